#include "modal/modal_sums.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/clearly_larger.h"
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

// What the table of coordinates shows of each mode: mass centres and rotations of all bodies, differential states.
ComplexMatrix table_entries(const System& system, const OperatingPoint& op, const EigenSolution& modes,
                            const ComplexMatrix& displacement) {
  const Layout& layout = system.layout();
  std::vector<Eigen::RowVectorXcd> rows;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    ComplexMatrix of = displacement.middleRows(block.offset, block.count);
    if (block.turns()) {
      const Matrix3 arm = skew(op.poses[b].R * system.model().bodies[b].p_BC);
      for (Index i = 0; i < 3; ++i) {
        for (Index j = 0; j < 3; ++j)
          of.row(i) -= arm(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) * of.row(3 + j);
      }
    }
    for (Index i = 0; i < of.rows(); ++i) rows.push_back(of.row(i));
  }
  for (Index k = modes.vectors.rows() - static_cast<Index>(modes.differential_states); k < modes.vectors.rows(); ++k)
    rows.push_back(modes.vectors.row(k));
  ComplexMatrix out(static_cast<Index>(rows.size()), displacement.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) out.row(static_cast<Index>(k)) = rows[k];
  return out;
}

// Modal coordinates of flexible bodies and of beams, which are in no table.
ComplexMatrix entries_beside(const System& system, const ComplexMatrix& displacement) {
  std::vector<Index> rows;
  for (const ExtraBlock& e : system.layout().extras) {
    if (!e.is_deformation()) continue;
    for (Index k = e.offset; k < e.offset + e.count; ++k) rows.push_back(k);
  }
  return displacement(rows, Eigen::all);
}

// The first of entries that are equally large but for rounding.
Complex largest_entry(const Eigen::VectorXcd& entries) {
  Complex largest = 0;
  for (const Complex& v : entries) {
    if (is_clearly_larger(std::abs(v), std::abs(largest))) largest = v;
  }
  return largest;
}

// Equal eigenvalues, or what cannot be told from them, have vectors of any basis of their space.
bool are_equal(const EigenMode& a, const EigenMode& b) {
  constexpr double equal = 1e-9;  // to which eigensolutions take values for equal
  return std::abs(a.eigenvalue_hz - b.eigenvalue_hz) <=
         equal * std::abs(b.eigenvalue_hz) + a.error_bound_hz + b.error_bound_hz;
}

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
      out.Phi_.col(c) = modes.vectors(position, k) / shapes.col(k).norm();
    }
    out.lu_.compute(out.unit_.cast<Complex>().asDiagonal() * out.Phi_);
    return out;
  }

  // Mode by mode of Φ.
  const std::vector<std::size_t>& modes() const { return chosen_; }
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
  ComplexMatrix Phi_;
  Eigen::FullPivLU<ComplexMatrix> lu_;
};

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
  const Matrix B = root.of(linear.velocities(Matrix::Identity(states, states)(Eigen::all, rate)).real());
  const Matrix M = B.transpose() * B;
  const auto along = along_states(system, linear, position, DampingOfForces::as_linearized);
  if (!along) return tl::unexpected(along.error());
  const Matrix &C = along->C, &K = along->K;
  const StateMotion at_point = motion_of_states(op, linear.at->choice, position);
  const auto x = displacement_from_rest(system, linear, position, *along, at_point);
  if (!x) return tl::unexpected(x.error());
  const auto modal = ModalCoordinates::make(linear, modes, position, M);
  if (!modal) return tl::unexpected(modal.error());
  const Eigen::VectorXcd eta = modal->of(*x), eta_rate = modal->of(at_point.rate);
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

ModalMasses modal_masses(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                         const EigenSolution& modes, MarkerId frame) {
  Vector origin{};
  Matrix3 axes = Matrix3::identity();
  if (frame.valid()) {
    const MarkerPlace& place = system.layout().marker(system.signals().place_of(frame));
    const Motion motion = system.motion(op);
    origin = motion.point(place), axes = motion.axes(place);
  }
  const MassRoot root(system, op);
  const Matrix rigid = root.of_rigid_motion(origin, axes);
  const ComplexMatrix displacement = linear.displacements(modes.vectors);
  ComplexMatrix shapes(rigid.rows(), displacement.cols());
  shapes.real() = root.of(displacement.real());
  shapes.imag() = root.of(displacement.imag());
  ComplexMatrix entries = table_entries(system, op, modes, displacement);
  ComplexMatrix beside = entries_beside(system, displacement);

  ModalMasses out;
  for (Index d = 0; d < 6; ++d) out.total[static_cast<std::size_t>(d)] = rigid.col(d).squaredNorm();
  out.modes.resize(modes.modes.size());
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const auto at = static_cast<Index>(k);
    const double before = shapes.col(at).norm();
    for (int twice = 0; twice < 2; ++twice) {
      for (std::size_t j = 0; j < k; ++j) {
        if (!are_equal(modes.modes[j], modes.modes[k])) continue;
        const auto other = shapes.col(static_cast<Index>(j));
        if (!(other.squaredNorm() > 0)) continue;
        const Complex part = other.dot(shapes.col(at)) / other.squaredNorm();
        shapes.col(at) -= other * part;
        entries.col(at) -= entries.col(static_cast<Index>(j)) * part;
        beside.col(at) -= beside.col(static_cast<Index>(j)) * part;
      }
    }
    // Where a body bends and none moves, its modal coordinates are all that there is.
    constexpr double moving_part = 1e-9;
    Complex largest = largest_entry(entries.col(at));
    const Complex bending = largest_entry(beside.col(at));
    if (std::abs(largest) <= moving_part * std::abs(bending)) largest = bending;
    ModalMasses::Row& row = out.modes[k];
    if (!(shapes.col(at).norm() > 1e-7 * before) || largest == Complex(0)) {
      row.kind = before > 0 ? ModalMasses::Row::Kind::repeated : ModalMasses::Row::Kind::still;
      shapes.col(at).setZero();
      continue;
    }
    shapes.col(at) /= largest;
    entries.col(at) /= largest, beside.col(at) /= largest;
    row.generalized = shapes.col(at).squaredNorm();
    // Beside the largest that a motion of this size can have, what rounding makes of a sum that is zero: of motions in
    // this direction that cancel, and of one that is all there is in it and is rounding itself.
    const double rounding =
        std::min(1e-8, std::max(64.0, modes.modes[k].condition) * std::numeric_limits<double>::epsilon());
    for (Index d = 0; d < 6; ++d) {
      const Complex L = shapes.col(at).dot(rigid.col(d).cast<Complex>());
      if (std::abs(L) <= rounding * shapes.col(at).norm() * rigid.col(d).norm()) continue;
      row.participation[static_cast<std::size_t>(d)] = L / row.generalized;
      row.effective[static_cast<std::size_t>(d)] = std::norm(L) / row.generalized;
    }
  }
  return out;
}

}  // namespace dynalin
