#include "perturbation/perturb.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/dense_products.h"
#include "base/word_hash.h"
#include "elements/controls/variable_list.h"
#include "perturbation/along_open_directions.h"
#include "perturbation/perturbation.h"
#include "perturbation/perturbed_point.h"
#include "perturbation/undefined_partials.h"
#include "system/undefined_rows.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

class Perturber {
 public:
  Perturber(const System& system, const OperatingPoint& op, const LinearOptions& options)
      : system_(system),
        layout_(system.layout()),
        options_(options),
        op_(op),
        at_(std::make_shared<PerturbedPoint>(system, op, options)) {}

  Result<Perturbation> run() {
    if (const auto undefined = undefined_row(system_, at_->motion, at_->rows)) return refusal(*undefined);
    auto chosen = choose_states(system_, at_->motion, at_->rows, options_);
    if (!chosen) return tl::unexpected(chosen.error());
    at_->choice = std::move(*chosen);
    StateChoice& choice = at_->choice;
    result_.model.time = op_.time;
    result_.principal_states = options_.principal_states && !options_.rm.valid();
    result_.warnings = choice.warnings;
    result_.near_singularity = near_singularity(system_, at_->rows, choice);
    read_channels();
    const UndefinedPartials undefined(system_, *at_);
    if (auto taken = take_massless(choice); !taken) return tl::unexpected(undefined.failure().value_or(taken.error()));
    if (at_->massless) {
      if (auto failure = undefined.failure_in_balances(at_->massless->limit.left))
        return tl::unexpected(std::move(*failure));
    }
    name_states();
    auto equations = PerturbationEquations::make(system_, *at_);
    if (!equations) return tl::unexpected(undefined.failure().value_or(equations.error()));
    if (undefined.failure()) {
      // Whether they count is asked of all variations.
      const Eigen::Index columns = equations->states() + static_cast<Eigen::Index>(at_->inputs.size());
      const Matrix a = equations->complete(Matrix::Identity(columns, columns));
      if (auto failure = undefined.failure(*equations, choice, a)) return tl::unexpected(std::move(*failure));
    }
    if (const std::string open = open_output(*equations); !open.empty()) {
      return tl::unexpected(Failure{
          "limit of vanishing mass",
          fmt::format("{} reads a rate or an acceleration of a freedom without mass, which depends on derivatives that "
                      "the linear model does not have{}",
                      open, at_->massless->at_rest ? "" : ": that is possible at rest only"),
          {},
          "massless-motion"});
    }
    result_.model.of_equations = mark_of(*equations);
    result_.equations = std::make_shared<const PerturbationEquations>(std::move(*equations));
    result_.at = std::move(at_);
    return std::move(result_);
  }

 private:
  void name_states() {
    const StateChoice& choice = at_->choice;
    result_.model.states = choice.states;
    result_.scales = choice.scales;
    for (std::size_t k = 0; k < choice.coordinates.size(); ++k) {
      if (choice.has_position[k]) result_.coordinates.push_back(choice.coordinates[k].label);
    }
    result_.kinematic_states = static_cast<std::size_t>(choice.first_differential);
    result_.model.kinematic_states = result_.kinematic_states;
    result_.differential_states = choice.differential.size();
  }

