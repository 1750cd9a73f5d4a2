#include "linear/linear_system.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/blas_threads.h"
#include "linear/balanced.h"
#include "linear/configuration.h"
#include "perturbation/perturbation.h"
#include "perturbation/perturbed_point.h"
#include "structural_zeros/structural_zeros.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

// All partials are finite, so what is not has grown too large: by what of what.
std::string overflown(const StateSpace& m) {
  const auto state = [&](Eigen::Index k) {
    const StateLabel& s = m.states[static_cast<std::size_t>(k)];
    return fmt::format("{} of {}", s.text, s.owner.text());
  };
  const auto look = [](const DenseMatrix& matrix, const auto& row, const auto& column) -> std::string {
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
        if (!std::isfinite(matrix(r, c)))
          return fmt::format("the derivative of {} by {} is too large for a number", row(r), column(c));
      }
    }
    return {};
  };
  const auto rate = [&](Eigen::Index k) { return "the rate of state " + state(k); };
  const auto input = [&](Eigen::Index k) { return m.inputs[static_cast<std::size_t>(k)].text; };
  const auto output = [&](Eigen::Index k) { return m.outputs[static_cast<std::size_t>(k)].text; };
  std::string found = look(m.A, rate, state);
  if (found.empty()) found = look(m.B, rate, input);
  if (found.empty()) found = look(m.C, output, state);
  if (found.empty()) found = look(m.D, output, input);
  return found;
}

// Entries that are zero in exact arithmetic come out as rounding. What is below the rounding of its own sum and of no
// weight beside the rest of a balanced matrix is zero; near singular constraints the first alone would take entries
// that matter.
Matrix without_rounding(Matrix A, const Matrix& rounding) {
  const Matrix compared = balanced(A).matrix;
  const double least = 1e-13 * compared.norm();
  return (A.array().abs() <= rounding.array() && compared.array().abs() <= least).select(0.0, A);
}

// Of unit columns of states.
std::vector<StateReach> reach_of(const System& system, const Perturbation& p, const Matrix& dq, const Matrix& dqdot) {
  std::vector<StateReach> reach(p.model.states.size());
  for (std::size_t k = 0; k < p.kinematic_states; ++k) {
    const Matrix& moved = p.model.states[k].is_rate ? dqdot : dq;
    for (std::int32_t c = 0; c < moved.rows(); ++c) {
      const double size = std::abs(moved(c, static_cast<Eigen::Index>(k))) / system.coordinate_scale(c);
      if (size > reach[k].size) reach[k] = {size, c};
    }
  }
  return reach;
}

}  // namespace

Result<LinearSystem> reduce(const System& system, Perturbation perturbation) {
  const OneBlasThread alone;  // no digit depends on how many there are
  LinearSystem out;
  static_cast<Perturbation&>(out) = std::move(perturbation);
  const PerturbationEquations& p = *out.equations;
  const PerturbedPoint& at = *out.at;
  StateSpace& model = out.model;
  const Eigen::Index states = p.states(), inputs = static_cast<Eigen::Index>(at.inputs.size());
  // Variations of all unknowns, by states, then inputs.
  const Matrix a = p.complete(Matrix::Identity(states + inputs, states + inputs));
  const Matrix rates = p.state_matrices(a), outputs = at.outputs_of(p, a);
  out.reach = reach_of(system, out, a.topRows(p.coordinates()), a.middleRows(p.rates(), p.coordinates()));
  auto roundings = p.roundings(a, PerturbationEquations::sizes(system, at));
  out.rounding = std::move(roundings.of_sums);
  out.uncertainty = std::move(roundings.of_coefficients);
  out.A = rates.leftCols(states);
  model.B = rates.rightCols(inputs);
  model.C = outputs.leftCols(states);
  model.D = outputs.rightCols(inputs);
  out.pencil = out.equations;
  if (at.without_damping && at.without_rate_coupling) {
    for (std::size_t k = 0; k < out.kinematic_states; ++k) {
      if (model.states[k].is_rate)
        out.A.col(static_cast<Eigen::Index>(k)).tail(static_cast<Eigen::Index>(out.differential_states)).setZero();
    }
    // No sparse equations have this block missing; what remains is the matrix itself.
    out.pencil = std::make_shared<const PerturbationEquations>(PerturbationEquations::of_state_matrix(out.A));
    out.beside_coefficients = out.uncertainty;
  }
  model.A = without_rounding(out.A, out.rounding);
  if (const std::string overflow = overflown(model); !overflow.empty())
    return tl::unexpected(Failure{"linear analysis", overflow, {}, "overflow"});
  out.structural_zeros = std::make_shared<const StructuralZeros>(system, out);
  return out;
}

