// A linear form on coordinates by the entries that are not zero.
#pragma once

#include <cstdint>
#include <vector>

namespace dynalin {

struct SparseRow {
  std::vector<std::int32_t> column;  // any order
  std::vector<double> value;
};

}  // namespace dynalin
