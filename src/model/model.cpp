#include "model/model.h"

#include <algorithm>
#include <limits>

namespace dynalin {

std::optional<ElementHandle> Model::find(std::string_view statement, std::int64_t id) const {
  const auto table = ids.find(statement);
  if (table == ids.end()) return std::nullopt;
  const auto it = table->second.find(id);
  if (it == table->second.end()) return std::nullopt;
  return it->second;
}

bool Model::has(Kind::Gives what) const {
  return std::any_of(sets.begin(), sets.end(),
                     [&](const auto& set) { return set->kind().gives == what && set->size() > 0; });
}

std::optional<MarkerId> Model::find_marker(std::int64_t id) const {
  const auto it = marker_ids.find(id);
  if (it == marker_ids.end()) return std::nullopt;
  return it->second;
}

std::optional<BodyId> Model::find_body(std::string_view statement, std::int64_t id) const {
  const auto table = body_ids.find(statement);
  if (table == body_ids.end()) return std::nullopt;
  const auto it = table->second.find(id);
  if (it == table->second.end()) return std::nullopt;
  return it->second;
}

namespace {

// A radius about the middle of the points that holds three quarters of them; nothing where these are at one place but
// for rounding.
std::optional<double> radius_of_most(const std::vector<Vector>& points) {
  const auto ranked = [](std::vector<double>& x, std::size_t k) {
    std::ranges::nth_element(x, x.begin() + static_cast<std::ptrdiff_t>(k));
    return x[k];
  };
  Vector middle;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> x;
    for (const Vector& p : points) x.push_back(p[c]);
    middle[c] = ranked(x, x.size() / 2);
  }
  std::vector<double> distance;
  for (const Vector& p : points) distance.push_back(norm(p - middle));
  const double radius = ranked(distance, (3 * (distance.size() - 1)) / 4);
  constexpr double rounding = 1e3 * std::numeric_limits<double>::epsilon();
  return radius > rounding * norm(middle) ? std::optional(radius) : std::nullopt;
}

}  // namespace

double Model::characteristic_length() const {
  // The exact diameter of n points costs n²; two sweeps from the farthest point are within a factor of √3 and
  // the result is only a scale. Starting at the centroid makes it independent of numbering and placement.
  std::vector<Vector> points;
  points.reserve(markers.size());
  for (std::size_t k = 1; k < markers.size(); ++k) {
    const Body& b = body(markers[k].place.body);
    if (!markers[k].floating) points.push_back(b.pose.r + b.pose.R * markers[k].place.p_BM);
  }
  if (points.size() < 2) return 1.0;
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
  // A few that are drawn far out are no scale for all others: what is small beside them would count as nothing.
  constexpr double farther = 1e4;
  if (const auto radius = radius_of_most(points)) length = std::min(length, farther * *radius);
  return length > 0 ? length : 1.0;
}

}  // namespace dynalin
