// Integrates F(t, y, y′) = 0 in time: SUNDIALS IDA, backward differentiation of orders 1 … 5 with steps of any size,
// its linear systems solved by StepFactors. Nothing of IDA is seen from outside.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "mechanics/accumulator.h"
#include "simulation/simulation_step.h"

namespace dynalin {

// The system as the integrator asks for it. Rows and unknowns may have any units.
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

class DaeIntegrator {
 public:
  DaeIntegrator(DaeProblem&, const StepBounds&);
  ~DaeIntegrator();
  DaeIntegrator(const DaeIntegrator&) = delete;
  DaeIntegrator& operator=(const DaeIntegrator&) = delete;

  // From a consistent point, where nothing is known of the past. `first_step` goes before that of the bounds.
  void start(double t, std::span<const double> y, std::span<const double> yp, std::optional<double> first_step = {});

  enum class Outcome : std::uint8_t { step, event, failed };
  // Of the steps from here on.
  void limit_steps(double longest);
  // One step, which does not go beyond `latest`, or up to the first zero of a switch in it.
  Outcome step(double latest);

  double time() const;
  std::span<const double> y() const;
  std::span<const double> yp() const;
  // Values and rates at an instant of the last step.
  void interpolate(double t, std::span<double> y, std::span<double> yp) const;
  // Of each switch, the sign of its rate where it has met zero, else 0.
  std::span<const int> crossed() const;
  // Why the last step failed, in a few words, and the unknown whose error or correction stood in the way most; −1:
  // none.
  const std::string& reason() const;
  std::int64_t hardest_unknown() const;
  // The unknown of which rounding leaves more than the error that is allowed of it, −1: none. Steps become shorter for
  // its sake, if that helps, or fail.
  std::int64_t at_its_rounding() const;
  IntegrationStatistics statistics() const;  // since it was made

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dynalin
