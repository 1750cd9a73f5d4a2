// An operating point by what its values belong to: a plain value that can be written down and put into the system of
// another run, as far as the same elements are there.
#pragma once

#include <string>
#include <vector>

#include "mechanics/delay_history.h"
#include "model/restated.h"
#include "system/carried_pairs.h"
#include "system/carried_turns.h"
#include "system/entry_keys.h"
#include "system/system.h"

namespace dynalin {

struct SavedPoint {
  struct Body {
    EntryKey of;
    Pose pose;
    Vector origin_offset;  // see Body of the model
    std::vector<double> velocity, acceleration;
  };
  struct Coordinates {  // outside bodies
    EntryKey of;
    std::vector<double> values, velocity, acceleration;
  };
  struct Value {
    EntryKey of;
    double value = 0;
  };
  struct State {
    EntryKey of;
    double value = 0, rate = 0;
  };

  struct Delay {  // the past that a call of DELAY reads
    EntryKey of;
    double start = 0;  // of the motion
    std::vector<DelayHistory::Instant> instants;
  };

  double time = 0;
  AnalysisMode mode = AnalysisMode::initial_conditions;
  double redundancy_tolerance = 0;
  std::vector<Body> bodies;
  std::vector<Coordinates> coordinates;
  std::vector<Value> multipliers, values, memory;
  KnownTurns turns;
  std::vector<State> states;
  std::vector<KnownPair> pairs;  // that states tell of
  std::vector<Delay> delays;     // none before anything has moved in time
};

SavedPoint saved_point(const System&, const OperatingPoint&);

struct RestoredPoint {
  OperatingPoint point;
  std::vector<std::string> not_here;   // elements that were saved and are not in this system
  std::vector<std::string> not_saved;  // elements of this system that start as they are stated
  std::vector<std::string> others;     // so do these: they have other coordinates than what was saved
  Restated begun;                      // what is stated of these holds at the next analysis
};
RestoredPoint restored_point(const SavedPoint&, const System&);

}  // namespace dynalin
