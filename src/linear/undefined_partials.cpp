#include "linear/undefined_partials.h"

#include <fmt/format.h>

#include <algorithm>

#include "system/undefined_rows.h"

namespace dynalin {

UndefinedPartials::UndefinedPartials(const System& system, const Motion& motion, Equations& eq,
                                     std::vector<std::int32_t> inputs, std::vector<std::int32_t> outputs,
                                     bool without_damping)
    : system_(system),
      motion_(motion),
      augmented_(system),
      outputs_(std::move(outputs)),
      without_damping_(without_damping),
      entries_(eq.clear_undefined()) {
  // Equations that inputs have cut do not count.
  std::erase_if(entries_, [&](const Entry& e) {
    return std::any_of(inputs.begin(), inputs.end(), [&](std::int32_t u) { return eq.algebraic_row(u) == e.row; });
  });
}

std::optional<Failure> UndefinedPartials::failure(const PerturbationEquations& p, const StateChoice& choice,
                                                  const Eigen::MatrixXd& a) const {
  if (entries_.empty()) return std::nullopt;
  const Eigen::Index states = p.states(), first = p.augmented();
  const Eigen::MatrixXd by_states = p.complete_left(Eigen::MatrixXd::Identity(states, states));
  Eigen::MatrixXd by_outputs = Eigen::MatrixXd::Zero(p.state_columns(), static_cast<Eigen::Index>(outputs_.size()));
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    by_outputs(first + augmented_.algebraic(outputs_[k]), static_cast<Eigen::Index>(k)) = 1;
  }
  by_outputs = p.solve_transposed(std::move(by_outputs));

  const std::int32_t algebraic = system_.layout().coordinate_count;
  const auto is_output = [&](std::int32_t row) {
    return std::find(outputs_.begin(), outputs_.end(), row - algebraic) != outputs_.end();
  };
  const auto moves = [&](Eigen::Index unknown) { return (a.row(unknown).array() != 0.0).any(); };
  const auto varies = [&](const Entry& e) {
    switch (e.family) {
      case PartialBy::position:
        return moves(e.column);
      case PartialBy::velocity:
      case PartialBy::damping:
        return moves(p.rates() + e.column);
      case PartialBy::acceleration:
        return moves(p.accelerations() + e.column);
      case PartialBy::lambda:
        return moves(first + augmented_.lambda(e.column));
      case PartialBy::algebraic:
        return moves(first + augmented_.algebraic(e.column));
      case PartialBy::state_rate:
        return moves(first + augmented_.state(e.column));
      case PartialBy::state:
        break;
    }
    return std::find(choice.differential.begin(), choice.differential.end(), e.column) != choice.differential.end();
  };
  const auto passes_on = [&](const Entry& e) {
    // Without damping the outputs alone see it.
    if (e.family == PartialBy::damping && without_damping_) return is_output(e.row);
    const Eigen::Index row = first + augmented_.equation(e.row);
    return (by_states.row(row).array() != 0.0).any() || (by_outputs.row(row).array() != 0.0).any();
  };
  std::vector<Entry> counted;
  for (const Entry& e : entries_) {
    if (varies(e) && passes_on(e)) counted.push_back(e);
  }
  if (counted.empty()) return std::nullopt;
  return named(counted);
}

std::optional<Failure> UndefinedPartials::failure() const {
  if (entries_.empty()) return std::nullopt;
  return named(entries_);
}

std::optional<Failure> UndefinedPartials::failure_in_balances(const Eigen::MatrixXd& balances) const {
  std::vector<Entry> counted;
  for (const Entry& e : entries_) {
    if ((balances.row(augmented_.equation(e.row)).array() != 0.0).any()) counted.push_back(e);
  }
  if (counted.empty()) return std::nullopt;
  return named(counted);
}

Failure UndefinedPartials::named(const std::vector<Entry>& entries) const {
  const Layout& layout = system_.layout();
  const std::vector<UndefinedValue> undefined_values = system_.undefined_values(motion_);
  const auto n = layout.coordinate_count, w = static_cast<std::int32_t>(layout.algebraic.size());
  std::vector<std::string> sentences;
  for (const Entry& e : entries) {
    std::string sentence;
    if (e.row >= n) {
      const ElementLabel& owner = e.row < n + w ? *layout.algebraic[static_cast<std::size_t>(e.row - n)].owner
                                                : *layout.states[static_cast<std::size_t>(e.row - n - w)].owner;
      sentence = undefined_value_of(undefined_values, owner);
      if (sentence.empty()) sentence = fmt::format("{} has no finite derivative here", owner.full_text());
    } else {
      // What acts on a body directly, without an unknown of its own: the reactions of constraints, forces along a line.
      const auto has_unknown = [&](const UndefinedValue& f) {
        const auto owns = [&](const auto& u) { return same_element(*u.owner, *f.of); };
        return std::any_of(layout.algebraic.begin(), layout.algebraic.end(), owns) ||
               std::any_of(layout.states.begin(), layout.states.end(), owns);
      };
      const auto found = std::find_if_not(undefined_values.begin(), undefined_values.end(), has_unknown);
      sentence = found != undefined_values.end()
                     ? found->reason
                     : fmt::format("the force on {} has no finite derivative here", layout.coordinate_text(e.row));
    }
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) sentences.push_back(sentence);
  }
  return {"linear analysis", sentences.front(), {sentences.begin() + 1, sentences.end()}, "undefined-derivative"};
}

}  // namespace dynalin
