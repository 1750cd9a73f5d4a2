#include "linear/linear_system.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/controls/variable_list.h"
#include "linear/perturbation.h"
#include "linear/state_choice.h"

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
  }

  Result<LinearSystem> run() {
    system_.constraints(motion_, rows_);
    system_.equations(motion_, rows_, eq_,
                      {Column::position, Column::velocity, Column::damping, Column::acceleration, Column::lambda,
                       Column::algebraic, Column::state, Column::state_rate});
    auto choice = choose_states(system_, motion_, rows_, options_);
    if (!choice) return tl::unexpected(choice.error());
    result_.model.time = op_.time;
    result_.model.states = choice->states;
    result_.coordinates = choice->labels;
    result_.kinematic_states = static_cast<std::size_t>(choice->first_differential);
    result_.differential_states = choice->differential.size();
    result_.warnings = choice->warnings;
    read_channels();
    auto equations =
        PerturbationEquations::make(system_, motion_, rows_, eq_, *choice, inputs_, options_.without_damping);
    if (!equations) return tl::unexpected(equations.error());
    reduce(std::make_shared<const PerturbationEquations>(std::move(*equations)));
    return std::move(result_);
  }

 private:
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
    for (const std::int32_t u : inputs_) {
      const AlgebraicUnknown& unknown = layout_.algebraic[static_cast<std::size_t>(u)];
      if (unknown.rate >= 0) {
        result_.warnings.push_back(fmt::format(
            "{} is a plant input, and a DIF1 needs its time derivative, which no state-space model has: the "
            "linear model takes it as zero",
            unknown.owner->full_text()));
      }
      const bool depends = depends_on_anything(u);
      const double value = op_.algebraic[static_cast<std::size_t>(u)];
      if (depends || value != 0.0) {
        result_.warnings.push_back(
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
      const auto family = static_cast<Column>(f);
      const ColumnMatrix& m = eq_.matrix(family);
      for (std::int32_t c = 0; c < m.columns; ++c) {
        if (family == Column::algebraic && c == unknown) continue;
        const auto first = m.row.begin() + m.start[static_cast<std::size_t>(c)],
                   last = m.row.begin() + m.start[static_cast<std::size_t>(c) + 1];
        const auto it = std::lower_bound(first, last, row);
        if (it != last && *it == row && m.value[static_cast<std::size_t>(it - m.row.begin())] != 0.0) return true;
      }
    }
    return false;
  }

  void reduce(std::shared_ptr<const PerturbationEquations> equations) {
    const PerturbationEquations& p = *equations;
    StateSpace& model = result_.model;
    const Eigen::Index states = p.states(), inputs = static_cast<Eigen::Index>(inputs_.size());
    const Matrix unit = Matrix::Identity(states + inputs, states + inputs);
    const Matrix a = p.complete(unit);
    const Saddle saddle(system_);
    const Eigen::Index n = p.coordinates(), first = p.saddle();
    result_.dq = a.topRows(n);
    result_.dqdot = a.middleRows(p.rates(), n);
    result_.dqddot = a.middleRows(p.accelerations(), n);
    result_.dlambda = a.middleRows(first + saddle.lambda(0), rows_.size());
    result_.dw = a.middleRows(first + saddle.algebraic(0), static_cast<Eigen::Index>(layout_.algebraic.size()));

    const Matrix rates = p.state_matrices(a);
    Matrix outputs = Matrix::Zero(static_cast<Eigen::Index>(outputs_.size()), states + inputs);
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      outputs.row(static_cast<Eigen::Index>(k)) = result_.dw.row(outputs_[k]);
    }
    if (options_.without_damping) {
      // Outputs keep what they see of velocities.
      Eigen::VectorXd seen(eq_.size());
      for (Eigen::Index c = 0; c < outputs.cols(); ++c) {
        seen.setZero();
        eq_.matrix(Column::damping)
            .multiply_add({result_.dqdot.col(c).data(), static_cast<std::size_t>(n)},
                          {seen.data(), static_cast<std::size_t>(seen.size())}, -1.0);
        for (std::size_t k = 0; k < outputs_.size(); ++k)
          outputs(static_cast<Eigen::Index>(k), c) += seen(eq_.algebraic_row(outputs_[k]));
      }
    }
    // Entries that are zero in exact arithmetic come out as rounding, and a double zero eigenvalue turns that into its
    // square root: what is below the rounding of its own sum is zero.
    const Matrix rounding = p.rounding(a);
    model.A = rates.leftCols(states);
    model.A = (model.A.array().abs() <= rounding.array()).select(0.0, model.A);
    model.B = rates.rightCols(inputs);
    model.C = outputs.leftCols(states);
    model.D = outputs.rightCols(inputs);
    result_.rounding = rounding;
    if (options_.without_damping && options_.without_rate_coupling) {
      for (std::size_t k = 0; k < result_.kinematic_states; ++k) {
        if (model.states[k].is_rate)
          model.A.col(static_cast<Eigen::Index>(k))
              .tail(static_cast<Eigen::Index>(result_.differential_states))
              .setZero();
      }
      // No sparse equations have this block missing; what remains is the matrix itself.
      equations = std::make_shared<const PerturbationEquations>(PerturbationEquations::of_state_matrix(model.A));
    }
    result_.equations = std::move(equations);
  }

  const System& system_;
  const Layout& layout_;
  const LinearOptions& options_;
  const OperatingPoint& op_;
  Motion motion_;
  ConstraintRows rows_;
  Equations eq_;
  std::vector<std::int32_t> inputs_, outputs_;
  LinearSystem result_;
};

}  // namespace

Result<LinearSystem> linearize(const System& system, OperatingPoint op, const LinearOptions& options) {
  op.mode = AnalysisMode::linear;
  return Linearizer(system, op, options).run();
}

}  // namespace dynalin
