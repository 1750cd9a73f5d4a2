// Up to which order of backward differentiation steps are longest. Orders 3 to 5 are unstable beside the imaginary
// axis: where undamped stiff modes are, however little they move, steps shrink to a part of their periods, and order 2
// passes over them (Hairer and Wanner, Solving ordinary differential equations II, V.1). That it does is seen by trial,
// in runs that have long to go.
#pragma once

#include <cstdint>
#include <optional>

namespace dynalin {

class OrderTrial {
 public:
  explicit OrderTrial(int highest) : highest_(highest), order_(highest) {}

  // After a step of that length with so much time ahead: the largest order of those to come, if it is another one.
  std::optional<int> after_step(double length, double ahead);

 private:
  int other() const;

  int highest_, order_;
  bool on_trial_ = false;
  std::int64_t steps_ = 0;  // of the window that lengths are taken in
  double time_ = 0;
  double known_ = 0;  // the mean length of steps before the trial
  std::int64_t since_trial_ = 0, pause_ = 0;
};

}  // namespace dynalin
