// The wrenches of elements, as tables, reports and the force functions of expressions see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/partials.h"
#include "mechanics/equations.h"
#include "mechanics/pair.h"

namespace dynalin {

// A force or constraint element as the force functions of expressions see it: what acts on its I marker.
struct MarkerWrench {
  PairMotion pair;
  PairForce force;
  // Scalar unknowns the wrench depends on: λ of a joint, w of a FUNCTION-valued force, coordinates beyond the pair's.
  struct Scalar {
    PartialBy family;
    std::int32_t column;
    Vector force, torque;
  };
  std::vector<Scalar> scalars;
  // A marker with whose axes the wrench on I turns beyond what the pair says, by their rotation δφ in global axes.
  struct Turn {
    const MarkerPlace* axes;
    Matrix3 force, torque;
  };
  std::vector<Turn> turns;
  bool J_follows_I = false;  // J is a floating marker at the origin of I
  PairScratch scratch;       // what the element keeps while it is asked

  void clear() { scalars.clear(), turns.clear(), J_follows_I = false; }
};

// Elements that exert a wrench, for tables, reports and the force functions of expressions.
class WrenchSource {
 public:
  // How many wrenches its elements exert: one each, but where one acts on many markers.
  virtual std::size_t wrench_count(std::size_t elements) const { return elements; }
  virtual std::size_t element_of_wrench(std::size_t which) const { return which; }
  virtual MarkerId marker_I(std::size_t which) const = 0;
  virtual MarkerId marker_J(std::size_t which) const = 0;
  // The marker along whose axes the statement gives the components.
  virtual MarkerId marker_of_axes(std::size_t which) const { return marker_J(which); }
  virtual void wrench(const Motion&, std::size_t which, Partials wanted, MarkerWrench&) const = 0;

 protected:
  ~WrenchSource() = default;
};

}  // namespace dynalin
