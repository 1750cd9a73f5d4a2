// Named matrices on their way into a file, and the two formats in which state matrices are exchanged.
#pragma once

#include <Eigen/Core>
#include <ctime>
#include <iosfwd>
#include <string>
#include <vector>

#include "dynalin/results.h"

namespace dynalin {

struct NamedMatrix {
  std::string name;    // at most 10 characters
  std::string suffix;  // of the MATLAB file: base name + suffix
  Eigen::MatrixXd value;
  bool transposed_in_matlab = false;  // STATES: one record a line there
};

// A, B, C, D, STATES, PINPUT, POUTPUT, leaving out what was not asked for.
std::vector<NamedMatrix> named_matrices(const StateSpace&);
// M, KB = [K B], P, C, D, STATES, PINPUT, POUTPUT.
std::vector<NamedMatrix> named_matrices(const SecondOrder&);

// MATRIXx FSAVE: a directory of names and sizes, then each matrix by columns, three values of 25 characters a line.
void write_fsave(std::ostream&, const std::vector<NamedMatrix>&, std::time_t date);
// MATLAB flat format: one matrix, one row a line, values separated by one blank.
void write_matlab(std::ostream&, const NamedMatrix&);

}  // namespace dynalin
