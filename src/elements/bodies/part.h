// What others ask of PART statements beyond the body.
#pragma once

#include <vector>

#include "model/model.h"

namespace dynalin {

struct PartCentre {
  const ElementLabel* part = nullptr;
  MarkerId cm;  // not valid where the statement names none
};
// Of every PART, in the order of the dataset.
std::vector<PartCentre> part_centres(const Model&);

}  // namespace dynalin
