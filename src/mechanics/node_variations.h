// How a marker on a body that changes its shape follows the modal coordinates of that, whatever their number.
//
// With the axes A of the body, the shapes φ_k, ψ_k of the node and the rotation vector a = ψ q
// (mechanics/deformation.h),
//
//     δp = A (φ_k + Σ_j M_j ψ_kj) δq_k,     δφ = A Σ_j U_j ψ_kj δq_k
//
// where M_j = ∂(Q o)/∂a_j and U_j is the spin of Q by a_j: only the three components of a have to be varied.
#pragma once

#include <array>
#include <cstdint>

#include "mechanics/deformation.h"
#include "mechanics/equations.h"

namespace dynalin {

// What a force and a torque on the marker, global axes, work on the modal coordinates: φ_k and ψ_k times these.
struct ModalWork {
  Vector on_translation, on_rotation;

  double of(const NodeShapes& shapes, std::size_t k) const {
    return dot(shapes.translation[k], on_translation) + dot(shapes.rotation[k], on_rotation);
  }
};

class NodeVariations {
 public:
  NodeVariations(const Motion&, BodyId, const NodeShapes&);  // the shapes outlive it

  // By one of them along the motion: δp = moves δq, δφ = turns δq, global axes.
  struct One {
    Vec3<Taylor> moves, turns;
  };
  One by(std::size_t k) const;
  ModalWork work(const Vector& force, const Vector& torque) const;

 private:
  const NodeShapes* shapes_;
  Mat3<Taylor> axes_;           // A
  Mat3<Taylor> moves_, turns_;  // A M_j, A U_j
};

// How work that a force and a torque do changes with the modal coordinates themselves: on coordinate k with l by ψ_kᵀ S
// ψ_l; this is S.
Matrix3 change_of_work(const Motion&, BodyId, const NodeShapes&, const Vector& force, const Vector& torque);

// Adds factor times the work on all modal coordinates to a column.
void add_modal_rows(PartialBy, std::int32_t column, const NodeShapes&, const ModalWork&, double factor, Equations&);

}  // namespace dynalin
