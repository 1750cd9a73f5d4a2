// Why an expression has no finite value or gradient here.
#include <algorithm>
#include <cmath>

#include "mechanics/bound_expression.h"
#include "mechanics/frame_variations.h"

namespace dynalin {

std::string BoundExpression::undefined_in_value(const Motion& motion, const std::vector<double>& values) const {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k])) continue;
    const BoundAtom& a = bound_atoms()[k];
    const bool straight =
        (a.force && a.force->axes_marker.straight(motion)) ||
        std::any_of(a.places.begin(), a.places.end(), [&](const auto& p) { return p.straight(motion); });
    return std::string(expression_.atoms()[k].at.text()) +
           (straight ? " reads the y or z axis of a marker at a point of contact where the curve is straight"
                     : " has no finite value");
  }
  const auto found = expression_.find_undefined<double>(values, UndefinedSearch::value);
  return found ? found->reason : std::string();
}

bool BoundExpression::has_gradient(const BoundAtom& a, const Motion& motion) const {
  const auto finite = [](const auto& partials) {
    return std::all_of(partials.begin(), partials.end(), [](double p) { return std::isfinite(p); });
  };
  for (const CoordinateBlock& block : blocks(a)) {
    const auto gradient_of = [&]<std::size_t N>() {
      return finite(path::varied_measure<N>(a.measure, a.places, motion, block).value.partial);
    };
    const bool defined = a.order == 0   ? gradient_of.operator()<6>()
                         : a.order == 1 ? gradient_of.operator()<12>()
                                        : gradient_of.operator()<18>();
    if (!defined) return false;
  }
  return true;
}

std::string BoundExpression::undefined_in_gradient(const Motion& motion, const std::vector<double>& values,
                                                   Derivatives derivatives) const {
  if (const auto found = expression_.find_undefined<double>(values, UndefinedSearch::value_and_partials))
    return found->reason;
  ExpressionScratch scratch;
  scratch.partials.resize(bound_atoms().size());
  expression_.evaluate<double>(values, std::span(scratch.partials), scratch.plain);
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const BoundAtom& a = bound_atoms()[k];
    const bool vanishes = scratch.partials[k] == 0.0 && passes_over(k, scratch);
    if (vanishes && (derivatives == Derivatives::first || !expression_.reaches(k, scratch.plain))) continue;
    const std::string text(expression_.atoms()[k].at.text());
    if (a.kind == BoundAtom::Kind::measure && !has_gradient(a, motion)) {
      const std::string_view place = place_without_gradient(a.measure);
      return text + " has no derivative " + std::string(place.empty() ? "here" : place);
    }
    if (a.kind == BoundAtom::Kind::force && is_size_of_nothing(a, motion)) {
      return text + " has no derivative where it is 0";
    }
  }
  if (derivatives == Derivatives::first) return {};
  fill_rates(motion, scratch);
  const auto found = expression_.find_undefined<Taylor>(scratch.taylor_atoms, UndefinedSearch::value_and_partials);
  return found ? found->reason : std::string();
}

void BoundExpression::find_undefined(const Motion& motion, const ElementLabel& of, UndefinedValues& found,
                                     Derivatives derivatives) const {
  if (found.length()) return find_kink(motion, *found.length(), of, found, derivatives);
  if (const Lack lack = undefined(motion, derivatives); !lack.reason.empty())
    found.add(UndefinedValue{&of, of.full_text() + ": " + lack.reason, lack.in_value});
}

BoundExpression::Lack BoundExpression::undefined(const Motion& motion, Derivatives derivatives) const {
  std::vector<double> values;
  for (const BoundAtom& a : bound_atoms()) values.push_back(atom_value(a, motion));
  if (std::string reason = undefined_in_value(motion, values); !reason.empty()) return {std::move(reason), true};
  return {undefined_in_gradient(motion, values, derivatives), false};
}

}  // namespace dynalin
