#include "geometry/facet_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/facet_tree.h"

namespace dynalin {

namespace {

using Index = FacetBody::Index;
using Corners = std::array<Vector, 3>;

constexpr double slack = 1e-11;  // of the size: by which boxes are larger than what they hold

Vector placed(const RelativeFrame<double>& f, const Vector& v) { return f.p + f.x * v.x + f.y * v.y + f.z * v.z; }

// Boxes of I as they stand in the axes of J, about boxes of their own there.
class PlacedBoxes {
 public:
  PlacedBoxes(const FacetBody& I, const RelativeFrame<double>& f, const FacetBody& J)
      : origin_(f.p), rows_{Vector{f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}} {
    for (std::size_t k = 0; k < 3; ++k)
      sizes_[k] = {0.5 * std::abs(rows_[k].x), 0.5 * std::abs(rows_[k].y), 0.5 * std::abs(rows_[k].z)};
    wider_ = slack * (I.radius() + J.radius());
  }
  bool overlap(const BoundingBox& a, const BoundingBox& b) const {
    return apart(a, b, 0) <= 0 && apart(a, b, 1) <= 0 && apart(a, b, 2) <= 0;
  }
  double square_apart(const BoundingBox& a, const BoundingBox& b) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = std::max(apart(a, b, k), 0.0);
      sum += d * d;
    }
    return sum;
  }

 private:
  // Along axis k, negative where they overlap.
  double apart(const BoundingBox& a, const BoundingBox& b, std::size_t k) const {
    const auto &low = a.min(), &high = a.max();
    const Vector &row = rows_[k], &size = sizes_[k];
    const auto n = static_cast<Eigen::Index>(k);
    const double middle = origin_[k] +
                          0.5 * (row.x * (low[0] + high[0]) + row.y * (low[1] + high[1]) + row.z * (low[2] + high[2])),
                 half =
                     wider_ + size.x * (high[0] - low[0]) + size.y * (high[1] - low[1]) + size.z * (high[2] - low[2]);
    return std::max(middle - half - b.max()[n], b.min()[n] - middle - half);
  }

  Vector origin_;
  std::array<Vector, 3> rows_, sizes_;
  double wider_;
};

// What Eigen asks for the search of all pairs whose boxes overlap.
struct Overlapping {
  const FacetBody::Tree &I, &J;
  PlacedBoxes boxes;
  std::vector<std::pair<Index, Index>> found;

  const BoundingBox& box_I(int item) const { return I.boxes[static_cast<std::size_t>(item)]; }
  const BoundingBox& box_J(int item) const { return J.boxes[static_cast<std::size_t>(item)]; }
  bool intersectVolumeVolume(const BoundingBox& a, const BoundingBox& b) const { return boxes.overlap(a, b); }
  bool intersectVolumeObject(const BoundingBox& a, int b) const { return boxes.overlap(a, box_J(b)); }
  bool intersectObjectVolume(int a, const BoundingBox& b) const { return boxes.overlap(box_I(a), b); }
  bool intersectObjectObject(int a, int b) {
    if (boxes.overlap(box_I(a), box_J(b))) found.emplace_back(static_cast<Index>(a), static_cast<Index>(b));
    return false;  // go on
  }
};

// --- distances, squared

double from_segment(const Vector& p, const Vector& from, const Vector& to) {
  const Vector way = to - from;
  const Vector apart = p - from - way * std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
  return dot(apart, apart);
}

double between_segments(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  double least = std::min({from_segment(a, c, d), from_segment(b, c, d), from_segment(c, a, b), from_segment(d, a, b)});
  // Where both are nearest between their ends, across both.
  const Vector u = b - a, v = d - c, n = cross(u, v), w = c - a;
  const double square = dot(n, n);
  if (square <= 1e-24 * dot(u, u) * dot(v, v)) return least;
  const double s = dot(cross(w, v), n) / square, t = dot(cross(w, u), n) / square;
  if (s > 0 && s < 1 && t > 0 && t < 1) {
    const double height = dot(w, n);
    least = std::min(least, height * height / square);
  }
  return least;
}

// From the face of a triangle where the foot of p lies in it.
double from_face(const Vector& p, const Corners& t) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const double square = dot(n, n), height = dot(n, p - t[0]);
  const Vector foot = p - n * (height / square);
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(n, cross(t[(k + 1) % 3] - t[k], foot - t[k])) < 0) return std::numeric_limits<double>::infinity();
  }
  return height * height / square;
}

double between_triangles(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, from_face(a[i], b), from_face(b[i], a)});
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, between_segments(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return least;
}

// Whether all of b is in front of the plane that holds one edge of a and stands across a's face, or of the face itself,
// by at least the root of `square`.
bool is_beyond(const Corners& a, const Corners& b, double square) {
  const Vector n = cross(a[1] - a[0], a[2] - a[0]);
  const auto in_front = [&](const Vector& out, const Vector& from) {
    const double least = std::min({dot(out, b[0] - from), dot(out, b[1] - from), dot(out, b[2] - from)});
    return least > 0 && least * least >= square * dot(out, out);
  };
  if (in_front(n, a[0]) || in_front(-n, a[0])) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (in_front(cross(a[(k + 1) % 3] - a[k], n), a[k])) return true;
  }
  return false;
}

// And what it asks for the search of the least distance.
struct Nearest {
  using Scalar = double;
  const FacetBody &of_I, &of_J;
  const RelativeFrame<double>& frame;
  PlacedBoxes boxes;
  double least = std::numeric_limits<double>::infinity();

  const BoundingBox& box_I(int item) const { return of_I.tree().boxes[static_cast<std::size_t>(item)]; }
  const BoundingBox& box_J(int item) const { return of_J.tree().boxes[static_cast<std::size_t>(item)]; }
  double minimumOnVolumeVolume(const BoundingBox& a, const BoundingBox& b) const { return boxes.square_apart(a, b); }
  double minimumOnVolumeObject(const BoundingBox& a, int b) const { return minimumOnVolumeVolume(a, box_J(b)); }
  double minimumOnObjectVolume(int a, const BoundingBox& b) const { return minimumOnVolumeVolume(box_I(a), b); }
  double minimumOnObjectObject(int a, int b) {
    Corners at_I, at_J;
    for (std::size_t k = 0; k < 3; ++k) {
      at_I[k] = placed(frame, of_I.vertices()[of_I.triangles()[static_cast<std::size_t>(a)].corner[k]]);
      at_J[k] = of_J.vertices()[of_J.triangles()[static_cast<std::size_t>(b)].corner[k]];
    }
    // Caps of long, thin triangles have many pairs whose boxes overlap.
    if (is_beyond(at_I, at_J, least) || is_beyond(at_J, at_I, least)) return least;
    least = std::min(least, between_triangles(at_I, at_J));
    return least;
  }
};

}  // namespace

std::vector<std::pair<Index, Index>> near_pairs(const FacetBody& I, const RelativeFrame<double>& f,
                                                const FacetBody& J) {
  Overlapping search{I.tree(), J.tree(), PlacedBoxes(I, f, J), {}};
  Eigen::BVIntersect(I.tree().hierarchy, J.tree().hierarchy, search);
  return std::move(search.found);
}

double least_distance(const FacetBody& I, const RelativeFrame<double>& f, const FacetBody& J) {
  Nearest search{I, J, f, PlacedBoxes(I, f, J)};
  return std::sqrt(Eigen::BVMinimize(I.tree().hierarchy, J.tree().hierarchy, search));
}

}  // namespace dynalin
