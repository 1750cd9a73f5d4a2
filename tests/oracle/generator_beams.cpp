// Beams of a draw: stated without deformation and held by what is joined to an end; their other nodes, all slopes and
// middles are then somewhere else, far bent, stretched and spinning.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

// Its nodes lie on an arc, or askew; the axes of their sections lead along it.
void Draw::draw_beam() {
  Beam b;
  b.id = static_cast<int>(m_.beams.size()) + 1;
  const std::size_t n = 2 + static_cast<std::size_t>(pick(2));
  b.qg = to_triple(box(L_)), b.reuler = angles_313(orientation());
  const double l = L_ * uniform(0.5, 0.9), arc = chance(0.5) ? uniform(-0.8, 0.8) : 0;
  Vec at;
  double heading = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) {
      at += l * Vec{std::cos(heading + arc / 2), std::sin(heading + arc / 2), 0};
      heading += arc;
    }
    b.places.push_back(to_triple(at));
    b.angles.push_back({heading, arc != 0 ? uniform(-0.3, 0.3) : 0, chance(0.5) ? uniform(-0.3, 0.3) : 0});
  }
  draw_sections(b, n, {.flatness = 0.6, .skewed = 0.5, .lightest = 0.5, .heaviest = 1.5});
  m_.beams.push_back(b);
  add_bodies_of(b);
  join_beam(b);
}

void Draw::draw_sections(Beam& b, std::size_t n, const SectionDraw& d) {
  const double area = L_ * L_ * uniform(0.03, 0.1), radius2 = L_ * L_ * uniform(0.03, 0.06);
  const bool tapered = chance(0.5);
  for (std::size_t k = 0; k < n; ++k) {
    const auto size = [&] { return tapered ? uniform(0.7, 1.4) : 1.0; };
    b.area.push_back(area * size());
    b.yy.push_back(area * radius2 * size()), b.zz.push_back(d.flatness * area * radius2 * size());
    b.yz.push_back(area * radius2 * (chance(d.skewed) ? uniform(-0.2, 0.2) : 0));
    b.torsion.push_back(area * radius2 * 1.2 * size());
    b.shear_y.push_back(1.2 * size()), b.shear_z.push_back(1.3 * size());
  }
  b.youngs_modulus = F_ / (L_ * L_) * uniform(50, 150), b.poissons_ratio = uniform(0, 0.4);
  b.density = uniform(d.lightest, d.heaviest) / (area * L_);
  b.damping = chance(0.6) ? uniform(0, 0.03) : 0;
}

// Where the dataset has them.
void Draw::add_bodies_of(const Beam& b) {
  const Mat axes = rotation_313(b.reuler);
  const auto add = [&](const BodyRef& ref, const Triple& at, const Triple& angles) {
    Body body;
    body.ref = ref, body.qg = at, body.reuler = angles;
    m_.bodies.push_back(body);
  };
  for (std::size_t k = 0; k < b.nodes(); ++k) {
    const Mat R = axes * rotation_313(b.angles[k]);
    add(b.node(k), to_triple(to_vec(b.qg) + axes * to_vec(b.places[k])), angles_313(R));
    add(b.slope(k), to_triple(R.column[0]), {});
    if (k + 1 < b.nodes() && !b.is_plane()) add(b.middle(k), {}, {});
  }
}

void Draw::join_beam(const Beam& b) {
  std::vector<BodyRef> solid;
  for (const BodyRef& ref : bodies_) {
    if (ref == ground || (ref.kind == BodyKind::part && body(ref).mass > 0)) solid.push_back(ref);
  }
  std::vector<bool> held(b.nodes(), false);
  const auto join = [&](std::size_t node) {
    connect(b.node(node), one_of(solid),
            one_of(std::vector{JointType::fixed, JointType::revolute, JointType::spherical, JointType::universal,
                               JointType::cylindrical, JointType::planar}));
    held[node] = true;
  };
  const bool last_too = chance(0.3);
  if (!chance(0.15)) join(0);
  if (last_too) join(b.nodes() - 1);
  const auto change = [&](const BodyRef& ref) -> Body& {
    return *std::find_if(m_.bodies.begin(), m_.bodies.end(), [&](const Body& body) { return body.ref == ref; });
  };
  for (std::size_t k = 0; k < b.nodes(); ++k) {
    Body& node = change(b.node(k));
    Mat R = rotation_313(node.reuler);
    if (!held[k]) {
      R = rotation_exponential(box(0.6)) * R;
      node.qg = to_triple(to_vec(node.qg) + box(0.25 * L_)), node.reuler = angles_313(R);
    }
    change(b.slope(k)).qg = to_triple(R.column[0] + box(0.2));
    if (k + 1 < b.nodes()) change(b.middle(k)).qg = to_triple(box(0.3));
    const int id = add_marker(b.node(k), {to_vec(node.qg) + box(0.3 * L_), orientation()});
    all_.push_back(id), oriented_.push_back(id), bodies_.push_back(b.node(k));
  }
}

void Draw::draw_beams() {
  if (!must_bend_ && plane_ == BeamPlane::none) return;
  std::swap(random_, beam_random_);
  must_bend_ ? draw_beam() : draw_plane_beam();
  std::swap(random_, beam_random_);
}

// At least one of them varies along the beam, by the place and by its motion there.
void Draw::draw_beam_load() {
  if (m_.beams.empty()) return;
  std::swap(random_, beam_random_);
  const Expr S = place_along_beam();
  BeamLoad load{1, 1, chance(0.5) ? one_of(oriented_) : 0, {}};
  const std::size_t varying = static_cast<std::size_t>(pick(6));
  for (std::size_t c = 0; c < 6; ++c) {
    if (c != varying && !chance(0.4)) continue;
    Expr e = constant(uniform(-0.5, 0.5)) + uniform(-0.4, 0.4) * shaped_kinematic();
    if (c == varying || chance(0.3))
      e = e + uniform(-0.6, 0.6) * call(Function::sin, {3.0 * S + constant(1)}) * kinematic();
    if (c == varying || chance(0.3)) {
      constexpr std::array<double, 3> sizes = {0.8, 0.6, 0.03};
      const int derivative = pick(3);
      // Of the line, and of beams in space of the sections as well; how those of a plane beam stand is no question of
      // the language.
      const int component = pick(plane_ == BeamPlane::none ? 6 : 3);
      const double length = component < 3 ? L_ : 1;
      e = e +
          (sizes[static_cast<std::size_t>(derivative)] * uniform(-1, 1) / length) * line_motion(derivative, component);
    }
    if (chance(0.4)) e = e + uniform(-0.4, 0.4) * varval(one_of(features_));
    if (!states_.empty() && chance(0.4)) e = e + uniform(-0.5, 0.5) * one_of(states_);
    load.component[c] = ((c < 3 ? 1 / L_ : 0.3) * F_) * e;
  }
  m_.beam_loads.push_back(load);
  std::swap(random_, beam_random_);
  check();
}

}  // namespace dynalin::oracle
