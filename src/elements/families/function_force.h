// A single force or torque whose magnitude is a function expression.
//
// The magnitude is an unknown that the expression defines; the element adds only the direction.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "elements/families/defined_unknown.h"
#include "elements/families/markers.h"
#include "mechanics/kernel.h"
#include "mechanics/wrench_source.h"
#include "model/schema.h"

namespace dynalin {

enum class Direction : std::uint8_t { along_line, along_z, about_z };

struct FunctionForce {
  const ElementLabel* label;
  MarkerId i, j;
  Direction direction = Direction::along_line;
  bool action_only = false;
  Expression magnitude;
};

class FunctionForceKernel final : public Kernel, public WrenchSource {
 public:
  FunctionForceKernel(std::vector<FunctionForce>, Layout&);

  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  std::size_t shares() const override { return shares_of(forces_.size()); }
  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return forces_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return forces_[k].element.j; }
  void wrench(const Motion&, std::size_t, Partials wanted, MarkerWrench&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;

 private:
  struct Force {
    FunctionForce element;
    const MarkerPlace *I, *J;  // of the layout
    DefinedUnknown magnitude;
  };
  // Where the markers of a force along their line meet: the force, and what a unit of its magnitude adds.
  struct Meeting {
    AtMeeting magnitude;
    PairForce force, by_magnitude;
  };
  static std::optional<Meeting> meeting(const Force&, const PairMotion&, const Motion&, ExpressionScratch&,
                                        Partials wanted);
  static PairForce force_of(const Force&, const PairMotion&, double magnitude, Partials wanted);
  std::vector<Force> forces_;
};

}  // namespace dynalin
