// MATRIX as other controls see it.
#pragma once

#include <string>
#include <vector>

namespace dynalin {

struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
  std::string name;            // upper case; empty without NAME
  double operator()(std::size_t r, std::size_t c) const { return values[c * rows + r]; }
};

}  // namespace dynalin
