// The body file that a FLEX_BODY names, and how long the body is.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flexible/modal_body.h"
#include "model/schema.h"

namespace dynalin {

// Nothing after a report: of a file that is none, or at its lines of what is wrong in it.
std::shared_ptr<ModalBody> read_body_file(const std::string& name, ElementReader&);
// The diagonal of the box around the nodes.
double extent_of(const std::vector<Vector>& nodes);

}  // namespace dynalin
