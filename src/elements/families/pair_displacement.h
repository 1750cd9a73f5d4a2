// One scalar displacement of marker I relative to marker J, as MOTION, COUPLER and GEAR drive or couple it.
#pragma once

#include <numbers>

#include "elements/families/joint.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

// Rotation about and translation along z_J of a joint, or a coordinate of a marker pair: X, Y, Z along the axes of
// J, and the angles of the body-fixed 1-2-3 sequence that turns the axes of J into those of I,
// R_JI = Rx(B1) Ry(B2) Rz(B3).
enum class Displacement : std::uint8_t { rotation, X, Y, Z, B1, B2, B3 };
inline constexpr Displacement translation_of_joint = Displacement::Z;

constexpr bool is_angle(Displacement d) {
  return d == Displacement::rotation || d == Displacement::B1 || d == Displacement::B2 || d == Displacement::B3;
}

// [length or rad]; angles as principal values.
template <class T>
T displacement(Displacement d, const RelativeFrame<T>& I) {
  using std::atan2, std::sqrt;
  switch (d) {
    case Displacement::rotation:
      return joint_rotation(I);
    case Displacement::X:
      return I.p.x;
    case Displacement::Y:
      return I.p.y;
    case Displacement::Z:
      return I.p.z;
    case Displacement::B1:
      return atan2(-I.z.y, I.z.z);
    case Displacement::B2:
      return atan2(I.z.x, sqrt(I.z.y * I.z.y + I.z.z * I.z.z));
    case Displacement::B3:
      return atan2(-I.y.x, I.x.x);
  }
  return I.p.z;
}

// The displacement as part of a constraint row.
class PairDisplacement {
 public:
  PairDisplacement(const MarkerPlace& I, const MarkerPlace& J, Displacement kind) : I_(I), J_(J), kind_(kind) {}
  // The angle is that with whole turns, which the memory has there.
  void count_turns(std::int32_t memory) { memory_ = memory; }

  Taylor along_motion(const Motion&) const;
  // Adds factor times the gradient to a position row.
  void add_to_row(const Motion&, double factor, std::int32_t row, ConstraintRows&) const;
  // Adds the variation of the force that a multiplier `lambda` exerts through the displacement.
  void add_reaction_partials(const Motion&, double lambda, Equations&) const;
  // The force itself on I, with its dependence on the multiplier of `row`.
  void wrench(const Motion&, double lambda, std::int32_t row, Partials wanted, MarkerWrench&) const;

 private:
  MarkerPlace I_, J_;
  Displacement kind_;
  std::int32_t memory_ = -1;
};

// Which freedom of a joint is meant: the only one that it has, where nothing says more.
enum class DrivenFreedom : std::uint8_t { only, rotation, translation };

// The displacement of a joint that a MOTION, COUPLER or GEAR takes; nothing after a reported error.
struct JointFreedom {
  MarkerId i, j;
  Displacement kind = Displacement::rotation;
};
std::optional<JointFreedom> joint_freedom(const Model&, const ElementLabel& user, JointRef, DrivenFreedom,
                                          Diagnostics&);

}  // namespace dynalin
