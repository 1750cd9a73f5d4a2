// The damping of the modes of a flexible body in parts of the critical one: CRATIO, or what holds where it is absent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "model/model.h"

namespace dynalin {

class DampingRoutine;

// Whose damping is looked for: its modes by ascending frequency [cycles/s], and their numbers.
struct RatioModes {
  std::string owner;
  std::vector<double> frequency, number;
};
// CRATIO as it is written at a place: a function of FXFREQ, the frequency of the mode in cycles per second, and of
// FXMODE, its number. Reports what is not one; nothing then.
std::optional<std::vector<double>> written_ratios(const Span&, const RatioModes&, Diagnostics&);
// What a compiled routine says, in `ratios`. Reports what is no ratio; false then.
bool called_ratios(const DampingRoutine&, const ElementLabel&, const RatioModes&, std::vector<double>& ratios,
                   Diagnostics&);
// 1 % below 100 cycles per second, 10 % below 1000, 100 % above.
double default_ratio(double frequency);

}  // namespace dynalin