namespace {

// A point with other accelerations of freedoms without mass, and velocities of condensed ones: they are not known.
OperatingPoint with_other_motion(const System& system, const OperatingPoint& op, const MasslessLimit& limit) {
  double fastest = 0, most = norm(system.model().gravity);
  for (const double v : op.velocity) fastest = std::max(fastest, std::abs(v));
  for (const double a : op.acceleration) most = std::max(most, std::abs(a));
  most = std::max(most, fastest * fastest);
  OperatingPoint other = op;
  const Eigen::VectorXd a = limit.directions.basis.rowwise().sum() * (most > 0 ? most : 1.0);
  const Eigen::VectorXd v = limit.condensed_directions().rowwise().sum() * (fastest > 0 ? fastest : 1.0);
  for (std::size_t k = 0; k < other.velocity.size(); ++k) {
    other.acceleration[k] += a(static_cast<Eigen::Index>(k));
    other.velocity[k] += v(static_cast<Eigen::Index>(k));
  }
  return other;
}

std::string names_of(const NearSingularity& near) {
  constexpr std::size_t most = 6;
  const std::vector<std::string> first(
      near.rows.begin(), near.rows.begin() + static_cast<std::ptrdiff_t>(std::min(most, near.rows.size())));
  return fmt::format("{}{}", fmt::join(first, ", "), near.rows.size() > most ? " and others" : "");
}

std::string names_of(const System& system, const std::vector<std::int32_t>& rows) {
  NearSingularity named;
  for (const std::int32_t r : rows) named.rows.push_back(system.row_text(r));
  return names_of(named);
}

// The linear model must not depend on what is not known of the motion of freedoms without mass.
bool same_model(const LinearSystem& one, const LinearSystem& other) {
  constexpr double same_entries = 1e-9;
  const auto differs = [&](const DenseMatrix& a, const DenseMatrix& b) {
    return a.rows() != b.rows() || a.cols() != b.cols() ||
           (a.size() > 0 && ((a - b).array().abs() > same_entries * (a.cwiseAbs() + b.cwiseAbs()).maxCoeff()).any());
  };
  return one.A.rows() == other.A.rows() &&
         ((one.A - other.A).array().abs() <= 1e3 * (one.rounding + other.rounding).array()).all() &&
         !differs(one.model.B, other.model.B) && !differs(one.model.C, other.model.C);
}

// Whether constraints are left out that are not quite redundant: refused where the model has more freedoms for it than
// beside this point, a warning elsewhere.
Result<void> look_at_near_dependence(const System& system, OperatingPoint op, LinearSystem& linear) {
  op.mode = AnalysisMode::linear;
  const NearDependence near = near_dependence(system, op, linear.at->choice);
  linear.left_out = near.left_out;
  if (!(near.distance > 0)) return {};
  if (const auto gained = freedoms_gained(system, op, linear)) {
    return tl::unexpected(Failure{
        "linear analysis",
        fmt::format("the configuration is too near a singular one: {} all but depend{} on other constraints (relative "
                    "distance below {:.0e}) and would leave {} more degree{} of freedom than right beside this point",
                    names_of(system, gained->rows), gained->rows.size() == 1 ? "s" : "", near.distance, gained->count,
                    gained->count == 1 ? "" : "s"),
        {},
        "too-near-singular"});
  }
  linear.warnings.warning(
      "constraint-left-out", system.layout().rows[static_cast<std::size_t>(near.rows.front())].owner->at,
      fmt::format("{} depend{} on other constraints but for less than {:.0e} of {} size, and {} left out as redundant",
                  names_of(system, near.rows), near.rows.size() == 1 ? "s" : "", near.distance,
                  near.rows.size() == 1 ? "its" : "their", near.rows.size() == 1 ? "is" : "are"));
  return {};
}

Result<LinearSystem> unreduced(const System& system, const OperatingPoint& op, Perturbation perturbation) {
  LinearSystem linear;
  static_cast<Perturbation&>(linear) = std::move(perturbation);
  if (auto looked = look_at_near_dependence(system, op, linear); !looked) return tl::unexpected(looked.error());
  return linear;
}

// Some things are seen in the state matrix alone: whether freedoms without mass that move have a linear model, and the
// block that the original implementation takes out of it.
bool needs_state_matrix(const Perturbation& p) {
  if (p.at->massless && !p.at->massless->at_rest) return true;
  return p.at->without_damping && p.at->without_rate_coupling && p.differential_states > 0;
}

}  // namespace

