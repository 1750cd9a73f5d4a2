// Constraints between what joints and markers do: screws, couplers, gears, motions, general constraints.
#include <algorithm>

#include "generator.h"

namespace dynalin::oracle {

namespace {

bool has_displacement(const Joint& j) {
  return j.type == JointType::revolute || j.type == JointType::translational || j.type == JointType::cylindrical;
}

}  // namespace

// A real screw has a cylindrical joint on the same markers. Screws alone are drawn like other joints.
void Draw::draw_screws() {
  const std::size_t count = m_.joints.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Joint joint = m_.joints[k];
    if (joint.type != JointType::cylindrical || !chance(0.4) || mobility() < 2) continue;
    const double pitch = L_ * uniform(0.3, 2) * (chance(0.5) ? 1 : -1);
    m_.joints.push_back({static_cast<int>(m_.joints.size()) + 1, JointType::screw, joint.i, joint.j, pitch});
    connected_.push_back(connected_[k]);
  }
}

// Displacements count from the zero of each joint: the last scale is the one that suits the drawn configuration.
void Draw::draw_couplers() {
  std::vector<Joint> offered;
  std::copy_if(m_.joints.begin(), m_.joints.end(), std::back_inserter(offered), has_displacement);
  const std::size_t wanted = chance(0.4) ? 3 : 2;
  if (offered.size() < wanted || mobility() < 2 || !chance(0.5)) return;
  const Model model(m_);
  for (int attempt = 0; attempt < 10; ++attempt) {
    Coupler c;
    c.id = 1;
    double sum = 0;
    std::vector<Joint> left = offered;
    for (std::size_t k = 0; k < wanted; ++k) {
      const auto at = static_cast<std::size_t>(pick(static_cast<int>(left.size())));
      const Joint joint = left[at];
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      const char freedom = joint.type == JointType::revolute        ? 'R'
                           : joint.type == JointType::translational ? 'T'
                                                                    : "RT"[pick(2)];
      const bool turns = freedom == 'R';
      const double q = static_cast<double>(model.evaluate(turns ? measure(Measure::AZ, {joint.i, joint.j})
                                                                : measure(Measure::DZ, {joint.i, joint.j, joint.j})));
      const double unit = turns ? 1 : L_;
      double scale = uniform(0.3, 2) * (chance(0.5) ? 1 : -1) / unit;
      if (k == 0 && chance(0.5)) scale = 1;
      if (k + 1 == wanted) scale = -sum / q;
      const double leading = c.scales.empty() ? scale * unit : c.scales[0] * (c.freedoms[0] == 'R' ? 1 : L_);
      const double weight = std::fabs(scale * unit / leading);
      if (!(weight > 0.2 && weight < 4)) break;
      sum += scale * q;
      c.joints.push_back(joint.id);
      c.scales.push_back(scale);
      c.freedoms += freedom;
    }
    if (c.joints.size() < wanted) continue;
    m_.couplers.push_back(c);
    return;
  }
}

void Draw::draw_gears() {
  if (m_.joints.size() < 2 || mobility() < 2 || !chance(0.6)) return;
  for (int attempt = 0; attempt < 30; ++attempt) {
    const auto one = static_cast<std::size_t>(pick(static_cast<int>(m_.joints.size())));
    const auto two = static_cast<std::size_t>(pick(static_cast<int>(m_.joints.size())));
    const Joint &a = m_.joints[one], &b = m_.joints[two];
    if (one == two || !has_displacement(a) || !has_displacement(b)) continue;
    const auto holds = [&](std::size_t k, const BodyRef& ref) {
      return connected_[k].first == ref || connected_[k].second == ref;
    };
    const BodyRef carrier = holds(two, connected_[one].first) ? connected_[one].first : connected_[one].second;
    if (!holds(two, carrier) || connected_[one] == connected_[two]) continue;
    const Model model(m_);
    const auto marker = [&](int id) { return model.markers()[static_cast<std::size_t>(model.marker_index(id))]; };
    const Frame cv{0.5L * (marker(a.i).p + marker(b.i).p) + box(0.5 * L_), orientation()};
    bool firm = true;
    for (const Joint* joint : {&a, &b}) {
      const MarkerMotion at = marker(body_of(joint->j) == carrier ? joint->j : joint->i);
      const Real turning = std::fabs(dot(cross(at.axis[2], cv.p - at.p), cv.R.column[2]));
      const Real sliding = std::fabs(dot(at.axis[2], cv.R.column[2]));
      const bool slides = joint->type == JointType::translational;
      firm = firm && (slides ? sliding > 0.3L : turning > 0.3L * L_ && turning < 1.2L * L_);
    }
    if (!firm) continue;
    m_.gears.push_back({1, {a.id, b.id}, add_marker(carrier, cv)});
    return;
  }
}

