// JPRIM/id, PARALLEL_AXES, I=, J=
//
// The z axes are parallel. Removes 2 rotations.
#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct ParallelAxes {
  static constexpr std::string_view variant = "PARALLEL_AXES";
  static constexpr std::string_view summary = "The z axes are parallel.";
  using enum PairRow;
  static constexpr std::array row_kinds = {Zi_Xj, Zi_Yj};
  static constexpr Uses uses = Uses::both_orientations;

  template <class T>
  static std::array<T, 2> rows(const RelativeFrame<T>& I) {
    return {I.z.x, I.z.y};
  }
};

}  // namespace

extern constinit const Kind jprim_parallel_axes = primitive<ParallelAxes>();

}  // namespace dynalin
