#include "mechanics/pair_sizes.h"

namespace dynalin {

namespace {

// A product with such axes rounds nothing.
bool is_along_the_ground(const Matrix3& axes) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double size = std::abs(axes(r, c));
      if (size != 0 && size != 1) return false;
    }
  }
  return true;
}

}  // namespace

BlockPartials sizes_by(const PairMotion& p, const PairBlock& b, const PairForce& f) {
  const bool turned = !is_along_the_ground(value(p.axes_J));
  const auto all = [](double size) { return Matrix3{{size, size, size}, {size, size, size}, {size, size, size}}; };
  const auto of = [&](const Matrix3& m) { return turned ? all(largest(m)) : sizes(m); };
  // Of a torque that is a sum of forces at arms. What is zero has nothing in it that was to cancel.
  const auto of_torque = [&](const Matrix3& m, double cancelled) {
    Matrix3 size = of(m);
    if (cancelled == 0) return size;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t r = 0; r < 3; ++r) {
        if (size(r, c) != 0) size(r, c) = std::max(size(r, c), cancelled);
      }
    }
    return size;
  };
  const Matrix3 delta = sizes(skew(value(p.delta))), moves = sizes(b.moves), turns = sizes(b.turns);
  const bool translation = b.kind == PairBlock::Kind::translation, modal = b.kind == PairBlock::Kind::modal;
  // Of a load that turns with the axes of J.
  const auto combined = [&](const Matrix3& origin, Matrix3 axes, const Vector& load) {
    if (translation) return origin;
    // Laws that do not know the axes of J have no partials by them, and nothing that cancels.
    if (b.of_J && largest(axes) > 0) axes += origin * delta + sizes(skew(load));
    return origin * moves + (modal ? axes * turns : axes);
  };
  const auto force_by = [&](const MarkerPartials& at, const Vector& load) {
    return combined(of(b.of_J ? at.origin_J : at.origin_I), of(b.of_J ? at.axes_J : at.axes_I), load);
  };
  // δ(ρ × F) = ρ × δF + δρ × F
  const auto torque_by = [&](const MarkerPartials& force, const MarkerPartials& at, const Vector& load, double moved) {
    const double arm = f.levers.arm;
    const auto by = [&](const Matrix3& of_force, const Matrix3& torque, double moves_by) {
      return of_torque(torque, arm == 0 ? 0 : arm * largest(of_force) + moved * moves_by);
    };
    return combined(by(b.of_J ? force.origin_J : force.origin_I, b.of_J ? at.origin_J : at.origin_I, 1),
                    by(b.of_J ? force.axes_J : force.axes_I, b.of_J ? at.axes_J : at.axes_I, arm), load);
  };
  BlockPartials out{force_by(f.force_on_position, f.force),
                    torque_by(f.force_on_position, f.torque_on_position, f.torque, f.levers.force),
                    {},
                    {}};
  if (!f.depends_on_velocity) return out;
  out.force_by_rate = force_by(f.force_on_velocity, {});
  out.torque_by_rate = torque_by(f.force_on_velocity, f.torque_on_velocity, {}, 0);
  return out;
}

}  // namespace dynalin
