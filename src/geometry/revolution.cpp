#include "geometry/revolution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon.h"

namespace dynalin {

namespace {

using Index = Mesh::Index;
constexpr double full_turn = 2 * std::numbers::pi;

std::size_t pieces(const Sweep& sweep) {
  const auto fewest = static_cast<std::size_t>(std::ceil(3 * std::min(std::abs(sweep.angle) / full_turn, 1.0) - 1e-9));
  return std::max({sweep.segments, fewest, std::size_t{1}});
}

// Adds the faces as it goes: one row of vertices for each point of the profile.
class Revolving {
 public:
  Revolving(std::span<const Meridian> profile, bool ring, const Sweep& sweep)
      : profile_(profile), ring_(ring), full_(sweep.full()), pieces_(pieces(sweep)) {
    const double angle = full_ ? full_turn : sweep.angle;
    for (const Meridian& m : profile_) {
      first_.push_back(static_cast<Index>(mesh_.vertices.size()));
      const std::size_t count = m.radius > 0 ? columns() : 1;
      for (std::size_t i = 0; i < count; ++i) {
        const double azimuth = sweep.start + angle * static_cast<double>(i) / static_cast<double>(pieces_);
        mesh_.add({m.radius * std::cos(azimuth), m.radius * std::sin(azimuth), m.height});
      }
    }
  }

  Mesh mesh() {
    const std::size_t n = profile_.size();
    for (std::size_t k = 0; k + (ring_ ? 0 : 1) < n; ++k) add_band(k, (k + 1) % n);
    if (!full_ && (ring_ || (profile_.front().radius == 0 && profile_.back().radius == 0))) add_ends();
    close(mesh_);
    return std::move(mesh_);
  }

 private:
  std::size_t columns() const { return full_ ? pieces_ : pieces_ + 1; }
  bool on_axis(std::size_t k) const { return profile_[k].radius == 0; }
  Index vertex(std::size_t k, std::size_t column) const {
    return on_axis(k) ? first_[k] : first_[k] + static_cast<Index>(column % columns());
  }

  void add_band(std::size_t k, std::size_t next) {
    if (on_axis(k) && on_axis(next)) return;
    for (std::size_t i = 0; i < pieces_; ++i) {
      const Index a = vertex(k, i), b = vertex(k, i + 1), c = vertex(next, i + 1), d = vertex(next, i);
      if (on_axis(k))
        mesh_.triangles.push_back({a, c, d});
      else if (on_axis(next))
        mesh_.triangles.push_back({a, b, c});
      else
        mesh_.quads.push_back({a, b, c, d});
    }
  }

  // The plane faces where a wedge begins and ends.
  void add_ends() {
    std::vector<Index> begin, end;
    for (std::size_t k = 0; k < profile_.size(); ++k) begin.push_back(vertex(k, 0)), end.push_back(vertex(k, pieces_));
    std::reverse(end.begin(), end.end());
    add_polygon(mesh_, begin), add_polygon(mesh_, end);
  }

  std::span<const Meridian> profile_;
  bool ring_, full_;
  std::size_t pieces_;
  std::vector<Index> first_;
  Mesh mesh_;
};

}  // namespace

bool Sweep::full() const { return std::abs(angle) >= full_turn * (1 - rounding_of_turn); }

Mesh revolved(std::span<const Meridian> profile, bool ring, const Sweep& sweep) {
  return Revolving(profile, ring, sweep).mesh();
}

Mesh frustum(double bottom_radius, double top_radius, double length, const Sweep& sweep) {
  std::vector<Meridian> profile{{0, 0}};
  if (bottom_radius > 0) profile.push_back({bottom_radius, 0});
  if (top_radius > 0) profile.push_back({top_radius, length});
  profile.push_back({0, length});
  return revolved(profile, false, sweep);
}

Mesh cylinder(double radius, double length, const Sweep& sweep) { return frustum(radius, radius, length, sweep); }

Mesh ellipsoid(const Vector& semi_axes, std::size_t segments) {
  const Sweep around{.segments = segments};
  const std::size_t bands = std::max<std::size_t>(pieces(around) / 2, 2);
  std::vector<Meridian> profile;
  for (std::size_t k = 0; k <= bands; ++k) {
    const double polar = std::numbers::pi * static_cast<double>(k) / static_cast<double>(bands);
    const bool pole = k == 0 || k == bands;
    profile.push_back({pole ? 0.0 : std::sin(polar), -std::cos(polar)});
  }
  Mesh mesh = revolved(profile, false, around);
  for (Vector& p : mesh.vertices) p = {semi_axes.x * p.x, semi_axes.y * p.y, semi_axes.z * p.z};
  return mesh;
}

Mesh torus(double major_radius, double minor_radius, const Sweep& sweep) {
  const std::size_t around = std::max<std::size_t>(sweep.segments / 2, 3);
  std::vector<Meridian> profile;
  for (std::size_t k = 0; k < around; ++k) {
    const double angle = full_turn * static_cast<double>(k) / static_cast<double>(around);
    profile.push_back({major_radius + minor_radius * std::cos(angle), minor_radius * std::sin(angle)});
  }
  return revolved(profile, true, sweep);
}

}  // namespace dynalin
