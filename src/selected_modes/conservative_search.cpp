#include "selected_modes/conservative_search.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/arbitrary_vector.h"
#include "base/dense_products.h"
#include "base/dense_solvers.h"
#include "distributed/krylov_progress.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr Index at_a_time = 4;  // columns of the block

}  // namespace

ConservativeSearch::ConservativeSearch(std::shared_ptr<const ConservativeModel> model, ShiftInverse& op)
    : model_(std::move(model)), op_(&op), vectors_(model_->coordinates(), 0) {}

void ConservativeSearch::follow_shift() {}

std::vector<Complex> ConservativeSearch::values_of(double square) const {
  if (square < 0) return {std::sqrt(-square), -std::sqrt(-square)};
  const Complex upper(0, std::sqrt(square));
  if (op_->shift().imag() != 0 && square > 0) return {upper};
  return {upper, std::conj(upper)};
}

Index ConservativeSearch::found() const {
  Index sum = 0;
  for (const double s : squares_) sum += static_cast<Index>(values_of(s).size());
  return sum;
}

std::vector<Complex> ConservativeSearch::values() const {
  std::vector<Complex> all;
  for (const double s : squares_) {
    for (const Complex& v : values_of(s)) all.push_back(v);
  }
  return all;
}

std::vector<Complex> ConservativeSearch::in_sight() const {
  std::vector<Complex> all;
  for (const double s : unsettled_) {
    for (const Complex& v : values_of(s)) all.push_back(v);
  }
  return all;
}

// |λ − σ| ≤ r has |λ² − σ²| ≤ r (r + 2|σ|).
bool ConservativeSearch::run(Index wanted, double radius) {
  const auto before = squares_.size();
  const Index modes = op_->shift().imag() == 0 ? (wanted + 1) / 2 : wanted;
  const bool ended = extend(modes, radius > 0 ? 1 / (radius * (radius + 2 * std::abs(op_->shift()))) : 0.0, 300);
  reached_ = 0;
  for (std::size_t k = before; k < squares_.size(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Complex& v : values_of(squares_[k])) nearest = std::min(nearest, std::abs(v - op_->shift()));
    reached_ = std::max(reached_, nearest);
  }
  return ended;
}

std::vector<Complex> ConservativeSearch::glance(Index count) {
  ConservativeSearch probe(model_, *op_);
  probe.extend(count, 0.0, 1);
  std::vector<Complex> all = probe.values();
  for (const Complex& v : probe.in_sight()) all.push_back(v);
  return all;
}

bool ConservativeSearch::extend(Index wanted, double least, int restarts) {
  unsettled_.clear();
  if (everything()) return true;
  const double sigma = op_->symmetric()->sigma();
  const Index locked = vectors_.cols(), n = model_->coordinates(), left = model_->freedoms() - locked;
  const Index most = std::min(left, std::max<Index>(2 * wanted + 6, wanted + 20));
  wanted = std::min(wanted, most);
  Matrix V(n, locked + most + at_a_time);
  V.leftCols(locked) = vectors_;
  const auto op = [&](const Matrix& v) { return op_->symmetric()->solve(model_->forces(v)); };
  // Orthogonal to the first columns, whose parts in it are added to `share`; 0 if nothing is left of what it was,
  // `before`. Of the first `known` once is enough, unless the last time, before which its size was `size`, or this one
  // takes away much.
  const auto without = [&](Eigen::Ref<Eigen::VectorXd> w, Index known, Index columns, Eigen::Ref<Eigen::VectorXd> share,
                           double size, double before) {
    constexpr int most_passes = 4;
    constexpr double much = 0.7;
    for (int pass = 0;; ++pass) {
      const Eigen::VectorXd f = model_->forces(w).col(0);
      const double now = std::sqrt(std::abs(w.dot(f)));
      const bool little = now > much * size;
      size = now;
      if (pass > 0 && (little || pass == most_passes)) break;
      const Index from = little ? known : 0;
      const Eigen::VectorXd along = V.middleCols(from, columns - from).transpose() * f;
      w.noalias() -= V.middleCols(from, columns - from) * along;
      share.tail(columns - from) += along;
    }
    if (!(size > 1e3 * eps * before)) return 0.0;
    w /= size;
    return size;
  };
  const auto sizes = [](const Matrix& columns, const Matrix& images) -> Eigen::RowVectorXd {
    return columns.cwiseProduct(images).colwise().sum().cwiseAbs().cwiseSqrt();
  };
  const auto start_at = [&](Index column) {
    for (int tries = 0; tries < 20; ++tries) {
      Eigen::VectorXd ignored = Eigen::VectorXd::Zero(column);
      Matrix start = op(arbitrary_vector(n, 500 + starts_++).real());
      const Matrix image = model_->forces(start);
      const double before = sizes(start, image)(0);
      take_out(V, column, image, start);
      V.col(column) = start.col(0);
      if (without(V.col(column), 0, column, ignored, before, before) > 0) return true;
    }
    return false;
  };
  // Columns of V beyond the locked ones: `processed` with their images in H, then those of the block.
  Index size = 0, processed = 0;
  for (; size < std::min(at_a_time, left); ++size) {
    if (!start_at(locked + size)) return false;
  }
  Matrix H = Matrix::Zero(most + at_a_time, most);
  KrylovProgress progress(wanted, least);
  for (int restart = 0; restart < restarts; ++restart) {
    while (processed < most) {
      const Index block = std::min({at_a_time, most - processed, size - processed});
      if (block <= 0) break;
      Matrix images = op(V.middleCols(locked + processed, block));
      if (!images.allFinite()) return false;
      // Twice for all columns of the block at once.
      const Index known = locked + size;
      Matrix of_images = model_->forces(images);
      const Eigen::RowVectorXd before = sizes(images, of_images);
      Matrix along = take_out(V, known, of_images, images);
      of_images = model_->forces(images);
      const Eigen::RowVectorXd after = sizes(images, of_images);
      along += take_out(V, known, of_images, images);
      for (Index b = 0; b < block; ++b, ++processed) {
        Eigen::VectorXd share = Eigen::VectorXd::Zero(locked + size);
        share.head(known) = along.col(b);
        const double rest = without(images.col(b), known, locked + size, share, after(b), before(b));
        H.col(processed).head(size) = share.tail(size);
        if (rest == 0 || locked + size >= V.cols() || size >= left) continue;
        V.col(locked + size) = images.col(b);
        H(size++, processed) = rest;
      }
    }
    // What the block has left once everything was processed: residuals.
    const Index m = processed, block = size - processed;
    Matrix T = H.topLeftCorner(m, m);
    T = (0.5 * (T + T.transpose())).eval();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(T);
    std::vector<Index> order(static_cast<std::size_t>(m));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::abs(solver.eigenvalues()(a)) > std::abs(solver.eigenvalues()(b));
    });
    const Matrix U = solver.eigenvectors()(Eigen::all, order);
    const Eigen::VectorXd theta = solver.eigenvalues()(order);
    const Matrix coupling = H.block(m, 0, block, m) * U;
    const auto value = [&](Index k) {
      return KrylovProgress::Value{std::abs(theta(k)), block > 0 ? coupling.col(k).norm() : 0.0};
    };
    Index done = 0;
    while (done < m && KrylovProgress::is_found(value(done), std::abs(theta(0)))) ++done;
    progress.look(done, m, done > 0 ? value(done - 1).size : 0, done < m ? std::optional(value(done)) : std::nullopt);
    const bool success = progress.has_reached_its_end();
    const Index kept = success ? done : std::min(m - 1, done + std::max<Index>(1, (m - done) / 2));
    if (success || restart + 1 == restarts || progress.stands_still()) {
      for (Index k = 0; k < m; ++k) {
        if (theta(k) != 0) (k < done ? squares_ : unsettled_).push_back(sigma + 1 / theta(k));
      }
      combine_columns(V, locked, U.leftCols(done));
      vectors_ = V.leftCols(locked + done);
      return success;
    }
    combine_columns(V, locked, U.leftCols(kept));
    for (Index b = 0; b < block; ++b) V.col(locked + kept + b) = V.col(locked + m + b).eval();
    H.setZero();
    H.topLeftCorner(kept, kept) = theta.head(kept).asDiagonal();
    H.block(kept, 0, block, kept) = coupling.leftCols(kept);
    processed = kept, size = kept + block;
  }
  return false;
}

