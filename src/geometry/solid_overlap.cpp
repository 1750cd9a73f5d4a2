#include "geometry/solid_overlap.h"

#include <algorithm>
#include <map>

#include "geometry/facet_tree.h"
#include "geometry/seen_back.h"
#include "geometry/solid_crossings.h"
#include "geometry/solid_sums.h"
#include "geometry/torus_crossings.h"
#include "geometry/torus_sums.h"

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

template <class Solid>
std::vector<Index> near_triangles(const Solid& solid, const RelativeFrame<double>& f, const FacetBody& J) {
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
template <class Solid>
struct NearestTriangle {
  using Scalar = double;
  const Solid& solid;
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

// Of all parts of facets, each volume's one after the other in order of their first facets. finish(sums, volume): false
// where it is none.
template <class Sums, class Parts, class Solid, class Add, class Finish>
bool add_up(Parts& parts, const Solid& solid, const Add& add, const Finish& finish, std::vector<Sums>& all) {
  std::map<std::size_t, Sums> volumes;
  std::unordered_map<std::size_t, std::size_t> number;
  for (const auto& part : parts) {
    const std::size_t n = number.try_emplace(part.volume, number.size()).first->second;
    add(volumes.try_emplace(n, solid).first->second, part);
  }
  for (const auto& [volume, n] : number) {
    if (!finish(volumes.at(n), volume)) return false;
  }
  for (auto& [n, sums] : volumes) all.push_back(std::move(sums));
  return true;
}

struct Surroundings {
  const RelativeFrame<double>& from_J;
  const FacetBody& J;
  bool cavity;
  bool hold(const Vector& p) const { return J.nearest(from_J.p + along(from_J, p)).outside == cavity; }
};

void add_volume(FacetSums& sums, const Overlap::Part& low, const Overlap::Part& high, SolidOverlaps& found) {
  SolidOverlap& o = found.volumes.emplace_back(SolidOverlap{std::move(sums.overlap), sums.curved, low, high});
  o.origin = sums.origin;
}

// False where roundings leave open what there is.
bool find_volumes(const QuadricSolid& solid, const PlacedSurface& surface, const std::vector<Index>& near,
                  const Surroundings& around, SolidOverlaps& found) {
  SolidCrossings crossings(solid, surface, near);
  if (!crossings.consistent()) return false;
  found.engulfed = crossings.empty() ? around.hold(solid.centre()) : crossings.has_closed_patch();
  if (crossings.empty() || found.engulfed) return true;
  const bool lower = solid.has_ends() && around.hold(crossings.pole(false)), upper = around.hold(crossings.pole(true));
  crossings.join(lower, upper);
  if (!crossings.consistent()) return false;
  const auto finish = [&](SolidSums& sums, std::size_t volume) {
    return sums.finish(lower && volume == crossings.volume_of_pole(false),
                       upper && volume == crossings.volume_of_pole(true));
  };
  std::vector<SolidSums> volumes;
  const auto add = [](SolidSums& sums, const SolidCrossings::Part& p) { sums.add(p.section, p.arcs); };
  if (!add_up(crossings.parts(), solid, add, finish, volumes)) return false;
  for (SolidSums& s : volumes) add_volume(s, s.low, s.high, found);
  return true;
}

bool find_volumes(const TorusSolid& torus, const PlacedSurface& surface, const std::vector<Index>& near,
                  const Surroundings& around, SolidOverlaps& found) {
  TorusCrossings crossings(torus, surface, near);
  if (!crossings.consistent()) return false;
  found.engulfed = crossings.empty() ? around.hold(torus.centre()) : crossings.has_closed_patch();
  if (crossings.empty() || found.engulfed) return true;
  crossings.join(around.hold(crossings.seam()));
  if (!crossings.consistent()) return false;
  const auto finish = [&](TorusSums& sums, std::size_t volume) {
    return sums.finish(crossings.holds_most_of_seam(volume));
  };
  std::vector<TorusSums> volumes;
  const auto add = [](TorusSums& sums, const TorusCrossings::Part& p) { sums.add(p.section); };
  if (!add_up(crossings.parts(), torus, add, finish, volumes)) return false;
  for (TorusSums& s : volumes) add_volume(s, {}, {}, found);
  return true;
}

template <class Solid>
SolidOverlaps overlaps_of(const Solid& solid, const RelativeFrame<double>& f, const FacetBody& J, bool cavity) {
  const double size = solid.size() + J.radius();
  for (const double times : {1.0, -7.0, 53.0}) {
    const Vector aside = (times * beside * size) * beside_way;
    const RelativeFrame<double> moved{f.p + aside, f.x, f.y, f.z};
    const PlacedSurface surface(J, seen_back(moved), cavity);
    SolidOverlaps found;
    if (!find_volumes(solid, surface, near_triangles(solid, moved, J), {moved, J, cavity}, found)) continue;
    for (SolidOverlap& o : found.volumes) {
      Turned{{f.x, f.y, f.z}}(o);
      o.origin = moved.p + along(f, o.origin);
    }
    found.aside = aside;
    return found;
  }
  SolidOverlaps none;
  none.definite = false;
  return none;
}

template <class Solid>
double least_distance_of(const Solid& solid, const RelativeFrame<double>& f, const FacetBody& J) {
  const RelativeFrame<double> from_J = seen_back(f);
  const PlacedSurface surface(J, from_J, false);
  NearestTriangle<Solid> search{solid, surface, from_J, J.tree()};
  return std::max(Eigen::BVMinimize(J.tree().hierarchy, search), 0.0);
}

}  // namespace

SolidOverlaps find_overlaps(const QuadricSolid& solid, const RelativeFrame<double>& f, const FacetBody& J,
                            bool cavity) {
  return overlaps_of(solid, f, J, cavity);
}
SolidOverlaps find_overlaps(const TorusSolid& torus, const RelativeFrame<double>& f, const FacetBody& J, bool cavity) {
  return overlaps_of(torus, f, J, cavity);
}

double least_distance(const QuadricSolid& solid, const RelativeFrame<double>& f, const FacetBody& J) {
  return least_distance_of(solid, f, J);
}
double least_distance(const TorusSolid& torus, const RelativeFrame<double>& f, const FacetBody& J) {
  return least_distance_of(torus, f, J);
}

}  // namespace dynalin
