// Friction in a joint, as FRICTION states it: what the joint bears presses its surfaces together, and how they slip
// says the rest (friction_law.h).
//
// Each component of force or torque is an algebraic unknown w with an equation of its own, as a FUNCTION-valued force
// is. What it depends on, pose and rate of I seen from J, the multipliers of the joint and the creep of the bristles,
// are the seeds of one dual number, so that no derivative is written here.
#pragma once

#include <optional>
#include <vector>

#include "base/dual.h"
#include "elements/forces/friction_at_rest.h"
#include "elements/forces/friction_load.h"
#include "mechanics/kernel.h"
#include "mechanics/stiction_source.h"
#include "mechanics/vanishing_source.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

class JointFrictionKernel final : public Kernel, public WrenchSource, public StictionSource, public VanishingSource {
 public:
  JointFrictionKernel(const std::vector<JointFriction>&, const std::vector<ElementLabel>&, Layout&);
  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return placed_[k].element->i; }
  MarkerId marker_J(std::size_t k) const override { return placed_[k].element->j; }
  void wrench(const Motion&, std::size_t, bool with_partials, MarkerWrench&) const override;
  void remember(const Motion&, Memory&) const override;
  std::string domain_violation(const Motion&) const override;
  void sticking(const Motion&, std::vector<Stiction>&) const override;
  void exhausted(const Motion&, std::vector<std::string>&) const override;
  void surfaces(std::vector<BristlesBetween>&) const override;
  void vanishing(const Motion&, const Layout&, std::vector<VanishingSize>&) const override;
  void take_rounding(const Motion&, std::span<const double>, Memory&) const override;

 private:
  static constexpr std::size_t most_rows = 5, most_components = 3;
  static constexpr std::size_t first_row_seed = 12, first_creep_seed = first_row_seed + most_rows;
  static constexpr std::size_t first_size_seed = first_creep_seed + most_components;
  using D = Dual<first_size_seed + most_sizes>;
  using Sizes = ReactionSizes<D, first_size_seed>;
  using Values = std::array<D, most_components>;

  struct Placed {
    const JointFriction* element;
    const MarkerPlace *I, *J;
    std::int32_t first_algebraic, first_state;  // −1 without bristles
    std::int32_t first_memory;                  // of a FrictionReference, −1 for a law without bristles
    std::int32_t rounding;                      // of the reaction, in the memory: of its force and its moment
    const WrenchSource* joint = nullptr;        // null while the joint is out of the model
    std::size_t which = 0;                      // of its wrenches
  };
  struct Evaluated {
    Values w, creep_rate;
    Values creep;                                // in equilibria
    std::array<std::int32_t, most_rows> rows{};  // whose multipliers the seeds are
    std::size_t row_count = 0;
    double speed = 0;  // of the slip
    Sizes sizes;       // of what the joint bears
  };
  Evaluated evaluate(const Placed&, const PairMotion&, const Motion&) const;
  static Evaluated inactive(const Placed&, const Motion&);
  static FrictionReference reference(const Placed&, const Motion&);
  static Values creep_here(const Placed&, const RelativeFrame<TimeTaylor<D>>& I, const Motion&);
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
