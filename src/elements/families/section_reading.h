// What an expression reads of how the section of a beam turns at a load point: SD(n), SV(n) and SA(n), n from 4 to 6.
//
// With the spin ϑ = Σ w_i δx_i of the section by the coordinates x of its element its angular velocity ω and its
// angular acceleration α change by
//
//     δω = ϑ′ − ω × ϑ,     δα = ϑ″ − ω × ϑ′ − α × ϑ
//
// and its angles by what they are of a small rotation ϑ.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "expression/measures.h"
#include "flexible/beam_element.h"

namespace dynalin {

// The 3-1-3 angles of the section axes against the global ones.
inline constexpr std::array<Measure, 3> section_angles = {Measure::PSI, Measure::THETA, Measure::PHI};

struct SectionReading {
  double value = 0;
  // By the coordinates of the element, their rates and their accelerations.
  std::array<double, beam_coordinates> by_position{}, by_rate{}, by_acceleration{};

  // Angles have none where others determine no axis to turn about; it is NaN there.
  bool has_gradient() const {
    return std::ranges::all_of(by_position, [](double p) { return std::isfinite(p); });
  }
};
// Derivative 0: one of the section angles [rad]; 1: a component of the angular velocity [rad/time], 2: of the angular
// acceleration [rad/time²], global axes.
SectionReading section_reading(const BeamElement&, const BeamMotion&, std::size_t load_point, std::size_t derivative,
                               std::size_t component);

}  // namespace dynalin
