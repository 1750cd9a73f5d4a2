// A body that changes its shape by modes, as the model has it: the modes and where their coordinates are.
#pragma once

#include "flexible/modal_body.h"
#include "mechanics/handles.h"

namespace dynalin {

struct FlexibleBody {
  BodyId body;
  const ModalBody* flexible = nullptr;
  std::size_t first = 0;  // of its modal coordinates among those outside poses
};

}  // namespace dynalin
