// Which cards the case control selects.
#pragma once

#include <set>
#include <vector>

#include "nastran_reader/deck.h"

namespace dynalin::nastran_reader {

class Points;
struct Point;

// The sets that a number stands for: itself, or those of an MPCADD or SPCADD of this number.
std::set<int> sets_of(const std::optional<Selected>&, const std::vector<SetSum>&);

// Points that a card of constraint holds; one that does not exist is passed over.
std::vector<const Point*> held_points(const Spc&, const Points&);

// Every component that a card makes dependent on others, in the manner of the cards: the first of an MPC, the named
// ones of rigid elements.
struct DependentFreedom {
  int freedom;
  Span at;
  std::string card;
};
std::vector<DependentFreedom> dependent_freedoms(const Deck&, const Points&);

}  // namespace dynalin::nastran_reader
