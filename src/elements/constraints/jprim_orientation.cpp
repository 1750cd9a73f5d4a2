// JPRIM/id, ORIENTATION, I=, J=
//
// All axes are parallel. Removes 3 rotations.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Orientation {
  static constexpr std::string_view variant = "ORIENTATION";
  static constexpr std::string_view summary = "All axes are parallel.";
  using enum PairRow;
  static constexpr std::array row_kinds = {Zi_Xj, Zi_Yj, Xi_Yj};
  static constexpr Uses uses = Uses::both_orientations;

  template <class T>
  static std::array<T, 3> rows(const RelativeFrame<T>& I) {
    return {I.z.x, I.z.y, I.x.y};
  }
};

}  // namespace

extern constinit const Kind jprim_orientation = primitive<Orientation>();

}  // namespace dynalin
