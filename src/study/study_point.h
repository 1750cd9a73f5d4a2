// Operating points in the course of a study, and the analyses that lead from one to the next.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/initial.h"
#include "analysis/statics.h"
#include "dynalin/marker_state.h"
#include "dynalin/remark.h"
#include "system/carry_over.h"

namespace dynalin {

// Why there is no result, and what was to be said before that was known.
struct StudyFailure : Failure {
  StudyFailure(Failure failure, Diagnostics said = {}) : Failure(std::move(failure)), remarks(std::move(said)) {}
  Diagnostics remarks;
  std::vector<Remark> problems;  // of an input that cannot be read: each of them, with its place
};
template <class T>
using StudyResult = tl::expected<T, StudyFailure>;

// What a static analysis found, the solution itself: at rest.
struct StaticSolution {
  int iterations = 0;
  double imbalance = 0;  // largest unbalanced force, or moment by the length of the model
  OperatingPoint at_rest;
};

// A point, and what the analyses before it have left.
struct StudyPoint {
  std::shared_ptr<const System> system;
  OperatingPoint values;
  bool started = false;     // an analysis has been made; before that the point is as drawn
  bool consistent = false;  // on the levels of position, velocity and acceleration
  Restated restated{};      // what edits of the model have stated anew since
  // Of the last analysis, if that was a static one.
  std::optional<StaticSolution> statics;
  std::vector<std::string> redundant_rows;  // "Zi.Xj of JOINT/3"
};

// A point together with what there is to say of how it was found.
struct FoundPoint {
  StudyPoint point;
  Diagnostics remarks;
};

// Whatever reading and numbering a model gave rise to saying: of its units, its equations, its settings.
Diagnostics remarks_on(const System&);
// Those that do not stand among the ones before in the same words.
Diagnostics new_remarks(const Diagnostics& now, const Diagnostics& before);
// "nothing here acts on INTEGRATOR/HMAX, which is passed over"; nothing of none.
Diagnostics passed_over(const std::vector<std::string>& settings);

StudyPoint as_drawn(std::shared_ptr<const System>);
// The same point in an edited model, by class and id of the elements.
StudyPoint continued(const StudyPoint&, std::shared_ptr<const System> edited, const Restated&);

// A marker that is fixed on its body.
MarkerState marker_state(const System&, const OperatingPoint&, MarkerId);

// A point that is consistent already stays as it is, but it is no static solution any more. Where the last level is not
// that of accelerations the next analysis makes the others, with all that is stated about the start.
StudyResult<FoundPoint> initial_conditions(StudyPoint, const LevelWatch& = {}, Level last = Level::acceleration);
// From the pose of the point.
StudyResult<FoundPoint> static_equilibrium(StudyPoint, const StaticsOptions&);
// With the stability of the solution. The point must have one.
StaticResult static_result(const StudyPoint&);

}  // namespace dynalin
