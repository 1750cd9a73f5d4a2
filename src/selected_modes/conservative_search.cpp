#include "selected_modes/conservative_search.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/dense_solvers.h"
#include "distributed/krylov_progress.h"
#include "selected_modes/conservative_krylov.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

}  // namespace

ConservativeSearch::ConservativeSearch(std::shared_ptr<const ConservativeModel> model, ShiftInverse& op,
                                       Progress progress)
    : model_(std::move(model)), op_(&op), told_(std::move(progress)), vectors_(model_->coordinates(), 0) {}

void ConservativeSearch::follow_shift() {}

std::vector<Complex> ConservativeSearch::values_of(double square) const {
  if (square < 0) return {std::sqrt(-square), -std::sqrt(-square)};
  const Complex upper(0, std::sqrt(square));
  // What is next to zero may have come out on either side of it: as many values on both.
  const double zero = zero_from_a_shift * std::abs(op_->shift());
  if (op_->shift().imag() != 0 && square > zero * zero) return {upper};
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
  const Index most = std::min(model_->freedoms() - vectors_.cols(), KrylovProgress::vectors_for(wanted));
  ConservativeKrylov space(*op_->symmetric(), vectors_, most, starts_);
  if (!space.start()) return false;
  KrylovProgress progress(std::min(wanted, most), least);
  for (int restart = 0; restart < restarts; ++restart) {
    if (!space.fill()) return false;
    const ConservativeKrylov::Ritz ritz = space.ritz();
    const Index all = ritz.count(), done = ritz.found();
    told_.tell([&] {
      const Index before = vectors_.cols();
      return fmt::format("{} of {} undamped modes, restart {}", before + std::min(done, wanted), before + wanted,
                         restart);
    });
    progress.look(done, all, done > 0 ? ritz.value(done - 1).size : 0,
                  done < all ? std::optional(ritz.value(done)) : std::nullopt);
    if (progress.has_reached_its_end() || restart + 1 == restarts || progress.stands_still()) {
      for (Index k = 0; k < all; ++k) {
        if (ritz.theta(k) != 0) (k < done ? squares_ : unsettled_).push_back(sigma + 1 / ritz.theta(k));
      }
      vectors_ = space.take(ritz, done);
      return progress.has_reached_its_end();
    }
    space.restart(ritz, std::min(all - 1, done + std::max<Index>(1, (all - done) / 2)));
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
