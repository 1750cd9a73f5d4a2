#include "system/mass_centres.h"

#include "elements/bodies/flex_body.h"

namespace dynalin {

std::vector<Vec3<Taylor>> mass_centres(const System& system, const Motion& motion) {
  const Model& model = system.model();
  std::vector<Vec3<Taylor>> in_body;
  in_body.reserve(motion.bodies.size());
  for (std::size_t b = 0; b < motion.bodies.size(); ++b) {
    const Vector c = model.bodies[b].p_BC;
    in_body.push_back({Taylor(c.x), Taylor(c.y), Taylor(c.z)});
  }
  for (const FlexibleBody& f : flexible_bodies(model)) {
    const ModalInertia& inertia = f.flexible->inertia;
    if (!(inertia.mass > 0)) continue;  // INVARIANTS may leave it out
    Vec3<Taylor>& c = in_body[static_cast<std::size_t>(f.body.index)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Taylor sum(inertia.first[axis]);
      for (std::size_t k = 0; k < inertia.modes(); ++k)
        sum += motion.outside_poses(f.first + k) * inertia.of_modes[k][axis];
      c[axis] = sum / inertia.mass;
    }
  }
  for (std::size_t b = 0; b < in_body.size(); ++b) {
    const BodyMotion& m = motion.bodies[b];
    in_body[b] = along_motion(m.r, m.rdot, m.rddot) + m.axes() * in_body[b];
  }
  return in_body;
}

}  // namespace dynalin
