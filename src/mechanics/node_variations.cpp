#include "mechanics/node_variations.h"

#include <algorithm>

namespace dynalin {

namespace {

Vec3<Taylor> rotation_vector(const Motion& motion, const NodeShapes& shapes) {
  Vec3<Taylor> a{};
  for (std::size_t k = 0; k < shapes.rotation.size(); ++k)
    a += motion.outside_poses(shapes.first + k) * shapes.rotation[k];
  return a;
}

}  // namespace

NodeVariations::NodeVariations(const Motion& motion, BodyId body, const NodeShapes& shapes)
    : shapes_(&shapes), axes_(motion.body(body).axes()) {
  using T = TimeTaylor<Dual<3>>;
  const Vec3<Taylor> a = rotation_vector(motion, shapes);
  Vec3<T> varied;
  for (std::size_t j = 0; j < 3; ++j) {
    varied[j] = {Dual<3>(a[j].value), Dual<3>(a[j].rate), Dual<3>(a[j].acceleration)};
    varied[j].value.partial[j] = 1;
  }
  const Mat3<T> Q = rotation_by(varied);
  const Vec3<T> offset = Q * shapes.offset;
  const auto plain = [](const Vec3<T>& v) {
    const auto of = [](const T& x) { return Taylor(x.value.value, x.rate.value, x.acceleration.value); };
    return Vec3<Taylor>{of(v.x), of(v.y), of(v.z)};
  };
  for (std::size_t j = 0; j < 3; ++j) {
    const auto partial = [&](const Vec3<T>& v) {
      const auto of = [&](const T& x) {
        return Taylor(x.value.partial[j], x.rate.partial[j], x.acceleration.partial[j]);
      };
      return Vec3<Taylor>{of(v.x), of(v.y), of(v.z)};
    };
    // The spin of a rotation is ½ Σ e × δe over its axes.
    Vec3<Taylor> spin{};
    for (std::size_t c = 0; c < 3; ++c) spin += cross(plain(Q[c]), partial(Q[c])) * 0.5;
    moves_[j] = axes_ * partial(offset);
    turns_[j] = axes_ * spin;
  }
}

NodeVariations::One NodeVariations::by(std::size_t k) const {
  const Vector &translation = shapes_->translation[k], &rotation = shapes_->rotation[k];
  return {axes_ * translation + moves_ * rotation, turns_ * rotation};
}

ModalWork NodeVariations::work(const Vector& force, const Vector& torque) const {
  return {transpose_times(value(axes_), force),
          transpose_times(value(moves_), force) + transpose_times(value(turns_), torque)};
}

Matrix3 change_of_work(const Motion& motion, BodyId body, const NodeShapes& shapes, const Vector& force,
                       const Vector& torque) {
  using T = Dual<3, Dual<3>>;
  const Vec3<Taylor> a = rotation_vector(motion, shapes);
  Vec3<T> varied;
  for (std::size_t j = 0; j < 3; ++j) {
    varied[j] = T(a[j].value);
    varied[j].partial[j].value = 1, varied[j].value.partial[j] = 1;
  }
  const Mat3<T> Q = rotation_by(varied);
  const Vec3<T> offset = Q * shapes.offset;
  // The outer part is the derivative by the component of row r, its inner one how that changes with that of column c.
  const Matrix3& A = motion.body(body).R;
  const Vector F = transpose_times(A, force), torque_on_body = transpose_times(A, torque);
  Matrix3 S;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto plain = [](const Vec3<T>& v) { return Vec3<Dual<3>>{v.x.value, v.y.value, v.z.value}; };
    const auto partial = [&](const Vec3<T>& v) {
      return Vec3<Dual<3>>{v.x.partial[r], v.y.partial[r], v.z.partial[r]};
    };
    Vec3<Dual<3>> spin{};
    for (std::size_t axis = 0; axis < 3; ++axis) spin += cross(plain(Q[axis]), partial(Q[axis])) * 0.5;
    const Dual<3> work = dot(partial(offset), F) + dot(spin, torque_on_body);
    for (std::size_t c = 0; c < 3; ++c) S(r, c) = work.partial[c];
  }
  return S;
}

void add_modal_rows(PartialBy family, std::int32_t column, const NodeShapes& shapes, const ModalWork& work,
                    double factor, Equations& eq) {
  std::array<double, 32> run;
  const std::size_t count = shapes.translation.size();
  const std::int32_t first_row = eq.layout().body_coordinate_count + static_cast<std::int32_t>(shapes.first);
  for (std::size_t first = 0; first < count; first += run.size()) {
    const std::size_t size = std::min(run.size(), count - first);
    for (std::size_t k = 0; k < size; ++k) run[k] = factor * work.of(shapes, first + k);
    eq.add(family, first_row + static_cast<std::int32_t>(first), column, {run.data(), size});
  }
}

}  // namespace dynalin
