// Assembly into a pattern that topology decides, never values.
#include "mechanics/accumulator.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

namespace dynalin::accumulator_test {
namespace {

struct Addition {
  std::int32_t row, column;
  std::vector<double> values;
};
using Places = std::map<std::pair<std::int32_t, std::int32_t>, double>;  // column, row

std::vector<Addition> drawn_additions(std::int32_t rows, std::int32_t columns) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int32_t> row(0, rows - 1), column(0, columns - 1), length(0, 4);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Addition> additions;
  for (int k = 0; k < 60; ++k) {
    Addition r{row(random), column(random), {}};
    for (std::int32_t n = std::min(length(random), rows - r.row); n > 0; --n) r.values.push_back(number(random));
    additions.push_back(r);
  }
  return additions;
}

void pass(Accumulator& a, const std::vector<Addition>& additions, double factor) {
  a.begin();
  for (const Addition& r : additions) {
    std::vector<double> v = r.values;
    for (double& x : v) x *= factor;
    a.add(r.row, r.column, v);
  }
  a.finish();
}

Places sums(const std::vector<Addition>& additions, double factor, bool sizes) {
  Places p;
  for (const Addition& r : additions) {
    for (std::size_t k = 0; k < r.values.size(); ++k) {
      const double v = factor * r.values[k];
      p[{r.column, r.row + static_cast<std::int32_t>(k)}] += sizes ? std::abs(v) : v;
    }
  }
  return p;
}

Places places(const ColumnMatrix& m, std::span<const double> values) {
  Places p;
  std::size_t k = 0;
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double) {
    EXPECT_FALSE(p.contains({c, r})) << "place twice";
    p[{c, r}] = values[k++];
  });
  EXPECT_EQ(k, values.size());
  return p;
}

void expect_same(const Places& a, const Places& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [at, v] : a) {
    ASSERT_TRUE(b.contains(at)) << "row " << at.second << " column " << at.first;
    EXPECT_NEAR(v, b.at(at), 1e-14) << "row " << at.second << " column " << at.first;
  }
}

TEST(Accumulator, sums_up_overlapping_runs_at_the_places_of_the_first_pass) {
  Accumulator a;
  a.resize(9, 7);
  const std::vector<Addition> additions = drawn_additions(9, 7);
  EXPECT_FALSE(a.recorded());
  pass(a, additions, 1);
  EXPECT_TRUE(a.recorded());
  for (const double factor : {1.0, -3.0}) {
    pass(a, additions, factor);
    expect_same(places(a.matrix(), a.matrix().value), sums(additions, factor, false));
  }
}

TEST(Accumulator, rows_ascend_within_a_column) {
  Accumulator a;
  a.resize(9, 7);
  pass(a, drawn_additions(9, 7), 1);
  const ColumnMatrix& m = a.matrix();
  ASSERT_EQ(m.start.size(), 8u);
  for (std::int32_t c = 0; c < m.columns; ++c) {
    std::int32_t last = -1;
    for_each_in_column(m, c, [&](std::int32_t r, double) {
      EXPECT_GT(r, last);
      last = r;
    });
  }
}

TEST(Accumulator, zeros_keep_their_places) {
  Accumulator a;
  a.resize(9, 7);
  const std::vector<Addition> additions = drawn_additions(9, 7);
  pass(a, additions, 0);
  pass(a, additions, 0);
  EXPECT_EQ(places(a.matrix(), a.matrix().value).size(), sums(additions, 1, false).size());
  pass(a, additions, 2);  // the pattern of a pass in which all was zero holds all later values
  expect_same(places(a.matrix(), a.matrix().value), sums(additions, 2, false));
}

TEST(Accumulator, sizes_are_sums_without_sign_and_forget_the_pass_before) {
  Accumulator a;
  a.resize(9, 7);
  a.keep_sizes();
  const std::vector<Addition> additions = drawn_additions(9, 7);
  pass(a, additions, 1);
  pass(a, additions, 5);
  pass(a, additions, -2);
  expect_same(places(a.matrix(), a.sizes()), sums(additions, 2, true));
}

TEST(Accumulator, entries_that_are_no_numbers_become_zero_and_are_named) {
  Accumulator a;
  a.resize(3, 3);
  a.keep_sizes();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  pass(a, {{0, 1, {1, nan}}, {2, 2, {-infinite}}, {2, 0, {4}}}, 1);
  pass(a, {{0, 1, {1, nan}}, {2, 2, {-infinite}}, {2, 0, {4}}}, 1);
  std::vector<std::pair<std::int32_t, std::int32_t>> named;
  a.clear_undefined([&](std::int32_t r, std::int32_t c) { named.emplace_back(r, c); });
  EXPECT_EQ(named, (std::vector<std::pair<std::int32_t, std::int32_t>>{{1, 1}, {2, 2}}));
  expect_same(places(a.matrix(), a.matrix().value), {{{0, 2}, 4}, {{1, 0}, 1}, {{1, 1}, 0}, {{2, 2}, 0}});
  expect_same(places(a.matrix(), a.sizes()), {{{0, 2}, 4}, {{1, 0}, 1}, {{1, 1}, 0}, {{2, 2}, 0}});
}

// What has cancelled still says by its size how far it may be off; only what nothing was added to goes.
TEST(Accumulator, settling_drops_places_that_hold_nothing) {
  Accumulator with_sizes, without;
  for (Accumulator* a : {&with_sizes, &without}) {
    a->resize(3, 4);
    if (a == &with_sizes) a->keep_sizes();
    for (int time = 0; time < 2; ++time) {
      pass(*a, {{0, 1, {1, 0, 2}}, {0, 2, {0, 0, 0}}, {1, 3, {5, -3}}, {1, 3, {-5}}}, 1);
    }
    a->settle();
  }
  expect_same(places(with_sizes.matrix(), with_sizes.matrix().value),
              {{{1, 0}, 1}, {{1, 2}, 2}, {{3, 1}, 0}, {{3, 2}, -3}});
  expect_same(places(with_sizes.matrix(), with_sizes.sizes()), {{{1, 0}, 1}, {{1, 2}, 2}, {{3, 1}, 10}, {{3, 2}, 3}});
  EXPECT_EQ(with_sizes.matrix().start, (std::vector<std::int32_t>{0, 0, 2, 2, 4}));
  expect_same(places(without.matrix(), without.matrix().value), {{{1, 0}, 1}, {{1, 2}, 2}, {{3, 2}, -3}});
}

TEST(Accumulator, a_new_size_forgets_the_pattern) {
  Accumulator a;
  a.resize(2, 2);
  pass(a, {{0, 0, {1}}}, 1);
  a.resize(3, 1);
  EXPECT_FALSE(a.recorded());
  pass(a, {{2, 0, {7}}}, 1);
  pass(a, {{2, 0, {7}}}, 1);
  expect_same(places(a.matrix(), a.matrix().value), {{{0, 2}, 7}});
}

TEST(ColumnMatrix, a_product_adds_factor_times_the_matrix) {
  Accumulator a;
  a.resize(2, 3);
  const std::vector<Addition> additions = {{0, 0, {1, 2}}, {1, 1, {3}}, {0, 2, {4, -5}}};
  pass(a, additions, 1);
  pass(a, additions, 1);
  std::vector<double> y = {10, 20};
  a.matrix().multiply_add(std::vector<double>{1, -1, 2}, y, 0.5);
  EXPECT_EQ(y, (std::vector<double>{10 + 0.5 * 9, 20 + 0.5 * (2 - 3 - 10)}));
}

}  // namespace
}  // namespace dynalin::accumulator_test
