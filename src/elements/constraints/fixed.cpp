// JOINT/id, FIXED, I=, J=
//
// A weld: the origins coincide and all axes are parallel. Removes all 6 degrees of freedom between the bodies.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Fixed {
  MarkerId i, j;

  static constexpr std::string_view variant = "FIXED";
  static constexpr std::string_view summary = "Weld: nothing is free.";
  static constexpr std::array<std::string_view, 6> row_names = {"DX", "DY", "DZ", "Zi.Xj", "Zi.Yj", "Xi.Yj"};
  static constexpr bool rotates = false, translates = false;
  static constexpr std::array<Argument<Fixed>, 2> arguments = {{
      {.name = "I", .slot = &Fixed::i, .required = true, .help = "marker on the first body"},
      {.name = "J", .slot = &Fixed::j, .required = true, .help = "marker on the second body"},
  }};

  template <class T>
  std::array<T, 6> rows(const RelativeFrame<T>& I) const {
    return {I.p.x, I.p.y, I.p.z, I.z.x, I.z.y, I.x.y};
  }
};

}  // namespace

extern constinit const Kind fixed = joint<Fixed>();

}  // namespace dynalin
