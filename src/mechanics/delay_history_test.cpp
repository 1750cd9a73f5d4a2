// What is read of the past: the order of the interpolation, what happens at jumps, and how long it is kept.
#include "mechanics/delay_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dynalin::delay_history_test {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double forever = -std::numeric_limits<double>::infinity();

double f(double t) { return std::sin(3 * t) + 0.2 * t * t; }
double slope_of_f(double t) { return 3 * std::cos(3 * t) + 0.4 * t; }

// f at steps of h from 0 to 2, every other one half as long.
DelayHistory history(double h, bool slopes) {
  DelayHistory past;
  double t = 0;
  for (int k = 0; t < 2 + 1e-12; ++k) {
    past.append(t, f(t), slopes ? slope_of_f(t) : unknown, forever);
    t += k % 2 == 0 ? h : 0.5 * h;
  }
  return past;
}

double largest_error(const DelayHistory& past) {
  double largest = 0;
  for (double s = 0.013; s < past.end(); s += 0.0171) largest = std::max(largest, std::abs(past.at(s).value - f(s)));
  return largest;
}

TEST(DelayHistory, is_of_fourth_order_with_and_without_slopes) {
  for (const bool slopes : {true, false}) {
    const double coarse = largest_error(history(0.1, slopes)), fine = largest_error(history(0.05, slopes));
    EXPECT_GT(coarse, 0);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.35) << slopes;
    EXPECT_LT(fine, slopes ? 5e-6 : 1e-4);
  }
}

TEST(DelayHistory, passes_its_instants_and_knows_the_slope_of_its_own_course) {
  for (const bool slopes : {true, false}) {
    const DelayHistory past = history(0.1, slopes);
    EXPECT_EQ(past.start(), 0);
    EXPECT_NEAR(past.at(0).value, f(0), 1e-15);
    EXPECT_NEAR(past.at(past.end()).value, f(past.end()), 1e-15);
    EXPECT_NEAR(past.at(0.15).value, f(0.15), 1e-15);
    for (const double s : {0.02, 0.31, 1.234}) {
      const double h = 1e-5, difference = (past.at(s + h).value - past.at(s - h).value) / (2 * h);
      EXPECT_NEAR(past.at(s).slope, difference, 1e-8);
      EXPECT_EQ(past.at(s).by_present, 0);
    }
  }
}

// A delay shorter than the step: the course goes on from the last instant to the present value.
TEST(DelayHistory, behind_the_last_instant_it_goes_on_to_the_present) {
  for (const bool slopes : {true, false}) {
    const auto error = [&](double h) {
      const DelayHistory past = history(h, slopes);
      const double t = past.end() + h, s = t - 0.3 * h;
      return std::abs(past.at(s, t, f(t)).value - f(s));
    };
    EXPECT_NEAR(std::log2(error(0.04) / error(0.02)), 4, 0.5) << slopes;
    const DelayHistory past = history(0.1, slopes);
    const double t = past.end() + 0.1, s = t - 0.03, e = 1.7;
    const auto at = past.at(s, t, e);
    EXPECT_NEAR(at.by_present, past.at(s, t, e + 1).value - at.value, 1e-12);
    EXPECT_NEAR(at.slope, (past.at(s + 1e-5, t, e).value - past.at(s - 1e-5, t, e).value) / 2e-5, 1e-7);
    // No delay at all: the present itself; as far as the last instant: that one.
    EXPECT_NEAR(past.at(t, t, e).value, e, 1e-14);
    EXPECT_NEAR(past.at(t, t, e).by_present, 1, 1e-14);
    EXPECT_NEAR(past.at(past.end() + 1e-12, t, e).value, f(past.end()), 1e-9);
  }
}

TEST(DelayHistory, one_instant_is_enough) {
  DelayHistory past;
  past.append(1, 5, unknown, forever);
  EXPECT_EQ(past.at(1).value, 5);
  EXPECT_EQ(past.at(1.25, 1.5, 7).value, 6);
  EXPECT_EQ(past.at(1.25, 1.5, 7).by_present, 0.5);
}

// Two instants right beside each other, one of them off by what an integration leaves open.
TEST(DelayHistory, noise_of_near_instants_stays_what_it_is) {
  for (const bool slopes : {true, false}) {
    DelayHistory past = history(0.1, slopes);
    const double end = past.end() + 1e-6, noise = 1e-8;
    past.append(end, f(end) + noise, slopes ? slope_of_f(end) : unknown, forever);
    EXPECT_NEAR(past.at(end + 0.05, end + 0.1, f(end + 0.1)).value, f(end + 0.05), 2e-3);
    past.append(end + 0.1, f(end + 0.1), slopes ? slope_of_f(end + 0.1) : unknown, forever);
    EXPECT_NEAR(past.at(end + 0.05).value, f(end + 0.05), 2e-3);
  }
}

// e = t before t = 1, 10 + 2 t behind.
TEST(DelayHistory, nothing_goes_across_a_jump) {
  for (const bool slopes : {true, false}) {
    DelayHistory past;
    for (const double t : {0.0, 0.4, 0.8, 1.0}) past.append(t, t, slopes ? 1 : unknown, forever);
    EXPECT_LT(past.switching(0.9) * past.switching(-0.1), 0);
    EXPECT_GT(past.switching(0.9) * past.switching(3), 0);  // the start is the only place
    past.append(1.0, 12, slopes ? 2 : unknown, forever);
    for (const double t : {1.1, 1.5, 2.0}) past.append(t, 10 + 2 * t, slopes ? 2 : unknown, forever);
    EXPECT_NEAR(past.at(0.95).value, 0.95, 1e-14);
    EXPECT_NEAR(past.at(1 - 1e-9).value, 1, 1e-8);
    EXPECT_NEAR(past.at(1).value, 12, 1e-13);
    EXPECT_NEAR(past.at(1.05).value, 12.1, 1e-13);
    EXPECT_LT(past.switching(0.9) * past.switching(1.1), 0);
    EXPECT_NEAR(past.switching(1), 0, 1e-14);
    EXPECT_NEAR(past.switching(0), 0, 1e-14);
    // Right behind an event only what follows from it counts.
    DelayHistory fresh;
    for (const double t : {0.0, 0.5, 1.0}) fresh.append(t, t, slopes ? 1 : unknown, forever);
    fresh.append(1.0, 12, slopes ? 2 : unknown, forever);
    EXPECT_NEAR(fresh.at(1.1, 1.2, 12.4).value, 12.2, 1e-13);
  }
}

