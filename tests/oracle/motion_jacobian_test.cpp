// The Jacobian that integrates motions in time against differences of its own residual: examples, the manual's models
// and generated mechanisms in motion, each as drawn but with velocities of its own on top. What multipliers of drift do
// to it is left out, and they are zero.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/initial.h"
#include "oracle/models.h"
#include "places/draws.h"
#include "simulation/motion_equations.h"

namespace dynalin::oracle::motion_jacobian_test {
namespace {

using Vector = std::vector<double>;

// Consistent on all levels, everything in motion.
Result<OperatingPoint> moving_point(const System& system) {
  Findings findings;
  auto op = initial_conditions(system, findings);
  if (!op) return op;
  op->mode = AnalysisMode::dynamics;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  for (std::size_t k = 0; k < op->velocity.size(); ++k)
    op->velocity[k] += part(random) * system.coordinate_scale(static_cast<std::int32_t>(k));
  return reconcile_velocity(system, std::move(*op), findings).and_then([&](OperatingPoint p) {
    return solve_acceleration(system, std::move(p), findings);
  });
}

// What an unknown is measured in.
Vector units_of(const System& system, const MotionUnknowns& unknowns, const OperatingPoint& op) {
  const Layout& layout = system.layout();
  Vector unit(unknowns.size(), 1.0);
  const auto at = [&](std::int32_t k) -> double& { return unit[static_cast<std::size_t>(k)]; };
  double load = 1e-3;
  for (const double v : op.lambda) load = std::max(load, std::abs(v));
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    for (std::int32_t k = 0; k < std::min(layout.bodies[b].count, 3); ++k)
      at(unknowns.position(b) + k) = system.length();
  }
  for (std::int32_t k = 0; k < layout.coordinate_count; ++k) {
    at(unknowns.velocity(k)) = system.coordinate_scale(k);
    if (k >= layout.body_coordinate_count) at(unknowns.extra(layout.extra_index(k))) = system.coordinate_scale(k);
  }
  for (std::size_t k = 0; k < layout.row_count(); ++k) at(unknowns.lambda(static_cast<std::int32_t>(k))) = load;
  for (std::size_t k = 0; k < op.algebraic.size(); ++k)
    at(unknowns.algebraic(static_cast<std::int32_t>(k))) = std::max(1.0, std::abs(op.algebraic[k]));
  for (std::size_t k = 0; k < op.state.size(); ++k)
    at(unknowns.state(static_cast<std::int32_t>(k))) = std::max(1.0, std::abs(op.state[k]));
  return unit;
}

class Differences {
 public:
  Differences(MotionEquations& equations, const System& system, const OperatingPoint& op)
      : equations_(equations), time_(op.time), y_(equations.size()), yp_(equations.size()) {
    equations.unknowns().pack(op, y_, yp_);
    unit_ = units_of(system, equations.unknowns(), op);
  }

  // Columns in their units, entries in the size of their rows. Where differences are not sharp, as at a kink, entries
  // are counted instead.
  void compare(double c) {
    const std::size_t n = equations_.size();
    const ColumnMatrix* found = equations_.jacobian(time_, c, y_, yp_);
    ASSERT_NE(found, nullptr);
    const ColumnMatrix exact = *found;
    Vector row_size(n, 0.0);
    for_each_entry(exact, [&](std::int32_t r, std::int32_t k, double v) {
      auto& size = row_size[static_cast<std::size_t>(r)];
      size = std::max(size, std::abs(v) * unit_[static_cast<std::size_t>(k)]);
    });
    for (std::size_t k = 0; k < n; ++k) {
      const Vector coarse = extrapolated(k, c, 2e-3), fine = extrapolated(k, c, 1e-3);
      Vector column(n, 0.0);
      for_each_in_column(exact, static_cast<std::int32_t>(k),
                         [&](std::int32_t r, double v) { column[static_cast<std::size_t>(r)] = v * unit_[k]; });
      for (std::size_t r = 0; r < n; ++r) {
        ++entries;
        const double size = row_size[r], off = std::abs(fine[r] - column[r]);
        if (!(std::abs(coarse[r] - fine[r]) <= sharpness * size)) {
          ++blunt;
          continue;
        }
        EXPECT_LE(off, tolerance * size) << "row " << r << " ("
                                         << equations_.unknowns().text(static_cast<std::int64_t>(r)) << "), column "
                                         << equations_.unknowns().text(static_cast<std::int64_t>(k)) << " " << k
                                         << ", c = " << c << ": " << column[r] << ", differences " << fine[r];
      }
    }
  }

  static constexpr double sharpness = 1e-7, tolerance = 2e-7;
  std::size_t entries = 0, blunt = 0;

 private:
  Vector residual(std::size_t k, double c, double step) {
    Vector y = y_, yp = yp_, r(y.size());
    y[k] += step * unit_[k], yp[k] += c * step * unit_[k];
    equations_.residual(time_, y, yp, r);
    return r;
  }
  Vector central(std::size_t k, double c, double step) {
    Vector up = residual(k, c, step);
    const Vector down = residual(k, c, -step);
    for (std::size_t r = 0; r < up.size(); ++r) up[r] = (up[r] - down[r]) / (2 * step);
    return up;
  }
  Vector extrapolated(std::size_t k, double c, double step) {
    const Vector coarse = central(k, c, step);
    Vector fine = central(k, c, step / 2);
    for (std::size_t r = 0; r < fine.size(); ++r) fine[r] += (fine[r] - coarse[r]) / 3;
    return fine;
  }

  MotionEquations& equations_;
  double time_;
  Vector y_, yp_, unit_;
};

struct Tally {
  int models = 0;
  std::size_t entries = 0, blunt = 0;
  std::string where;  // models that have blunt entries
};

void examine(const NamedModel& model, Tally& tally) {
  SCOPED_TRACE(model.name);
  const auto system = system_of(model);
  const auto op = moving_point(*system);
  if (!op) return;
  ConstraintRows rows;
  rows.resize(system->layout());
  system->constraints(system->motion(*op), rows);
  Events events(*system);
  MotionEquations equations(*system, events, *op, system->partition(rows, RowLevel::velocity).active, {});
  Differences differences(equations, *system, *op);
  differences.compare(0);
  differences.compare(20);
  ++tally.models, tally.entries += differences.entries, tally.blunt += differences.blunt;
  if (differences.blunt > 0) tally.where += model.name + ": " + std::to_string(differences.blunt) + "\n";
}

// Few models have no such point, and few entries a kink nearby: shapes in contact overlap by less than differences
// step, and a film at rest about its middle is stiffer by what it moves, either way.
void expect_nearly_all(const Tally& tally, int models) {
  EXPECT_GE(tally.models, models);
  EXPECT_LE(static_cast<double>(tally.blunt), 5e-4 * static_cast<double>(tally.entries)) << tally.where;
}

TEST(MotionJacobian, is_exact_for_shipped_models) {
  Tally tally;
  for (const NamedModel& model : shipped_models()) examine(model, tally);
  expect_nearly_all(tally, 40);
}

TEST(MotionJacobian, is_exact_for_generated_mechanisms) {
  Tally tally;
  const auto seeds = drawn_seeds(1, 50);
  for (const std::uint64_t seed : seeds) examine(generated_model(seed), tally);
  for (std::uint64_t seed = 201; seed <= 206; ++seed) examine(generated_model(seed), tally);
  expect_nearly_all(tally, static_cast<int>(seeds.size()) - 5);
}

}  // namespace
}  // namespace dynalin::oracle::motion_jacobian_test
