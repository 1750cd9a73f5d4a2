#include "simulation/hidden_crossings.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dynalin::hidden_crossings_test {
namespace {

// One function over a step, and what is found of it: times and signs one after the other.
struct Found {
  std::vector<double> times;
  std::vector<int> signs;
  int looks = 0;
};
template <class Function>
Found search(Function&& f, double from, double to) {
  HiddenCrossings search;
  const double begin = f(from), end = f(to);
  search.begin({&begin, 1});
  Found found;
  for (double t = from; found.times.size() < 10;) {
    const int reported = end * begin < 0 ? 1 : 0;  // by who compares the ends
    const auto at = search.first(
        t, to, {&end, 1}, [&](double s, std::span<double> v) { v[0] = f(s), ++found.looks; }, std::span(&reported, 1));
    if (!at) break;
    found.times.push_back(t = *at);
    found.signs.push_back(search.crossed()[0]);
  }
  return found;
}

TEST(HiddenCrossings, finds_what_is_beyond_zero_for_a_moment) {
  for (const double depth : {0.3, 1e-3, 1e-9}) {
    const Found f = search([&](double t) { return (t - 0.41) * (t - 0.41) - depth * depth; }, 0, 2);
    ASSERT_EQ(f.times.size(), 2u) << depth;
    EXPECT_NEAR(f.times[0], 0.41 - depth, 1e-12);
    EXPECT_NEAR(f.times[1], 0.41 + depth, 1e-12);
    EXPECT_EQ(f.signs, (std::vector<int>{-1, 1}));
  }
}

TEST(HiddenCrossings, finds_all_of_a_step_in_their_order) {
  const Found f = search([](double t) { return (t - 0.1) * (t - 0.5) * (t - 0.6); }, 0, 1);
  ASSERT_EQ(f.times.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(f.times[k], (std::array{0.1, 0.5, 0.6})[k], 1e-12);
  EXPECT_EQ(f.signs, (std::vector<int>{1, -1, 1}));
}

TEST(HiddenCrossings, leaves_what_comes_near_zero_and_what_begins_there) {
  EXPECT_TRUE(search([](double t) { return 1e-6 + (t - 0.5) * (t - 0.5); }, 0, 1).times.empty());
  EXPECT_TRUE(search([](double t) { return t; }, 0, 1).times.empty());
}

// The gap of two balls that pass each other at a steady speed: a dip of one part in 5 to 500 of the step.
TEST(HiddenCrossings, finds_a_narrow_dip_of_what_falls_and_rises_steadily) {
  for (const double step : {0.02, 0.3, 2.0}) {
    for (const double at : {0.09, 0.2, 0.41, 0.5, 0.83, 0.91}) {
      const auto gap = [&](double t) { return std::hypot(10 * (t - at * step), 0.015) - 0.02; };
      const double half = 0.1 * std::sqrt(0.02 * 0.02 - 0.015 * 0.015);
      const Found f = search(gap, 0, step);
      ASSERT_EQ(f.times.size(), 2u) << step << " " << at;
      EXPECT_NEAR(f.times[0], at * step - half, 1e-12);
      EXPECT_NEAR(f.times[1], at * step + half, 1e-12);
    }
  }
}

TEST(HiddenCrossings, looks_no_closer_at_what_is_out_of_reach) {
  EXPECT_EQ(search([](double t) { return std::hypot(10 * (t - 0.4), 0.015) + 3; }, 0, 1).looks, 2);
  EXPECT_EQ(search([](double t) { return 1 - 0.9 * t; }, 0, 1).looks, 2);
  EXPECT_EQ(search([](double t) { return 1 / (1 + t); }, 0, 1).looks, 2);
  const Found passes = search([](double t) { return std::hypot(10 * (t - 0.4), 0.021) - 0.02; }, 0, 1);
  EXPECT_TRUE(passes.times.empty());
  EXPECT_LT(passes.looks, 26);
}

// What has begun beside zero by a rounding and ends on that side was on the other one in between.
TEST(HiddenCrossings, finds_the_end_of_what_began_with_a_sign_of_rounding) {
  const Found f = search([](double t) { return t == 0 ? -1e-18 : t * (0.9 - t); }, 0, 1);
  ASSERT_EQ(f.times.size(), 1u);
  EXPECT_NEAR(f.times[0], 0.9, 1e-12);
}

TEST(HiddenCrossings, takes_a_sign_of_rounding_where_it_begins_for_what_follows) {
  const auto f = [](double t) { return t == 0 ? -1e-18 : t * (2 - t); };
  EXPECT_TRUE(search(f, 0, 1).times.empty());
}

}  // namespace
}  // namespace dynalin::hidden_crossings_test
