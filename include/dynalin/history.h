// What a simulation over time leaves behind: every VARIABLE and every REQUEST at each output time, the start included.
// Units of the dataset, angles in radians.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dynalin/request_values.h"

namespace dynalin {

struct VariableHistory {
  std::int64_t id = 0;
  std::string view_name;       // empty if it has none
  std::vector<double> values;  // at each time
};

struct RequestHistory {
  RequestName request;
  std::string view_name;                    // empty if it has none
  std::vector<std::string> components;      // "MAG", "X" …
  std::vector<std::vector<double>> values;  // at each time those of all components; not finite where there is none
};

struct History {
  std::vector<double> times;
  std::vector<VariableHistory> variables;
  std::vector<RequestHistory> requests;  // those that can be evaluated
};

}  // namespace dynalin
