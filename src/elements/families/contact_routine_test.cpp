// Friction of a CONTACT by a routine: forces along the slip and across it, and their derivatives from rest on.
#include "elements/families/contact_routine.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace dynalin::contact_routine_test {
namespace {

// By the speed of slip v = XDOT(1), the spin w = XDOT(3) and N = NFORCE: −N (2 v − v³), N v², −N w; or what does not
// vanish at rest.
class Law final : public Routine {
 public:
  explicit Law(double at_rest = 0) : at_rest_(at_rest) {}
  static constexpr std::size_t speed = 8, spin = 10, force = 11;

  double value(const RoutineInputs<double>& in, std::size_t which) const override {
    const double v = in[speed], N = in[force];
    return which == 0 ? at_rest_ - N * (2 * v - v * v * v) : which == 1 ? N * v * v : -N * in[spin];
  }
  std::span<const double> partials(const RoutineInputs<double>& in, std::size_t which) const override {
    const double v = in[speed], N = in[force];
    partials_.assign(in.size(), 0.0);
    partials_[speed] = which == 0 ? -N * (2 - 3 * v * v) : which == 1 ? 2 * N * v : 0;
    partials_[spin] = which == 2 ? -N : 0;
    partials_[force] = which == 0 ? -(2 * v - v * v * v) : which == 1 ? v * v : -in[spin];
    return partials_;
  }
  TimeTaylor<double> value(const RoutineInputs<TimeTaylor<double>>&, std::size_t) const override { return {}; }
  std::span<const TimeTaylor<double>> partials(const RoutineInputs<TimeTaylor<double>>&, std::size_t) const override {
    return {};
  }
  std::string name() const override { return "a law"; }
  std::string reason_of_value(std::span<const double>) const override { return {}; }
  std::string reason_of_partials(std::span<const double>) const override { return {}; }

 private:
  double at_rest_;
  mutable std::vector<double> partials_;
};

using D = Dual<4>;
const Vector normal{0, 0.6, 0.8}, first{1, 0, 0}, second{0, 0.8, -0.6};

// Slip a along the first, b along the second direction, spin and normal force, each a seed.
template <class T>
ContactFriction<T> friction(const Law& law, const std::array<T, 4>& x) {
  const auto as = [](const Vector& v) { return Vec3<T>{T(v.x), T(v.y), T(v.z)}; };
  const ContactSlip<T> slip{as(normal), Vec3<T>(as(first) * x[0] + as(second) * x[1]), x[2], x[3]};
  return called_friction(law, ContactPlace<T>{}, slip, {.time = 0.0, .mode = 4.0});
}
std::array<double, 6> numbers(const Law& law, const std::array<double, 4>& x) {
  const auto f = friction(law, x);
  return {f.force.x, f.force.y, f.force.z, f.torque.x, f.torque.y, f.torque.z};
}

TEST(ContactRoutine, friction_is_along_the_slip_across_it_and_about_the_normal) {
  const auto f = friction<double>(Law(), {0.3, 0.4, 0.7, 5.0});
  const double v = 0.5, along = -5 * (2 * v - v * v * v), aside = 5 * v * v;
  const Vector slip = first * 0.6 + second * 0.8, across = cross(normal, slip);
  EXPECT_LT(norm(f.force - (slip * along + across * aside)), 1e-14);
  EXPECT_LT(norm(f.torque - normal * (-5 * 0.7)), 1e-14);
}

TEST(ContactRoutine, friction_has_its_derivatives_at_every_slip_and_at_rest) {
  for (const std::array<double, 2> slip : {std::array{0.3, 0.4}, {1e-3, -2e-3}, {1e-12, 0.0}, {0.0, 0.0}}) {
    const std::array<double, 4> at = {slip[0], slip[1], 0.7, 5.0};
    std::array<D, 4> seeded;
    for (std::size_t k = 0; k < 4; ++k) seeded[k] = D(at[k], k);
    const auto f = friction<D>(Law(), seeded);
    const std::array<D, 6> found = {f.force.x, f.force.y, f.force.z, f.torque.x, f.torque.y, f.torque.z};
    for (std::size_t k = 0; k < 4; ++k) {
      constexpr double h = 1e-6;
      auto low = at, high = at;
      low[k] -= h, high[k] += h;
      const auto a = numbers(Law(), low), b = numbers(Law(), high);
      for (std::size_t c = 0; c < 6; ++c) {
        // What friction across the slip makes of a square is off by the step at rest.
        EXPECT_NEAR(found[c].partial[k], (b[c] - a[c]) / (2 * h), 2e-5) << slip[0] << " " << k << " " << c;
      }
    }
    const auto plain = numbers(Law(), at);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(found[c].value, plain[c], 1e-12);
  }
}

TEST(ContactRoutine, friction_that_does_not_vanish_at_rest_has_no_direction_there) {
  EXPECT_TRUE(std::isnan(friction<double>(Law(1.0), {0.0, 0.0, 0.0, 5.0}).force.x));
  EXPECT_FALSE(std::isnan(friction<double>(Law(1.0), {0.1, 0.0, 0.0, 5.0}).force.x));
}

}  // namespace
}  // namespace dynalin::contact_routine_test
