// What LINEAR takes besides the choice of its result.
#pragma once

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
};

}  // namespace dynalin
