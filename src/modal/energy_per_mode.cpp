#include "modal/energy_per_mode.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "linear/balanced.h"
#include "linear/physical_matrices.h"
#include "modal/mass_root.h"
#include "perturbation/perturbed_point.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using Index = Eigen::Index;

ComplexMatrix times(const Matrix& m, const ComplexMatrix& x) {
  ComplexMatrix out(m.rows(), x.cols());
  out.real() = m * x.real();
  out.imag() = m * x.imag();
  return out;
}

// The square of an amplitude that is rounding beside that of another mode.
constexpr double unexcited = 1e-24;
// Of the model's length, what a mode that is at rest may move by: rounding of places.
constexpr double rounding_of_rest = 1e-13;

// Places of coordinates and of their rates among the states; empty where a coordinate has no rate.
std::pair<std::vector<Index>, std::vector<Index>> pairs_of(const LinearSystem& linear) {
  std::vector<Index> position, rate;
  for (std::size_t k = 0; k < linear.kinematic_states; ++k) {
    (linear.model.states[k].is_rate ? rate : position).push_back(static_cast<Index>(k));
  }
  return {position, rate};
}

// C, K and what is taken from accelerations, of the states that are coordinates [user mass].
struct AlongStates {
  Matrix M, C, K;
};

// Coordinates without mass that follow from a balance of forces are no states: they go along with those that are,
// x = T s, x′ = T s′ + T′ s, in the physical matrices and from the left, where their balance vanishes.
Result<AlongStates> along_states(const System& system, const LinearSystem& linear, const std::vector<Index>& position,
                                 DampingOfForces damping) {
  auto physical = PhysicalEquations::make(system, linear, damping);
  if (!physical) return tl::unexpected(physical.error());
  const MotionMap& Q = physical->whole().force;
  const double factor = system.model().units.ucf;
  if (!linear.has_massless_states)
    return AlongStates{factor * Q.of_accelerations, factor * Q.of_rates, factor * Q.of_coordinates};
  const auto states = static_cast<Index>(linear.model.states.size());
  const Eigen::MatrixXcd unit = Matrix::Identity(states, states)(Eigen::all, position).cast<Complex>();
  const Matrix dq = linear.displacements(unit).real(), dqdot = linear.velocities(unit).real();
  const std::vector<std::vector<StateChoice::Entry>>& gradient = linear.at->with_massless->gradient;
  Matrix T = Matrix::Zero(static_cast<Index>(gradient.size()), dq.cols()), T_rate = T;
  for (std::size_t k = 0; k < gradient.size(); ++k) {
    for (const StateChoice::Entry& e : gradient[k]) {
      T.row(static_cast<Index>(k)) += e.c.g * dq.row(e.column);
      T_rate.row(static_cast<Index>(k)) += e.c.g * dqdot.row(e.column) + e.c.v * dq.row(e.column);
    }
  }
  const Matrix left = factor * T.transpose();
  return AlongStates{left * Q.of_accelerations * T, left * Q.of_rates * T,
                     left * (Q.of_coordinates * T + Q.of_rates * T_rate)};
}

