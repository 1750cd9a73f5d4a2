#include "elements/families/state_equations.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "elements/families/defined_unknown.h"

namespace dynalin {

namespace {

constexpr double singular_to_rounding = 1e-14;  // of rows whose largest entry is 1

}  // namespace

StateEquationsKernel::StateEquationsKernel(std::vector<StateEquationsLaw> laws, const std::vector<ElementLabel>& labels,
                                           StateType type, Layout& layout)
    : labels_(&labels) {
  for (std::size_t k = 0; k < laws.size(); ++k) {
    Sampling sampling(std::move(laws[k].sampling));
    Element e{std::move(laws[k]), std::move(sampling)};
    const StateEquationsLaw& law = e.law;
    e.first_state = static_cast<std::int32_t>(layout.states.size());
    for (std::size_t n = 0; n < law.derivatives.size(); ++n) {
      DifferentialState z{&labels[k], type, static_cast<std::int32_t>(n) + 1,
                          n < law.initial.size() ? law.initial[n] : 0.0, law.held_in_statics};
      z.held_in_dynamics = law.in_statics_only;
      layout.add_state(z);
    }
    std::int32_t component = 0;
    e.first_output = static_cast<std::int32_t>(layout.algebraic.size());
    for (std::size_t n = 0; n < law.outputs.size(); ++n) layout.add_algebraic(labels[k], ++component);
    e.first_discrete = static_cast<std::int32_t>(layout.algebraic.size());
    for (std::size_t n = 0; n < e.sampling.size(); ++n) layout.add_algebraic(labels[k], ++component);
    if (e.sampling.size() > 0) sampled_.push_back(k);
    elements_.push_back(std::move(e));
  }
}

void StateEquationsKernel::bind(Binder& binder) {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    Element& e = elements_[k];
    for (const Expression& f : e.law.derivatives) e.derivatives.emplace_back(f, binder);
    for (const Expression& g : e.law.outputs) {
      e.outputs.emplace_back(g, binder);
      if (e.law.in_statics_only) e.kept_outputs.push_back(binder.add_memory((*labels_)[k], "output", 0.0));
    }
    if (e.sampling.size() > 0) e.sampling.bind((*labels_)[k], binder);
  }
}

bool StateEquationsKernel::add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder& binder) {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    const auto output = static_cast<std::size_t>(algebraic - e.first_output);
    if (algebraic < e.first_output || output >= e.outputs.size() + e.sampling.size()) continue;
    OutputRate r{k, rate, std::nullopt};
    if (output < e.outputs.size()) r.function.emplace(e.law.outputs[output], binder, Binding::rates);
    rates_.push_back(std::move(r));
    return true;
  }
  return false;
}

bool StateEquationsKernel::rests(const Element& e, const Motion& motion) {
  return e.law.in_statics_only && !is_equilibrium(motion.mode);
}

void StateEquationsKernel::equations(const Motion& motion, Equations& eq) const {
  // NODAMPIN leaves these partials alone.
  constexpr PartialBy by_velocity = PartialBy::velocity;
  for (const Element& e : elements_) {
    const double sign = e.solves_for_rates() ? 1.0 : -1.0;
    for (std::size_t n = 0; n < e.derivatives.size(); ++n) {
      const std::int32_t z = e.first_state + static_cast<std::int32_t>(n), row = eq.state_row(z);
      if (!e.solves_for_rates()) add_state_rate(motion, eq, row, z);
      // What keeps its states has no rates.
      if (!rests(e, motion)) e.derivatives[n].add(motion, eq, row, sign, by_velocity);
    }
    for (std::size_t n = 0; n < e.outputs.size(); ++n) {
      const std::int32_t row = begin_definition(motion, eq, e.first_output + static_cast<std::int32_t>(n));
      if (rests(e, motion)) {
        eq.add_residual(row, -motion.memory[static_cast<std::size_t>(e.kept_outputs[n])]);
      } else {
        e.outputs[n].add(motion, eq, row, -1.0, by_velocity);
      }
    }
    for (std::size_t n = 0; n < e.sampling.size(); ++n) {
      const std::int32_t row = begin_definition(motion, eq, e.first_discrete + static_cast<std::int32_t>(n));
      eq.add_residual(row, -e.sampling.value(motion, n));
    }
  }
  for (const OutputRate& r : rates_) {
    const std::int32_t row = begin_definition(motion, eq, r.rate);
    if (r.function && !rests(elements_[r.element], motion)) r.function->add_rate(motion, eq, row, -1.0, by_velocity);
  }
}

void StateEquationsKernel::remember(const Motion& motion, Memory& memory) const {
  if (!is_equilibrium(motion.mode)) return;
  for (const Element& e : elements_) {
    for (std::size_t n = 0; n < e.kept_outputs.size(); ++n) {
      memory[static_cast<std::size_t>(e.kept_outputs[n])] =
          motion.algebraic[static_cast<std::size_t>(e.first_output) + n];
    }
  }
}

