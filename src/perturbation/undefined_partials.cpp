#include "perturbation/undefined_partials.h"

#include <fmt/format.h>

#include <algorithm>

#include "perturbation/perturbed_point.h"
#include "system/sources.h"
#include "system/undefined_rows.h"

namespace dynalin {

UndefinedPartials::UndefinedPartials(const System& system, PerturbedPoint& at)
    : system_(system),
      motion_(at.motion),
      augmented_(system),
      outputs_(at.outputs),
      without_damping_(at.without_damping),
      entries_(at.equations.clear_undefined()) {
  // Equations that inputs have cut do not count.
  std::erase_if(entries_, [&](const Entry& e) {
    return std::ranges::any_of(at.inputs, [&](std::int32_t u) { return at.equations.algebraic_row(u) == e.row; });
  });
  for_each_source<VanishingSource>(system, [&](const ElementSet&, const VanishingSource& source) {
    source.vanishing(motion_, system.layout(), sizes_);
  });
}

std::vector<bool> UndefinedPartials::vary(const PerturbationEquations& p, const Eigen::MatrixXd& a) const {
  // Of the terms of a sum: what is not zero beside them.
  constexpr double part_of_terms = 1e-12;
  constexpr double units = PerturbationEquations::units_of_rounding;
  std::vector<bool> varies(sizes_.size(), false);
  if (sizes_.empty()) return varies;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(p.unknowns(), a.cols());
  all.topRows(a.rows()) = a;
  all.bottomLeftCorner(p.states(), p.states()).setIdentity();
  // What each equation is added up of, and what computing its coefficients has left.
  Eigen::MatrixXd terms = units * p.rounding_variances(all).cwiseSqrt();
  for_each_entry(p.products(), [&](std::int32_t r, std::int32_t c, double v) {
    terms.row(r) += part_of_terms * std::abs(v) * all.row(c).cwiseAbs();
  });
  for (std::size_t k = 0; k < sizes_.size(); ++k) {
    for (const std::vector<VanishingSize::Partial>& component : sizes_[k].components) {
      Eigen::MatrixXd along = Eigen::MatrixXd::Zero(p.state_columns(), 1);
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(a.cols()), none = sum;
      for (const VanishingSize::Partial& by : component) {
        const Eigen::Index unknown = by.family == PartialBy::position ? by.column
                                     : by.family == PartialBy::lambda ? p.augmented() + augmented_.lambda(by.column)
                                                                      : p.rates() + by.column;
        along(unknown, 0) += by.value;
        sum += by.value * a.row(unknown);
        none += part_of_terms * std::abs(by.value) * a.row(unknown).cwiseAbs();
      }
      // What the terms of all equations make of the sum: (∂ sum/∂ a) F⁻¹ of them.
      none += p.solve_transposed(std::move(along)).cwiseAbs().transpose() * terms.topRows(p.state_columns());
      if ((sum.array().abs() > none.array()).any()) varies[k] = true;
    }
  }
  return varies;
}

std::optional<Failure> UndefinedPartials::failure(const PerturbationEquations& p, const StateChoice& choice,
                                                  const Eigen::MatrixXd& a) const {
  if (entries_.empty() && sizes_.empty()) return std::nullopt;
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
  const auto is_passed_on = [&](std::int32_t of_equations) {
    const Eigen::Index row = first + augmented_.equation(of_equations);
    return (by_states.row(row).array() != 0.0).any() || (by_outputs.row(row).array() != 0.0).any();
  };
  const auto passes_on = [&](const Entry& e) {
    // Without damping the outputs alone see it.
    if (e.family == PartialBy::damping && without_damping_) return is_output(e.row);
    return is_passed_on(e.row);
  };
  std::vector<Entry> counted;
  for (const Entry& e : entries_) {
    if (varies(e) && passes_on(e)) counted.push_back(e);
  }
  std::vector<const VanishingSize*> counted_sizes;
  const std::vector<bool> vary = this->vary(p, a);
  for (std::size_t k = 0; k < sizes_.size(); ++k) {
    const auto takes_part = [&](std::int32_t w) { return is_passed_on(algebraic + w); };
    if (vary[k] && std::ranges::any_of(sizes_[k].algebraic, takes_part)) counted_sizes.push_back(&sizes_[k]);
  }
  return named(counted, counted_sizes);
}

std::optional<Failure> UndefinedPartials::failure() const {
  std::vector<const VanishingSize*> sizes;
  for (const VanishingSize& size : sizes_) sizes.push_back(&size);
  return named(entries_, sizes);
}

std::optional<Failure> UndefinedPartials::failure_in_balances(const Eigen::MatrixXd& balances) const {
  const auto is_taken_in = [&](std::int32_t row) {
    return (balances.row(augmented_.equation(row)).array() != 0.0).any();
  };
  std::vector<Entry> counted;
  for (const Entry& e : entries_) {
    if (is_taken_in(e.row)) counted.push_back(e);
  }
  std::vector<const VanishingSize*> counted_sizes;
  for (const VanishingSize& size : sizes_) {
    const auto row = [&](std::int32_t w) { return system_.layout().coordinate_count + w; };
    if (std::ranges::any_of(size.algebraic, is_taken_in, row)) counted_sizes.push_back(&size);
  }
  return named(counted, counted_sizes);
}

std::optional<Failure> UndefinedPartials::named(const std::vector<Entry>& entries,
                                                const std::vector<const VanishingSize*>& sizes) const {
  if (entries.empty() && sizes.empty()) return std::nullopt;
  const Layout& layout = system_.layout();
  const std::vector<UndefinedValue> undefined_values = system_.undefined_values(motion_);
  const auto n = layout.coordinate_count, w = static_cast<std::int32_t>(layout.algebraic.size());
  std::vector<std::string> sentences;
  const auto add = [&](const std::string& sentence) {
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) sentences.push_back(sentence);
  };
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
      // What acts by an unknown is known by that.
      const auto reason_of = [&](const Entry& by) {
        if (by.family != PartialBy::algebraic) return std::string();
        return undefined_value_of(undefined_values, *layout.algebraic[static_cast<std::size_t>(by.column)].owner);
      };
      sentence = reason_of(e);
      const auto found = std::find_if_not(undefined_values.begin(), undefined_values.end(), has_unknown);
      if (sentence.empty() && found != undefined_values.end()) sentence = found->reason;
      for (std::size_t k = 0; k < entries_.size() && sentence.empty(); ++k)
        if (entries_[k].row == e.row) sentence = reason_of(entries_[k]);
      if (sentence.empty())
        sentence = fmt::format("the force on {} has no finite derivative here", layout.coordinate_text(e.row));
    }
    add(sentence);
  }
  for (const VanishingSize* size : sizes) add(size->reason);
  return Failure{
      "linear analysis", sentences.front(), {sentences.begin() + 1, sentences.end()}, "undefined-derivative"};
}

}  // namespace dynalin
