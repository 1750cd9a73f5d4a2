// Sets of elements that have something to say of a point at which a model is linearized.
#pragma once

#include "base/diagnostics.h"
#include "mechanics/motion.h"

namespace dynalin {

struct Model;

class LinearRemarks {
 public:
  // Adds warnings that name the elements; `length` is that of the model.
  virtual void remark_at(const Model&, const Motion&, double length, Diagnostics&) const = 0;

 protected:
  ~LinearRemarks() = default;
};

}  // namespace dynalin
