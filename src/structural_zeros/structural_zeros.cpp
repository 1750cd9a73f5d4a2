#include "structural_zeros/structural_zeros.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/dense_solvers.h"
#include "perturbation/perturbed_point.h"
#include "structural_zeros/carried_forces.h"
#include "structural_zeros/direction_changes.h"
#include "structural_zeros/element_partials.h"
#include "structural_zeros/null_space.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

}  // namespace

class StructuralZeros::Contributions {
 public:
  Contributions(const System& system, const Perturbation& perturbation)
      : state_count_(system.layout().states.size()),
        n_(system.layout().coordinate_count),
        w_(static_cast<std::int32_t>(system.layout().algebraic.size())),
        at_(perturbation.at),
        rows_(at_->rows),
        choice_(at_->choice),
        changes_(system, perturbation),
        partials_(system, at_->trace(), at_->without_damping),
        forces_(system, at_->motion, rows_, partials_) {
    find_driven(at_->equations);
  }

  // Whether differential state k of the layout does not act on bodies.
  const std::vector<bool>& driven_states() const { return driven_; }

  Matrix beyond(const Matrix& earlier, double limit) const {
    if (!changes_.known()) return Matrix(choice_.size(), 0);
    return beyond(earlier, changes_.beside(earlier), limit);
  }
  Matrix beyond(const Matrix& earlier, const Matrix& columns, double rounding) const {
    if (!changes_.known()) return Matrix(choice_.size(), 0);
    return beyond(earlier, changes_.beside(earlier, columns), rounding);
  }

 private:
  Matrix beyond(const Matrix& earlier, const Directions& d, double limit) const {
    if (d.states.cols() == 0) return Matrix(choice_.size(), 0);
    std::vector<Eigen::RowVectorXd> rows;
    add_rates_that_follow(d, rows);
    add_readings(d, rows);
    forces_.add(d, rows);
    const Matrix null = null_space(rows, d.states.cols(), limit * std::sqrt(static_cast<double>(d.states.cols())));
    return without(earlier, d.states * null);
  }

