#include "base/program_heap.h"

#include <cstdlib>  // says whether the C library is glibc
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "base/signals_held_back.h"
#endif

namespace dynalin {

#ifdef __GLIBC__

namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;
constexpr std::uintptr_t page = 2 * mebibyte;

// Large pages, from the first address to the one behind the last.
struct Pages {
  std::uintptr_t first = 0, last = 0;
};

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
Pages grow_in_large_pages(std::size_t room) {
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
  const Pages pages{(before + page - 1) / page * page, heap_end() / page * page};
  if (pages.first >= pages.last ||
      ::madvise(reinterpret_cast<void*>(pages.first), pages.last - pages.first, MADV_HUGEPAGE) != 0)
    return {};
  return pages;
}

#ifdef MADV_POPULATE_WRITE

// Clears pages before the program comes to them. The first page of each stretch is left to the program: once it is
// there, the stretches behind it are next.
void clear_ahead(Pages pages) {
  constexpr std::uintptr_t untouched = 512 * mebibyte;  // most models need less
  constexpr std::uintptr_t stretch = 32 * mebibyte, lead = 2 * stretch;
  constexpr std::chrono::milliseconds soon(1), seldom(50);
  std::uintptr_t reached = pages.first + untouched, cleared = reached;
  std::chrono::milliseconds pause = soon;
  while (reached + stretch <= pages.last) {
    unsigned char in_memory = 0;
    if (::mincore(reinterpret_cast<void*>(reached), 1, &in_memory) != 0) return;
    if ((in_memory & 1u) == 0) {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, seldom);
      continue;
    }
    pause = soon;
    reached += stretch;
    for (; cleared < reached + lead && cleared + stretch <= pages.last; cleared += stretch) {
      if (::madvise(reinterpret_cast<void*>(cleared + page), stretch - page, MADV_POPULATE_WRITE) != 0) return;
    }
  }
}

void clear_ahead_in_a_thread(Pages pages) {
  const SignalsHeldBack quiet;
  try {
    std::thread(clear_ahead, pages).detach();
  } catch (const std::system_error&) {  // the program does it itself
  }
}

#else

void clear_ahead_in_a_thread(Pages) {}

#endif

}  // namespace

void prepare_heap() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TRIM_THRESHOLD, -1);  // nothing is given back
  if (has_limited_addresses()) return;
  const Pages pages = grow_in_large_pages(machine_memory() / 4);
  if (pages.first < pages.last && thread_count() > 1) clear_ahead_in_a_thread(pages);
}

#else

void prepare_heap() {}

#endif

}  // namespace dynalin
