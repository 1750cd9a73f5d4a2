// The lowest modes K φ = ω² M φ of a large sparse model that is held, none of them missed.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <tl/expected.hpp>

#include "reduction/finite_element_model.h"
#include "reduction/inertia_factors.h"

namespace dynalin::reduction {

struct LowestModes {
  Eigen::VectorXd squares;  // ω², ascending [rad²/time²]
  Eigen::MatrixXd shapes;   // a column each, φᵀMφ = 1
};

struct ModeRequest {
  Eigen::Index count = std::numeric_limits<Eigen::Index>::max();
  double below = std::numeric_limits<double>::infinity();  // ω²
};

// As many as there are, at most `count` and none above `below`, one of which is finite; a mode whose neighbour has the
// same frequency brings it with it. K is positive definite with these factors, M is positive semidefinite and may be
// singular. That none is missing is counted by the signs of K − σM. The error says what failed.
tl::expected<LowestModes, std::string> lowest_modes(const SparseMatrix& stiffness, const SparseMatrix& mass,
                                                    const InertiaFactors& of_stiffness, const ModeRequest&);

}  // namespace dynalin::reduction
