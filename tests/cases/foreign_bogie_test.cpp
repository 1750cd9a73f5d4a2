// A motor bogie at constant speed (tests/foreign): rotors that spin, one by gears and one by a belt, creep between
// wheel and rail, a damper that rubs. What moves is steady, and so the modes do not depend on coordinates.
#include <gmock/gmock.h>

#include "cases/foreign.h"
#include "cases/newton_euler.h"

namespace dynalin::cases::newton_euler::foreign_bogie_test {
namespace {

using Frame = NewtonEuler::Point;

class Bogie : public Foreign {
 protected:
  enum Bodies { frame, wheels_ahead, wheels_behind, box_ahead, box_behind, motor, generator, bolster, damper };
  enum Coordinate { frame_at, box_at = 6, spin = 18, bolster_at = 20, damper_at = 26, coordinates };
  static Vec6 row(Real a, Real b, Real c, Real d, Real e, Real f) {
    Vec6 v;
    v << a, b, c, d, e, f;
    return v;
  }

  static NewtonEuler model(Real speed, bool rubbing) {
    NewtonEuler n;
    n.scale = VecX::Constant(coordinates, 0.2L);
    n.bodies = {{3.2L, products(2.1L, 3.4L, 4.9L, 0.08L, -0.11L, 0.05L)},
                {1.5L, products(0.9L, 0.12L, 0.9L)},
                {1.5L, products(0.9L, 0.12L, 0.9L)},
                {0.35L, products(0.12L, 0.05L, 0.11L)},
                {0.35L, products(0.12L, 0.05L, 0.11L)},
                {0.8L, products(0.04L, 0.03L, 0.04L)},
                {0.1L, products(0.004L, 0.006L, 0.004L)},
                {12, products(15, 38, 36)},
                {0.05L, products(0.001L, 0.001L, 0.001L)}};
    n.poses = [](const VecX& q, Real) {
      const auto loose = [&](Eigen::Index k, const Vec3& drawn) {
        return NewtonEuler::Pose{drawn + q.segment<3>(k), exponential(q.segment<3>(k + 3))};
      };
      const auto turned = [](const NewtonEuler::Pose& on, const Vec3& at, Real angle) {
        return NewtonEuler::Pose{on.p + on.R * at, on.R * about(Vec3::UnitY(), angle)};
      };
      const auto ahead = loose(box_at, Vec3(1.25L, 0, 0.45L)), behind = loose(box_at + 6, Vec3(-1.25L, 0, 0.45L)),
                 carried = loose(bolster_at, Vec3(0, 0, 1.5L));
      std::vector<NewtonEuler::Pose> at;
      at.push_back(loose(frame_at, Vec3(0, 0, 0.6L)));
      at.push_back(turned(ahead, Vec3::Zero(), q(spin))), at.push_back(turned(behind, Vec3::Zero(), q(spin + 1)));
      at.push_back(ahead), at.push_back(behind);
      // The pitch point divides 0.6 into 0.4 and 0.2; the belt goes from 1 to 2.5.
      at.push_back(turned(ahead, Vec3(-0.6L, 0, 0.05L), -2 * q(spin)));
      at.push_back(turned(behind, Vec3(0, 0, 0.2L), 2.5L * q(spin + 1)));
      at.push_back(carried);
      at.push_back(turned(carried, Vec3(1.1L, 0, -0.5L + q(damper_at)), 0));
      return at;
    };
    n.loads = [speed, rubbing, bodies = n.bodies](const NewtonEuler::State& s, NewtonEuler::Loads& l) {
      for (std::size_t b = 0; b < bodies.size(); ++b) l.add(s, b, s.bodies[b].p, Vec3(0, 0, -bodies[b].mass * 9.8L));
      const auto rubber = [&](std::size_t i, const Vec3& in_i, std::size_t j, const Vec3& in_j, const Vec6& k,
                              const Vec6& c, const Vec6& load) {
        const Frame I = marker(s.bodies[i], in_i), J = marker(s.bodies[j], in_j);
        const Relative r = relative(I, J);
        l.press(s, i, I, j, J, load - k.cwiseProduct(r.at) - c.cwiseProduct(r.rate));
      };
      const Vec6 k = row(9000, 4500, 1300, 300, 20, 250), c = row(40, 30, 25, 2, 1, 2);
      rubber(frame, Vec3(1.25L, 0, -0.15L), box_ahead, Vec3::Zero(), k, c, row(0, 0, 73.059L, 0, -4.704L, 0));
      rubber(frame, Vec3(-1.25L, 0, -0.15L), box_behind, Vec3::Zero(), k, c, row(0, 0, 76.391L, 0, 0, 0));
      rubber(bolster, Vec3(0, 0, -0.6L), frame, Vec3(0, 0, 0.3L), row(350, 300, 800, 400, 900, 60),
             row(20, 25, 40, 8, 10, 4), row(-5, -2, 117.6L, 0.2L, -0.5L, -2.2L));
      rubber(damper, Vec3::Zero(), frame, Vec3(1.1L, 0, 0.4L), row(500, 400, 1500, 5, 5, 5),
             row(1, 1, 2, 0.1L, 0.1L, 0.1L), row(5, 2, 0.49L, 0, 0, 0));
      // Through rest friction is a damper: a cubic of slope 3/2 to 0.04. Its guide bears what presses, √29.
      if (rubbing) l.along(damper_at) -= 1.5L / 0.04L * (0.25L * std::sqrt(29.0L) + 0.8L) * s.rate(damper_at);
      const Real f11 = 7600, f22 = 6900, half = 0.75L, cone = 0.15L, radius = 0.45L;
      for (const bool behind : {false, true}) {
        const std::size_t b = behind ? wheels_behind : wheels_ahead;
        const Frame &w = s.bodies[b], &box = s.bodies[behind ? box_behind : box_ahead];
        const Real slip = (speed + w.v.x() - radius * w.w.y()) / speed, yaw = std::atan2(box.R(1, 0), box.R(0, 0)),
                   roll = std::atan2(-box.R(1, 2), box.R(2, 2));
        l.add(s, b, w.p,
              Vec3(-f11 * slip, -f22 * (w.v.y() / speed - yaw) - 900 * w.p.y(),
                   (behind ? 95.501L : 99.029L) - 52000 * (w.p.z() - radius) - 60 * w.v.z()),
              Vec3(-30000 * roll - 30 * w.w.x(), radius * f11 * slip,
                   -f11 * half * (cone * w.p.y() / radius + half * w.w.z() / speed)));
      }
      // The input turns the motor against its box.
      const Vec3 drive = s.u(0) * s.bodies[box_ahead].R.col(1);
      l.add(s, motor, s.bodies[motor].p, Vec3::Zero(), drive),
          l.add(s, box_ahead, s.bodies[motor].p, Vec3::Zero(), -drive);
    };
    return n;
  }
  static VecX running(Real speed) {
    VecX x = VecX::Zero(2 * coordinates);
    x(coordinates + spin) = x(coordinates + spin + 1) = speed / 0.45L;
    return x;
  }
};

TEST_F(Bogie, bogie) {
  const RunResult r = run_foreign("bogie");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto modes = all_with(r, "eigenvalues");
  ASSERT_EQ(modes.size(), 2u);
  const VecX none = VecX::Zero(1);
  for (const bool fast : {false, true}) {
    const Real speed = fast ? 27 : 18;
    const NewtonEuler n = model(speed, !fast);
    const VecX x = running(speed);
    EXPECT_LE(n.rates(x, none, 0).tail(coordinates).norm(), 1e-10L);  // drawn in balance
    const MatX A = n.by_state(n.rates_at(0), x, none);
    expect_spectrum(*modes[fast ? 1 : 0], spectrum(A), 1e-8, 1e-4);
    if (fast) continue;
    // How far the leading wheels go aside, and how fast the generator turns in its box.
    MatX C = MatX::Zero(2, 2 * coordinates);
    C(0, box_at + 1) = 1, C(1, coordinates + spin + 1) = 2.5L;
    const MatX B = n.by_input(n.rates_at(0), x, none);
    expect_response(
        last_with(r, "A"), {0.2, 1.1, 4.0, 15.0}, [&](double hz) { return response(A, B, C, MatX::Zero(2, 1), hz); },
        1e-7);
  }
  EXPECT_TRUE(r.wrote("bogie.res"));
}

}  // namespace
}  // namespace dynalin::cases::newton_euler::foreign_bogie_test
