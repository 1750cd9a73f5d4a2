// Which surfaces the bristles of a FRICTION are between, by which a model that is edited or reloaded knows them again.
#include "elements/forces/friction_kernel.h"

namespace dynalin {

namespace {

std::string_view name_of(FrictionSurface surface) {
  switch (surface) {
    case FrictionSurface::slide:
      return "slide";
    case FrictionSurface::sleeve:
      return "sleeve";
    case FrictionSurface::ball:
      return "ball";
    case FrictionSurface::hinge:
      return "hinge";
    case FrictionSurface::yoke_of_I:
      return "bar of I";
    case FrictionSurface::yoke_of_J:
      return "bar of J";
  }
  return {};
}

}  // namespace

void JointFrictionKernel::pair_states(const Motion& motion, std::vector<PairStates>& out) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    const JointFriction& f = *p.element;
    if (p.first_state < 0) continue;
    const Frame<Taylor> I = motion.frame(*p.I), J = motion.frame(*p.J);
    const Matrix3 axes_I = value(I.axes), axes_J = value(J.axes);
    const bool is_ball = f.surface == FrictionSurface::ball, is_bar = !is_ball && !f.is_along_common_z();
    Vector on_I, on_J;
    if (!is_ball) on_I = axes_I.z, on_J = axes_J.z;
    if (is_bar) on_I = on_J = (f.surface == FrictionSurface::yoke_of_I ? axes_I : axes_J) * unit_vectors[f.axis];
    std::vector<Vector> directions(f.component_count(), on_J);
    if (is_ball) directions = {axes_J.x, axes_J.y, axes_J.z};
    out.push_back({&(*labels_)[k],
                   f.joint,
                   name_of(f.surface),
                   {{{f.i, value(I.origin), on_I}, {f.j, value(J.origin), on_J}}},
                   std::move(directions),
                   f.surface == FrictionSurface::slide ? 0
                   : is_ball                           ? f.ball_radius
                                                       : f.pin_radius});
  }
}

}  // namespace dynalin
