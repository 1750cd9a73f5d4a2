// JPRIM/id, INLINE, I=, J=
//
// The origin of I stays on the z axis of J. Removes 2 translations; the force acts at the origin of I.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Inline {
  static constexpr std::string_view variant = "INLINE";
  static constexpr std::string_view summary = "The origin of I stays on the z axis of J.";
  using enum PairRow;
  static constexpr std::array row_kinds = {DX, DY};
  static constexpr Uses uses = Uses::orientation_of_J;

  template <class T>
  static std::array<T, 2> rows(const RelativeFrame<T>& I) {
    return {I.p.x, I.p.y};
  }
};

}  // namespace

extern constinit const Kind jprim_inline = primitive<Inline>();

}  // namespace dynalin
