// FUNCTION of a MOTION or GCON with the VARIABLEs that it reads put into it: what is left of it knows TIME alone, or
// displacements and velocities as well. No row of a constraint follows an unknown.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "elements/controls/array.h"
#include "elements/controls/variable.h"
#include "expression/expression.h"
#include "model/model.h"

namespace dynalin {

// What may be left, in words, and the code of the error where something else is.
struct Readable {
  bool (*reads)(const Atom&);
  std::string_view in_words, code;
};
inline constexpr Readable time_alone = {[](const Atom& a) { return a.function->family == AtomFamily::time; },
                                        "TIME only", "function-of-state"};

class WithoutVariables {
 public:
  // Of the constraint with this label; what it follows is noted in the model.
  WithoutVariables(Model& model, const ElementLabel& label, const Readable& readable, Diagnostics& diagnostics)
      : model_(model), label_(label), readable_(readable), diagnostics_(diagnostics) {}

  // Nothing after a reported dependence on something else.
  std::optional<Expression> of(const Expression& function);

 private:
  std::optional<Expression> definition(const Atom&);
  const Array* array_of(const Atom&) const;
  // Of an ARRAY of numbers.
  std::optional<double> constant(const Atom&) const;
  // The VARIABLE that an atom reads, by itself or as an entry of an ARRAY, PINPUT or POUTPUT.
  std::optional<VariableRef> variable_of(const Atom&) const;

  Model& model_;
  const ElementLabel& label_;
  const Readable& readable_;
  Diagnostics& diagnostics_;
  std::vector<VariableRef> within_;  // whose function is looked at
};

}  // namespace dynalin
