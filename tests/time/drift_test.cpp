// What conservative mechanisms lose over many periods, at the ERROR that is there when nothing is stated.
#include "places/draws.h"
#include "time/conservative.h"
#include "time/course.h"

namespace dynalin::in_time::drift_test {
namespace {

struct Bound {
  Conservative (*mechanism)();
  double periods;
  double energy;                      // largest change, as a part of that of the motion
  double position, velocity;          // of constraints between outputs
  std::vector<std::int64_t> momenta;  // VARIABLEs that stay as they are
  double momentum = 0;                // their largest change, as a part of the largest
  double early = 0.2;                 // what of these changes is there after a fifth of the periods
};

void PrintTo(const Bound& b, std::ostream* out) { *out << b.mechanism().name; }

class Drift : public ::testing::TestWithParam<Bound> {};

TEST_P(Drift, over_many_periods_is_small) {
  const Bound& bound = GetParam();
  const Conservative mechanism = bound.mechanism();
  const double periods = draws(1.0, 0.2) * bound.periods, part = draws(1.0, bound.early);
  const Course c = led_through_time(mechanism.dataset, {periods * mechanism.period, 100});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_LE(c.drift(90) / mechanism.energy_unit, part * bound.energy);
  EXPECT_LE(c.position_drift, bound.position);
  EXPECT_LE(c.velocity_drift, bound.velocity);
  double size = 0;
  for (const std::int64_t v : bound.momenta) size = std::max(size, std::abs(c.variables.at(v)[0]));
  for (const std::int64_t v : bound.momenta) EXPECT_LE(c.drift(v), part * bound.momentum * size) << v;
}

// docs/simulation.md, Accuracy, has what was measured. Energy goes steadily, but for the body that tumbles.
const Bound bounds[] = {
    {pendulum, 1000, 4e-3, 1e-12, 1e-12, {}},
    {tumbling_body, 1000, 1e-3, 1e-12, 1e-12, {4, 5, 6}, 1e-2, 0.4},
    {heavy_top, 1000, 1e-3, 1e-12, 1e-12, {4, 5}, 1e-2},
    {spatial_four_bar, 1000, 2e-2, 2e-6, 4e-6, {}},
    {slider_crank, 1000, 1e-2, 2e-6, 4e-6, {}},
    {gyroscope, 1000, 4e-3, 5e-6, 5e-6, {4, 5}, 3e-4},
};

INSTANTIATE_TEST_SUITE_P(Time, Drift, ::testing::ValuesIn(bounds), [](const auto& its) {
  std::string name = its.param.mechanism().name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

}  // namespace
}  // namespace dynalin::in_time::drift_test
