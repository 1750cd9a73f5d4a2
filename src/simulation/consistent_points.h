// Points of a run that are consistent on all levels, made by the analyses of initial conditions (analysis/initial.h)
// from what is nearly right. What these have to say of a point is said once in a run.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "analysis/initial.h"
#include "system/system.h"

namespace dynalin {

class ConsistentPoints {
 public:
  // What there is to say goes into the findings, which must outlive this.
  ConsistentPoints(const System& system, Findings& findings) : system_(system), findings_(findings) {}

  // Everything that belongs to an operating point, from positions, velocities and states that are nearly right. Rows
  // that follow from the others may be off by `left_out` in their scales, where that is more than the point allows.
  Result<OperatingPoint> at(OperatingPoint, double left_out);
  // Accelerations and reactions, from those at hand; where that fails, as from a point as drawn.
  Result<OperatingPoint> accelerations(OperatingPoint, Findings&) const;

  // Whether this has not been said in this run.
  bool is_new(const std::string& remark) { return said_.insert(remark).second; }

 private:
  const System& system_;
  Findings& findings_;
  std::set<std::string> said_;  // remarks so far
};

}  // namespace dynalin
