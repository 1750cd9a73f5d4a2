// JOINT/id, REVOLUTE, I=, J= [, IC=]
//
// A hinge: the origins coincide and the z axes are parallel. Removes 5 degrees of freedom; the rotation that is
// left is the angle from x_J to x_I about the common z axis.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Revolute {
  static constexpr std::string_view variant = "REVOLUTE";
  static constexpr std::string_view summary = "Hinge: one rotation about the common z axis is free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ, Zi_Xj, Zi_Yj};
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr bool rotates = true;
  static constexpr JointSurfaces surfaces = JointSurfaces::hinge;

  template <class T>
  static std::array<T, 5> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.p.z, I.z.x, I.z.y};
  }
};

}  // namespace

extern constinit const Kind revolute = joint<Revolute>();

}  // namespace dynalin
