#include "mechanics/motion.h"

#include <numbers>

#include "mechanics/deformation.h"

namespace dynalin {

namespace {
Matrix3 cross_columns(const Vector& a, const Matrix3& m) { return {cross(a, m.x), cross(a, m.y), cross(a, m.z)}; }
}  // namespace

void BodyMotion::set(const Pose& pose, const Vector& v, const Vector& omega, const Vector& a, const Vector& alpha) {
  r = pose.r, rdot = v, rddot = a;
  w = omega, wdot = alpha;
  R = pose.R;
  Rdot = cross_columns(omega, R);
  Rddot = cross_columns(alpha, R) + cross_columns(omega, Rdot);
}

Mat3<Taylor> BodyMotion::axes() const {
  return {along_motion(R.x, Rdot.x, Rddot.x), along_motion(R.y, Rdot.y, Rddot.y), along_motion(R.z, Rdot.z, Rddot.z)};
}

namespace {
template <class T>
Deformation<T> deformed(const Motion& motion, const NodeShapes& shapes) {
  return deformation<T>(shapes, [&](std::size_t k) {
    const Taylor q = motion.outside_poses(shapes.first + k);
    if constexpr (std::is_same_v<T, double>)
      return q.value;
    else
      return q;
  });
}
}  // namespace

Vector Motion::origin_on_body(const MarkerPlace& m) const { return m.p_BM + deformed<double>(*this, *m.shapes).moved; }
Matrix3 Motion::axes_on_body(const MarkerPlace& m) const { return deformed<double>(*this, *m.shapes).turned * m.R_BM; }

Mat3<Taylor> Motion::axes_along(const MarkerPlace& m) const {
  const BodyMotion& b = body(m.body);
  if (m.shapes) return b.axes() * (deformed<Taylor>(*this, *m.shapes).turned * m.R_BM);
  const Matrix3 R = b.R * m.R_BM, Rdot = b.Rdot * m.R_BM, Rddot = b.Rddot * m.R_BM;
  return {along_motion(R.x, Rdot.x, Rddot.x), along_motion(R.y, Rdot.y, Rddot.y), along_motion(R.z, Rdot.z, Rddot.z)};
}

Vec3<Taylor> Motion::arm(const MarkerPlace& m) const {
  const BodyMotion& b = body(m.body);
  if (m.shapes) return b.axes() * (m.p_BM + deformed<Taylor>(*this, *m.shapes).moved);
  return along_motion(b.R * m.p_BM, b.Rdot * m.p_BM, b.Rddot * m.p_BM);
}

Frame<Taylor> Motion::frame(const MarkerPlace& m, BodyId from) const {
  const BodyMotion &b = body(m.body), &f = body(from);
  return {along_motion(b.r - f.r, b.rdot - f.rdot, b.rddot - f.rddot) + arm(m), axes_along(m)};
}

double unwrapped(double principal, double remembered) {
  return remembered + std::remainder(principal - remembered, 2.0 * std::numbers::pi);
}

}  // namespace dynalin
