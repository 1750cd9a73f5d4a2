// Where an expression finds a marker: at its place on its body, or at a point of contact that a curve parameter moves
// along the curve that the marker carries.
#pragma once

#include <cstddef>
#include <cstdint>

#include "expression/parametric_curve.h"
#include "mechanics/deformation.h"

namespace dynalin {

struct MarkerFrame {
  const MarkerPlace* fixed = nullptr;  // of the layout
  const ParametricCurve* curve = nullptr;
  std::int32_t parameter = -1;  // among the coordinates
  std::uint32_t extra = 0;      // and among those in Motion::extra

  const MarkerPlace& place() const { return *fixed; }
  // The frame at parameter u of the curve carried by `carrier`.
  template <class T>
  Frame<T> on_curve(const Frame<T>& carrier, const T& u) const {
    const Frame<T> local = curve->frame(u);
    return {carrier.origin + carrier.axes * local.origin, carrier.axes * local.axes};
  }
  // The frame in the BCS by the motion of its node, if the body changes its shape, and by the curve parameter u.
  template <class T>
  Frame<T> on_body(const NodeMotion<T>& node, const T& u) const {
    const auto constant = [](const Vector& v) { return Vec3<T>{T(v.x), T(v.y), T(v.z)}; };
    Frame<T> f{constant(place().p_BM), {constant(place().R_BM.x), constant(place().R_BM.y), constant(place().R_BM.z)}};
    if (place().shapes) {
      const Deformation<T> d = deformation(*place().shapes, node);
      f = {f.origin + d.moved, d.turned * f.axes};
    }
    return curve ? on_curve(f, u) : f;
  }
  Taylor along_motion(const Motion& motion) const {
    return {motion.extra[extra], motion.extra_rate[extra], motion.extra_acceleration[extra]};
  }
  // Its origin from that of `from`'s BCS.
  Frame<Taylor> frame(const Motion& motion, BodyId from) const {
    const Frame<Taylor> carrier = motion.frame(*fixed, from);
    return curve ? on_curve(carrier, along_motion(motion)) : carrier;
  }
  // From the BCS of the body that carries it.
  Vec3<Taylor> arm(const Motion& motion) const {
    const Vec3<Taylor> carrier = motion.arm(*fixed);
    if (!curve) return carrier;
    return carrier + motion.axes_along(*fixed) * curve->frame(along_motion(motion)).origin;
  }
  Matrix3 axes(const Motion& motion) const {
    const Matrix3 carrier = motion.axes(*fixed);
    return curve ? carrier * curve->frame(motion.extra[extra]).axes : carrier;
  }
  // Whether its y and z axes are unknown.
  bool straight(const Motion& motion) const { return curve && curve->straight_at(motion.extra[extra]); }
};

}  // namespace dynalin
