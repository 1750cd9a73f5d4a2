// How near a singular configuration the operating point is, and what roundings of the point make of the linear model
// there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "linear/linear_system.h"
#include "states/state_choice.h"

namespace dynalin {

// The largest entry against that of the state matrix, lengths of the model, radians and the fastest rate of model and
// motion taken as units.
double relative_size(const System&, const OperatingPoint&, const LinearSystem&, const Eigen::MatrixXd& of_matrix);

// The state whose rate is known least: what roundings may leave in an entry of its row of the state matrix, against the
// largest entry of the row, in the same units. Rows without entries are known, and so is a model without state matrix.
struct LeastKnownRate {
  double part = 0;
  std::size_t state = 0;
};
LeastKnownRate least_known_rate(const System&, const OperatingPoint&, const LinearSystem&);

// Degrees of freedom that the model has at the point and not a thousandth of its length beside it, as constraint rows
// depend on others here alone (those that the linear system has left out). Rows that do so everywhere are redundant and
// no reason for any.
struct FreedomsGained {
  std::size_t count = 0;
  std::vector<std::int32_t> rows;
};
std::optional<FreedomsGained> freedoms_gained(const System&, const OperatingPoint&, const LinearSystem&);
// Constraint rows left out as redundant that depend on the others, and not only by rounding, up to a part of their own
// size: a power of ten that they are at most away from it, zero where there are none. The choice is that of the point.
struct NearDependence {
  double distance = 0;
  std::vector<std::int32_t> rows;
  std::vector<std::int32_t> left_out;  // all that are redundant, by rounding or not
};
NearDependence near_dependence(const System&, const OperatingPoint&, const StateChoice&);
// Constraint rows that no motion changes to first order, neither here nor where the point moves to: they hold nothing.
std::vector<std::int32_t> rows_that_hold_nothing(const System&, const OperatingPoint&);

// How far the entries of the state matrix follow when velocities change by a unit in the last place, and accelerations
// and reactions with them; poses are what they are. Infinite where a point that near has no such model, empty where the
// estimated roundings of the entries are of no weight: then nothing is tried.
using Linearization = std::function<Result<LinearSystem>(const OperatingPoint&)>;
Eigen::MatrixXd rounding_of_velocities(const System&, const OperatingPoint&, const LinearSystem&, const Linearization&);

}  // namespace dynalin
