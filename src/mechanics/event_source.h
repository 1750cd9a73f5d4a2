// Elements and the events of a motion in time: where they have kinks, and those that watch it and act, as SENSORs do.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "expression/switch_list.h"
#include "mechanics/equations.h"
#include "mechanics/motion.h"

namespace dynalin {

// Elements with kinks or jumps of their own. Those of bound expressions (the ends of a STEP, the condition of an IF)
// are known without.
class SwitchSource {
 public:
  // Adds functions of the motion that change their sign where what the elements say has a kink or a jump: as many in
  // the same order at every motion.
  virtual void switches(const Motion&, ExpressionScratch&, SwitchList&) const = 0;

 protected:
  ~SwitchSource() = default;
};

// What is to be done at an instant.
struct EventAction {
  bool restart = false;               // the integration begins anew: what the motion follows from has changed
  bool output = false;                // a step of output is written
  bool returns = false;               // the simulation ends here
  bool halts = false;                 // and the run with it
  bool refactor = false;              // the Jacobian is factored anew
  bool dump = false;                  // all values are written into the message file
  std::optional<double> output_step;  // from here on [time]
  std::optional<double> step_size;    // of the next step of the integration [time]
  std::string text;                   // for the message file: whole lines

  bool ends() const { return returns || halts; }
  // What is to be done at the same instant as well, behind it.
  void add(const EventAction& more) {
    restart = restart || more.restart, output = output || more.output, refactor = refactor || more.refactor;
    returns = returns || more.returns, halts = halts || more.halts, dump = dump || more.dump;
    if (more.output_step) output_step = more.output_step;
    if (more.step_size) step_size = more.step_size;
    text += more.text;
  }
};

class EventSource {
 public:
  virtual std::size_t event_count() const = 0;
  // Adds a function for each of its elements that changes its sign where what is watched passes what it is compared
  // with.
  virtual void crossings(const Motion&, ExpressionScratch&, SwitchList&) const = 0;
  // What those do whose functions changed their sign, 1 upwards, −1 downwards, 0 not at all; the memory keeps it.
  virtual void act(const Motion&, std::span<const int> crossed, Memory&, EventAction&) const = 0;
  // What those do whose condition holds already where a simulation begins.
  virtual void act_at_start(const Motion&, Memory&, EventAction&) const = 0;

 protected:
  ~EventSource() = default;
};

}  // namespace dynalin
