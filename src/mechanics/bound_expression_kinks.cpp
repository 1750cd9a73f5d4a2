// Where an expression has another value or slope on either side of the point at which it is linearized.
//
// Its exact value and slopes are compared on both sides, one of its measures moved by next to nothing at a time. What
// is smooth differs the less the nearer the sides are; what jumps or bends differs as much.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "expression/program.h"
#include "mechanics/bound_expression.h"

namespace dynalin {

namespace {

// Two distances of the sides, of the size of what is moved; the nearer one is about what rounding leaves of it.
constexpr double far = 1e-9, near = 1e-12;
constexpr double step_from_zero = 1e-150;  // beside a measure that is zero, of which no size is known
constexpr double seen = 1e-6;              // of the larger side

bool differs(double a, double b) { return std::abs(a - b) > seen * std::max(std::abs(a), std::abs(b)); }
// As far away as near, and not because it is rounding.
bool stays(double a_far, double b_far, double a, double b) {
  return differs(a, b) && std::isfinite(a - b) && std::abs(a - b) >= 0.5 * std::abs(a_far - b_far);
}

}  // namespace

// Of the measure that is moved, the first thing that is not the same on both sides.
std::string BoundExpression::kink_along(std::size_t moved, double size, std::vector<double>& values,
                                        ExpressionScratch& scratch) const {
  struct Side {
    double value;
    std::vector<double> slopes;
  };
  const double x = values[moved];
  const auto side = [&](double by) {
    values[moved] = x + by;
    scratch.partials.resize(values.size());
    Side s{expression_.evaluate<double>(values, std::span(scratch.partials), scratch.plain), scratch.partials};
    values[moved] = x;
    return s;
  };
  const double step = size > 0 ? size : step_from_zero;
  const Side below_far = side(-far * step), above_far = side(far * step);
  const Side below = side(-near * step), above = side(near * step);
  const std::string name(expression_.atoms()[moved].at.text());
  // What slopes make of the way between the sides is no jump: the corner is between them, and not at the point.
  const double made_by_slopes = near * step * (std::abs(below.slopes[moved]) + std::abs(above.slopes[moved]));
  if (stays(below_far.value, above_far.value, below.value, above.value) &&
      !(std::abs(above.value - below.value) <= made_by_slopes))
    return fmt::format("jumps here from {:g} to {:g} with {}", below.value, above.value, name);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!stays(below_far.slopes[k], above_far.slopes[k], below.slopes[k], above.slopes[k])) continue;
    // What a slope makes of the value along all of what it is a slope by: of a STEP5 that ends, rounding.
    const double reach = std::abs(values[k]) + (k == moved ? size : 0.0);
    if (reach > 0 && std::abs(above.slopes[k] - below.slopes[k]) * reach <= near * std::abs(below.value)) continue;
    const Side at = side(0);
    const std::string by = k == moved ? "it" : std::string(expression_.atoms()[k].at.text());
    return fmt::format("has a kink here: along {} its slope by {} changes from {:g} to {:g}, and {:g} is taken", name,
                       by, below.slopes[k], above.slopes[k], at.slopes[k]);
  }
  return {};
}

void BoundExpression::find_kink(const Motion& motion, double length, const ElementLabel& of,
                                UndefinedValues& found) const {
  using Kind = BoundAtom::Kind;
  std::vector<double> values;
  for (const BoundAtom& a : bound_atoms()) values.push_back(atom_value(a, motion));
  ExpressionScratch scratch;
  scratch.partials.resize(bound_atoms().size());
  const auto add = [&](const std::string& what) {
    constexpr std::size_t told = 100;  // bytes
    found.add(Kink{&of, fmt::format("{} of {} {}", on_one_line(expression_.at(), told), of.full_text(), what)});
  };
  // The size of a vector that is zero grows whichever way it moves.
  expression_.evaluate<double>(values, std::span(scratch.partials), scratch.plain);
  const auto add_size = [&](const Span& size) {
    add(fmt::format("has a kink here: {} is 0 and grows whichever way it moves, and its slope is taken as 0",
                    size.text()));
  };
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const double slope = scratch.partials[k];
    if (!is_size(bound_atoms()[k]) || values[k] != 0.0 || slope == 0.0) continue;
    return add_size(expression_.atoms()[k].at);
  }
  if (const auto size = expression_.size_of_nothing(scratch.plain)) return add_size(*size);
  // Those of routines are their own.
  if (!expression_.has_switches() || !expression_.program().routines.empty()) return;
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const BoundAtom& a = bound_atoms()[k];
    if (a.kind != Kind::measure && a.kind != Kind::channel && a.kind != Kind::force) continue;
    const bool displacement = a.kind == Kind::measure && a.order == 0;
    const double usual = !displacement ? 0.0 : a.measure <= Measure::DM ? length : 1.0;
    const std::string what = kink_along(k, std::max(std::abs(values[k]), usual), values, scratch);
    if (!what.empty()) return add(what);
  }
}

}  // namespace dynalin
