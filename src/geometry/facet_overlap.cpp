#include "geometry/facet_overlap.h"

#include <algorithm>

#include "geometry/facet_arrangement.h"
#include "geometry/facet_pairs.h"

namespace dynalin {

namespace {

using Index = FacetBody::Index;

// Of the size: how far the one body is moved aside before it is looked where surfaces cross, so that edges which lie in
// a facet or meet another edge, as those of parts drawn flush do, are beside it for all who ask.
constexpr double far_aside = 1e-13;
const Vector shift_aside{0.5412, -0.2987, 0.7861};

constexpr double roundings = 1e-9;  // of an area

// --- integrals

Matrix3 outer(const Vector& a, const Vector& b) { return {a * b.x, a * b.y, a * b.z}; }

// Over a part of a plane.
struct PlaneMoments {
  double area = 0;
  Vector first{};    // ∫ x dS
  Matrix3 second{};  // ∫ x xᵀ dS
  void add(const Vector& a, const Vector& b, const Vector& c, const Vector& normal) {
    const double s = 0.5 * dot(normal, cross(b - a, c - a));
    const Vector sum = a + b + c;
    area += s;
    first += sum * (s / 3);
    second += (s / 12) * (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum));
  }
};

// The part of one triangle, with the normal n out of what is full, that bounds a volume.
void add_part(const PlaneMoments& m, const Vector& n, bool of_I, Overlap& o) {
  o.volume += dot(n, m.first) / 3;
  for (std::size_t k = 0; k < 3; ++k) o.moment[k] += 0.5 * n[k] * m.second(k, k);
  if (!of_I) return;
  // The surface moves by (d + w × x) · n = d · n + w · (x × n).
  o.volume_by_shift += n * m.area;
  o.volume_by_turn += cross(m.first, n);
  o.moment_by_shift += outer(m.first, n);
  const auto crossed = [&](const Vector& row) { return cross(row, n); };
  const Matrix3 rows = {crossed(m.second.x), crossed(m.second.y), crossed(m.second.z)};
  o.moment_by_turn += transpose(rows);
}

// How the part of a facet grows where a facet of the other body cuts it: the cut moves over it with the velocity, seen
// from it, of the other body along the normal of that one's facet by the sine of the angle between both.
void add_cut(const SurfacePiece& p, const Vector& normal, const Vector& other_normal, const Vector& origin,
             Overlap::Part& part) {
  constexpr double parallel = 1e-9;  // sine: of facets in one plane, of which either all or nothing is inside
  const double sine = norm(cross(normal, other_normal));
  if (sine <= parallel) return;
  const double length = (p.of_I ? -1 : 1) * norm(p.to - p.from) / sine;
  const Vector middle = 0.5 * (p.from + p.to) - origin;
  part.area_by_shift += other_normal * length;
  part.area_by_turn += cross(middle, other_normal) * length;
}

std::vector<Overlap> integrals(const std::vector<SurfacePiece>& pieces, const PlacedSurface& I, const PlacedSurface& J,
                               double size) {
  std::vector<Overlap> volumes;
  const auto same_volume = [](const SurfacePiece& a, const SurfacePiece& b) { return a.volume == b.volume; };
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    const SurfacePiece& first = pieces[begin];
    if (begin == 0 || !same_volume(pieces[begin - 1], first)) volumes.emplace_back().origin = first.from;
    Overlap& o = volumes.back();
    const PlacedSurface &A = first.of_I ? I : J, &B = first.of_I ? J : I;
    const Vector n = A.normal(first.triangle);
    const Vector start = first.from - o.origin;
    Overlap::Part part{first.triangle};
    PlaneMoments m;
    double reach = 0;
    for (; end < pieces.size(); ++end) {
      const SurfacePiece& p = pieces[end];
      if (!same_volume(p, first) || p.of_I != first.of_I || p.triangle != first.triangle) break;
      m.add(start, p.from - o.origin, p.to - o.origin, n);
      reach = std::max(reach, norm(p.to - first.from));
      if (p.other != SurfacePiece::none) add_cut(p, n, B.normal(p.other), o.origin, part);
    }
    // What bounds a hole in the part of another volume.
    if (m.area < -roundings * reach * (reach + 1e-3 * size)) o.whole = false;
    add_part(m, n, first.of_I, o);
    part.area = m.area;
    (first.of_I ? o.of_I : o.of_J).push_back(part);
  }
  return volumes;
}

// Whether a lump of one of the bodies that crosses nothing is wholly in the other one: in what the facets of B bound,
// or in a cavity in what is around them.
bool engulfs(const SurfaceArrangement& found, bool of_I, const FacetBody& A, const RelativeFrame<double>& A_from_B,
             const FacetBody& B, bool cavity) {
  Index next = 0;
  for (Index t = 0; t < A.lump_of().size(); ++t) {
    if (A.lump_of()[t] != next) continue;
    const Index lump = next++;
    if (found.lumps[of_I].contains(lump)) continue;
    const PlacedSurface placed(A, A_from_B, false);
    if (B.nearest(placed.at(placed.corner(t, 0))).outside == cavity) return true;
  }
  return false;
}

}  // namespace

Overlaps find_overlaps(const FacetBody& I, const RelativeFrame<double>& f, const FacetBody& J, bool cavity) {
  Overlaps found;
  const double size = I.radius() + J.radius();
  const RelativeFrame<double> own{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const RelativeFrame<double> J_from_I{-Vector{dot(f.x, f.p), dot(f.y, f.p), dot(f.z, f.p)},
                                       {f.x.x, f.y.x, f.z.x},
                                       {f.x.y, f.y.y, f.z.y},
                                       {f.x.z, f.y.z, f.z.z}};
  const auto pairs = near_pairs(I, f, J);
  for (const double times : {1.0, -7.0, 53.0}) {
    RelativeFrame<double> beside = f;
    beside.p += (times * far_aside * size) * shift_aside;
    const PlacedSurface placed_I(I, beside, false), placed_J(J, own, cavity);
    const SurfaceArrangement crossing = arrangement(placed_I, placed_J, pairs);
    found.definite = crossing.consistent;
    if (!found.definite) continue;
    found.engulfed = engulfs(crossing, true, I, f, J, cavity) || engulfs(crossing, false, J, J_from_I, I, false);
    found.volumes = integrals(crossing.pieces, placed_I, placed_J, size);
    return found;
  }
  return found;
}

}  // namespace dynalin
