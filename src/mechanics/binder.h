// What elements need while a system is made: references become numbers, and where an expression reads what is not
// there yet, an unknown, a state or a place in the memory is made for it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mechanics/signals.h"

namespace dynalin {

class Binder {
 public:
  virtual ~Binder() = default;
  virtual const Signals& signals() const = 0;
  // The channel of a data atom, the rate that a DIF1 reads included.
  virtual Channel data(const Atom&) = 0;
  // The time derivative of a channel; that of an algebraic value becomes an unknown of its own.
  virtual Channel rate_of(const Channel&) = 0;
  // The unknown that a DELAY is.
  virtual Channel delayed(const Atom&) = 0;
  // Where the memory holds what the SENSOR of that id gave when it last triggered.
  virtual std::int32_t sensor_value(std::int64_t id) = 0;
  // An expression that is part of the equations reads what kind of analysis it is evaluated in.
  virtual void note_analysis() = 0;
  // One with kinks or jumps.
  virtual void note_switches(const BoundExpression&) = 0;
  // Gives a call its SPLINE or CURVE.
  virtual void attach(SplineUse&) = 0;
  virtual std::int32_t add_memory(const ElementLabel& owner, std::string_view name, double initial) = 0;
  // Where the memory has AX, AY or AZ with all its turns.
  virtual std::int32_t count_turns(Measure, MarkerId i, MarkerId j) = 0;
  // Notes why the model cannot be solved as it stands, and where that is written.
  virtual void problem(std::string_view code, const Span& at, std::string, std::string hint = {}) = 0;
};

}  // namespace dynalin
