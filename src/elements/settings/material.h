// What FE_PARTs ask of a MATERIAL.
#pragma once

#include <optional>

#include "model/model.h"

namespace dynalin {

struct MaterialData {
  double density = 0;                                    // [mass/length³]
  std::optional<double> youngs_modulus, poissons_ratio;  // [force/length²]
  Span other;  // the first argument that is not known, none where its source is null
};
// Null where the handle is of something else.
const MaterialData* material_data(const Model&, ElementHandle);

}  // namespace dynalin
