#include "linear/linear_system.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "elements/controls/variable_list.h"
#include "linear/balanced.h"
#include "linear/configuration.h"
#include "linear/massless_states.h"
#include "linear/perturbation.h"
#include "linear/state_choice.h"
#include "linear/structural_zeros.h"
#include "linear/undefined_partials.h"
#include "system/undefined_rows.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

class Linearizer {
 public:
  Linearizer(const System& system, const OperatingPoint& op, const LinearOptions& options)
      : system_(system), layout_(system.layout()), options_(options), op_(op), motion_(system.motion(op)) {
    rows_.resize(layout_);
    eq_.resize(layout_);
    eq_.keep_sizes();
    eq_.note_elements(&trace_);
  }

  Result<LinearSystem> run() {
    system_.constraints(motion_, rows_);
    system_.equations(motion_, rows_, eq_,
                      {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::acceleration,
                       PartialBy::lambda, PartialBy::algebraic, PartialBy::state, PartialBy::state_rate});
    if (const auto undefined = undefined_row(system_, motion_, rows_)) return refusal(*undefined);
    auto choice = choose_states(system_, motion_, rows_, options_);
    if (!choice) return tl::unexpected(choice.error());
    result_.model.time = op_.time;
    result_.principal_states = options_.principal_states && !options_.rm.valid();
    result_.warnings = choice->warnings;
    result_.near_singularity = near_singularity(system_, rows_, *choice);
    read_channels();
    const UndefinedPartials undefined(system_, motion_, eq_, inputs_, outputs_, options_.without_damping);
    if (auto taken = take_massless(*choice); !taken) return tl::unexpected(undefined.failure().value_or(taken.error()));
    if (massless_) {
      if (auto failure = undefined.failure_in_balances(massless_->limit.left))
        return tl::unexpected(std::move(*failure));
    }
    result_.model.states = choice->states;
    result_.scales = choice->scales;
    for (std::size_t k = 0; k < choice->coordinates.size(); ++k) {
      if (choice->has_position[k]) result_.coordinates.push_back(choice->coordinates[k].label);
    }
    result_.kinematic_states = static_cast<std::size_t>(choice->first_differential);
    result_.model.kinematic_states = result_.kinematic_states;
    result_.differential_states = choice->differential.size();
    auto equations = PerturbationEquations::make(system_, motion_, rows_, eq_, *choice, inputs_,
                                                 options_.without_damping, massless_ ? &*massless_ : nullptr);
    if (!equations) return tl::unexpected(undefined.failure().value_or(equations.error()));
    const Matrix a = variations(*equations);
    if (auto failure = undefined.failure(*equations, *choice, a)) return tl::unexpected(std::move(*failure));
    if (const std::string open = open_output(*equations); !open.empty()) {
      return tl::unexpected(Failure{
          "limit of vanishing mass",
          fmt::format("{} reads a rate or an acceleration of a freedom without mass, which depends on derivatives that "
                      "the linear model does not have{}",
                      open, massless_->at_rest ? "" : ": that is possible at rest only"),
          {}});
    }
    reduce(std::make_shared<const PerturbationEquations>(std::move(*equations)), a);
    if (const std::string overflow = overflown(); !overflow.empty()) return refusal(overflow);
    result_.structural_zeros = std::make_shared<const StructuralZeros>(
        system_, motion_, std::move(rows_), trace_, eq_, *choice, result_, options_.without_damping,
        massless_ ? massless_->limit.directions.coordinate : std::vector<std::int32_t>());
    return std::move(result_);
  }

  // Whether accelerations of freedoms without mass, and velocities of condensed ones, are not known at the point.
  bool leaves_motion_open() const { return massless_ && !massless_->at_rest; }
  OperatingPoint with_other_motion() const {
    const MasslessLimit& limit = massless_->limit;
    double fastest = 0, most = norm(system_.model().gravity);
    for (const double v : op_.velocity) fastest = std::max(fastest, std::abs(v));
    for (const double a : op_.acceleration) most = std::max(most, std::abs(a));
    most = std::max(most, fastest * fastest);
    OperatingPoint other = op_;
    const Eigen::VectorXd a = limit.directions.basis.rowwise().sum() * (most > 0 ? most : 1.0);
    const Eigen::VectorXd v = limit.condensed_directions().rowwise().sum() * (fastest > 0 ? fastest : 1.0);
    for (std::size_t k = 0; k < other.velocity.size(); ++k) {
      other.acceleration[k] += a(static_cast<Eigen::Index>(k));
      other.velocity[k] += v(static_cast<Eigen::Index>(k));
    }
    return other;
  }
  std::string massless_names() const {
    const Eigen::Index k = massless_->limit.count();
    return names_of(system_, massless_->limit.directions, Matrix::Identity(k, k));
  }

