// The displacement of I from J as linear forces read it, y and y′ in the axes of J:
//
//     y = (DX, DY, DZ, AX, AY, AZ)(I,J),   y′ = (velocity seen from J, relative angular velocity)
//
// The angles are projections and count whole turns; y′ holds the angular velocity itself, not their rates, and exists
// where they do not. So an angle is evaluated for those laws alone in which it has a factor: zero times what is not
// defined would not be zero.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "elements/families/markers.h"
#include "mechanics/pair_motion.h"
#include "mechanics/undefined_value.h"

namespace dynalin {

using AnglesRead = std::array<bool, 3>;  // which of AX, AY, AZ

// Where the memory has those of marker i seen from j that are read, with all their turns.
class CountedAngles {
 public:
  CountedAngles() = default;  // none is read
  CountedAngles(Layout&, MarkerId i, MarkerId j, const AnglesRead&);
  const AnglesRead& read() const { return read_; }
  double total(std::size_t k, const Motion& motion) const {
    return motion.memory[static_cast<std::size_t>(entries_[k])];
  }

 private:
  AnglesRead read_{};
  std::array<std::int32_t, 3> entries_{};
};

// Angles that are not read are zero, and stay so.
RelativeDisplacement relative_displacement(const PairMotion&, const CountedAngles&);

// The first angle read that is not defined there, in words; `I` names the marker.
std::optional<UndefinedValue> undefined_angle(const ElementLabel&, const AnglesRead&, const PairMotion&,
                                              std::string_view I = "I");
// Warns where the axes are drawn so that an angle which the force reads is not defined.
void warn_of_undefined_angles(const Model&, const ElementLabel&, MarkerId i, MarkerId j, const AnglesRead&,
                              Diagnostics&);

}  // namespace dynalin
