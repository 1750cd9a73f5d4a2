// JOINT/id, HOOKE, I=, J=
//
// The cross of UNIVERSAL with other axes named: the origins coincide, the z axes lie along the shafts, and x of I and
// y of J, the two bars of the cross, stay perpendicular. Removes 4 degrees of freedom.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Hooke {
  static constexpr std::string_view variant = "HOOKE";
  static constexpr std::string_view summary =
      "Cross with z axes along the shafts: rotations about x of I and about y of J are free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ, Xi_Yj};
  static constexpr std::string_view axes =
      "the z axes lie along the shafts, x of I and y of J along the two bars of the cross";
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr JointSurfaces surfaces = JointSurfaces::cross;
  static constexpr std::array<std::size_t, 2> bars = {0, 1};

  template <class T>
  static std::array<T, 4> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.p.z, I.x.y};
  }
};

}  // namespace

extern constinit const Kind hooke = joint<Hooke>();

}  // namespace dynalin
