#include "simulation/stopped_integration.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace dynalin {

Failure StoppedIntegration::failure() const {
  Failure f{"dynamics", fmt::format("at time {:.9g}: {}", point.time, integrator.reason()), {}, "stopped-integration"};
  const std::string hardest = equations.unknowns().text(integrator.hardest_unknown());
  if (!hardest.empty()) f.details.push_back("what stood in the way most is " + hardest);
  // At a point that was tried, or at the last one itself, which says the same.
  std::string outside = equations.undefined();
  if (outside.empty()) outside = system.domain_violation(system.motion(point));
  if (!outside.empty()) f.details.push_back(std::move(outside));
  OperatingPoint later = point;
  later.time += a_little;
  Findings unused;
  if (const auto met = assemble_position(system, std::move(later), unused); !met)
    f.details.push_back("a little later " + met.error().message);
  return f;
}

}  // namespace dynalin
