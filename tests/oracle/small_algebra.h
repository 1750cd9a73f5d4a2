// Three-vectors, rotations and a dense LU in extended precision, written for the oracle alone. Nothing
// here is shared with the product, so a mistake in the product's algebra cannot hide itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace dynalin::oracle {

using Real = long double;

// Over numbers, or over jets (jet.h).
template <class T>
struct Vector3 {
  T x{}, y{}, z{};
};
using Vec = Vector3<Real>;

template <class T>
[[nodiscard]] Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
[[nodiscard]] Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
[[nodiscard]] Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
[[nodiscard]] Vector3<T> operator*(const std::type_identity_t<T>& s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
Vector3<T>& operator+=(Vector3<T>& a, const Vector3<T>& b) {
  return a = a + b;
}
template <class T>
[[nodiscard]] T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[nodiscard]] Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
[[nodiscard]] T norm(const Vector3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
[[nodiscard]] const T& component(const Vector3<T>& a, int k) {
  return k == 0 ? a.x : (k == 1 ? a.y : a.z);
}
inline void set_component(Vec& a, int k, Real value) { (k == 0 ? a.x : (k == 1 ? a.y : a.z)) = value; }
[[nodiscard]] inline Vec normalized(const Vec& v) { return (1 / norm(v)) * v; }
[[nodiscard]] inline Vec unit(int axis) {
  Vec e;
  set_component(e, axis, 1);
  return e;
}

// A 3 x 3 matrix by columns: the columns of a rotation are the axes of the rotated frame.
struct Mat {
  std::array<Vec, 3> column{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
};

[[nodiscard]] inline Vec operator*(const Mat& m, const Vec& v) {
  return v.x * m.column[0] + v.y * m.column[1] + v.z * m.column[2];
}
[[nodiscard]] inline Mat operator*(const Mat& a, const Mat& b) {
  return {{a * b.column[0], a * b.column[1], a * b.column[2]}};
}
[[nodiscard]] inline Mat operator+(const Mat& a, const Mat& b) {
  return {{a.column[0] + b.column[0], a.column[1] + b.column[1], a.column[2] + b.column[2]}};
}
[[nodiscard]] inline Mat operator*(Real s, const Mat& a) {
  return {{s * a.column[0], s * a.column[1], s * a.column[2]}};
}
[[nodiscard]] inline Mat transpose(const Mat& m) {
  const auto& c = m.column;
  return {{Vec{c[0].x, c[1].x, c[2].x}, Vec{c[0].y, c[1].y, c[2].y}, Vec{c[0].z, c[1].z, c[2].z}}};
}
[[nodiscard]] inline Mat skew(const Vec& v) { return {{Vec{0, v.z, -v.y}, Vec{-v.z, 0, v.x}, Vec{v.y, -v.x, 0}}}; }
[[nodiscard]] inline Mat zero_matrix() { return {{Vec{}, Vec{}, Vec{}}}; }

[[nodiscard]] inline Mat rotation_z(Real a) {
  return {{Vec{std::cos(a), std::sin(a), 0}, Vec{-std::sin(a), std::cos(a), 0}, Vec{0, 0, 1}}};
}
[[nodiscard]] inline Mat rotation_x(Real a) {
  return {{Vec{1, 0, 0}, Vec{0, std::cos(a), std::sin(a)}, Vec{0, -std::sin(a), std::cos(a)}}};
}
[[nodiscard]] inline Mat rotation_313(Real a, Real b, Real c) { return rotation_z(a) * rotation_x(b) * rotation_z(c); }

// sum (-1)^k s^k / (2k + p)! and its derivative in s. With p = 1, 2, 3 these are sin(t)/t,
// (1 - cos t)/t^2 and (t - sin t)/t^3 at s = t^2, without their cancellation at small angles.
struct SeriesValue {
  Real value = 0, slope = 0;
};
using SeriesCoefficients = std::array<Real, 30>;
[[nodiscard]] constexpr SeriesCoefficients rotation_coefficients(int p) {
  Real coefficient = 1;
  for (int k = 2; k <= p; ++k) coefficient /= static_cast<Real>(k);
  SeriesCoefficients all{};
  int k = 0;
  for (Real& c : all) {
    c = coefficient;
    coefficient /= -static_cast<Real>((2 * k + p + 1) * (2 * k + p + 2));
    ++k;
  }
  return all;
}
inline constexpr std::array<SeriesCoefficients, 3> rotation_coefficient = {
    rotation_coefficients(1), rotation_coefficients(2), rotation_coefficients(3)};
[[nodiscard]] inline SeriesValue rotation_series(Real s, int p) {
  const SeriesCoefficients& c = rotation_coefficient[static_cast<std::size_t>(p - 1)];
  SeriesValue sum;
  Real power = 1, power_before = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Real term = c[k] * power, slope = static_cast<Real>(k) * c[k] * power_before;
    sum.value += term, sum.slope += slope;
    // Far behind all digits, and later terms are smaller yet.
    if (k > 0 && std::fabs(term) < 1e-30L && std::fabs(slope) < 1e-30L) break;
    power_before = power;
    power *= s;
  }
  return sum;
}

// exp(y^), its left Jacobian J with d/dt exp(y^) = (J y')^ exp(y^), and dJ/dt for a rate of y.
[[nodiscard]] inline Mat rotation_exponential(const Vec& y) {
  const Real s = dot(y, y);
  const Mat Y = skew(y);
  return Mat{} + rotation_series(s, 1).value * Y + rotation_series(s, 2).value * (Y * Y);
}
[[nodiscard]] inline Mat left_jacobian(const Vec& y) {
  const Real s = dot(y, y);
  const Mat Y = skew(y);
  return Mat{} + rotation_series(s, 2).value * Y + rotation_series(s, 3).value * (Y * Y);
}
[[nodiscard]] inline Mat left_jacobian_rate(const Vec& y, const Vec& ydot) {
  const Real s = dot(y, y);
  const Real sdot = 2 * dot(y, ydot);
  const Mat Y = skew(y);
  const Mat Yd = skew(ydot);
  const SeriesValue b = rotation_series(s, 2);
  const SeriesValue c = rotation_series(s, 3);
  return (b.slope * sdot) * Y + b.value * Yd + (c.slope * sdot) * (Y * Y) + c.value * (Yd * Y + Y * Yd);
}
[[nodiscard]] inline Vec solve3(const Mat& m, const Vec& b) {
  const auto& c = m.column;
  const Real det = dot(c[0], cross(c[1], c[2]));
  return {dot(b, cross(c[1], c[2])) / det, dot(c[0], cross(b, c[2])) / det, dot(c[0], cross(c[1], b)) / det};
}

// Row-major dense matrix.
class Dense {
 public:
  Dense() = default;
  Dense(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), data_(rows * columns, 0) {}
  [[nodiscard]] Real& operator()(std::size_t i, std::size_t j) { return data_[i * columns_ + j]; }
  [[nodiscard]] Real operator()(std::size_t i, std::size_t j) const { return data_[i * columns_ + j]; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  void swap_rows(std::size_t i, std::size_t k) {
    for (std::size_t j = 0; j < columns_; ++j) std::swap((*this)(i, j), (*this)(k, j));
  }

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<Real> data_;
};

// LU with row equilibration and partial pivoting.
class Lu {
 public:
  Lu() = default;
  explicit Lu(Dense m) : lu_(std::move(m)), order_(lu_.rows()), scale_(lu_.rows(), 1) {
    const std::size_t n = lu_.rows();
    if (n != lu_.columns()) throw std::runtime_error("the system to solve is not square");
    for (std::size_t i = 0; i < n; ++i) {
      order_[i] = i;
      Real largest = 0;
      for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, std::fabs(lu_(i, j)));
      if (!(largest > 0)) throw std::runtime_error("the system to solve has an empty row");
      scale_[i] = 1 / largest;
      for (std::size_t j = 0; j < n; ++j) lu_(i, j) *= scale_[i];
    }
    for (std::size_t k = 0; k < n; ++k) eliminate(k);
    below_ = entries([](std::size_t i, std::size_t j) { return j < i; });
    above_ = entries([](std::size_t i, std::size_t j) { return j > i; });
  }

  [[nodiscard]] std::vector<Real> solve(const std::vector<Real>& b) const {
    const std::size_t n = lu_.rows();
    std::vector<Real> x(n);
    for (std::size_t i = 0; i < n; ++i) {
      Real sum = b[order_[i]] * scale_[order_[i]];
      for (std::size_t e = below_.start[i]; e < below_.start[i + 1]; ++e)
        sum -= below_.entry[e].value * x[below_.entry[e].column];
      x[i] = sum;
    }
    for (std::size_t i = n; i-- > 0;) {
      Real sum = x[i];
      for (std::size_t e = above_.start[i]; e < above_.start[i + 1]; ++e)
        sum -= above_.entry[e].value * x[above_.entry[e].column];
      x[i] = sum / lu_(i, i);
    }
    return x;
  }
  [[nodiscard]] bool ready() const { return ready_; }

 private:
  void eliminate(std::size_t k) {
    const std::size_t n = lu_.rows();
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::fabs(lu_(i, k)) > std::fabs(lu_(pivot, k))) pivot = i;
    }
    if (!(std::fabs(lu_(pivot, k)) > 1e-15L)) throw std::runtime_error("a system is singular");
    if (pivot != k) {
      lu_.swap_rows(pivot, k);
      std::swap(order_[pivot], order_[k]);
    }
    std::vector<std::size_t> used;
    for (std::size_t j = k + 1; j < n; ++j) {
      if (lu_(k, j) != 0) used.push_back(j);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      if (lu_(i, k) == 0) continue;
      const Real factor = lu_(i, k) / lu_(k, k);
      lu_(i, k) = factor;
      for (const std::size_t j : used) lu_(i, j) -= factor * lu_(k, j);
    }
    ready_ = k + 1 == n;
  }
  // Most factors are zero; one set of them serves many right-hand sides.
  struct Entries {
    struct One {
      std::size_t column;
      Real value;
    };
    std::vector<One> entry;
    std::vector<std::size_t> start{0};  // of each row, and the end
  };
  template <class Of>
  [[nodiscard]] Entries entries(Of&& is_of) const {
    Entries out;
    for (std::size_t i = 0; i < lu_.rows(); ++i) {
      for (std::size_t j = 0; j < lu_.columns(); ++j) {
        if (is_of(i, j) && lu_(i, j) != 0) out.entry.push_back({j, lu_(i, j)});
      }
      out.start.push_back(out.entry.size());
    }
    return out;
  }

  Dense lu_;
  Entries below_, above_;
  std::vector<std::size_t> order_;
  std::vector<Real> scale_;
  bool ready_ = false;
};

}  // namespace dynalin::oracle
