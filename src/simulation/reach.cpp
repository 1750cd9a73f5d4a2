#include "simulation/reach.h"

#include <fmt/format.h>

#include <algorithm>

namespace dynalin {

std::optional<std::string> end_out_of_reach(const OutputTimes& times, const SimulationStep& at) {
  // A million steps a second, which is more than any model lets a computer do, are 10¹² in eleven days.
  constexpr std::int64_t judged_by = 5000;
  constexpr double most = 1e12;
  const std::int64_t steps = at.statistics.steps;
  if (steps < judged_by) return std::nullopt;
  const double done = at.point.time - times.start(), left = times.end() - at.point.time;
  const double length = std::max(done / static_cast<double>(steps), at.statistics.step_size);
  if (left <= most * length) return std::nullopt;
  return fmt::format(
      "the end of the simulation at time {:g} (END or DURATION) is out of reach: {} steps have led to {:.6g}, and "
      "{:.0e} more of {:.2g} each are to go",
      times.end(), steps, at.point.time, left / length, length);
}

}  // namespace dynalin
