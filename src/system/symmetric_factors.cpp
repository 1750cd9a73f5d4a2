#include "system/symmetric_factors.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/parallel.h"
#include "system/klu_factors.h"
#include "system/lu_choice.h"
#include "system/mumps_matrix.h"
#include "system/nested_dissection.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

ColumnMatrix both_triangles(const ColumnMatrix& lower) {
  std::vector<Triplet> both;
  for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) {
    both.push_back({r, c, 0.0});
    if (r != c) both.push_back({c, r, 0.0});
  });
  return compressed(lower.rows, lower.columns, both);
}

}  // namespace

struct SymmetricFactors::Inertia {
  MumpsMatrix<DMUMPS_STRUC_C> mumps{MumpsSymmetry::symmetric, 60};
  std::int32_t rows;
  std::vector<double> value;
  std::int64_t negative = 0;

  Inertia(const ColumnMatrix& lower, const std::optional<std::vector<std::int32_t>>& place) : rows(lower.rows) {
    mumps.control(13) = 1;        // all pivots are counted
    mumps.real_control(1) = 0.1;  // pivot threshold
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) { mumps.add_place(r, c); });
    mumps.eliminate_in(place);
  }
  bool factor(std::vector<double> values) {
    value = std::move(values);
    const int status = mumps.factor(rows, value.data());
    negative = mumps.problem().infog[11];
    return status == 0;
  }
  void solve(Eigen::MatrixXd& b) {
    const auto columns = static_cast<int>(b.cols());
    mumps.solve(b.data(), columns, Transposed::no, columns);
  }
};

// Eigen's, of the upper triangle in the order of elimination.
struct SymmetricFactors::InOrder {
  using Sparse = Eigen::SparseMatrix<double>;
  struct Factors : Eigen::SimplicialLDLT<Sparse, Eigen::Upper, Eigen::NaturalOrdering<int>> {
    Eigen::Index predicted_entries() const { return m_matrix.outerIndexPtr()[m_matrix.cols()]; }
  };

  std::vector<std::int32_t> place;     // of each unknown in the order
  std::vector<std::int32_t> entry_of;  // of the triangle, by entries of the pattern
  Sparse upper;
  Factors factors;
  std::int64_t negative = 0;
  bool serves = false;

  InOrder(const ColumnMatrix& lower, const ColumnMatrix& both, const std::vector<std::int32_t>& order) : place(order) {
    std::vector<Eigen::Triplet<double>> entries;
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) {
      const auto [first, last] = std::minmax({place_of(r), place_of(c)});
      entries.emplace_back(first, last, static_cast<double>(entries.size()));
    });
    upper.resize(lower.rows, lower.rows);
    upper.setFromTriplets(entries.begin(), entries.end());
    entry_of.resize(entries.size());
    for (Eigen::Index k = 0; k < upper.nonZeros(); ++k)
      entry_of[static_cast<std::size_t>(upper.valuePtr()[k])] = static_cast<std::int32_t>(k);
    factors.analyzePattern(upper);
    serves = !wants_nested_dissection(both, 2 * static_cast<double>(factors.predicted_entries()));
  }
  std::int32_t place_of(std::int32_t k) const { return place[static_cast<std::size_t>(k)]; }

  bool factor(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) upper.valuePtr()[entry_of[k]] = values[k];
    factors.factorize(upper);
    if (factors.info() != Eigen::Success) return false;
    negative = (factors.vectorD().array() < 0).count();
    return stands_for_the_matrix();
  }

  // With all eigenvalues of M = 1 − (factored)⁻¹ A less than 1 nothing between both is singular, and so they have the
  // same signs. No eigenvalue is larger than the k-th root of the size of Mᵏ, which vectors of random signs show, in
  // units that make the entries of A alike. M itself is large where A is ill-conditioned, though no more than a part of
  // what it is applied to: what it makes of any vector is nearly a mode next to the shift, and of that it leaves
  // little.
  bool stands_for_the_matrix() const {
    constexpr double largest_difference = 0.1;
    constexpr Eigen::Index probes = 4;
    Eigen::VectorXd size = Eigen::VectorXd::Zero(upper.cols());
    for (Eigen::Index c = 0; c < upper.cols(); ++c) {
      for (Sparse::InnerIterator e(upper, c); e; ++e) {
        for (const Eigen::Index k : {e.row(), e.col()}) size(k) = std::max(size(k), std::abs(e.value()));
      }
    }
    if (!(size.minCoeff() > 0) || !size.allFinite()) return false;
    std::mt19937 random(1);
    Eigen::MatrixXd x(upper.cols(), probes);
    for (Eigen::Index c = 0; c < probes; ++c) {
      for (Eigen::Index k = 0; k < x.rows(); ++k) x(k, c) = (random() & 1u ? 1 : -1) / std::sqrt(size(k));
    }
    const auto multiply = [&] {
      const Eigen::MatrixXd b = upper.selfadjointView<Eigen::Upper>() * x;
      x -= factors.solve(b);
      return x.allFinite() ? (size.cwiseSqrt().asDiagonal() * x).colwise().norm().maxCoeff()
                           : std::numeric_limits<double>::infinity();
    };
    const double before = std::sqrt(static_cast<double>(x.rows())), once = multiply();
    return once <= largest_difference * before && (once <= largest_difference || multiply() <= largest_difference);
  }
  void solve(Eigen::MatrixXd& b) const {
    Eigen::MatrixXd in_order(b.rows(), b.cols());
    for (Eigen::Index k = 0; k < b.rows(); ++k) in_order.row(place[static_cast<std::size_t>(k)]) = b.row(k);
    in_order = factors.solve(in_order).eval();
    for (Eigen::Index k = 0; k < b.rows(); ++k) b.row(k) = in_order.row(place[static_cast<std::size_t>(k)]);
  }
};

