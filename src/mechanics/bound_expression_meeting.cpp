// What an expression is at a point where two markers meet.
#include <algorithm>
#include <cmath>

#include "mechanics/bound_expression.h"

namespace dynalin {

namespace {

bool is_same_point(const MarkerPlace& a, const MarkerPlace& b) {
  const auto same = [&](std::size_t c) { return a.p_BM[c] == b.p_BM[c]; };
  return &a == &b || (a.body == b.body && !a.shapes && !b.shapes && same(0) && same(1) && same(2));
}

}  // namespace

bool BoundExpression::reads_forces() const {
  return std::ranges::any_of(bound_atoms(), [](const BoundAtom& a) { return a.kind == BoundAtom::Kind::force; });
}

AtMeeting BoundExpression::where_they_meet(const Motion& motion, ExpressionScratch& scratch, const MarkerPlace& I,
                                           const MarkerPlace& J) const {
  using Kind = BoundAtom::Kind;
  using Others = AtMeeting::Others;
  const std::span<const BoundAtom> atoms = bound_atoms();
  AtMeeting at;
  at.value = value(motion, scratch);
  const std::span<const double> slopes = partials(motion, scratch);
  const auto is_distance = [&](const BoundAtom& a) {
    if (a.kind != Kind::measure || a.measure != Measure::DM || a.places[0].curve || a.places[1].curve) return false;
    const MarkerPlace &from = a.places[1].place(), &to = a.places[0].place();
    return (is_same_point(to, I) && is_same_point(from, J)) || (is_same_point(to, J) && is_same_point(from, I));
  };
  for (std::size_t k = 0; k < atoms.size(); ++k) {
    const BoundAtom& a = atoms[k];
    const double slope = slopes[k];
    const bool varies = a.kind == Kind::channel || a.kind == Kind::measure || a.kind == Kind::force;
    if (!varies || (slope == 0.0 && passes_over(k, scratch))) continue;
    if (std::isfinite(slope) && is_distance(a)) {
      at.by_distance += slope;
      continue;
    }
    const bool grows = is_size(a) && atom_value(a, motion) == 0.0;
    const bool defined = std::isfinite(slope) && !grows && (a.kind != Kind::measure || has_gradient(a, motion));
    at.others = std::max(at.others, defined ? Others::defined : Others::undefined);
  }
  return at;
}

}  // namespace dynalin
