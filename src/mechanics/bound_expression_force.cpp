// Forces and reactions that an expression reads, and what they depend on.
#include <cmath>
#include <limits>

#include "mechanics/bound_expression.h"
#include "mechanics/frame_variations.h"
#include "mechanics/marker_references.h"
#include "mechanics/pair_blocks.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

namespace {

LoadPart part_of(std::uint8_t component) { return component > 4 ? LoadPart::torque : LoadPart::force; }
bool is_magnitude(std::uint8_t component) { return component == 1 || component == 5; }
std::size_t axis_of(std::uint8_t component) { return (component - 2u) % 4u; }

}  // namespace

double BoundExpression::force_value(const BoundAtom& a, const Motion& motion) const {
  const Force& of = *a.force;
  Vector sum{};
  MarkerWrench w;
  for (const ForceTerm& t : of.terms) {
    w.clear();
    t.wrench.source->wrench(motion, t.wrench.which, Partials::no, w);
    sum += on_marker(w, t.on_J, part_of(of.component));
  }
  if (is_magnitude(of.component)) return norm(sum);
  return dot(of.axes_marker.axes(motion)[axis_of(of.component)], sum);
}

bool BoundExpression::is_size(const BoundAtom& a) {
  if (a.kind == BoundAtom::Kind::force) return is_magnitude(a.force->component);
  return a.kind == BoundAtom::Kind::measure &&
         (a.measure == Measure::DM || a.measure == Measure::VM || a.measure == Measure::WM ||
          a.measure == Measure::ACCM || a.measure == Measure::WDTM);
}

bool BoundExpression::is_size_of_nothing(const BoundAtom& a, const Motion& motion) const {
  return is_magnitude(a.force->component) && force_value(a, motion) == 0.0;
}

void BoundExpression::add_force(const BoundAtom& a, const Motion& motion, const IntoEquation& into,
                                double factor) const {
  Equations& eq = into.eq;
  const std::int32_t row = into.row;
  const Force& of = *a.force;
  const LoadPart part = part_of(of.component);
  const bool torque = part == LoadPart::torque;
  std::vector<MarkerWrench> wrenches(of.terms.size());
  Vector sum{};
  double terms = 0;  // in size: a component that is next to nothing is added up from them as well
  for (std::size_t t = 0; t < of.terms.size(); ++t) {
    const ForceTerm& term = of.terms[t];
    MarkerWrench& w = wrenches[t];
    term.wrench.source->wrench(motion, term.wrench.which, Partials::yes, w);
    sum += on_marker(w, term.on_J, part);
    terms += norm(torque ? w.force.torque : w.force.force);
    if (torque && term.on_J) terms += norm(dynalin::value(w.pair.delta)) * norm(w.force.force);
  }
  eq.add_residual(row, 0.0, std::abs(factor) * terms);
  // The direction that picks the component: an axis of the marker, or that of the vector itself.
  Vector e{};
  if (is_magnitude(of.component)) {
    const double size = norm(sum);
    if (size > 0) e = sum / size;
  } else {
    e = of.axes_marker.axes(motion)[axis_of(of.component)];
    const Vector turn = cross(e, sum);
    for_each_turning_block(
        motion, of.axes_marker.place(), eq.layout(), [&](std::int32_t column, std::size_t count, const Matrix3& turns) {
          for (std::size_t k = 0; k < count; ++k)
            eq.add(PartialBy::position, row, column + static_cast<std::int32_t>(k), factor * dot(turns[k], turn));
        });
    for (const CoordinateBlock& block : blocks(a)) {
      const auto axes = path::varied_frame<6>(motion, of.axes_marker, block, of.axes_marker.place().body).axes;
      const auto& axis = axes[axis_of(of.component)];
      const Vector slope{axis.x.value.partial[0], axis.y.value.partial[0], axis.z.value.partial[0]};
      eq.add(PartialBy::position, row, block.column, factor * dot(slope, sum));
    }
  }

  // The size of no force has a kink: what changes the force changes it in no defined way.
  const bool kink = is_magnitude(of.component) && factor != 0.0 && norm(sum) == 0.0;
  for (std::size_t t = 0; t < of.terms.size(); ++t) {
    const MarkerWrench& w = wrenches[t];
    const PairMotion& p = w.pair;
    const bool on_J = of.terms[t].on_J;
    if (on_J && !w.force.acts_on_J()) continue;
    const Vector delta = dynalin::value(p.delta);
    // e·(vector of interest) in terms of force and torque on I.
    const auto picked = [&](const Vector& f, const Vector& m) {
      if (kink) {
        const Vector change = !torque ? f : on_J ? m + cross(delta, f) : m;
        return norm(change) == 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
      }
      if (!torque) return on_J ? -dot(e, f) : dot(e, f);
      return on_J ? -dot(e, m) - dot(e, cross(delta, f)) : dot(e, m);
    };
    for_each_block(p, eq.layout(), [&](const PairBlock& block) {
      const BlockPartials on = partials_by(block, w.force);
      for (std::size_t k = 0; k < block.count; ++k) {
        const std::int32_t column = block.column + static_cast<std::int32_t>(k);
        double value = picked(on.force[k], on.torque[k]);
        if (torque && on_J && !w.J_follows_I) {
          const Vector lever = cross(block.of_J ? -block.moves[k] : block.moves[k], w.force.force);
          value -= kink && norm(lever) != 0.0 ? std::numeric_limits<double>::quiet_NaN() : dot(e, lever);
        }
        eq.add(PartialBy::position, row, column, factor * value);
        eq.add(into.velocity_family, row, column, factor * picked(on.force_by_rate[k], on.torque_by_rate[k]));
      }
    });
    for (const MarkerWrench::Scalar& s : w.scalars) {
      const PartialBy family = s.family == PartialBy::damping ? into.velocity_family : s.family;
      eq.add(family, row, s.column, factor * picked(s.force, s.torque));
    }
    for (const MarkerWrench::Turn& turn : w.turns) {
      for_each_turning_block(
          motion, *turn.axes, eq.layout(), [&](std::int32_t column, std::size_t count, const Matrix3& turns) {
            const Matrix3 F = turn.force * turns, T = turn.torque * turns;
            for (std::size_t k = 0; k < count; ++k)
              eq.add(PartialBy::position, row, column + static_cast<std::int32_t>(k), factor * picked(F[k], T[k]));
          });
    }
  }
}

}  // namespace dynalin
