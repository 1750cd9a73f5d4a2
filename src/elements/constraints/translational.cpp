// JOINT/id, TRANSLATIONAL, I=, J= [, IC=]
//
// A slider: the origin of I stays on the z axis of J and all axes stay parallel. Removes 5 degrees of freedom; the
// translation that is left is that of I along z_J, measured from J.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Translational {
  static constexpr std::string_view variant = "TRANSLATIONAL";
  static constexpr std::string_view summary = "Slider: one translation along the common z axis is free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, Zi_Xj, Zi_Yj, Xi_Yj};
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr bool translates = true;
  static constexpr JointSurfaces surfaces = JointSurfaces::slide;

  template <class T>
  static std::array<T, 5> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.z.x, I.z.y, I.x.y};
  }
};

}  // namespace

extern constinit const Kind translational = joint<Translational>().sliding();

}  // namespace dynalin
