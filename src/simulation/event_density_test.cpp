#include "simulation/event_density.h"

#include <gmock/gmock.h>

namespace dynalin::event_density_test {
namespace {

using ::testing::HasSubstr;

TEST(EventDensity, passes_over_switches_after_very_many_restarts_in_a_row_and_says_so_once) {
  EventDensity density;
  Diagnostics warnings;
  std::int64_t steps = 0;
  // The first one follows none.
  for (int k = 0; k <= 200; ++k) {
    EXPECT_TRUE(density.watches());
    density.note_restart(
        steps += 3, 0.1, [] { return std::vector<Kink>(); }, warnings);
  }
  EXPECT_FALSE(density.watches());
  ASSERT_EQ(warnings.items().size(), 1u);
  EXPECT_EQ(warnings.items()[0].code, "dense-events");
  EXPECT_THAT(warnings.items()[0].message, HasSubstr("at time 0.1 functions switch without end"));
  EXPECT_FALSE(density.watch_again(steps + 200));
  EXPECT_TRUE(density.watch_again(steps + 201));
  EXPECT_TRUE(density.watches());
  for (int k = 0; k <= 200; ++k)
    density.note_restart(
        steps += 3, 0.2, [] { return std::vector<Kink>(); }, warnings);
  EXPECT_FALSE(density.watches());
  EXPECT_EQ(warnings.items().size(), 1u);
}

TEST(EventDensity, names_what_has_a_kink_there) {
  EventDensity density;
  Diagnostics warnings;
  const ElementLabel slack{"VARIABLE", 3, "", {}}, other{"SFORCE", 1, "", {}};
  const auto kinks = [&] { return std::vector<Kink>{{&slack, "MAX"}, {&other, "IF"}, {&slack, "STEP"}}; };
  for (int k = 0; k <= 200; ++k) density.note_restart(k, 0.1, kinks, warnings);
  ASSERT_EQ(warnings.items().size(), 1u);
  EXPECT_THAT(warnings.items()[0].message, ::testing::EndsWith("; what has a kink there is SFORCE/1, VARIABLE/3"));
  EXPECT_THAT(warnings.items()[0].hint, HasSubstr("a kink that the motion comes back to"));
}

// What is stated of time alone does not jump to and fro, however its rate is off where it has hardly begun.
TEST(EventDensity, names_no_course_of_a_motion) {
  const ElementLabel drive{"MOTION", 1, "", {}}, controller{"DIFF", 2, "", {}};
  Layout layout;
  layout.velocity_driven = {&drive};
  layout.states.resize(2);
  layout.states[0].owner = &drive, layout.states[1].owner = &controller;
  OperatingPoint behind;
  behind.state_rate = {2e-15, 4};
  EventDensity density;
  Diagnostics warnings;
  density.note_jumps(layout, {}, {1e-15, 3}, behind);
  for (int k = 0; k <= 200; ++k)
    density.note_restart(
        k, 0.1, [] { return std::vector<Kink>(); }, warnings);
  ASSERT_EQ(warnings.items().size(), 1u);
  EXPECT_THAT(warnings.items()[0].message, ::testing::EndsWith("; what jumps to and fro is DIFF/2"));
}

TEST(EventDensity, begins_to_count_anew_after_steps_without_events) {
  EventDensity density;
  Diagnostics warnings;
  std::int64_t steps = 0;
  for (int k = 0; k < 5; ++k) {
    for (int event = 0; event < 150; ++event)
      density.note_restart(
          ++steps, 0.1, [] { return std::vector<Kink>(); }, warnings);
    steps += 21;
  }
  EXPECT_TRUE(density.watches());
  EXPECT_TRUE(warnings.items().empty());
  EXPECT_FALSE(density.watch_again(steps + 10000)) << "they were never passed over";
}

TEST(EventDensity, ends_a_run_where_time_does_not_pass) {
  EventDensity passing;
  for (int k = 0; k < 30000; ++k) ASSERT_TRUE(passing.pass(k * 1e-8, 1.0)) << k;
  EventDensity standing;
  for (int k = 0; k < 10000; ++k) ASSERT_TRUE(standing.pass(0.5 + k * 1e-15, 1.0)) << k;
  const auto failed = standing.pass(0.5, 1.0);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "at time 0.5: 10000 events within a billionth of the run");
}

}  // namespace
}  // namespace dynalin::event_density_test
