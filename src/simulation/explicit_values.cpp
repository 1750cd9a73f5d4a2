#include "simulation/explicit_values.h"

#include <cmath>

#include "mechanics/kernel.h"
#include "model/model.h"

namespace dynalin {

namespace {

// Of each algebraic unknown that has one, null of the others.
std::vector<const BoundExpression*> functions_of_values(const System& system) {
  const Layout& layout = system.layout();
  std::vector<const BoundExpression*> functions(layout.algebraic.size(), nullptr);
  for (std::size_t k = 0; k < functions.size(); ++k) {
    const ElementLabel& owner = *layout.algebraic[k].owner;
    const auto handle = system.model().find(owner.statement, owner.id);
    if (!handle || !handle->valid()) continue;
    const Signals::Element element = system.signals().element(*handle);
    const ChannelSource* source = element.kernel ? element.kernel->channels() : nullptr;
    if (!source) continue;
    const Channel channel = source->value_channel(element.index);
    const bool is_its_value = channel.kind == Channel::Kind::algebraic && channel.index == static_cast<std::int32_t>(k);
    if (is_its_value) functions[k] = source->value_function(element.index);
  }
  return functions;
}

}  // namespace

ExplicitValues::ExplicitValues(const System& system, const Motion& motion) {
  std::vector<const BoundExpression*> functions = functions_of_values(system);
  ConstraintRows rows;
  rows.resize(system.layout());
  Equations eq;
  eq.resize(system.layout());
  system.constraints(motion, rows);
  system.equations(motion, rows, eq, {PartialBy::algebraic});
  std::vector<std::vector<std::size_t>> readers(functions.size());
  std::vector<std::size_t> open(functions.size(), 0);  // what it reads and is not in order yet
  for_each_entry(eq.matrix(PartialBy::algebraic), [&](std::int32_t r, std::int32_t c, double v) {
    const std::int32_t reader = r - eq.algebraic_row(0);
    if (reader < 0 || reader >= static_cast<std::int32_t>(functions.size())) return;
    const auto at = static_cast<std::size_t>(reader), read = static_cast<std::size_t>(c);
    if (at == read) {
      if (std::abs(v) != 1) functions[at] = nullptr;
    } else if (functions[read] != nullptr) {
      readers[read].push_back(at);
      ++open[at];
    }
  });
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < functions.size(); ++k)
    if (open[k] == 0) known.push_back(k);
  while (!known.empty()) {
    const std::size_t k = known.back();
    known.pop_back();
    if (functions[k] != nullptr) in_order_.push_back({k, functions[k]});
    for (const std::size_t reader : readers[k])
      if (--open[reader] == 0) known.push_back(reader);
  }
}

void ExplicitValues::evaluate(Motion& motion, ExpressionScratch& scratch) const {
  for (const Value& v : in_order_) {
    // Where a function ends there is what led there.
    const double value = v.function->value(motion, scratch);
    if (std::isfinite(value)) motion.algebraic[v.unknown] = value;
  }
}

}  // namespace dynalin
