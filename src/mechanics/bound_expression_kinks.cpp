// Where an expression has another value or slope on either side of the point at which it is linearized.
//
// Its exact value and slopes are compared on both sides, one of its measures moved by next to nothing at a time. What
// is smooth differs the less the nearer the sides are; what jumps or bends differs as much.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "expression/program.h"
#include "mechanics/bound_expression.h"

namespace dynalin {

namespace {

// Two distances of the sides, of the size of what is moved; the nearer one is about what rounding leaves of it.
constexpr double far = 1e-9, near = 1e-12;
// Beside a measure that is zero, of which no size is known; what goes by its square has to be seen.
constexpr double step_from_zero = 1e-100;
constexpr double seen = 1e-6;  // of the larger side

bool differs(double a, double b) { return std::abs(a - b) > seen * std::max(std::abs(a), std::abs(b)); }
// As far away as near, and not because it is rounding.
bool stays(double a_far, double b_far, double a, double b) {
  return differs(a, b) && std::isfinite(a - b) && std::abs(a - b) >= 0.5 * std::abs(a_far - b_far);
}

// That of a root grows with every step towards its corner, where it is infinite; any other has become what it is there.
std::string slope_text(double at_far, double at_near, double on_other_side) {
  constexpr double grown = 1.01;
  const bool rounding = at_far == 0.0 || std::abs(at_near) < seen * std::abs(on_other_side);
  if (!rounding && std::abs(at_near) > grown * std::abs(at_far)) return at_near > 0 ? "infinite" : "-infinite";
  return fmt::format("{:g}", at_near);
}

// A value and its slopes by all measures, beside the point.
struct Side {
  double value = 0;
  std::vector<double> slopes;
};
struct Sides {
  Side below_far, above_far, below, above, at;
};

// Of a function that is moved along one measure by `step` · near, the first slope that is not the same on both sides.
// Each counts by how far its measure goes, as rounding of the function tells: `reach`.
std::string bend(const Sides& s, const std::function<double(std::size_t)>& reach, std::size_t moved,
                 const AtomList& atoms, std::string_view of) {
  for (std::size_t k = 0; k < atoms.size(); ++k) {
    const double a_far = s.below_far.slopes[k], b_far = s.above_far.slopes[k];
    const double a = s.below.slopes[k], b = s.above.slopes[k];
    if (!stays(a_far, b_far, a, b)) continue;
    // What a slope makes of the value along all of what it is a slope by: of a STEP5 that ends, rounding.
    const double all = reach(k);
    if (all > 0 && std::abs(b - a) * all <= near * std::abs(s.below.value)) continue;
    const std::string by = k == moved ? "it" : std::string(atoms[k].at.text());
    return fmt::format("has a kink here: along {} {} by {} changes from {} to {}, and {:g} is taken",
                       atoms[moved].at.text(), of, by, slope_text(a_far, a, b), slope_text(b_far, b, a),
                       s.at.slopes[k]);
  }
  return {};
}

}  // namespace

// Of the measure that is moved, the first thing that is not the same on both sides.
std::string BoundExpression::kink_along(std::size_t moved, double size, std::vector<double>& values,
                                        ExpressionScratch& scratch) const {
  const double x = values[moved], step = size > 0 ? size : step_from_zero;
  const auto side = [&](double by) {
    values[moved] = x + by * step;
    scratch.partials.resize(values.size());
    Side s{expression_.evaluate<double>(values, std::span(scratch.partials), scratch.plain), scratch.partials};
    values[moved] = x;
    return s;
  };
  const Sides s{side(-far), side(far), side(-near), side(near), side(0)};
  // What slopes make of the way between the sides is no jump: the corner is between them, and not at the point.
  const double made_by_slopes = near * step * (std::abs(s.below.slopes[moved]) + std::abs(s.above.slopes[moved]));
  if (stays(s.below_far.value, s.above_far.value, s.below.value, s.above.value) &&
      !(std::abs(s.above.value - s.below.value) <= made_by_slopes))
    return fmt::format("jumps here from {:g} to {:g} with {}", s.below.value, s.above.value,
                       expression_.atoms()[moved].at.text());
  const auto reach = [&](std::size_t k) { return std::abs(values[k]) + (k == moved ? size : 0.0); };
  return bend(s, reach, moved, expression_.atoms(), "its slope");
}

// The same of its time derivative, whose measures and their rates are in `scratch.taylor_atoms`. By the rates it has
// the slopes of the function itself.
std::string BoundExpression::kink_of_rate_along(std::size_t moved, double size, ExpressionScratch& scratch) const {
  std::vector<Taylor>& values = scratch.taylor_atoms;
  const double x = values[moved].value, step = size > 0 ? size : step_from_zero;
  const auto side = [&](double by) {
    values[moved].value = x + by * step;
    scratch.taylor_partials.resize(values.size());
    Side s{expression_.evaluate<Taylor>(values, std::span(scratch.taylor_partials), scratch.taylor).rate, {}};
    for (const Taylor& p : scratch.taylor_partials) s.slopes.push_back(p.rate);
    values[moved].value = x;
    return s;
  };
  const auto reach = [&](std::size_t k) { return std::abs(values[k].value) + (k == moved ? size : 0.0); };
  return bend({side(-far), side(far), side(-near), side(near), side(0)}, reach, moved, expression_.atoms(),
              "the slope of its rate");
}

void BoundExpression::find_kink(const Motion& motion, double length, const ElementLabel& of, UndefinedValues& found,
                                Derivatives derivatives) const {
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
  if (!expression_.has_switches() || !expression_.program().routines().empty()) return;
  const bool with_rates = derivatives == Derivatives::with_rates;
  if (with_rates) fill_rates(motion, scratch);
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const BoundAtom& a = bound_atoms()[k];
    if (a.kind != Kind::measure && a.kind != Kind::channel && a.kind != Kind::force) continue;
    const bool displacement = a.kind == Kind::measure && a.order == 0;
    const double usual = !displacement ? 0.0 : a.measure <= Measure::DM ? length : 1.0;
    const double size = std::max(std::abs(values[k]), usual);
    std::string what = kink_along(k, size, values, scratch);
    if (what.empty() && with_rates) what = kink_of_rate_along(k, size, scratch);
    if (!what.empty()) return add(what);
  }
}

}  // namespace dynalin