Result<LinearSystem> linearize_unreduced(const System& system, OperatingPoint op, const LinearOptions& options) {
  auto perturbation = perturb(system, op, options);
  if (!perturbation) return tl::unexpected(perturbation.error());
  return unreduced(system, op, std::move(*perturbation));
}

Result<LinearSystem> linearize(const System& system, OperatingPoint op, const LinearOptions& options,
                               std::size_t up_to) {
  const auto at = [&](const OperatingPoint& point) -> Result<LinearSystem> {
    auto perturbation = perturb(system, point, options);
    if (!perturbation) return tl::unexpected(perturbation.error());
    return reduce(system, std::move(*perturbation));
  };
  auto perturbation = perturb(system, op, options);
  if (!perturbation) return tl::unexpected(perturbation.error());
  if (perturbation->model.states.size() > up_to && !needs_state_matrix(*perturbation))
    return unreduced(system, op, std::move(*perturbation));
  auto linear = reduce(system, std::move(*perturbation));
  if (!linear) return linear;
  if (const auto& massless = linear->at->massless; massless && !massless->at_rest) {
    const MasslessLimit& limit = massless->limit;
    Findings ignored;
    auto other = solve_acceleration(system, with_other_motion(system, op, limit), ignored);
    if (!other) return tl::unexpected(other.error());
    const auto second = at(*other);
    if (!second || !same_model(*linear, *second)) {
      return tl::unexpected(
          Failure{"limit of vanishing mass",
                  fmt::format("the linear model depends on accelerations of freedoms without mass "
                              "({}), which are known at rest only",
                              names_of(system, limit.directions, Matrix::Identity(limit.count(), limit.count()))),
                  {},
                  "massless-motion"});
    }
  }
  if (auto looked = look_at_near_dependence(system, op, *linear); !looked) return tl::unexpected(looked.error());
  op.mode = AnalysisMode::linear;
  const Matrix of_velocities = rounding_of_velocities(system, op, *linear, at);
  if (of_velocities.size() == 0) return linear;
  linear->uncertainty += of_velocities;
  if (linear->beside_coefficients.size() > 0) {
    linear->beside_coefficients += of_velocities;
  } else {
    linear->beside_coefficients = of_velocities;
  }
  const NearSingularity& near = linear->near_singularity;
  constexpr double worth_a_warning = 1e-6, worth_a_look = 1e-3, too_near_singular = 1e-7;
  // So near that accelerations, too, are lost in their own rounding, what velocities make of them tells nothing.
  const bool lost = near.distance < too_near_singular && relative_size(system, op, *linear, linear->rounding) > 10;
  if (lost || !(relative_size(system, op, *linear, of_velocities) < 1)) {
    return tl::unexpected(
        Failure{"linear analysis",
                fmt::format("the configuration is too near a singular one: {} all but depend on each other (relative "
                            "distance {:.1e}), and rounding of the velocities alone decides about the state matrix",
                            names_of(near), near.distance),
                {},
                "too-near-singular"});
  }
  // Elsewhere a state matrix may be nothing but rounding: that of a disc that turns freely.
  const Matrix& unknown = near.distance < worth_a_look ? linear->uncertainty : of_velocities;
  if (const double part = relative_size(system, op, *linear, unknown); part > worth_a_warning) {
    linear->warnings.warning(
        "near-singular", {},
        fmt::format("near a singular configuration: {} all but depend on each other (relative distance {:.1e}); "
                    "rounding changes the state matrix by {:.0e} of its size, which the error bounds "
                    "of the eigenvalues hold",
                    names_of(near), near.distance, part));
  }
  return linear;
}

}  // namespace dynalin
