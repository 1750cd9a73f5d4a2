// JOINT/id, RACKPIN, I=, J=, PD=
//
// Rack and pinion. I sits on the pinion with z_I along its axis, J on the rack with z_J along the rack. With p_z the
// position of the pinion along the rack and θ the rotation of the pinion about z_I relative to the rack,
//
//     p_z − PD θ / 2 = const,          θ = angle from u to x_I about z_I,  u = the part of z_J across z_I,
//
// measured from the configuration of the dataset: a pinion that turns positively about z_I rolls towards +z of J. It
// removes 1 degree of freedom and aligns no axes. A negative PD is the pinion on the other side of the rack.
#include <numbers>

#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Rackpin {
  double pitch_diameter = 1;  // [length]

  static constexpr std::string_view variant = "RACKPIN";
  static constexpr std::string_view summary = "Rack and pinion: I rolls along z of J on a pinion of diameter PD.";
  static constexpr std::array row_kinds = {PairRow::pinion};
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr std::string_view parameter = "PD";

  double period() const { return std::numbers::pi * pitch_diameter; }
  template <class T>
  std::array<T, 1> rows(const RelativeFrame<T>& I) const {
    using std::atan2;
    // z_J in the axes of I is (x_I·z_J, y_I·z_J, z_I·z_J): the pinion turns by minus the angle of that direction.
    return {I.p.z + atan2(I.y.z, I.x.z) * (pitch_diameter / 2)};
  }
};

}  // namespace

extern constinit const Kind rackpin = joint<Rackpin>();

}  // namespace dynalin
