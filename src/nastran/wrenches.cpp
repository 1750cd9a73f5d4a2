#include "nastran/wrenches.h"

namespace dynalin::nastran {

SingleWrenches::SingleWrenches(const System& system) {
  const auto& sets = system.model().sets;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ElementSet& set = *sets[s];
    if (set.size() == 0 || !set.active) continue;
    const Kernel* kernel = system.signals().element(ElementHandle{static_cast<std::int32_t>(s), 0}).kernel;
    const WrenchSource* source = kernel ? kernel->reported_wrenches() : nullptr;
    if (!source) continue;
    auto& of_statement = by_id_[set.kind().statement];
    for (std::size_t w = 0; w < source->wrench_count(set.size()); ++w)
      of_statement[set.labels[source->element_of_wrench(w)].id].push_back({source, w});
  }
}

const ReportedWrench* SingleWrenches::of(const ElementLabel& label) const {
  const auto statement = by_id_.find(label.statement);
  if (statement == by_id_.end()) return nullptr;
  const auto found = statement->second.find(label.id);
  return found == statement->second.end() || found->second.size() != 1 ? nullptr : &found->second.front();
}

}  // namespace dynalin::nastran
