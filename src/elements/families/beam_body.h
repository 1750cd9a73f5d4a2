// Beams: inertia, weight, stiffness and damping of each element between two nodes (flexible/beam_element.h). Their
// coordinates outside poses are the slopes of the nodes and, in space, the rotations of the middles of elements; in a
// plane rows hold them there (elements/families/plane_beam_rows.h).
#pragma once

#include "elements/families/nodal_body.h"
#include "elements/families/plane_beam_rows.h"
#include "mechanics/kernel.h"

namespace dynalin {

class BeamBodyKernel final : public Kernel {
 public:
  // Adds the coordinates of beams outside poses to the layout.
  BeamBodyKernel(std::vector<BeamBody>, const Model&, Layout&);
  void constraints(const Motion&, ConstraintRows&) const override;
  void equations(const Motion&, Equations&) const override;
  std::string domain_violation(const Motion&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;
  std::vector<const BodySource*> bodies() const override;

 private:
  std::vector<BeamBody> beams_;
  std::vector<NodalBody> bodies_;  // of the same
  std::vector<PlaneBeamRows> plane_rows_;
  Vector gravity_;
};

}  // namespace dynalin