TEST(DelayHistory, a_kink_is_a_place_too_and_noise_of_a_new_start_is_none) {
  DelayHistory past;
  for (const double t : {0.0, 0.5, 1.0}) past.append(t, t, 1, forever);
  past.append(1.0, 1 + 1e-9, 1 + 1e-6, forever);
  EXPECT_EQ(past.size(), 3u);
  past.append(1.0, 1, -1, forever);
  EXPECT_EQ(past.size(), 4u);
  past.append(2.0, 0, -1, forever);
  EXPECT_LT(past.switching(0.9) * past.switching(1.1), 0);
  EXPECT_NEAR(past.at(1.5).value, 0.5, 1e-14);
}

// A copy keeps what it had; both go on by themselves.
TEST(DelayHistory, copies_are_independent) {
  DelayHistory past;
  for (int k = 0; k < 300; ++k) past.append(0.01 * k, f(0.01 * k), slope_of_f(0.01 * k), forever);
  const DelayHistory before = past;
  for (int k = 300; k < 500; ++k) past.append(0.01 * k, -1, 0, forever);
  EXPECT_EQ(before.size(), 300u);
  EXPECT_NEAR(before.end(), 2.99, 1e-12);
  for (const double s : {0.005, 0.633, 1.999, 2.985}) EXPECT_NEAR(before.at(s).value, f(s), 1e-7);
  EXPECT_NEAR(past.at(0.005).value, f(0.005), 1e-7);
}

TEST(DelayHistory, forgets_what_nobody_asks_for_any_more) {
  DelayHistory past, all;
  for (int k = 0; k < 20000; ++k) {
    const double t = 0.01 * k;
    past.append(t, f(t), slope_of_f(t), t - 1), all.append(t, f(t), slope_of_f(t), forever);
    if (k % 70 == 0) past.append(t, f(t) + 2, slope_of_f(t), t - 1), all.append(t, f(t) + 2, slope_of_f(t), forever);
    if (k < 200 || k % 33 != 0) continue;
    EXPECT_EQ(past.at(t - 0.995).value, all.at(t - 0.995).value);
    EXPECT_EQ(past.switching(t - 0.5) < 0, all.switching(t - 0.5) < 0) << t;
  }
  EXPECT_LT(past.size(), 500u);
  EXPECT_GT(all.size(), 20000u);
  EXPECT_EQ(past.start(), 0);
}

TEST(DelayHistory, begins_anew_where_time_goes_back) {
  DelayHistory past = history(0.1, true);
  past.append(0.5, 3, 0, forever);
  EXPECT_EQ(past.size(), 1u);
  EXPECT_EQ(past.start(), 0.5);
}

// What an event changes beyond value and slope is a place as well where who records it says so.
TEST(DelayHistory, both_sides_of_an_event_are_kept) {
  DelayHistory past;
  for (const double t : {0.0, 0.5, 1.0 - 1e-12}) past.append(t, t, 1, forever);
  past.append_behind(1, 1, 1, forever, false);
  EXPECT_EQ(past.size(), 3u);
  past.append(1.5, 1.5, 1, forever), past.append(2 - 1e-12, 2, 1, forever);
  past.append_behind(2, 2, 1, forever, true);
  EXPECT_EQ(past.size(), 6u);
  past.append(3 - 1e-12, 3, 1, forever);
  past.append_behind(3, 7, 0, forever, false);
  past.append(4, 7, 0, forever);
  EXPECT_NEAR(past.at(3 - 1e-9).value, 3, 1e-8);
  EXPECT_NEAR(past.at(3).value, 7, 1e-14);
  EXPECT_LT(past.switching(1.9) * past.switching(2.1), 0);
  EXPECT_LT(past.switching(2.9) * past.switching(3.1), 0);
}

TEST(DelayHistory, steps_end_between_two_events_and_pass_over_nothing) {
  DelayHistory past;
  past.append(0, 0, 0, forever);
  for (const double t : {1.0, 1.001}) {
    past.append(t - 1e-12, 0, 0, forever);
    past.append_behind(t, 0, 0, forever, true);
  }
  for (const double t : {2.0, 3.0, 3.1, 3.2, 4.0, 5.0}) past.append(t, t == 3.1 ? 1 : 0, 0, forever);
  const auto end = [&](double from, double to) {
    StepReach r(1e-3);
    past.look_ahead(from, to, r);
    return from + r.share() * (to - from);
  };
  EXPECT_NEAR(end(0.5, 1.5), 1.0005, 1e-9);
  EXPECT_NEAR(end(0.5, 0.9), 0.9, 1e-12);
  EXPECT_NEAR(end(2.5, 4.5), 3.1, 0.1 + 1e-9);
  EXPECT_NEAR(end(3.3, 4.5), 4.5, 1e-12);
}

}  // namespace
}  // namespace dynalin::delay_history_test