 private:
  Result<void> take_massless(StateChoice& choice) {
    if (!lacks_mass(system_)) return {};
    std::vector<bool> cut(layout_.algebraic.size(), false);
    for (const std::int32_t u : inputs_) cut[static_cast<std::size_t>(u)] = true;
    auto limit = massless_limit(system_, motion_, rows_, eq_, {choice.velocity_active, cut, options_.without_damping});
    if (!limit) return tl::unexpected(limit.error());
    if (!*limit) return {};
    massless_.emplace();
    massless_->limit = std::move(**limit);
    massless_->at_rest = at_rest(system_, op_, massless_->limit.directions);
    if (auto taken = take_massless_states(system_, rows_, choice, *massless_); !taken) return taken;
    result_.warnings.append(massless_->remarks);
    result_.first_order = massless_->first_order;
    result_.has_massless_states = true;
    return {};
  }

  void read_channels() {
    const Model& model = system_.model();
    const auto read = [&](const std::optional<ElementHandle>& handle, std::vector<ChannelLabel>& labels,
                          std::vector<std::int32_t>& unknowns, std::int64_t& id) {
      if (!handle) return;
      id = model.label(*handle).id;
      for (const VariableRef v : model.get<VariableList>(*handle)->variables) {
        labels.push_back({model.label(v).id, model.label(v).text()});
        unknowns.push_back(system_.signals().variable(v).index);
      }
    };
    read(options_.pinput, result_.model.inputs, inputs_, result_.model.pinput);
    read(options_.poutput, result_.model.outputs, outputs_, result_.model.poutput);
    for (const Model::FollowedVariable& f : model.followed_in_time) {
      const std::int32_t followed = system_.signals().variable(f.variable).index;
      if (std::find(inputs_.begin(), inputs_.end(), followed) == inputs_.end()) continue;
      result_.warnings.warning(
          "followed-input", model.label(f.variable).at,
          fmt::format("{} is a plant input, and {} follows its course in time; the linear model holds the motion",
                      model.label(f.variable).full_text(), f.follower->full_text()));
    }
    for (const std::int32_t u : inputs_) {
      const AlgebraicUnknown& unknown = layout_.algebraic[static_cast<std::size_t>(u)];
      if (unknown.rate >= 0) {
        result_.warnings.warning(
            "rate-of-input", unknown.owner->at,
            fmt::format("{} is a plant input, and a DIF1 needs its time derivative, which no state-space model has: "
                        "the linear model takes it as zero",
                        unknown.owner->full_text()));
      }
      const bool depends = depends_on_anything(u);
      const double value = op_.algebraic[static_cast<std::size_t>(u)];
      if (depends || value != 0.0) {
        result_.warnings.warning(
            "dependent-input", unknown.owner->at,
            fmt::format("{} is a plant input but its own expression {}; the linear model takes it as independent. "
                        "Remove it from the "
                        "PINPUT, or put a new VARIABLE with FUNCTION=0 there and add its VARVAL to the expression",
                        layout_.algebraic[static_cast<std::size_t>(u)].owner->full_text(),
                        depends ? "depends on the state of the model" : fmt::format("has the value {:g}", value)));
      }
    }
  }

  bool depends_on_anything(std::int32_t unknown) const {
    const std::int32_t row = eq_.algebraic_row(unknown);
    for (std::size_t f = 0; f < column_families; ++f) {
      const auto family = static_cast<PartialBy>(f);
      const ColumnMatrix& m = eq_.matrix(family);
      for (std::int32_t c = 0; c < m.columns; ++c) {
        if (family == PartialBy::algebraic && c == unknown) continue;
        const auto first = m.row.begin() + m.start[static_cast<std::size_t>(c)],
                   last = m.row.begin() + m.start[static_cast<std::size_t>(c) + 1];
        const auto it = std::lower_bound(first, last, row);
        if (it != last && *it == row && m.value[static_cast<std::size_t>(it - m.row.begin())] != 0.0) return true;
      }
    }
    return false;
  }

  static tl::unexpected<Failure> refusal(std::string message) {
    return tl::unexpected(Failure{"linear analysis", std::move(message), {}});
  }

