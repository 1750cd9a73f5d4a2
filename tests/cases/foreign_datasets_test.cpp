// Whole models as other programs and people write them, in tests/foreign with the commands they are run by: a generator
// of input for rotors, the export of a graphical pre-processor, an old hand. Every number of theirs that a model
// depends on has a part in an answer that is worked out here without the program. Those that take more have files of
// their own, foreign_…_test.cpp.
#include <gmock/gmock.h>

#include <numbers>

#include "cases/foreign.h"
#include "cases/small_vibrations.h"

namespace dynalin::cases::foreign_datasets_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class ForeignDatasets : public Foreign {};

// Ixx, Iyy, Izz, Ixy, Ixz, Iyz with positive product integrals.
Matrix3d inertia(double xx, double yy, double zz, double xy = 0, double xz = 0, double yz = 0) {
  return Matrix3d{{xx, -xy, -xz}, {-xy, yy, -yz}, {-xz, -yz, zz}};
}
Matrix6 diagonal(double x, double y, double z, double ax, double ay, double az) {
  return Vector6(x, y, z, ax, ay, az).asDiagonal();
}
void couple(Matrix6& a, int r, int c, double value) { a(r, c) = a(c, r) = value; }

// Brakes and weight are taken away by commands; what is left is at rest and without load as it is drawn.
TEST_F(ForeignDatasets, wind_turbine) {
  const Matrix3d sections = turned(30, 0, 0), hub_axes = turned(90, 85, 0);
  SmallVibrations turbine;
  int below = SmallVibrations::ground;
  for (int k = 0; k < 10; ++k) {
    const int piece =
        turbine.add_body({0, 0, 1.5 + 3 * k}, 400 - 20 * k, inertia(300 - 10 * k, 310 - 10 * k, 60 - 2 * k));
    Matrix6 K = diagonal(4.0e6 - 2e5 * k, 4.4e6 - 2e5 * k, 5e8, 6e7 - 3e6 * k, 6.6e7 - 3e6 * k, 3e7);
    couple(K, 0, 4, -3e6), couple(K, 1, 3, 3.2e6);
    turbine.add_link(piece, below, {0, 0, 3.0 * k}, sections, K, 0.002 * K);
    below = piece;
  }
  const Vector3d top(0, 0, 30), hub_centre(-1.5, 0, 31.2);
  const int nacelle = turbine.add_body({0.4, 0, 31}, 3000, inertia(2000, 3000, 2500, 10, 20, -30));
  const auto about_z = [](double value) { return diagonal(0, 0, 0, 0, 0, value); };
  turbine.add_hinge(nacelle, below, top, Matrix3d::Identity());
  turbine.add_link(nacelle, below, top, Matrix3d::Identity(), about_z(1e6), about_z(1e3));
  const int hub = turbine.add_body(hub_centre, 1500, hub_axes * inertia(400, 400, 700) * hub_axes.transpose());
  turbine.add_hinge(hub, nacelle, hub_centre, hub_axes);
  turbine.add_link(hub, nacelle, hub_centre, hub_axes, about_z(2e5), about_z(50));
  for (int b = 0; b < 3; ++b) {
    const Matrix3d blade = turned(90, 85, 120 * b);
    int inside = hub;
    for (int j = 0; j < 3; ++j) {
      const auto out = [&](double x) -> Vector3d { return hub_centre + x * blade.col(0); };
      const int piece =
          turbine.add_body(out(1.55 + 2 * j), 90 - 20 * j,
                           blade * inertia(6 - j, 40 - 10 * j, 42 - 10 * j, 0, 0.3 * (j + 1)) * blade.transpose());
      Matrix6 K = diagonal(2e8, 3e6 - 5e5 * j, 1e6 - 2e5 * j, 4e5, 1e6 - 2e5 * j, 3e6 - 5e5 * j);
      couple(K, 1, 5, -4e5), couple(K, 2, 4, 3e5);
      turbine.add_link(piece, inside, out(0.5 + 2 * j), blade, K, 0.001 * K);
      inside = piece;
    }
  }
  const RunResult r = run_foreign("wind_turbine");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_spectrum(last_with(r, "eigenvalues"), SmallVibrations::eigenvalues(turbine.matrices()), 1e-8, 0);
  EXPECT_TRUE(r.wrote("wind_turbine.res"));
}