void StateEquationsKernel::undefined_values(const Motion& motion, UndefinedValues& undefined) const {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    const ElementLabel& label = (*labels_)[k];
    if (e.sampling.size() > 0) {
      if (const std::string reason = e.sampling.failure(motion); !reason.empty()) {
        UndefinedValues why;
        e.sampling.find_undefined(motion, label, why);
        undefined.add(UndefinedValue{
            &label,
            label.full_text() + ": " + reason + (why.values().empty() ? "" : "; " + why.values().front().reason),
            true});
      }
    }
    for (const BoundExpression& f : e.derivatives) f.find_undefined(motion, label, undefined);
    if (rests(e, motion)) continue;
    for (const BoundExpression& g : e.outputs) g.find_undefined(motion, label, undefined);
  }
  for (const OutputRate& r : rates_) {
    if (!r.function || rests(elements_[r.element], motion)) continue;
    r.function->find_undefined(motion, (*labels_)[r.element], undefined, BoundExpression::Derivatives::with_rates);
  }
}

// Implicit equations have to determine all rates: their partials with respect to these, a square matrix, be regular.
std::string StateEquationsKernel::domain_violation(const Motion& motion) const {
  ExpressionScratch scratch;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    if (!e.solves_for_rates() || e.derivatives.empty()) continue;
    const auto size = static_cast<Eigen::Index>(e.derivatives.size());
    Eigen::MatrixXd by_rates = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index row = 0; row < size; ++row) {
      const auto at = static_cast<std::size_t>(row);
      const auto partials = e.derivatives[at].partials(motion, scratch);
      const auto atoms = e.law.derivatives[at].atoms();
      for (std::size_t a = 0; a < atoms.size(); ++a) {
        if (atoms[a].function->reads == DataSource::state_rate && atoms[a].argument_count > 1)
          by_rates(row, atoms[a].argument[1] - 1) += partials[a];
      }
      if (const double largest = by_rates.row(row).cwiseAbs().maxCoeff(); largest > 0) by_rates.row(row) /= largest;
    }
    if (!by_rates.allFinite()) continue;  // said elsewhere
    Eigen::FullPivLU<Eigen::MatrixXd> lu(by_rates);
    lu.setThreshold(singular_to_rounding);
    if (lu.isInvertible()) continue;
    return fmt::format(
        "the implicit equations of {} do not determine the rates of its states here: their partial derivatives with "
        "respect to these are a matrix of rank {}, not {}",
        (*labels_)[k].full_text(), lu.rank(), size);
  }
  return {};
}

Channel StateEquationsKernel::state_channel(std::size_t element, std::size_t n) const {
  const Element& e = elements_[element];
  const std::size_t states = e.law.derivatives.size();
  if (n < states) return {Channel::Kind::state, e.first_state + static_cast<std::int32_t>(n), 0};
  return {Channel::Kind::algebraic, e.first_discrete + static_cast<std::int32_t>(n - states), 0};
}

Channel StateEquationsKernel::output_channel(std::size_t element, std::size_t n) const {
  return {Channel::Kind::algebraic, elements_[element].first_output + static_cast<std::int32_t>(n), 0};
}

void StateEquationsKernel::crossings(const Motion& motion, ExpressionScratch&, SwitchList& out) const {
  for (const std::size_t k : sampled_) out.add(elements_[k].sampling.crossing(motion));
}

// Whoever is due samples, though rounding may have it a little later: all see what was before.
bool StateEquationsKernel::sample(const Motion& motion, Memory& memory) const {
  bool changed = false;
  for (const std::size_t k : sampled_) {
    const Sampling& sampling = elements_[k].sampling;
    if (rests(elements_[k], motion) || !sampling.is_due(motion)) continue;
    changed = sampling.sample(motion, memory) || changed;
  }
  return changed;
}

// The integration begins anew at a point that is made consistent. When this would be was known before: it is none of
// the restarts that are counted, and warned of where a motion switches without end.
void StateEquationsKernel::act(const Motion& motion, std::span<const int> crossed, Memory& memory,
                               EventAction& action) const {
  const bool passed = std::any_of(crossed.begin(), crossed.end(), [](int way) { return way > 0; });
  if (passed && sample(motion, memory)) action.refactor = true;
}

void StateEquationsKernel::act_at_start(const Motion& motion, Memory& memory, EventAction& action) const {
  if (sample(motion, memory)) action.restart = true;
}

void StateEquationsKernel::stated_memory(std::vector<StatedMemory>& out) const {
  for (const std::size_t k : sampled_)
    out.push_back({&(*labels_)[k], elements_[k].law.schedule_arguments, elements_[k].sampling.schedule()});
}

}  // namespace dynalin