  // Of all unknowns, by states, then inputs.
  Matrix variations(const PerturbationEquations& p) const {
    const Eigen::Index columns = p.states() + static_cast<Eigen::Index>(inputs_.size());
    return p.complete(Matrix::Identity(columns, columns));
  }

  // All partials are finite, so what is not has grown too large: by what of what.
  std::string overflown() const {
    const StateSpace& m = result_.model;
    const auto state = [&](Eigen::Index k) {
      const StateLabel& s = m.states[static_cast<std::size_t>(k)];
      return fmt::format("{} of {}", s.text, s.owner.text());
    };
    const auto look = [](const Matrix& matrix, const auto& row, const auto& column) -> std::string {
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

  void reduce(std::shared_ptr<const PerturbationEquations> equations, const Matrix& a) {
    const PerturbationEquations& p = *equations;
    StateSpace& model = result_.model;
    const Eigen::Index states = p.states(), inputs = static_cast<Eigen::Index>(inputs_.size());
    const AugmentedSystem augmented(system_);
    const Eigen::Index n = p.coordinates(), first = p.augmented();
    result_.dq = a.topRows(n);
    result_.dqdot = a.middleRows(p.rates(), n);
    result_.dqddot = a.middleRows(p.accelerations(), n);
    result_.dlambda = a.middleRows(first + augmented.lambda(0), rows_.size());
    result_.dw = a.middleRows(first + augmented.algebraic(0), static_cast<Eigen::Index>(layout_.algebraic.size()));

    const Matrix rates = p.state_matrices(a);
    const Matrix outputs = outputs_of(p, a);
    result_.rounding = p.rounding(a);
    result_.A = rates.leftCols(states);
    model.B = rates.rightCols(inputs);
    model.C = outputs.leftCols(states);
    model.D = outputs.rightCols(inputs);
    if (options_.without_damping && options_.without_rate_coupling) {
      for (std::size_t k = 0; k < result_.kinematic_states; ++k) {
        if (model.states[k].is_rate)
          result_.A.col(static_cast<Eigen::Index>(k))
              .tail(static_cast<Eigen::Index>(result_.differential_states))
              .setZero();
      }
      // No sparse equations have this block missing; what remains is the matrix itself.
      equations = std::make_shared<const PerturbationEquations>(PerturbationEquations::of_state_matrix(result_.A));
    }
    model.A = without_rounding(result_.A, result_.rounding);
    result_.equations = std::move(equations);
  }

  // What outputs see of columns of unknowns.
  Matrix outputs_of(const PerturbationEquations& p, const Matrix& a) const {
    const Eigen::Index n = p.coordinates(), w = p.augmented() + AugmentedSystem(system_).algebraic(0);
    Matrix outputs(static_cast<Eigen::Index>(outputs_.size()), a.cols());
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      outputs.row(static_cast<Eigen::Index>(k)) = a.row(w + outputs_[k]);
    }
    if (!options_.without_damping) return outputs;
    // Outputs keep what they see of velocities.
    Eigen::VectorXd seen(eq_.size());
    for (Eigen::Index c = 0; c < outputs.cols(); ++c) {
      const Eigen::VectorXd rates = a.col(c).segment(p.rates(), n);
      seen.setZero();
      eq_.matrix(PartialBy::damping)
          .multiply_add({rates.data(), static_cast<std::size_t>(n)},
                        {seen.data(), static_cast<std::size_t>(seen.size())}, -1.0);
      for (std::size_t k = 0; k < outputs_.size(); ++k)
        outputs(static_cast<Eigen::Index>(k), c) += seen(eq_.algebraic_row(outputs_[k]));
    }
    return outputs;
  }

  // The name of an output that reads what freedoms without mass leave open.
  std::string open_output(const PerturbationEquations& p) const {
    const Matrix& open = p.open_directions();
    if (open.cols() == 0) return {};
    const Matrix seen = outputs_of(p, open);
    const Eigen::RowVectorXd moves = open.topRows(3 * p.coordinates()).cwiseAbs().colwise().maxCoeff();
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      double size = 0;
      const std::int32_t row = eq_.algebraic_row(outputs_[k]);
      for (std::size_t f = 0; f < column_families; ++f) {
        for_each_entry(eq_.matrix(static_cast<PartialBy>(f)), [&](std::int32_t r, std::int32_t, double v) {
          if (r == row) size += std::abs(v);
        });
      }
      if ((seen.row(static_cast<Eigen::Index>(k)).array().abs() > 1e-10 * size * moves.array()).any())
        return layout_.algebraic[static_cast<std::size_t>(outputs_[k])].owner->full_text();
    }
    return {};
  }

