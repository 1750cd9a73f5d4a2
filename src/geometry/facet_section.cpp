#include "geometry/facet_section.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynalin {

namespace {

using Index = FacetBody::Index;
using Piece = FacetSection::Piece;

constexpr double one_crossing = 1e-14;  // of the size

// A side, seen from the same end by both of its facets.
LineInSolid side_in_solid(const QuadricSolid& s, const PlacedSurface& A, Index t, std::size_t side) {
  const Index from = A.corner(t, side), to = A.corner(t, side + 1);
  if (from < to) return line_in_solid(s, A.at(from), A.at(to));
  return line_in_solid(s, A.at(to), A.at(from)).turned_round();
}

// A straight line about what of a facet is between the ends of the solid.
struct Line {
  SolidFace face;
  std::size_t side;
  LineInSolid in;
};

std::vector<Line> lines_between_ends(const QuadricSolid& s, const std::array<LineInSolid, 3>& sides, bool& consistent) {
  std::vector<Line> lines;
  for (std::size_t k = 0; k < 3; ++k) {
    if (sides[k].between_ends) lines.push_back({SolidFace::none, k, sides[k]});
  }
  std::vector<Line> all;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const LineInSolid &here = lines[n].in, &next = lines[(n + 1) % lines.size()].in;
    all.push_back(lines[n]);
    if (here.last_at != next.first_at) consistent = false;
    if (here.last_at == SolidFace::none) continue;
    LineInSolid end;
    end.between_ends = true;
    end.first = here.last, end.last = next.first;
    end.first_inside = here.last_inside, end.last_inside = next.first_inside;
    find_inside(s, end);
    all.push_back({here.last_at, 0, end});
  }
  return all;
}

// Of a section that cuts no side: an ellipse about its middle, if that is within.
void add_ellipse(const QuadricSolid& s, const std::vector<Line>& lines, FacetSection& section) {
  const Vector &n = section.normal, start = lines.front().in.first;
  const Vector e1 = normalized(std::abs(n.x) < 0.6 ? cross(n, Vector{1, 0, 0}) : cross(n, Vector{0, 1, 0})),
               e2 = cross(n, e1);
  const double a = s.form(e1, e1), b = s.form(e1, e2), c = s.form(e2, e2), determinant = a * c - b * b;
  if (!(a > 0 && c > 0 && determinant > 0)) return;
  const Vector slope = s.gradient(start);
  const double u = -0.5 * dot(slope, e1), v = -0.5 * dot(slope, e2);
  const Vector middle = start + e1 * ((c * u - b * v) / determinant) + e2 * ((a * v - b * u) / determinant);
  const double depth = -s.value(middle);
  if (!(depth > 0) || !s.between_ends(middle)) return;
  for (const Line& line : lines) {
    if (dot(n, cross(line.in.last - line.in.first, middle - line.in.first)) <= 0) return;
  }
  const Vector to1 = e1 * std::sqrt(depth / a), to2 = e2 * std::sqrt(depth / c);
  const std::array<Vector, 4> corners{middle + to1, middle + to2, middle - to1, middle - to2};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector &from = corners[k], &to = corners[(k + 1) % 4];
    section.boundary.push_back({SolidFace::curved, 0, from, to, normalized(to - from)});
  }
}

// From where the one piece leaves the solid to where the next one enters it.
void add_arc(const QuadricSolid& s, const Piece& out, const Piece& in, FacetSection& section) {
  const Vector way = in.from - out.to;
  const bool same = &out == &in;
  if (!same && norm(way) <= one_crossing * s.size()) return;
  section.boundary.push_back({SolidFace::curved, 0, out.to, in.from, same ? -out.direction : normalized(way)});
}

}  // namespace

FacetSection section_of(const QuadricSolid& s, const PlacedSurface& A, Index t) {
  FacetSection section{t, A.normal(t), {}, true};
  std::array<LineInSolid, 3> sides;
  for (std::size_t k = 0; k < 3; ++k) sides[k] = side_in_solid(s, A, t, k);
  const auto lines = lines_between_ends(s, sides, section.consistent);
  std::vector<Piece> straight;
  std::vector<bool> arc_behind, arc_before;
  for (const Line& line : lines) {
    const LineInSolid& in = line.in;
    const Vector way = in.last - in.first;
    if (!in.enters || norm(way) == 0) continue;
    const bool is_side = line.face == SolidFace::none;
    straight.push_back({line.face, line.side, in.from, in.to, normalized(way), is_side && in.from_at == SolidFace::none,
                        is_side && in.to_at == SolidFace::none});
    arc_before.push_back(in.from_at == SolidFace::curved), arc_behind.push_back(in.to_at == SolidFace::curved);
  }
  if (straight.empty()) {
    if (!lines.empty()) add_ellipse(s, lines, section);
    return section;
  }
  for (std::size_t n = 0; n < straight.size(); ++n) {
    const std::size_t next = (n + 1) % straight.size();
    section.boundary.push_back(straight[n]);
    section.consistent = section.consistent && arc_behind[n] == arc_before[next];
    if (arc_behind[n]) add_arc(s, straight[n], straight[next], section);
  }
  return section;
}

}  // namespace dynalin