// Rates are i times what stands in these columns, positions what does: both are real.
ModeSearch::Part ConservativeSearch::part(const std::function<bool(Complex)>& which, bool left) const {
  std::vector<Index> chosen;
  std::vector<bool> both;  // of a pair; of real values always, which are on either side of every region alike
  for (std::size_t k = 0; k < squares_.size(); ++k) {
    const std::vector<Complex> all = values_of(squares_[k]);
    const auto in = std::count_if(all.begin(), all.end(), which);
    if (in == 0) continue;
    chosen.push_back(static_cast<Index>(k)), both.push_back(in == 2 || squares_[k] <= 0);
  }
  const Matrix v = vectors_(Eigen::all, chosen);
  // From A (x; 0) = (0; x) and A (0; x) = (−ω² x; 0) of rates and positions, and its transpose.
  const Matrix shapes = left ? model_->motions_transposed(model_->forces(v)) : model_->states_of(v);
  const Index p =
      static_cast<Index>(chosen.size() + static_cast<std::size_t>(std::count(both.begin(), both.end(), true)));
  Matrix W = Matrix::Zero(shapes.rows(), p);
  ComplexMatrix D = ComplexMatrix::Zero(p, p);
  Index at = 0;
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const double square = squares_[static_cast<std::size_t>(chosen[c])];
    const auto put = [&](Index column, const std::vector<std::int32_t>& to, double factor) {
      for (std::size_t k = 0; k < to.size(); ++k)
        W(to[k], column) += factor * shapes(model_->positions()[k], static_cast<Index>(c));
    };
    if (both[c]) {
      put(at, model_->rates(), 1.0), put(at + 1, model_->positions(), 1.0);
      D(at + 1, at) = Complex(0, 1), D(at, at + 1) = Complex(0, square);
      at += 2;
    } else {
      // The upper value iω, of whose left vector this is i times.
      const double omega = std::sqrt(square);
      put(at, model_->rates(), left ? 1.0 : omega), put(at, model_->positions(), left ? omega : 1.0);
      D(at, at) = Complex(0, omega);
      ++at;
    }
  }
  W = (left ? Matrix(op_->units().asDiagonal() * W) : Matrix(op_->units().cwiseInverse().asDiagonal() * W));
  const Eigen::VectorXd norm = W.colwise().norm();
  W = W * norm.cwiseInverse().asDiagonal();
  D = (norm.asDiagonal() * D * norm.cwiseInverse().asDiagonal()).eval();
  const Eigen::HouseholderQR<Matrix> qr(W);
  Part out;
  out.basis = columns_of_q(qr, p).cast<Complex>();
  for (const std::int32_t rate : model_->rates()) out.basis.row(rate) *= Complex(0, 1);
  if (left) return out;
  const ComplexMatrix R = Matrix(qr.matrixQR().topRows(p).triangularView<Eigen::Upper>()).cast<Complex>();
  // R D R⁻¹
  const ComplexMatrix product = R * D;
  out.matrix = R.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(product);
  return out;
}

}  // namespace dynalin
