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
  const auto of = [turned](const Matrix3& m) {
    if (!turned) return sizes(m);
    const double size = largest(m);
    const Vector column{size, size, size};
    return Matrix3{column, column, column};
  };
  const Matrix3 delta = sizes(skew(value(p.delta))), moves = sizes(b.moves), turns = sizes(b.turns);
  const bool translation = b.kind == PairBlock::Kind::translation, modal = b.kind == PairBlock::Kind::modal;
  // Of a load that turns with the axes of J.
  const auto by = [&](const MarkerPartials& at, const Vector& load) {
    const Matrix3 origin = of(b.of_J ? at.origin_J : at.origin_I);
    if (translation) return origin;
    Matrix3 axes = of(b.of_J ? at.axes_J : at.axes_I);
    // Laws that do not know the axes of J have no partials by them, and nothing that cancels.
    if (b.of_J && largest(axes) > 0) axes += origin * delta + sizes(skew(load));
    return origin * moves + (modal ? axes * turns : axes);
  };
  BlockPartials out{by(f.force_on_position, f.force), by(f.torque_on_position, f.torque), {}, {}};
  if (!f.depends_on_velocity) return out;
  out.force_by_rate = by(f.force_on_velocity, {}), out.torque_by_rate = by(f.torque_on_velocity, {});
  return out;
}

}  // namespace dynalin
