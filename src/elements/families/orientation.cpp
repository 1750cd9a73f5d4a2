#include "elements/families/orientation.h"

#include <fmt/format.h>

#include <cmath>

namespace dynalin {

namespace {
// Points this close to a line, relative to their distance, do not define a plane.
constexpr double degenerate = 1e-10;
}  // namespace

std::optional<Matrix3> orientation(const WrittenOrientation& w, const Vector& origin, ElementReader& reader) {
  if (w.angles && (w.z_point || w.x_point)) {
    reader.error(
        "conflicting-orientation", reader.at(w.z_point ? w.z_name : w.x_name),
        fmt::format("{} states both {} and {}", reader.label().text(), w.angles_name, w.z_point ? w.z_name : w.x_name));
    return std::nullopt;
  }
  if (w.angles) return rotation_313(w.angles->x, w.angles->y, w.angles->z);
  if (!w.z_point && !w.x_point) return Matrix3::identity();

  const auto fail = [&](std::string_view argument, std::string what) {
    reader.error("degenerate-orientation", reader.at(argument), std::move(what));
    return std::nullopt;
  };
  // The leading axis runs through the exact point, the other point fixes the plane. Without ZP z stays what it is.
  const bool x_leads = w.x_exact;
  if (x_leads && !w.x_point) return fail(w.z_name, fmt::format("USEXP needs {}", w.x_name));
  const std::string_view lead_name = x_leads ? w.x_name : w.z_name;
  const auto& lead_point = x_leads ? w.x_point : w.z_point;
  const Vector lead = lead_point ? *lead_point - origin : Vector{0, 0, 1};
  if (norm(lead) == 0.0) {
    return fail(lead_name, fmt::format("{} of {} coincides with the origin", lead_name, reader.label().text()));
  }
  const Vector axis = normalized(lead);
  const auto& plane_point = x_leads ? w.z_point : w.x_point;
  Vector towards = x_leads ? Vector{0, 0, 1} : Vector{1, 0, 0};
  if (plane_point) {
    towards = *plane_point - origin;
  } else if (norm(cross(axis, towards)) < 1e-6) {
    towards = x_leads ? Vector{1, 0, 0} : Vector{0, 1, 0};
  }
  const Vector normal = x_leads ? cross(towards, axis) : cross(axis, towards);
  if (norm(normal) <= degenerate * norm(towards) || norm(towards) == 0.0) {
    if (!lead_point)
      return fail(w.x_name, fmt::format("{} of {} is on the z axis, which stays as it is without {}", w.x_name,
                                        reader.label().text(), w.z_name));
    return fail(x_leads ? w.z_name : w.x_name, fmt::format("{} and {} of {} lie on one line with the origin", w.z_name,
                                                           w.x_name, reader.label().text()));
  }
  const Vector y = normalized(normal);
  if (x_leads) return Matrix3{axis, y, cross(axis, y)};
  return Matrix3{cross(y, axis), y, axis};
}

}  // namespace dynalin
