// Quasi-statics: an equilibrium at every output time, each sought from where the ones before it lead.
//
// Between two outputs a step is halved where nothing is found, and where the equilibrium found lies far from where the
// last two lead. What is still far off after the smallest step is a jump (snap-through), which is taken and told; what
// is not found then, even by a search from other places, is an error that names the time.
#pragma once

#include "analysis/statics.h"
#include "simulation/course.h"

namespace dynalin {

struct QuasiStaticEnd {
  OperatingPoint point;   // as static_operating_point leaves it: moving as motions in time ask
  StaticsReport statics;  // of the last equilibrium
  SimulationEnd end = SimulationEnd::reached;
};

// From a point near an equilibrium to the end of `times`, or to where the watch does not go on. The watch is called
// with the equilibrium of the start as well. What is handed out stands still, whatever drives it.
Result<QuasiStaticEnd> advance_quasi_statics(const System&, OperatingPoint from, const StaticsOptions&, const Course&);

}  // namespace dynalin
