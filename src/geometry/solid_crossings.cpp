#include "geometry/solid_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynalin {

namespace {

using Index = FacetBody::Index;
using Piece = FacetSection::Piece;

constexpr double on_axis = 1e-9;  // of the size: what is not beside the line from pole to pole

// Of the arc on a piece: its highest place, and one between its ends.
Vector highest_of(const QuadricSolid& solid, const ConicPiece& p, const Vector& up) {
  const auto climbs = [&](double s) { return dot(up, ConicPiece::tangent(solid, p, p.place(s, 0))) > 0; };
  if (!climbs(0) || climbs(1)) return dot(up, p.from) > dot(up, p.to) ? p.from : p.to;
  double low = 0, high = 1;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (climbs(middle) ? low : high) = middle;
  }
  return p.place(low, 0).at;
}

// A direction in which no rim, facet or edge is drawn as a rule, so much along z that poles are on either rim.
Vector upwards(const QuadricSolid& s) {
  if (!s.has_ends()) return {0.3127, 0.5411, 0.7807};
  const double along = s.frustum().high - s.frustum().low,
               across = std::max(s.frustum().high_radius, s.frustum().low_radius);
  const double share = 0.01 * along / across;
  return normalized(Vector{0.8293 * share, 0.5588 * share, 1});
}

}  // namespace

SolidCrossings::SolidCrossings(const QuadricSolid& solid, const PlacedSurface& surface, const std::vector<Index>& near)
    : solid_(solid), surface_(surface), up_(upwards(solid)), lower_(solid.farthest(-up_)), upper_(solid.farthest(up_)) {
  for (const Index t : near) {
    FacetSection section = section_of(solid, surface, t);
    consistent_ = consistent_ && section.consistent;
    if (section.boundary.empty()) continue;
    part_of_.emplace(t, parts_.size());
    parts_.push_back({std::move(section), {}, {}, 0});
    find_arcs(parts_.back());
  }
  if (!consistent_) return;
  chains_of_.resize(parts_.size());
  for (std::size_t k = 0; k < parts_.size(); ++k) find_chains(k);
  sets_ = JoinedSets(parts_.size() + 2);
  join_neighbours();
}

void SolidCrossings::find_arcs(Part& part) {
  for (const Piece& p : part.section.boundary) {
    part.first_arc.push_back(part.arcs.size());
    if (p.face != SolidFace::curved) continue;
    const bool found = for_each_piece(solid_, part.section.normal, p.from, p.to, p.direction,
                                      [&](const ConicPiece& arc) { part.arcs.push_back(arc); });
    consistent_ = consistent_ && found;
  }
  part.first_arc.push_back(part.arcs.size());
}

std::size_t SolidCrossings::crossing(Index t, std::size_t side, bool at_end) {
  if (!surface_.owns(t, side)) {
    const Index across = surface_.across(t, side);
    side = surface_.side_across(t, side), t = across, at_end = !at_end;
  }
  const auto key = std::uint64_t{t} << 3 | std::uint64_t{side} << 1 | std::uint64_t{at_end};
  const auto [it, is_new] = crossings_.try_emplace(key, 0);
  if (is_new) it->second = loops_.add();
  return it->second;
}

// Chains begin where a side leaves the solid.
void SolidCrossings::find_chains(std::size_t part) {
  const auto& boundary = parts_[part].section.boundary;
  const std::size_t count = boundary.size();
  bool found = false;
  for (std::size_t k = 0; k < count; ++k) {
    if (boundary[k].face != SolidFace::none || boundary[k].to_corner) continue;
    std::size_t end = k + 1;
    while (boundary[end % count].face != SolidFace::none) ++end;
    add_chain(part, k, end), found = true;
  }
  if (!found && std::ranges::none_of(boundary, [](const Piece& p) { return p.face == SolidFace::none; }))
    add_chain(part, 0, count);
}

void SolidCrossings::add_chain(std::size_t part, std::size_t begin, std::size_t end) {
  const FacetSection& section = parts_[part].section;
  const auto& boundary = section.boundary;
  const std::size_t count = boundary.size();
  const Piece &first = boundary[begin], &last = boundary[end % count];
  Chain c{part, 0, first.to, last.from, first.face != SolidFace::none, {}, {}, 0};
  if (c.closed) {
    c.loop = loops_.add();
  } else {
    if (last.from_corner) {
      consistent_ = false;
      return;
    }
    const std::size_t a = crossing(section.triangle, first.side, true),
                      b = crossing(section.triangle, last.side, false);
    loops_.join(a, b);
    c.loop = a;
  }
  c.highest = c.somewhere = c.from, c.top = height(c.from);
  const auto look = [&](const Vector& p) {
    if (height(p) > c.top) c.top = height(p), c.highest = p;
  };
  look(c.to);
  const Part& whole = parts_[part];
  for (std::size_t k = c.closed ? begin : begin + 1; k < end; ++k) {
    const Piece& p = boundary[k % count];
    look(p.from), look(p.to);
    c.somewhere = p.from + (p.to - p.from) * 0.37;
    for (std::size_t n = whole.first_arc[k % count]; n < whole.first_arc[k % count + 1]; ++n) {
      look(highest_of(solid_, whole.arcs[n], up_));
      c.somewhere = whole.arcs[n].place(0.37, 0).at;
    }
  }
  chains_of_[part].push_back(chains_.size());
  chains_.push_back(c);
}

