// Beams: inertia, weight, stiffness and damping of each element between two nodes (flexible/beam_element.h). Their
// coordinates outside poses are the slopes of the nodes and the rotations of the middles of elements.
#pragma once

#include "elements/bodies/fe_part.h"
#include "mechanics/kernel.h"

namespace dynalin {

class BeamBodyKernel final : public Kernel {
 public:
  // All beams of the model; adds their coordinates to the layout.
  BeamBodyKernel(const Model&, Layout&);
  void equations(const Motion&, Equations&) const override;
  std::string domain_violation(const Motion&) const override;

 private:
  std::vector<BeamBody> beams_;
  Vector gravity_;
};

}  // namespace dynalin
