// Random mechanisms. Bodies and joint frames are placed in the global frame first and then expressed on
// their bodies, so that loops close as drawn; velocities are projected onto the constraints. Quantities are
// drawn in natural units (a length, a force that moves a unit mass at ten lengths per time squared) so
// that every unit system gives equally gentle numbers.
#include "generator.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

#include "accepted_draws.h"

namespace dynalin::oracle {

void Draw::draw_units() {
  const double r = uniform(0, 1);
  if (r >= 0.5) m_.ucf = r < 0.75 ? 1000 : 386.0885826771654;
  L_ = m_.ucf == 1 ? 1 : (m_.ucf == 1000 ? 1000 : 30);
  F_ = 10 * L_ / m_.ucf;
  const Vec g = box(9 * L_);
  m_.gravity = to_triple(g);
  m_.bodies.push_back({});
  m_.bodies[0].ref = ground;
}

const Body& Draw::body(const BodyRef& ref) const {
  return *std::find_if(m_.bodies.begin(), m_.bodies.end(), [&](const Body& b) { return b.ref == ref; });
}

const Marker& Draw::marker(int id) const {
  return *std::find_if(m_.markers.begin(), m_.markers.end(), [&](const Marker& k) { return k.id == id; });
}

BodyRef Draw::body_of(int marker_id) const { return marker(marker_id).body; }

Vec Draw::place_of(int marker_id) const {
  const Marker& k = marker(marker_id);
  const Body& owner = body(k.body);
  return to_vec(owner.qg) + rotation_313(owner.reuler[0], owner.reuler[1], owner.reuler[2]) * to_vec(k.qp);
}

int Draw::add_marker(const BodyRef& ref, const Frame& global) {
  const Body& owner = body(ref);
  const Mat R = rotation_313(owner.reuler[0], owner.reuler[1], owner.reuler[2]);
  Marker marker;
  marker.id = next_marker_++;
  marker.body = ref;
  marker.qp = to_triple(transpose(R) * (global.p - to_vec(owner.qg)));
  marker.reuler = angles_313(transpose(R) * global.R);
  m_.markers.push_back(marker);
  return marker.id;
}

void Draw::add_body(BodyKind kind) {
  Body b;
  b.ref = {kind, static_cast<int>(m_.bodies.size()) + 1};
  b.qg = to_triple(box(L_));
  b.reuler = angles_313(orientation());
  b.mass = uniform(0.7, 3);
  m_.bodies.push_back(b);
  bodies_.push_back(b.ref);
  const Frame cm{to_vec(b.qg) + box(0.35 * L_), orientation()};
  const int cm_id = add_marker(b.ref, cm);
  Body& added = m_.bodies.back();
  added.cm = cm_id;
  if (kind == BodyKind::point_mass) return;
  // Principal moments from positive second moments satisfy the triangle inequality.
  const double s = b.mass * L_ * L_;
  const double x = s * uniform(0.02, 0.2), y = s * uniform(0.02, 0.2), z = s * uniform(0.02, 0.2);
  const Mat P = orientation();
  Mat J = P * Mat{{Vec{y + z, 0, 0}, Vec{0, x + z, 0}, Vec{0, 0, x + y}}} * transpose(P);
  if (chance(0.25)) {
    const Frame im{cm.p + box(0.3 * L_), orientation()};
    added.im = add_marker(b.ref, im);
    const Mat to_im = transpose(im.R) * cm.R;
    const Mat S = skew(transpose(im.R) * (cm.p - im.p));
    J = to_im * J * transpose(to_im) + -static_cast<Real>(b.mass) * (S * S);
  }
  const Triple d{static_cast<double>(J.column[0].x), static_cast<double>(J.column[1].y),
                 static_cast<double>(J.column[2].z)};
  m_.bodies.back().ip = {d[0],
                         d[1],
                         d[2],
                         -static_cast<double>(J.column[1].x),
                         -static_cast<double>(J.column[2].x),
                         -static_cast<double>(J.column[2].y)};
}

void Draw::connect(const BodyRef& i_body, const BodyRef& j_body, JointType type) {
  Frame J{0.5L * (to_vec(body(i_body).qg) + to_vec(body(j_body).qg)) + box(0.4 * L_), orientation()};
  Frame I = J;
  switch (type) {
    case JointType::revolute:
      I.R = J.R * rotation_z(uniform(-2.2, 2.2));
      break;
    case JointType::translational:
      I.p += static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[2];
      break;
    case JointType::spherical:
      I.R = orientation();
      break;
    case JointType::universal:
      // A quarter turn about any axis in the x-y plane of J leaves z_I normal to z_J.
      I.R = J.R * rotation_z(uniform(-3, 3)) * rotation_x(std::numbers::pi_v<Real> / 2) * rotation_z(uniform(-3, 3));
      break;
    case JointType::fixed:
      break;
    case JointType::cylindrical:
      I.R = J.R * rotation_z(uniform(-2.2, 2.2));
      I.p += static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[2];
      break;
    case JointType::planar:
      I.R = J.R * rotation_z(uniform(-2.2, 2.2));
      I.p += static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[0] +
             static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[1];
      break;
    case JointType::hooke:
      // x_I stays normal to y_J: a turn about y_J, then one about x_I.
      I.R = J.R * rotation_x(-std::numbers::pi_v<Real> / 2) * rotation_z(uniform(-1, 1)) *
            rotation_x(std::numbers::pi_v<Real> / 2) * rotation_x(uniform(-1, 1));
      break;
    case JointType::convel: {
      // A turn about an axis in the x-y plane makes the matrix symmetric where the row looks.
      const Mat to = rotation_z(uniform(-3, 3));
      I.R = J.R * to * rotation_x(uniform(-1, 1)) * transpose(to);
      break;
    }
    case JointType::screw:
    case JointType::rackpin:
      I.R = orientation();
      I.p += box(0.7 * L_);
      break;
    case JointType::atpoint:
      I.R = orientation();
      break;
    case JointType::inline_:
      I.R = orientation();
      I.p += static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[2];
      break;
    case JointType::inplane:
    case JointType::gcon_plane:
      I.R = orientation();
      I.p += static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[0] +
             static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[1];
      break;
    case JointType::orientation:
      I.p += box(0.7 * L_);
      break;
    case JointType::parallel_axes:
      I.R = J.R * rotation_z(uniform(-2.2, 2.2));
      I.p += box(0.7 * L_);
      break;
    case JointType::perpendicular:
    case JointType::gcon_right_angle:
      I.R = J.R * rotation_z(uniform(-3, 3)) * rotation_x(std::numbers::pi_v<Real> / 2) * rotation_z(uniform(-3, 3));
      I.p += box(0.7 * L_);
      break;
  }
  const int i = add_marker(i_body, I);
  const int j = add_marker(j_body, J);
  const bool sized = type == JointType::screw || type == JointType::rackpin;
  const double size = sized ? L_ * uniform(0.3, 1.5) * (chance(0.5) ? 1 : -1) : 0;
  m_.joints.push_back({static_cast<int>(m_.joints.size()) + 1, type, i, j, size});
  connected_.emplace_back(i_body, j_body);
}

int Draw::mobility() const {
  int count = 0;
  for (const Body& b : m_.bodies) {
    count += b.ref.kind == BodyKind::part ? 6 : (b.ref.kind == BodyKind::point_mass ? 3 : 0);
  }
  for (const Joint& j : m_.joints) count -= equations_of(j.type);
  for (const Contact& c : m_.contacts) count -= c.equations();
  count -= static_cast<int>(m_.couplers.size() + m_.gears.size() + m_.gcons.size());
  return count - static_cast<int>(m_.motions.size());
}

void Draw::draw_tree() {
  const int n = 2 + pick(5);
  std::vector<BodyRef> parents{ground};
  for (int k = 0; k < n; ++k) {
    const bool mass_point = k > 0 && chance(0.12);
    add_body(mass_point ? BodyKind::point_mass : BodyKind::part);
    const BodyRef child = bodies_.back();
    const BodyRef parent = chance(0.65) ? parents.back() : one_of(parents);
    if (mass_point) {
      if (chance(0.5)) {
        connect(child, parent,
                one_of(std::vector{JointType::spherical, JointType::atpoint, JointType::inline_, JointType::inplane}));
      }
      continue;
    }
    parents.push_back(child);
    if (mobility() < 10 && chance(0.06)) continue;  // free, held by springs alone
    const double r = uniform(0, 1);
    const JointType type = rubbing_ >= 0 && k == 0 ? wanted_joint()
                           : r < 0.3               ? JointType::revolute
                           : r < 0.36              ? JointType::spherical
                           : r < 0.42              ? JointType::universal
                           : r < 0.54              ? JointType::translational
                           : r < 0.57              ? JointType::fixed
                                      : static_cast<JointType>(static_cast<int>(JointType::cylindrical) + pick(14));
    if (chance(0.5)) {
      connect(child, parent, type);
    } else {
      connect(parent, child, type);
    }
  }
}

void Draw::draw_loops() {
  if (wanted_loops_ == 0 && !chance(0.5)) return;
  const int wanted = std::max(wanted_loops_, 1 + pick(2));
  int closed = 0;
  for (int attempt = 0; attempt < 12 && closed < wanted; ++attempt) {
    const BodyRef a = one_of(bodies_), b = one_of(bodies_);
    const bool joined = std::any_of(connected_.begin(), connected_.end(), [&](const auto& c) {
      return (c.first == a && c.second == b) || (c.first == b && c.second == a);
    });
    if (a == b || joined || a.kind == BodyKind::point_mass || b.kind == BodyKind::point_mass) continue;
    const double r = uniform(0, 1);
    const JointType type = r < 0.3    ? JointType::spherical
                           : r < 0.45 ? JointType::universal
                           : r < 0.55 ? JointType::revolute
                           : r < 0.65 ? JointType::inline_
                           : r < 0.75 ? JointType::inplane
                           : r < 0.82 ? JointType::hooke
                           : r < 0.86 ? JointType::gcon_plane
                           : r < 0.90 ? JointType::gcon_right_angle
                           : r < 0.94 ? JointType::screw
                           : r < 0.97 ? JointType::rackpin
                                      : JointType::perpendicular;
    if (mobility() - equations_of(type) < 1) continue;
    connect(a, b, type);
    ++closed;
  }
}

void Draw::draw_massless() {
  if (!chance(0.6)) return;
  std::vector<std::size_t> candidates;
  for (std::size_t b = 0; b < m_.bodies.size(); ++b) {
    if (m_.bodies[b].ref.kind != BodyKind::part) continue;
    int links = 0;
    for (std::size_t k = 0; k < m_.joints.size(); ++k) {
      if (connected_[k].first != m_.bodies[b].ref && connected_[k].second != m_.bodies[b].ref) continue;
      const int id = m_.joints[k].id;
      const bool driven =
          std::any_of(m_.motions.begin(), m_.motions.end(), [&](const Motion& a) { return a.joint == id; });
      links += driven || m_.joints[k].type == JointType::fixed ? 2 : 1;
    }
    if (links >= 2) candidates.push_back(b);
  }
  if (candidates.empty()) return;
  Body& light = m_.bodies[one_of(candidates)];
  light.mass = 0;
  light.ip = {};
  light.im = 0;
  if (chance(0.6)) light.cm = 0;
}

void Draw::draw_measure_markers() {
  for (const BodyRef& ref : bodies_) {
    const Vec centre = ref == ground ? Vec{} : to_vec(body(ref).qg);
    for (int k = 0; k < 2; ++k) {
      const int id = add_marker(ref, {centre + box(0.6 * L_), orientation()});
      all_.push_back(id);
      if (ref.kind != BodyKind::point_mass) oriented_.push_back(id);
    }
  }
}

void Draw::draw_velocities() {
  Model model(m_);
  const Stated free{std::vector<bool>(model.bodies.size(), false), std::vector<bool>(model.bodies.size(), false)};
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    model.motion[b].v = box(model.bodies[b].ref.kind < BodyKind::beam_slope ? 1.5 * L_ : 1);
    const bool spins = must_spin_ && model.bodies[b].ref.kind == BodyKind::flexible_frame;
    model.motion[b].w = model.bodies[b].dof == 6 ? box(spins ? 5 : 2.5) : Vec{};
  }
  model.update_velocities();
  complete_velocities(model, free);
  model.update_velocities();
  for (Body& b : m_.bodies) {
    if (is_elastic(b.ref.kind)) {
      const BodyMotion& m = model.motion[static_cast<std::size_t>(model.body_index(b.ref))];
      b.v = to_triple(m.v);
      if (turns(b.ref.kind)) b.w = to_triple(m.w);
    }
    if (b.cm == 0) continue;
    const MarkerMotion& cm = model.markers()[static_cast<std::size_t>(model.marker_index(b.cm))];
    b.v = to_triple(cm.v);
    if (b.ref.kind == BodyKind::part) b.w = to_triple(transpose(Mat{cm.axis}) * cm.w);
  }
  here_.emplace(m_);
  place(*here_, drawn_point(m_));
  if (!must_spin_) return;
  const Flexible& f = m_.flexibles[0];
  if (norm(here_->motion[static_cast<std::size_t>(here_->body_index(f.frame()))].w) < 0.5L * lowest_frequency(f))
    throw std::runtime_error("the seed wants a faster spin");
}

