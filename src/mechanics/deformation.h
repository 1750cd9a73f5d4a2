// Markers on bodies that change their shape. With the modal coordinates q of its body and the shapes φ, ψ of its node,
// a marker stands, BCS axes, o from the node to the marker undeformed, at
//
//     p = p_BM + φ q + (Q − 1) o,     R = Q R_BM,     Q = exp(skew(ψ q))
//
// The exponential keeps the axes orthonormal and turns by ψ δq to first order, however large q is.
#pragma once

#include <cmath>

#include "mechanics/motion.h"

namespace dynalin {

// exp(skew(a)) by its columns, smooth at a = 0.
template <class T>
Mat3<T> rotation_by(const Vec3<T>& a) {
  using std::cos, std::sin, std::sqrt;
  const T s = dot(a, a);
  T sine(1.0), cosine(1.0);  // sin(√s)/√s, 2 (1 − cos √s)/s
  if (value_of(s) <= 1.0) {
    for (int k = 12; k > 0; --k) {  // to the last digit, derivatives included
      sine = T(1.0) - s * sine * (1.0 / (2 * k * (2 * k + 1)));
      cosine = T(1.0) - s * cosine * (1.0 / ((2 * k + 1) * (2 * k + 2)));
    }
  } else {
    const T angle = sqrt(s);
    sine = sin(angle) / angle;
    cosine = (T(1.0) - cos(angle)) * 2.0 / s;
  }
  const auto column = [&](std::size_t c) {
    Vec3<T> e{T(0.0), T(0.0), T(0.0)};
    e[c] = T(1.0);
    const Vec3<T> once = cross(a, e);
    return e + sine * once + (cosine * 0.5) * cross(a, once);
  };
  return {column(0), column(1), column(2)};
}

// φ q and ψ q of a node.
template <class T>
struct NodeMotion {
  Vec3<T> moved{T(0.0), T(0.0), T(0.0)}, angle{T(0.0), T(0.0), T(0.0)};
};
// q(k): the modal coordinate k of the body.
template <class T, class Q>
NodeMotion<T> node_motion(const NodeShapes& shapes, Q&& q) {
  NodeMotion<T> node;
  for (std::size_t k = 0; k < shapes.translation.size(); ++k) {
    const T x = q(k);
    node.moved += x * shapes.translation[k];
    node.angle += x * shapes.rotation[k];
  }
  return node;
}
inline NodeMotion<Taylor> node_motion(const NodeShapes& shapes, const Motion& motion) {
  return node_motion<Taylor>(shapes, [&](std::size_t k) { return motion.outside_poses(shapes.first + k); });
}

// What that makes of a marker's place in the BCS: how far it moves, and Q.
template <class T>
struct Deformation {
  Vec3<T> moved;
  Mat3<T> turned;
};
template <class T>
Deformation<T> deformation(const NodeShapes& shapes, const NodeMotion<T>& node) {
  const Mat3<T> turned = rotation_by(node.angle);
  const Vector& o = shapes.offset;
  return {node.moved + turned * o - Vec3<T>{T(o.x), T(o.y), T(o.z)}, turned};
}
template <class T, class Q>
Deformation<T> deformation(const NodeShapes& shapes, Q&& q) {
  return deformation(shapes, node_motion<T>(shapes, q));
}

}  // namespace dynalin
