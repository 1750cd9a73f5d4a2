#include "elements/families/drawn_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

constexpr double nearly_parallel = 1 - 5e-7;  // of a cosine: a milliradian

// "Zi.Xj": an axis of I and one of J.
bool is_product(std::string_view row) { return row.size() == 5 && row[1] == 'i' && row[2] == '.' && row[4] == 'j'; }

std::size_t axis(char letter) { return static_cast<std::size_t>(letter - 'X'); }

double component(const Vector& v, char letter) { return v[axis(letter)]; }

Vector axis_of(const RelativeFrame<double>& I, char letter) { return letter == 'X' ? I.x : letter == 'Y' ? I.y : I.z; }

char small(char letter) { return static_cast<char>(letter - 'X' + 'x'); }

// What the joint asks of axes that a row belongs to: where z of I is perpendicular to x and y of J, the z axes are
// parallel, and so are then the x axes where x of I is perpendicular to y of J.
std::string demand(std::string_view row, bool z_axes_parallel, const std::string& I, const std::string& J) {
  if (row[0] == row[3])
    return fmt::format("the {} axes of {} and {} must be perpendicular, and are drawn parallel", small(row[0]), I, J);
  if (z_axes_parallel)
    return fmt::format("the {} axes of {} and {} must be parallel, and are drawn perpendicular", small(row[0]), I, J);
  return fmt::format("the {} axis of {} and the {} axis of {} must be perpendicular, and are drawn parallel",
                     small(row[0]), I, small(row[3]), J);
}

}  // namespace

void check_drawn_axes(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j,
                      std::span<const std::string_view> row_names, std::string_view hint, Diagnostics& diagnostics) {
  const RelativeFrame<double> I = drawn_frame(model, i, j);
  const bool z_axes_parallel = std::find(row_names.begin(), row_names.end(), "Zi.Xj") != row_names.end();
  const std::string name_I = model.marker(i).label->text(), name_J = model.marker(j).label->text();
  for (const std::string_view row : row_names) {
    std::string text;
    if (is_product(row) && std::abs(component(axis_of(I, row[0]), row[3])) > nearly_parallel) {
      text = demand(row, z_axes_parallel, name_I, name_J);
    } else if (row == "Xi.Yj-Yi.Xj" && std::abs(I.x.y - I.y.x) > 2 * nearly_parallel) {
      text = fmt::format(
          "the angle from x of {0} to y of {1} must be that from y of {0} to x of {1}, and they are drawn as far apart "
          "as can be",
          name_I, name_J);
    } else if (row == "DZ-PINION" && std::abs(I.z.z) > nearly_parallel) {
      text = fmt::format(
          "the z axis of {}, about which the pinion turns, and the z axis of {}, along the rack, are drawn parallel",
          name_I, name_J);
    }
    if (text.empty()) continue;
    diagnostics.error("parallel-axes", label.at, fmt::format("{}: {}", label.full_text(), text), std::string(hint));
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

}  // namespace dynalin