Mechanism Draw::mechanism() {
  draw_units();
  draw_tree();
  draw_loops();
  draw_screws();
  draw_couplers();
  draw_gears();
  draw_contacts();
  if (whole_language_) draw_planes();
  if (must_ride_) draw_axis();
  draw_motions();
  draw_measure_markers();
  draw_position_gcon();
  draw_velocity_gcon();
  check_structure();
  draw_massless();
  draw_beams();
  draw_flexibles();
  draw_velocities();
  draw_contact_starts();
  draw_springs();
  draw_linear_forces();
  draw_nforces();
  if (whole_language_) draw_cable();
  if (must_float_) draw_journal();
  draw_controls();
  draw_sforces();
  read_gse();
  draw_general_forces();
  draw_outputs();
  if (!known_softenings_) check();
  draw_frictions();
  if (!known_softenings_ && !m_.frictions.empty()) check();
  draw_touches();
  draw_beam_load();
  draw_modal_forces();
  return m_;
}

Mechanism random_mechanism(std::uint64_t seed) {
  const auto titled = [&](Mechanism m) {
    m.title = "Random mechanism, seed " + std::to_string(seed);
    return m;
  };
  if (const auto known = accepted_draw(seed)) return titled(Draw(seed, *known).mechanism());
  for (std::uint64_t attempt = 0; attempt < 2000; ++attempt) {
    try {
      Draw draw(seed, attempt);
      Mechanism m = titled(draw.mechanism());
      remember_accepted_draw(seed, {attempt, draw.softenings()});
      return m;
    } catch (const std::runtime_error&) {
      // Rejected: the next draw of the same seed.
    }
  }
  throw std::runtime_error("no acceptable mechanism for this seed");
}

}  // namespace dynalin::oracle
