// Craig–Bampton: a finite-element model in a few shapes, exact in statics at its interface nodes.
//
// With b the interface freedoms and i the others,
//     constraint modes  Ψ = [E; −K_ii⁻¹ K_ib],   fixed-interface modes  K_ii φ = ω² M_ii φ,   T = [Ψ, [0; φ]],
// made orthogonal by (TᵀKT) v = ω² (TᵀMT) v after motions of the whole as a rigid body are taken out: not those of a
// low frequency, but the motions themselves, which the constraint modes reproduce exactly. What is left are
// approximations of the modes of the free body and, above them, shapes that carry the compliance of the interface.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "base/diagnostics.h"
#include "reduction/finite_element_model.h"
#include "reduction/rigid_motion.h"

namespace dynalin::reduction {

struct ReductionRequest {
  std::vector<NodeLabel> interface;                                    // their translations and rotations are kept
  Eigen::Index modes = 20;                                             // fixed-interface modes, at most
  double highest_frequency = std::numeric_limits<double>::infinity();  // of these [cycles/time]
  bool rotations_required = true;  // an interface node without rotations is an error
};

struct Reduction {
  Eigen::MatrixXd shapes;           // n x N, in the order of frequency; M is E in those with mass
  Eigen::VectorXd squares;          // N: ω², the diagonal of K in them [rad²/time²]
  Eigen::VectorXd fixed_interface;  // ω² of the fixed-interface modes that were taken
  Eigen::Index constraint_modes = 0;
  Eigen::Index rigid_removed = 0;  // motions of the whole: 6 of a body that nothing holds
  // Of the shapes the last ones: they have no mass, as the rotations of lumped masses, or hardly any beside that of the
  // body, and count as if they vibrated at 100 times the highest frequency of the others.
  Eigen::Index massless = 0;
  double strain_of_rigid = 0;  // FreeMotions::strain
  double off_diagonal = 0;     // how far shapes miss orthogonality, in M and, of each pair's frequencies, in K
  MassProperties properties;
};

// What is wrong with the request and with the model as a whole goes to the diagnostics; the error says that numbers
// failed, and is empty beside diagnostics.
tl::expected<Reduction, std::string> reduce_model(const FiniteElementModel&, const ReductionRequest&, Diagnostics&);

}  // namespace dynalin::reduction
