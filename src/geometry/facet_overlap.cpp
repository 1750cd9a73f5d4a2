#include "geometry/facet_overlap.h"

#include <algorithm>
#include <type_traits>

#include "geometry/facet_arrangement.h"
#include "geometry/facet_integrals.h"
#include "geometry/facet_pairs.h"
#include "geometry/seen_back.h"

namespace dynalin {

namespace {

using Index = FacetBody::Index;

// Of the size: how far the one body is moved aside before it is looked where surfaces cross, so that edges which lie in
// a facet or meet another edge, as those of parts drawn flush do, are beside it for all who ask.
constexpr double far_aside = 1e-13;
const Vector shift_aside{0.5412, -0.2987, 0.7861};

constexpr double roundings = 1e-9;  // of an area

// --- integrals

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

// From `begin` on: the part of one triangle. Returns where the next one begins.
template <class Part>
std::size_t add_triangle(const std::vector<SurfacePiece>& pieces, std::size_t begin, const PlacedSurface& A,
                         const PlacedSurface& B, double size, Overlap& o, std::vector<Part>& parts) {
  const SurfacePiece& first = pieces[begin];
  const Vector n = A.normal(first.triangle), start = first.from - o.origin;
  Part part;
  part.triangle = first.triangle;
  PlaneMoments m;
  double reach = 0;
  std::size_t end = begin;
  for (; end < pieces.size(); ++end) {
    const SurfacePiece& p = pieces[end];
    if (p.volume != first.volume || p.of_I != first.of_I || p.triangle != first.triangle) break;
    m.add(start, p.from - o.origin, p.to - o.origin, n);
    o.corners.push_back(p.from - o.origin);
    reach = std::max(reach, norm(p.to - first.from));
    if (p.other == SurfacePiece::none) continue;
    const auto cut = StraightCut::of(p.from - o.origin, p.to - o.origin, n, B.normal(p.other), p.of_I ? -1.0 : 1.0);
    if (cut) cut->add_to(part);
  }
  // What bounds a hole in the part of another volume.
  if (m.area < -roundings * reach * (reach + 1e-3 * size)) o.whole = false;
  add_part(m, n, first.of_I, o);
  part.area = m.area;
  if constexpr (std::is_same_v<Part, Overlap::FixedPart>) part.first = m.first;
  parts.push_back(part);
  return end;
}

std::vector<Overlap> integrals(const std::vector<SurfacePiece>& pieces, const PlacedSurface& I, const PlacedSurface& J,
                               double size) {
  std::vector<Overlap> volumes;
  for (std::size_t k = 0; k < pieces.size();) {
    if (k == 0 || pieces[k].volume != pieces[k - 1].volume) volumes.emplace_back().origin = pieces[k].from;
    Overlap& o = volumes.back();
    k = pieces[k].of_I ? add_triangle(pieces, k, I, J, size, o, o.of_I)
                       : add_triangle(pieces, k, J, I, size, o, o.of_J);
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
  const auto pairs = near_pairs(I, f, J);
  for (const double times : {1.0, -7.0, 53.0}) {
    const Vector aside = (times * far_aside * size) * shift_aside;
    const RelativeFrame<double> beside{f.p + aside, f.x, f.y, f.z};
    const PlacedSurface placed_I(I, beside, false), placed_J(J, own, cavity);
    const SurfaceArrangement crossing = arrangement(placed_I, placed_J, pairs);
    found.definite = crossing.consistent;
    if (!found.definite) continue;
    found.engulfed =
        engulfs(crossing, true, I, beside, J, cavity) || engulfs(crossing, false, J, seen_back(beside), I, false);
    found.volumes = integrals(crossing.pieces, placed_I, placed_J, size);
    found.aside = aside;
    return found;
  }
  return found;
}

}  // namespace dynalin
