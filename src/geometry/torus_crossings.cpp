#include "geometry/torus_crossings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

constexpr double whole_circle = 2 * std::numbers::pi;
// In the tube, where no rim, facet or edge is drawn as a rule.
constexpr double seam_at = 2.2671;

// Of a difference of angles, the way that is less than half a turn.
double short_way(double angle) { return angle - whole_circle * std::round(angle / whole_circle); }
double angle_about_axis(const Vector& p) { return std::atan2(p.y, p.x); }
// From the seam on, from 0 to a turn.
double angle_in_tube(const TorusSolid& s, const Vector& p) {
  const double v = std::atan2(p.z, std::hypot(p.x, p.y) - s.major()) - seam_at;
  return v < 0 ? v + whole_circle : v;
}
// Whether a line goes up in the tube.
bool climbs(const TorusSolid& s, const SpiricPiece::Place& place) {
  const Vector &p = place.at, &t = place.tangent;
  const double radius = std::hypot(p.x, p.y);
  return (radius - s.major()) * t.z - p.z * (p.x * t.x + p.y * t.y) / radius > 0;
}

}  // namespace

TorusCrossings::TorusCrossings(const TorusSolid& torus, const PlacedSurface& surface,
                               const std::vector<FacetBody::Index>& near)
    : torus_(torus) {
  for (const auto t : near) {
    TorusSections sections = sections_of(torus, surface, t);
    if (!sections.consistent) {
      consistent_ = false;
      return;
    }
    for (TorusSection& s : sections.list) parts_.push_back({std::move(s), 0});
  }
  sets_ = JoinedSets(parts_.size() + 1);
  join_sides();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (const TorusSection::Chain& c : parts_[k].section.chains) follow(k, c);
  }
}

// Both facets at a side have the same parts of it.
void TorusCrossings::join_sides() {
  std::unordered_map<std::uint64_t, std::size_t> open;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (const TorusSection::Edge& e : parts_[k].section.edges) {
      const auto [it, is_first] = open.try_emplace(e.key, k);
      if (is_first) continue;
      sets_.join(it->second, k);
      open.erase(it);
    }
  }
  consistent_ = consistent_ && open.empty();
}

std::size_t TorusCrossings::crossing(std::uint64_t key) {
  const auto [it, is_new] = crossings_.try_emplace(key, 0);
  if (is_new) it->second = lines_.add();
  return it->second;
}

// --- along the lines

void TorusCrossings::follow(std::size_t part, const TorusSection::Chain& chain) {
  const std::size_t first = chain.closed ? lines_.add() : crossing(chain.begin);
  std::size_t line = first;
  double u = angle_about_axis(chain.from), v = angle_in_tube(torus_, chain.from);
  look(line, {u, v, part});
  const auto go_to = [&](const Vector& p, const SpiricPiece* piece, double from, double to) {
    const double next_u = angle_about_axis(p), next_v = angle_in_tube(torus_, p);
    add_step({part, line, u, next_u, v, short_way(next_u - u), short_way(next_v - v), piece, from, to}, next_v, line);
    u = next_u, v = next_v;
    look(line, {u, v, part});
  };
  for (const SpiricPiece& piece : chain.arcs) {
    double s = 0;
    for (const SpiricPiece::Place& p : piece.places) go_to(p.at, &piece, s, p.s), s = p.s;
    go_to(piece.to, &piece, s, 1);
  }
  if (chain.arcs.empty()) go_to(chain.to, nullptr, 0, 1);
  lines_.join(line, chain.closed ? first : crossing(chain.end));
}

void TorusCrossings::look(std::size_t line, const Top& top) {
  tops_.resize(std::max(tops_.size(), line + 1));
  if (top.v > tops_[line].v) tops_[line] = top;
}

void TorusCrossings::look_between(const Step& step) {
  const auto climbs_at = [&](double s) {
    const auto place = step.piece->place(torus_, s, 0);
    return place && climbs(torus_, *place);
  };
  if (!climbs_at(step.from) || climbs_at(step.to)) return;
  double low = step.from, high = step.to;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (climbs_at(middle) ? low : high) = middle;
  }
  const auto top = step.piece->place(torus_, low, 0);
  if (!top) return;
  const double v = angle_in_tube(torus_, top->at);
  if (std::abs(v - step.v) < 1) look(step.line, {angle_about_axis(top->at), v, step.part});
}

void TorusCrossings::add_step(const Step& step, double next_v, std::size_t& line) {
  steps_.push_back(step);
  const double turns = std::round((step.v + step.dv - next_v) / whole_circle);
  if (turns == 0) {
    if (step.piece) look_between(step);
    return;
  }
  double u = step.u;
  if (step.piece) {
    if (const auto place = step.piece->place(torus_, share_where(step, true, seam_at), 0))
      u = angle_about_axis(place->at);
  }
  on_seam_.push_back({step.part, line, u, turns < 0});
  line = lines_.add();
}

