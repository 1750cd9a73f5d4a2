#include "simulation/prescribed_turning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/motion_courses.h"
#include "system/row_terms.h"

namespace dynalin {

namespace {

constexpr int instants = 5;      // of a step at which rates are looked at
constexpr int most_rounds = 12;  // to a billionth of what is asked for
constexpr double enough = 0.5;   // of what a step may turn: none is sought that turns farther

double farthest(const std::vector<double>& from, const std::vector<double>& to) {
  double most = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const double way = std::abs(to[k] - from[k]);
    if (std::isnan(way)) return way;
    most = std::max(most, way);
  }
  return most;
}

}  // namespace

PrescribedTurning::PrescribedTurning(const System& system) : system_(system), rates_(system.layout().states.size()) {
  rows_.resize(system.layout());
  for (std::size_t k = 0; k < system.layout().rows.size(); ++k) {
    if (system.layout().rows[k].prescribed) turning_.push_back(k);
  }
  if (turning_.empty()) return;
  const std::vector<RowTerms> terms = row_terms(system, system.motion(system.drawn()));
  std::erase_if(turning_, [&](std::size_t k) { return !terms[k].driven_angle; });
}

double PrescribedTurning::step(const OperatingPoint& from, double longest, double most) {
  if (turning_.empty() || !(longest > 0)) return longest;
  return step_by_ends(from, step_by_rates(from, longest, most), most);
}

std::vector<double> PrescribedTurning::angles(const OperatingPoint& from, double since) {
  OperatingPoint at = from;
  at.time += since;
  if (since > 0) advance_courses(system_, from, at);
  const std::vector<RowTerms> terms = row_terms(system_, system_.motion(at));
  std::vector<double> found;
  for (const std::size_t k : turning_) found.push_back(*terms[k].driven_angle);
  return found;
}

double PrescribedTurning::step_by_ends(const OperatingPoint& from, double longest, double most) {
  const double least = 4 * std::numeric_limits<double>::epsilon() * (std::abs(from.time) + longest);
  const std::vector<double> end = angles(from, longest);
  std::vector<double> begin = angles(from, 0), at_near = begin;
  double near = 0;
  while (true) {
    const double whole = farthest(begin, end);
    if (whole <= most || !std::isfinite(whole)) return longest;  // who makes the step says what is no number
    double far = longest;
    std::vector<double> at_far = end;
    while (far - near > least) {
      const double middle = near + 0.5 * (far - near);
      std::vector<double> at_middle = angles(from, middle);
      const double way = farthest(begin, at_middle);
      if (way <= most && way >= enough * most) return middle;
      (way <= most ? near : far) = middle;
      (way <= most ? at_near : at_far) = std::move(at_middle);
    }
    // A jump: turning is told from where it would have begun on its other side.
    for (std::size_t k = 0; k < begin.size(); ++k) begin[k] += at_far[k] - at_near[k];
    if (far >= longest) return longest;
    near = far, at_near = std::move(at_far);
  }
}

double PrescribedTurning::step_by_rates(const OperatingPoint& from, double longest, double most) {
  OperatingPoint still = from;
  std::ranges::fill(still.velocity, 0.0);
  std::ranges::fill(still.acceleration, 0.0);
  Motion motion = system_.motion(still);
  const auto rate_of = [&](std::size_t k, double since) {
    const ConstraintRow& row = system_.layout().rows[k];
    const auto of = [&](std::int32_t state) { return rates_[static_cast<std::size_t>(state)]; };
    if (row.course_rate >= 0)
      return std::abs(from.state[static_cast<std::size_t>(row.course_rate)]) + since * std::abs(of(row.course_rate));
    return std::abs(row.course >= 0 ? of(row.course) : rows_.along_motion(static_cast<std::int32_t>(k)).rate);
  };
  double h = longest;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<double> way(turning_.size(), 0.0);
    int within = 0;
    for (; within < instants; ++within) {
      const double since = (within + 0.5) * h / instants;
      motion.time = from.time + since;
      system_.constraints(motion, rows_);
      system_.course_rates(motion, rates_);
      for (std::size_t k = 0; k < turning_.size(); ++k) way[k] += h / instants * rate_of(turning_[k], since);
      if (!std::isfinite(std::ranges::max(way))) return longest;  // who makes the step says why
      if (std::ranges::max(way) > most) break;
    }
    if (within == instants) return h;
    h *= std::max(within, 1) / static_cast<double>(instants);
  }
  return h;
}

}  // namespace dynalin
