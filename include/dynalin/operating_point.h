// Where a mechanism is at one instant, how it moves, and what its constraints and forces exert.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynalin/element_id.h"
#include "dynalin/marker_state.h"
#include "dynalin/operating_state.h"
#include "dynalin/remark.h"
#include "dynalin/request_values.h"

namespace dynalin::library {

// Constant, like the model it belongs to. Ids that the model does not have throw Error.
class OperatingPoint {
 public:
  double time() const;
  // Whether constraints, velocities, forces and accelerations agree: not where the point is merely as drawn.
  bool is_consistent() const;

  // Everything that is known at the point.
  OperatingState state() const;
  // Some of it.
  BodyState part(std::int64_t id) const;
  BodyState point_mass(std::int64_t id) const;
  MarkerState marker(std::int64_t id) const;  // 0 is the global frame
  double variable(std::int64_t id) const;     // of a point as drawn 0: nothing is solved for there
  // What an element exerts on its marker I: a constraint its reaction, or a force element (on the first of its I
  // markers, where there are several). The statement may be abbreviated as in a dataset.
  Load load(const ElementId&) const;
  // What the REQUESTs have here in the order of the dataset, then those of MREQUESTs; without those that cannot be
  // evaluated, which remarks of the model name. A component without a finite value is not finite.
  std::vector<RequestValues> requests() const;

  // Constraint rows that depend on others, "Zi.Xj of JOINT/3".
  const std::vector<std::string>& redundant_rows() const;
  // Of the analysis that found the point.
  const std::vector<Remark>& remarks() const;

  // What a static analysis found, if that led here and nothing came after it. The solution itself is at rest; the point
  // may have the velocities of the dataset again.
  bool is_static() const;
  StaticResult static_result() const;  // throws if it was another analysis

  struct Inside;
  explicit OperatingPoint(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
  const Inside& inside() const { return *inside_; }

 private:
  std::shared_ptr<const Inside> inside_;
};

}  // namespace dynalin::library
