// The motion of the whole system at one instant, as elements see it: poses and their time derivatives,
// multipliers, algebraic values and differential states. Evaluated once per pass and shared.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/time_taylor.h"
#include "base/vec3.h"
#include "mechanics/handles.h"

namespace dynalin {

// Pose of a body coordinate system: origin and axes in global coordinates.
struct Pose {
  Vector r;  // [length]
  Matrix3 R = Matrix3::identity();
};

// A body's BCS along the motion; all components in global axes.
struct BodyMotion {
  Vector r, rdot, rddot;   // origin and its derivatives
  Matrix3 R, Rdot, Rddot;  // axes and their derivatives
  Vector w, wdot;          // angular velocity and acceleration

  Mat3<TimeTaylor<double>> axes() const;  // R along the motion
  // Fills the derivatives of R: R′ = ω×R, R″ = α×R + ω×(ω×R).
  void set(const Pose& pose, const Vector& v, const Vector& omega, const Vector& a, const Vector& alpha);
};

using Taylor = TimeTaylor<double>;

inline Vec3<Taylor> along_motion(const Vector& v, const Vector& vdot, const Vector& vddot) {
  return {{v.x, vdot.x, vddot.x}, {v.y, vdot.y, vddot.y}, {v.z, vdot.z, vddot.z}};
}
inline Vector value(const Vec3<Taylor>& v) { return {v.x.value, v.y.value, v.z.value}; }
inline Vector rate(const Vec3<Taylor>& v) { return {v.x.rate, v.y.rate, v.z.rate}; }
inline Vector acceleration(const Vec3<Taylor>& v) { return {v.x.acceleration, v.y.acceleration, v.z.acceleration}; }
inline Matrix3 value(const Mat3<Taylor>& m) { return {value(m.x), value(m.y), value(m.z)}; }

// What the expression function MODE returns.
enum class AnalysisMode : int {
  kinematics = 1,
  initial_conditions = 3,
  dynamics = 4,
  statics = 5,
  quasi_statics = 6,
  linear = 7
};
// Where nothing moves, and only TIME goes on.
inline bool is_equilibrium(AnalysisMode mode) {
  return mode == AnalysisMode::statics || mode == AnalysisMode::quasi_statics;
}

// Values that outlive an evaluation and change only with an accepted step: total angles for the turn count.
using Memory = std::vector<double>;

class DelayHistories;  // what DELAY reads: values in the past (mechanics/delay_history.h)

// How an integration over time goes, up to its last step: what CPU, HSIZE, ORDER, NJAC and NRHS return, and how far off
// it may be.
struct IntegrationProgress {
  double processor_time = 0;  // of the program [s]
  double step_size = 0;       // [time]
  double order = 0, jacobians = 0, evaluations = 0;
  double left_over = 0;  // errors of some steps that have not died away, as a part of the model's length
};

struct Motion {
  double time = 0;
  AnalysisMode mode = AnalysisMode::initial_conditions;
  IntegrationProgress progress;
  std::vector<BodyMotion> bodies;                             // ground first
  std::vector<double> extra, extra_rate, extra_acceleration;  // coordinates outside poses: modal, curve parameters
  std::vector<double> lambda;                                 // multipliers, one per constraint row
  std::vector<double> algebraic;                              // values of VARIABLEs, force components, outputs
  std::vector<double> state, state_rate;                      // differential states
  Memory memory;
  const DelayHistories* delays = nullptr;  // null before anything has moved in time

  const BodyMotion& body(BodyId b) const { return bodies[static_cast<std::size_t>(b.index)]; }
  Taylor outside_poses(std::size_t k) const { return {extra[k], extra_rate[k], extra_acceleration[k]}; }
  // Marker frame along the motion, global axes; its origin from that of `from`'s BCS, which keeps what is near exact.
  Frame<Taylor> frame(const MarkerPlace&, BodyId from = ground_body) const;
  Mat3<Taylor> axes_along(const MarkerPlace&) const;
  // From the BCS to the marker along the motion, global axes: exact however far from the global origin both are.
  Vec3<Taylor> arm(const MarkerPlace&) const;
  Vector point(const MarkerPlace& m) const {
    const BodyMotion& b = body(m.body);
    return b.r + b.R * (m.shapes ? origin_on_body(m) : m.p_BM);
  }
  Matrix3 axes(const MarkerPlace& m) const { return body(m.body).R * (m.shapes ? axes_on_body(m) : m.R_BM); }

 private:
  // Of a marker with shapes, in the BCS.
  Vector origin_on_body(const MarkerPlace&) const;
  Matrix3 axes_on_body(const MarkerPlace&) const;
};

// The angle with the same sine and cosine as `principal` that lies nearest to `remembered`.
double unwrapped(double principal, double remembered);

}  // namespace dynalin
