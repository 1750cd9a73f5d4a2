// JPRIM/id, PERPENDICULAR, I=, J=
//
// The z axis of I is perpendicular to the z axis of J. Removes 1 rotation.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Perpendicular {
  static constexpr std::string_view variant = "PERPENDICULAR";
  static constexpr std::string_view summary = "The z axes are perpendicular.";
  static constexpr std::array row_kinds = {PairRow::Zi_Zj};
  static constexpr Uses uses = Uses::both_orientations;

  template <class T>
  static std::array<T, 1> rows(const RelativeFrame<T>& I) {
    return {I.z.z};
  }
};

}  // namespace

extern constinit const Kind jprim_perpendicular = primitive<Perpendicular>();

}  // namespace dynalin
