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
#include "mechanics/kernel.h"
#include "mechanics/stiction_source.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

// What slips: about or along z of J, about an axis of the cross that is fixed on I or on J, or about a ball.
enum class FrictionSurface : std::uint8_t { slide, hinge, sleeve, yoke_of_I, yoke_of_J, ball };

struct JointFriction {
  std::int64_t joint = 0;
  MarkerId i, j;  // of the joint
  FrictionSurface surface = FrictionSurface::hinge;
  std::size_t axis = 2;  // of yokes: which axis of the marker lies along the bar of the cross
  FrictionLaw law;

  double pin_radius = 1, ball_radius = 1;        // [length]
  double friction_arm = 1, bending_arm = 1;      // [length]
  double reaction_arm = 1, overlap = 1000;       // [length]
  double overlap_growth = 0;                     // by displacement along z of J: 1, −1 or 0
  RelativeFrame<double> drawn;                   // I seen from J
  double force_preload = 0, torque_preload = 0;  // [force], [force·length]
  bool of_force = true, of_bending = true, of_torsion = true;
  bool rests_in_statics = false;
  bool joint_acts = true;  // false while the joint is out of the model: no friction then, and no bristles

  // The components of w: a force along z of J, torques about the axes of J or the bar of the cross.
  std::size_t component_count() const {
    return surface == FrictionSurface::ball ? 3 : surface == FrictionSurface::sleeve ? 2 : 1;
  }
  // Of a component of w against the force on the surface [length, or 1].
  double lever(std::size_t component) const {
    if (surface == FrictionSurface::ball) return ball_radius;
    return pushes() && component == 0 ? 1.0 : pin_radius;
  }
  // Along or about z of both markers, not along axes of one.
  bool is_along_common_z() const { return surface == FrictionSurface::hinge || pushes(); }
  bool pushes() const { return surface == FrictionSurface::slide || surface == FrictionSurface::sleeve; }
};

class JointFrictionKernel final : public Kernel, public WrenchSource, public StictionSource {
 public:
  JointFrictionKernel(const std::vector<JointFriction>&, const std::vector<ElementLabel>&, Layout&);
  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return placed_[k].element->i; }
  MarkerId marker_J(std::size_t k) const override { return placed_[k].element->j; }
  void wrench(const Motion&, std::size_t, bool with_partials, MarkerWrench&) const override;
  void remember(const Motion&, Memory&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;
  std::string domain_violation(const Motion&) const override;
  void sticking(const Motion&, std::vector<Stiction>&) const override;
  void exhausted(const Motion&, std::vector<std::string>&) const override;
  void surfaces(std::vector<BristlesBetween>&) const override;

 private:
  static constexpr std::size_t most_rows = 5, most_components = 3;
  static constexpr std::size_t first_row_seed = 12, first_creep_seed = first_row_seed + most_rows;
  using D = Dual<first_creep_seed + most_components>;
  using Values = std::array<D, most_components>;

  struct Placed {
    const JointFriction* element;
    const MarkerPlace *I, *J;
    std::int32_t first_algebraic, first_state;  // −1 without bristles
    std::int32_t first_memory;                  // of a FrictionReference, −1 for a law without bristles
    const WrenchSource* joint = nullptr;        // null while the joint is out of the model
    std::size_t which = 0;                      // of its wrenches
  };
  struct Evaluated {
    Values w, creep_rate;
    Values creep;                                // in equilibria
    std::array<std::int32_t, most_rows> rows{};  // whose multipliers the seeds are
    std::size_t row_count = 0;
    double speed = 0;  // of the slip
  };
  Evaluated evaluate(const Placed&, const PairMotion&, const Motion&) const;
  static Evaluated inactive(const Placed&, const Motion&);
  static FrictionReference reference(const Placed&, const Motion&);
  static Values creep_here(const Placed&, const RelativeFrame<TimeTaylor<D>>& I, const Motion&);
  void add_creep(const Placed&, std::size_t component, const Evaluated&, const PairMotion&, const Motion&,
                 Equations&) const;
  void add_row(std::int32_t row, const D& value, const Evaluated&, const Placed&, const PairMotion&,
               PartialBy velocity_family, Equations&) const;

  std::vector<Placed> placed_;
  const std::vector<ElementLabel>* labels_;
};

}  // namespace dynalin
