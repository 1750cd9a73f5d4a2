// A flexible body out of matrices with names, as translators of finite-element results write them. With n nodes, N
// modes and v^ the matrix of the cross product by v, symbols as in modal_inertia.h:
//
//     SELNOD    n × 4     of each node its label and its place in the BCS
//     T_MODE    3n × N    x, y, z of each node in turn by a unit of each mode
//     R_MODE    3n × N    the same of rotations
//     GENSTIFF  N × N     generalized stiffness; N × 1: its diagonal
//     INVAR1    1 × 1     mass                      INVAR6    N × N     generalized mass
//     INVAR2    3 × 1     Σ m s                     INVAR7    3 × 3     Σ m (s^)ᵀ s^ + J
//     INVAR3    3 × N     Σ m φ_j                   INVAR8    3 × 3N    block j: Σ m s^ φ_j^
//     INVAR4    3 × N     Σ m s×φ_j + J ψ_j         INVAR9    3 × 3N²   block (j − 1) N + k: Σ m φ_j^ φ_k^
//     INVAR5    3 × N²    column (j − 1) N + k: Σ m φ_j×φ_k
//     SELMOD    N × 1     numbers of the modes, 1 to 999999; 1 … N without it. A second column is passed over.
//     GENDAMP   N × N     generalized damping
//     MODLOAD   (6+N) × L a column for each load: force, torque about the BCS, axes of the BCS, then of the modes
//
// INVAR5, INVAR8 and INVAR9 may be missing: the inertia does not follow the deformation then.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flexible/modal_body.h"

namespace dynalin {

// One of the MATRIX statements that a FLEX_BODY names.
struct ModalMatrix {
  std::string name;   // upper case
  std::string label;  // "MATRIX/7"
  Eigen::Map<const Eigen::MatrixXd> values;
  Span at;                                                           // the statement
  std::function<Span(Eigen::Index row, Eigen::Index column)> place;  // of a number
};

// Nothing after errors, which stand at the matrix or at its number; what is missing at `at`. `owner` is the body,
// "FLEX_BODY/2".
std::optional<ModalBody> modal_body_of(const std::vector<ModalMatrix>&, const Span& at, const std::string& owner,
                                       Diagnostics&);

}  // namespace dynalin
