// What state the generated mechanisms are in that Agreement compares: in which regime their frictions, and how fast
// their flexible bodies spin. A test that a formula is right says nothing of a regime that no draw has.
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
  for (std::uint64_t seed = first_of_friction; seed < behind_friction; ++seed) look(seed);
  for (const JointType joint : rubbing_joints) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      EXPECT_GT((drawn[{joint, static_cast<RubRegime>(k)}]), 0)
          << "joint of type " << static_cast<int>(joint) << " in " << names[k];
    }
  }
}

// Where the rotation is fast beside the vibration of the modes, centrifugal and Coriolis forces have a part in all
// entries.
TEST(Generated, flexible_bodies_spin_about_as_fast_as_they_vibrate) {
  for (std::uint64_t seed = behind_friction; seed < 360; ++seed) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    Model model(m);
    place(model, drawn_point(m));
    const Flexible& f = m.flexibles.at(0);
    const auto motion = [&](const BodyRef& ref) {
      return model.motion[static_cast<std::size_t>(model.body_index(ref))];
    };
    EXPECT_GE(norm(motion(f.frame()).w), 0.5L * lowest_frequency(f));
    EXPECT_GT(norm(motion(f.modes()).p), 0);
  }
}

}  // namespace
}  // namespace dynalin::oracle::generated_regimes_self_check
