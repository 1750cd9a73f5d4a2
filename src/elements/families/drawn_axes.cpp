#include "elements/families/drawn_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/families/common_frame.h"

namespace dynalin {

namespace {

constexpr double nearly_parallel = 1 - 5e-7;  // of a cosine: a milliradian

// What the joint asks of axes that a row belongs to: where z of I is perpendicular to x and y of J, the z axes are
// parallel, and so are then the x axes where x of I is perpendicular to y of J.
std::string demand(const AxesOfPair& axes, bool z_axes_parallel, const std::string& I, const std::string& J) {
  constexpr std::string_view letters = "xyz";
  const char of_I = letters[axes.of_I], of_J = letters[axes.of_J];
  if (of_I == of_J)
    return fmt::format("the {} axes of {} and {} must be perpendicular, and are drawn parallel", of_I, I, J);
  if (z_axes_parallel)
    return fmt::format("the {} axes of {} and {} must be parallel, and are drawn perpendicular", of_I, I, J);
  return fmt::format("the {} axis of {} and the {} axis of {} must be perpendicular, and are drawn parallel", of_I, I,
                     of_J, J);
}

Vector axis_of(const RelativeFrame<double>& I, std::size_t axis) { return axis == 0 ? I.x : axis == 1 ? I.y : I.z; }

}  // namespace

void check_drawn_axes(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j,
                      std::span<const PairRow> rows, std::string_view hint, Diagnostics& diagnostics) {
  const RelativeFrame<double> I = drawn_frame(model, i, j);
  const std::string name_I = model.marker(i).label->text(), name_J = model.marker(j).label->text();
  for (const PairRow row : rows) {
    const auto axes = perpendicular_axes(row);
    std::string text;
    if (axes && std::abs(axis_of(I, axes->of_I)[axes->of_J]) > nearly_parallel) {
      text = demand(*axes, has_row(rows, PairRow::Zi_Xj), name_I, name_J);
    } else if (row == PairRow::equal_angles && std::abs(I.x.y - I.y.x) > 2 * nearly_parallel) {
      text = fmt::format(
          "the angle from x of {0} to y of {1} must be that from y of {0} to x of {1}, and they are drawn as far apart "
          "as can be",
          name_I, name_J);
    } else if (row == PairRow::pinion && std::abs(I.z.z) > nearly_parallel) {
      text = fmt::format(
          "the z axis of {}, about which the pinion turns, and the z axis of {}, along the rack, are drawn parallel",
          name_I, name_J);
    }
    if (text.empty()) continue;
    text = fmt::format("{}: {}", label.full_text(), text);
    if (model.edited) {
      diagnostics.warning("parallel-axes", label.at, std::move(text),
                          "that is the drawing; by now bodies may stand otherwise");
    } else {
      diagnostics.error("parallel-axes", label.at, std::move(text), std::string(hint));
    }
    return;
  }
}

void warn_of_skew_axes(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j,
                       Diagnostics& diagnostics) {
  const double cosine = drawn_frame(model, i, j).z.z;
  if (cosine > nearly_parallel) return;
  diagnostics.warning(
      "skew-axes", label.at,
      fmt::format("the z axes of {} and {} are {:.4g} degrees apart as drawn, and {} acts about that of {}",
                  model.marker(i).label->text(), model.marker(j).label->text(),
                  std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi, label.full_text(),
                  model.marker(j).label->text()),
      "they are meant to be parallel and to point the same way");
}

void warn_of_missing_line(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j,
                          Diagnostics& diagnostics) {
  const Marker &I = model.marker(i), &J = model.marker(j);
  if (I.floating || J.floating || I.place.body == J.place.body) return;
  const double size = norm(model.body(J.place.body).pose.r) + norm(J.place.p_BM);
  if (norm(drawn_frame(model, i, j).p) > rounding_of_places * size) return;
  diagnostics.warning("no-line-of-action", label.at,
                      fmt::format("{} and {} are drawn at one point: the line of action of {} has no direction there",
                                  I.label->text(), J.label->text(), label.full_text()),
                      "only a force that is zero there can be: draw the markers apart, or use one along axes");
}

std::string text_without_direction(const ElementLabel& label) {
  return "the markers of " + label.full_text() + " coincide, its line of action has no direction";
}

}  // namespace dynalin
