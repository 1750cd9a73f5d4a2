// Friction in a joint, as FRICTION states it: what the joint bears presses its surfaces together, and how they slip
// says the rest (friction_law.h).
//
// Each component of force or torque is an algebraic unknown w with an equation of its own, as a FUNCTION-valued force
// is; what it is at a motion, with all derivatives, is evaluated_friction.h.
#pragma once

#include <vector>

#include "elements/forces/evaluated_friction.h"
#include "mechanics/kernel.h"
#include "mechanics/pair_state_source.h"
#include "mechanics/stiction_source.h"
#include "mechanics/vanishing_source.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

class JointFrictionKernel final : public Kernel,
                                  public WrenchSource,
                                  public StictionSource,
                                  public VanishingSource,
                                  public PairStateSource {
 public:
  JointFrictionKernel(const std::vector<JointFriction>&, const std::vector<ElementLabel>&, Layout&);
  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return placed_[k].element->i; }
  MarkerId marker_J(std::size_t k) const override { return placed_[k].element->j; }
  void wrench(const Motion&, std::size_t, Partials wanted, MarkerWrench&) const override;
  void remember(const Motion&, Memory&) const override;
  std::string domain_violation(const Motion&) const override;
  void sticking(const Motion&, std::vector<Stiction>&) const override;
  void exhausted(const Motion&, std::vector<std::string>&) const override;
  void pair_states(const Motion&, std::vector<PairStates>&) const override;
  void vanishing(const Motion&, const Layout&, std::vector<VanishingSize>&) const override;
  void take_rounding(const Motion&, std::span<const double>, Memory&) const override;

 private:
  using Placed = PlacedFriction;
  using Evaluated = EvaluatedFriction;
  using D = Evaluated::D;

  void add_creep(const Placed&, std::size_t component, const Evaluated&, const PairMotion&, const Motion&,
                 Equations&) const;
  template <class Take>
  static void by_motion_and_reaction(const D& value, const Evaluated&, const PairMotion&, PartialBy velocity_family,
                                     const Layout&, const Take&);
  void add_row(std::int32_t row, const D& value, const Evaluated&, const Placed&, const PairMotion&,
               PartialBy velocity_family, Equations&) const;

  std::vector<Placed> placed_;
  const std::vector<ElementLabel>* labels_;
};

}  // namespace dynalin
