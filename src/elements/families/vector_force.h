// A force and a torque on I given by expressions in the axes of RM, with the opposite on the body of a floating marker
// at the same point: VFORCE, VTORQUE and GFORCE.
//
// Every component is an unknown that its expression defines.
#pragma once

#include <memory>
#include <vector>

#include "elements/families/defined_unknown.h"
#include "elements/families/markers.h"
#include "mechanics/kernel.h"
#include "mechanics/wrench_source.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

struct VectorForce {
  MarkerId i, jfloat, rm;
  // FX FY FZ TX TY TZ; those that are not written stay without unknown.
  std::array<std::optional<Expression>, 6> component;
};

class VectorForceKernel final : public Kernel, public WrenchSource {
 public:
  VectorForceKernel(std::vector<VectorForce>, const std::vector<ElementLabel>&, Components, Layout&);
  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  std::size_t shares() const override { return shares_of(forces_.size()); }
  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return forces_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return forces_[k].element.jfloat; }
  MarkerId marker_of_axes(std::size_t k) const override { return forces_[k].element.rm; }
  void wrench(const Motion&, std::size_t, Partials wanted, MarkerWrench&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;

 private:
  struct Component {
    std::size_t axis;  // 0–2 force, 3–5 torque
    DefinedUnknown value;
  };
  struct Force {
    VectorForce element;
    MarkerPlace I, J, RM;
    std::vector<Component> components;
  };
  std::vector<Force> forces_;
  const std::vector<ElementLabel>* labels_;
  Components components_;  // that the statement has, written or not
};

struct WrittenVectorForce {
  MarkerId i, jfloat, rm;
  Expression fx, fy, fz, tx, ty, tz;
  VectorExpression fxyz, txyz;
  Expression function;
};

// Takes over what is written of the components that the statement has.
void take_components(const WrittenVectorForce&, Components, VectorForce&, ElementReader&);
void check_vector_force(Model&, const ElementLabel&, const VectorForce&, Diagnostics&);

// E: WrittenVectorForce with arguments, keyword, summary, components.
template <class E>
class VectorForceSet final : public TypedSet<VectorForce> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    E written;
    if (read_arguments(written, reader)) take_components(written, E::components, elements[k], reader);
  }
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) check_vector_force(model, labels[k], elements[k], diagnostics);
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<VectorForceKernel>(elements, labels, E::components, layout);
  }
};

template <class E>
constexpr Kind vector_force() {
  return Kind{E::keyword,
              "",
              E::summary,
              Kind::Role::element,
              detail::argument_infos<E>,
              [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<VectorForceSet<E>>(kind); },
              Kind::EnergyRows::one}
      .deactivatable();
}

// The routine that gives all components together. Said: what it is told of the statement, a structure of
// user_routine.h.
template <class Said, std::size_t n>
constexpr std::array<RoutineKind, 1> routine_of_components(std::string_view name,
                                                           const std::array<ValueArgument, n>& components) {
  return {{{.routine = name,
            .values = n,
            .arguments = RoutineArguments::function,
            .told =
                [](const StatementWords& s) {
                  Said said{};
                  said.ID = s.id(), said.NPAR = s.constants().count(), said.PAR = s.constants().data();
                  said.I = s.integer("I"), said.JFLOAT = s.integer("JFLOAT"), said.RM = s.integer("RM");
                  return ToldToRoutine{std::make_shared<const Said>(said)};
                },
            .components = components,
            .constants = components}}};
}

}  // namespace dynalin
