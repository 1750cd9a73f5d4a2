// A rigid body, PART or POINT_MASS, for those who weigh it.
#pragma once

#include "mechanics/body_source.h"
#include "model/model.h"

namespace dynalin {

class RigidBody final : public BodySource {
 public:
  // Both must outlive this.
  RigidBody(const Model&, const Layout&, BodyId);

  std::span<const BodyId> bodies() const override { return {&id_, 1}; }
  Vec3<Taylor> centre_in_body(const Motion&, BodyId) const override;
  double mass() const override { return body_->user_mass; }
  bool lacks_inertia() const override;
  void add_momentum_rows(const Motion&, std::vector<SparseRow>&) const override;
  std::vector<WeighedPart> weighed_parts(const Motion&) const override;
  KineticEnergy kinetic_energy(const Motion&, const Eigen::VectorXcd& velocity) const override;

 private:
  const Body* body_;
  BodyId id_;
  std::int32_t first_;  // of its coordinates
  bool turns_;
};

}  // namespace dynalin
