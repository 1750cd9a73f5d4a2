// A flexible body as its modal text file (.fem) states it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

// N modes, n nodes; axes and origin are those of the finite-element model. Shapes are displacements in units of q.
struct BodyFile {
  std::string title;              // one line
  std::vector<NodeLabel> labels;  // n
  Eigen::MatrixXd places;         // 3 x n [length]
  Eigen::MatrixXd shapes;         // 6n x N: of each node three translations [length/q], three rotations [rad/q]
  Eigen::MatrixXd mass;           // N x N [mass·(length/q)²]
  Eigen::MatrixXd stiffness;      // N x N [force/length·(length/q)²]

  // The whole body: record 12.
  double total_mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre [mass·length²]

  // Records 14 to 18. With m over all mass, s the place, φ_j the shapes, v^ the matrix of v ×:
  Eigen::MatrixXd i3, i4;  // 3 x N: Σ m φ_j and Σ m s × φ_j
  // 3 x 3N, mode by mode; empty where only the undeformed inertia is known.
  Eigen::MatrixXd i8;  // Σ m s^ φ_j^ (record 16 has the opposite sign)
  // 3 x N·N, in the order of j, then k.
  Eigen::MatrixXd i5;  // Σ m φ_j × φ_k
  // 3N x 3N, blocks j, k.
  Eigen::MatrixXd i9;  // Σ m φ_j^ φ_k^
};

// The same body in other units: numbers of length, mass and force are multiplied by these, and shapes are counted in
// the new unit of length.
struct UnitFactors {
  double length = 1, mass = 1, force = 1;
};
BodyFile in_other_units(BodyFile, const UnitFactors&);

}  // namespace dynalin::reduction
