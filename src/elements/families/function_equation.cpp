#include "elements/families/function_equation.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "elements/families/defined_unknown.h"

namespace dynalin {

namespace {

constexpr double rates_cancel = 1e-9;             // of the sum of their sizes
constexpr double singular_implicit_rate = 1e-14;  // of rows whose largest entry is 1

bool is_algebraic(FunctionEquationKernel::Form form) {
  using Form = FunctionEquationKernel::Form;
  return form == Form::value || form == Form::implicit_algebraic || form == Form::condition;
}

}  // namespace

FunctionEquationKernel::FunctionEquationKernel(std::vector<Item> items, const std::vector<ElementLabel>& labels,
                                               Layout& layout)
    : items_(std::move(items)), labels_(&labels) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    if (is_algebraic(item.form)) {
      const std::int32_t n = layout.add_algebraic(labels[k], 0, item.initial);
      layout.algebraic[static_cast<std::size_t>(n)].guess_is_start = item.form == Form::condition && item.start_stated;
      unknowns_.push_back({Channel::Kind::algebraic, n, 0});
    } else {
      DifferentialState z{&labels[k], StateType::diff, 1, item.initial, item.held_in_statics};
      z.initial_rate = item.initial_rate;
      z.held_in_dynamics = item.held_in_dynamics;
      unknowns_.push_back({Channel::Kind::state, layout.add_state(z), 0});
    }
  }
}

void FunctionEquationKernel::bind(Binder& binder) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    if (item.terms.empty()) {
      const bool value_less_function = item.form == Form::value || item.form == Form::rate;
      parts_.push_back({k, k, value_less_function ? -1.0 : 1.0, BoundExpression(item.function, binder)});
    }
    const bool condition = item.form == Form::condition;
    for (const Term& t : item.terms) {
      const Expression& e = items_[t.of].function;
      parts_.push_back(
          {k, t.of, t.factor, BoundExpression(e, binder, condition ? Binding::condition : Binding::equations)});
      if (condition) whole_.push_back({k, t.of, t.factor, BoundExpression(e, binder)});
      if (!t.with_rate) continue;
      if (condition) {
        whole_.back().rate = unknowns_[t.of];
      } else {
        parts_.back().rate = binder.rate_of(unknowns_[t.of]);
      }
    }
  }
  std::vector<Group*> group_of(items_.size(), nullptr);
  for (Group& g : coupled_) {
    for (const std::size_t k : g.items) group_of[k] = &g;
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (Group* g = group_of[parts_[k].item]) g->parts.push_back(k);
  }
}

bool FunctionEquationKernel::add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder& binder) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    if (!is_algebraic(item.form) || unknowns_[k].index != algebraic) continue;
    const bool value = item.form == Form::value;
    if (item.terms.empty()) {
      rates_.push_back({rate, value, value ? -1.0 : 1.0, BoundExpression(item.function, binder, Binding::rates), k});
    }
    for (const Term& t : item.terms) {
      rates_.push_back(
          {rate, false, t.factor, BoundExpression(items_[t.of].function, binder, Binding::condition_rates), t.of});
    }
    return true;
  }
  return false;
}

const BoundExpression* FunctionEquationKernel::value_function(std::size_t element) const {
  if (items_[element].form != Form::value) return nullptr;
  const auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.item == element; });
  return part != parts_.end() ? &part->function : nullptr;
}

void FunctionEquationKernel::equations(const Motion& motion, Equations& eq) const {
  const auto row_of = [&](std::size_t k) {
    const std::int32_t n = unknowns_[k].index;
    return is_algebraic(items_[k].form) ? eq.algebraic_row(n) : eq.state_row(n);
  };
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const std::int32_t n = unknowns_[k].index;
    if (items_[k].form == Form::value) {
      add_unknown(motion, eq, row_of(k), n);
    } else if (items_[k].form == Form::rate && items_[k].terms.empty()) {
      add_state_rate(motion, eq, row_of(k), n);
    }
  }
  for (const Part& p : parts_) {
    // NODAMPIN leaves out what VARIABLEs see of velocities; the partials of a DIFF stay.
    p.function.add(motion, eq, row_of(p.item), p.factor,
                   items_[p.item].form == Form::value ? PartialBy::damping : PartialBy::velocity);
    if (p.rate.kind == Channel::Kind::algebraic) {
      add_unknown(motion, eq, row_of(p.item), p.rate.index);
    } else if (p.rate.kind == Channel::Kind::state_rate) {
      add_state_rate(motion, eq, row_of(p.item), p.rate.index);
    }
  }
  for (const RateEquation& r : rates_) {
    const std::int32_t row = eq.algebraic_row(r.rate);
    if (r.explicit_value) add_unknown(motion, eq, row, r.rate);
    r.function.add_rate(motion, eq, row, r.factor, PartialBy::velocity);
  }
}

