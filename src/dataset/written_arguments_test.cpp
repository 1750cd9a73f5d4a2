#include "dataset/written_arguments.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "base/block_memory.h"

namespace dynalin::written_arguments_test {
namespace {

// An argument that is known by a number.
WrittenArgument argument(std::uint32_t number) {
  WrittenArgument w;
  w.name.offset = number;
  return w;
}

std::vector<std::uint32_t> numbers(const WrittenArguments& list) {
  std::vector<std::uint32_t> all;
  for (const WrittenArgument& w : list) all.push_back(w.name.offset);
  return all;
}
using Numbers = std::vector<std::uint32_t>;

TEST(WrittenArguments, cost_a_statement_one_pointer) { EXPECT_EQ(sizeof(WrittenArguments), sizeof(void*)); }

TEST(WrittenArguments, are_none_at_first) {
  WrittenArguments list;
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(numbers(list), Numbers{});
  list.erase_if([](const WrittenArgument&) { return true; });
  list.release();
  EXPECT_TRUE(list.empty());
  EXPECT_THROW(list.at(0), std::out_of_range);
}

TEST(WrittenArguments, are_added_inserted_and_taken_out) {
  WrittenArguments list;
  for (std::uint32_t k = 0; k < 10; ++k) list.push_back(argument(k));
  EXPECT_EQ(numbers(list), (Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  const std::array more = {argument(20), argument(21)};
  list.insert(0, more);
  list.insert(5, more);
  EXPECT_EQ(numbers(list), (Numbers{20, 21, 0, 1, 2, 20, 21, 3, 4, 5, 6, 7, 8, 9}));
  list.erase(0);
  list.erase(list.size() - 1);
  EXPECT_EQ(numbers(list), (Numbers{21, 0, 1, 2, 20, 21, 3, 4, 5, 6, 7, 8}));
  list.erase_if([](const WrittenArgument& w) { return w.name.offset >= 20; });
  EXPECT_EQ(numbers(list), (Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(list.front().name.offset, 0u);
  EXPECT_EQ(list.back().name.offset, 8u);
  EXPECT_EQ(list.at(3).name.offset, 3u);
  EXPECT_THROW(list.at(9), std::out_of_range);
}

// However many of them: adding them one by one costs no more than copying each a few times.
TEST(WrittenArguments, may_be_a_great_many) {
  constexpr std::uint32_t count = 200'000;
  WrittenArguments list;
  for (std::uint32_t k = 0; k < count; ++k) list.push_back(argument(k));
  ASSERT_EQ(list.size(), count);
  EXPECT_EQ(list[count - 1].name.offset, count - 1);
}

TEST(WrittenArguments, copies_outlive_the_memory_of_what_they_are_copied_from) {
  WrittenArguments copy, moved;
  {
    BlockMemory memory;
    const std::array two = {argument(1), argument(2)};
    WrittenArguments list(two, memory);
    copy = list;
    list.push_back(argument(3));
    EXPECT_EQ(numbers(list), (Numbers{1, 2, 3}));
    WrittenArguments other = std::move(list);
    EXPECT_EQ(numbers(other), (Numbers{1, 2, 3}));
    moved = other;
  }
  copy.push_back(argument(4));
  EXPECT_EQ(numbers(copy), (Numbers{1, 2, 4}));
  EXPECT_EQ(numbers(moved), (Numbers{1, 2, 3}));
}

TEST(WrittenArguments, give_their_memory_back) {
  BlockMemory memory;
  const std::vector<WrittenArgument> many(100'000);
  WrittenArguments first(many, memory), second(many, memory);
  const std::size_t blocks = memory.blocks();
  first.release();
  EXPECT_LT(memory.blocks(), blocks);
  EXPECT_TRUE(first.empty());
  EXPECT_EQ(second.size(), many.size());
}

}  // namespace
}  // namespace dynalin::written_arguments_test
