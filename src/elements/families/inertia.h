// Bodies with mass: inertia forces and weight.
//
// With ρ = R s of every mass point, m c = ∫ρ dm, and the second moments S_ab = ∫ s_a s_b dm along the body's axes a_a,
// the inertia force and its moment about the BCS origin are written on the path alone, without ω:
//
//     F = m r″ + m c″,     T = m c × r″ + Σ S_ab a_a × a_b″
//
// Varying the path, δa = δθ × a, gives the exact partials:
//
//     δF = m δr″ + δθ″×mc + 2 δθ′×mc′ + δθ×mc″
//     δT = mc × δr″ + (mr″×(mc×δθ))/m + J δθ″ + 2 (tr G₁ − G₁) δθ′ + (G₂ᵀ − G₂) δθ
//
// with G₁ = Ȧ S Aᵀ, G₂ = Ä S Aᵀ and J = tr(A S Aᵀ) − A S Aᵀ.
#pragma once

#include <memory>
#include <vector>

#include "elements/families/rigid_body.h"
#include "mechanics/kernel.h"
#include "model/model.h"

namespace dynalin {

class InertiaKernel final : public Kernel {
 public:
  // All rigid bodies of one kind in the model.
  InertiaKernel(const Model&, const Layout&, BodyKind);
  void equations(const Motion&, Equations&) const override;
  std::vector<const BodySource*> bodies() const override;
  std::size_t shares() const override { return shares_of(masses_.size()); }

 private:
  struct Mass {
    BodyId body;
    double mass;    // dynamical
    Vector moment;  // m s, BCS axes
    Matrix3 S;      // second moments about the BCS origin, BCS axes
  };
  std::vector<Mass> masses_;
  std::vector<RigidBody> bodies_;  // of the same
  Vector gravity_;
};

}  // namespace dynalin
