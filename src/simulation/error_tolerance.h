// What errors steps of a run may have: the part of a coordinate's length, of a velocity, of a state.
#pragma once

namespace dynalin {

struct ErrorTolerance {
  double relative = 1e-6;
  double duration = 1;        // of the simulation [time]: a velocity counts by the way it makes
  double passed_over = 1e-3;  // part of the range of a table that steps need not see
};

}  // namespace dynalin
