// JPRIM/id, INPLANE, I=, J=
//
// The origin of I stays in the xy plane of J. Removes 1 translation; the force acts at the origin of I.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Inplane {
  static constexpr std::string_view variant = "INPLANE";
  static constexpr std::string_view summary = "The origin of I stays in the xy plane of J.";
  static constexpr std::array row_kinds = {PairRow::DZ};
  static constexpr Uses uses = Uses::orientation_of_J;

  template <class T>
  static std::array<T, 1> rows(const RelativeFrame<T>& I) {
    return {I.p.z};
  }
};

}  // namespace

extern constinit const Kind jprim_inplane = primitive<Inplane>();

}  // namespace dynalin
