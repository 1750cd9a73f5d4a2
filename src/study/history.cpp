#include "study/history.h"

namespace dynalin {

namespace {

struct Variable {
  ElementHandle handle;
  const ElementLabel* label;
};

std::vector<Variable> variables_of(const Model& model) {
  std::vector<Variable> list;
  for (std::size_t s = 0; s < model.sets.size(); ++s) {
    const ElementSet& set = *model.sets[s];
    if (!set.active || set.kind().gives != Kind::Gives::value) continue;
    for (std::size_t k = 0; k < set.size(); ++k)
      list.push_back({{static_cast<std::int32_t>(s), static_cast<std::int32_t>(k)}, &set.labels[k]});
  }
  return list;
}

}  // namespace

void append(History& history, const System& system, const OperatingPoint& point,
            const std::vector<RequestValues>& requests) {
  const std::vector<Variable> variables = variables_of(system.model());
  if (history.times.empty()) {
    for (const Variable& v : variables) history.variables.push_back({v.label->id, std::string(v.label->view_name), {}});
    for (const RequestValues& r : requests) history.requests.push_back({r.request, r.view_name, r.components, {}});
  }
  history.times.push_back(point.time);
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const Channel c = system.signals().variable({variables[k].handle});
    history.variables[k].values.push_back(point.algebraic[static_cast<std::size_t>(c.index)] + 0.0);
  }
  for (std::size_t k = 0; k < requests.size(); ++k) history.requests[k].values.push_back(requests[k].values);
}

}  // namespace dynalin
