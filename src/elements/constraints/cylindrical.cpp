// JOINT/id, CYLINDRICAL, I=, J= [, ICTRAN=] [, ICROT=]
//
// A sleeve on a shaft: the origin of I stays on the z axis of J and the z axes stay parallel. Removes 4 degrees of
// freedom; the rotation from x_J to x_I and the translation of I along z_J are left.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Cylindrical {
  static constexpr std::string_view variant = "CYLINDRICAL";
  static constexpr std::string_view summary =
      "Sleeve: rotation about and translation along the common z axis are free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, Zi_Xj, Zi_Yj};
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr bool rotates = true;
  static constexpr bool translates = true;
  static constexpr JointSurfaces surfaces = JointSurfaces::sleeve;

  template <class T>
  static std::array<T, 4> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.z.x, I.z.y};
  }
};

}  // namespace

extern constinit const Kind cylindrical = joint<Cylindrical>();

}  // namespace dynalin
