#include "carvel-peers/shim/heap.hpp"

#include <malloc.h>

#include <climits>
#include <ctime>

namespace carvel_peers {

void heap_fresh() {
  // Setting the threshold, here to its initial value, also stops the C library from
  // raising it: a fresh process has not freed a large array yet.
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  malloc_trim(0);
}

void heap_keep() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, 64 * 1024 * 1024);
}

void heap_trim() { malloc_trim(0); }

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace carvel_peers
