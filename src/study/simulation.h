// Simulations over time: a point is led through time to another, and handed out on its way.
#pragma once

#include "simulation/output_times.h"
#include "simulation/simulation_step.h"
#include "study/study_point.h"

namespace dynalin {

struct SimulationRequest {
  SimulationKind kind = SimulationKind::dynamics;
  OutputTimes times;  // from the time of the point on
  IntegratorSettings integrator{};
  KinematicsSettings kinematics{};
  StaticsOptions statics{};  // of each equilibrium
};

struct SimulatedPoint {
  StudyPoint point;  // consistent, wherever it ended
  SimulationEnd end = SimulationEnd::reached;
  SimulationKind kind = SimulationKind::dynamics;  // what was done: never transient
  IntegrationStatistics statistics;
  Diagnostics remarks;
};

// What is done at a point where that is asked for: never transient.
SimulationKind kind_at(const StudyPoint&, SimulationKind asked);

// A point that is not consistent is made so first. What fails leaves everything that was handed out until then.
StudyResult<SimulatedPoint> simulate(StudyPoint from, const SimulationRequest&, const SimulationWatch& = {});

}  // namespace dynalin
