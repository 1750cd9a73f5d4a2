// How far joints are turned and moved at the start, where elements state it, and how the displacements of several hang
// together: a place of bodies shows no whole turns.
#pragma once

#include <string_view>
#include <vector>

#include "mechanics/motion.h"

namespace dynalin {

// Σ factor q = constant at the start; of one q that is what an element states.
struct StartDisplacements {
  struct Term {
    MarkerId i, j;
    bool turns = true;  // about z of J, else along it
    double factor = 1;
  };
  std::vector<Term> terms;
  double constant = 0;
  const ElementLabel* of = nullptr;
  std::string_view argument;  // that states it; "" if it holds as long as the element does
};

class StartDisplacementSource {
 public:
  virtual void start_displacements(const Motion& start, std::vector<StartDisplacements>&) const = 0;

 protected:
  ~StartDisplacementSource() = default;
};

}  // namespace dynalin
