// Where a simulation over time has to stop on its way, and what is done there: kinks and jumps of the equations, and
// SENSORs.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mechanics/event_source.h"
#include "system/system.h"

namespace dynalin {

// Of one simulation: it keeps scratch memory.
class Events {
 public:
  explicit Events(const System&);

  std::size_t size() const { return switches_ + sensors_; }
  std::size_t switch_count() const { return switches_; }  // which come first
  // Functions that change their sign at an event: all switches of the system, then those of its sensors.
  void values(const Motion&, std::span<double>);
  // Those of sensors alone.
  void watched(const Motion&, std::span<double>);
  // Whether what sensors watch has values.
  bool watched_is_finite(const Motion&);
  // Where a simulation begins: sensors whose condition holds trigger at once.
  EventAction at_start(OperatingPoint&);
  // Where functions have changed their sign: 1 upwards, −1 downwards, 0 not. Sensors that trigger evaluate EVALUATE,
  // and the memory of the point keeps it. Without a restart the integration goes on as if nothing had been.
  EventAction at(std::span<const int> crossed, OperatingPoint&);
  // What sensors watch that has come to the other side of zero, or to it, from one list of values to another: 1
  // upwards, −1 downwards, 0 not.
  std::vector<int> passed(std::span<const double> from, std::span<const double> to) const;

 private:
  void finish(EventAction&, const OperatingPoint&) const;

  const System* system_;
  std::size_t switches_ = 0, sensors_ = 0;
  ExpressionScratch scratch_;
  SwitchList list_;
};

// All values of a point by the names of what they belong to, a line each (YYDUMP).
std::string dump_of(const System&, const OperatingPoint&);

}  // namespace dynalin
