// MATRIX as other controls see it.
#pragma once

#include <vector>

namespace dynalin {

struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
  double operator()(std::size_t r, std::size_t c) const { return values[c * rows + r]; }
};

}  // namespace dynalin
