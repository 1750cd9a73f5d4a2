// Switching functions: functions of the motion that change their sign where a value has a kink or a jump. Between two
// instants at which none of them does everything is smooth, so that an integrator locates the changes and steps from
// one to the next.
#pragma once

#include <span>
#include <vector>

namespace dynalin {

struct SwitchList {
  std::vector<double> value;  // always finite
  // Whether a change of sign means anything here: not in a branch of an IF that is not taken.
  std::vector<char> counts;
  bool any_undefined = false;  // since it was cleared

  // One that has no value here, such as SQRT(x) − 1 at x < 0, is 1.
  void add(double switching, bool does_count = true);
  void clear() { value.clear(), counts.clear(), any_undefined = false; }
};

// Whether one that counts at either motion has another sign at the second.
bool changes_between(const SwitchList&, const SwitchList&);

// Changes its sign at every knot, of which the first is number `first` of all; continuous, negative before knot 0. One
// function serves any number of knots, but two that are passed in one step are not seen.
double knot_switch(std::span<const double> knots, double x, std::size_t first = 0);

}  // namespace dynalin
