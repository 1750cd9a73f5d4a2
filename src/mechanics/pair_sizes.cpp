#include "mechanics/pair_sizes.h"

namespace dynalin {

namespace {

// Laws that do not know the axes of J have no partials by them, and nothing that cancels.
bool is_nothing(const Matrix3& m) { return norm(m.x) == 0 && norm(m.y) == 0 && norm(m.z) == 0; }

}  // namespace

BlockPartials sizes_by(const PairMotion& p, const PairBlock& b, const PairForce& f) {
  const Matrix3 delta = sizes(skew(value(p.delta)));
  const Matrix3 moves = sizes(b.moves), turns = sizes(b.turns);
  const bool translation = b.kind == PairBlock::Kind::translation, modal = b.kind == PairBlock::Kind::modal;
  // Of a load that turns with the axes of J.
  const auto by = [&](const MarkerPartials& at, const Vector& load) {
    const Matrix3 origin = sizes(b.of_J ? at.origin_J : at.origin_I);
    if (translation) return origin;
    const Matrix3& axes = b.of_J ? at.axes_J : at.axes_I;
    Matrix3 of_axes = sizes(axes);
    if (b.of_J && !is_nothing(axes)) of_axes += origin * delta + sizes(skew(load));
    return origin * moves + (modal ? of_axes * turns : of_axes);
  };
  BlockPartials out{by(f.force_on_position, f.force), by(f.torque_on_position, f.torque), {}, {}};
  if (!f.depends_on_velocity) return out;
  out.force_by_rate = by(f.force_on_velocity, {}), out.torque_by_rate = by(f.torque_on_velocity, {});
  return out;
}

}  // namespace dynalin
