// The numbered equations of a model: sparse residuals and Jacobians out of the kernels of its elements.
#pragma once

#include <memory>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "elements/families/delay.h"
#include "mechanics/body_source.h"
#include "mechanics/equations.h"
#include "mechanics/event_source.h"
#include "mechanics/kernel.h"
#include "mechanics/signals.h"
#include "mechanics/start_source.h"
#include "mechanics/turn_counter.h"
#include "model/model.h"
#include "system/elimination.h"
#include "system/entry_keys.h"
#include "system/operating_point.h"
#include "system/sparse_lu.h"

namespace dynalin {

// Which constraint rows take part and which coordinates are independent.
struct Partition {
  std::vector<bool> active;               // rows
  std::vector<std::int32_t> independent;  // coordinates, most wanted as states first
  std::vector<std::int32_t> redundant;    // rows
};

struct SystemOptions {
  DelayReading delays = DelayReading::first_order;
  // Angles whose turns another system of the model counts: those that nothing reads here go on being counted, for what
  // an edit takes into the model again.
  std::vector<AngleName> counted_before;
};

class SignalTable;

// Finished when it is made, and never changed after: many threads may use one at a time.
class System {
 public:
  // The equations of a model, or why it cannot be solved as it stands.
  static tl::expected<std::shared_ptr<const System>, Diagnostics> make(std::shared_ptr<const Model>,
                                                                       const SystemOptions& = {});
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  const Model& model() const { return *model_; }
  const Layout& layout() const { return layout_; }
  const Signals& signals() const;
  double length() const { return length_; }  // by which displacements are made comparable with rotations
  std::size_t coordinates() const { return static_cast<std::size_t>(layout_.coordinate_count); }

  OperatingPoint drawn() const;  // poses and states as the dataset gives them, everything else zero
  Motion motion(const OperatingPoint&) const;

  void constraints(const Motion&, ConstraintRows&) const;
  // Conditions of all elements at the start, and their rows from `first_row` on.
  const std::vector<StartCondition>& starts() const { return starts_; }
  void start_rows(const Motion&, std::int32_t first_row, ConstraintRows&) const;
  // Residuals with reactions included, and the wanted partials (patterns are recorded when first wanted).
  void equations(const Motion&, const ConstraintRows&, Equations&, std::initializer_list<PartialBy> wanted) const;
  // Of courses of motions, by their places among all states; other entries stay.
  void course_rates(const Motion&, std::span<double> state_rates) const;
  void remember(OperatingPoint&) const;
  // The turns of angles alone.
  void count_turns(const Motion& motion, Memory& memory) const { turns_.remember(motion, memory); }
  // Where functions have no finite value or no derivative; the first that has no value, or else the first.
  std::vector<UndefinedValue> undefined_values(const Motion&) const;
  // Functions that have another value or slope on either side of the motion: a linear model has neither of them.
  std::vector<Kink> kinks(const Motion&) const;
  std::string undefined_value(const Motion&) const;
  std::string domain_violation(const Motion&) const;
  // Of all elements and their expressions, as many in the same order at every motion; the list is emptied first.
  void switches(const Motion&, ExpressionScratch&, SwitchList&) const;
  // Elements that watch the motion (SENSOR), kind by kind.
  std::span<const EventSource* const> event_sources() const { return event_sources_; }
  // Of an accepted instant of a motion in time, the start included: keeps what DELAYs will read. At an event, once
  // before and once behind it.
  void record(OperatingPoint&) const;
  // The second, of which the first is `before`.
  void record_behind(const OperatingPoint& before, OperatingPoint&) const;
  // The first event behind the point that is known beforehand, infinite if none is: what DELAYs read jumps or has a
  // kink.
  double next_event(const OperatingPoint&) const;
  // Ends a step that leads from one motion about to another where it would pass over what is known to be between: what
  // tables have there, what has been before and is delayed.
  bool looks_ahead() const { return looks_ahead_; }
  void look_ahead(const Motion& from, const Motion& to, ExpressionScratch&, StepReach&) const;
  // The longest step in time that resolves what elements do here; infinite if all is resolved by the error control.
  double longest_step(const Motion&) const;

  // All that have mass or could, in the order of the layout.
  std::span<const BodySource* const> bodies() const { return bodies_; }

  // Scale of a coordinate: the model length for translations, 1 for rotations, and what moves as far for the others.
  double coordinate_scale(std::int32_t coordinate) const { return scale_[static_cast<std::size_t>(coordinate)]; }
  // Elimination of the rows up to a level, the position rows or all rows on velocities, with columns in the default
  // preference. Rows that are left out count as redundant ones do, but are not among them.
  Partition partition(const ConstraintRows&, RowLevel last, const std::vector<bool>& left_out = {}) const;
  // Coordinates in the order in which they are wanted as states: by element id, rotations first, followers last.
  const std::vector<std::int32_t>& preference() const { return preference_; }

  // "Zi.Xj of JOINT/3"; rows beyond the constraints are conditions at the start
  std::string row_text(std::int32_t row) const;

 private:
  explicit System(std::shared_ptr<const Model>);
  void switches_of_elements(const Motion&, ExpressionScratch&, SwitchList&) const;  // delays aside; adds to the list
  std::shared_ptr<DelayHistories> histories_of(const OperatingPoint&) const;
  void number_bodies();
  void make_kernels(const SystemOptions&);
  void find_angles(const std::vector<AngleName>& counted_before);
  void scale_coordinates();

  std::shared_ptr<const Model> model_;
  Layout layout_;
  std::vector<std::unique_ptr<Kernel>> kernels_;
  std::unique_ptr<SignalTable> signals_;
  TurnCounter turns_;
  std::vector<StartCondition> starts_;
  std::vector<BoundExpression> switching_;  // those with kinks or jumps
  std::vector<const StartSource*> start_sources_;
  std::vector<const SwitchSource*> switch_sources_;
  std::vector<const EventSource*> event_sources_;
  std::vector<const DelaySource*> delay_sources_;
  std::vector<const BodySource*> bodies_;
  double length_ = 1;
  std::vector<double> scale_;
  std::vector<std::int32_t> preference_;
  std::vector<const SwitchSource*> delay_switches_;  // apart from the other sources of switches
  bool looks_ahead_ = false;
};

// One row of the constraint matrix scaled to comparable columns, for the elimination.
SparseRow scaled_row(const System&, std::span<const ConstraintRows::Entry>);

}  // namespace dynalin
