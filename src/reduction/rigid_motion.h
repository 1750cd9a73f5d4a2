// How the model moves as a rigid body, which of these motions strain nothing, and the mass that they see.
#pragma once

#include <Eigen/Core>

#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

// n x 6: the freedoms in unit translations along x, y, z and unit (linearized) rotations about axes through the origin.
Eigen::MatrixXd rigid_motions(const FiniteElementModel&);

struct FreeMotions {
  Eigen::MatrixXd directions;  // 6 x r: combinations of the six motions that strain nothing
  double strain = 0;           // the largest |K R| of these, beside |K||R|: rounding of the matrices
};
FreeMotions free_motions(const FiniteElementModel&, const Eigen::MatrixXd& rigid);

// What the mass matrix says of the undeformed body.
struct MassProperties {
  Eigen::Matrix<double, 6, 6> matrix;  // RᵀMR about the origin
  double mass = 0;                     // the mean of the three directions [mass]
  double uneven = 0;                   // how far these differ, relative: not 0 where freedoms are held
  Eigen::Vector3d centre;              // [length]
  Eigen::Matrix3d inertia;             // about the centre [mass·length²]
};
MassProperties mass_properties(const FiniteElementModel&, const Eigen::MatrixXd& rigid);

}  // namespace dynalin::reduction
