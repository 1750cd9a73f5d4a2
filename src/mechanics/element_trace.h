// What each element on its own adds to the equations, before anything is summed up: in a sum over elements a small
// contribution beside large ones is lost, and whether every single one vanishes cannot be seen any more.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace dynalin {

enum class PartialBy : std::uint8_t;
struct ElementLabel;

struct ElementTrace {
  struct Partial {
    PartialBy family;
    std::int32_t row, column;
    double value;
    std::int32_t term;  // of an algebraic or differential equation, −1 if the entry stands alone
  };
  struct Load {  // on a row of the force balance
    std::int32_t row;
    double value, size;  // what it has been added up from, which may have cancelled
  };
  // One force, joint or body; entries up to those of the next one are its own.
  struct Element {
    const ElementLabel* of;  // null before the first
    std::size_t first_partial, first_load;
    std::int32_t first_row, row_count;  // the constraint rows whose reactions it is, if any
  };
  std::vector<Element> elements;
  std::vector<Partial> partials;
  std::vector<Load> loads;
  std::vector<double> coefficients;  // of terms: how much of what the term reads an equation takes

  void clear() {
    elements.clear(), partials.clear(), loads.clear(), coefficients.clear(), laws.clear();
    term = -1;
    begin(nullptr, -1, 0);
  }
  void begin(const ElementLabel* of, std::int32_t first_row, std::int32_t row_count) {
    elements.push_back({of, partials.size(), loads.size(), first_row, row_count});
  }
  std::size_t end_of_partials(std::size_t e) const {
    return e + 1 < elements.size() ? elements[e + 1].first_partial : partials.size();
  }
  std::size_t end_of_loads(std::size_t e) const {
    return e + 1 < elements.size() ? elements[e + 1].first_load : loads.size();
  }

  std::int32_t term = -1;  // the one that is being added

  // One force and torque at a point as its law gives it, in axes of its own: turned into those of the ground a soft
  // direction would be lost in the rounding of a stiff one. It is all that its element adds to the balance of bodies.
  struct Law {
    struct Partial {  // of force and torque about that point where it was, along the axes as they were
      PartialBy family;
      std::int32_t column;
      std::array<double, 6> value;
    };
    std::size_t element;  // its place among these
    Matrix3 axes;
    Vector origin, force, torque;
    std::vector<Partial> partials;
  };
  std::vector<Law> laws;
};

}  // namespace dynalin
