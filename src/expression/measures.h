// The marker measures of function expressions, DX to INCANG, each written once over the scalar type.
//
// Evaluated on TimeTaylor<double> a measure yields its value and rates, on TimeTaylor<Dual> with path variations as
// seeds also its gradient (mechanics/path.h); one of displacements needs no rates and may be evaluated on double or
// Dual alone, where all others are NaN. Formulas: function expressions, marker kinematics.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/time_taylor.h"
#include "base/vec3.h"

namespace dynalin {

enum class Measure : std::uint8_t {
  // clang-format off
  DX, DY, DZ, DM,
  VX, VY, VZ, VM, VR,
  WX, WY, WZ, WM,
  ACCX, ACCY, ACCZ, ACCM,
  WDTX, WDTY, WDTZ, WDTM,
  AX, AY, AZ, PSI, THETA, PHI, YAW, PITCH, ROLL, INCANG,
  UVX_X, UVX_Y, UVX_Z, UVY_X, UVY_Y, UVY_Z, UVZ_X, UVZ_Y, UVZ_Z,  // axis of i · axis of j
  // Smooth where the angles they are made of are not (smooth_angles.cpp).
  PSI_PLUS_PHI, PSI_MINUS_PHI, YAW_PLUS_ROLL, YAW_MINUS_ROLL, THETA_SQUARED, INCANG_SQUARED, INCANG_COSINE,
  // clang-format on
};

// AX, AY and AZ count whole turns.
constexpr bool counts_turns(Measure m) { return m == Measure::AX || m == Measure::AY || m == Measure::AZ; }

// Whether a measure may jump where it has no gradient; the others have a kink there and change no faster than the
// motion.
bool may_jump(Measure);
// Where a measure has no gradient, as the end of a sentence: "where it is 0". Empty if it has one wherever it has
// a value.
std::string_view place_without_gradient(Measure);

// Frames of the markers i, j, k, l along the motion, global axes; the global frame where one is left out.
template <class T>
struct MeasureFrames {
  Frame<T> i, j, k, l;
};

// The measure with as many time derivatives as its kinematic order leaves; the rest is NaN. So are gradients where it
// has none: sizes and angles that are zero but for rounding count as zero.
template <class T>
T evaluate_measure(Measure, const MeasureFrames<T>&);

}  // namespace dynalin
