#include "base/block_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <iterator>
#include <new>

namespace dynalin {

namespace {

class SystemPages final : public std::pmr::memory_resource {
  static constexpr std::size_t large = std::size_t{1} << 17;

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (bytes < large) return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    return pages;
  }
  void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
    if (bytes < large) return std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
    munmap(block, bytes);
  }
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
};

constexpr std::size_t block_alignment = 64;

void give_back(std::byte* begin, std::size_t size) { system_pages().deallocate(begin, size, block_alignment); }

}  // namespace

std::pmr::memory_resource& system_pages() {
  static SystemPages pages;
  return pages;
}

BlockMemory::~BlockMemory() {
  for (const auto& [begin, block] : blocks_) give_back(begin, block.size);
}

void* BlockMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
  if (alignment > block_alignment) throw std::bad_alloc();
  constexpr std::size_t first = std::size_t{1} << 12, largest = std::size_t{1} << 19;
  std::size_t at = (used_ + alignment - 1) / alignment * alignment;
  if (!latest_ || at + bytes > blocks_[latest_].size) {
    const std::size_t next = latest_ ? std::min(2 * blocks_[latest_].size, largest) : first;
    const std::size_t size = std::max(next, bytes);
    latest_ = static_cast<std::byte*>(system_pages().allocate(size, block_alignment));
    blocks_[latest_] = {size, 0};
    at = 0;
  }
  used_ = at + bytes;
  ++blocks_[latest_].pieces;
  return latest_ + at;
}

void BlockMemory::do_deallocate(void* piece, std::size_t, std::size_t) {
  const auto block = std::prev(blocks_.upper_bound(static_cast<std::byte*>(piece)));
  if (--block->second.pieces > 0) return;
  if (block->first == latest_) {
    used_ = 0;
    return;
  }
  give_back(block->first, block->second.size);
  blocks_.erase(block);
}

}  // namespace dynalin
