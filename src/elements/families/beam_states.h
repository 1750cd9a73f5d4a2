// How the coordinates of a beam are numbered among the states of its FE_PART: position, rotation and slope of each
// node, node by node, then the rotations between nodes, all of them followed by their rates. Of a beam in a plane place
// and slope in that plane alone; the others, which rows hold, have numbers behind all states. They are along global
// axes whatever is asked for: a reference marker has no influence on them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "flexible/plane_beam.h"
#include "mechanics/layout.h"

namespace dynalin {

class BeamStates {
 public:
  BeamStates(std::size_t nodes, const std::optional<BeamPlane>&);

  std::int32_t count() const { return count_; }
  std::array<std::int32_t, 6> of_pose(std::size_t node) const;
  std::array<std::int32_t, 3> of_slope(std::size_t node) const;
  std::array<std::int32_t, 3> of_middle(std::size_t element) const;

 private:
  // Of a node of a beam in a plane: the first number of those that rows hold.
  std::int32_t first_held(std::size_t node) const { return 2 * count_ + 5 * static_cast<std::int32_t>(node) + 1; }

  std::int32_t nodes_, count_;
  std::optional<BeamPlane> plane_;
};

}  // namespace dynalin