void FunctionEquationKernel::undefined_values(const Motion& motion, UndefinedValues& undefined_values) const {
  for (const Part& p : parts_) p.function.find_undefined(motion, (*labels_)[p.of], undefined_values);
  for (const RateEquation& r : rates_) {
    r.function.find_undefined(motion, (*labels_)[r.of], undefined_values, BoundExpression::Derivatives::with_rates);
  }
}

std::string FunctionEquationKernel::domain_violation(const Motion& motion) const {
  std::string reason = uncancelled_rate(motion);
  return reason.empty() ? singular_group(motion) : reason;
}

// The rates that cancel in conditions do so as they are written; here they have to, to the last digits.
std::string FunctionEquationKernel::uncancelled_rate(const Motion& motion) const {
  if (whole_.empty()) return {};
  ExpressionScratch scratch;
  std::map<std::int64_t, std::pair<double, double>> sums;  // of partials by DIFF, and of their sizes
  for (std::size_t k = 0; k < whole_.size(); ++k) {
    const Part& p = whole_[k];
    const auto add = [&](std::int64_t id, double value) {
      sums[id].first += value;
      sums[id].second += std::abs(value);
    };
    const auto partials = p.function.partials(motion, scratch);
    const auto atoms = items_[p.of].function.atoms();
    for (std::size_t a = 0; a < atoms.size(); ++a) {
      if (atoms[a].function->reads == DataSource::state_rate) add(atoms[a].argument[0], p.factor * partials[a]);
    }
    if (p.rate.kind != Channel::Kind::none) add((*labels_)[p.of].id, -p.factor);
    if (k + 1 < whole_.size() && whole_[k + 1].item == p.item) continue;
    for (const auto& [id, sum] : sums) {
      if (std::abs(sum.first) <= rates_cancel * sum.second) continue;
      return fmt::format("{} is held by a condition in which DIF1({}) cancels elsewhere, but not here",
                         (*labels_)[p.item].full_text(), id);
    }
    sums.clear();
  }
  return {};
}

// The rank that the structure of equations promises, asked for with their partials here: by rates, of conditions by
// what these are the rates of. Of groups that read others' values it is not known.
std::string FunctionEquationKernel::singular_group(const Motion& motion) const {
  ExpressionScratch scratch;
  for (const auto& [group, parts] : coupled_) {
    const auto m = static_cast<Eigen::Index>(group.size());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(m, m);
    bool known = true;
    const auto place = [&members = group](std::size_t item) {
      return std::find(members.begin(), members.end(), item) - members.begin();
    };
    for (const std::size_t part : parts) {
      const Part& p = parts_[part];
      const Eigen::Index row = place(p.item);
      const bool by_value = is_algebraic(items_[p.item].form);
      const auto partials = p.function.partials(motion, scratch);
      const auto atoms = items_[p.of].function.atoms();
      for (std::size_t a = 0; a < atoms.size(); ++a) {
        const Atom atom = atoms[a];
        const DataSource reads = atom.function->reads;
        if (by_value && (atom.function->family != AtomFamily::data || reads == DataSource::state_rate)) continue;
        if (reads == (by_value ? DataSource::state : DataSource::state_rate)) {
          const auto of = std::find_if(group.begin(), group.end(),
                                       [&](std::size_t k) { return (*labels_)[k].id == atom.argument[0]; });
          if (of != group.end()) jacobian(row, of - group.begin()) += p.factor * partials[a];
        } else if (by_value) {
          known = false;
        }
      }
      const bool own_rate = items_[p.item].form == Form::rate && items_[p.item].terms.empty();
      if (own_rate) jacobian(row, row) += 1;
      if (p.rate.kind != Channel::Kind::none) jacobian(row, place(p.of)) += 1;
    }
    if (!known || !jacobian.allFinite()) continue;
    for (Eigen::Index r = 0; r < m; ++r) {
      if (const double size = jacobian.row(r).cwiseAbs().maxCoeff(); size > 0) jacobian.row(r) /= size;
    }
    Eigen::FullPivLU<Eigen::MatrixXd> lu(jacobian);
    lu.setThreshold(singular_implicit_rate);
    if (lu.isInvertible()) continue;
    if (m == 1) {
      return fmt::format("the equation of {} does not determine its DIF1 here: its derivative by DIF1 is zero",
                         (*labels_)[group.front()].full_text());
    }
    std::vector<std::string> names;
    for (const std::size_t k : group) names.push_back((*labels_)[k].full_text());
    std::sort(names.begin(), names.end());
    return fmt::format(
        "the equations of {} do not determine their DIF1 here: what stands in them would be enough, but at this point "
        "they depend on each other",
        fmt::join(names, ", "));
  }
  return {};
}

}  // namespace dynalin
