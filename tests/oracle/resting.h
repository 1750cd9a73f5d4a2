// Generated mechanisms as statics takes them.
#pragma once

#include "oracle/generator.h"

namespace dynalin::oracle {

inline Mechanism random_resting_mechanism(std::uint64_t seed) {
  Mechanism mechanism = random_mechanism(seed);
  // Ground springs hold what would float away.
  for (const Body& b : mechanism.bodies) {
    if (b.ref.kind == BodyKind::ground || b.cm == 0 || seed % 4 == 0) continue;
    Marker anchor;
    anchor.id = 9000 + b.ref.id;
    anchor.body = ground;
    anchor.qp = {b.qg[0] + 1.3, b.qg[1] - 0.7, b.qg[2] + 2.1};
    mechanism.markers.push_back(anchor);
    mechanism.springs.push_back(
        {9000 + b.ref.id, Direction::translational, b.cm, anchor.id, 30 * b.mass / mechanism.ucf, 0, 0, 0.5});
  }
  // Velocity constraints say nothing at rest; motions by rate are refused there.
  std::erase_if(mechanism.gcons, [](const Gcon& g) { return g.of_rates; });
  for (Motion& m : mechanism.motions) m.level = 0;
  return mechanism;
}

// A model at rest has constant motions.
inline void hold_motions(Mechanism& mechanism) {
  for (Motion& m : mechanism.motions) {
    m.f.c[0] = static_cast<double>(motion_values(m.f, 0)[0]);
    m.f.c[1] = m.f.c[2] = m.f.c[3] = m.f.amplitude = 0;
  }
}

}  // namespace dynalin::oracle
