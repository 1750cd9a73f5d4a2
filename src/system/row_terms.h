// What elements say of their constraint rows beyond values.
#pragma once

#include <vector>

#include "mechanics/row_terms.h"
#include "system/system.h"

namespace dynalin {

std::vector<RowTerms> row_terms(const System&, const Motion&);

}  // namespace dynalin
