#include "simulation/integration_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dynalin {

namespace {

constexpr double default_error = 1e-3;
// What the error of a step may be. A step of order 5 and length h has an error like h⁶, a run of some periods one like
// h⁵: for that to be in proportion to ERROR, and below it, steps are held to this part of ERROR^1.2.
constexpr double part_of_error = 5e-4, power_of_error = 1.2;
constexpr double largest_part_of_error = 0.1;  // in a step, of what rounding leaves no more exact
// Of the range of a table, what steps may pass over: ERROR within these.
constexpr double least_passed_over = 1e-6, most_passed_over = 1e-3;

// What a step may be off, as a part of the model's length.
double error_of_step(const IntegratorSettings& settings) {
  return std::clamp(part_of_error * std::pow(settings.error.value_or(default_error), power_of_error), 1e-14, 1e-3);
}

}  // namespace

IntegrationBounds::IntegrationBounds(const IntegratorSettings& settings, const OutputTimes& times)
    : error(settings.error.value_or(default_error)) {
  tolerance.relative = error_of_step(settings);
  tolerance.duration = times.end() - times.start();
  tolerance.passed_over = std::clamp(error, least_passed_over, most_passed_over);
  steps.loosest = std::max(1.0, largest_part_of_error * error / tolerance.relative);
  // As short as it may be stated, time has to go on by it.
  constexpr double told_apart = 1e3 * std::numeric_limits<double>::epsilon();
  if (settings.first_step) {
    steps.first = std::max(*settings.first_step, told_apart * std::max(std::abs(times.start()), std::abs(times.end())));
  }
  steps.least = settings.least_step;
  steps.largest_order = static_cast<int>(std::clamp<std::int64_t>(settings.largest_order.value_or(5), 1, 5));
  steps.iterations =
      static_cast<int>(std::clamp<std::int64_t>(settings.iteration_limit.value_or(steps.iterations), 1, 100));
  // Unless it says so, the integration does not pass over a whole interval of output.
  steps.largest = settings.largest_step;
  if (!steps.largest && !settings.interpolate.value_or(false)) steps.largest = times.step();
}

}  // namespace dynalin
