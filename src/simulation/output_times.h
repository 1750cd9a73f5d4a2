// The instants at which a simulation hands out points: start + k Δ up to the end, which is always one of them.
#pragma once

#include <cstdint>
#include <optional>

#include "system/operating_point.h"

namespace dynalin {

class OutputTimes {
 public:
  // `step` may be longer than the whole; the last interval is what is left.
  OutputTimes(double start, double end, double step);
  static OutputTimes of_count(double start, double end, std::int64_t steps);

  double start() const { return start_; }
  double end() const { return end_; }
  double step() const { return step_; }
  std::int64_t count() const { return count_; }  // of intervals
  // More outputs than this are no simulation that anybody waits for, or has a disk for.
  static constexpr std::int64_t most = 100'000'000;
  // Why they cannot be handed out, nothing where they can: more than `most`, or instants that rounding does not tell
  // apart.
  std::optional<Failure> refusal() const;
  // The k-th of 0 … count(), exact at both ends.
  double at(std::int64_t k) const;
  // Where a step of about this length from `now`, which is before the k-th, ends: there if that is no farther, half-way
  // to it if two steps would pass it, so that the last two are equal.
  double next(double now, double step, std::int64_t k) const;

 private:
  double start_, end_, step_;
  std::int64_t count_;
};

}  // namespace dynalin
