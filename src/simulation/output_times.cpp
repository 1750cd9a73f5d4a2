#include "simulation/output_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

OutputTimes::OutputTimes(double start, double end, double step) : start_(start), end_(end), step_(step) {
  // An end that is a whole number of steps away but for rounding is.
  const double intervals = (end - start) / step, nearest = std::round(intervals);
  const bool whole = std::abs(intervals - nearest) <= 1e-9 * std::max(1.0, nearest);
  constexpr double countable = 1e15;  // more than anybody takes, and exact
  count_ =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(whole ? nearest : std::ceil(intervals), countable)));
}

OutputTimes OutputTimes::of_count(double start, double end, std::int64_t steps) {
  OutputTimes times(start, end, (end - start) / static_cast<double>(steps));
  times.count_ = steps;
  return times;
}

std::optional<Failure> OutputTimes::refusal() const {
  constexpr double last_places = 16 * std::numeric_limits<double>::epsilon();
  const std::string which =
      fmt::format("outputs {:g} apart (DTOUT, or DT of a SENSOR) from a time of {:g} to {:g}", step_, start_, end_);
  if (!(step_ > last_places * std::max(std::abs(start_), std::abs(end_))))
    return Failure{"simulation", which + " are the same instant, but for rounding", {}, "outputs-too-close"};
  if (count_ > most) {
    return Failure{"simulation",
                   fmt::format("{} are {:.4g}, and {:.0e} are the most", which, static_cast<double>(count_),
                               static_cast<double>(most)),
                   {},
                   "too-many-outputs"};
  }
  return std::nullopt;
}

double OutputTimes::at(std::int64_t k) const { return k >= count_ ? end_ : start_ + step_ * static_cast<double>(k); }

double OutputTimes::next(double now, double step, std::int64_t k) const {
  constexpr double rounding_of_times = 1e-9;  // of sums of steps
  const double target = at(k), left = target - now;
  if (step >= left * (1 - rounding_of_times)) return target;
  return now + (2 * step > left ? 0.5 * left : step);
}

}  // namespace dynalin
