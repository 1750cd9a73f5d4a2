// Which cards the case control selects.
#pragma once

#include <set>
#include <vector>

#include "nastran_reader/deck.h"

namespace dynalin::nastran_reader {

// The sets that a number stands for: itself, or those of an MPCADD or SPCADD of this number.
std::set<int> sets_of(const std::optional<Selected>&, const std::vector<SetSum>&);

// Every component that a card makes dependent on others, in the manner of the cards: the first of an MPC, the named
// ones of rigid elements.
struct DependentFreedom {
  int freedom;
  Span at;
  std::string card;
};
class Points;
std::vector<DependentFreedom> dependent_freedoms(const Deck&, const Points&);

}  // namespace dynalin::nastran_reader
