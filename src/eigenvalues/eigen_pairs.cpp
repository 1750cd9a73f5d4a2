#include "eigenvalues/eigen_pairs.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cycle.h"
#include "base/dense_products.h"

namespace dynalin {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double squarable = 1e150;  // its square is a number

// Of [N⁻¹ head; tail], where a tiny value beside long chains of zeros makes N⁻¹ too large for double.
Eigen::VectorXcd direction(const Eigen::MatrixXcd& N, const Eigen::VectorXcd& column) {
  using Long = std::complex<long double>;
  Eigen::Matrix<Long, Eigen::Dynamic, 1> x = column.cast<Long>();
  const Eigen::Matrix<Long, Eigen::Dynamic, 1> head = x.head(N.rows());
  const Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic> long_N = N.cast<Long>();
  x.head(N.rows()) = long_N.triangularView<Eigen::Upper>().solve(head);
  x.normalize();
  return x.cast<std::complex<double>>();
}

// The pair becomes two real values, if real and imaginary parts of its vectors are independent on both sides: by so
// much of the squares of their products.
bool split_pair(EigenPairs& pairs, std::size_t k, double value, double least) {
  const auto at = static_cast<Eigen::Index>(k);
  Eigen::MatrixXd right(pairs.right.rows(), 2), left(pairs.left.rows(), 2);
  right << pairs.right.col(at).real(), pairs.right.col(at).imag();
  left << pairs.left.col(at).real(), pairs.left.col(at).imag();
  const Eigen::Matrix2d products = left.transpose() * right;
  if (!(std::abs(products.determinant()) > least * products.squaredNorm())) return false;
  left = (left * products.inverse().transpose()).eval();  // each sees one of the right ones alone
  right.colwise().normalize(), left.colwise().normalize();
  const Eigen::Index added = pairs.right.cols();
  for (auto* vectors : {&pairs.right, &pairs.left}) vectors->conservativeResize(Eigen::NoChange, added + 1);
  pairs.right.col(at) = right.col(0).cast<std::complex<double>>(),
  pairs.right.col(added) = right.col(1).cast<std::complex<double>>();
  pairs.left.col(at) = left.col(0).cast<std::complex<double>>(),
  pairs.left.col(added) = left.col(1).cast<std::complex<double>>();
  pairs.values[k] = value, pairs.values.emplace_back(value);
  return true;
}

}  // namespace

void clear_rounding(EigenPairs& pairs, std::vector<EigenTrust>& trust) {
  constexpr double rounding_of_real_part = 1e-13;
  double fastest = 0;
  for (const std::complex<double>& v : pairs.values) fastest = std::max(fastest, std::abs(v));
  for (std::size_t k = 0; k < trust.size(); ++k) {
    std::complex<double>& v = pairs.values[k];
    const double unit = rounding_of_real_part * (v.imag() == 0 ? fastest : std::abs(v.imag())), re = std::abs(v.real());
    // To first order the bound of a zero is the value that is computed for it, by a hair more or less.
    if (re > 2 * trust[k].bound || re > unit) continue;
    v.real(0);
    trust[k].bound += re;
  }
}

void clear_phases(EigenPairs& pairs, const std::vector<EigenTrust>& trust) {
  for (std::size_t k = 0; k < trust.size(); ++k) {
    if (pairs.values[k].imag() != 0 || trust[k].cluster != 1) continue;
    for (Eigen::MatrixXcd* side : {&pairs.right, &pairs.left}) {
      auto vector = side->col(static_cast<Eigen::Index>(k));
      Eigen::Index largest = 0;
      if (vector.cwiseAbs2().maxCoeff(&largest) == 0) continue;  // a left one that is not known
      const std::complex<double> phase = vector(largest) / std::abs(vector(largest));
      vector = (std::conj(phase) * vector).real().normalized().cast<std::complex<double>>().eval();
    }
  }
}

void split_pairs_of_zeros(EigenPairs& pairs, std::vector<EigenTrust>& trust) {
  double fastest = 0;
  for (const std::complex<double>& v : pairs.values) fastest = std::max(fastest, std::abs(v));
  const std::size_t count = pairs.values.size();
  for (std::size_t k = 0; k < count; ++k) {
    const double modulus = std::abs(pairs.values[k]);
    if (pairs.values[k].imag() == 0 || modulus > epsilon * epsilon * fastest || modulus > trust[k].bound) continue;
    if (!split_pair(pairs, k, 0, epsilon)) continue;
    trust[k].bound += modulus;
    trust.push_back(trust[k]);
  }
}

