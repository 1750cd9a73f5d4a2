// Elements whose states tell of the motion of a marker I seen from J. They are of that motion alone: of two other
// markers, or along another axis, the element begins without them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/motion.h"

namespace dynalin {

struct PairStates {
  struct End {
    MarkerId marker;
    Vector at, axis;  // of the surface there, global; no axis of a ball
  };

  const ElementLabel* of = nullptr;
  std::int64_t joint = 0;   // whose surfaces slip; 0 of a displacement
  std::string_view motion;  // "slide", "bar of I", "B1": its kind is the first word
  std::array<End, 2> ends;  // I and J
  // Of slip: what each state is the way along or about, of I seen from J, global. None of a displacement, which begins
  // as it is found.
  std::vector<Vector> directions;
  double radius = 0;  // of surfaces that turn [length]; 0 where every place of the bodies slips alike
};

class PairStateSource {
 public:
  virtual void pair_states(const Motion&, std::vector<PairStates>&) const = 0;

 protected:
  ~PairStateSource() = default;
};

}  // namespace dynalin
