#include "elements/families/section_reading.h"

#include <algorithm>

#include "mechanics/motion.h"

namespace dynalin {

namespace {

// By six coordinates at a time, each with the spin that it has: where others leave an angle no axis to turn about, as
// in a plane across the global z axis, there may be a derivative by these.
void read_angle(const BeamElement::SectionMotion& section, Measure which, SectionReading& out) {
  constexpr std::size_t seeds = 6;
  using BySpins = Dual<seeds>;
  MeasureFrames<BySpins> frames;
  for (Frame<BySpins>* f : {&frames.j, &frames.k, &frames.l}) f->axes = Mat3<BySpins>::identity();
  for (std::size_t first = 0; first < beam_coordinates; first += seeds) {
    const std::size_t count = std::min(seeds, beam_coordinates - first);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vector a = value(section.axes[axis]);
      for (std::size_t c = 0; c < 3; ++c) frames.i.axes[axis][c] = BySpins(a[c]);
      for (std::size_t k = 0; k < count; ++k) {
        const Vector by = cross(value(section.spin[first + k]), a);
        for (std::size_t c = 0; c < 3; ++c) frames.i.axes[axis][c].partial[k] = by[c];
      }
    }
    const BySpins angle = evaluate_measure(which, frames);
    out.value = angle.value;
    for (std::size_t k = 0; k < count; ++k) out.by_position[first + k] = angle.partial[k];
  }
}

}  // namespace

SectionReading section_reading(const BeamElement& element, const BeamMotion& motion, std::size_t load_point,
                               std::size_t derivative, std::size_t component) {
  const BeamElement::SectionMotion section = element.section_along(motion, load_point);
  SectionReading out;
  if (derivative == 0) {
    read_angle(section, section_angles[component], out);
    return out;
  }
  Vector angular_velocity, angular_acceleration;  // ω and α
  for (std::size_t a = 0; a < 3; ++a) {
    const Vector axis = value(section.axes[a]);
    angular_velocity += 0.5 * cross(axis, rate(section.axes[a]));
    angular_acceleration += 0.5 * cross(axis, acceleration(section.axes[a]));
  }
  out.value = (derivative == 1 ? angular_velocity : angular_acceleration)[component];
  for (std::size_t k = 0; k < beam_coordinates; ++k) {
    const Vector w = value(section.spin[k]), w1 = rate(section.spin[k]), w2 = acceleration(section.spin[k]);
    if (derivative == 1) {
      out.by_position[k] = (w1 - cross(angular_velocity, w))[component];
      out.by_rate[k] = w[component];
    } else {
      out.by_position[k] = (w2 - cross(angular_velocity, w1) - cross(angular_acceleration, w))[component];
      out.by_rate[k] = (2 * w1 - cross(angular_velocity, w))[component];
      out.by_acceleration[k] = w[component];
    }
  }
  return out;
}

}  // namespace dynalin
