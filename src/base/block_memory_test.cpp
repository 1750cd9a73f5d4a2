#include "base/block_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dynalin::block_memory_test {
namespace {

using Numbers = std::pmr::vector<std::int64_t>;

std::vector<Numbers> lists(BlockMemory& memory, std::size_t count) {
  std::vector<Numbers> made;
  for (std::size_t k = 0; k < count; ++k) {
    made.emplace_back(&memory);
    made.back().assign(5, static_cast<std::int64_t>(k));
  }
  return made;
}

TEST(block_memory, goes_back_in_the_order_in_which_it_was_taken) {
  BlockMemory memory;
  std::vector<Numbers> made = lists(memory, 100'000);  // 4 MB
  const std::size_t all = memory.blocks();
  EXPECT_GT(all, 8u);
  for (std::size_t k = 0; k < made.size() / 2; ++k) {
    ASSERT_EQ(made[k], Numbers(5, static_cast<std::int64_t>(k)));
    Numbers(&memory).swap(made[k]);
  }
  EXPECT_LE(memory.blocks(), all / 2 + 2);
  EXPECT_EQ(made.back(), Numbers(5, 99'999));
  made.clear();
  EXPECT_EQ(memory.blocks(), 1u);  // that from which the next piece is taken
}

TEST(block_memory, takes_pieces_of_any_size_and_alignment) {
  BlockMemory memory;
  for (const std::size_t bytes : {1u, 3u, 4095u, 4096u, 100'000u, 3'000'000u}) {
    for (const std::size_t alignment : {1u, 8u, 64u}) {
      void* piece = memory.allocate(bytes, alignment);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(piece) % alignment, 0u) << bytes;
      std::fill_n(static_cast<char*>(piece), bytes, 'x');
    }
  }
}

// What is in no block any more is taken from the same one again.
TEST(block_memory, is_used_again_where_the_latest_block_is_free) {
  BlockMemory memory;
  for (int k = 0; k < 10'000; ++k) Numbers(100, 7, &memory);
  EXPECT_EQ(memory.blocks(), 1u);
}

TEST(block_memory, of_a_copy_is_its_own) {
  Numbers copy;
  {
    BlockMemory memory;
    Numbers original({1, 2, 3}, &memory);
    copy = original;
    EXPECT_EQ(Numbers(original), original);
  }
  EXPECT_EQ(copy, Numbers({1, 2, 3}));
}

}  // namespace
}  // namespace dynalin::block_memory_test
