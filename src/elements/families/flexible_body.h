// Bodies that change their shape: inertia, weight, stiffness and damping by the coordinates of the BCS and the modal
// coordinates q.
//
// The kinetic energy is that of flexible/modal_inertia.h, with u = Aᵀ r′ and the angular velocity w of the axes A of
// the BCS along themselves, wₓ = a_z·a_y′ and so on. With the momentum p = A (I1 u + w × c + Σ I3 q′) = (I1 r + A c)′
// and the angular momentum h = J w + Σ G_k q_k′ its equations are written on the path alone:
//
//     F = (I1 r + A c)″ − I1 g,     L = A c × (r″ − g) + (A h)′
//     Q_k = A I3_k·(r″ − g) + (G_k·w)′ − ½ w·J,k w − w·Σ I5_kl q_l′ + Σ I6_kl q_l″ + Σ K_kl q_l + Σ D_kl q_l′
//
// What is quadratic in the modes is contracted with q once, so that all partials but those of modes by modes cost the
// same for each mode.
#pragma once

#include <memory>
#include <vector>

#include "elements/families/shaped_body.h"
#include "mechanics/channel_source.h"
#include "mechanics/kernel.h"
#include "mechanics/start_source.h"
#include "model/model.h"

namespace dynalin {

// Of bodies whose modal coordinates or rates compiled routines read each is an unknown as well, u − q = 0.
class FlexibleBodyKernel final : public Kernel, public StartSource, public ChannelSource {
 public:
  FlexibleBodyKernel(const std::vector<FlexibleBody>&, const Model&, Layout&);
  void equations(const Motion&, Equations&) const override;
  std::vector<const BodySource*> bodies() const override;

  const StartSource* starts() const override { return this; }
  std::span<const StartCondition> start_conditions() const override { return starts_; }
  void start_rows(const Motion&, std::int32_t first_row, ConstraintRows&) const override;

  const ChannelSource* channels() const override { return this; }
  Channel shape_channel(BodyId, std::size_t mode, int derivative) const override;
  bool add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder&) override;

 private:
  struct Item {
    BodyId body;
    const ModalBody* flexible;      // of the model
    ModalInertia inertia;           // dynamical
    std::int32_t first_column = 0;  // of the modal coordinates
    std::size_t first_extra = 0;
    bool couples = false;  // modes by the quadratic invariants
  };
  void add_stiffness(const Item&, const Motion&, Equations&) const;
  // An unknown that is a modal coordinate (derivative 0), its rate or its acceleration.
  struct Reading {
    BodyId body;
    std::size_t mode;
    int derivative;
    std::int32_t column;  // of the coordinate
    std::size_t extra;
    std::int32_t algebraic;
  };
  static void read(const Reading&, const Motion&, Equations&);

  std::vector<Item> items_;
  std::vector<ShapedBody> bodies_;  // of the same
  std::vector<Reading> readings_;
  Vector gravity_;
  std::vector<StartCondition> starts_;
  std::vector<std::pair<std::size_t, Eigen::Index>> start_places_;  // item and mode of each
};

}  // namespace dynalin
