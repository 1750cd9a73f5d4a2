#include "system/mass_centres.h"

namespace dynalin {

std::vector<Vec3<Taylor>> centres_in_bodies(const System& system, const Motion& motion) {
  std::vector<Vec3<Taylor>> in_body(motion.bodies.size());
  for (const BodySource* source : system.bodies()) {
    for (const BodyId b : source->bodies())
      in_body[static_cast<std::size_t>(b.index)] = source->centre_in_body(motion, b);
  }
  return in_body;
}

std::vector<Vec3<Taylor>> mass_centres(const System& system, const Motion& motion) {
  std::vector<Vec3<Taylor>> in_body = centres_in_bodies(system, motion);
  for (std::size_t b = 0; b < in_body.size(); ++b) {
    const BodyMotion& m = motion.bodies[b];
    in_body[b] = along_motion(m.r, m.rdot, m.rddot) + m.axes() * in_body[b];
  }
  return in_body;
}

}  // namespace dynalin
