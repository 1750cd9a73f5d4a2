// How densely events follow each other. Where functions switch without end their switches are passed over for some
// steps, within the error that is allowed; where time does not pass in any number of events the run ends.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/initial.h"
#include "system/system.h"

namespace dynalin {

class EventDensity {
 public:
  // An event of a run of that duration; a failure where too many have been on next to no way.
  Result<void> pass(double time, double duration);
  // What is on the other side of an event not what it was before: values of VARIABLEs and rates of states. The course
  // of a MOTION follows time alone, which nothing drives to and fro.
  void note_jumps(const Layout&, const std::vector<double>& values, const std::vector<double>& rates,
                  const OperatingPoint& behind);
  // The integration begins anew after so many steps of the run, at a point with kinks; a warning where switches are
  // passed over from here on.
  using Kinks = std::function<std::vector<Kink>()>;
  void note_restart(std::int64_t steps, double time, const Kinks&, Diagnostics& warnings);
  // Whether switches are looked for.
  bool watches() const;
  // After a step without event: whether switches that were passed over are to be looked for again.
  bool watch_again(std::int64_t steps);

 private:
  double crowd_from_ = 0;  // the time of the first event of a crowd
  int crowd_ = 0, close_ = 0;
  std::optional<std::int64_t> last_;                    // restart, counted in steps
  bool said_ = false;                                   // the warning
  std::set<std::string> jumping_;                       // what had another value behind the last event
  std::vector<double> largest_values_, largest_rates_;  // at events so far
};

}  // namespace dynalin
