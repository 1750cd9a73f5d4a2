// JOINT/id, SCREW, I=, J=, PITCH=
//
// A thread: I advances along z_J by PITCH in one turn about z_J,
//
//     p_z − PITCH θ / 2π = const,      θ the angle from x_J to x_I about z_J,
//
// measured from the configuration of the dataset. It removes 1 degree of freedom and aligns no axes: a real screw is
// this joint and a CYLINDRICAL one on the same markers.
#include <numbers>

#include "elements/families/joint.h"

namespace dynalin {

namespace {

struct Screw {
  double pitch = 1;  // [length]

  static constexpr std::string_view variant = "SCREW";
  static constexpr std::string_view summary = "Thread: I advances along z of J by PITCH in one turn.";
  static constexpr std::array row_kinds = {PairRow::thread};
  static constexpr Uses uses = Uses::both_orientations;
  static constexpr std::string_view parameter = "PITCH";

  double period() const { return pitch; }
  template <class T>
  std::array<T, 1> rows(const RelativeFrame<T>& I) const {
    return {I.p.z - joint_rotation(I) * (pitch / (2 * std::numbers::pi))};
  }
};

}  // namespace

extern constinit const Kind screw = joint<Screw>();

}  // namespace dynalin
