// Initial conditions: a point that is consistent on the levels of position, velocity and acceleration.
//
// Position: Newton steps of least change until all rows hold; coordinates named by EXACT move last. Velocity: what the
// dataset states is kept and the rest changes least, in the norm of CM velocities and L times angular velocities.
// Acceleration: accelerations, multipliers, algebraic values and state rates together, by Newton.
#pragma once

#include <functional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "base/progress.h"
#include "model/restated.h"
#include "system/system.h"

namespace dynalin {

template <class T>
using Result = tl::expected<T, Failure>;

// Redundant rows and remarks of an analysis, for the message file.
struct Findings {
  std::vector<std::int32_t> redundant_rows;
  Diagnostics warnings;
};

// Of coordinates outside bodies in the least change of positions and velocities, beside 1 for those of bodies.
inline constexpr double follower_weight = 1e-16;

// What of the statements about the start holds is said by the last argument of each: nothing where it is left out.
//
// Moves the poses onto the constraints by the least change; a consistent point comes back untouched.
Result<OperatingPoint> assemble_position(const System&, OperatingPoint start, Findings&, const Restated& = {},
                                         const Progress& = {});
// Velocities by the dataset's initial conditions.
Result<OperatingPoint> initial_velocity(const System&, OperatingPoint, Findings&);
// Velocities of least change from those of the point itself.
Result<OperatingPoint> reconcile_velocity(const System&, OperatingPoint, Findings&, const Restated& = {});
// Accelerations and everything that follows from poses, velocities and states.
Result<OperatingPoint> solve_acceleration(const System&, OperatingPoint, Findings&);

enum class Level { position, velocity, acceleration };
struct LevelWatch {
  std::function<void(Level, bool done)> level{};  // called as each begins and when it is done
  Progress progress{};
};
// The levels in turn up to the last one, with a word on what assembly moves.
Result<OperatingPoint> initial_conditions(const System&, const OperatingPoint& from, const Restated&, Findings&,
                                          const LevelWatch& = {}, Level last = Level::acceleration);
// From the model as drawn, by all that the dataset states.
Result<OperatingPoint> initial_conditions(const System&, Findings&);

// Largest relative violation of the position rows (or of velocity rows) and the row that has it.
struct Violation {
  double relative = 0;
  std::int32_t row = -1;
};
Violation position_violation(const System&, const ConstraintRows&);

}  // namespace dynalin
