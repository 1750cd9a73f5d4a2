// JPRIM/id, ATPOINT, I=, J=
//
// The origins coincide. Removes 3 translations.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Atpoint {
  static constexpr std::string_view variant = "ATPOINT";
  static constexpr std::string_view summary = "The origins coincide.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY, DZ};
  static constexpr Uses uses = Uses::no_orientation;

  template <class T>
  static std::array<T, 3> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y, I.p.z};
  }
};

}  // namespace

extern constinit const Kind jprim_atpoint = primitive<Atpoint>();

}  // namespace dynalin
