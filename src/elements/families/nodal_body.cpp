#include "elements/families/nodal_body.h"

#include <algorithm>
#include <array>

#include "elements/families/weighed_mass.h"

namespace dynalin {

NodalBody::NodalBody(const Model& model, const Layout& layout, const BeamBody& beam)
    : model_(&model), layout_(&layout), beam_(&beam) {}

double NodalBody::mass() const {
  double mass = 0;
  for (std::size_t e = 0; e < elements(); ++e) mass += model_->units.ucf * element(e).mass();
  return mass;
}

void NodalBody::add_momentum_rows(const Motion&, std::vector<SparseRow>& rows) const {
  const auto add = [&](std::int32_t first, std::int32_t count) {
    for (std::int32_t k = first; k < first + count; ++k) rows.push_back({{k}, {1.0}});
  };
  add(layout_->body_coordinate_count + static_cast<std::int32_t>(beam_->first_extra),
      static_cast<std::int32_t>(beam_->extra_count()));
  for (const BodyId node : beam_->nodes) add(layout_->body(node).offset, layout_->body(node).count);
}

std::vector<WeighedPart> NodalBody::weighed_parts(const Motion& motion) const {
  std::vector<WeighedPart> parts;
  for (std::size_t e = 0; e < elements(); ++e) {
    const BeamColumns columns = beam_->columns(*layout_, e);
    parts.push_back({{columns.begin(), columns.end()},
                     {},
                     root_of_mass(model_->units.ucf * element(e).mass_matrix(beam_->motion(motion, e)))});
  }
  return parts;
}

KineticEnergy NodalBody::kinetic_energy(const Motion& motion, const Eigen::VectorXcd& velocity) const {
  KineticEnergy energy;
  for (std::size_t e = 0; e < elements(); ++e) {
    const BeamMotion of_element = beam_->motion(motion, e);
    const auto own = rows_of(beam_->columns(*layout_, e), velocity);
    for (const BeamVector& part : {BeamVector(own.real()), BeamVector(own.imag())}) {
      const auto twice = element(e).kinetic_terms(of_element, part);
      for (std::size_t k = 0; k < twice.size(); ++k) energy.terms[k] += 0.5 * model_->units.ucf * twice[k];
    }
  }
  return energy;
}

std::optional<double> NodalBody::own_work(const Motion& motion, PartialBy by, const Eigen::VectorXcd& u) const {
  double sum = 0;
  BeamForces f;
  for (std::size_t e = 0; e < elements(); ++e) {
    element(e).forces(beam_->motion(motion, e), {}, Partials::yes, f);
    const auto own = rows_of(beam_->columns(*layout_, e), u);
    const BeamMatrix& m = by == PartialBy::position ? f.stiffness : f.damping;
    for (const BeamVector& part : {BeamVector(own.real()), BeamVector(own.imag())}) sum += part.dot(m * part);
  }
  return sum;
}

void NodalBody::start_velocity(const Motion& motion, const Holds& holds, std::span<double> of_all) const {
  if (std::ranges::none_of(StatedVelocity::cm_names, holds) &&
      std::ranges::none_of(StatedVelocity::angular_names, holds))
    return;
  const StatedVelocity& stated = beam_->velocity;
  const Pose& first = model_->body(beam_->nodes.front()).pose;
  const BodyMotion& first_now = motion.body(beam_->nodes.front());
  const Matrix3 turned = first_now.R * transpose(first.R);
  const Pose now{first_now.r + turned * (beam_->drawn.r - first.r), turned * beam_->drawn.R};
  const auto along = [](const std::array<std::optional<double>, 3>& components, const Matrix3& axes) {
    Vector sum;
    for (std::size_t k = 0; k < 3; ++k) sum += components[k].value_or(0) * axes[k];
    return sum;
  };
  const Vector v = along(stated.of_cm, motion.axes(layout_->marker(stated.cm_axes)));
  const Vector w =
      along(stated.angular, stated.angular_axes.valid() ? motion.axes(layout_->marker(stated.angular_axes)) : now.R);
  const auto put = [&](std::int32_t at, const Vector& x) {
    for (std::size_t k = 0; k < 3; ++k) of_all[static_cast<std::size_t>(at) + k] = x[k];
  };
  for (std::size_t k = 0; k < beam_->nodes.size(); ++k) {
    const std::int32_t offset = layout_->body(beam_->nodes[k]).offset;
    put(offset, v + cross(w, motion.body(beam_->nodes[k]).r - now.r));
    put(offset + 3, w);
    const std::size_t s = beam_->slope(k);
    put(layout_->body_coordinate_count + static_cast<std::int32_t>(s),
        cross(w, Vector{motion.extra[s], motion.extra[s + 1], motion.extra[s + 2]}));
  }
  // Middles are turned against what turns with them.
  for (std::size_t e = 0; !beam_->plane && e < elements(); ++e)
    put(layout_->body_coordinate_count + static_cast<std::int32_t>(beam_->middle(e)), {});
}

}  // namespace dynalin
