// COORDINATES and SECTION of an FE_PART: a row of numbers for each node, which begins with its label. They state what
// the lists X, Y, Z, PSI, THETA, PHI and AREA, IYY, IZZ, IYZ, IXX do, which are made of them.
#pragma once

#include <cstddef>
#include <string_view>

#include "elements/bodies/fe_part_statement.h"

namespace dynalin {

// Whether an argument is one of the two.
bool is_rows(std::string_view argument);
// Where NODE_LABELS is not stated: nodes in the order of their rows. False after an error in the labels.
bool labels_nodes(FePart&, ElementReader&);
// The rows into lists, with the labels of the nodes known; false after an error.
bool take_rows(FePart&, ElementReader&);
// Where the number stands that a list has for a node: in its row, else as the list; the statement where neither does.
Span stated_at(const FePart&, std::string_view list, std::size_t node, const ElementReader&);

}  // namespace dynalin
