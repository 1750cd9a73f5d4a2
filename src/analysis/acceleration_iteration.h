// Newton's method for accelerations, multipliers, algebraic values and state rates of a point, all together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/acceleration_equations.h"
#include "system/sparse_lu.h"

namespace dynalin {

// What an iteration leaves behind.
struct AccelerationSolution {
  OperatingPoint op;
  SparseLu lu;
  bool settled = false;         // else corrections have to show that the first step was all
  ColumnMatrix factored;        // from the second step on
  bool linear = true;           // every point had the same matrix
  Eigen::VectorXd terms;        // of each equation
  Eigen::VectorXd uncertainty;  // of each unknown
};

// At λ = 0 a force of reactions may have no derivative: it waits until the others have made reactions.
enum class AccelerationStart : std::uint8_t { undefined_held, reactions_held };
// Linear equations are solved by one step, but for roundings.
enum class AccelerationSteps : std::uint8_t { one_if_linear, until_settled };

tl::expected<AccelerationSolution, Failure> iterate_accelerations(const System&, AccelerationEquations&, OperatingPoint,
                                                                  AccelerationStart, AccelerationSteps);

// Whoever vanishes with the reactions is told what rounding makes of them.
void take_rounding(const System&, const Eigen::VectorXd& of_multipliers, OperatingPoint&);

tl::unexpected<Failure> acceleration_failure(std::string message, std::string_view code,
                                             std::vector<std::string> details = {});
// Names what has no finite value at the point.
tl::unexpected<Failure> without_finite_value(const System&, const OperatingPoint&,
                                             std::vector<std::string> details = {});

}  // namespace dynalin
