// A system F(t, y, y′) = 0 as what integrates it asks for it, and what bounds the steps of that.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "mechanics/accumulator.h"

namespace dynalin {

// Rows and unknowns may have any units.
class DaeProblem {
 public:
  virtual ~DaeProblem() = default;
  virtual std::size_t size() const = 0;
  // False where something has no finite value: the integrator tries a shorter step.
  virtual bool residual(double t, std::span<const double> y, std::span<const double> yp, std::span<double> r) = 0;
  // ∂F/∂y + c ∂F/∂y′, always of the same pattern; null like above.
  virtual const ColumnMatrix* jacobian(double t, double c, std::span<const double> y, std::span<const double> yp) = 0;
  // Reciprocals of the errors that are allowed in each unknown in a step of this length (0: not known yet); next to
  // nothing for those that no error is asked of.
  virtual void weights(double step, std::span<const double> y, std::span<double> weight) const = 0;
  // Sizes of the terms of each equation as they were evaluated last, which was here: rounding is a part of them.
  virtual void terms(std::span<const double> y, std::span<const double> yp, std::span<double> size) const = 0;
  // 1 where the rate of an unknown counts, 0 for algebraic ones, whose error nobody controls.
  virtual std::span<const double> differential() const = 0;
  // Functions whose zeros end a step.
  virtual std::size_t switch_count() const = 0;
  virtual void switches(double t, std::span<const double> y, std::span<const double> yp, std::span<double> values) = 0;
  // Whether steps may pass over something that is known beforehand, and the part of one that leads from a point to
  // another, which it is expected to reach, that may be made.
  virtual bool looks_ahead() const { return false; }
  struct Instant {
    double t;
    std::span<const double> y, yp;
  };
  virtual double part_to_make(const Instant& /*from*/, const Instant& /*to*/) { return 1; }
};

struct StepBounds {
  std::optional<double> largest, first, least;  // [time]
  int largest_order = 5, iterations = 4;        // of Newton's method in a step
  // How many times the error that is asked for may be allowed in unknowns that rounding leaves no more exact.
  double loosest = 1e3;
};

}  // namespace dynalin
