// JOINT/id, SPHERICAL, I=, J=
//
// A ball: the origins coincide. Removes 3 degrees of freedom; the rows are taken along the axes of J.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Spherical {
  MarkerId i, j;

  static constexpr std::string_view variant = "SPHERICAL";
  static constexpr std::string_view summary = "Ball: the origins coincide, all rotations are free.";
  static constexpr std::array<std::string_view, 3> row_names = {"DX", "DY", "DZ"};
  static constexpr bool rotates = false, translates = false;
  static constexpr std::array<Argument<Spherical>, 2> arguments = {{
      {.name = "I", .slot = &Spherical::i, .required = true, .help = "marker on the first body"},
      {.name = "J", .slot = &Spherical::j, .required = true, .help = "marker on the second body"},
  }};

  template <class T>
  std::array<T, 3> rows(const RelativeFrame<T>& I) const {
    return {I.p.x, I.p.y, I.p.z};
  }
};

}  // namespace

extern constinit const Kind spherical = joint<Spherical>();

}  // namespace dynalin
