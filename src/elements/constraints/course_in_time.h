// FUNCTION of a MOTION with the VARIABLEs that it reads put into it: what is left of it knows TIME alone.
#pragma once

#include <optional>
#include <vector>

#include "elements/controls/array.h"
#include "elements/controls/variable.h"
#include "expression/expression.h"
#include "model/model.h"

namespace dynalin {

class CourseInTime {
 public:
  // Of the motion with this label; what it follows is noted in the model.
  CourseInTime(Model& model, const ElementLabel& label, Diagnostics& diagnostics)
      : model_(model), label_(label), diagnostics_(diagnostics) {}

  // Nothing after a reported dependence on the state.
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
  Diagnostics& diagnostics_;
  std::vector<VariableRef> within_;  // whose function is looked at
};

}  // namespace dynalin