void SolidCrossings::join_neighbours() {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const FacetSection& section = parts_[k].section;
    for (const Piece& p : section.boundary) {
      if (p.face != SolidFace::none) continue;
      const auto beside = part_of_.find(surface_.across(section.triangle, p.side));
      if (beside == part_of_.end()) {
        consistent_ = false;
        return;
      }
      sets_.join(k, beside->second);
    }
  }
}

bool SolidCrossings::has_closed_patch() {
  std::vector<bool> open(parts_.size() + 2, false);
  for (const Chain& c : chains_) open[sets_.of(c.part)] = true;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (!open[sets_.of(k)]) return true;
  }
  return false;
}

void SolidCrossings::add_crossings(std::size_t part, const Vector& across, const Vector& half,
                                   std::vector<MeridianCrossing>& found) {
  const FacetSection& section = parts_[part].section;
  std::array<Vector, 3> corner;
  std::array<double, 3> beside;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = surface_.at(surface_.corner(section.triangle, k));
    beside[k] = dot(across, corner[k] - upper_);
  }
  std::array<Vector, 2> ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if ((beside[k] > 0) == (beside[next] > 0) || count == 2) continue;
    ends[count++] = corner[k] + (corner[next] - corner[k]) * (beside[k] / (beside[k] - beside[next]));
  }
  if (count < 2) return;
  const LineInSolid line = line_in_solid(solid_, ends[0], ends[1]);
  if (!line.enters) return;
  for (const bool at_end : {false, true}) {
    const SolidFace face = at_end ? line.to_at : line.from_at;
    const Vector& at = at_end ? line.to : line.from;
    // Of a cone the straight line between the poles is on its surface.
    if (face == SolidFace::none || dot(half, at - upper_) <= on_axis * solid_.size()) continue;
    Vector way = cross(across, solid_.outwards(face, at));
    if (dot(way, up_) < 0) way = -way;
    found.push_back({part, loops_.of(nearest_chain(part, at).loop), at, height(at), dot(way, section.normal) > 0});
  }
}

// Of the chains on a facet, the one to the right of whose ends a place is, or on the line between them.
const SolidCrossings::Chain& SolidCrossings::nearest_chain(std::size_t part, const Vector& at) const {
  const Vector& n = parts_[part].section.normal;
  const auto beside = [&](std::size_t k) {
    const Vector way = chains_[k].to - chains_[k].from;
    return dot(n, cross(way, at - chains_[k].from)) / std::max(norm(way), std::numeric_limits<double>::min());
  };
  return chains_[*std::ranges::min_element(chains_of_[part], {}, beside)];
}

std::vector<SolidCrossings::MeridianCrossing> SolidCrossings::meridian_through(const Vector& place) {
  const Vector axis = lower_ - upper_, normal = cross(axis, place - upper_);
  const double size = norm(normal);
  std::vector<MeridianCrossing> found;
  if (!(size > 1e-12 * solid_.size() * solid_.size())) {
    consistent_ = false;
    return found;
  }
  const Vector across = normal / size, half = normalized(cross(across, axis));
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (!chains_of_[k].empty()) add_crossings(k, across, half, found);
  }
  std::ranges::sort(found, {}, &MeridianCrossing::height);
  return found;
}

// Along any meridian on which there is something: a sliver may be missed.
void SolidCrossings::join_lower_pole() {
  for (const Chain& c : chains_) {
    const auto on_way = meridian_through(c.somewhere);
    if (on_way.empty()) continue;
    sets_.join(on_way.front().part, parts_.size());
    return;
  }
  consistent_ = false;
}

void SolidCrossings::join(bool lower_pole_inside, bool upper_pole_inside) {
  std::unordered_map<std::size_t, const Chain*> highest;
  for (const Chain& c : chains_) {
    const Chain*& best = highest[loops_.of(c.loop)];
    if (!best || c.top > best->top) best = &c;
  }
  for (const auto& [loop, chain] : highest) {
    const auto on_way = meridian_through(chain->highest);
    const auto next = std::ranges::find_if(
        on_way, [own = loop, top = chain->top](const MeridianCrossing& m) { return m.loop != own && m.height > top; });
    if (next == on_way.end()) {
      if (upper_pole_inside) sets_.join(chain->part, parts_.size() + 1);
    } else if (next->leaves) {
      sets_.join(chain->part, next->part);
    }
  }
  if (lower_pole_inside) join_lower_pole();
  for (std::size_t k = 0; k < parts_.size(); ++k) parts_[k].volume = sets_.of(k);
}

}  // namespace dynalin