void split_pairs_of_equal_values(EigenPairs& pairs) {
  constexpr double equal = 1e-12, independent = 1e-6;
  const std::size_t count = pairs.values.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::complex<double> v = pairs.values[k];
    if (v.imag() == 0) continue;
    // In unit vectors along the parts x + j y of a vector A is [re im·|y|/|x|; im·|x|/|y| re]: of a chain one is large.
    double coupling = v.imag();
    for (const Eigen::MatrixXcd* side : {&pairs.right, &pairs.left}) {
      const auto vector = side->col(static_cast<Eigen::Index>(k));
      const double x = vector.real().norm(), y = vector.imag().norm();
      coupling = std::max(coupling, v.imag() * std::max(x / y, y / x));
    }
    if (coupling <= equal * std::abs(v.real())) split_pair(pairs, k, v.real(), independent);
  }
}

std::vector<std::size_t> printed_order(const std::vector<std::complex<double>>& values) {
  constexpr double tie = 1e-10;
  const auto key = [](const std::complex<double>& v) { return v.imag() == 0 ? std::abs(v.real()) : v.imag(); };
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const std::complex<double> x = values[a], y = values[b];
    const bool x_real = x.imag() == 0, y_real = y.imag() == 0;
    if (x_real != y_real) return x_real;
    return key(x) < key(y);
  });
  // Values that differ by rounding alone come in no order that another way to compute them would have: those that are
  // as far from zero, ±σ or ±σ + jω, are listed by their real part.
  const auto at = [&](std::size_t k) { return values[order[k]]; };
  const auto tied = [&](std::size_t k, std::size_t first) {
    return (at(k).imag() == 0) == (at(first).imag() == 0) && key(at(k)) - key(at(first)) <= tie * std::abs(at(first));
  };
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    for (end = first + 1; end < order.size() && tied(end, first);) ++end;
    const auto begin_of_ties = order.begin() + static_cast<std::ptrdiff_t>(first),
               end_of_ties = order.begin() + static_cast<std::ptrdiff_t>(end);
    // Equal ones keep the order in which they came.
    std::vector<double> real;
    for (std::size_t k = first; k < end; ++k) real.push_back(at(k).real());
    std::sort(real.begin(), real.end());
    const double unit = tie * std::abs(at(first));
    const auto rank = [&](std::size_t k) {
      double lowest = real.front();
      for (const double x : real) {
        if (x > values[k].real()) break;
        if (x - lowest > unit) lowest = x;
      }
      return lowest;
    };
    std::stable_sort(begin_of_ties, end_of_ties, [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  }
  return order;
}

EigenMode mode_of(const EigenPairs& pairs, const EigenTrust& trust, std::size_t at) {
  const auto column = static_cast<Eigen::Index>(at);
  EigenMode mode;
  mode.eigenvalue_hz = pairs.values[at] / cycle;
  mode.is_real = pairs.real(column);
  mode.condition = 1 / std::abs(pairs.left.col(column).dot(pairs.right.col(column)));
  mode.error_bound_hz = trust.bound / cycle;
  mode.refined = trust.refined;
  mode.cluster_size = static_cast<std::size_t>(trust.cluster);
  return mode;
}

EigenMode structural_zero_mode(bool defective) {
  EigenMode mode;
  mode.is_real = mode.structural_zero = true;
  mode.condition = defective ? std::numeric_limits<double>::infinity() : 1.0;
  return mode;
}

void map_to_states(const ZeroModes& zero, EigenPairs& pairs) {
  const Eigen::Index n = zero.block.rows(), z = zero.count;
  if (z == 0) {
    pairs.right = zero.scale.asDiagonal() * pairs.right;
    pairs.left = zero.scale.cwiseInverse().asDiagonal() * pairs.left;
  } else {
    const Eigen::MatrixXcd C = zero.block.topRightCorner(z, n - z).cast<std::complex<double>>();
    Eigen::MatrixXcd full(n, pairs.right.cols());
    full.bottomRows(n - z) = pairs.right;
    full.topRows(z) = -C * pairs.right;
    for (Eigen::Index k = 0; k < full.cols(); ++k) {
      Eigen::MatrixXcd N = zero.block.topLeftCorner(z, z).cast<std::complex<double>>();
      N.diagonal().array() -= pairs.values[static_cast<std::size_t>(k)];
      if (pairs.values[static_cast<std::size_t>(k)] == 0.0) {  // the mean of a cluster around zero
        full.col(k).head(z).setZero();
        continue;
      }
      const Eigen::VectorXcd head = N.triangularView<Eigen::Upper>().solve(full.col(k).head(z));
      if (head.norm() < squarable) {
        full.col(k).head(z) = head;
      } else {
        full.col(k) = direction(N, full.col(k));
      }
    }
    pairs.right = real_product(zero.right(), full);
    pairs.left = real_product(zero.left().rightCols(n - z), pairs.left);
  }
  pairs.right.colwise().normalize();
  pairs.left.colwise().normalize();
}

}  // namespace dynalin
