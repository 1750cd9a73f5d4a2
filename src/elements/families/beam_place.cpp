#include "elements/families/beam_place.h"

#include <algorithm>

namespace dynalin {

BeamColumns BeamBody::columns(const Layout& layout, std::size_t element) const {
  BeamColumns list{};
  const auto put = [&](std::size_t first, std::int32_t column, std::int32_t count) {
    for (std::int32_t k = 0; k < count; ++k) list[first + static_cast<std::size_t>(k)] = column + k;
  };
  const auto outside = [&](std::size_t extra) {
    return layout.body_coordinate_count + static_cast<std::int32_t>(extra);
  };
  put(0, layout.body(nodes[element]).offset, 6);
  put(6, layout.body(nodes[element + 1]).offset, 6);
  put(12, outside(slope(element)), 3);
  put(15, outside(slope(element + 1)), 3);
  if (plane) {
    std::fill(list.begin() + 18, list.end(), -1);
  } else {
    put(18, outside(middle(element)), 3);
  }
  return list;
}

BeamMotion BeamBody::motion(const Motion& motion, std::size_t element) const {
  BeamMotion m;
  const auto three = [&](std::size_t extra) {
    return Vec3<Taylor>{motion.outside_poses(extra), motion.outside_poses(extra + 1), motion.outside_poses(extra + 2)};
  };
  const BodyMotion &one = motion.body(nodes[element]), &other = motion.body(nodes[element + 1]);
  m.chord = along_motion(other.r - one.r, other.rdot - one.rdot, other.rddot - one.rddot);
  m.acceleration = {one.rddot, other.rddot};
  m.axes = {one.axes(), other.axes()};
  m.slope = {three(slope(element)), three(slope(element + 1))};
  if (!plane) m.middle = three(middle(element));
  return m;
}

void find_coordinates(std::vector<BeamBody>& beams, const Layout& layout) {
  for (BeamBody& b : beams) {
    for (const ExtraBlock& e : layout.extras) {
      if (same_element(e.label, *b.label)) b.first_extra = layout.extra_index(e.offset);
    }
  }
}

}  // namespace dynalin
