#include "simulation/prescribed_turning.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

constexpr int instants = 5;      // of a step at which rates are looked at
constexpr int most_rounds = 12;  // to a billionth of what is asked for

}  // namespace

PrescribedTurning::PrescribedTurning(const System& system)
    : system_(system),
      rotates_(static_cast<std::size_t>(system.layout().coordinate_count)),
      rates_(system.layout().states.size()) {
  rows_.resize(system.layout());
  for (std::size_t k = 0; k < system.layout().rows.size(); ++k) {
    if (system.layout().rows[k].prescribed) prescribed_.push_back(k);
  }
  for (const BodyBlock& b : system.layout().bodies) {
    if (b.turns()) std::fill_n(rotates_.begin() + b.offset + 3, 3, true);
  }
}

// Those of the rows that are made of rotations alone.
std::vector<std::size_t> PrescribedTurning::angles() const {
  std::vector<std::size_t> found;
  for (const std::size_t k : prescribed_) {
    if (std::ranges::all_of(rows_.row(static_cast<std::int32_t>(k)),
                            [&](const auto& e) { return e.c.g == 0 || rotates_[static_cast<std::size_t>(e.column)]; }))
      found.push_back(k);
  }
  return found;
}

double PrescribedTurning::step(const OperatingPoint& from, double longest, double most) {
  if (prescribed_.empty() || !(longest > 0)) return longest;
  OperatingPoint still = from;
  std::ranges::fill(still.velocity, 0.0);
  std::ranges::fill(still.acceleration, 0.0);
  Motion motion = system_.motion(still);
  system_.constraints(motion, rows_);
  const std::vector<std::size_t> turning = angles();
  if (turning.empty()) return longest;
  const auto rate_of = [&](std::size_t k, double since) {
    const ConstraintRow& row = system_.layout().rows[k];
    const auto of = [&](std::int32_t state) { return rates_[static_cast<std::size_t>(state)]; };
    if (row.course_rate >= 0)
      return std::abs(from.state[static_cast<std::size_t>(row.course_rate)]) + since * std::abs(of(row.course_rate));
    return std::abs(row.course >= 0 ? of(row.course) : rows_.along_motion(static_cast<std::int32_t>(k)).rate);
  };
  double h = longest;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<double> way(turning.size(), 0.0);
    int within = 0;
    for (; within < instants; ++within) {
      const double since = (within + 0.5) * h / instants;
      motion.time = from.time + since;
      system_.constraints(motion, rows_);
      system_.course_rates(motion, rates_);
      for (std::size_t k = 0; k < turning.size(); ++k) way[k] += h / instants * rate_of(turning[k], since);
      if (!std::isfinite(std::ranges::max(way))) return longest;  // who makes the step says why
      if (std::ranges::max(way) > most) break;
    }
    if (within == instants) return h;
    h *= std::max(within, 1) / static_cast<double>(instants);
  }
  return h;
}

}  // namespace dynalin
