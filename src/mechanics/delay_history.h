// The past that DELAY reads: values of its first argument at accepted instants of a motion in time, and their course
// between.
//
// Two neighbouring instants with known slopes are joined by the cubic that has values and slopes there, of fourth order
// in the step. Without slopes it is the cubic through four neighbours. Where the value or its slope jumps (the start,
// an event) there is an instant on either side, and no cubic goes across. Behind the last accepted instant, where a
// delay is shorter than the step, the course goes on to the present value: w = e(t − τ) then depends on e(t), smoothly,
// and becomes e(t) as τ goes to 0.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/source.h"
#include "expression/step_reach.h"

namespace dynalin {

struct Motion;

class DelayHistory {
 public:
  struct Instant {
    double time, value;
    double slope;         // NaN where it is not known
    bool begins = false;  // nothing is joined to what was before
  };
  // At a past time: the value, its slope there, and how it follows the present value.
  struct Reading {
    double value = 0, slope = 0, by_present = 0;
  };

  bool empty() const { return size() == 0; }
  double start() const { return start_; }            // of the motion
  double end() const { return end_; }                // the last accepted instant
  double oldest() const { return instant(0).time; }  // that is kept
  // At start() ≤ s ≤ end().
  Reading at(double s) const;
  // At end() < s ≤ t, where the value is `present` at t.
  Reading at(double s, double t, double present) const;
  // Changes its sign where s passes a jump or a kink.
  double switching(double s) const;
  // The first jump or kink behind s, infinite if there is none.
  double next_break(double s) const;
  // Ends a step in which the past that is read goes from s0 to s1: between two jumps or kinks, which switching() shows
  // one at a time alone, and where it would pass over something that the integration has once resolved.
  void look_ahead(double s0, double s1, StepReach&) const;

  // The next accepted instant; nothing before `oldest` is read any more. A second one at the same time begins anew if
  // the value or the slope has jumped. Where time has gone back everything does.
  void append(double time, double value, double slope, double oldest);
  // The instant right behind an event, of which the last one is the other side. It begins anew if the value or the
  // slope has jumped, or if the event `changes` the course beyond these.
  void append_behind(double time, double value, double slope, double oldest, bool changes);

  // What is kept, and the history that consists of that.
  std::vector<Instant> instants() const;
  static DelayHistory of(double start, const std::vector<Instant>&);
  // For whoever may read further back than what is kept: it begins there.
  DelayHistory from_oldest() const;

  std::size_t size() const { return full_.size() * chunk_size + recent_.size(); }  // of instants kept

 private:
  static constexpr std::size_t chunk_size = 64;
  using Chunk = std::vector<Instant>;

  const Instant& instant(std::size_t k) const {
    return k / chunk_size < full_.size() ? (*full_[k / chunk_size])[k % chunk_size]
                                         : recent_[k - full_.size() * chunk_size];
  }
  std::size_t instants_until(double s) const;  // how many of those kept
  // The next one on that side at least so far away, nothing if a jump or the end comes first.
  std::optional<std::size_t> instant_before(std::size_t k, double distance) const;
  std::optional<std::size_t> instant_behind(std::size_t k, double distance) const;
  void add(const Instant&);
  void drop(double oldest);
  bool jumps(double value, double slope) const;
  void note_size(double value, double slope);

  // A copy shares what is complete, so that each accepted point has its own history at little cost.
  std::vector<std::shared_ptr<const Chunk>> full_;
  Chunk recent_;
  std::vector<double> breaks_;      // times of instants that begin anew
  std::size_t breaks_dropped_ = 0;  // before those
  double start_ = 0, end_ = 0;
  double largest_value_ = 0, largest_slope_ = 0;  // so far
};

// Of all calls of DELAY, in the order of Layout::delay_calls.
class DelayHistories {
 public:
  explicit DelayHistories(std::size_t calls) : of_call(calls) {}
  std::vector<DelayHistory> of_call;
};

// The calls of DELAY of a model.
class DelaySource {
 public:
  // An accepted instant of a motion in time: what will be read of it is kept.
  virtual void record(const Motion&, DelayHistories&) const = 0;
  // Behind an event, after what was right before it has been recorded. `by_elements`: something other than a delay has
  // a kink or a jump there.
  virtual void record_behind(const Motion& before, const Motion& now, bool by_elements, DelayHistories&) const = 0;
  // The first instant behind `time` at which a jump or a kink of the past acts, as far as that is known.
  virtual double next_event(double time, const DelayHistories&) const = 0;
  // Ends a step that leads from one motion about to another where the past would pass over what is between.
  virtual void look_ahead(const Motion&, const Motion&, StepReach&) const = 0;
  // The longest step in time that resolves the delays here.
  virtual double longest_step(const Motion&) const = 0;

 protected:
  ~DelaySource() = default;
};

}  // namespace dynalin
