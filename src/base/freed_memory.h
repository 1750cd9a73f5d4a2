// How a program keeps memory that it has freed. For the main function of programs: it holds for the whole process.
#pragma once

#include <cstdlib>  // says whether the C library is glibc
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dynalin {

// Columns of all unknowns of large models come and go: given back to the system each time, they would have to be
// cleared, page by page, a third of a run for selected modes of very large ones. What one thread frees another takes:
// all have one arena, as nothing that they share allocates much.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 1024 * mebibyte);
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TRIM_THRESHOLD, 1024 * mebibyte);
#endif
}

}  // namespace dynalin
