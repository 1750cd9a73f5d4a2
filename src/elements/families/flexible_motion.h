// The motion of a body that changes its shape, over any scalar: F, L and Q_k of flexible_body.h, from the pose of the
// BCS along the path and what the modal coordinates make of the body.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "base/dual.h"
#include "flexible/modal_inertia.h"
#include "mechanics/motion.h"
#include "mechanics/path.h"

namespace dynalin::flexible_motion {

// A quantity and its first derivative along the motion.
template <class S>
using Momentary = Dual<1, S>;
template <class S>
Momentary<S> momentary(const S& value, const S& rate) {
  Momentary<S> m(value);
  m.partial[0] = rate;
  return m;
}
template <class S>
Vec3<Momentary<S>> now(const Vec3<TimeTaylor<S>>& v) {
  return {momentary(v.x.value, v.x.rate), momentary(v.y.value, v.y.rate), momentary(v.z.value, v.z.rate)};
}
template <class S>
Vec3<Momentary<S>> rate_now(const Vec3<TimeTaylor<S>>& v) {
  return {momentary(v.x.rate, v.x.acceleration), momentary(v.y.rate, v.y.acceleration),
          momentary(v.z.rate, v.z.acceleration)};
}

// The pose of the BCS along the motion, global axes.
template <class S>
struct Path {
  Vec3<TimeTaylor<S>> r;
  Mat3<TimeTaylor<S>> A;

  Vec3<Momentary<S>> spin() const {  // w
    return {dot(now(A.z), rate_now(A.y)), dot(now(A.x), rate_now(A.z)), dot(now(A.y), rate_now(A.x))};
  }
  Vec3<S> acceleration_less(const Vector& g) const {
    return {r.x.acceleration - S(g.x), r.y.acceleration - S(g.y), r.z.acceleration - S(g.z)};
  }
};

// What the modal coordinates make of the body, BCS axes: c, J and Σ G_k q_k′.
template <class S>
struct Shape {
  Vec3<TimeTaylor<S>> c;
  Mat3<Momentary<S>> J;
  Vec3<Momentary<S>> swing;

  Vec3<S> arm() const { return {c.x.value, c.y.value, c.z.value}; }
  S polar() const { return J(0, 0).value + J(1, 1).value + J(2, 2).value; }  // of all three axes
};

template <class S>
struct Balance {
  Vec3<S> force, moment;
};

// F and L of the head of flexible_body.h.
template <class S>
Balance<S> balance(double mass, const Path<S>& path, const Shape<S>& shape, const Vector& gravity) {
  const Vec3<TimeTaylor<S>> arm = path.A * shape.c;
  const Vec3<Momentary<S>> h = shape.J * path.spin() + shape.swing;
  const Vec3<Momentary<S>> H = now(path.A.x) * h.x + now(path.A.y) * h.y + now(path.A.z) * h.z;
  const Vec3<S> a = path.acceleration_less(gravity);
  const Vec3<S> at{arm.x.value, arm.y.value, arm.z.value};
  const Vec3<S> at2{arm.x.acceleration, arm.y.acceleration, arm.z.acceleration};
  return {mass * a + at2, cross(at, a) + Vec3<S>{H.x.partial[0], H.y.partial[0], H.z.partial[0]}};
}

// The quadratic invariants contracted with the modal coordinates, a row for each mode.
struct Contracted {
  Eigen::VectorXd q, q1, q2;
  std::vector<Vector> G, G1;   // G_k and its rate, which is −Σ I5_kl q_l′
  std::vector<Vector> G2;      // −(Σ I5_kl q_l′)′
  std::vector<Matrix3> J, J1;  // J,k and its rate
  Shape<double> shape;
};

Contracted contract(const ModalInertia&, const Motion&, std::size_t first_extra);

template <std::size_t N>
Momentary<Dual<N>> constant(const Momentary<double>& x) {
  return momentary(Dual<N>(x.value), Dual<N>(x.partial[0]));
}
template <std::size_t N>
Shape<Dual<N>> constant(const Shape<double>& s) {
  Shape<Dual<N>> out;
  out.c = path::constant<N>(s.c);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) out.J(i, k) = constant<N>(s.J(i, k));
    out.swing[i] = constant<N>(s.swing[i]);
  }
  return out;
}
template <std::size_t N>
Path<Dual<N>> constant(const Path<double>& p) {
  return {path::constant<N>(p.r), {path::constant<N>(p.A.x), path::constant<N>(p.A.y), path::constant<N>(p.A.z)}};
}

