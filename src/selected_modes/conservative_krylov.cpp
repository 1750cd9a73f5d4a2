#include "selected_modes/conservative_krylov.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <vector>

#include "base/arbitrary_vector.h"
#include "base/dense_products.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

constexpr Index at_a_time = 4;  // columns of the block

// By M, of columns and of M times them.
Eigen::RowVectorXd sizes_by_mass(const Matrix& columns, const Matrix& forces) {
  return columns.cwiseProduct(forces).colwise().sum().cwiseAbs().cwiseSqrt();
}

}  // namespace

ConservativeKrylov::ConservativeKrylov(const ConservativeFactors& op, const Matrix& locked, Index most,
                                       unsigned& starts)
    : op_(op),
      model_(op.model()),
      locked_(locked.cols()),
      left_(model_.freedoms() - locked_),
      most_(most),
      starts_(starts),
      V_(model_.coordinates(), locked_ + most + at_a_time),
      H_(Matrix::Zero(most + at_a_time, most)) {
  V_.leftCols(locked_) = locked;
}

// Orthogonal to the first columns, whose parts in it are added to `share`; 0 if nothing is left of what it was,
// `before`. Of the first `known` once is enough, unless the last time, before which its size was `size`, or this one
// takes away much.
double ConservativeKrylov::without(Eigen::Ref<Eigen::VectorXd> w, Index known, Index columns,
                                   Eigen::Ref<Eigen::VectorXd> share, double size, double before) const {
  constexpr int most_passes = 4;
  constexpr double much = 0.7;
  for (int pass = 0;; ++pass) {
    const Eigen::VectorXd f = model_.forces(w).col(0);
    const double now = std::sqrt(std::abs(w.dot(f)));
    const bool little = now > much * size;
    size = now;
    if (pass > 0 && (little || pass == most_passes)) break;
    const Index from = little ? known : 0;
    const Eigen::VectorXd along = V_.middleCols(from, columns - from).transpose() * f;
    w.noalias() -= V_.middleCols(from, columns - from) * along;
    share.tail(columns - from) += along;
  }
  if (!(size > 1e3 * eps * before)) return 0.0;
  w /= size;
  return size;
}

bool ConservativeKrylov::start_at(Index column) {
  constexpr int most_tries = 20;
  for (int tries = 0; tries < most_tries; ++tries) {
    Eigen::VectorXd ignored = Eigen::VectorXd::Zero(column);
    Matrix start = image(arbitrary_vector(model_.coordinates(), 500 + starts_++).real());
    const Matrix forces = model_.forces(start);
    const double before = sizes_by_mass(start, forces)(0);
    take_out(V_, column, forces, start);
    V_.col(column) = start.col(0);
    if (without(V_.col(column), 0, column, ignored, before, before) > 0) return true;
  }
  return false;
}

bool ConservativeKrylov::start() {
  for (; size_ < std::min(at_a_time, left_); ++size_) {
    if (!start_at(locked_ + size_)) return false;
  }
  return true;
}

bool ConservativeKrylov::fill() {
  while (processed_ < most_) {
    const Index block = std::min({at_a_time, most_ - processed_, size_ - processed_});
    if (block <= 0) break;
    Matrix images = image(V_.middleCols(locked_ + processed_, block));
    if (!images.allFinite()) return false;
    // Twice for all columns of the block at once.
    const Index known = locked_ + size_;
    Matrix of_images = model_.forces(images);
    const Eigen::RowVectorXd before = sizes_by_mass(images, of_images);
    Matrix along = take_out(V_, known, of_images, images);
    of_images = model_.forces(images);
    const Eigen::RowVectorXd after = sizes_by_mass(images, of_images);
    along += take_out(V_, known, of_images, images);
    for (Index b = 0; b < block; ++b, ++processed_) {
      Eigen::VectorXd share = Eigen::VectorXd::Zero(locked_ + size_);
      share.head(known) = along.col(b);
      const double rest = without(images.col(b), known, locked_ + size_, share, after(b), before(b));
      H_.col(processed_).head(size_) = share.tail(size_);
      if (rest == 0 || locked_ + size_ >= V_.cols() || size_ >= left_) continue;
      V_.col(locked_ + size_) = images.col(b);
      H_(size_++, processed_) = rest;
    }
  }
  return true;
}

ConservativeKrylov::Ritz ConservativeKrylov::ritz() const {
  const Index m = processed_, block = size_ - processed_;
  Matrix T = H_.topLeftCorner(m, m);
  T = (0.5 * (T + T.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(T);
  std::vector<Index> order(static_cast<std::size_t>(m));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::abs(solver.eigenvalues()(a)) > std::abs(solver.eigenvalues()(b));
  });
  Ritz ritz{solver.eigenvalues()(order), solver.eigenvectors()(Eigen::all, order), {}};
  // What the block has left once everything was processed.
  ritz.residuals = H_.block(m, 0, block, m) * ritz.vectors;
  return ritz;
}

Index ConservativeKrylov::Ritz::found() const {
  Index found = 0;
  while (found < count() && KrylovProgress::is_found(value(found), std::abs(theta(0)))) ++found;
  return found;
}

void ConservativeKrylov::restart(const Ritz& ritz, Index kept) {
  const Index m = processed_, block = size_ - processed_;
  combine_columns(V_, locked_, ritz.vectors.leftCols(kept));
  for (Index b = 0; b < block; ++b) V_.col(locked_ + kept + b) = V_.col(locked_ + m + b).eval();
  H_.setZero();
  H_.topLeftCorner(kept, kept) = ritz.theta.head(kept).asDiagonal();
  H_.block(kept, 0, block, kept) = ritz.residuals.leftCols(kept);
  processed_ = kept, size_ = kept + block;
}

Matrix ConservativeKrylov::take(const Ritz& ritz, Index found) {
  combine_columns(V_, locked_, ritz.vectors.leftCols(found));
  return V_.leftCols(locked_ + found);
}

}  // namespace dynalin
