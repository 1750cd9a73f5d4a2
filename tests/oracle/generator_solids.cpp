// Pairs of solids of a draw that press on each other, one perhaps a cavity for the other: shallow, at places that
// follow small motions smoothly.
#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

namespace {

constexpr SolidShape ellipsoid = SolidShape::ellipsoid, box_shape = SolidShape::box, frustum = SolidShape::frustum,
                     torus = SolidShape::torus, wedge = SolidShape::wedge;

// Seeds 291 + k and 301 + k have numbers k, k + 10, k + 20 and k + 30.
constexpr std::array<Meeting, 40> meetings{{
    {torus, false, ellipsoid, false, false, Spot::any},       // 291
    {torus, false, frustum, true, false, Spot::mantle},       // 292
    {torus, false, torus, false, false, Spot::any},           // 293
    {torus, false, box_shape, false, false, Spot::face},      // 294
    {ellipsoid, false, box_shape, false, false, Spot::face},  // 295
    {ellipsoid, false, frustum, true, false, Spot::end},      // 296
    {torus, false, frustum, false, false, Spot::edge},        // 297
    {ellipsoid, false, frustum, false, false, Spot::edge},    // 298
    {torus, false, box_shape, false, false, Spot::edge},      // 299
    {ellipsoid, false, box_shape, false, false, Spot::edge},  // 300
    {frustum, false, box_shape, false, true, Spot::any},      // 291
    {torus, false, box_shape, false, true, Spot::any},        // 292
    {box_shape, false, box_shape, false, true, Spot::any},    // 293
    {ellipsoid, false, box_shape, false, true, Spot::any},    // 294
    {frustum, true, frustum, false, true, Spot::mantle},      // 295
    {torus, false, frustum, true, true, Spot::mantle},        // 296
    {box_shape, false, frustum, false, true, Spot::mantle},   // 297
    {ellipsoid, false, frustum, true, true, Spot::mantle},    // 298
    {frustum, false, frustum, true, true, Spot::end},         // 299
    {box_shape, false, frustum, true, true, Spot::mantle},    // 300
    {box_shape, false, ellipsoid, false, true, Spot::any},    // 291
    {frustum, true, ellipsoid, false, true, Spot::any},       // 292
    {torus, false, ellipsoid, false, true, Spot::any},        // 293
    {box_shape, false, ellipsoid, true, true, Spot::any},     // 294
    {frustum, false, ellipsoid, true, true, Spot::any},       // 295
    {torus, false, ellipsoid, true, true, Spot::any},         // 296
    {ellipsoid, false, frustum, false, true, Spot::mantle},   // 297
    {torus, false, frustum, false, true, Spot::mantle},       // 298
    {ellipsoid, false, frustum, false, false, Spot::mantle},  // 299
    {ellipsoid, false, frustum, true, false, Spot::edge},     // 300
    {ellipsoid, true, wedge, false, false, Spot::face},       // 291
    {ellipsoid, true, wedge, false, false, Spot::edge},       // 292
    {wedge, false, box_shape, false, true, Spot::any},        // 293
    {wedge, false, frustum, false, true, Spot::mantle},       // 294
    {wedge, false, ellipsoid, false, true, Spot::any},        // 295
    {wedge, false, frustum, true, true, Spot::end},           // 296
    {wedge, false, ellipsoid, true, true, Spot::any},         // 297
    {ellipsoid, true, box_shape, false, false, Spot::edge},   // 298
    {ellipsoid, true, frustum, false, false, Spot::edge},     // 299
    {ellipsoid, true, wedge, false, false, Spot::edge},       // 300
}};

// Whether a normal in the axes of a box or frustum is one of such a spot. Edges: rims and corners as well.
bool belongs_to(Spot spot, const Solid& s, const Vec& n) {
  constexpr Real exact = 1e-9L;
  if (spot == Spot::any) return true;
  if (s.shape == SolidShape::wedge) {
    const std::vector<Vec> at = corners(s, {});
    bool face = std::fabs(n.z) > 1 - exact;
    for (std::size_t k = 0; k < at.size(); k += 2) {
      const Vec side = at[(k + 2) % at.size()] - at[k];
      face = face || dot(n, normalized({side.y, -side.x, 0})) > 1 - exact;
    }
    return face == (spot == Spot::face);
  }
  if (s.shape == SolidShape::box) {
    const bool face = std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)}) > 1 - exact;
    return face == (spot == Spot::face);
  }
  const Real taper = s.size[1] - static_cast<Real>(s.size[2]), slope = taper / std::hypot(taper, Real(s.size[0]));
  const bool end = std::fabs(n.z) > 1 - exact, mantle = std::fabs(std::fabs(n.z) - std::fabs(slope)) < exact;
  return spot == (end ? Spot::end : mantle ? Spot::mantle : Spot::edge);
}

