#include "elements/families/read_displacement.h"

#include <fmt/format.h>

#include <cmath>

#include "elements/families/common_frame.h"
#include "mechanics/layout.h"

namespace dynalin {

namespace {

// AX, AY, AZ of I seen from J: angles from y_J, z_J, x_J to the projections of y.. of I (dataset language, section
// 0.1).
template <class T>
T projected_angle(std::size_t k, const RelativeFrame<T>& I) {
  using std::atan2;
  return k == 0 ? atan2(-I.z.y, I.z.z) : k == 1 ? atan2(I.z.x, I.z.z) : atan2(I.x.y, I.x.x);
}

// An angle is not defined where an axis of I is along that axis of J about which nothing can be seen.
struct Angle {
  std::string_view name;
  char axis_I, axis_J;
};
constexpr std::array<Angle, 3> projected_angles = {{{"AX", 'z', 'x'}, {"AY", 'z', 'y'}, {"AZ", 'x', 'z'}}};

// Of those that are read the first for which both arguments of ATAN2 vanish: below that they are roundings.
const Angle* first_undefined(const AnglesRead& read, const RelativeFrame<double>& I) {
  constexpr double rounding_of_axes = 1e-12;
  const std::array<double, 3> sizes = {std::hypot(I.z.y, I.z.z), std::hypot(I.z.x, I.z.z), std::hypot(I.x.y, I.x.x)};
  for (std::size_t k = 0; k < 3; ++k) {
    if (read[k] && sizes[k] < rounding_of_axes) return &projected_angles[k];
  }
  return nullptr;
}

}  // namespace

CountedAngles::CountedAngles(Layout& layout, MarkerId i, MarkerId j, const AnglesRead& read) : read_(read) {
  constexpr std::array<Measure, 3> measures = {Measure::AX, Measure::AY, Measure::AZ};
  for (std::size_t k = 0; k < 3; ++k) {
    if (read[k]) entries_[k] = layout.count_turns(measures[k], i, j);
  }
}

RelativeDisplacement relative_displacement(const PairMotion& pair, const CountedAngles& angles) {
  const auto I = path::seeded<12>(pair.relative);
  // Relative angular velocity, ½ Σ a × a′ over the axes of I seen from J.
  const auto half_sum = [&](std::size_t u, std::size_t v) {
    Dual<12> sum(0.0);
    for (const auto* a : {&I.x, &I.y, &I.z}) sum = sum + (*a)[u].value * (*a)[v].rate - (*a)[v].value * (*a)[u].rate;
    return sum * 0.5;
  };
  const std::array<Dual<12>, 6> rates = {I.p.x.rate,     I.p.y.rate,     I.p.z.rate,
                                         half_sum(1, 2), half_sum(2, 0), half_sum(0, 1)};
  RelativeDisplacement d;
  const auto take = [&](std::size_t r, const Dual<12>& y) {
    d.y[r] = y.value;
    for (std::size_t k = 0; k < 6; ++k) d.on_pose[r][k] = y.partial[k];
  };
  for (std::size_t r = 0; r < 3; ++r) {
    take(r, I.p[r].value);
    if (!angles.read()[r]) continue;
    take(3 + r, projected_angle(r, I).value);
    d.y[3 + r] = unwrapped(d.y[3 + r], angles.total(r, *pair.motion));
  }
  for (std::size_t r = 0; r < 6; ++r) {
    d.rate[r] = rates[r].value;
    for (std::size_t k = 0; k < 6; ++k) {
      d.rate_on_pose[r][k] = rates[r].partial[k];
      d.rate_on_rate[r][k] = rates[r].partial[6 + k];
    }
  }
  return d;
}

std::optional<UndefinedValue> undefined_angle(const ElementLabel& label, const AnglesRead& read, const PairMotion& pair,
                                              std::string_view I) {
  const Angle* angle = first_undefined(read, pose_of(pair.relative));
  if (!angle) return std::nullopt;
  return UndefinedValue{&label,
                        fmt::format("{}: the angle {} is not defined where the {} axis of {} is along the {} axis of J",
                                    label.full_text(), angle->name, angle->axis_I, I, angle->axis_J),
                        false};
}

void warn_of_undefined_angles(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j,
                              const AnglesRead& read, Diagnostics& diagnostics) {
  const Angle* angle = first_undefined(read, drawn_frame(model, i, j));
  if (!angle) return;
  const std::string name_I = model.marker(i).label->text(), name_J = model.marker(j).label->text();
  diagnostics.warning(
      "skew-axes", label.at,
      fmt::format("{} reads the angle {} of {} in {}, which is not defined as drawn: the {} axis of {} "
                  "is along the {} axis of {}",
                  label.full_text(), angle->name, name_I, name_J, angle->axis_I, name_I, angle->axis_J, name_J),
      "such a force is for small angles: give one of the markers the axes of the other");
}

}  // namespace dynalin
