// The search for an equilibrium from one point on, in the order that `statics.h` states: each way only where those
// before it fail.
#pragma once

#include <string>
#include <vector>

#include "analysis/static_descent.h"
#include "analysis/statics.h"

namespace dynalin {

// What happens at an equilibrium that loads of the drawn model push away.
enum class AtSaddles : std::uint8_t { stay, go_on };

class EquilibriumSearch {
 public:
  // `drawn` meets all constraints; everything in it is at rest.
  EquilibriumSearch(const System&, OperatingPoint drawn, const StaticsOptions&, StaticsReport&, Findings&);

  // `first_state`: values of differential states that a pure integrator keeps where they balance.
  Result<OperatingPoint> run(AtSaddles, const std::vector<double>& first_state);

 private:
  bool is_of_this_mechanism();
  bool is_grossly_unbalanced();
  bool may_go_on() const { return !found_ && equations_.effort() < options_.effort_limit; }
  void search_downhill();
  bool is_hopeless();
  void descend(OperatingPoint start);
  void search_by_other_ways();
  void search_from_other_places();
  std::optional<OperatingPoint> near_enough();
  void note_nearest(const OperatingPoint&);
  void keep_first_state(const std::vector<double>& first_state);
  tl::unexpected<Failure> refused();
  OperatingPoint with_report(OperatingPoint);

  const System& system_;
  const StaticsOptions& options_;
  StaticsReport& report_;
  Findings& findings_;
  StaticEquations equations_;
  StaticHistory history_;
  Descent descent_;
  OperatingPoint op_, drawn_, lowest_;
  OperatingPoint nearest_;  // to rest, of all searches: what a refusal speaks of
  bool found_ = false, held_states_ = false;
  FirstFreedoms loose_;                   // what nothing held to begin with
  const ElementLabel* turned_ = nullptr;  // a joint, by a point that was balanced otherwise
  std::vector<std::string> proof_;        // of what nothing holds anywhere
};

}  // namespace dynalin
