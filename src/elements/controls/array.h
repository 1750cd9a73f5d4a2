// ARRAY as other controls see it.
#pragma once

#include <optional>
#include <vector>

#include "model/schema.h"

namespace dynalin {

struct Array {
  bool ic = false, u = false, x = false, y = false;
  std::optional<std::int64_t> size;
  std::vector<double> numbers;
  std::vector<VariableRef> variables;
  ElementHandle owner;         // of an X or Y array: the LSE, TFSISO … it belongs to
  std::size_t owned_size = 0;  // its number of entries there

  static constexpr std::array<Argument<Array>, 7> arguments = {{
      {.name = "IC", .slot = &Array::ic, .help = "constants, such as initial conditions"},
      {.name = "U", .slot = &Array::u, .help = "inputs: values of VARIABLEs"},
      {.name = "X", .slot = &Array::x, .help = "states of one LSE or TFSISO"},
      {.name = "Y", .slot = &Array::y, .help = "outputs of one LSE or TFSISO"},
      {.name = "SIZE", .slot = &Array::size, .minimum = 1, .help = "number of entries"},
      {.name = "NUMBERS", .slot = &Array::numbers, .help = "the constants"},
      {.name = "VARIABLES", .slot = &Array::variables, .help = "the inputs in order"},
  }};

  std::size_t entries() const { return u ? variables.size() : (x || y) ? owned_size : numbers.size(); }
};

// Ties the X or Y array of `owner` to it and checks type and size; reports what does not fit.
void claim_array(Model&, ArrayRef, char type, std::size_t size, ElementHandle owner, const ElementLabel& owner_label,
                 Diagnostics&);
// The U array of an element: its VARIABLEs, or a report and nothing.
const Array* input_array(const Model&, ArrayRef, const ElementLabel& owner_label, Diagnostics&);

}  // namespace dynalin
