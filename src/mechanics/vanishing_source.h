// Elements whose equations take in the size of a vector that is zero here, to rounding. It has no derivative, and the
// equations hold it as constant; what comes of that where the vector changes is for the linear model to ask.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mechanics/equations.h"

namespace dynalin {

struct VanishingSize {
  struct Partial {
    PartialBy family;
    std::int32_t column;
    double value;
  };
  std::vector<std::vector<Partial>> components;  // of the vector, by the unknowns
  std::vector<std::int32_t> algebraic;           // values whose equations take its size in
  std::string reason;                            // a sentence that names the element
};

class VanishingSource {
 public:
  virtual void vanishing(const Motion&, const Layout&, std::vector<VanishingSize>&) const = 0;
  // What rounding makes of the multipliers at a point: sizes that are no more are zero from now on.
  virtual void take_rounding(const Motion&, std::span<const double> of_multipliers, Memory&) const = 0;

 protected:
  ~VanishingSource() = default;
};

}  // namespace dynalin