void Draw::draw_motions() {
  const std::vector<Joint> joints = m_.joints;
  for (const Joint& joint : joints) {
    using enum JointType;
    const bool angles = joint.type == spherical || joint.type == hooke || joint.type == convel ||
                        joint.type == universal || joint.type == atpoint;
    const bool point = body_of(joint.i).kind == BodyKind::point_mass || body_of(joint.j).kind == BodyKind::point_mass;
    const char freedom = joint.type == revolute        ? 'R'
                         : joint.type == translational ? 'T'
                         : joint.type == cylindrical   ? "RTZ"[pick(3)]
                         : joint.type == planar        ? "XY"[pick(2)]
                         : joint.type == inplane       ? "XY"[pick(2)]
                         : joint.type == inline_       ? 'Z'
                         : angles && !point            ? "123"[pick(3)]
                                                       : ' ';
    if (freedom == ' ' || !chance(0.2) || mobility() < 2) continue;
    Motion motion{static_cast<int>(m_.motions.size()) + 1, joint.id, {}, freedom, chance(0.4) ? 1 + pick(2) : 0};
    m_.motions.push_back(motion);
    const Model still(m_);
    const auto row = std::find_if(still.rows.begin(), still.rows.end(),
                                  [&](const Row& r) { return r.motion == static_cast<int>(m_.motions.size()) - 1; });
    const double size = freedom == 'R' || freedom <= '3' ? 1 : L_;
    TimeFunction f;
    f.c = {0, size * uniform(-2, 2), size * uniform(-3, 3), size * uniform(-2, 2)};
    if (chance(0.6)) {
      f.amplitude = size * uniform(0.1, 0.6);
      f.frequency = uniform(1, 4);
      f.phase = uniform(-2, 2);
    }
    f.c[0] = static_cast<double>(still.row_position(*row) - motion_values(f, 0)[0]);
    m_.motions.back().f = f;
  }
}

// Any function of displacements and time, less its present value.
void Draw::draw_position_gcon() {
  if (mobility() < 2 || !chance(0.35)) return;
  const auto [i, j] = distant_pair(true);
  const auto [k, l] = distant_pair(true);
  Expr g = measure(Measure::DM, {i, j});
  const int kind = pick(4);
  const double turn = L_ * uniform(-0.5, 0.5);
  if (kind == 1 && body_of(k).kind != BodyKind::point_mass) {
    g = measure(Measure::DX, {i, j, j}) + turn * call(Function::sin, {measure(Measure::AY, {k, l})});
  }
  if (kind == 2) {
    g = measure(Measure::DY, {i, j, l}) +
        turn * call(Function::cos, {uniform(1, 3) * time_now() + (1 / L_) * measure(Measure::DM, {k, l})});
  }
  if (kind == 3) {
    g = (1 / L_) * measure(Measure::DX, {i, j}) * measure(Measure::DZ, {k, l, j}) + measure(Measure::DM, {i, j});
  }
  const Model model(m_);
  m_.gcons.push_back({201, false, g - constant(static_cast<double>(model.evaluate(g)))});
}

// Affine to the velocities: a knife edge, rolling at an arm, a relation between speeds, each perhaps with a drift.
void Draw::draw_velocity_gcon() {
  if (!chance(0.4)) return;
  const int count = chance(0.3) ? 2 : 1;
  for (int n = 0; n < count; ++n) {
    if (mobility() < 2) return;
    const auto [i, j] = distant_pair(true);
    const auto [k, l] = distant_pair(true);
    const auto along = static_cast<Measure>(static_cast<int>(Measure::VX) + pick(3));
    const bool turning = body_of(k).kind != BodyKind::point_mass;
    Expr g = measure(along, {i, j, j, j});
    switch (pick(4)) {
      case 0:
        if (body_of(i).kind == BodyKind::part) g = measure(along, {i, 0, i});
        break;
      case 1:
        // The point of a body that is under the marker k of another one has no speed along x.
        if (body_of(moving(i, j)).kind == BodyKind::part) {
          const int c = moving(i, j);
          g = measure(Measure::VX, {c}) + measure(Measure::WY, {c}) * measure(Measure::DZ, {k, c}) -
              measure(Measure::WZ, {c}) * measure(Measure::DY, {k, c});
        }
        break;
      case 2:
        if (turning) {
          g = g - L_ * uniform(0.2, 0.8) * call(Function::cos, {(1 / L_) * measure(Measure::DX, {i, j, l})}) *
                      measure(Measure::WX, {k, l, l});
        }
        break;
      default:
        g = measure(Measure::VR, {i, j}) - uniform(0.2, 0.7) * measure(along, {k, l, j});
        break;
    }
    if (chance(0.4)) g = g - L_ * uniform(-0.5, 0.5) * call(Function::sin, {time_now() + constant(uniform(-1, 1))});
    if (chance(0.4)) g = g - uniform(-0.5, 0.5) * measure(Measure::DY, {i, j, l});
    m_.gcons.push_back({301 + n, true, g});
  }
}

}  // namespace dynalin::oracle