  // Which states act on bodies, and which algebraic unknowns bodies or such states read directly.
  void find_driven(const Equations& eq) {
    const auto size = static_cast<std::size_t>(eq.size());
    // What each equation reads: the equations of unknowns and states.
    std::vector<std::vector<std::int32_t>> reads(size);
    const auto add_reads = [&](PartialBy family, std::int32_t first) {
      for_each_entry(eq.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
        if (v != 0.0) reads[static_cast<std::size_t>(r)].push_back(first + c);
      });
    };
    add_reads(PartialBy::algebraic, n_);
    add_reads(PartialBy::state, n_ + w_), add_reads(PartialBy::state_rate, n_ + w_);
    std::vector<bool> acts(size, false);  // equations that bodies depend on
    std::vector<std::int32_t> open;
    for (std::int32_t r = 0; r < n_; ++r) {
      acts[static_cast<std::size_t>(r)] = true;
      open.push_back(r);
    }
    while (!open.empty()) {
      const auto& next = reads[static_cast<std::size_t>(open.back())];
      open.pop_back();
      for (const std::int32_t r : next) {
        if (acts[static_cast<std::size_t>(r)]) continue;
        acts[static_cast<std::size_t>(r)] = true;
        open.push_back(r);
      }
    }
    for (std::size_t k = 0; k < state_count_; ++k) driven_.push_back(!acts[static_cast<std::size_t>(n_ + w_) + k]);
    for_each_entry(eq.matrix(PartialBy::algebraic), [&](std::int32_t r, std::int32_t c, double v) {
      if (r < n_ && v != 0.0) held_rows_.push_back(n_ + c);
    });
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(state_count_); ++k) {
      if (!driven_[static_cast<std::size_t>(k)]) held_rows_.push_back(n_ + w_ + k);
    }
    std::sort(held_rows_.begin(), held_rows_.end());
    held_rows_.erase(std::unique(held_rows_.begin(), held_rows_.end()), held_rows_.end());
  }

  // Coordinates without a rate of their own change as the others make them; that must be what is wanted.
  void add_rates_that_follow(const Directions& d, std::vector<Eigen::RowVectorXd>& rows) const {
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      if (choice_.has_rate[k] || choice_.position_state[k] < 0) continue;
      Eigen::RowVectorXd sum = -d.rates_of_states.row(choice_.position_state[k]);
      double size = sum.cwiseAbs().maxCoeff();
      for (const auto& e : choice_.gradient[k]) {
        sum += e.c.g * d.change[Directions::at(PartialBy::velocity)].row(e.column) +
               e.c.v * d.change[Directions::at(PartialBy::position)].row(e.column);
        const double u = d.unit(PartialBy::position, e.column);
        size = std::max({size, std::abs(e.c.g) * u * d.size[Directions::at(PartialBy::velocity)],
                         std::abs(e.c.v) * u * d.size[Directions::at(PartialBy::position)]});
      }
      if (size > 0) rows.push_back(sum / size);
    }
  }

  // What a held equation reads stays what it is, quantity by quantity; those that are taken with equal weight may
  // change together, as two displacements whose difference is meant.
  void add_readings(const Directions& d, std::vector<Eigen::RowVectorXd>& rows) const {
    for (const std::int32_t row : held_rows_) {
      const std::vector<Reading>* found = partials_.readings(row);
      if (!found) continue;
      std::map<double, std::pair<Eigen::RowVectorXd, double>> groups;  // by weight: change and size
      for (const Reading& reading : *found) {
        if (reading.coefficient == 0.0 || !std::isfinite(reading.coefficient)) continue;
        auto& [sum, size] =
            groups.try_emplace(std::abs(reading.coefficient), Eigen::RowVectorXd::Zero(d.states.cols()), 0.0)
                .first->second;
        for (const ElementPartial& p : reading.partials) {
          sum += p.value * d.change[Directions::at(p.family)].row(p.column);
          size = std::max(size, std::abs(p.value) * partials_.size_of(d, p));
        }
      }
      for (const auto& [weight, group] : groups) {
        if (group.second > 0) rows.push_back(group.first / group.second);
      }
    }
  }

  // What directions have beyond the span of earlier ones: coordinates, rates and differential states in units of the
  // largest of their kind.
  Matrix without(const Matrix& earlier, const Matrix& found) const {
    Matrix all(found.rows(), earlier.cols() + found.cols());
    all << earlier, found;
    std::array<double, 3> unit{};
    const auto kind = [&](Index k) -> double& {
      return unit[k >= choice_.first_differential ? 2 : choice_.states[static_cast<std::size_t>(k)].is_rate ? 1 : 0];
    };
    for (Index k = 0; k < all.rows() && all.cols() > 0; ++k)
      kind(k) = std::max(kind(k), all.row(k).cwiseAbs().maxCoeff());
    for (Index k = 0; k < all.rows(); ++k) {
      if (kind(k) > 0) all.row(k) /= kind(k);
    }
    // What earlier directions take others to may be nothing: an integrator alone has a motion that nothing follows.
    std::vector<Index> moving;
    for (Index c = earlier.cols(); c < all.cols(); ++c) {
      if (!all.col(c).isZero(0)) moving.push_back(c);
    }
    Matrix fresh = all(Eigen::all, moving);
    fresh.colwise().normalize();
    if (earlier.cols() > 0) {
      const Eigen::ColPivHouseholderQR<Matrix> known(all.leftCols(earlier.cols()));
      const Matrix Q = columns_of_q(known, known.rank());
      for (int pass = 0; pass < 2; ++pass) fresh -= Q * (Q.transpose() * fresh);
    }
    if (fresh.cols() == 0 || !fresh.allFinite()) return Matrix(found.rows(), 0);
    const Eigen::ColPivHouseholderQR<Matrix> qr(fresh);
    const Index rank = independent_columns(qr);
    if (rank == 0) return Matrix(found.rows(), 0);
    fresh = (fresh * qr.colsPermutation()).leftCols(rank).eval();
    for (Index k = 0; k < fresh.rows(); ++k) {
      if (kind(k) > 0) fresh.row(k) *= kind(k);
    }
    return fresh;
  }

  const std::size_t state_count_;
  const std::int32_t n_, w_;
  const std::shared_ptr<const PerturbedPoint> at_;
  const ConstraintRows& rows_;
  const StateChoice& choice_;
  const DirectionChanges changes_;
  const ElementPartials partials_;
  const CarriedForces forces_;
  std::vector<std::int32_t> held_rows_;  // of algebraic unknowns that act on bodies, and of states that do
  std::vector<bool> driven_;
};

StructuralZeros::StructuralZeros(const System& system, const Perturbation& perturbation)
    : driven_(perturbation.model.states.size(), false),
      contributions_(std::make_unique<const Contributions>(system, perturbation)) {
  const StateChoice& choice = perturbation.at->choice;
  for (std::size_t k = 0; k < choice.differential.size(); ++k) {
    driven_[static_cast<std::size_t>(choice.first_differential) + k] =
        contributions_->driven_states()[static_cast<std::size_t>(choice.differential[k])];
  }
}

StructuralZeros::~StructuralZeros() = default;

Eigen::MatrixXd StructuralZeros::beyond(const Eigen::MatrixXd& earlier, double limit) const {
  return contributions_->beyond(earlier, limit);
}

Eigen::MatrixXd StructuralZeros::beyond(const Matrix& earlier, const Matrix& columns, double rounding) const {
  return contributions_->beyond(earlier, columns, rounding);
}

}  // namespace dynalin
