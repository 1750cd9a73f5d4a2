// A compiled routine at work for one statement, as expressions see it: several values, functions of the same inputs.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/source.h"
#include "base/time_taylor.h"

namespace dynalin {

// Values of nodes, of which a routine reads some.
template <class T>
struct RoutineInputs {
  std::span<const T> nodes;
  std::span<const std::int32_t> read;

  std::size_t size() const { return read.size(); }
  const T& operator[](std::size_t k) const { return nodes[static_cast<std::size_t>(read[k])]; }
};

class Routine {
 public:
  virtual ~Routine() = default;
  // Value `which`; not a number where the routine has none.
  virtual double value(const RoutineInputs<double>&, std::size_t which) const = 0;
  virtual TimeTaylor<double> value(const RoutineInputs<TimeTaylor<double>>&, std::size_t which) const = 0;
  // Its partial derivatives with respect to the inputs, not numbers where nobody knows them. They live until the next
  // call in this thread.
  virtual std::span<const double> partials(const RoutineInputs<double>&, std::size_t which) const = 0;
  virtual std::span<const TimeTaylor<double>> partials(const RoutineInputs<TimeTaylor<double>>&,
                                                       std::size_t which) const = 0;

  virtual std::string name() const = 0;  // "the routine sfosub of friction.so"
  // Why there is no value, or no derivative, at these inputs.
  virtual std::string reason_of_value(std::span<const double> inputs) const = 0;
  virtual std::string reason_of_partials(std::span<const double> inputs) const = 0;
};

struct Atom;
class Expression;
// Value `which` of a routine that reads these atoms in this order.
Expression routine_expression(std::vector<Atom> inputs, std::shared_ptr<const Routine>, std::size_t which,
                              const Span& at);

struct RoutineUse {
  std::shared_ptr<const Routine> routine;
  std::size_t which = 0, inputs = 0;
  Span at;
};

}  // namespace dynalin