// Of a step that goes over an angle: where.
double TorusCrossings::share_where(const Step& step, bool of_v, double angle) const {
  double low = step.from, high = step.to;
  if (!step.piece) return low;
  const bool rises = (of_v ? step.dv : step.du) > 0;
  for (int k = 0; k < 52; ++k) {
    const double middle = 0.5 * (low + high);
    const auto place = step.piece->place(torus_, middle, 0);
    if (!place) break;
    const double here = of_v ? angle_in_tube(torus_, place->at) + seam_at : angle_about_axis(place->at);
    ((short_way(here - angle) > 0) == rises ? high : low) = middle;
  }
  return low;
}

// What is in the body is to the right of a line that has the facet to its left: below what goes on around the axis, and
// ahead of what goes up.
std::vector<TorusCrossings::Crossing> TorusCrossings::on_meridian(double u) const {
  std::vector<Crossing> found;
  for (const Step& step : steps_) {
    // The same place is on the same side as the end of one step and the beginning of the next one.
    const double before = short_way(step.u - u), after = short_way(step.next_u - u);
    if ((before > 0) == (after > 0) || std::abs(before - after) > 0.5 * whole_circle) continue;
    double v = step.v;
    if (step.piece) {
      if (const auto place = step.piece->place(torus_, share_where(step, false, u), 0))
        v = angle_in_tube(torus_, place->at);
    }
    found.push_back({step.part, step.line, v, step.du > 0});
  }
  std::ranges::sort(found, {}, &Crossing::at);
  return found;
}

// --- what hangs together

bool TorusCrossings::has_closed_patch() {
  std::vector<bool> open(parts_.size() + 1, false);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (!parts_[k].section.chains.empty()) open[sets_.of(k)] = true;
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (!open[sets_.of(k)]) return true;
  }
  return false;
}

Vector TorusCrossings::seam() const {
  const double radius = torus_.major() + torus_.minor() * std::cos(seam_at), u = 0.3127;
  return {radius * std::cos(u), radius * std::sin(u), torus_.minor() * std::sin(seam_at)};
}

void TorusCrossings::join_along_seam() {
  std::ranges::sort(on_seam_, {}, &Crossing::at);
  for (std::size_t k = 0; k < on_seam_.size(); ++k) {
    const Crossing &here = on_seam_[k], &next = on_seam_[(k + 1) % on_seam_.size()];
    if (here.leaves == next.leaves) consistent_ = false;
    if (!here.leaves) sets_.join(here.part, next.part);
  }
}

const TorusCrossings::Crossing* TorusCrossings::behind(double u) const {
  if (on_seam_.empty()) return nullptr;
  const auto next = std::ranges::find_if(on_seam_, [&](const Crossing& c) { return c.at > u; });
  return next == on_seam_.end() ? &on_seam_.front() : &*next;
}

void TorusCrossings::join(bool seam_inside) {
  seam_inside_ = seam_inside && on_seam_.empty();
  join_along_seam();
  const std::size_t seam = parts_.size();
  std::unordered_map<std::size_t, Top> highest;
  for (std::size_t k = 0; k < tops_.size(); ++k) {
    Top& best = highest[lines_.of(k)];
    if (tops_[k].v > best.v) best = tops_[k];
  }
  bool from_seam = seam_inside_;
  for (const auto& [line, top] : highest) {
    const auto on_way = on_meridian(top.u);
    if (from_seam && !on_way.empty()) {
      from_seam = false;
      if (on_way.front().leaves) sets_.join(on_way.front().part, seam);
    }
    const auto next = std::ranges::find_if(
        on_way, [&, own = line, from = top.v](const Crossing& c) { return lines_.of(c.line) != own && c.at > from; });
    if (next != on_way.end()) {
      if (next->leaves) sets_.join(top.part, next->part);
    } else if (const Crossing* c = behind(top.u)) {
      if (c->leaves) sets_.join(top.part, c->part);
    } else if (seam_inside_) {
      sets_.join(top.part, seam);
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) parts_[k].volume = sets_.of(k);
}

bool TorusCrossings::holds_most_of_seam(std::size_t volume) {
  if (on_seam_.empty()) return seam_inside_ && sets_.of(parts_.size()) == volume;
  double share = 0;
  for (std::size_t k = 0; k < on_seam_.size(); ++k) {
    const Crossing &here = on_seam_[k], &next = on_seam_[(k + 1) % on_seam_.size()];
    if (here.leaves || sets_.of(here.part) != volume) continue;
    const double way = next.at - here.at;
    share += way < 0 ? way + whole_circle : way;
  }
  return share > 0.5 * whole_circle;
}

}  // namespace dynalin
