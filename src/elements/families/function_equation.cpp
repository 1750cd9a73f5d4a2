#include "elements/families/function_equation.h"

namespace dynalin {

FunctionEquationKernel::FunctionEquationKernel(Unknown unknown, std::vector<Item> items,
                                               const std::vector<ElementLabel>& labels, Layout& layout)
    : unknown_(unknown), first_(0), items_(std::move(items)), labels_(&labels) {
  const bool algebraic = unknown_ == Unknown::algebraic;
  first_ = static_cast<std::int32_t>(algebraic ? layout.algebraic.size() : layout.states.size());
  for (std::size_t k = 0; k < items_.size(); ++k) {
    if (algebraic) {
      layout.add_algebraic(labels[k], 0, items_[k].initial);
    } else {
      layout.add_state({&labels[k], StateType::diff, 1, items_[k].initial, items_[k].held_in_statics});
    }
  }
}

void FunctionEquationKernel::bind(const Signals& signals) {
  for (Item& item : items_) functions_.emplace_back(item.function, signals);
}

void FunctionEquationKernel::equations(const Motion& motion, Equations& eq) const {
  const bool algebraic = unknown_ == Unknown::algebraic;
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const std::int32_t n = first_ + static_cast<std::int32_t>(k);
    const auto at = static_cast<std::size_t>(n);
    const std::int32_t row = algebraic ? eq.algebraic_row(n) : eq.state_row(n);
    eq.add_residual(row, algebraic ? motion.algebraic[at] : motion.state_rate[at]);
    eq.add(algebraic ? Column::algebraic : Column::state_rate, row, n, 1.0);
    // NODAMPIN leaves out what VARIABLEs see of velocities; the partials of a DIFF stay.
    functions_[k].add(motion, eq, row, -1.0, algebraic ? Column::damping : Column::velocity);
  }
}

void FunctionEquationKernel::remember(const Motion& motion, Memory& memory) const {
  for (const BoundExpression& f : functions_) f.remember(motion, memory);
}

Channel FunctionEquationKernel::value_channel(std::size_t element) const {
  return {Channel::Kind::algebraic, first_ + static_cast<std::int32_t>(element), 0};
}

Channel FunctionEquationKernel::state_channel(std::size_t element, std::size_t) const {
  return {Channel::Kind::state, first_ + static_cast<std::int32_t>(element), 0};
}

std::string FunctionEquationKernel::fault(const Motion& motion) const {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const std::string reason = functions_[k].fault(motion);
    if (!reason.empty()) return (*labels_)[k].full_text() + ": " + reason;
  }
  return {};
}

}  // namespace dynalin
