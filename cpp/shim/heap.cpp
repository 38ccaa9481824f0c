#include "carvel-peers/shim/heap.hpp"

#include <malloc.h>

#include <climits>

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

}  // namespace carvel_peers
