// Vectors and rotation matrices over any scalar (double, Dual, TimeTaylor and their nestings).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/dual.h"

namespace dynalin {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  T& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  const T& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }

  Vec3& operator+=(const Vec3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  Vec3& operator-=(const Vec3& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
};

template <class A, class B>
auto operator+(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3<decltype(a.x + b.x)>{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
auto operator-(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A>
Vec3<A> operator-(const Vec3<A>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class A, class S>
auto operator*(const Vec3<A>& a, const S& s) {
  return Vec3<decltype(a.x * s)>{a.x * s, a.y * s, a.z * s};
}
template <class A, class S>
auto operator*(const S& s, const Vec3<A>& a) {
  return Vec3<decltype(s * a.x)>{s * a.x, s * a.y, s * a.z};
}
template <class A, class S>
auto operator/(const Vec3<A>& a, const S& s) {
  return Vec3<decltype(a.x / s)>{a.x / s, a.y / s, a.z / s};
}
template <class A, class B>
auto dot(const Vec3<A>& a, const Vec3<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
auto cross(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3<decltype(a.x * b.x)>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class A>
A norm(const Vec3<A>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class A>
Vec3<A> normalized(const Vec3<A>& a) {
  return a / norm(a);
}

// A 3×3 matrix kept by columns. For a rotation R_GI the columns x, y, z are the axes of I in G.
template <class T>
struct Mat3 {
  Vec3<T> x, y, z;

  Vec3<T>& operator[](std::size_t column) { return column == 0 ? x : column == 1 ? y : z; }
  const Vec3<T>& operator[](std::size_t column) const { return column == 0 ? x : column == 1 ? y : z; }
  T& operator()(std::size_t row, std::size_t column) { return (*this)[column][row]; }
  const T& operator()(std::size_t row, std::size_t column) const { return (*this)[column][row]; }

  Mat3& operator+=(const Mat3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  Mat3& operator-=(const Mat3& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }

  static Mat3 identity() { return diagonal(T(1.0)); }
  static Mat3 diagonal(const T& d) { return {{d, T(0.0), T(0.0)}, {T(0.0), d, T(0.0)}, {T(0.0), T(0.0), d}}; }
};

template <class A, class B>
auto operator*(const Mat3<A>& m, const Vec3<B>& v) {
  return m.x * v.x + m.y * v.y + m.z * v.z;
}
template <class A, class B>
auto operator*(const Mat3<A>& m, const Mat3<B>& n) {
  return Mat3<decltype(m.x.x * n.x.x)>{m * n.x, m * n.y, m * n.z};
}
template <class A>
Mat3<A> operator*(double s, const Mat3<A>& m) {
  return {s * m.x, s * m.y, s * m.z};
}
template <class A>
Mat3<A> operator+(Mat3<A> a, const Mat3<A>& b) {
  return a += b;
}
template <class A>
Mat3<A> operator-(Mat3<A> a, const Mat3<A>& b) {
  return a -= b;
}
template <class A>
Mat3<A> operator-(const Mat3<A>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class A>
Mat3<A> transpose(const Mat3<A>& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}
// mᵀ v without forming the transpose.
template <class A, class B>
auto transpose_times(const Mat3<A>& m, const Vec3<B>& v) {
  using T = decltype(m.x.x * v.x);
  return Vec3<T>{dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
template <class A, class B>
auto transpose_times(const Mat3<A>& m, const Mat3<B>& n) {
  using T = decltype(m.x.x * n.x.x);
  return Mat3<T>{transpose_times(m, n.x), transpose_times(m, n.y), transpose_times(m, n.z)};
}
template <class A>
A trace(const Mat3<A>& m) {
  return m.x.x + m.y.y + m.z.z;
}
// a bᵀ
template <class A>
Mat3<A> outer(const Vec3<A>& a, const Vec3<A>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
// skew(a) b = a × b
template <class A>
Mat3<A> skew(const Vec3<A>& a) {
  return {{A(0.0), a.z, -a.y}, {-a.z, A(0.0), a.x}, {a.y, -a.x, A(0.0)}};
}

using Vector = Vec3<double>;
using Matrix3 = Mat3<double>;

template <class T>
Vector value_of(const Vec3<T>& v) {
  return {value_of(v.x), value_of(v.y), value_of(v.z)};
}

// Origin and axes of a marker, in global or another stated frame.
template <class T>
struct Frame {
  Vec3<T> origin;
  Mat3<T> axes;  // columns: the unit vectors x, y, z
};

// exp(skew(a)): the rotation by |a| about the direction of a.
Matrix3 rotation_exponential(const Vector& a);
// Rz(psi) Rx(theta) Rz(phi): the body-fixed 3-1-3 sequence of REULER, radians.
Matrix3 rotation_313(double psi, double theta, double phi);
// The nearest rotation to a matrix that has drifted from orthogonality by rounding.
Matrix3 orthonormalized(const Matrix3& m);

}  // namespace dynalin
