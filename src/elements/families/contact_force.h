// Contact between the shapes of two bodies: where they overlap, a pressure and friction at each place
// (families/contact_law.h, geometry/touch.h). All of it is one wrench on the marker of I's first shape, at its origin;
// the opposite acts on J's body there. Every formula is that of the motion of one marker seen from the other, so that
// the turning of the normal and the travel of the place of contact are in all derivatives.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "elements/families/contact_law.h"
#include "expression/routine.h"
#include "geometry/touch.h"
#include "mechanics/event_source.h"
#include "mechanics/kernel.h"
#include "mechanics/stiction_source.h"
#include "mechanics/wrench_source.h"
#include "model/model.h"

namespace dynalin {

// A shape on one of the two bodies, placed in the axes of the marker of the first one.
struct PlacedSide {
  solid::Side side;
  Frame<double> from_first;
  bool is_first = true;  // there
};

struct ContactForce {
  MarkerId i, j;
  std::vector<PlacedSide> I, J;
  Pressure pressure;
  std::optional<SlipFriction> friction;
  bool friction_in_statics = true;
  // Compiled routines in the place of the two laws, null where those act.
  std::shared_ptr<const Routine> normal_routine, friction_routine;
};

class ContactKernel final : public Kernel, public WrenchSource, public SwitchSource, public StictionSource {
 public:
  ContactKernel(const std::vector<ContactForce>&, const std::vector<ElementLabel>&, Layout&);

  void equations(const Motion&, Equations&) const override;
  std::size_t shares() const override { return forces_.size() / 2 + 1; }  // facets take long
  void undefined_values(const Motion&, UndefinedValues&) const override;

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return forces_[k].law->i; }
  MarkerId marker_J(std::size_t k) const override { return forces_[k].law->j; }
  void wrench(const Motion&, std::size_t k, Partials wanted, MarkerWrench&) const override;

  const SwitchSource* kinks() const override { return this; }
  // Where surfaces meet or part, where they hold each other no more, and where a plane ends.
  void switches(const Motion&, ExpressionScratch&, SwitchList&) const override;

  // Its friction has no bristles: nothing sticks, and at rest it bears nothing.
  void sticking(const Motion&, std::vector<Stiction>&) const override {}
  void exhausted(const Motion&, std::vector<std::string>&) const override;

 private:
  struct Placed {
    const ContactForce* law;   // of the model
    const MarkerPlace *I, *J;  // of the layout
  };
  static PairForce force_of(const Placed&, const PairMotion&, const Motion&, Partials wanted);
  std::vector<Placed> forces_;
  const std::vector<ElementLabel>* labels_;
};

// Where a contact is on the brink of another law: on the one side of the point it pushes and on the other it does not,
// or pushes with another stiffness.
struct ContactBrink {
  enum class Kind : std::uint8_t { touching, letting_go, end_of_plane, end_of_face };
  Kind kind;
  bool pushes;  // here
};
// Each kind once, of all places of the contact. `length`: how near counts, 1e-9 of it [length].
std::vector<ContactBrink> brinks(const ContactForce&, const Motion&, const MarkerPlace& I, const MarkerPlace& J,
                                 double length);

}  // namespace dynalin
