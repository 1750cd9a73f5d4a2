// JOINT/id, CONVEL, I=, J=
//
// A constant-velocity joint: the origins coincide and the angle between x_I and y_J stays equal to that between y_I and
// x_J, so that both shafts, along their z axes away from the joint, turn at equal and opposite rates. Removes 4
// degrees of freedom.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Convel {
  static constexpr std::string_view variant = "CONVEL";
  static constexpr std::string_view summary =
      "Constant-velocity joint: what one shaft turns about its axis, the other turns about its own.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ, equal_angles};
  static constexpr std::string_view axes =
      "z points along each shaft away from the joint; with parallel x axes or parallel y axes it fits";
  static constexpr Uses uses = Uses::both_orientations;

  template <class T>
  static std::array<T, 4> rows(const RelativeFrame<T>& I) {
    // The two forms of the last row are one for turned axes, and each keeps its digits where the other cancels: shafts
    // in line have z axes that point away from each other, and of the difference nothing is left there.
    const bool in_line = value_of(I.z.z) < 0;
    return {I.p.x, I.p.y, I.p.z, in_line ? (I.z.x * I.y.z - I.z.y * I.x.z) / (1.0 - I.z.z) : I.x.y - I.y.x};
  }
};

}  // namespace

extern constinit const Kind convel = joint<Convel>();

}  // namespace dynalin
