#include "selected_modes/eigenvalue_search.h"

#include <algorithm>

namespace dynalin {

using Complex = std::complex<double>;
using ComplexMatrix = Eigen::MatrixXcd;
using Index = Eigen::Index;

namespace {

// (at + T⁻¹) of a triangle.
ComplexMatrix matrix_of(const ComplexMatrix& T, Complex at) {
  ComplexMatrix B = ComplexMatrix::Identity(T.rows(), T.rows());
  T.triangularView<Eigen::Upper>().solveInPlace(B);
  B.diagonal().array() += at;
  return B;
}

}  // namespace

void EigenvalueSearch::follow_shift() {
  if (found() > 0) {
    ComplexMatrix shifted = matrix_of(space_.triangle(), at_), T = ComplexMatrix::Identity(found(), found());
    shifted.diagonal().array() -= shift();
    shifted.triangularView<Eigen::Upper>().solveInPlace(T);
    space_.set_triangle(std::move(T));
  }
  at_ = shift();
}

bool EigenvalueSearch::run(Index wanted, double radius) {
  if (found() == 0) at_ = shift();
  const Index before = found();
  const auto apply = [&](Eigen::VectorXcd& v) { side_ == Side::right ? op_->apply(v) : op_->apply_adjoint(v); };
  const bool converged = space_.run(apply, wanted, radius > 0 ? 1 / radius : 0.0);
  reached_ = 0;
  for (Index k = before; k < found(); ++k) reached_ = std::max(reached_, 1 / std::abs(space_.triangle()(k, k)));
  return converged;
}

std::vector<Complex> EigenvalueSearch::glance(Index count) {
  at_ = shift();
  KrylovSchur probe(op_->states());
  const auto apply = [&](Eigen::VectorXcd& v) { side_ == Side::right ? op_->apply(v) : op_->apply_adjoint(v); };
  probe.run(apply, count, 0.0, 1);
  std::vector<Complex> all;
  for (Index k = 0; k < probe.found(); ++k) all.push_back(value_of(probe.triangle()(k, k)));
  for (const Complex& theta : probe.in_sight()) {
    if (theta != 0.0) all.push_back(value_of(theta));
  }
  return all;
}

std::vector<Complex> EigenvalueSearch::values() const {
  std::vector<Complex> all;
  for (Index k = 0; k < found(); ++k) all.push_back(value_of(space_.triangle()(k, k)));
  return all;
}

std::vector<Complex> EigenvalueSearch::in_sight() const {
  std::vector<Complex> all;
  for (const Complex& theta : space_.in_sight()) {
    if (theta != 0.0) all.push_back(value_of(theta));
  }
  return all;
}

EigenvalueSearch::Part EigenvalueSearch::part(const std::function<bool(Complex)>& which) {
  const Index count = space_.order([&](Complex theta) { return which(value_of(theta)); });
  Part p{space_.basis().leftCols(count), {}};
  if (side_ == Side::right) p.matrix = matrix_of(space_.triangle().topLeftCorner(count, count), at_);
  return p;
}

}  // namespace dynalin
