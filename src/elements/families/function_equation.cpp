#include "elements/families/function_equation.h"

namespace dynalin {

namespace {

bool is_algebraic(FunctionEquationKernel::Form form) {
  return form == FunctionEquationKernel::Form::value || form == FunctionEquationKernel::Form::implicit_algebraic;
}

}  // namespace

FunctionEquationKernel::FunctionEquationKernel(std::vector<Item> items, const std::vector<ElementLabel>& labels,
                                               Layout& layout)
    : items_(std::move(items)), labels_(&labels) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    if (is_algebraic(item.form)) {
      unknowns_.push_back({Channel::Kind::algebraic, layout.add_algebraic(labels[k], 0, item.initial), 0});
    } else {
      DifferentialState z{&labels[k], StateType::diff, 1, item.initial, item.held_in_statics};
      z.initial_rate = item.initial_rate;
      unknowns_.push_back({Channel::Kind::state, layout.add_state(z), 0});
    }
  }
}

void FunctionEquationKernel::bind(const Signals& signals) {
  for (Item& item : items_) functions_.emplace_back(item.function, signals);
}

bool FunctionEquationKernel::add_rate_equation(std::int32_t algebraic, std::int32_t rate, const Signals& signals) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    if (!is_algebraic(items_[k].form) || unknowns_[k].index != algebraic) continue;
    rates_.push_back(
        {rate, items_[k].form == Form::value, BoundExpression(items_[k].function, signals, Binding::rates)});
    return true;
  }
  return false;
}

void FunctionEquationKernel::equations(const Motion& motion, Equations& eq) const {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const bool algebraic = is_algebraic(items_[k].form);
    const std::int32_t n = unknowns_[k].index;
    const auto at = static_cast<std::size_t>(n);
    const std::int32_t row = algebraic ? eq.algebraic_row(n) : eq.state_row(n);
    // NODAMPIN leaves out what VARIABLEs see of velocities; the partials of a DIFF stay.
    switch (items_[k].form) {
      case Form::value:
        eq.add_residual(row, motion.algebraic[at]);
        eq.add(Column::algebraic, row, n, 1.0);
        functions_[k].add(motion, eq, row, -1.0, Column::damping);
        break;
      case Form::rate:
        eq.add_residual(row, motion.state_rate[at]);
        eq.add(Column::state_rate, row, n, 1.0);
        functions_[k].add(motion, eq, row, -1.0, Column::velocity);
        break;
      case Form::implicit_state:
      case Form::implicit_algebraic:
        functions_[k].add(motion, eq, row, 1.0, Column::velocity);
        break;
    }
  }
  for (const RateEquation& r : rates_) {
    const std::int32_t row = eq.algebraic_row(r.rate);
    if (r.explicit_value) {
      eq.add_residual(row, motion.algebraic[static_cast<std::size_t>(r.rate)]);
      eq.add(Column::algebraic, row, r.rate, 1.0);
    }
    r.function.add_rate(motion, eq, row, r.explicit_value ? -1.0 : 1.0, Column::velocity);
  }
}

void FunctionEquationKernel::remember(const Motion& motion, Memory& memory) const {
  for (const BoundExpression& f : functions_) f.remember(motion, memory);
  for (const RateEquation& r : rates_) r.function.remember(motion, memory);
}

std::string FunctionEquationKernel::fault(const Motion& motion) const {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const std::string reason = functions_[k].fault(motion);
    if (!reason.empty()) return (*labels_)[k].full_text() + ": " + reason;
  }
  return {};
}

}  // namespace dynalin
