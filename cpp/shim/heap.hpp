// The C library's heap, which both sides allocate from, and its clock.
#pragma once

namespace carvel_peers {

// Large arrays come from pages that nobody has touched, and go back when freed.
void heap_fresh();
// Freed memory stays with the process and is handed out again.
void heap_keep();
// Gives back what is free.
void heap_trim();
// Processor time of the process, in kernel and user mode.
double cpu_seconds();

}  // namespace carvel_peers