// δr, then δθ, each at three levels.
inline constexpr std::size_t pose_seeds = 18;
using ByPose = Dual<pose_seeds>;

inline Path<ByPose> varied(const Path<double>& p) {
  Path<ByPose> s = constant<pose_seeds>(p);
  for (std::size_t level = 0; level < 3; ++level) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<Taylor> along{Taylor(unit_vectors[k].x), Taylor(unit_vectors[k].y), Taylor(unit_vectors[k].z)};
      path::vary(s.r, 6 * level + k, level, along);
      for (std::size_t a = 0; a < 3; ++a) path::vary(s.A[a], 6 * level + 3 + k, level, path::turned(k, p.A[a]));
    }
  }
  return s;
}

// The shape with a modal coordinate varied at three levels: δc = I3 ξ, δJ = J,k ξ, δΣ G q′ = Σ I5_kl q_l′ ξ + G_k ξ′.
inline Shape<Dual<3>> varied(const Contracted& c, const Vector& moves, std::size_t k) {
  Shape<Dual<3>> s = constant<3>(c.shape);
  for (std::size_t level = 0; level < 3; ++level)
    path::vary(s.c, level, level, {Taylor(moves.x), Taylor(moves.y), Taylor(moves.z)});
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      s.J(i, j).value.partial[0] = c.J[k](i, j);
      s.J(i, j).partial[0].partial[0] = c.J1[k](i, j);
      s.J(i, j).partial[0].partial[1] = c.J[k](i, j);
    }
    s.swing[i].value.partial[0] = -c.G1[k][i];
    s.swing[i].partial[0].partial[0] = -c.G2[k][i];
    s.swing[i].value.partial[1] = c.G[k][i];
    s.swing[i].partial[0].partial[2] = c.G[k][i];
  }
  return s;
}

// What one mode feels of the motion of the BCS: the first four terms of Q_k.
template <class S>
struct Felt {
  Vec3<S> a, w, wdot;        // acceleration of the origin less gravity, angular velocity and its rate, BCS axes
  std::array<S, 6> squares;  // of w, as in tensor_components

  Felt(const Path<S>& path, const Vector& gravity) {
    const Vec3<S> global = path.acceleration_less(gravity);
    const Vec3<Momentary<S>> spin = path.spin();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<TimeTaylor<S>>& axis = path.A[k];
      a[k] = axis.x.value * global.x + axis.y.value * global.y + axis.z.value * global.z;
      w[k] = spin[k].value, wdot[k] = spin[k].partial[0];
    }
    for (std::size_t at = 0; at < squares.size(); ++at) {
      const auto [i, k] = tensor_components[at];
      squares[at] = (i == k ? 0.5 : 1.0) * (w[i] * w[k]);
    }
  }
  S by(const Vector& moves, const Vector& G, const Vector& G1, const Matrix3& J) const {
    S sum = a.x * moves.x + a.y * moves.y + a.z * moves.z;
    for (std::size_t k = 0; k < 3; ++k) sum += wdot[k] * G[k] + w[k] * (2 * G1[k]);
    for (std::size_t at = 0; at < squares.size(); ++at) {
      const auto [i, k] = tensor_components[at];
      sum += squares[at] * (-J(i, k));
    }
    return sum;
  }
};

}  // namespace dynalin::flexible_motion
