#include "model/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dynalin {

const std::shared_ptr<const StatedVelocity>& StatedVelocity::none() {
  static const auto nothing = std::make_shared<const StatedVelocity>();
  return nothing;
}

const std::shared_ptr<const BodyNature>& BodyNature::part() {
  static const auto rigid = std::make_shared<const BodyNature>();
  return rigid;
}

std::optional<ElementHandle> Model::find(std::string_view statement, std::int64_t id) const {
  const auto table = ids.find(statement);
  if (table == ids.end()) return std::nullopt;
  const ElementHandle* handle = table->second.find(id);
  return handle ? std::optional(*handle) : std::nullopt;
}

bool Model::has(Kind::Gives what) const {
  return std::any_of(sets.begin(), sets.end(),
                     [&](const auto& set) { return set->kind().gives == what && set->size() > 0; });
}

std::optional<MarkerId> Model::find_marker(std::int64_t id) const {
  if (id == 0) return global_frame;
  const MarkerId* marker = marker_ids.find(id);
  return marker ? std::optional(*marker) : std::nullopt;
}

std::optional<BodyId> Model::find_body(std::string_view statement, std::int64_t id) const {
  const auto table = body_ids.find(statement);
  if (table == body_ids.end()) return std::nullopt;
  const BodyId* body = table->second.find(id);
  return body ? std::optional(*body) : std::nullopt;
}

namespace {

double ranked(std::vector<double> x, std::size_t k) {
  std::ranges::nth_element(x, x.begin() + static_cast<std::ptrdiff_t>(k));
  return x[k];
}

// A radius about the middle of the points that holds three quarters of them.
double radius_of_most(const std::vector<Vector>& points) {
  Vector middle;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> x;
    x.reserve(points.size());
    for (const Vector& p : points) x.push_back(p[c]);
    middle[c] = ranked(std::move(x), points.size() / 2);
  }
  std::vector<double> distance;
  distance.reserve(points.size());
  for (const Vector& p : points) distance.push_back(norm(p - middle));
  return ranked(std::move(distance), (3 * (points.size() - 1)) / 4);
}

// The size of one body in the middle of all, from its mass centre to its markers or by its inertia; 0 without any.
double size_of_bodies(const Model& model, std::span<const MarkerId> markers) {
  std::vector<double> size;
  size.reserve(model.bodies.size());
  for (const Body& b : model.bodies)
    size.push_back(b.mass > 0 ? std::sqrt(std::max(0.0, trace(b.J_BC)) / b.mass) : 0.0);
  for (const MarkerId id : markers) {
    const Marker& m = model.marker(id);
    const auto b = static_cast<std::size_t>(m.place.body.index);
    if (!m.floating) size[b] = std::max(size[b], norm(m.place.p_BM - model.bodies[b].p_BC));
  }
  size.front() = 0;  // the ground may reach anywhere
  std::erase(size, 0.0);
  return size.empty() ? 0.0 : ranked(size, size.size() / 2);
}

std::vector<Vector> origins_of(const Model& model, std::span<const MarkerId> markers) {
  std::vector<Vector> points;
  points.reserve(markers.size());
  for (const MarkerId id : markers) {
    const Marker& m = model.marker(id);
    const Body& b = model.body(m.place.body);
    if (!m.floating) points.push_back(b.pose.r + b.pose.R * m.place.p_BM);
  }
  return points;
}

// The largest distance of two points, bounded by where most of them are and how large the bodies of the markers are:
// less than `coincide` of that is one place.
double extent_of(const Model& model, std::span<const MarkerId> markers, const std::vector<Vector>& points,
                 double coincide) {
  // The exact diameter of n points costs n²; two sweeps from the farthest point are within a factor of √3 and
  // the result is only a scale. Starting at the centroid makes it independent of numbering and placement.
  if (points.size() < 2) return 0;
  const auto farthest = [&](const Vector& from) {
    return *std::max_element(points.begin(), points.end(), [&](const Vector& a, const Vector& b) {
      return dot(a - from, a - from) < dot(b - from, b - from);
    });
  };
  Vector centroid{};
  for (const Vector& p : points) centroid += p / static_cast<double>(points.size());
  const Vector a = farthest(centroid);
  const Vector b = farthest(a);
  const Vector c = farthest(b);
  double length = std::max(norm(b - a), norm(c - b));
  // A few that are drawn far out are no scale for all others: what is small beside them would count as nothing. One
  // place is none either, but the bodies there are not so small.
  constexpr double farther = 1e4;
  if (const double size = size_of_bodies(model, markers); size > 0) {
    length = std::min(length, farther * std::max(radius_of_most(points), size));
    if (length <= coincide * size) length = size;
  }
  return length;
}

}  // namespace

double Model::characteristic_length() const {
  std::vector<MarkerId> all;
  all.reserve(markers.size());
  for (std::size_t k = 1; k < markers.size(); ++k) all.push_back(MarkerId{static_cast<std::int32_t>(k)});
  // Asked for while parts are read, whose mass centres may not be there yet: their size is not what it will be.
  constexpr double rounding = 1e-12;
  const double length = extent_of(*this, all, origins_of(*this, all), rounding);
  return length > 0 ? length : 1.0;
}

double Model::characteristic_length(std::span<const MarkerId> of) const {
  std::vector<Vector> points = origins_of(*this, of);
  for (const Body& b : bodies)
    if (b.mass > 0) points.push_back(b.pose.r + b.pose.R * b.p_BC);
  constexpr double nearly_coincide = 1e-3;
  const double length = extent_of(*this, of, points, nearly_coincide);
  return length > 0 ? length : characteristic_length();
}

}  // namespace dynalin
