// The two kinds of SFORCE share everything but their direction.
#pragma once

#include <memory>

#include "elements/families/drawn_axes.h"
#include "elements/families/function_force.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

template <class E>
class SingleComponentSet final : public TypedSet<E> {
 public:
  using TypedSet<E>::TypedSet;
  void read(std::size_t k, ElementReader& reader) override { read_arguments(this->elements[k], reader); }
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < this->elements.size(); ++k) {
      const E& e = this->elements[k];
      const bool turns = E::acts_on_rotation;
      const PairRequirements needs{!e.action_only, turns, turns && !e.action_only};
      if (!check_pair(model, this->labels[k], e.i, e.j, needs, diagnostics)) continue;
      if (e.direction() == Direction::along_line) warn_of_missing_line(model, this->labels[k], e.i, e.j, diagnostics);
      if (turns && !e.action_only) warn_of_skew_axes(model, this->labels[k], e.i, e.j, diagnostics);
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<FunctionForce> forces;
    forces.reserve(this->elements.size());
    for (std::size_t k = 0; k < this->elements.size(); ++k) {
      const E& e = this->elements[k];
      forces.push_back({&this->labels[k], e.i, e.j, e.direction(), e.action_only, e.function});
    }
    return std::make_unique<FunctionForceKernel>(std::move(forces), layout);
  }
};

// Its routine is told which of the two it is.
inline ToldToRoutine told_of_sforce(const StatementWords& s) {
  static constexpr std::array<std::string_view, 1> rotational = {"ROTATIONAL"};
  return told<sAdamsSforce>(s, s.integer("I"), s.integer("J"), s.has("ACTIONONLY"),
                            s.word_among(rotational) ? "ROTATION" : "TRANSLATION");
}
inline constexpr std::array<RoutineKind, 1> sforce_routines = {{{.routine = "sfosub",
                                                                 .values = 1,
                                                                 .arguments = RoutineArguments::function,
                                                                 .told = told_of_sforce,
                                                                 .constants = value_of_function}}};

template <class E>
constexpr Kind single_component() {
  return Kind{
      "SFORCE",
      E::variant,
      E::summary,
      Kind::Role::element,
      detail::argument_infos<E>,
      [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<SingleComponentSet<E>>(kind); },
      Kind::EnergyRows::one}
      .deactivatable()
      .calling(sforce_routines);
}

}  // namespace dynalin
