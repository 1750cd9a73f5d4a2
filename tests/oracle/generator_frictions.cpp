// Friction of a draw: in joints that have some, in every regime, away from where regimes meet and from reactions that
// vanish.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

namespace {

// Friction that grows with the reaction it makes jams, or has several answers: whether that is near, either way.
bool nearly_jams(const Mechanism& mechanism, double length) {
  for (const double creep : {0.0, 1.0, -1.0}) {
    Mechanism rough = mechanism;
    for (Friction& f : rough.frictions) f.mu_static *= 1.3, f.mu_dynamic *= 1.3;
    try {
      Model rubs(rough);
      place(rubs, drawn_point(mechanism));
      for (std::size_t k = 0; k < rubs.slots.size(); ++k) {
        for (const Friction& f : mechanism.frictions) {
          if (rubs.slots[k].element == ElementClass::friction && rubs.slots[k].element_id == f.id)
            rubs.z[k] = creep * f.deformation;
        }
      }
      solve_algebra(rubs);
      for (const BodyMotion& b : rubs.motion) {
        if (norm(b.al) > 150 || norm(b.a) > 150 * length) return true;
      }
    } catch (const std::runtime_error&) {
      return true;
    }
  }
  return false;
}

}  // namespace

void Draw::rub_as_wanted(Friction& f, double speed) {
  if (speed < 0.01 * L_) throw std::runtime_error("the seed wants a joint that slips");
  const RubRegime regime = wanted_regime();
  f.effect = 0, f.inputs = 15;
  f.lugre = regime == RubRegime::lugre;
  f.bristles = f.mu_static / f.deformation;
  switch (regime) {
    case RubRegime::stiction:
      f.velocity = speed * uniform(1.3, 4);
      break;
    case RubRegime::transition:
      f.velocity = speed / (1 + (f.ratio - 1) * uniform(0.3, 0.7));
      break;
    case RubRegime::sliding:
      f.velocity = speed / (f.ratio * uniform(1.3, 3));
      break;
    case RubRegime::lugre:
      f.velocity = speed * uniform(0.4, 0.8);
      f.bristle_damping = uniform(0.03, 0.1) / L_, f.viscosity = uniform(0.03, 0.1) / L_;
      break;
  }
}

void Draw::draw_frictions() {
  if (!may_rub_) return;
  std::swap(random_, friction_random_);
  using enum JointType;
  for (const Joint& joint : m_.joints) {
    const bool rubs = joint.type == revolute || joint.type == translational || joint.type == spherical ||
                      joint.type == universal || joint.type == hooke || joint.type == cylindrical;
    const bool driven =
        std::any_of(m_.motions.begin(), m_.motions.end(), [&](const Motion& a) { return a.joint == joint.id; });
    // Friction of a ball turns what it holds.
    const bool turns_point = joint.type == spherical && (body_of(joint.i).kind == BodyKind::point_mass ||
                                                         body_of(joint.j).kind == BodyKind::point_mass);
    const bool wanted = rubbing_ >= 0 && joint.id == 1;
    if (!rubs || driven || turns_point || m_.frictions.size() > 1 || !(chance(0.5) || wanted)) continue;
    Friction f;
    f.id = static_cast<int>(m_.frictions.size()) + 1;
    f.joint = joint.id;
    f.mu_static = uniform(0.1, 0.3);
    f.mu_dynamic = f.mu_static * uniform(0.4, 1);
    f.pin = L_ * uniform(0.05, 0.3), f.ball = L_ * uniform(0.05, 0.3);
    f.arm = L_ * uniform(0.05, 0.3), f.bending = L_ * uniform(0.5, 1.5);
    f.reaction = L_ * uniform(0.7, 2), f.overlap = L_ * uniform(1, 3);
    f.force_preload = F_ * uniform(0, 0.3), f.torque_preload = F_ * L_ * uniform(0, 0.1);
    f.delta = pick(3) - 1;
    f.effect = chance(0.5) ? 0 : 1 + pick(2);
    if (chance(0.4)) f.inputs = pick(16);
    f.on_j = (joint.type == universal || joint.type == hooke) && chance(0.5);
    f.ratio = uniform(1.5, 2.5);
    f.deformation = L_ * uniform(0.3, 1.5);
    // By how fast the surfaces slip here: stiction, transition or sliding.
    Real square = 0;
    for (const Model::Slip& s : here_->slips(f)) square += s.speed * s.speed;
    const double speed = static_cast<double>(std::sqrt(square));
    const double r = uniform(0, 1);
    f.velocity = speed < 0.01 * L_ ? L_ * uniform(0.2, 2)
                 : r < 0.4         ? speed * uniform(1.3, 4)
                 : r < 0.7         ? speed / (1 + (f.ratio - 1) * uniform(0.3, 0.7))
                                   : speed / (f.ratio * uniform(1.3, 3));
    f.lugre = chance(0.3);
    if (f.lugre) {
      f.effect = 0;
      f.bristles = f.mu_static / f.deformation, f.velocity = L_ * uniform(0.3, 2);
      f.bristle_damping = uniform(0, 0.1) / L_, f.viscosity = uniform(0, 0.1) / L_;
    }
    if (wanted) rub_as_wanted(f, speed);
    m_.frictions.push_back(f);
  }
  const auto too_much = [&] { return known_softenings_ ? softenings_ < *known_softenings_ : nearly_jams(m_, L_); };
  for (; !m_.frictions.empty() && too_much(); ++softenings_) {
    if (softenings_ == 3) m_.frictions.clear();
    for (Friction& f : m_.frictions) {
      for (double* x : {&f.mu_static, &f.mu_dynamic, &f.bristles, &f.bristle_damping, &f.viscosity, &f.force_preload,
                        &f.torque_preload})
        *x *= 0.3;
    }
  }
  if (rubbing_ >= 0 && (m_.frictions.empty() || m_.frictions.front().joint != 1))
    throw std::runtime_error("the seed wants friction in its first joint");
  if (!m_.frictions.empty()) {
    const Friction& f = m_.frictions.back();
    const JointType type = m_.joints[static_cast<std::size_t>(f.joint - 1)].type;
    const int rm = chance(0.4) ? 0 : one_of(oriented_);
    const Expr read = type == translational ? (1 / F_) * friction_load(f.id, pick(2), 2 + pick(3), rm)
                                            : (1 / (F_ * L_)) * friction_load(f.id, pick(2), 6 + pick(3), rm);
    m_.poutput.variables.push_back(variable(read));
    if (chance(0.3)) m_.sforces[0].function = m_.sforces[0].function + (0.1 * F_) * read;
  }
  std::swap(random_, friction_random_);
}

void Draw::check_frictions(const Model& model) const {
  for (const Friction& f : m_.frictions) {
    const auto [across, along, bending, torsion] = model.pressing(f);
    const JointType type = m_.joints[static_cast<std::size_t>(f.joint - 1)].type;
    const bool ball = type == JointType::spherical;
    // A sleeve bears nothing along its axis, neither force nor torque.
    const bool along_counts = !ball && type != JointType::cylindrical;
    if (across < 0.1 * F_ || (along_counts && along < 0.02 * F_ && torsion < 0.02 * F_ * L_))
      throw std::runtime_error("a reaction that rubs nearly vanishes");
    if (!ball && bending < 0.02 * F_ * L_) throw std::runtime_error("a moment that rubs nearly vanishes");
  }
}

}  // namespace dynalin::oracle
