#include "nastran_reader/quadratic_eigen.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nastran_reader/deflation.h"
#include "nastran_reader/regular_pencil.h"

namespace dynalin::nastran_reader {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double rounding = std::numeric_limits<double>::epsilon();
// Up to this size every eigenvalue is refined with a factorization of its own.
constexpr Index refined_up_to = 250;

double power_near(double x) { return std::exp2(std::round(std::log2(x))); }
double largest(const MatrixXd& m) { return m.size() == 0 ? 0 : m.cwiseAbs().maxCoeff(); }

// λ = unit · σ, rows and columns scaled: all in powers of two, so that nothing is rounded.
struct Scaled {
  MatrixXd M, B, K;
  double unit = 1;
  VectorXd columns;
};

Scaled scaled(const MatrixXd& M, const MatrixXd& B, const MatrixXd& K) {
  const Index n = K.rows();
  Scaled s{M, B, K, 1, VectorXd::Ones(n)};
  for (int pass = 0; pass < 10; ++pass) {
    // The unit of time in which fast and slow terms are of like size.
    const double m = largest(s.M), b = largest(s.B), k = largest(s.K);
    double unit = 1;
    if (m > 0 && k > 0) {
      unit = power_near(std::sqrt(k / m));
    } else if (m > 0 && b > 0) {
      unit = power_near(b / m);
    } else if (b > 0 && k > 0) {
      unit = power_near(k / b);
    }
    s.unit *= unit;
    s.M *= unit * unit, s.B *= unit;
    const MatrixXd sizes = s.M.cwiseAbs().cwiseMax(s.B.cwiseAbs()).cwiseMax(s.K.cwiseAbs());
    const auto root = [](double x) { return x > 0 ? 1 / power_near(std::sqrt(x)) : 1; };
    const VectorXd rows = sizes.rowwise().maxCoeff().unaryExpr(root);
    const VectorXd columns = sizes.colwise().maxCoeff().transpose().unaryExpr(root);
    for (MatrixXd* x : {&s.M, &s.B, &s.K}) *x = rows.asDiagonal() * *x * columns.asDiagonal();
    s.columns.array() *= columns.array();
  }
  return s;
}

using Wide = std::complex<long double>;

MatrixXcd at(const Scaled& s, Complex z) { return z * z * s.M + z * s.B + s.K.cast<Complex>(); }

enum class Of : bool { value, derivative };
// wᴴ Q(z) v or its derivative by z, summed in extended precision: what cancels is what matters.
Wide form(const Scaled& s, Complex z, const VectorXcd& w, const VectorXcd& v, Of of) {
  const bool derivative = of == Of::derivative;
  const Wide x(z);
  const Wide of_m = derivative ? 2.0L * x : x * x, of_b = derivative ? Wide(1) : x,
             of_k = derivative ? Wide(0) : Wide(1);
  Wide sum = 0;
  const Index n = s.K.rows();
  for (Index j = 0; j < n; ++j) {
    Wide column = 0;
    for (Index i = 0; i < n; ++i) {
      const double m = s.M(i, j), b = s.B(i, j), k = s.K(i, j);
      if (m == 0 && b == 0 && k == 0) continue;
      const Wide q =
          of_m * static_cast<long double>(m) + of_b * static_cast<long double>(b) + of_k * static_cast<long double>(k);
      column += std::conj(Wide(w[i])) * q;
    }
    sum += column * Wide(v[j]);
  }
  return sum;
}

// A start that no eigenvector is orthogonal to but by accident, the same on every machine.
VectorXcd start(Index n) {
  VectorXcd v(n);
  for (Index k = 0; k < n; ++k) v[k] = Complex(1 + 0.3 * std::sin(1.0 + double(k)), 0.4 * std::cos(2.0 * double(k)));
  return v.normalized();
}

// LAPACK's, which are faster than templates for matrices that fill a cache.
class ComplexFactors {
 public:
  explicit ComplexFactors(MatrixXcd m) : m_(std::move(m)), pivots_(static_cast<std::size_t>(m_.rows())) {
    const auto n = static_cast<lapack_int>(m_.rows());
    LAPACKE_zgetrf(LAPACK_COL_MAJOR, n, n, lapack(m_.data()), n, pivots_.data());
  }
  // By the matrix ('N') or its adjoint ('C'); not finite where a pivot vanishes.
  VectorXcd solved(char of, VectorXcd v) const {
    const auto n = static_cast<lapack_int>(m_.rows());
    LAPACKE_zgetrs(LAPACK_COL_MAJOR, of, n, 1, lapack(m_.data()), n, pivots_.data(), lapack(v.data()), n);
    return v;
  }

