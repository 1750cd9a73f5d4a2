// Forces that are linear in the displacement of I from J, as BUSHING, FIELD and BEAM have them:
//
//     (F, T) = FORCE − K (y − LENGTH) − C y′        on I, in the axes of J
//     y = (DX, DY, DZ, AX, AY, AZ)(I,J) in the axes of J,   y′ = (velocity seen from J, relative angular velocity)
//
// or what a compiled routine of the user says of y − LENGTH and y′, if it has one. The opposite acts on J's body at the
// origin of I, which is −F and −T − p × F at the origin of J (families/read_displacement.h).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "elements/families/markers.h"
#include "elements/families/read_displacement.h"
#include "expression/routine.h"
#include "mechanics/kernel.h"
#include "mechanics/wrench_source.h"
#include "model/schema.h"

namespace dynalin {

// As the statements give it.
struct LinearLaw {
  MarkerId i, j;
  Array66 K{}, C{};          // stiffness and damping
  Array6 length{}, force{};  // displacement at which `force` acts
  std::shared_ptr<const Routine> routine{};
};

// As it is kept: most have a diagonal alone.
struct LinearWrench {
  struct Coupling {
    std::uint8_t row, column;
    double K, C;
  };
  MarkerId i, j;
  std::vector<Coupling> couplings;  // row by row, without those that are zero
  Array6 length{}, force{};
  // Force of time, mode, y − LENGTH and y′ in this order, in the place of `couplings` and `force`.
  std::shared_ptr<const Routine> routine;

  LinearWrench() = default;
  explicit LinearWrench(const LinearLaw&);
  // Whether rotations or torques are in it; without them POINT_MASSes will do.
  bool turns() const;
  // Those with a stiffness; a damper reads the angular velocity and no angle.
  AnglesRead reads_angles() const;
  // Whether the force is along the line to the origin of J wherever I is at rest: K is the same in all directions, and
  // nothing is added. Then the opposite has no moment about that origin.
  bool is_central() const;
};

// A law without torques whose opposite turns the body of J all the same, because it acts at the origin of I: reported
// where that body is a POINT_MASS.
void check_moment_on_J(const Model&, const ElementLabel&, const LinearWrench&, Diagnostics&);

class LinearWrenchKernel final : public Kernel, public WrenchSource {
 public:
  LinearWrenchKernel(const std::vector<LinearWrench>&, const std::vector<ElementLabel>&, Layout&);
  void equations(const Motion&, Equations&) const override;
  std::size_t shares() const override { return shares_of(laws_.size()); }
  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return laws_[k].law->i; }
  MarkerId marker_J(std::size_t k) const override { return laws_[k].law->j; }
  void wrench(const Motion&, std::size_t, Partials wanted, MarkerWrench&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;

 private:
  struct Placed {
    const LinearWrench* law;   // of the model
    const MarkerPlace *I, *J;  // of the layout
    CountedAngles angles;
  };
  static RelativeWrench law_of(const Placed&, const PairMotion&, const Motion&, Partials wanted);
  static Array6 rounding_of(const Placed&, const PairMotion&);  // of forces and torques
  std::vector<Placed> laws_;
  const std::vector<ElementLabel>* labels_;
};

// Elements E that give `LinearLaw law(ElementReader&)` from their arguments, reporting what does not fit.
template <class E>
class LinearWrenchSet final : public TypedSet<LinearWrench> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    E written;
    const bool readable = read_arguments(written, reader);
    // What is wrong with values is said beside what is wrong with other arguments.
    constexpr bool says_all = requires { E::says_all; };
    if (!readable && !says_all) return;
    const LinearLaw law = written.law(reader);
    if (readable) elements[k] = LinearWrench(law);
  }
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const bool turns = elements[k].turns();
      check_pair(model, labels[k], elements[k].i, elements[k].j, {.rotation_of_I = turns, .rotation_of_J = turns},
                 diagnostics);
      if (!turns) check_moment_on_J(model, labels[k], elements[k], diagnostics);
      if (turns && !diagnostics.has_errors())
        warn_of_undefined_angles(model, labels[k], elements[k].i, elements[k].j, elements[k].reads_angles(),
                                 diagnostics);
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<LinearWrenchKernel>(elements, labels, layout);
  }
};

template <class E>
constexpr Kind linear_wrench() {
  return Kind{
      E::keyword,
      "",
      E::summary,
      Kind::Role::element,
      detail::argument_infos<E>,
      [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<LinearWrenchSet<E>>(kind); },
      Kind::EnergyRows::one}
      .deactivatable();
}

// Puts a list of exactly N values into an array; false after a reported error. An empty list leaves the array as it is.
template <std::size_t N>
bool take_values(const std::vector<double>& values, std::string_view name, std::array<double, N>& out,
                 ElementReader& reader);
extern template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 3>&, ElementReader&);
extern template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 6>&, ElementReader&);
extern template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 21>&, ElementReader&);
extern template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 36>&, ElementReader&);
// A 6 × 6 matrix entered by columns.
Array66 by_columns(const std::array<double, 36>&);
Array66 scaled(const Array66&, double factor);

}  // namespace dynalin
