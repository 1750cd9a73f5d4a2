// What every element contributes to the equations, by element, and what every equation of an unknown reads, quantity by
// quantity: the notes of an evaluation in order.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mechanics/element_trace.h"
#include "structural_zeros/direction_changes.h"

namespace dynalin {

struct ElementPartial {
  PartialBy family;
  std::int32_t row, column;
  double value;
};
struct ElementContribution {
  struct Load {
    double value = 0, size = 0;  // what it is, and what it has been added up from
  };
  std::vector<ElementPartial> partials;
  std::map<std::int32_t, Load> load;    // by row of the balance
  std::vector<std::int32_t> reactions;  // its constraint rows
  // What tells more than all of these where the element has them (element_trace.h).
  std::vector<ElementTrace::Law> laws;
};
struct Reading {  // one quantity in an algebraic or differential equation
  std::vector<ElementPartial> partials;
  double coefficient;
};

class ElementPartials {
 public:
  ElementPartials(const System&, const ElementTrace&, bool without_damping);

  const std::vector<ElementContribution>& elements() const { return elements_; }
  // Of an algebraic unknown or a differential state, by its equation; nothing where there are none.
  const std::vector<Reading>* readings(std::int32_t equation) const;
  // The change that a partial's quantity is measured against.
  double size_of(const Directions&, const ElementPartial&) const;

 private:
  void read(const ElementTrace::Partial&, const ElementTrace&);
  double size_of_algebraic(const Directions&, std::int32_t unknown, int depth) const;

  const std::int32_t n_, w_;  // coordinates and algebraic unknowns
  std::vector<ElementContribution> elements_;
  std::map<std::int32_t, std::vector<Reading>> readings_;  // by equation
  std::int32_t last_term_ = -1;
};

}  // namespace dynalin
