// The order in which loops fill in little, against elimination in numbers.
#include "system/nested_dissection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "system/sparse_lu.h"

namespace dynalin::nested_dissection_test {
namespace {

// A grid of side × side bodies of three coordinates each, and a multiplier between neighbours; numbered at random.
struct Grid {
  std::int32_t side, bodies, size;
  ColumnMatrix matrix;

  explicit Grid(std::int32_t n) : side(n), bodies(n * n) {
    std::vector<Triplet> t;
    for (std::int32_t b = 0; b < bodies; ++b) {
      for (std::int32_t i = 0; i < 3; ++i) {
        for (std::int32_t j = 0; j < 3; ++j) t.push_back({3 * b + i, 3 * b + j, 1});
      }
    }
    std::int32_t lambda = 3 * bodies;
    std::vector<std::int32_t> number(static_cast<std::size_t>(bodies));
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), std::mt19937(4));
    const auto connect = [&](std::int32_t one, std::int32_t other) {
      const std::int32_t a = number[static_cast<std::size_t>(one)], b = number[static_cast<std::size_t>(other)];
      for (const std::int32_t body : {a, b}) {
        for (std::int32_t i = 0; i < 3; ++i)
          t.push_back({lambda, 3 * body + i, 1}), t.push_back({3 * body + i, lambda, 1});
      }
      ++lambda;
    };
    for (std::int32_t y = 0; y < side; ++y) {
      for (std::int32_t x = 0; x < side; ++x) {
        if (x + 1 < side) connect(y * side + x, y * side + x + 1);
        if (y + 1 < side) connect(y * side + x, (y + 1) * side + x);
      }
    }
    size = lambda;
    matrix = compressed(size, size, t);
  }
};

// Entries of the factor below the diagonal, by elimination of the pattern.
std::size_t fill(const ColumnMatrix& m, const std::vector<std::int32_t>& place) {
  std::vector<std::set<std::int32_t>> later(place.size());
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double) {
    const std::int32_t a = place[static_cast<std::size_t>(r)], b = place[static_cast<std::size_t>(c)];
    if (a != b) later[static_cast<std::size_t>(std::min(a, b))].insert(std::max(a, b));
  });
  std::size_t entries = 0;
  for (auto& of : later) {
    entries += of.size();
    if (of.empty()) continue;
    auto& next = later[static_cast<std::size_t>(*of.begin())];
    next.insert(std::next(of.begin()), of.end());
  }
  return entries;
}

TEST(NestedDissection, is_an_order_of_all_unknowns_that_fills_in_little) {
  const Grid grid(24);
  const auto place = nested_dissection(grid.matrix);
  ASSERT_TRUE(place);
  std::vector<std::int32_t> sorted = *place, counted(place->size());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < counted.size(); ++k) counted[k] = static_cast<std::int32_t>(k);
  EXPECT_EQ(sorted, counted);
  EXPECT_LT(fill(grid.matrix, *place), fill(grid.matrix, counted) / 2);
}

TEST(NestedDissection, a_multiplier_comes_behind_a_body_that_it_holds) {
  const Grid grid(9);
  const auto place = nested_dissection(grid.matrix);
  ASSERT_TRUE(place);
  for (std::int32_t k = 3 * grid.bodies; k < grid.size; ++k) {
    std::int32_t first = grid.size;
    for_each_in_column(grid.matrix, k,
                       [&](std::int32_t r, double) { first = std::min(first, (*place)[static_cast<std::size_t>(r)]); });
    EXPECT_LT(first, (*place)[static_cast<std::size_t>(k)]);
  }
}

TEST(NestedDissection, only_of_symmetric_patterns) {
  EXPECT_FALSE(nested_dissection(compressed(2, 2, std::vector<Triplet>{{0, 0, 1}, {1, 1, 1}, {0, 1, 1}})));
  EXPECT_FALSE(nested_dissection(compressed(2, 3, std::vector<Triplet>{{0, 0, 1}, {1, 1, 1}})));
  const auto few = nested_dissection(compressed(2, 2, std::vector<Triplet>{{0, 0, 1}, {1, 1, 1}}));
  ASSERT_TRUE(few);
  EXPECT_EQ(few->size(), 2u);
}

}  // namespace
}  // namespace dynalin::nested_dissection_test
