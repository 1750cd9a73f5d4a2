// VARIABLE as others see it.
#pragma once

#include "expression/expression.h"
#include "mechanics/handles.h"
#include "model/model.h"

namespace dynalin {

// The expression that defines a VARIABLE.
const Expression& variable_function(const Model&, VariableRef);

}  // namespace dynalin