// In millimetres, kilograms and newtons: forces count a thousandfold. Bushings carry the weight as they are drawn, and
// their loads turn with the body.
TEST_F(ForeignDatasets, car) {
  constexpr double newton = 1000;
  const Matrix3d upright = Matrix3d::Identity(), across = turned(0, 90, 0);
  SmallVibrations car;
  const int body = car.add_body({1170, 0, 560}, 1200, inertia(4.5e8, 1.9e9, 2.1e9, 0, 6e7, 0));
  const int engine = car.add_body({520, 0, 600}, 180, inertia(1.5e7, 9e6, 1.2e7, 1e6, -8e5, 5e5));
  for (const bool rear : {false, true}) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d at(rear ? 2600 : 0, side * (rear ? 750 : 760), 300);
      const int carrier = car.add_body(at, 22, inertia(4e5, 6e5, 4.5e5));
      const int wheel = car.add_body(at, 18, inertia(5e5, 9e5, 5e5));
      const Matrix6 K = rear ? diagonal(3000, 9000, 22, 5e6, 4e6, 6e6) : diagonal(2500, 8000, 25, 5e6, 4e6, 6e6);
      const double load = rear ? 2824.3152 : 3942.2733, weight = 40 * 9.80665;
      car.add_link(carrier, body, at, rear ? turned(180, 0, 0) : upright, newton * K,
                   newton * diagonal(5, 6, rear ? 1.6 : 1.8, 1000, 1000, 1000), {0, 0, -newton * load});
      car.add_link(wheel, SmallVibrations::ground, at, upright, newton * diagonal(300, 180, 210, 0, 0, 0),
                   newton * diagonal(0.1, 0.12, 0.15, 0, 0, 0), {0, 0, newton * (load + weight)});
      car.add_hinge(wheel, carrier, at, across);
    }
  }
  const Vector3d mounts[] = {{300, 200, 650}, {300, -200, 650}, {960, 0, 650}};
  for (int k = 0; k < 3; ++k) {
    car.add_link(engine, body, mounts[k], upright, newton * diagonal(150, 120, 300 + 50 * k, 0, 0, 0),
                 newton * diagonal(0.5, 0.5, 0.8, 0, 0, 0), {0, 0, newton * 588.399});
  }
  const auto expected = car.matrices();

  const RunResult r = run_foreign("car");
  ASSERT_EQ(r.status, 0) << r.err;
  // Drawn in balance, to the digits of its loads.
  for (const auto& b : last_with(r, "iterations").at("operating_point").at("bodies")) {
    if (b.at("element") == "PART/2") {
      EXPECT_NEAR(b.at("position").at(2), 560, 1e-9);
    }
  }
  // Wheels may turn: four pairs of zeros, of which the Schur form of the reference makes ±√ε.
  expect_spectrum(last_with(r, "eigenvalues"), SmallVibrations::eigenvalues(expected), 1e-8, 1e-4);

  const nlohmann::json& states = last_with(r, "A");
  expect_response(
      states, {0.7, 1.3, 8.0, 14.0},
      [&](double hz) {
        return Eigen::MatrixXcd::Constant(
            1, 1,
            newton * car.response(expected, 2 * std::numbers::pi * hz, body, {200, 300, 900}, body, {2600, -400, 660},
                                  Vector3d::UnitZ()));
      },
      1e-9);
}

// The motor turns by 40 degrees a second, 3 turns to 2 of the second shaft; across the joint tan φ₃ = cos 60° tan φ₄.
TEST_F(ForeignDatasets, gear_train) {
  const RunResult r = run_foreign("gear_train");
  ASSERT_EQ(r.status, 0) << r.err;
  const double pi = std::numbers::pi, pitch = 0.02 / (2 * pi), second = 2.0 / 3, slant = second / 0.5,
               rack = second * 0.1;
  // Seen from the motor where the cross is drawn.
  const double mass = 0.2 + 0.3 * second * second + (0.05 + 3 * pitch * pitch) * slant * slant + 2 * rack * rack;
  expect_spectrum(last_with(r, "eigenvalues"),
                  {{0, std::sqrt(10 / mass) / (2 * pi)}, {0, -std::sqrt(10 / mass) / (2 * pi)}}, 1e-10, 0);
  int ends = 0;
  for (const auto& result : r.json.at("results")) {
    if (!result.contains("history")) continue;
    const double time = result.at("operating_point").at("time"), second_turn = second * 40 * pi / 180 * time;
    const double slant_turn = std::atan2(std::sin(second_turn), 0.5 * std::cos(second_turn));
    for (const auto& b : result.at("operating_point").at("bodies")) {
      const auto expect_place = [&](const Vector3d& expected) {
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(b.at("position").at(static_cast<std::size_t>(c)), expected(c), 1e-9) << time;
      };
      if (b.at("element") == "PART/5") expect_place((0.3 - pitch * slant_turn) * turned(90, 60, 0).col(2)), ++ends;
      if (b.at("element") == "PART/6") expect_place({-0.1 * second_turn, 0.1, 0}), ++ends;
    }
  }
  EXPECT_EQ(ends, 4);
  EXPECT_TRUE(r.wrote("gear_train.req"));
}

}  // namespace
}  // namespace dynalin::cases::foreign_datasets_test
