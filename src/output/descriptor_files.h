// The sparse equations of a linear model in formats that others read.
#pragma once

#include <iosfwd>
#include <string>

#include "dynalin/descriptor_form.h"

namespace dynalin {

// Matrix Market, coordinates of real numbers; `comment` is one line above them.
void write_matrix_market(std::ostream&, const Eigen::SparseMatrix<double>&, const std::string& comment);

// A MATLAB file (level 5) with sparse E and A, those of B, C and D that there are, STATES, PINPUT and POUTPUT as the
// state matrices have them, and lists of names `states`, `inputs`, `outputs`; `first_state` counts from 1. The stream
// is bad afterwards where it could not be written.
void write_mat_file(std::ostream&, const DescriptorForm&);

// What the unknowns from the first state on, the inputs and the outputs are: a line each, columns separated by tabs.
void write_labels(std::ostream&, const DescriptorForm&);

}  // namespace dynalin
