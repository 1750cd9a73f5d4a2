#include "geometry/torus_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

constexpr std::size_t no_number = static_cast<std::size_t>(-1);
constexpr double next_to_it = 1e-6;  // of the size: there the way of the curve says which place is the first one

class Cutter {
 public:
  Cutter(const TorusSolid& torus, const PlacedSurface& A, FacetBody::Index t)
      : torus_(torus), surface_(A), triangle_(t), normal_(A.normal(t)) {
    for (std::size_t k = 0; k < 3; ++k) corners_[k] = A.at(A.corner(t, k));
  }

  TorusSections find() {
    for (std::size_t k = 0; k < 3; ++k) add_side(k);
    const SpiricCurve curve(torus_, normal_, dot(normal_, corners_[0]));
    curve_ = &curve;
    find_arcs();
    if (found_.consistent) follow_cycles();
    if (found_.consistent) add_loops();
    if (!found_.consistent) found_.list.clear();
    return std::move(found_);
  }

 private:
  // What of a side is in the torus. No key: it begins or ends at a corner.
  struct Part {
    TorusSection::Edge edge;
    bool from_corner, to_corner;
    std::uint64_t enters, leaves;
    std::size_t arc = no_number, section = no_number;  // of the arc that begins where it leaves
  };
  struct Crossing {
    std::size_t part;
    bool leaves;
    Vector point;
    SpiricCurve::Place place;
  };
  struct Arc {
    std::size_t to;  // a part
    std::vector<SpiricPiece> pieces;
  };

  void add_side(std::size_t side);
  void find_arcs();
  void sort(std::vector<Crossing>&) const;
  void add_arcs(const std::vector<Crossing>&);
  bool add_arc(const Crossing& out, const Crossing& in, bool is_only_one, bool wraps);
  void follow_cycles();
  void add_loops();
  bool in_triangle(const Vector& p) const;
  void add_hole(std::size_t loop, TorusSection::Chain&&);
  std::size_t section_about_hole(const SpiricCurve::Place&) const;
  std::size_t section_on_outer(const SpiricCurve::Place&) const;

  const TorusSolid& torus_;
  const PlacedSurface& surface_;
  FacetBody::Index triangle_;
  Vector normal_;
  std::array<Vector, 3> corners_;
  const SpiricCurve* curve_ = nullptr;
  std::vector<Part> parts_;                       // around the triangle
  std::vector<std::vector<Crossing>> crossings_;  // of each loop
  std::vector<Arc> arcs_;
  TorusSections found_;
};

// Both facets at a side see it from the same end.
void Cutter::add_side(std::size_t side) {
  const auto from = surface_.corner(triangle_, side), to = surface_.corner(triangle_, side + 1);
  const bool forwards = from < to;
  const Vector a = surface_.at(forwards ? from : to), b = surface_.at(forwards ? to : from);
  const LineThroughTorus line = line_through(torus_, a, b);
  const bool owns = surface_.owns(triangle_, side);
  const std::uint64_t owner = owns ? triangle_ : surface_.across(triangle_, side),
                      side_there = owns ? side : surface_.side_across(triangle_, side),
                      key = owner << 5 | side_there << 3;
  std::vector<Part> along;
  std::size_t next = 0;
  for (bool from_end = line.first_inside; from_end || next < line.count; from_end = false) {
    const std::size_t enters = next, leaves = from_end ? next : next + 1;
    const bool to_end = leaves == line.count;
    const Vector first = from_end ? a : line.at[enters], last = to_end ? b : line.at[leaves];
    const std::uint64_t number = from_end ? 0 : enters + 1;
    along.push_back({{key | number, side, first, last}, from_end, to_end, key | enters, key | leaves});
    next = leaves + 1;
  }
  if (!forwards) {
    std::ranges::reverse(along);
    for (Part& p : along)
      std::swap(p.edge.from, p.edge.to), std::swap(p.from_corner, p.to_corner), std::swap(p.enters, p.leaves);
  }
  parts_.insert(parts_.end(), along.begin(), along.end());
}

void Cutter::find_arcs() {
  crossings_.resize(curve_->loops().size());
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& p = parts_[k];
    for (const bool leaves : {false, true}) {
      if (leaves ? p.to_corner : p.from_corner) continue;
      if (crossings_.empty()) {
        found_.consistent = false;
        return;
      }
      const Vector& at = leaves ? p.edge.to : p.edge.from;
      const SpiricCurve::Place place = curve_->find(at);
      crossings_[curve_->loop_of(place.stretch)].push_back({k, leaves, at, place});
    }
  }
  for (auto& on_loop : crossings_) {
    sort(on_loop);
    add_arcs(on_loop);
  }
}

void Cutter::sort(std::vector<Crossing>& list) const {
  const auto order = [&](const Crossing& c) { return std::pair(curve_->order_of(c.place.stretch), c.place.turn); };
  std::ranges::sort(list, {}, order);
  const auto comes_before = [&](const Crossing& a, const Crossing& b) {
    const Vector way = b.point - a.point;
    return norm(way) <= next_to_it * torus_.size() && dot(way, curve_->tangent(a.point)) > 0;
  };
  for (std::size_t k = 1; k < list.size(); ++k) {
    for (std::size_t n = k; n > 0 && comes_before(list[n], list[n - 1]); --n) std::swap(list[n], list[n - 1]);
  }
  if (list.size() > 2 && comes_before(list.front(), list.back())) std::swap(list.front(), list.back());
  // Places that are one.
  for (std::size_t k = 0; k + 2 < list.size(); ++k) {
    if (list[k].leaves == list[k + 1].leaves && list[k + 1].leaves != list[k + 2].leaves &&
        norm(list[k + 2].point - list[k + 1].point) == 0)
      std::swap(list[k + 1], list[k + 2]);
  }
}

