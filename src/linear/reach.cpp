#include "linear/reach.h"

#include <cmath>
#include <numbers>

#include "base/arbitrary_vector.h"
#include "perturbation/perturbation.h"

namespace dynalin {

namespace {

// Displacements of all coordinates by units of the chosen ones, as an operator.
class Displacements {
 public:
  Displacements(const System& system, const LinearSystem& linear) : linear_(linear) {
    size_.resize(linear.equations->coordinates());
    for (std::int32_t c = 0; c < size_.size(); ++c) size_(c) = system.coordinate_scale(c);
    unit_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(linear.model.states.size()));
    for (std::size_t k = 0; k < linear.kinematic_states; ++k) unit_(static_cast<Eigen::Index>(k)) = linear.scales[k];
  }

  const Eigen::VectorXd& unit() const { return unit_; }
  Eigen::VectorXd of(const Eigen::VectorXd& shares) const {
    const Eigen::VectorXcd states = unit_.cwiseProduct(shares).cast<std::complex<double>>();
    return linear_.displacements(states).col(0).real().cwiseQuotient(size_);
  }
  // What a unit of each chosen coordinate makes of one coordinate.
  Eigen::VectorXd row(Eigen::Index coordinate) const {
    const PerturbationEquations& p = *linear_.equations;
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(p.state_columns(), 1);
    b(coordinate, 0) = 1 / size_(coordinate);
    const Eigen::MatrixXd y = p.solve_transposed(std::move(b));
    Eigen::VectorXd row = Eigen::VectorXd::Zero(unit_.size());
    for (std::int32_t k = 0; k < p.states(); ++k) {
      for_each_in_column(p.products(), p.state_columns() + k, [&](std::int32_t r, double v) {
        if (r < p.state_columns()) row(k) -= v * y(r, 0);
      });
    }
    return row.cwiseProduct(unit_);
  }

 private:
  const LinearSystem& linear_;
  Eigen::VectorXd size_, unit_;
};

Eigen::Index largest(const Eigen::VectorXd& v) {
  Eigen::Index at = 0;
  v.cwiseAbs().maxCoeff(&at);
  return at;
}

// From the coordinate that an uneven motion moves most to the state that moves it most, to what that moves most …
std::optional<Disproportion> searched(const System& system, const LinearSystem& linear, double least) {
  const Displacements T(system, linear);
  if (T.unit().size() == 0 || T.unit().isZero(0) || linear.equations->coordinates() == 0) return std::nullopt;
  Disproportion found;
  Eigen::Index coordinate = largest(uneven_motion(system, linear));
  constexpr int longest_way = 10;
  for (int step = 0; step < longest_way; ++step) {
    const Eigen::Index state = largest(T.row(coordinate));
    const Eigen::VectorXd moved = T.of(Eigen::VectorXd::Unit(T.unit().size(), state));
    coordinate = largest(moved);
    const double times = std::abs(moved(coordinate));
    if (!(times > found.times)) break;
    found = {times, static_cast<std::size_t>(state), static_cast<std::int32_t>(coordinate)};
  }
  if (!(found.times > least)) return std::nullopt;
  return found;
}

}  // namespace

std::optional<Disproportion> largest_disproportion(const System& system, const LinearSystem& linear, double least) {
  if (linear.reach.size() != linear.model.states.size()) return searched(system, linear, least);
  Disproportion found{least, 0, -1};
  for (std::size_t k = 0; k < linear.kinematic_states; ++k) {
    const double unit = linear.scales[k];
    if (unit == 0) continue;
    const double moved = linear.reach[k].size * unit;
    if (moved > found.times) found = {moved, k, linear.reach[k].coordinate};
  }
  if (found.coordinate < 0) return std::nullopt;
  return found;
}

Eigen::VectorXd uneven_motion(const System& system, const LinearSystem& linear) {
  const auto states = static_cast<Eigen::Index>(linear.model.states.size());
  if (linear.reach.size() == linear.model.states.size()) {
    Eigen::VectorXcd direction = Eigen::VectorXcd::Zero(states);
    double share = 1;
    for (std::size_t k = 0; k < linear.kinematic_states; ++k) {
      if (linear.model.states[k].is_rate) continue;
      if (const double size = linear.reach[k].size; size > 0) direction(static_cast<Eigen::Index>(k)) = share / size;
      share *= -std::numbers::phi / 2;
    }
    return linear.displacements(direction).col(0).real();
  }
  const Displacements T(system, linear);
  Eigen::VectorXd moved = T.of(arbitrary_vector(states, 1).real());
  if (moved.size() == 0) return moved;
  if (const double most = moved.cwiseAbs().maxCoeff(); most > 0) moved /= most;
  for (std::int32_t c = 0; c < moved.size(); ++c) moved(c) *= system.coordinate_scale(c);
  return moved;
}

}  // namespace dynalin
