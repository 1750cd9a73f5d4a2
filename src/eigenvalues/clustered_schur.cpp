#include "eigenvalues/clustered_schur.h"

#include <lapacke.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "eigenvalues/index.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using ComplexMatrix = Eigen::MatrixXcd;
using LongReal = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

constexpr Index most_for_qr_iteration = 60;  // in long double

}  // namespace

LongComplexMatrix times(const LongComplexMatrix& a, const LongComplexMatrix& b) {
  const LongReal ar = a.real(), ai = a.imag(), br = b.real(), bi = b.imag();
  LongComplexMatrix c(a.rows(), b.cols());
  c.real() = ar * br - ai * bi;
  c.imag() = ar * bi + ai * br;
  return c;
}

bool ClusteredSchur::compute(const LongComplexMatrix& M) {
  const Index size = M.rows();
  label_.resize(at(size));
  std::iota(label_.begin(), label_.end(), Index{0});
  first_ = label_;
  if (size <= most_for_qr_iteration) {
    const Eigen::ComplexSchur<LongComplexMatrix> found(M);
    if (found.info() != Eigen::Success) return false;
    T_ = found.matrixT(), Q_ = found.matrixU();
    return true;
  }
  ComplexMatrix T = M.cast<Complex>(), Q(size, size);
  Eigen::VectorXcd values(size);
  const auto n = static_cast<lapack_int>(size);
  const auto lapack = [](ComplexMatrix& m) { return reinterpret_cast<lapack_complex_double*>(m.data()); };
  lapack_int unused = 0;
  if (LAPACKE_zgees(LAPACK_COL_MAJOR, 'V', 'N', nullptr, n, lapack(T), n, &unused,
                    reinterpret_cast<lapack_complex_double*>(values.data()), lapack(Q), n) != 0)
    return false;
  T_ = T.cast<LongComplex>(), Q_ = Q.cast<LongComplex>();
  return true;
}

Eigen::Index ClusteredSchur::cluster_of(Index k) const {
  return std::upper_bound(first_.begin(), first_.end(), k) - first_.begin() - 1;
}

void ClusteredSchur::join(const std::vector<Index>& number_of_cluster) {
  for (Index k = 0; k < T_.rows(); ++k) label_[at(k)] = number_of_cluster[at(cluster_of(k))];
  arrange();
}

// Exchanges the neighbours k and k + 1 on the diagonal of T by a rotation.
void ClusteredSchur::exchange(Index k) {
  const LongComplex a = T_(k, k), b = T_(k + 1, k + 1), x = T_(k, k + 1), y = b - a;
  const long double norm = std::hypot(std::abs(x), std::abs(y));
  if (norm > 0) {
    const LongComplex c = x / norm, s = y / norm;  // (c, s) spans the eigenvector of b
    const auto turn = [&](auto&& left, auto&& right) {
      for (Index r = 0; r < left.size(); ++r) {
        const LongComplex p = left(r), q = right(r);
        left(r) = p * c + q * s;
        right(r) = q * std::conj(c) - p * std::conj(s);
      }
    };
    turn(T_.col(k).head(k + 2), T_.col(k + 1).head(k + 2));
    turn(Q_.col(k), Q_.col(k + 1));
    for (Index j = k; j < T_.cols(); ++j) {
      const LongComplex p = T_(k, j), q = T_(k + 1, j);
      T_(k, j) = std::conj(c) * p + std::conj(s) * q;
      T_(k + 1, j) = c * q - s * p;
    }
    T_(k + 1, k) = 0;
    T_(k, k) = b, T_(k + 1, k + 1) = a;
  }
  std::swap(label_[at(k)], label_[at(k + 1)]);
}

// Clusters stand together on the diagonal.
void ClusteredSchur::arrange() {
  const Index n = T_.rows();
  first_.clear();
  for (Index begin = 0; begin < n;) {
    first_.push_back(begin);
    const Index label = label_[at(begin)];
    Index end = begin + 1;
    for (Index k = end; k < n; ++k) {
      if (label_[at(k)] != label) continue;
      for (Index m = k; m > end; --m) exchange(m - 1);
      ++end;
    }
    begin = end;
  }
}

// Bases of the invariant subspaces, orthonormal each: T V = V diag(T_jj), V_jj = 1.
LongComplexMatrix ClusteredSchur::bases() const {
  const Index n = T_.rows();
  LongComplexMatrix Z(n, n);
  for (Index j = 0; j < clusters(); ++j) {
    const Index begin = first(j), k = size(j);
    LongComplexMatrix v = LongComplexMatrix::Zero(begin + k, k);
    v.bottomRows(k).setIdentity();
    for (Index c = 0; c < k; ++c) {
      LongComplexMatrix right = -T_.block(0, begin + c, begin, 1);
      for (Index b = 0; b < c; ++b) right += v.col(b).head(begin) * T_(begin + b, begin + c);
      for (Index r = begin - 1; r >= 0; --r) {
        const LongComplex x = right(r, 0) / (T_(r, r) - T_(begin + c, begin + c));
        v(r, c) = x;
        right.col(0).head(r) -= T_.col(r).head(r) * x;
      }
    }
    LongComplexMatrix z = times(Q_.leftCols(begin + k), v);
    if (k == 1) {
      z /= z.norm();
    } else {
      z = Eigen::HouseholderQR<LongComplexMatrix>(z).householderQ() * LongComplexMatrix::Identity(n, k);
    }
    Z.middleCols(begin, k) = z;
  }
  return Z;
}

}  // namespace dynalin
