// How far one step may go of an integration that evaluates functions at the ends of its steps alone. No control of
// errors sees what a table has between them (a pulse, the bump of a road), but its points are known: they are looked at
// before the step is made.
#pragma once

#include <algorithm>
#include <cmath>

namespace dynalin {

class StepReach {
 public:
  // What may be passed over, as a part of the range of a table.
  explicit StepReach(double tolerance) : tolerance_(tolerance) {}

  double tolerance() const { return tolerance_; }
  double share() const { return share_; }  // of the step, above 0
  void end_at(double share) {
    if (share > 0 && share < share_) share_ = share;
  }

 private:
  double tolerance_, share_ = 1;
};

// A course from x0 to x1, which a step makes: what one expects of it who knows value and slope at x0 and the value at
// x1. A smooth course that is followed in steps of high order is near that.
class ExpectedCourse {
 public:
  ExpectedCourse(double x0, double y0, double slope, double x1, double y1)
      : x0_(x0), y0_(y0), slope_(slope), width_(x1 - x0), bend_(y1 - y0 - slope * (x1 - x0)) {}
  double at(double x) const {
    const double share = (x - x0_) / width_;
    return y0_ + slope_ * (x - x0_) + bend_ * share * share;
  }

 private:
  double x0_, y0_, slope_, width_, bend_;
};

}  // namespace dynalin