// Rates and accelerations at the point of the states that are coordinates.
struct StateMotion {
  Eigen::VectorXd rate, acceleration;
};
StateMotion motion_of_states(const OperatingPoint& op, const StateChoice& choice, const std::vector<Index>& position) {
  const auto n = static_cast<Index>(position.size());
  StateMotion motion{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (std::size_t k = 0; k < choice.coordinates.size(); ++k) {
    const auto at = std::ranges::find(position, static_cast<Index>(choice.position_state[k]));
    if (at == position.end()) continue;
    double& rate = motion.rate(at - position.begin());
    double& acceleration = motion.acceleration(at - position.begin());
    if (const auto& x = choice.along_motion[k]) {
      rate = x->rate, acceleration = x->acceleration;
      continue;
    }
    for (const StateChoice::Entry& e : choice.gradient[k]) {
      const auto q = static_cast<std::size_t>(e.column);
      rate += e.c.g * op.velocity[q];
      acceleration += e.c.g * op.acceleration[q] + e.c.v * op.velocity[q];
    }
  }
  return motion;
}

// Of each mode 1/|yᴴx| as EigenMode::condition has it, with states in units in which A is balanced: in others it may be
// any number.
Eigen::VectorXd balanced_conditions(const LinearSystem& linear, const EigenSolution& modes) {
  const Eigen::VectorXcd units = balanced(linear.A).scale.cwiseInverse().cast<Complex>();
  const auto conjugates = static_cast<Index>(std::ranges::count(modes.modes, false, &EigenMode::is_real));
  const Index count = modes.vectors.cols();
  ComplexMatrix all(modes.vectors.rows(), count + conjugates);
  all.leftCols(count) = modes.vectors;
  for (Index k = 0, at = count; k < count; ++k) {
    if (!modes.modes[static_cast<std::size_t>(k)].is_real) all.col(at++) = modes.vectors.col(k).conjugate();
  }
  all = units.asDiagonal() * all;
  all.colwise().normalize();
  // Left vectors are rows of the inverse.
  return all.completeOrthogonalDecomposition().pseudoInverse().rowwise().norm().head(count);
}

// Numbers of modes whose shapes span the coordinates, vibrations before real modes. A shape that differs from earlier
// ones by no more than rounding of A may have made of it, 1/condition being how near A is to a defective matrix, adds
// nothing.
std::vector<std::size_t> spanning(const LinearSystem& linear, const EigenSolution& modes, const ComplexMatrix& shapes) {
  constexpr double part_of_its_own = 1e-7, unit = 64 * std::numeric_limits<double>::epsilon();
  std::vector<std::size_t> order, chosen;
  for (const bool real : {false, true}) {
    for (std::size_t k = 0; k < modes.modes.size(); ++k) {
      if (modes.modes[k].is_real == real) order.push_back(k);
    }
  }
  std::optional<Eigen::VectorXd> conditions;  // where the unbalanced ones decide
  const auto uncertain = [&](std::size_t k, double beside) {
    if (modes.modes[k].structural_zero || beside > unit * modes.modes[k].condition) return false;
    if (!conditions) conditions = balanced_conditions(linear, modes);
    return !(beside > unit * (*conditions)(static_cast<Index>(k)));
  };
  ComplexMatrix basis(shapes.rows(), 0);
  for (const std::size_t k : order) {
    if (basis.cols() == shapes.rows()) break;
    const double size = shapes.col(static_cast<Index>(k)).norm();
    if (!(size > 0)) continue;
    Eigen::VectorXcd v = shapes.col(static_cast<Index>(k)) / size;
    for (int twice = 0; twice < 2; ++twice) v -= basis * (basis.adjoint() * v).eval();
    const double beside = v.norm();
    if (!(beside > part_of_its_own) || uncertain(k, beside)) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = v.normalized();
    chosen.push_back(k);
  }
  return chosen;
}

tl::unexpected<Failure> no_modal_energy(std::string why) {
  return tl::unexpected(Failure{"energies per mode", std::move(why), {}, "no-modal-energy"});
}

// x of the states that are coordinates, from where the linear model would rest: K x = −(M x″ + C x′).
Result<Eigen::VectorXd> displacement_from_rest(const System& system, const LinearSystem& linear,
                                               const std::vector<Index>& position, const AlongStates& along,
                                               const StateMotion& at_point) {
  // The accelerations are those of all forces, also where the linear model leaves their damping out.
  Eigen::VectorXd balance = along.M * at_point.acceleration;
  if (linear.at->without_damping) {
    const auto damped = along_states(system, linear, position, DampingOfForces::whole);
    if (!damped) return tl::unexpected(damped.error());
    balance += damped->C * at_point.rate;
  } else {
    balance += along.C * at_point.rate;
  }
  return Eigen::VectorXd(along.K.completeOrthogonalDecomposition().solve(-balance));
}

// η of Φ η = x, with as many modes as there are coordinates.
class ModalCoordinates {
 public:
  // Rows by the root of their mass, so that lengths and angles compare. Fails where shapes do not span the coordinates.
  static Result<ModalCoordinates> make(const LinearSystem& linear, const EigenSolution& modes,
                                       const std::vector<Index>& position, const Matrix& M) {
    ModalCoordinates out;
    out.unit_ = M.diagonal().cwiseSqrt().unaryExpr([](double m) { return m > 0 ? m : 1.0; });
    const ComplexMatrix shapes = out.unit_.cast<Complex>().asDiagonal() * modes.vectors(position, Eigen::all);
    out.chosen_ = spanning(linear, modes, shapes);
    const auto n = static_cast<Index>(position.size());
    if (static_cast<Index>(out.chosen_.size()) < n) {
      return no_modal_energy(fmt::format(
          "the modal matrix is singular: the shapes of all modes span {} of {} coordinates", out.chosen_.size(), n));
    }
    // Shapes of like size: what a controller moves beside its own states may be small in any unit, and is no rounding.
    out.Phi_.resize(n, n);
    for (Index c = 0; c < n; ++c) {
      const auto k = static_cast<Index>(out.chosen_[static_cast<std::size_t>(c)]);
      out.sizes_.push_back(shapes.col(k).norm());
      out.Phi_.col(c) = modes.vectors(position, k) / out.sizes_.back();
    }
    out.lu_.compute(out.unit_.cast<Complex>().asDiagonal() * out.Phi_);
    return out;
  }

  // Mode by mode of Φ.
  const std::vector<std::size_t>& modes() const { return chosen_; }
  // Of the eigenvector that is one of Φ.
  double size(std::size_t i) const { return sizes_[i]; }
  Eigen::VectorXcd of(const Eigen::VectorXd& x) const {
    return lu_.solve(Eigen::VectorXcd(unit_.cwiseProduct(x).cast<Complex>()));
  }
  // e_iᴴ Σ_j (ΦᴴmΦ)_ij e_j
  double share(const Matrix& m, const Eigen::VectorXcd& e, Index i) const {
    return std::real(std::conj(e(i)) * Phi_.col(i).dot(times(m, Phi_ * e).col(0)));
  }

 private:
  ModalCoordinates() = default;

  Eigen::VectorXd unit_;
  std::vector<std::size_t> chosen_;
  std::vector<double> sizes_;
  ComplexMatrix Phi_;
  Eigen::FullPivLU<ComplexMatrix> lu_;
};

// Amplitudes of modes that move nothing, and of those that do so at no speed: rounding of the operating point.
void drop_rest(const System& system, const LinearSystem& linear, const EigenSolution& modes,
               const ModalCoordinates& modal, Eigen::VectorXcd& eta, Eigen::VectorXcd& eta_rate) {
  const ComplexMatrix displacement = linear.displacements(modes.vectors);
  for (std::size_t i = 0; i < modal.modes().size(); ++i) {
    const std::size_t mode = modal.modes()[i];
    double way = 0;  // as a part of the model's length, where the amplitude is 1
    for (Index k = 0; k < displacement.rows(); ++k)
      way = std::max(way, std::abs(displacement(k, static_cast<Index>(mode))) /
                              system.coordinate_scale(static_cast<std::int32_t>(k)));
    way /= modal.size(i);
    const double frequency = 2 * std::numbers::pi * std::abs(modes.modes[mode].eigenvalue_hz);
    const auto at = static_cast<Index>(i);
    if (std::abs(eta(at)) * way <= rounding_of_rest) eta(at) = 0;
    if (std::abs(eta_rate(at)) * way <= rounding_of_rest * frequency) eta_rate(at) = 0;
  }
}

// Shares that are rounding beside those of other modes.
void drop_unexcited(std::vector<EnergyPerMode::Share>& modes) {
  using Share = EnergyPerMode::Share;
  for (double Share::*of : {&Share::kinetic, &Share::potential, &Share::power}) {
    double size = 0;
    for (const Share& s : modes) size += std::abs(s.*of);
    for (Share& s : modes) {
      if (std::abs(s.*of) <= unexcited * size) s.*of = 0;
    }
  }
}

}  // namespace

