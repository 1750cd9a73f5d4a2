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
  ElementHandle owner;          // of an X or Y array: the LSE, GSE … it belongs to
  std::size_t owned_size = 0;   // its number of entries there
  std::size_t owned_first = 0;  // which of the owner's states is its first entry

  static constexpr std::array<Argument<Array>, 7> arguments = {{
      {.name = "IC", .slot = &Array::ic, .help = "constants, such as initial conditions"},
      {.name = "U", .slot = &Array::u, .help = "inputs: values of VARIABLEs"},
      {.name = "X", .slot = &Array::x, .help = "states of one LSE, GSE or TFSISO"},
      {.name = "Y", .slot = &Array::y, .help = "outputs of one LSE, GSE or TFSISO"},
      {.name = "SIZE", .slot = &Array::size, .minimum = 1, .help = "number of entries"},
      {.name = "NUMBERS", .slot = &Array::numbers, .help = "the constants"},
      {.name = "VARIABLES", .slot = &Array::variables, .help = "the inputs in order"},
  }};

  std::size_t entries() const { return u ? variables.size() : (x || y) ? owned_size : numbers.size(); }
};

// What an element has in an X or Y array.
struct OwnedEntries {
  char type;  // 'X' or 'Y'
  std::size_t size;
  std::string_view argument{};  // that names the array, where it is not called as its type
  std::size_t first = 0;        // of its states
};
// Ties the array to its owner and checks type and size; reports what does not fit.
void claim_array(Model&, ArrayRef, const OwnedEntries&, ElementHandle owner, const ElementLabel& owner_label,
                 Diagnostics&);
inline void claim_array(Model& model, ArrayRef ref, char type, std::size_t size, ElementHandle owner,
                        const ElementLabel& owner_label, Diagnostics& diagnostics) {
  claim_array(model, ref, {type, size}, owner, owner_label, diagnostics);
}
// The U array of an element: its VARIABLEs, or a report and nothing.
const Array* input_array(const Model&, ArrayRef, const ElementLabel& owner_label, Diagnostics&);

}  // namespace dynalin