struct SymmetricFactors::Solving {
  KluFactors klu;
  ColumnMatrix matrix;                                       // both triangles
  std::vector<std::pair<std::int32_t, std::int32_t>> place;  // of each entry of the lower one
  bool serves = false;

  Solving(const ColumnMatrix& lower, ColumnMatrix both) : matrix(std::move(both)) {
    serves = klu.analyse(matrix) && !wants_nested_dissection(matrix, klu.predicted_entries());
    if (!serves) return;
    // Columns in order meet the entries of each row in order.
    std::vector<std::int32_t> next(matrix.start.begin(), matrix.start.end() - 1);
    place.reserve(lower.value.size());
    const auto take = [&](std::int32_t column) { return next[static_cast<std::size_t>(column)]++; };
    std::vector<std::int32_t> below(lower.value.size()), above(lower.value.size());
    std::size_t k = 0;
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) { above[k++] = r == c ? -1 : take(r); });
    k = 0;
    for_each_entry(lower, [&](std::int32_t, std::int32_t c, double) { below[k++] = take(c); });
    for (k = 0; k < below.size(); ++k) place.emplace_back(below[k], above[k]);
  }

  bool factor(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto [below, above] = place[k];
      matrix.value[static_cast<std::size_t>(below)] = values[k];
      if (above >= 0) matrix.value[static_cast<std::size_t>(above)] = values[k];
    }
    return klu.factor(matrix);
  }

  // Long columns two at a time by all threads.
  void solve(Eigen::MatrixXd& b) const {
    const auto columns = static_cast<int>(b.cols()), at_once = matrix.rows > long_column ? 2 : std::max(1, columns);
    in_parallel(static_cast<std::size_t>((columns + at_once - 1) / at_once), [&](std::size_t block) {
      const int first = static_cast<int>(block) * at_once;
      klu.solve(b.col(first).data(), matrix.rows, std::min(at_once, columns - first));
    });
  }
};

SymmetricFactors::SymmetricFactors(const ColumnMatrix& lower, FactorsFor use) {
  if (lower.rows == 0) return;
  ColumnMatrix both = both_triangles(lower);
  if (use == FactorsFor::solving) {
    solving_ = std::make_unique<Solving>(lower, both);
    if (solving_->serves) return;
    solving_.reset();
  }
  place_ = nested_dissection(both);
  if (use == FactorsFor::inertia && place_) {
    in_order_ = std::make_unique<InOrder>(lower, both, *place_);
    if (!in_order_->serves) in_order_.reset();
  }
  lower_ = lower;
}

SymmetricFactors::~SymmetricFactors() = default;

bool SymmetricFactors::factor(std::vector<double> values) {
  if (solving_) return solving_->factor(values);
  if (in_order_) {
    if (in_order_->factor(values)) return true;
    in_order_.reset();
  }
  if (!inertia_ && lower_.rows > 0) {
    inertia_ = std::make_unique<Inertia>(lower_, place_);
    lower_ = {};
  }
  return !inertia_ || inertia_->factor(std::move(values));
}

std::int64_t SymmetricFactors::negative_pivots() const {
  assert(!solving_);
  if (in_order_) return in_order_->negative;
  return inertia_ ? inertia_->negative : 0;
}

void SymmetricFactors::solve(Eigen::MatrixXd& b) const {
  if (solving_) return solving_->solve(b);
  if (in_order_) return in_order_->solve(b);
  if (inertia_) inertia_->solve(b);
}

}  // namespace dynalin
