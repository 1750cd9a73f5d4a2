// What others ask of FLEX_BODY statements beyond the body.
#pragma once

#include <vector>

#include "elements/families/flexible_place.h"
#include "model/model.h"

namespace dynalin {

// All of the model, in the order of the bodies. Mass and inertia of their Body are those of the undeformed body about
// the BCS, which stands for the mass centre.
std::vector<FlexibleBody> flexible_bodies(const Model&);
// By BodyId, null where a body is rigid.
std::vector<const ModalBody*> flexible_by_body(const Model&);

}  // namespace dynalin
