// JOINT/id, UNIVERSAL, I=, J=
//
// A cross: the origins coincide and the z axes, which lie along the two bars of the cross, stay perpendicular.
// Removes 4 degrees of freedom.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Universal {
  static constexpr std::string_view variant = "UNIVERSAL";
  static constexpr std::string_view summary = "Cross: rotations about z of I and about z of J are free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ, Zi_Zj};
  static constexpr std::string_view axes =
      "the z axes lie along the two bars of the cross; with z axes along the shafts it is a HOOKE";
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr JointSurfaces surfaces = JointSurfaces::cross;
  static constexpr std::array<std::size_t, 2> bars = {2, 2};

  template <class T>
  static std::array<T, 4> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.p.z, I.z.z};
  }
};

}  // namespace

extern constinit const Kind universal = joint<Universal>();

}  // namespace dynalin
