// JOINT/id, FIXED, I=, J=
//
// A weld: the origins coincide and all axes are parallel. Removes all 6 degrees of freedom between the bodies.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Fixed {
  static constexpr std::string_view variant = "FIXED";
  static constexpr std::string_view summary = "Weld: nothing is free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ, Zi_Xj, Zi_Yj, Xi_Yj};
  static constexpr Uses uses = Uses::both_orientations;

  template <class T>
  static std::array<T, 6> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.p.z, I.z.x, I.z.y, I.x.y};
  }
};

}  // namespace

extern constinit const Kind fixed = joint<Fixed>().with_example("JOINT/1, FIXED");

}  // namespace dynalin
