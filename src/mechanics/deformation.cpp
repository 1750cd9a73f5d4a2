#include "mechanics/deformation.h"

namespace dynalin {

ModalVariation modal_variation(const Motion& motion, BodyId body, const NodeShapes& shapes, std::size_t k) {
  using T = TimeTaylor<Dual<1>>;
  const auto d = deformation<T>(shapes, [&](std::size_t n) {
    const Taylor q = motion.outside_poses(shapes.first + n);
    T x{Dual<1>(q.value), Dual<1>(q.rate), Dual<1>(q.acceleration)};
    if (n == k) x.value.partial[0] = 1.0;
    return x;
  });
  const auto value = [](const Vec3<T>& v) {
    return Vec3<Taylor>{{v.x.value.value, v.x.rate.value, v.x.acceleration.value},
                        {v.y.value.value, v.y.rate.value, v.y.acceleration.value},
                        {v.z.value.value, v.z.rate.value, v.z.acceleration.value}};
  };
  const auto partial = [](const Vec3<T>& v) {
    const auto of = [](const T& x) { return Taylor(x.value.partial[0], x.rate.partial[0], x.acceleration.partial[0]); };
    return Vec3<Taylor>{of(v.x), of(v.y), of(v.z)};
  };
  // Of a rotation the vector is ½ Σ a × δa over the axes.
  Vec3<Taylor> turns{};
  for (std::size_t c = 0; c < 3; ++c) turns += cross(value(d.turned[c]), partial(d.turned[c])) * 0.5;
  const Mat3<Taylor> R = motion.body(body).axes();
  return {R * partial(d.moved), R * turns};
}

ModalChange modal_change(const Motion& motion, BodyId body, const NodeShapes& shapes, std::size_t k, std::size_t by) {
  using T = Dual<1, Dual<1>>;
  const auto d = deformation<T>(shapes, [&](std::size_t n) {
    T x(motion.outside_poses(shapes.first + n).value);
    if (n == k) x.partial[0].value = 1.0;
    if (n == by) x.value.partial[0] = 1.0;
    return x;
  });
  // The outer part is the derivative by coordinate k, its inner part how that changes.
  const auto derivative = [](const Vec3<T>& v) {
    return Vec3<Dual<1>>{v.x.partial[0], v.y.partial[0], v.z.partial[0]};
  };
  const auto plain = [](const Vec3<T>& v) { return Vec3<Dual<1>>{v.x.value, v.y.value, v.z.value}; };
  const auto change = [](const Vec3<Dual<1>>& v) { return Vector{v.x.partial[0], v.y.partial[0], v.z.partial[0]}; };
  Vec3<Dual<1>> turns{};
  for (std::size_t c = 0; c < 3; ++c) turns += cross(plain(d.turned[c]), derivative(d.turned[c])) * 0.5;
  const Matrix3& R = motion.body(body).R;
  return {R * change(derivative(d.moved)), R * change(turns)};
}

}  // namespace dynalin
