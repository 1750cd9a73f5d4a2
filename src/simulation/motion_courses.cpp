#include "simulation/motion_courses.h"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>

#include "simulation/events.h"
#include "simulation/hidden_crossings.h"

namespace dynalin {

namespace {

using Integrand = std::function<Eigen::VectorXd(double)>;

// ∫ and ∫ |f| by Kronrod's 15 points, and how far Gauss's 7 among them are from it.
struct Integral {
  Eigen::VectorXd value, size, error;
};
Integral kronrod(const Integrand& f, double a, double b) {
  static constexpr std::array<double, 8> node = {
      0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
      0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
      0.586087235467691130294144691693014, 0.405845151377397166906606412076961,
      0.207784955007898467600689403773245, 0.0};
  static constexpr std::array<double, 8> weight = {
      0.022935322010529224963732008058970, 0.063092092629978553290700663189204, 0.104790010322250183839876322541518,
      0.140653259715525918745189590510238, 0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr std::array<double, 4> gauss_weight = {
      0.129484966168869693270611432679082, 0.279705391489276667901467771423780, 0.381830050505118944950369775488975,
      0.417959183673469387755102040816327};
  const double half = 0.5 * (b - a), middle = a + half;
  Eigen::VectorXd value = f(middle);
  Eigen::VectorXd size = weight[7] * value.cwiseAbs(), gauss = gauss_weight[3] * value;
  value *= weight[7];
  for (std::size_t k = 0; k < 7; ++k) {
    const Eigen::VectorXd left = f(middle - half * node[k]), right = f(middle + half * node[k]);
    value += weight[k] * (left + right);
    size += weight[k] * (left.cwiseAbs() + right.cwiseAbs());
    if (k % 2 == 1) gauss += gauss_weight[k / 2] * (left + right);
  }
  return {half * value, std::abs(half) * size, std::abs(half) * (value - gauss).cwiseAbs()};
}

// Halves intervals until all components are exact to a part of their size; a jump is closed in on to rounding.
Eigen::VectorXd integral(const Integrand& f, double a, double b, const Eigen::VectorXd& allowed) {
  constexpr double least_interval = 4;  // roundings of the time
  const Integral whole = kronrod(f, a, b);
  const double middle = a + 0.5 * (b - a);
  const double rounding = std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
  // Where 15 points are so near 7 they are themselves exact to far more.
  const bool exact =
      (whole.error.array() <= 1e-11 * whole.size.array()).all() || (whole.error.array() <= allowed.array()).all();
  if (exact || std::abs(b - a) <= least_interval * rounding || !whole.value.allFinite()) return whole.value;
  return integral(f, a, middle, allowed) + integral(f, middle, b, allowed);
}

// Instants between two others at which functions of time have kinks or jumps, as the ends of a STEP, in their order: 15
// points may all lie beside what happens between two of them.
std::vector<double> switching_times(const System& system, Motion motion, double from, double to) {
  Events events(system);
  const std::size_t n = events.switch_count();
  std::vector<double> all(events.size()), at_from(n), at_to(n), now(n);
  const auto values = [&](double t, std::span<double> of_time) {
    motion.time = t;
    events.values(motion, all);
    std::copy_n(all.begin(), n, of_time.begin());
  };
  values(from, at_from), values(to, at_to);
  HiddenCrossings hidden;
  hidden.begin(at_from);
  std::vector<double> times;
  double last = from;
  while (const auto t = hidden.first(last, to, at_to, values)) times.push_back(last = *t);
  values(last, at_from);
  for (std::size_t k = 0; k < n; ++k) {
    if (!(at_from[k] * at_to[k] < 0)) continue;
    double low = last, high = to;
    for (double t = 0.5 * (low + high); t > low && t < high; t = 0.5 * (low + high)) {
      values(t, now);
      (now[k] * at_from[k] > 0 ? low : high) = t;
    }
    times.push_back(high);
  }
  std::ranges::sort(times);
  return times;
}

// Instants up to which tables of time are as they are expected: of a pulse as well, nothing may be in 15 points.
void add_points_of_tables(const System& system, Motion motion, double from, double to, std::vector<double>& times) {
  constexpr double least_bump = 1e-9;  // of the range of a table
  if (!system.looks_ahead()) return;
  ExpressionScratch scratch;
  Motion end = motion;
  end.time = to, motion.time = from;
  while (true) {
    StepReach reach(least_bump);
    system.look_ahead(motion, end, scratch, reach);
    const double next = motion.time + reach.share() * (to - motion.time);
    if (!(next > motion.time && next < to)) return;
    times.push_back(motion.time = next);
  }
}

}  // namespace

void advance_courses(const System& system, const OperatingPoint& from, OperatingPoint& to) {
  const Layout& layout = system.layout();
  std::vector<const ConstraintRow*> driven;
  for (const ConstraintRow& row : layout.rows) {
    if (row.course >= 0) driven.push_back(&row);
  }
  if (driven.empty()) return;
  const auto count = static_cast<Eigen::Index>(driven.size());
  Motion motion = system.motion(from);
  std::vector<double> rates(layout.states.size(), 0.0);
  // f of each, and (t − τ) f.
  const Integrand f = [&](double t) {
    motion.time = t;
    system.course_rates(motion, rates);
    Eigen::VectorXd y(2 * count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const ConstraintRow& row = *driven[static_cast<std::size_t>(k)];
      y(k) = rates[static_cast<std::size_t>(row.course_rate >= 0 ? row.course_rate : row.course)];
      y(count + k) = (to.time - t) * y(k);
    }
    return y;
  };
  const double h = to.time - from.time;
  const auto [earlier, later] = std::minmax(from.time, to.time);
  std::vector<double> ends = switching_times(system, motion, earlier, later);
  add_points_of_tables(system, motion, earlier, later, ends);
  std::ranges::sort(ends);
  if (to.time < from.time) std::ranges::reverse(ends);
  ends.push_back(to.time);
  Eigen::VectorXd size = Eigen::VectorXd::Zero(2 * count), change = size;
  double begin = from.time;
  for (const double end : ends) {
    size += kronrod(f, begin, end).size;
    begin = end;
  }
  begin = from.time;
  for (const double end : ends) {
    change += integral(f, begin, end, std::numeric_limits<double>::epsilon() * size);
    begin = end;
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const ConstraintRow& row = *driven[static_cast<std::size_t>(k)];
    const auto s = static_cast<std::size_t>(row.course);
    if (row.course_rate < 0) {
      to.state[s] = from.state[s] + change(k);
      continue;
    }
    const auto p = static_cast<std::size_t>(row.course_rate);
    to.state[s] = from.state[s] + h * from.state[p] + change(count + k);
    to.state[p] = from.state[p] + change(k);
  }
}

}  // namespace dynalin