// In the axes of its marker.
Vec middle_of(const Solid& s) {
  if (s.shape == SolidShape::box) return 0.5L * to_vec(s.size);
  if (s.shape == SolidShape::wedge) {
    const Real half = s.size[2] / 2.0L, out = s.size[1] / 2.0L;
    return {out * std::cos(half), out * std::sin(half), s.size[0] / 2.0L};
  }
  return s.shape == SolidShape::frustum ? Vec{0, 0, s.size[0] / 2.0L} : Vec{};
}

struct Pair {
  Touch touch;
  MarkerPose I, J;
  [[nodiscard]] std::vector<TouchPlace> places() const { return places_of_solids(touch, I, J); }
  [[nodiscard]] TouchPlace deepest() const {
    const std::vector<TouchPlace> all = places();
    return *std::min_element(all.begin(), all.end(),
                             [](const TouchPlace& a, const TouchPlace& b) { return a.gap < b.gap; });
  }
};

// I towards J, or away from the middle of a cavity, until the deepest place is so deep.
void press(Pair& pair, const Vec& direction, Real depth, Real length) {
  if (pair.touch.cavity == Cavity::none) {
    const TouchPlace apart = pair.deepest();
    if (apart.gap < 0.02L * length || apart.gap > 0.6L * length) throw std::runtime_error("solids are not near");
    pair.I.p += (-(apart.gap + depth)) * apart.normal;
  } else {
    const Vec start = pair.I.p;
    Real low = 0, high = 4 * length;
    for (int k = 0; k < 60; ++k) {
      const Real middle = (low + high) / 2;
      pair.I.p = start + middle * direction;
      (pair.deepest().gap > -depth ? low : high) = middle;
    }
  }
  if (std::fabs(pair.deepest().gap + depth) > 1e-9L * length) throw std::runtime_error("solids cannot be pressed");
}

// Where it is closed, it must stay so and go on smoothly as I moves: no jumps, and no kinks of the first order.
void check_smoothness(const Pair& pair, Real length) {
  const std::vector<TouchPlace> here = pair.places();
  for (const TouchPlace& p : here) {
    if (std::fabs(p.gap) < 0.025L * length) throw std::runtime_error("a place is nearly open");
  }
  for (int c = 0; c < 6; ++c) {
    for (const Real h : {0.01L, 0.002L}) {
      std::array<std::vector<TouchPlace>, 2> moved;
      for (const int side : {0, 1}) {
        Pair there = pair;
        Vec by;
        set_component(by, c % 3, side == 0 ? h : -h);
        if (c < 3) {
          there.I.p += length * by;
        } else {
          there.I.p = here[0].point + rotation_exponential(by) * (pair.I.p - here[0].point);
          there.I.R = rotation_exponential(by) * pair.I.R;
        }
        moved[static_cast<std::size_t>(side)] = there.places();
      }
      for (std::size_t k = 0; k < here.size(); ++k) {
        const TouchPlace &up = moved[0][k], &down = moved[1][k];
        if (here[k].gap > 0 && up.gap > 0 && down.gap > 0) continue;
        const Real bent = std::max({norm(up.normal - 2 * here[k].normal + down.normal),
                                    norm(up.point - 2 * here[k].point + down.point) / length});
        if (!(bent < 30 * h * h)) throw std::runtime_error("a place of contact jumps");
      }
    }
  }
}

}  // namespace

