// Memory for a great many small values that are made one after the other and go in the same order.
#pragma once

#include <cstddef>
#include <map>
#include <memory_resource>

namespace dynalin {

// Small blocks as everything else; large ones are pages of the system's and go straight back to it, where the C library
// would keep them for the program.
std::pmr::memory_resource& system_pages();

// Pieces out of such blocks. A block goes back as soon as no piece of it is in use, and everything with this object.
// For one thread at a time.
class BlockMemory final : public std::pmr::memory_resource {
 public:
  BlockMemory() = default;
  BlockMemory(const BlockMemory&) = delete;
  BlockMemory& operator=(const BlockMemory&) = delete;
  ~BlockMemory() override;

  std::size_t blocks() const { return blocks_.size(); }

 private:
  struct Block {
    std::size_t size = 0, pieces = 0;
  };

  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* piece, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }

  std::map<std::byte*, Block> blocks_;  // by where they begin
  std::byte* latest_ = nullptr;         // the block that pieces are taken from
  std::size_t used_ = 0;                // of it
};

}  // namespace dynalin
