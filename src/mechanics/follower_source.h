// Elements with coordinates that follow bodies: where a curve is touched (ExtraRole::follower).
#pragma once

#include <cstdint>
#include <span>

#include "mechanics/motion.h"

namespace dynalin {

// The coordinates of one element, and its constraint rows: these say whether it still is where it was.
struct Follower {
  std::int32_t first_coordinate = 0, coordinates = 0;
  std::int32_t first_row = 0, rows = 0;
};

class FollowerSource {
 public:
  virtual std::span<const Follower> followers() const = 0;
  // Values of the coordinates of one of them with which its rows come next to being met at the poses of the motion.
  virtual void find(std::size_t follower, const Motion&, std::span<double> values) const = 0;

 protected:
  ~FollowerSource() = default;
};

}  // namespace dynalin