  Result<void> take_massless(StateChoice& choice) {
    if (!lacks_mass(system_)) return {};
    std::vector<bool> cut(layout_.algebraic.size(), false);
    for (const std::int32_t u : at_->inputs) cut[static_cast<std::size_t>(u)] = true;
    auto limit = massless_limit(system_, at_->motion, at_->rows, at_->equations,
                                {choice.velocity_active, cut, options_.without_damping});
    if (!limit) return tl::unexpected(limit.error());
    if (!*limit) return {};
    at_->with_massless = choice;
    at_->massless.emplace();
    at_->massless->limit = std::move(**limit);
    at_->massless->at_rest = at_rest(system_, op_, at_->massless->limit.directions);
    if (auto taken = take_massless_states(system_, at_->rows, choice, *at_->massless); !taken) return taken;
    result_.warnings.append(at_->massless->remarks);
    result_.first_order = at_->massless->first_order;
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
    read(options_.pinput, result_.model.inputs, at_->inputs, result_.model.pinput);
    read(options_.poutput, result_.model.outputs, at_->outputs, result_.model.poutput);
    for (const Model::FollowedVariable& f : model.followed_in_time) {
      const std::int32_t followed = system_.signals().variable(f.variable).index;
      if (std::find(at_->inputs.begin(), at_->inputs.end(), followed) == at_->inputs.end()) continue;
      result_.warnings.warning(
          "followed-input", model.label(f.variable).at,
          fmt::format("{} is a plant input, and {} follows its course in time; the linear model holds the motion",
                      model.label(f.variable).full_text(), f.follower->full_text()));
    }
    for (auto at = at_->inputs.begin(); at != at_->inputs.end(); ++at) {
      const std::int32_t u = *at;
      if (std::find(at_->inputs.begin(), at, u) != at) continue;  // listed before
      const AlgebraicUnknown& unknown = layout_.algebraic[static_cast<std::size_t>(u)];
      if (unknown.rate >= 0) {
        result_.warnings.warning(
            "rate-of-input", unknown.owner->at,
            fmt::format(
                "{} is a plant input, and a DIF1 or DELAY needs its time derivative, which no state-space model "
                "has: the linear model takes it as zero",
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
    const std::int32_t row = at_->equations.algebraic_row(unknown);
    for (std::size_t f = 0; f < column_families; ++f) {
      const auto family = static_cast<PartialBy>(f);
      const ColumnMatrix& m = at_->equations.matrix(family);
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
    return tl::unexpected(Failure{"linear analysis", std::move(message), {}, "undefined-value"});
  }

  // Of all that results are made of.
  EquationsMark mark_of(const PerturbationEquations& p) const {
    WordHash hash;
    const auto add = [&](std::int32_t r, std::int32_t c, double v) {
      hash.add(r, c);
      hash.add(v);
    };
    hash.add(op_.time);
    hash.add(options_.rm.index, at_->without_damping + 2 * at_->without_rate_coupling);
    for_each_entry(p.products(), add);
    for_each_entry(p.by_states_and_inputs(), add);
    for_each_entry(at_->outputs_by_unknowns(p), add);
    for (const StateLabel& s : result_.model.states) {
      hash.add(static_cast<std::int32_t>(s.type), s.coordinate);
      hash.add(static_cast<std::uint64_t>(s.element));
      hash.add(s.text);
    }
    for (const auto* channels : {&result_.model.inputs, &result_.model.outputs})
      for (const ChannelLabel& c : *channels) hash.add(static_cast<std::uint64_t>(c.variable));
    return hash.value();
  }

  // The name of an output that reads what freedoms without mass leave open.
  std::string open_output(const PerturbationEquations& p) const {
    const Matrix& open = p.open_directions();
    if (open.cols() == 0) return {};
    const Matrix seen = at_->outputs_of(p, open);
    const Eigen::RowVectorXd moves = open.topRows(3 * p.coordinates()).cwiseAbs().colwise().maxCoeff();
    for (std::size_t k = 0; k < at_->outputs.size(); ++k) {
      double size = 0;
      const std::int32_t row = at_->equations.algebraic_row(at_->outputs[k]);
      for (std::size_t f = 0; f < column_families; ++f) {
        for_each_entry(at_->equations.matrix(static_cast<PartialBy>(f)), [&](std::int32_t r, std::int32_t, double v) {
          if (r == row) size += std::abs(v);
        });
      }
      if ((seen.row(static_cast<Eigen::Index>(k)).array().abs() > rounding_along_open_directions * size * moves.array())
              .any())
        return layout_.algebraic[static_cast<std::size_t>(at_->outputs[k])].owner->full_text();
    }
    return {};
  }

  const System& system_;
  const Layout& layout_;
  const LinearOptions& options_;
  const OperatingPoint& op_;
  std::shared_ptr<PerturbedPoint> at_;
  Perturbation result_;
};

// part(columns) of motions.
template <class Part>
Eigen::MatrixXcd of_motions(const PerturbationEquations& equations, const Eigen::Ref<const Eigen::MatrixXcd>& of_states,
                            Part&& part) {
  Eigen::MatrixXcd all(equations.coordinates(), of_states.cols());
  for_few_columns(equations.unknowns(), of_states.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const Eigen::MatrixXcd motions = equations.motions(of_states.middleCols(first, count));
    all.middleCols(first, count) = part(motions);
  });
  return all;
}

}  // namespace

Result<Perturbation> perturb(const System& system, const OperatingPoint& op, const LinearOptions& options) {
  return Perturber(system, op, options).run();
}

Eigen::MatrixXcd Perturbation::displacements(const Eigen::Ref<const Eigen::MatrixXcd>& of_states) const {
  return of_motions(*equations, of_states, [&](const auto& m) { return m.topRows(equations->coordinates()); });
}
Eigen::MatrixXcd Perturbation::velocities(const Eigen::Ref<const Eigen::MatrixXcd>& of_states) const {
  return of_motions(*equations, of_states, [&](const auto& m) { return m.bottomRows(equations->coordinates()); });
}

}  // namespace dynalin