void Cutter::add_arcs(const std::vector<Crossing>& list) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Crossing &here = list[k], &next = list[(k + 1) % list.size()];
    if (here.leaves == next.leaves) found_.consistent = false;
    if (!found_.consistent) return;
    if (here.leaves && !add_arc(here, next, list.size() == 2, k + 1 == list.size())) found_.consistent = false;
  }
}

bool Cutter::add_arc(const Crossing& out, const Crossing& in, bool is_only_one, bool wraps) {
  parts_[out.part].arc = arcs_.size();
  Arc& arc = arcs_.emplace_back(Arc{in.part, {}});
  SpiricPieces pieces(torus_, *curve_, normal_, arc.pieces);
  const Vector way = in.point - out.point;
  if (norm(way) > next_to_it * torus_.size())
    return pieces.add(out.point, out.place, in.point, in.place, wraps && in.place.stretch == out.place.stretch);
  const double ahead = dot(way, curve_->tangent(out.point));
  // Next to nothing of the loop, or next to all of it.
  const bool is_all =
      is_only_one && (ahead < 0 || (ahead == 0 && in_triangle(curve_->at({out.place.stretch, std::numbers::pi / 2}))));
  SpiricCurve::Place end = out.place;
  if (!is_all) end.turn = in.place.stretch == out.place.stretch ? in.place.turn : std::numbers::pi;
  return pieces.add(out.point, out.place, in.point, end, is_all);
}

void Cutter::follow_cycles() {
  for (std::size_t first = 0; first < parts_.size(); ++first) {
    if (parts_[first].section != no_number) continue;
    TorusSection section{triangle_, normal_, {}, {}};
    std::size_t k = first;
    do {
      Part& p = parts_[k];
      if (p.section != no_number) {
        found_.consistent = false;
        return;
      }
      p.section = found_.list.size();
      section.edges.push_back(p.edge);
      if (p.to_corner) {
        k = (k + 1) % parts_.size();
        if (!parts_[k].from_corner) found_.consistent = false;
      } else if (p.arc == no_number) {
        found_.consistent = false;
      } else {
        Arc& arc = arcs_[p.arc];
        const Part& next = parts_[arc.to];
        section.chains.push_back({false, p.leaves, next.enters, p.edge.to, next.edge.from, std::move(arc.pieces)});
        k = arc.to;
      }
      if (!found_.consistent) return;
    } while (k != first);
    found_.list.push_back(std::move(section));
  }
}

bool Cutter::in_triangle(const Vector& p) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(normal_, cross(corners_[(k + 1) % 3] - corners_[k], p - corners_[k])) <= 0) return false;
  }
  return true;
}

// Loops that meet no side. What a hole is in comes before it.
void Cutter::add_loops() {
  const auto& loops = curve_->loops();
  for (const bool holes : {false, true}) {
    for (std::size_t n = 0; n < loops.size(); ++n) {
      if (loops[n].is_hole != holes || !crossings_[n].empty()) continue;
      if (!in_triangle(curve_->at({loops[n].stretches.front(), std::numbers::pi / 2}))) continue;
      TorusSection::Chain chain;
      chain.closed = true;
      SpiricPieces pieces(torus_, *curve_, normal_, chain.arcs);
      if (!pieces.add(loops[n])) {
        found_.consistent = false;
        return;
      }
      if (chain.arcs.empty()) continue;
      chain.from = chain.to = chain.arcs.front().from;
      if (!holes) {
        found_.list.push_back({triangle_, normal_, {}, {std::move(chain)}});
        continue;
      }
      const std::size_t about = section_about_hole({loops[n].stretches.front(), std::numbers::pi / 2});
      if (about >= found_.list.size()) {
        found_.consistent = false;
        return;
      }
      found_.list[about].chains.push_back(std::move(chain));
    }
  }
}

// From the hole on to the other side of the torus, or to a side of the facet.
std::size_t Cutter::section_about_hole(const SpiricCurve::Place& place) const {
  if (found_.list.size() < 2) return 0;
  const Vector from = curve_->at(place), way = curve_->out_of_hole(place);
  double least = 1;
  std::size_t at_side = no_number;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector in = cross(normal_, corners_[(k + 1) % 3] - corners_[k]);
    const double approaches = -dot(in, way), share = dot(in, from - corners_[k]) / approaches;
    if (approaches > 0 && share < least) least = share, at_side = k;
  }
  const Vector there = from + way * least;
  if (at_side == no_number) return section_on_outer(curve_->find(there));
  std::size_t nearest = no_number;
  double away = std::numeric_limits<double>::infinity();
  for (const Part& p : parts_) {
    if (p.edge.side != at_side) continue;
    const double beyond =
        std::max(dot(there - p.edge.to, p.edge.to - p.edge.from), dot(p.edge.from - there, p.edge.to - p.edge.from));
    if (beyond < away) away = beyond, nearest = p.section;
  }
  return nearest;
}

std::size_t Cutter::section_on_outer(const SpiricCurve::Place& place) const {
  const auto& list = crossings_[curve_->loop_of(place.stretch)];
  if (list.empty()) return found_.list.size() - 1;
  const auto order = [&](const SpiricCurve::Place& p) { return std::pair(curve_->order_of(p.stretch), p.turn); };
  const Crossing* before = &list.back();
  for (const Crossing& c : list) {
    if (order(c.place) > order(place)) break;
    before = &c;
  }
  return parts_[before->part].section;
}

}  // namespace

TorusSections sections_of(const TorusSolid& torus, const PlacedSurface& A, FacetBody::Index t) {
  return Cutter(torus, A, t).find();
}

}  // namespace dynalin
