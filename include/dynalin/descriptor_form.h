// The linear model with all its equations kept, sparse: for models whose state matrix nobody wants to hold.
#pragma once

#include <Eigen/SparseCore>

#include "dynalin/results.h"

namespace dynalin {

// E w' = A w + B u, y = C w + D u with w = (a, x): E has ones in the rows of the states x, which are the last of w, and
// nothing elsewhere. a are displacements, velocities, accelerations, reactions and values of VARIABLEs and forces,
// which the equations without derivative determine. Eigenvalues are the finite ones of A - s E, in radians per unit
// time, and C (s E - A)^-1 B + D is the transfer function of StateSpace. Units are those of the model.
struct DescriptorForm {
  double time = 0;
  std::vector<StateLabel> states;  // of x
  Eigen::Index first_state = 0;    // its place in w, counted from 0
  std::vector<ChannelLabel> inputs, outputs;
  std::int64_t pinput = 0, poutput = 0, rm = 0, pstate = 0;  // ids as in StateSpace
  bool original = false;
  EquationsMark of_equations = 0;
  Eigen::SparseMatrix<double> E, A, B, C, D;  // B, C and D without columns, or rows, where no channels were asked for
};

}  // namespace dynalin