  // Entries that are zero in exact arithmetic come out as rounding. What is below the rounding of its own sum and of no
  // weight beside the rest of a balanced matrix is zero; near singular constraints the first alone would take entries
  // that matter.
  static Matrix without_rounding(Matrix A, const Matrix& rounding) {
    const Matrix compared = balanced(A).matrix;
    const double least = 1e-13 * compared.norm();
    return (A.array().abs() <= rounding.array() && compared.array().abs() <= least).select(0.0, A);
  }

  const System& system_;
  const Layout& layout_;
  const LinearOptions& options_;
  const OperatingPoint& op_;
  Motion motion_;
  ConstraintRows rows_;
  ElementTrace trace_;
  Equations eq_;
  std::vector<std::int32_t> inputs_, outputs_;
  std::optional<MasslessStates> massless_;
  LinearSystem result_;
};

}  // namespace

namespace {

std::string names_of(const NearSingularity& near) {
  constexpr std::size_t most = 6;
  const std::vector<std::string> first(
      near.rows.begin(), near.rows.begin() + static_cast<std::ptrdiff_t>(std::min(most, near.rows.size())));
  return fmt::format("{}{}", fmt::join(first, ", "), near.rows.size() > most ? " and others" : "");
}

// The linear model must not depend on what is not known of the motion of freedoms without mass.
bool same_model(const LinearSystem& one, const LinearSystem& other) {
  constexpr double rounding = 1e-9;
  const auto differs = [&](const Matrix& a, const Matrix& b) {
    return a.rows() != b.rows() || a.cols() != b.cols() ||
           (a.size() > 0 && ((a - b).array().abs() > rounding * (a.cwiseAbs() + b.cwiseAbs()).maxCoeff()).any());
  };
  return one.A.rows() == other.A.rows() &&
         ((one.A - other.A).array().abs() <= 1e3 * (one.rounding + other.rounding).array()).all() &&
         !differs(one.model.B, other.model.B) && !differs(one.model.C, other.model.C);
}

}  // namespace

Result<LinearSystem> linearize(const System& system, OperatingPoint op, const LinearOptions& options) {
  const AnalysisMode mode = op.mode;
  op.mode = AnalysisMode::linear;
  const auto at = [&](const OperatingPoint& point) { return Linearizer(system, point, options).run(); };
  Linearizer linearizer(system, op, options);
  auto linear = linearizer.run();
  if (!linear) return linear;
  if (linearizer.leaves_motion_open()) {
    OperatingPoint moved = linearizer.with_other_motion();
    moved.mode = mode;
    Findings ignored;
    auto other = solve_acceleration(system, std::move(moved), ignored);
    if (!other) return tl::unexpected(other.error());
    other->mode = AnalysisMode::linear;
    const auto second = at(*other);
    if (!second || !same_model(*linear, *second)) {
      return tl::unexpected(Failure{"limit of vanishing mass",
                                    fmt::format("the linear model depends on accelerations of freedoms without mass "
                                                "({}), which are known at rest only",
                                                linearizer.massless_names()),
                                    {}});
    }
  }
  linear->uncertainty = rounding_of_velocities(system, op, *linear, [&](OperatingPoint there) {
    there.mode = AnalysisMode::linear;
    return at(there);
  });
  if (linear->uncertainty.size() == 0) return linear;
  const double part = relative_size(system, op, *linear, linear->uncertainty);
  constexpr double worth_a_warning = 1e-6, singular = 1e-7;
  const NearSingularity& near = linear->near_singularity;
  // So near that accelerations, too, are lost in their own rounding, what velocities make of them tells nothing.
  const bool lost = near.distance < singular && relative_size(system, op, *linear, linear->rounding) > 10;
  if (lost || !(part < 1)) {
    return tl::unexpected(
        Failure{"linear analysis",
                fmt::format("the configuration is too near a singular one: {} all but depend on each other (relative "
                            "distance {:.1e}), and rounding of the velocities alone decides about the state matrix",
                            names_of(near), near.distance),
                {}});
  }
  if (part > worth_a_warning) {
    linear->warnings.warning(
        "near-singular", {},
        fmt::format("near a singular configuration: {} all but depend on each other (relative distance {:.1e}); "
                    "rounding of the velocities changes the state matrix by {:.0e} of its size, which the error bounds "
                    "of the eigenvalues hold",
                    names_of(near), near.distance, part));
  }
  return linear;
}

}  // namespace dynalin
