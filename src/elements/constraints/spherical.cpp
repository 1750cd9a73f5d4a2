// JOINT/id, SPHERICAL, I=, J=
//
// A ball: the origins coincide. Removes 3 degrees of freedom; the rows are taken along the axes of J.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Spherical {
  static constexpr std::string_view variant = "SPHERICAL";
  static constexpr std::string_view summary = "Ball: the origins coincide, all rotations are free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ};
  static constexpr Uses uses = Uses::no_orientation;
  static constexpr JointSurfaces surfaces = JointSurfaces::ball;

  template <class T>
  static std::array<T, 3> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.p.z};
  }
};

}  // namespace

extern constinit const Kind spherical = joint<Spherical>();

}  // namespace dynalin
