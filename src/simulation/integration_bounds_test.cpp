#include "simulation/integration_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dynalin::integration_bounds_test {
namespace {

const OutputTimes times(1, 3, 0.25);

TEST(IntegrationBounds, steps_do_not_pass_over_an_interval_of_output_unless_that_is_asked_for) {
  IntegratorSettings settings;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.largest, 0.25);
  settings.interpolate = true;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.largest, std::nullopt);
  settings.largest_step = 2;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.largest, 2);
}

TEST(IntegrationBounds, a_first_step_is_one_by_which_time_goes_on) {
  IntegratorSettings settings;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.first, std::nullopt);
  settings.first_step = 1e-9;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.first, 1e-9);
  settings.first_step = 1e-300;
  const double first = IntegrationBounds(settings, times).steps.first.value();
  EXPECT_LT(first, 1e-12);
  EXPECT_GT(times.end() - first, times.end() - 2 * first);
}

TEST(IntegrationBounds, errors_of_steps_follow_what_those_of_the_run_may_be) {
  IntegratorSettings settings;
  EXPECT_EQ(IntegrationBounds(settings, times).error, 1e-3);
  settings.error = 1e-4;
  const IntegrationBounds coarse(settings, times);
  EXPECT_EQ(coarse.tolerance.duration, 2);
  EXPECT_EQ(coarse.tolerance.passed_over, 1e-4);
  EXPECT_NEAR(coarse.steps.loosest * coarse.tolerance.relative, 1e-5, 1e-19);
  settings.error = 1e-5;
  const IntegrationBounds fine(settings, times);
  EXPECT_NEAR(coarse.tolerance.relative / fine.tolerance.relative, std::pow(10, 1.2), 1e-12);
  // Within what can be told apart, and what is of use.
  settings.error = 1e-30;
  EXPECT_EQ(IntegrationBounds(settings, times).tolerance.relative, 1e-14);
  EXPECT_EQ(IntegrationBounds(settings, times).tolerance.passed_over, 1e-6);
  EXPECT_EQ(IntegrationBounds(settings, times).steps.loosest, 1);
  settings.error = 1e4;
  EXPECT_EQ(IntegrationBounds(settings, times).tolerance.relative, 1e-3);
  EXPECT_EQ(IntegrationBounds(settings, times).tolerance.passed_over, 1e-3);
}

TEST(IntegrationBounds, orders_and_iterations_stay_within_what_there_is) {
  IntegratorSettings settings;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.largest_order, 5);
  EXPECT_EQ(IntegrationBounds(settings, times).steps.iterations, 4);
  settings.largest_order = 12, settings.iteration_limit = 1000;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.largest_order, 5);
  EXPECT_EQ(IntegrationBounds(settings, times).steps.iterations, 100);
  settings.largest_order = 2, settings.iteration_limit = 0;
  EXPECT_EQ(IntegrationBounds(settings, times).steps.largest_order, 2);
  EXPECT_EQ(IntegrationBounds(settings, times).steps.iterations, 1);
}

}  // namespace
}  // namespace dynalin::integration_bounds_test