// Extents of about this size, or radii of half of it; of either sense where that says where the marker is.
Solid Draw::solid(SolidShape shape, bool regular, double size) {
  const auto some = [&] { return L_ * size * uniform(0.7, 1.2); };
  const auto signed_extent = [&] { return some() * (chance(0.3) ? -1 : 1); };
  Solid s{shape, {}};
  switch (shape) {
    case SolidShape::ellipsoid:
      s.size[0] = some();
      s.size[1] = regular ? s.size[0] : some();
      s.size[2] = regular ? s.size[0] : some();
      break;
    case SolidShape::box:
      for (double& extent : s.size) extent = signed_extent();
      break;
    case SolidShape::frustum:
      s.size[0] = signed_extent();
      s.size[1] = some() / 2;
      s.size[2] = regular ? s.size[1] : some() / 2;
      break;
    case SolidShape::torus:
      s.size[0] = some() / 2;
      s.size[1] = s.size[0] * uniform(0.25, 0.4);
      break;
    case SolidShape::wedge:
      s.size = {signed_extent(), some(), uniform(1.2, 2.4)};
      break;
  }
  return s;
}

void Draw::draw_meeting(const Meeting& meeting) {
  std::vector<BodyRef> massive;
  std::copy_if(bodies_.begin(), bodies_.end(), std::back_inserter(massive),
               [](const BodyRef& b) { return b.kind != BodyKind::point_mass; });
  const BodyRef a = one_of(massive), b = one_of(massive);
  if (a == b) throw std::runtime_error("a body does not touch itself");
  Pair pair;
  Touch& t = pair.touch;
  t.id = static_cast<int>(m_.touches.size()) + 1;
  t.kind = TouchKind::solids;
  t.cavity = meeting.in_cavity ? Cavity::j : Cavity::none;
  t.solid_i = solid(meeting.first, meeting.first_regular, meeting.in_cavity ? 0.7 : 1.1);
  t.solid_j = solid(meeting.second, meeting.second_regular, meeting.in_cavity ? 2.4 : 1.1);
  const Vec at = 0.5L * (to_vec(body(a).qg) + to_vec(body(b).qg)) + box(0.3 * L_);
  const Mat R_I = orientation(), R_J = orientation();
  const Vec apart = meeting.in_cavity ? box(0.1 * L_) : box(1.2 * L_), direction = orientation().column[0];
  pair.J = {at - R_J * middle_of(t.solid_j), R_J};
  pair.I = {at + apart - R_I * middle_of(t.solid_i), R_I};
  press(pair, direction, L_ * uniform(0.05, 0.09), L_);
  if (!belongs_to(meeting.spot, t.solid_j, transpose(R_J) * pair.deepest().normal)) {
    throw std::runtime_error("solids meet elsewhere");
  }
  check_smoothness(pair, L_);
  if (chance(0.5)) {
    std::swap(pair.I, pair.J);
    std::swap(t.solid_i, t.solid_j);
    if (meeting.in_cavity) t.cavity = Cavity::i;
  }
  t.i = add_marker(a, {pair.I.p, pair.I.R}), t.j = add_marker(b, {pair.J.p, pair.J.R});
  draw_touch_law(t);
  check_regimes(m_.touches.back());
}

// In motion, and away from where one piece of a law passes into another.
void Draw::check_regimes(const Touch& t) const {
  Model here(m_);
  place(here, drawn_point(m_));
  const auto near = [](Real x, Real limit) { return std::fabs(x - limit) < 0.1L * limit; };
  for (const Model::TouchState& s : here.touch_states(m_.touches.size() - 1)) {
    if (s.gap > 0) continue;
    const Real speed = norm(s.slip());
    if (norm(s.velocity) < 0.05L * L_) throw std::runtime_error("solids that touch do not move along each other");
    const bool between = s.pressure < 0.02L * F_ || (!t.restitution && near(-s.gap, t.full_damping)) ||
                         (t.rubs && (near(speed, t.stiction_speed) || near(speed, t.sliding_speed)));
    if (between) throw std::runtime_error("a place of contact is between two pieces of its law");
  }
}

void Draw::draw_meetings() {
  for (std::size_t k = 0; k < 4; ++k) {
    const Meeting& meeting = meetings[static_cast<std::size_t>(meeting_) + 10 * k];
    bool drawn = false;
    for (int attempt = 0; attempt < 400 && !drawn; ++attempt) {
      const Mechanism before = m_;
      const int marker = next_marker_;
      try {
        draw_meeting(meeting);
        drawn = true;
      } catch (const std::runtime_error&) {
        m_ = before;
        next_marker_ = marker;
      }
    }
    if (!drawn) throw std::runtime_error("solids do not meet");
  }
}

}  // namespace dynalin::oracle
