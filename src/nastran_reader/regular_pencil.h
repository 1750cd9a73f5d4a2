// Eigenvalues of A x = λ E x with a regular E.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "nastran_reader/deflation.h"

namespace dynalin::nastran_reader {

enum class Correction {
  none,
  by_vectors  // of each value by the quotient of its own vectors, which takes away what the size of the fastest one
              // costs
};

// Nothing if the QR iteration does not converge.
std::optional<std::vector<std::complex<double>>> regular_eigenvalues(const Pencil&, Correction);

}  // namespace dynalin::nastran_reader