Result<EnergyPerMode> energy_per_mode(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                                      const EigenSolution& modes) {
  const auto [position, rate] = pairs_of(linear);
  if (linear.first_order > 0) {
    return no_modal_energy(
        "a model with coordinates of first order, of freedoms that have damping and no mass, has fewer rates than "
        "coordinates: its shapes do not share out its energy");
  }
  if (position.size() != rate.size()) {
    return no_modal_energy(
        "a model with velocity constraints has fewer rates than coordinates: its shapes do not share out its energy");
  }
  const auto n = static_cast<Index>(position.size()), states = static_cast<Index>(linear.model.states.size());
  EnergyPerMode out;
  out.modes.resize(modes.modes.size());
  out.counted.assign(modes.modes.size(), false);
  if (n == 0) return out;  // differential states alone
  const MassRoot root(system, op);
  const Matrix B =
      root.of(linear.velocities(Matrix::Identity(states, states)(Eigen::all, rate).cast<Complex>()).real());
  const Matrix M = B.transpose() * B;
  const auto along = along_states(system, linear, position, DampingOfForces::as_linearized);
  if (!along) return tl::unexpected(along.error());
  const Matrix &C = along->C, &K = along->K;
  const StateMotion at_point = motion_of_states(op, linear.at->choice, position);
  const auto x = displacement_from_rest(system, linear, position, *along, at_point);
  if (!x) return tl::unexpected(x.error());
  const auto modal = ModalCoordinates::make(linear, modes, position, M);
  if (!modal) return tl::unexpected(modal.error());
  Eigen::VectorXcd eta = modal->of(*x), eta_rate = modal->of(at_point.rate);
  drop_rest(system, linear, modes, *modal, eta, eta_rate);
  out.at_rest = eta_rate.isZero(0);
  for (Index i = 0; i < n; ++i) {
    const std::size_t mode = modal->modes()[static_cast<std::size_t>(i)];
    EnergyPerMode::Share& s = out.modes[mode];
    s.kinetic = 0.5 * modal->share(M, eta_rate, i);
    s.potential = 0.5 * modal->share(K, eta, i);
    s.power = modal->share(C, eta_rate, i);
    out.counted[mode] = true;
    out.total.kinetic += s.kinetic, out.total.potential += s.potential, out.total.power += s.power;
  }
  drop_unexcited(out.modes);
  return out;
}

}  // namespace dynalin
