// The structure of differential-algebraic equations by Pryce's Σ-method (BIT 41 (2001), 364): from which derivative of
// which unknown stands in which equation follow how often each equation has to be differentiated and how many values
// are free at the start. It holds where the Jacobian of the differentiated equations is regular.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace dynalin {

// The highest derivative of unknown j in equation i, nothing where it does not stand there.
using Signature = std::vector<std::vector<std::optional<int>>>;

struct StructuralIndex {
  std::vector<std::size_t> equation;  // of each unknown: a transversal with the largest sum of derivatives
  std::vector<int> differentiated;    // each equation so often, c
  std::vector<int> highest;           // of each unknown the derivative that is solved for, d
  int freedoms = 0;                   // Σ d − Σ c
};

// Nothing where no equation can be found for each unknown.
std::optional<StructuralIndex> structural_index(const Signature&);

}  // namespace dynalin
