// Integrates F(t, y, y′) = 0 in time by backward differentiation of orders 1 … 5 with steps of any size, which SUNDIALS
// IDA makes (ida_solver.h); nothing of it is seen from outside. Here is the course of the steps: the first one, those
// that end early, those that lead nowhere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "simulation/dae_problem.h"
#include "simulation/simulation_step.h"

namespace dynalin {

class DaeIntegrator {
 public:
  DaeIntegrator(DaeProblem&, const StepBounds&);
  ~DaeIntegrator();
  DaeIntegrator(const DaeIntegrator&) = delete;
  DaeIntegrator& operator=(const DaeIntegrator&) = delete;

  // From a consistent point, where nothing is known of the past. `first_step` goes before that of the bounds.
  void start(double t, std::span<const double> y, std::span<const double> yp, std::optional<double> first_step = {});

  // Of the steps from here on.
  void limit_steps(double longest);
  enum class Outcome : std::uint8_t { step, event, failed };
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
  struct Course;
  std::unique_ptr<Course> course_;
};

}  // namespace dynalin
