#include "mechanics/motion.h"

#include <numbers>

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

Mat3<Taylor> Motion::axes_along(const MarkerPlace& m) const {
  const BodyMotion& b = body(m.body);
  const Matrix3 R = b.R * m.R_BM, Rdot = b.Rdot * m.R_BM, Rddot = b.Rddot * m.R_BM;
  return {along_motion(R.x, Rdot.x, Rddot.x), along_motion(R.y, Rdot.y, Rddot.y), along_motion(R.z, Rdot.z, Rddot.z)};
}

Vec3<Taylor> Motion::arm(const MarkerPlace& m) const {
  const BodyMotion& b = body(m.body);
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
