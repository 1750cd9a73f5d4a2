#include "nastran/ids.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace dynalin::nastran::ids_test {
namespace {

TEST(ids, families_with_the_same_offset_follow_each_other) {
  Ids ids;
  for (std::int64_t k = 1; k <= 3; ++k) EXPECT_EQ(ids.take(IdSpace::element, 1), k);
  EXPECT_EQ(ids.take(IdSpace::element, 1), 4);
  EXPECT_EQ(ids.take(IdSpace::element, 1000), 1000);
}

TEST(ids, spaces_do_not_see_each_other) {
  Ids ids;
  EXPECT_EQ(ids.take(IdSpace::element, 7), 7);
  EXPECT_EQ(ids.take(IdSpace::point, 7), 7);
  EXPECT_EQ(ids.take(IdSpace::element, 7), 8);
}

TEST(ids, numbers_start_at_one) {
  Ids ids;
  EXPECT_EQ(ids.take(IdSpace::point, 0), 1);
  EXPECT_EQ(ids.take(IdSpace::point, -5), 2);
}

TEST(ids, each_is_the_first_free_one_from_where_it_is_wanted) {
  std::mt19937 draw(7);
  Ids ids;
  std::set<std::int64_t> taken;
  for (int k = 0; k < 2000; ++k) {
    const std::int64_t wanted = std::uniform_int_distribution<std::int64_t>(1, 3000)(draw);
    std::int64_t expected = wanted;
    while (taken.count(expected)) ++expected;
    EXPECT_EQ(ids.is_free(IdSpace::property, wanted), expected == wanted);
    ASSERT_EQ(ids.take(IdSpace::property, wanted), expected);
    taken.insert(expected);
  }
}

}  // namespace
}  // namespace dynalin::nastran::ids_test
