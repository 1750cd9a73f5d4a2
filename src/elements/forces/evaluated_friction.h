// What friction in a joint is at a motion: the components w of force and torque and what becomes of the bristles.
//
// What they depend on, pose and rate of I seen from J, the multipliers of the joint, the creep of the bristles and
// sizes that are zero, are the seeds of one dual number, so that no derivative is written anywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/dual.h"
#include "elements/forces/friction_at_rest.h"
#include "elements/forces/friction_load.h"
#include "mechanics/layout.h"
#include "mechanics/pair.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

// A joint with friction in the model.
struct PlacedFriction {
  const JointFriction* element;
  const MarkerPlace *I, *J;
  std::int32_t first_algebraic, first_state;  // −1 without bristles
  std::int32_t first_memory;                  // of a FrictionReference, −1 for a law without bristles
  std::int32_t rounding;                      // of the reaction, in the memory: of its force and its moment
  const WrenchSource* joint = nullptr;        // null while the joint is out of the model
  std::size_t which = 0;                      // of its wrenches

  FrictionReference reference(const Motion&) const;
};

struct EvaluatedFriction {
  static constexpr std::size_t most_rows = 5, most_components = 3;
  static constexpr std::size_t first_row_seed = 12, first_creep_seed = first_row_seed + most_rows;
  static constexpr std::size_t first_size_seed = first_creep_seed + most_components;
  using D = Dual<first_size_seed + most_sizes>;
  using Sizes = ReactionSizes<D, first_size_seed>;
  using Values = std::array<D, most_components>;

  static EvaluatedFriction at(const PlacedFriction&, const PairMotion&, const Motion&);
  // Exerts nothing, and its bristles stay as they are.
  static EvaluatedFriction inactive(const PlacedFriction&, const Motion&);

  Values w, creep_rate;
  Values creep;                                // in equilibria
  std::array<std::int32_t, most_rows> rows{};  // whose multipliers the seeds are
  std::size_t row_count = 0;
  double speed = 0;  // of the slip
  Sizes sizes;       // of what the joint bears
};

// A slip that is none: what a simulation that has come to rest leaves of it has no direction, and the linear model is
// that of bristles at rest.
inline bool slips(const JointFriction& f, double speed) {
  constexpr double no_slip = 1e-6;  // of the velocity up to which surfaces stick
  return speed > (f.law.has_bristles() ? no_slip * f.law.stiction_velocity : 0);
}

}  // namespace dynalin