 private:
  static lapack_complex_double* lapack(Complex* p) { return reinterpret_cast<lapack_complex_double*>(p); }
  static const lapack_complex_double* lapack(const Complex* p) {
    return reinterpret_cast<const lapack_complex_double*>(p);
  }
  MatrixXcd m_;
  std::vector<lapack_int> pivots_;
};

struct Vectors {
  VectorXcd right, left;
};
// Inverse iteration from both sides, in rows and columns that are of like size at this value.
Vectors inverse_iteration(const Scaled& s, Complex z) {
  const double size = std::abs(z);
  const Scales scales = equilibrating(size * size * s.M.cwiseAbs() + size * s.B.cwiseAbs() + s.K.cwiseAbs());
  MatrixXcd Q = scales.rows.cast<Complex>().asDiagonal() * at(s, z) * scales.columns.cast<Complex>().asDiagonal();
  // An exact eigenvalue would leave a pivot of zero.
  Q.diagonal().array() += rounding * 1e-3;
  const ComplexFactors factors(std::move(Q));
  Vectors out{start(s.K.rows()), start(s.K.rows())};
  for (int k = 0; k < 3; ++k) {
    out.right = factors.solved('N', std::move(out.right)).normalized();
    out.left = factors.solved('C', std::move(out.left)).normalized();
  }
  out.right.array() *= scales.columns.array();
  out.left.array() *= scales.rows.array();
  return out;
}

// Newton's steps on the quotient, which is exact to second order in both vectors. Values that others stand close to
// keep what they are: there a single vector means nothing.
Complex refined(const Scaled& s, const Complex first, double distance) {
  Complex z = first;
  constexpr double small_step = 1e-10;
  double last = HUGE_VAL;
  for (int k = 0; k < 6; ++k) {
    const Vectors v = inverse_iteration(s, z);
    if (!v.right.allFinite() || !v.left.allFinite()) return first;
    const Wide slope = form(s, z, v.left, v.right, Of::derivative);
    if (slope == Wide(0)) return first;
    const Complex step(form(s, z, v.left, v.right, Of::value) / slope);
    const double relative = std::abs(step) / std::abs(z);
    if (!(relative < last)) break;  // rounding, or no convergence
    z -= z.imag() == 0 ? Complex(step.real(), 0) : step;
    if (!(std::abs(z - first) <= 0.1 * distance) || !(std::abs(z - first) <= 0.1 * std::abs(first))) return first;
    last = relative;
    if (relative <= rounding) break;
  }
  return last <= small_step ? z : first;
}

void refine(const Scaled& s, std::vector<Complex>& values, Index zeros) {
  const std::vector<Complex> before = values;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (before[k].imag() < 0) continue;
    double distance = zeros > 0 ? std::abs(before[k]) : HUGE_VAL;
    for (std::size_t j = 0; j < before.size(); ++j) {
      if (j != k) distance = std::min(distance, std::abs(before[j] - before[k]));
    }
    if (distance == HUGE_VAL) distance = std::abs(before[k]);
    values[k] = refined(s, before[k], distance);
    if (before[k].imag() == 0) continue;
    for (std::size_t j = 0; j < before.size(); ++j) {
      if (before[j] == std::conj(before[k])) values[j] = std::conj(values[k]);
    }
  }
}

}  // namespace

tl::expected<QuadraticEigenvalues, std::string> finite_eigenvalues(MatrixXd M, MatrixXd B, MatrixXd K) {
  QuadraticEigenvalues out;
  const Index n = K.rows();
  if (n == 0) return out;
  if (!M.allFinite() || !B.allFinite() || !K.allFinite())
    return tl::unexpected(std::string("a term of the matrices is not finite"));
  const Scaled s = scaled(M, B, K);
  // Velocities first: rows of motion above, and that velocities are rates below.
  Pencil p{MatrixXd::Zero(2 * n, 2 * n), MatrixXd::Zero(2 * n, 2 * n)};
  p.E.topLeftCorner(n, n) = s.M;
  p.E.bottomRightCorner(n, n).setIdentity();
  p.A << -s.B, -s.K, MatrixXd::Identity(n, n), MatrixXd::Zero(n, n);
  // E is regular where M is, and A where K is: these are the cheaper questions.
  if (!dependent_rows(s.M).dependent.empty() && deflate_infinite(p) < 0)
    return tl::unexpected(
        std::string("the matrices are singular for every frequency: something moves and nothing tells how"));
  if (p.E.rows() > 0 && !dependent_rows(s.K).dependent.empty()) {
    out.zeros = deflate_zero(p);
    if (out.zeros < 0)
      return tl::unexpected(
          std::string("the matrices are singular for every frequency: something moves and nothing tells how"));
  }
  const bool small = n <= refined_up_to;
  auto values = regular_eigenvalues(p, small ? Correction::none : Correction::by_vectors);
  if (!values) return tl::unexpected(std::string("the QR iteration did not converge"));
  if (small) refine(s, *values, out.zeros);
  out.values.assign(static_cast<std::size_t>(out.zeros), Complex(0, 0));
  for (const Complex& z : *values) out.values.push_back(z * s.unit);
  std::stable_sort(out.values.begin(), out.values.end(), [](const Complex& a, const Complex& b) {
    const double x = std::abs(a), y = std::abs(b);
    // The two of a pair have one size and stand together, the negative frequency first.
    return x != y ? x < y : a.imag() < b.imag();
  });
  return out;
}

VectorXcd eigenvector(const MatrixXd& M, const MatrixXd& B, const MatrixXd& K, Complex value) {
  const Scaled s = scaled(M, B, K);
  VectorXcd v = s.columns.asDiagonal() * inverse_iteration(s, value / s.unit).right;
  Index at_largest = 0;
  v.cwiseAbs().maxCoeff(&at_largest);
  return v / v[at_largest];
}

}  // namespace dynalin::nastran_reader
