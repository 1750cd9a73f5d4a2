#include "geometry/solid_overlap.h"

#include <algorithm>
#include <map>

#include "geometry/facet_tree.h"
#include "geometry/seen_back.h"
#include "geometry/solid_crossings.h"
#include "geometry/solid_sums.h"

namespace dynalin {

namespace {

using Index = FacetBody::Index;

// Of the size: how far the solid is moved aside, as bodies of facets are (facet_overlap.cpp), so that rims in a facet
// and mantles along an edge are beside it for all who ask.
constexpr double beside = 1e-13;
const Vector beside_way{0.5412, -0.2987, 0.7861};

Vector along(const RelativeFrame<double>& f, const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; }

// What Eigen asks for all triangles whose boxes meet another one.
struct BoxesIn {
  BoundingBox box;
  const FacetBody::Tree& tree;
  std::vector<Index>& found;

  bool intersectVolume(const BoundingBox& b) const { return box.intersects(b); }
  bool intersectObject(int item) const {
    if (box.intersects(tree.boxes[static_cast<std::size_t>(item)])) found.push_back(static_cast<Index>(item));
    return false;  // go on
  }
};

std::vector<Index> near_triangles(const QuadricSolid& solid, const RelativeFrame<double>& f, const FacetBody& J) {
  const double slack = 1e-11 * (solid.size() + J.radius());
  Vector low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector row{f.x[k], f.y[k], f.z[k]};
    low[k] = f.p[k] + dot(row, solid.farthest(-row)) - slack;
    high[k] = f.p[k] + dot(row, solid.farthest(row)) + slack;
  }
  std::vector<Index> found;
  BoxesIn search{{to_eigen(low), to_eigen(high)}, J.tree(), found};
  Eigen::BVIntersect(J.tree().hierarchy, search);
  std::ranges::sort(found);
  return found;
}

// And for the least distance.
struct NearestTriangle {
  using Scalar = double;
  const QuadricSolid& solid;
  const PlacedSurface& surface;
  const RelativeFrame<double>& from_J;
  const FacetBody::Tree& tree;

  double minimumOnVolume(const BoundingBox& b) const {
    const Eigen::Vector3d c = b.center();
    return apart(solid, from_J.p + along(from_J, Vector{c[0], c[1], c[2]})) - 0.5 * b.diagonal().norm();
  }
  double minimumOnObject(int item) const {
    const auto t = static_cast<Index>(item);
    return least_apart(solid, surface.at(surface.corner(t, 0)), surface.at(surface.corner(t, 1)),
                       surface.at(surface.corner(t, 2)));
  }
};

// From the axes of the solid to those of J.
struct Turned {
  Matrix3 R;
  void operator()(Overlap::Part& p) const {
    p.area_by_shift = R * p.area_by_shift, p.area_by_turn = R * p.area_by_turn;
  }
  Matrix3 of(const Matrix3& m) const { return R * m * transpose(R); }
  void operator()(Overlap::FixedPart& p) const {
    (*this)(static_cast<Overlap::Part&>(p));
    p.first = R * p.first, p.first_by_shift = of(p.first_by_shift), p.first_by_turn = of(p.first_by_turn);
  }
  void operator()(SolidOverlap& o) const {
    o.moment = R * o.moment, o.volume_by_shift = R * o.volume_by_shift, o.volume_by_turn = R * o.volume_by_turn;
    o.moment_by_shift = of(o.moment_by_shift), o.moment_by_turn = of(o.moment_by_turn);
    for (Vector& v : o.corners) v = R * v;
    for (Overlap::FixedPart& p : o.of_J) (*this)(p);
    (*this)(o.curved), (*this)(o.low), (*this)(o.high);
  }
};

// False where roundings leave open what there is.
bool find_volumes(SolidCrossings& crossings, const QuadricSolid& solid, const RelativeFrame<double>& f,
                  const FacetBody& J, bool cavity, SolidOverlaps& found) {
  if (!crossings.consistent()) return false;
  const auto inside = [&](const Vector& p) { return J.nearest(f.p + along(f, p)).outside == cavity; };
  found.engulfed = crossings.empty() ? inside(solid.centre()) : crossings.has_closed_patch();
  if (crossings.empty() || found.engulfed) return true;
  const bool lower = solid.has_ends() && inside(crossings.pole(false)), upper = inside(crossings.pole(true));
  crossings.join(lower, upper);
  if (!crossings.consistent()) return false;
  std::map<std::size_t, SolidSums> volumes;  // in order of their first facet
  std::unordered_map<std::size_t, std::size_t> number;
  for (const auto& part : crossings.parts()) {
    const std::size_t n = number.try_emplace(part.volume, number.size()).first->second;
    volumes.try_emplace(n, solid).first->second.add(part.section, part.arcs);
  }
  for (const auto& [volume, n] : number) {
    SolidSums& sums = volumes.at(n);
    if (!sums.finish(lower && volume == crossings.volume_of_pole(false),
                     upper && volume == crossings.volume_of_pole(true)))
      return false;
  }
  for (auto& [n, sums] : volumes) {
    SolidOverlap& o =
        found.volumes.emplace_back(SolidOverlap{std::move(sums.overlap), sums.curved, sums.low, sums.high});
    Turned{{f.x, f.y, f.z}}(o);
    o.origin = f.p;
  }
  return true;
}

}  // namespace

SolidOverlaps find_overlaps(const QuadricSolid& solid, const RelativeFrame<double>& f, const FacetBody& J,
                            bool cavity) {
  const double size = solid.size() + J.radius();
  for (const double times : {1.0, -7.0, 53.0}) {
    const Vector aside = (times * beside * size) * beside_way;
    const RelativeFrame<double> moved{f.p + aside, f.x, f.y, f.z};
    const PlacedSurface surface(J, seen_back(moved), cavity);
    SolidCrossings crossings(solid, surface, near_triangles(solid, moved, J));
    SolidOverlaps found;
    if (!find_volumes(crossings, solid, moved, J, cavity, found)) continue;
    found.aside = aside;
    return found;
  }
  SolidOverlaps none;
  none.definite = false;
  return none;
}

double least_distance(const QuadricSolid& solid, const RelativeFrame<double>& f, const FacetBody& J) {
  const RelativeFrame<double> from_J = seen_back(f);
  const PlacedSurface surface(J, from_J, false);
  NearestTriangle search{solid, surface, from_J, J.tree()};
  return std::max(Eigen::BVMinimize(J.tree().hierarchy, search), 0.0);
}

}  // namespace dynalin
