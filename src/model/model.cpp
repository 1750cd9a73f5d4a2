#include "model/model.h"

#include <algorithm>

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
  const double length = std::max(norm(b - a), norm(c - b));
  return length > 0 ? length : 1.0;
}

}  // namespace dynalin
