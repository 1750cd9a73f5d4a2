// A body with shapes, FLEX_BODY, for those who weigh it: its mass matrix is that of flexible/modal_inertia.h.
#pragma once

#include "elements/families/flexible_place.h"
#include "mechanics/body_source.h"
#include "model/model.h"

namespace dynalin {

class ShapedBody final : public BodySource {
 public:
  // Both must outlive this.
  ShapedBody(const Model&, const Layout&, const FlexibleBody&);

  std::span<const BodyId> bodies() const override { return {&of_.body, 1}; }
  // c/I1, which moves in the body as the modal coordinates do.
  Vec3<Taylor> centre_in_body(const Motion&, BodyId) const override;
  double mass() const override { return shape().inertia.mass; }
  bool lacks_inertia() const override { return shape().lacks_inertia; }
  void add_momentum_rows(const Motion&, std::vector<SparseRow>&) const override;
  std::vector<WeighedPart> weighed_parts(const Motion&) const override;
  // Terms of the BCS with mass and inertia about it.
  KineticEnergy kinetic_energy(const Motion&, const Eigen::VectorXcd& velocity) const override;
  std::optional<double> own_work(const Motion&, PartialBy, const Eigen::VectorXcd&) const override;
  void start_velocity(const Motion&, const Holds&, std::span<double> of_all) const override;
  // Where its linear modes are no longer what a real body does: turning faster than a tenth of its lowest frequency
  // with the BCS held, of which geometric stiffening would show, or bent by more than a tenth of its length or turned
  // within by more than ten degrees.
  void add_cautions(const Motion&, Diagnostics&) const override;
  // "FLEX_BODY/2: mass 4.2, 8 modes from 12.3 to 812 cycles/s", frequencies with the BCS held.
  std::optional<std::string> summary() const override;

 private:
  const ModalBody& shape() const { return *of_.flexible; }
  const ElementLabel& label() const { return model_->body(of_.body).label; }
  Eigen::Map<const Eigen::VectorXd> modal_coordinates(const Motion& motion) const {
    return {motion.extra.data() + of_.first, shape().modes()};
  }

  const Model* model_;
  FlexibleBody of_;
  std::int32_t pose_, modes_;  // the first coordinate of each
};

}  // namespace dynalin
