// Which coordinates, inputs and outputs a linear model is to have (LINEAR command).
#pragma once

#include <optional>

#include "mechanics/handles.h"

namespace dynalin {

struct LinearOptions {
  std::optional<ElementHandle> pstate, pinput, poutput;
  MarkerId rm;                   // not valid: global coordinates
  bool without_damping = false;  // NODAMPIN
  // Of the original implementation (LINEAR command, 5.1.12):
  bool principal_states = false;       // mass centres and 3-1-3 angles of principal axes
  bool without_rate_coupling = false;  // with without_damping: differential states see no rates
};

}  // namespace dynalin
