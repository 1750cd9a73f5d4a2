#include "simulation/dae_integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dynalin::dae_integrator_test {
namespace {

// Terms as large as b that cancel.
class CancellingTerms : public DaeProblem {
 public:
  CancellingTerms(double b, double allowed) : b_(b), allowed_(allowed) {
    matrix_.rows = matrix_.columns = 2;
    matrix_.start = {0, 2, 4}, matrix_.row = {0, 1, 0, 1};
  }
  std::size_t size() const override { return 2; }
  void weights(double, std::span<const double>, std::span<double> weight) const override {
    weight[0] = 1 / allowed_, weight[1] = 1e-30;
  }
  void terms(std::span<const double>, std::span<const double>, std::span<double> size) const override {
    size[0] = size[1] = 2 * b_;
  }
  std::span<const double> differential() const override { return differential_; }
  std::size_t switch_count() const override { return 0; }
  void switches(double, std::span<const double>, std::span<const double>, std::span<double>) override {}

 protected:
  double b_, allowed_;
  std::array<double, 2> differential_{1, 0};
  ColumnMatrix matrix_;
};

// y′ = b − w and w = b + y: rounding of w is an error of y′.
class RoundedRate final : public CancellingTerms {
 public:
  using CancellingTerms::CancellingTerms;
  bool residual(double, std::span<const double> y, std::span<const double> yp, std::span<double> r) override {
    r[0] = yp[0] - (b_ - y[1]);
    r[1] = y[1] - (b_ + y[0]);
    return true;
  }
  const ColumnMatrix* jacobian(double, double c, std::span<const double>, std::span<const double>) override {
    matrix_.value = {c, -1, 1, 1};
    return &matrix_;
  }
};

// y′ = w and b + y = b + exp(−t): rounding is an error of y, however short a step is.
class RoundedPlace final : public CancellingTerms {
 public:
  using CancellingTerms::CancellingTerms;
  bool residual(double t, std::span<const double> y, std::span<const double> yp, std::span<double> r) override {
    r[0] = yp[0] - y[1];
    r[1] = (b_ + y[0]) - (b_ + std::exp(-t));
    return true;
  }
  const ColumnMatrix* jacobian(double, double c, std::span<const double>, std::span<const double>) override {
    matrix_.value = {c, 1, -1, 0};
    return &matrix_;
  }
};

struct Reached {
  bool ok = true;
  double error = 0;
  std::int64_t steps = 0;
  std::string reason;
  std::int64_t at_its_rounding = -1;
};
Reached led(DaeProblem& problem, std::array<double, 2> y, double loosest) {
  StepBounds bounds;
  bounds.loosest = loosest;
  DaeIntegrator integrator(problem, bounds);
  const std::array yp{-1.0, 0.0};
  integrator.start(0, y, yp);
  Reached r;
  while (r.ok && integrator.time() < 1 && integrator.statistics().steps < 3000)
    r.ok = integrator.step(1) == DaeIntegrator::Outcome::step;
  r.error = std::abs(integrator.y()[0] - std::exp(-integrator.time()));
  r.steps = integrator.statistics().steps;
  r.reason = integrator.reason();
  r.at_its_rounding = integrator.at_its_rounding();
  return r;
}

// 900 000 steps where errors below rounding were asked for.
TEST(DaeIntegrator, asks_for_no_errors_below_what_rounding_leaves) {
  constexpr double large = 1e9, allowed = 1e-13;
  RoundedRate rate(large, allowed);
  const Reached r = led(rate, {1, large + 1}, 1e7);
  EXPECT_TRUE(r.ok) << r.reason;
  EXPECT_LT(r.steps, 500);
  EXPECT_LT(r.error, 5e-7);
  RoundedRate exact(1, allowed);
  EXPECT_LT(led(exact, {1, 2}, 1e5).error, 1e-11);
  RoundedPlace place(large, allowed);
  const Reached p = led(place, {1, -1}, 1e8);
  EXPECT_TRUE(p.ok) << p.reason;
  EXPECT_LT(p.error, 5e-7);
  EXPECT_EQ(r.at_its_rounding, -1);
  EXPECT_EQ(p.at_its_rounding, -1);
}

TEST(DaeIntegrator, says_when_rounding_is_more_than_may_be_allowed) {
  RoundedPlace place(1e9, 1e-13);
  EXPECT_EQ(led(place, {1, -1}, 1e3).at_its_rounding, 0);
}

}  // namespace
}  // namespace dynalin::dae_integrator_test
