// Kernels of a system that say more of their elements than equations, as StictionSource and RequestSource.
#pragma once

#include <cstdint>

#include "system/system.h"

namespace dynalin {

// use(elements, source) for each set of active elements whose Kernel is a Source.
template <class Source, class Use>
void for_each_source(const System& system, const Use& use) {
  const auto& sets = system.model().sets;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s]->size() == 0 || !sets[s]->active) continue;
    const ElementHandle first{static_cast<std::int32_t>(s), 0};
    if (const auto* source = dynamic_cast<const Source*>(system.signals().element(first).kernel))
      use(*sets[s], *source);
  }
}

template <class Source>
bool has_source(const System& system) {
  bool any = false;
  for_each_source<Source>(system, [&](const ElementSet&, const Source&) { any = true; });
  return any;
}

}  // namespace dynalin
