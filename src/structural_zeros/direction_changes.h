// How everything in a model changes along directions of its states: a unit of each chosen coordinate at rest in it, and
// what makes a displacement grow as each of given earlier directions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "perturbation/perturb.h"
#include "states/state_choice.h"

namespace dynalin {

struct Directions {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  static std::size_t at(PartialBy family) { return static_cast<std::size_t>(family); }
  // What a unit of a quantity compares with.
  double unit(PartialBy family, std::int32_t column) const {
    return at(family) <= at(PartialBy::acceleration) ? scale[static_cast<std::size_t>(column)] : 1.0;
  }

  Eigen::MatrixXd states, rates_of_states;  // columns x, and x′ that is wanted of it
  std::array<RowMajor, column_families> change;
  std::array<double, column_families> size{};  // largest change, in units of coordinates
  std::vector<double> scale;                   // of coordinates
};

class DirectionChanges {
 public:
  DirectionChanges(const System&, const Perturbation&);

  // Whether accelerations follow from those of states, and there is a coordinate to move.
  bool known() const { return rates_known_ && !positions_.empty(); }
  Directions beside(const Eigen::MatrixXd& earlier) const;
  // The same of the displacements in columns of states instead of each coordinate's.
  Directions beside(const Eigen::MatrixXd& earlier, const Eigen::MatrixXd& columns) const;

 private:
  void factor_rates();
  void set_changes(Directions&) const;
  Directions with_changes(Eigen::MatrixXd at_rest, const Eigen::MatrixXd& earlier) const;
  double scale(std::int32_t coordinate) const { return scale_[static_cast<std::size_t>(coordinate)]; }

  const std::size_t state_count_;  // of the layout
  const std::shared_ptr<const PerturbationEquations> equations_;
  const std::shared_ptr<const PerturbedPoint> at_;
  const ConstraintRows& rows_;
  const StateChoice& choice_;
  const std::int32_t first_lambda_, first_algebraic_;  // among the unknowns of the equations
  const std::int32_t n_;
  const std::size_t algebraic_count_;
  std::vector<double> scale_;                     // of coordinates
  std::vector<std::int32_t> positions_;           // states that are coordinates
  std::vector<std::int32_t> rates_of_positions_;  // −1 for those without
  SparseLu rates_;
  bool rates_known_ = false;
};

}  // namespace dynalin
