#include "base/program_heap.h"

#include <cstdlib>  // says whether the C library is glibc
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <vector>
#endif

namespace dynalin {

#ifdef __GLIBC__

namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

bool has_limited_addresses() {
  struct rlimit limit {};
  for (const auto which : {RLIMIT_AS, RLIMIT_DATA}) {
    if (::getrlimit(which, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return true;
  }
  return false;
}

std::size_t machine_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(size) : 0;
}

// The heap reaches as far as it is to be before anything lies in it, since advice holds for what is there.
void grow_in_large_pages(std::size_t room) {
  constexpr std::size_t block = 512 * mebibyte;  // below what is mapped by itself
  const auto heap_end = [] { return reinterpret_cast<std::uintptr_t>(::sbrk(0)); };
  const std::uintptr_t before = heap_end();
  std::vector<void*> blocks;
  blocks.reserve(room / block);
  for (std::uintptr_t end = before; blocks.size() < room / block;) {
    blocks.push_back(std::malloc(block));
    if (heap_end() == end) break;
    end = heap_end();
  }
  for (void* const b : blocks) std::free(b);
  constexpr std::uintptr_t page = 2 * mebibyte;
  const std::uintptr_t first = (before + page - 1) / page * page, last = heap_end() / page * page;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace

void prepare_heap() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TRIM_THRESHOLD, -1);  // nothing is given back
  if (!has_limited_addresses()) grow_in_large_pages(machine_memory() / 4);
}

#else

void prepare_heap() {}

#endif

}  // namespace dynalin
