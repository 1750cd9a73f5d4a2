// JOINT/id, PLANAR, I=, J=
//
// A plate on a plane: the origin of I stays in the xy plane of J and the z axes stay parallel. Removes 3 degrees of
// freedom.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Planar {
  static constexpr std::string_view variant = "PLANAR";
  static constexpr std::string_view summary =
      "Plate on a plane: two translations in the xy plane of J and the rotation about its z axis are free.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DZ, Zi_Xj, Zi_Yj};
  static constexpr Uses uses = Uses::both_orientations;

  template <class T>
  static std::array<T, 3> rows(const RelativeFrame<T>& I) {
    return {I.p.z, I.z.x, I.z.y};
  }
};

}  // namespace

extern constinit const Kind planar = joint<Planar>();

}  // namespace dynalin
