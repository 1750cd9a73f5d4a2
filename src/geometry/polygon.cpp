#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

constexpr double least_area = 1e-12;  // of the square of the size: what has less area has none

struct Flat {
  double x = 0, y = 0;
};
// Twice the area of a triangle, positive counter-clockwise.
double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Cuts off corners in which the rest has no part, one after the other.
class EarClipping {
 public:
  EarClipping(std::vector<Flat> corners, double least) : at_(std::move(corners)), least_(least) {
    for (std::size_t k = 0; k < at_.size(); ++k) rest_.push_back(k);
  }

  bool clip() {
    std::size_t tried = 0, k = 0;
    while (rest_.size() > 3) {
      const std::size_t n = rest_.size();
      if (tried == n || work_ > most_work) return false;
      k %= n;
      const std::size_t before = rest_[(k + n - 1) % n], tip = rest_[k], after = rest_[(k + 1) % n];
      if (!is_ear(before, tip, after)) {
        ++tried, ++k;
        continue;
      }
      triangles.push_back({before, tip, after});
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(k));
      tried = 0;
    }
    if (turn(at_[rest_[0]], at_[rest_[1]], at_[rest_[2]]) <= least_) return false;
    triangles.push_back({rest_[0], rest_[1], rest_[2]});
    return true;
  }

  std::vector<std::array<std::size_t, 3>> triangles;

 private:
  static constexpr std::size_t most_work = 30'000'000;  // it grows with the cube of the corners at worst

  bool is_ear(std::size_t a, std::size_t b, std::size_t c) {
    work_ += rest_.size();
    if (turn(at_[a], at_[b], at_[c]) <= least_) return false;
    // A corner on the new side counts as inside: it would be left on the side of a triangle.
    return std::none_of(rest_.begin(), rest_.end(), [&](std::size_t p) {
      return p != a && p != b && p != c && turn(at_[a], at_[b], at_[p]) >= -least_ &&
             turn(at_[b], at_[c], at_[p]) >= -least_ && turn(at_[c], at_[a], at_[p]) >= -least_;
    });
  }

  std::vector<Flat> at_;
  double least_;
  std::size_t work_ = 0;
  std::vector<std::size_t> rest_;
};

double square_of_size(std::span<const Vector> corners) {
  double size = 0;
  for (const Vector& p : corners) size = std::max(size, dot(p - corners[0], p - corners[0]));
  return size;
}

bool is_convex(std::span<const Vector> corners, const Vector& normal, double least) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector &a = corners[(k + n - 1) % n], &b = corners[k], &c = corners[(k + 1) % n];
    if (dot(cross(b - a, c - b), normal) <= least) return false;
  }
  return true;
}

}  // namespace

Vector vector_area(std::span<const Vector> corners) {
  Vector sum;
  for (std::size_t k = 2; k < corners.size(); ++k) sum += cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  return 0.5 * sum;
}

bool add_polygon(Mesh& mesh, std::span<const Mesh::Index> corners) {
  if (corners.size() < 3) return false;
  std::vector<Vector> at;
  for (const Mesh::Index v : corners) at.push_back(mesh.vertices[v]);
  const Vector area = vector_area(at);
  const double size = square_of_size(at), least = least_area * size;
  if (!(norm(area) > least) || !std::isfinite(size)) return false;
  const Vector z = normalized(area);
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return true;
  }
  if (corners.size() == 4 && is_convex(at, z, least)) {
    mesh.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
    return true;
  }
  const Vector across = std::abs(z.x) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const Vector x = normalized(cross(across, z)), y = cross(z, x);
  std::vector<Flat> plane;
  for (const Vector& p : at) plane.push_back({dot(p - at[0], x), dot(p - at[0], y)});
  EarClipping ears(std::move(plane), least);
  if (!ears.clip()) return false;
  for (const auto& t : ears.triangles) mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  return true;
}

}  // namespace dynalin
