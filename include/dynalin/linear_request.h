// What LINEAR takes besides the choice of its result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace dynalin {

// Ids of statements, nothing where an option is not used.
struct LinearRequest {
  std::optional<std::int64_t> pstate{}, pinput{}, poutput{};
  std::optional<std::int64_t> rm{};     // marker relative to which the coordinates are taken
  bool without_damping = false;         // forces and VARIABLEs lose what they see of velocities
  bool original = false;                // ORIGINAL, the original implementation: all of the following
  bool principal_states = false;        // positions of mass centres and 3-1-3 angles of principal axes
  bool without_rate_coupling = false;   // with without_damping: differential states lose what they see of velocities
  bool without_reconciliation = false;  // a static solution is taken as it was found, at rest
  // A model with more states has no matrices that are dense and as large as it is: selected modes come from its sparse
  // equations (unless stated above 400 states), and state matrices are refused (above 5000).
  std::optional<std::size_t> dense_up_to{};
};

}  // namespace dynalin
