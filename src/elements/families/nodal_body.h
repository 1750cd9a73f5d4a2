// A beam of finite elements, FE_PART, for those who weigh it: its elements have all of the mass.
#pragma once

#include "elements/families/beam_place.h"
#include "mechanics/body_source.h"
#include "model/model.h"

namespace dynalin {

class NodalBody final : public BodySource {
 public:
  // All must outlive this.
  NodalBody(const Model&, const Layout&, const BeamBody&);

  std::span<const BodyId> bodies() const override { return beam_->nodes; }
  // Of a node: where it stands.
  Vec3<Taylor> centre_in_body(const Motion&, BodyId) const override { return {}; }
  double mass() const override;
  // Density, areas and second moments are positive: each coordinate of a node has inertia, or follows one that has.
  bool lacks_inertia() const override { return false; }
  void add_momentum_rows(const Motion&, std::vector<SparseRow>&) const override;
  std::vector<WeighedPart> weighed_parts(const Motion&) const override;
  KineticEnergy kinetic_energy(const Motion&, const Eigen::VectorXcd& velocity) const override;
  std::optional<double> own_work(const Motion&, PartialBy, const Eigen::VectorXcd&) const override;
  // All of it moves as if rigid, about the BCS, which goes with the first node.
  void start_velocity(const Motion&, const Holds&, std::span<double> of_all) const override;

 private:
  std::size_t elements() const { return beam_->elements->size(); }
  const BeamElement& element(std::size_t k) const { return *(*beam_->elements)[k]; }

  const Model* model_;
  const Layout* layout_;
  const BeamBody* beam_;
};

}  // namespace dynalin
