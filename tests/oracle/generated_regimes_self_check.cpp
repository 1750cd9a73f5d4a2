// What state the generated mechanisms are in that Agreement compares: in which regime their frictions, how fast their
// flexible bodies spin and how they are loaded. A test that a formula is right says nothing of a regime that no draw
// has.
#include <algorithm>
#include <array>
#include <map>

#include "generator.h"
#include "self_check.h"

namespace dynalin::oracle::generated_regimes_self_check {
namespace {

constexpr std::array names = {"stiction", "transition", "sliding", "LuGre's law"};

RubRegime regime_of(const Model& at, const Friction& f) {
  if (f.lugre) return RubRegime::lugre;
  Real square = 0;
  for (const Model::Slip& s : at.slips(f)) square += s.speed * s.speed;
  const Real speed = std::sqrt(square);
  return speed < f.velocity             ? RubRegime::stiction
         : speed < f.ratio * f.velocity ? RubRegime::transition
                                        : RubRegime::sliding;
}

TEST(Generated, frictions_of_each_joint_are_in_each_regime) {
  std::map<std::pair<JointType, RubRegime>, int> drawn;
  const auto look = [&](std::uint64_t seed) {
    const Mechanism m = random_mechanism(seed);
    Model model(m);
    place(model, drawn_point(m));
    for (const Friction& f : m.frictions) {
      // EFFECT and INPUTS leave something out.
      if (f.effect == 0 && f.inputs == 15)
        ++drawn[{m.joints[static_cast<std::size_t>(f.joint - 1)].type, regime_of(model, f)}];
    }
  };
  for (std::uint64_t seed = 331; seed <= 354; ++seed) look(seed);
  for (const JointType joint : rubbing_joints) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      EXPECT_GT((drawn[{joint, static_cast<RubRegime>(k)}]), 0)
          << "joint of type " << static_cast<int>(joint) << " in " << names[k];
    }
  }
}

// Where the rotation is fast beside the vibration of the modes, centrifugal and Coriolis forces have a part in all
// entries; what joints bear turns with the nodes.
TEST(Generated, flexible_bodies_spin_about_as_fast_as_they_vibrate_and_bear_loads) {
  for (std::uint64_t seed = 355; seed <= 360; ++seed) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    Model model(m);
    place(model, drawn_point(m));
    solve_algebra(model);
    const Flexible& f = m.flexibles.at(0);
    const auto motion = [&](const BodyRef& ref) {
      return model.motion[static_cast<std::size_t>(model.body_index(ref))];
    };
    EXPECT_GE(norm(motion(f.frame()).w), 0.5L * lowest_frequency(f));
    EXPECT_GT(norm(motion(f.modes()).p), 0);
    // A force by which the modes would yield as far as they are deformed.
    Real softest = f.stiffness[0][0];
    for (std::size_t k = 1; k < 3; ++k) softest = std::min<Real>(softest, f.stiffness[k][k]);
    Real most = 0;
    for (std::size_t k = 0; k < m.joints.size(); ++k) {
      const auto on_body = [&](int marker) {
        return of_flexible(m.markers[static_cast<std::size_t>(model.marker_index(marker))].body.kind);
      };
      if (on_body(m.joints[k].i) || on_body(m.joints[k].j))
        most = std::max(most, norm(model.joint_wrench(static_cast<int>(k)).f));
    }
    EXPECT_GT(most, 0.3L * softest * norm(motion(f.modes()).p));
  }
}

}  // namespace
}  // namespace dynalin::oracle::generated_regimes_self_check
