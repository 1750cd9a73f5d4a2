// Ids that fill a table densely, with wide gaps, or all at the same remainder.
#include "model/id_table.h"

#include <gtest/gtest.h>

#include <set>

namespace dynalin::model_test::id_table_test {
namespace {

// The id itself is what it stands for.
void expect_all_found(const std::vector<std::int32_t>& ids, bool reserved) {
  IdTable<std::int32_t> table;
  if (reserved) table.reserve(ids.size());
  for (const std::int32_t id : ids) {
    EXPECT_EQ(table.find(id), nullptr);
    EXPECT_TRUE(table.emplace(id, id).second);
    ASSERT_NE(table.find(id), nullptr);
  }
  EXPECT_EQ(table.size(), ids.size());
  std::set<std::int32_t> seen;
  for (const std::int32_t id : ids) {
    ASSERT_NE(table.find(id), nullptr) << id;
    EXPECT_EQ(*table.find(id), id);
    EXPECT_EQ(table.find(id + (std::int64_t{1} << 32)), nullptr);
  }
  table.for_each([&](std::int32_t id, std::int32_t value) {
    EXPECT_EQ(id, value);
    EXPECT_TRUE(seen.insert(id).second);
  });
  EXPECT_EQ(seen, std::set<std::int32_t>(ids.begin(), ids.end()));
}

TEST(IdTable, finds_all_that_it_was_given) {
  for (const std::int32_t step : {1, 8, 1000, 65536, 99991}) {
    std::vector<std::int32_t> ids;
    for (std::int32_t k = 1; k <= 20000; ++k) ids.push_back(k * step);
    SCOPED_TRACE(step);
    expect_all_found(ids, true);
    expect_all_found(ids, false);
  }
  expect_all_found({2147483647, 1, 2147483646}, true);
}

TEST(IdTable, keeps_the_first_of_two) {
  IdTable<int> table;
  table.reserve(1);
  EXPECT_TRUE(table.emplace(7, 1).second);
  const auto [value, fresh] = table.emplace(7, 2);
  EXPECT_FALSE(fresh);
  EXPECT_EQ(*value, 1);
  EXPECT_EQ(table.size(), 1u);
}

TEST(IdTable, has_no_ids_that_are_none) {
  IdTable<int> table;
  EXPECT_EQ(table.find(1), nullptr);
  table.emplace(1, 1);
  for (const std::int64_t id : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 32})
    EXPECT_EQ(table.find(id), nullptr) << id;
}

}  // namespace
}  // namespace dynalin::model_test::id_table_test
