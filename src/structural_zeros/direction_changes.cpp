#include "structural_zeros/direction_changes.h"

#include <algorithm>
#include <cmath>

#include "perturbation/perturbation.h"
#include "perturbation/perturbed_point.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

}  // namespace

DirectionChanges::DirectionChanges(const System& system, const Perturbation& perturbation)
    : state_count_(system.layout().states.size()),
      equations_(perturbation.equations),
      at_(perturbation.at),
      rows_(at_->rows),
      choice_(at_->choice),
      first_lambda_(equations_->augmented() + AugmentedSystem(system).lambda(0)),
      first_algebraic_(equations_->augmented() + AugmentedSystem(system).algebraic(0)),
      n_(system.layout().coordinate_count),
      algebraic_count_(system.layout().algebraic.size()) {
  for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
    if (choice_.position_state[k] < 0) continue;
    positions_.push_back(choice_.position_state[k]);
    rates_of_positions_.push_back(choice_.rate_state[k]);
  }
  for (std::int32_t k = 0; k < n_; ++k) scale_.push_back(system.coordinate_scale(k));
  factor_rates();
}

// Accelerations follow from those of states; along freedoms without mass any will do, as no force depends on them.
void DirectionChanges::factor_rates() {
  // A coordinate of each freedom without mass: nothing depends on its acceleration.
  std::vector<std::int32_t> massless;
  if (at_->massless) massless = at_->massless->limit.directions.coordinate;
  bool square = false;
  const auto vacant = static_cast<std::int32_t>(massless.size());
  ColumnMatrix level = level_matrix(rows_, choice_, choice_.velocity_active, choice_.has_rate, square, vacant);
  if (!square) return;
  if (vacant > 0) {
    std::vector<Triplet> entries;
    for_each_entry(level, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
    std::int32_t r = n_ - vacant;
    for (const std::int32_t c : massless) entries.push_back({r++, c, 1 / scale(c)});
    level = compressed(n_, n_, entries);
  }
  rates_known_ = rates_.factor(level);
}

Directions DirectionChanges::beside(const Matrix& earlier) const {
  const auto free = static_cast<Index>(positions_.size());
  Matrix at_rest = Matrix::Zero(choice_.size(), free);
  for (Index k = 0; k < free; ++k) at_rest(positions_[static_cast<std::size_t>(k)], k) = 1;
  return with_changes(std::move(at_rest), earlier);
}

Directions DirectionChanges::beside(const Matrix& earlier, const Matrix& columns) const {
  Matrix at_rest = Matrix::Zero(choice_.size(), columns.cols());
  for (const std::int32_t k : positions_) at_rest.row(k) = columns.row(k);
  return with_changes(std::move(at_rest), earlier);
}

Directions DirectionChanges::with_changes(Matrix at_rest, const Matrix& earlier) const {
  const Index free = at_rest.cols(), more = earlier.cols();
  Directions d;
  d.states = Matrix::Zero(choice_.size(), free + more);
  d.rates_of_states = d.states;
  d.states.leftCols(free) = at_rest;
  for (std::size_t k = 0; k < positions_.size() && more > 0; ++k) {
    if (rates_of_positions_[k] >= 0) d.states.row(rates_of_positions_[k]).tail(more) = earlier.row(positions_[k]);
  }
  d.rates_of_states.rightCols(more) = earlier;
  d.scale = scale_;
  set_changes(d);
  // Every column in units of the largest thing that it moves. Velocities displace condensed freedoms without mass
  // only, by rounding if they are a rigid motion.
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(free + more);
  for (Index c = 0; c < factor.size(); ++c) {
    double size = 0;
    for (const PartialBy family : {PartialBy::position, PartialBy::velocity}) {
      if (family == PartialBy::position && c >= free) continue;
      for (std::int32_t k = 0; k < n_; ++k)
        size = std::max(size, std::abs(d.change[Directions::at(family)](k, c)) / scale(k));
      if (size > 0) break;
    }
    if (size > 0) factor(c) = 1 / size;
  }
  d.states = d.states * factor.asDiagonal();
  d.rates_of_states = d.rates_of_states * factor.asDiagonal();
  for (Directions::RowMajor& m : d.change) m = m * factor.asDiagonal();
  for (std::size_t f = 0; f < column_families; ++f) {
    for (Index k = 0; k < d.change[f].rows(); ++k) {
      if (d.change[f].cols() == 0) continue;
      const double u = d.unit(static_cast<PartialBy>(f), static_cast<std::int32_t>(k));
      d.size[f] = std::max(d.size[f], d.change[f].row(k).cwiseAbs().maxCoeff() / u);
    }
  }
  return d;
}

void DirectionChanges::set_changes(Directions& d) const {
  const Matrix all = equations_->complete(d.states);
  const Matrix dq = all.topRows(n_), dqdot = all.middleRows(equations_->rates(), n_);
  Matrix right = Matrix::Zero(n_, d.states.cols());
  Index r = 0;
  const auto row_of = [&](const auto& row) {
    for (const auto& e : row) right.row(r) -= e.c.a1 * dqdot.row(e.column) + e.c.a0 * dq.row(e.column);
  };
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!choice_.velocity_active[static_cast<std::size_t>(k)]) continue;
    row_of(rows_.row(k));
    ++r;
  }
  for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
    if (!choice_.has_rate[k]) continue;
    right.row(r) = d.rates_of_states.row(choice_.rate_state[k]);
    row_of(choice_.gradient[k]);
    ++r;
  }
  rates_.solve(right);
  d.change[Directions::at(PartialBy::position)] = dq;
  d.change[Directions::at(PartialBy::velocity)] = d.change[Directions::at(PartialBy::damping)] = dqdot;
  d.change[Directions::at(PartialBy::acceleration)] = right;
  d.change[Directions::at(PartialBy::lambda)] = all.middleRows(first_lambda_, rows_.size());
  d.change[Directions::at(PartialBy::algebraic)] =
      all.middleRows(first_algebraic_, static_cast<Index>(algebraic_count_));
  const Index states = static_cast<Index>(state_count_);
  d.change[Directions::at(PartialBy::state)] = d.change[Directions::at(PartialBy::state_rate)] =
      Directions::RowMajor::Zero(states, d.states.cols());
}

}  // namespace dynalin
