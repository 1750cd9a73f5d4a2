// The tower crane of tests/foreign in fourteen coordinates: its bodies, loads and controllers, worked out from the text
// of the dataset. What moves along with a velocity constraint is found by its multiplier.
#pragma once

#include <array>

#include "cases/newton_euler.h"

namespace dynalin::cases::newton_euler::foreign_crane {

using Frame = NewtonEuler::Point;

inline constexpr Real gravity = 981, kilonewton = 1e5L, height = 4000;
enum Coordinate {
  lean_x,
  lean_y,
  twist,
  slew,
  trolley,
  winch,
  hoist,
  motor,
  hook_at,
  panel_turn = 11,
  coordinates = 14
};
enum Bodies { head, jib, carriage, winch_drum, second_drum, hoist_drum, hoist_motor, hook, panel };
enum Controller { slewing_error, current, gust, trolley_error, filtered, controllers };
inline constexpr std::array masses = {3000.0L, 9500.0L, 650.0L, 60.0L, 60.0L, 400.0L, 150.0L, 150.0L, 2000.0L};

// y + a y³ = right.
inline Real cubic(Real slope, Real a, Real right) {
  Real y = 0;
  for (int k = 0; k < 60; ++k) y -= (slope * y + a * y * y * y - right) / (slope + 3 * a * y * y);
  return y;
}

// x holds the coordinates, their rates (with the friction gear all but that of the drum, which follows from the
// motor's), and the states of the controllers.
class Crane {
 public:
  bool geared = true, at_work = false;

  Crane() {
    n_.consistency = kilonewton;
    n_.states = controllers;
    // As long as they may be: the motor is fast, and second differences in time lose digits with short steps.
    n_.scale = VecX{{50, 50, 1, 1, 20, 2, 2, 4, 50, 50, 50, 1, 1, 1}};
    const Mat3 aslant = about(Vec3::UnitZ(), pi_l / 6);
    const std::array inertias = {products(3.1e7L, 2.9e7L, 2.2e7L, 1e6L, -2e6L, 3e6L),
                                 products(9e8L, 2.4e10L, 2.45e10L, 1e8L, -9e8L, 2e7L),
                                 products(3e6L, 4e6L, 5e6L),
                                 products(4e5L, 6e5L, 4e5L),
                                 products(3e5L, 4.5e5L, 3e5L),
                                 products(9e4L, 1.2e5L, 9e4L),
                                 products(7e3L, 7e3L, 8e3L),
                                 Mat3(Mat3::Zero()),
                                 Mat3(aslant * products(1.7e7L, 9e6L, 1.1e7L, 4e5L, -3e5L, 2e5L) * aslant.transpose())};
    for (std::size_t b = 0; b < masses.size(); ++b) n_.bodies.push_back({masses[b], inertias[b]});
    n_.poses = [this](const VecX& q, Real) { return poses(q); };
    n_.loads = [this](const NewtonEuler::State& s, NewtonEuler::Loads& l) { loads(s, l); };
  }
  Crane(const Crane&) = delete;
  Crane& operator=(const Crane&) = delete;

  static constexpr Eigen::Index left_out = coordinates + hoist;
  static Real ratio(Real out) { return 0.9L + 4e-4L * out; }
  // With the rate of the drum, and without.
  VecX whole(const VecX& x) const {
    if (!geared) return x;
    VecX all(x.size() + 1);
    const Real drum = ratio(x(trolley)) * x(coordinates + motor - 1) / 25;
    all << x.head(left_out), drum, x.tail(x.size() - left_out);
    return all;
  }
  VecX reduced(const VecX& all) const {
    if (!geared) return all;
    VecX x(all.size() - 1);
    x << all.head(left_out), all.tail(all.size() - left_out - 1);
    return x;
  }
  // What the friction gear presses with, 25 θ″ − r ψ″ − r′ ψ′ = 0, and all rates with it.
  struct Moving {
    VecX inputs, rates;
  };
  Moving moving(const VecX& x, const VecX& u, Real t) const {
    const VecX all = whole(x);
    VecX v(4), by_one(4);
    v << u, 0;
    if (!geared) return {v, n_.rates(all, v, t)};
    by_one << u, 1;
    const std::vector<VecX> at_both = n_.rates(all, std::vector{v, by_one}, t);
    const VecX &free = at_both[0], pressed = at_both[1] - free;
    const Real r = ratio(all(trolley)), carried = 4e-4L * all(coordinates + trolley) * all(coordinates + motor);
    const auto slip = [&](const VecX& by) { return 25 * by(coordinates + hoist) - r * by(coordinates + motor); };
    v(3) = (carried - slip(free)) / slip(pressed);
    return {v, free + v(3) * pressed};
  }
  VecX rates(const VecX& x, const VecX& u, Real t) const { return reduced(moving(x, u, t).rates); }
  VecX outputs(const VecX& x, const VecX& u, Real t) const {
    const NewtonEuler::State s = state(x, t);
    const VecX v = moving(x, u, t).inputs;
    const Frame& c = s.bodies[carriage];
    const Vec3 blown = wind_at(s);
    return VecX{{(c.R.transpose() * (blown - carriage_origin(s)))(0), blown(1), std::abs(rope(s).pushes),
                 n_.acceleration(panel, whole(x), v, t).z(), s.rate(hoist)}};
  }
  Vec3 panel_acceleration(const VecX& x, Real t) const {
    return n_.acceleration(panel, whole(x), moving(x, VecX::Zero(3), t).inputs, t);
  }
  NewtonEuler::State state(const VecX& x, Real t) const { return n_.at(whole(x), VecX::Zero(4), t); }
  VecX rest(const VecX& x, Real t) const { return n_.rest(x, VecX::Zero(4), t); }

  using Function = VecX (Crane::*)(const VecX&, const VecX&, Real) const;
  MatX by_state(Function f, const VecX& x, Real t) const {
    const VecX none = VecX::Zero(3);
    const VecX all = VecX::Ones(controllers);
    VecX scales(2 * coordinates + controllers);
    scales << n_.scale, n_.scale, all;
    scales = reduced(scales);
    MatX a((this->*f)(x, none, t).size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      a.col(k) = first_difference([&](Real d) -> VecX { return (this->*f)(x + d * VecX::Unit(x.size(), k), none, t); },
                                  0.01L * scales(k));
    }
    return a;
  }
  MatX by_input(Function f, const VecX& x, Real t) const {
    MatX b((this->*f)(x, VecX::Zero(3), t).size(), 3);
    for (Eigen::Index k = 0; k < 3; ++k)
      b.col(k) = first_difference([&](Real d) -> VecX { return (this->*f)(x, d * VecX::Unit(3, k), t); }, 0.01L);
    return b;
  }
  // Wind on the panel.
  static Vec3 wind(const NewtonEuler::State& s) {
    const Vec3 v = s.bodies[panel].speed(wind_arm) - Vec3(s.z(gust), 0, 0);
    return -v.norm() * Vec3(1.5e-6L * v.x(), 1.5e-6L * v.y(), 0.6e-6L * v.z());
  }
  static Vec3 wind_at(const NewtonEuler::State& s) { return s.bodies[panel].of(wind_arm); }
  // On the panel, from the jib: the trolley sees its place, and the one rate as the trolley itself does.
  static Vec3 tag_line(const NewtonEuler::State& s) {
    const Frame& c = s.bodies[carriage];
    const Vec3 beside = wind_at(s) - carriage_origin(s), drift = s.bodies[panel].speed(wind_arm) - c.speed(origin_arm),
               at = c.R.transpose() * beside, along = c.R.transpose() * (drift - c.w.cross(beside)),
               across = c.R.transpose() * drift;
    return c.R * Vec3(-0.004L * at.x() - 0.002L * along.x(), -0.006L * (at.y() + 40) - 0.003L * across.y(), 0);
  }
  struct Rope {
    Vec3 along;  // from trolley to hook
    Real pushes;
  };
  static Rope rope(const NewtonEuler::State& s) {
    const Frame& c = s.bodies[carriage];
    const Vec3 way = s.bodies[hook].p - c.of(rope_arm), along = way.normalized();
    const Real apart = along.dot(s.bodies[hook].v - c.speed(rope_arm)), out = 1500 - 25 * s.q(hoist),
               strain = way.norm() / out - 1;
    return {along, -(1.2e4L * strain * (1 + 30 * strain) + 0.05L * (apart + 25 * s.rate(hoist)))};
  }
  static Vec3 carriage_origin(const NewtonEuler::State& s) { return s.bodies[carriage].of(origin_arm); }

 private:
  // From the mass centres.
  inline static const Vec3 wind_arm{-5, -37, 10}, rope_arm{-3, 0, -10}, origin_arm{-3, 0, 20};
  NewtonEuler n_;

  // Of projected angles: ATAN2(−z₂, z₃), ATAN2(z₁, z₃), ATAN2(x₂, x₁).
  static Mat3 projected(Real a, Real b, Real turned) {
    const Vec3 z = Vec3(std::tan(b), -std::tan(a), 1).normalized();
    const Real c = std::cos(turned), s = std::sin(turned);
    Mat3 R;
    R.col(0) = Vec3(c, s, -(z.x() * c + z.y() * s) / z.z()).normalized();
    R.col(1) = z.cross(R.col(0)), R.col(2) = z;
    return R;
  }
  static Vec3 top(const VecX& q) {
    return Vec3(q(lean_x), q(lean_y), -0.6L * (q(lean_x) * q(lean_x) + q(lean_y) * q(lean_y)) / height);
  }
  std::vector<NewtonEuler::Pose> poses(const VecX& q) const {
    const Mat3 tower = projected(-1.5L * q(lean_y) / height, 1.5L * q(lean_x) / height, q(twist)),
               R = tower * about(Vec3::UnitZ(), q(slew));
    const Vec3 ring = top(q) + 80 * tower.col(2), hangs = q.segment<3>(hook_at);
    const Mat3 hung = projected(q(panel_turn), q(panel_turn + 1), q(panel_turn + 2));
    const auto on_jib = [&](const Vec3& at, const Mat3& turned = Mat3::Identity()) {
      return NewtonEuler::Pose{ring + R * at, R * turned};
    };
    const auto rolled = [](Real angle) { return about(Vec3::UnitY(), angle); };
    return {{top(q) + tower * Vec3(4, 2, -60), tower},
            on_jib(Vec3(150, 0, 120)),
            on_jib(Vec3(1803 + q(trolley), 0, -80)),
            on_jib(Vec3(2600, 0, 40), rolled(q(winch))),
            on_jib(Vec3(150, 0, 40), rolled((q(trolley) - 10 * q(winch)) / 9)),
            on_jib(Vec3(-300, 0, 100), rolled(q(hoist))),
            on_jib(Vec3(-400, 0, 90), euler(180, 90, 0) * about(Vec3::UnitZ(), q(motor))),
            {hangs, Mat3::Identity()},
            {hangs + hung * Vec3(5, -3, -120), hung}};
  }
  void loads(const NewtonEuler::State& s, NewtonEuler::Loads& l) const {
    for (std::size_t b = 0; b < masses.size(); ++b)
      l.add(s, b, s.bodies[b].p, Vec3(0, 0, -masses[b] * gravity / kilonewton));
    const Real since = s.time - 2, square = at_work ? since * since : 0;
    const Real slew_to = 0.03L * square + s.u(1), trolley_to = -25 * square, motor_to = 10 * square + s.u(2);

    const Frame& t = s.bodies[head];
    const Vec3 point(-4, -2, 60), at = t.of(point), v = t.speed(point);
    l.add(s, head, at,
          Vec3(-2.1L * at.x() - 0.15L * at.y() - 0.025L * v.x(), -0.15L * at.x() - 1.9L * at.y() - 0.022L * v.y(), 0),
          Vec3(0, 0, -1.4e6L * s.q(twist) - 2.5e4L * t.w.z()));
    const Vec3 drive = 6e3L * s.z(current) * t.R.col(2);
    l.add(s, jib, s.bodies[jib].p, Vec3::Zero(), drive), l.add(s, head, t.p, Vec3::Zero(), -drive);
    const Real error = slew_to - s.q(slew);
    l.rates(slewing_error) = error;
    l.rates(current) = (25 * error + 1.5L * s.z(slewing_error) - 60 * s.rate(slew) - 1.2L * s.z(current)) / 0.4L;

    const Real missing = trolley_to - s.q(trolley), speed = s.rate(trolley);
    l.rates(trolley_error) = missing, l.rates(filtered) = 8 * (speed - s.z(filtered));
    l.along(winch) += 1.5L * missing + 0.3L * s.z(trolley_error) - 1.4L * s.z(filtered) - 6 * s.rate(winch);
    const Real turn = (s.q(trolley) - 10 * s.q(winch)) / 9, turning = (speed - 10 * s.rate(winch)) / 9,
               held = -500 * turn - 40 * turning;
    l.along(trolley) += held / 9, l.along(winch) -= held * 10 / 9;

    const Rope r = rope(s);
    const Vec3 pull = r.pushes * r.along;
    l.add(s, hook, s.bodies[hook].p, pull);
    l.add(s, carriage, s.bodies[carriage].of(rope_arm), -pull);
    l.along(hoist) -= 25 * std::abs(r.pushes);
    l.along(motor) -= 20 * (s.q(motor) - motor_to) + 1.5L * s.rate(motor);
    if (geared)
      l.along(hoist) += 25 * s.u(3), l.along(motor) -= ratio(s.q(trolley)) * s.u(3);
    else
      l.along(hoist) -= 9000 * s.q(hoist) + 400 * s.rate(hoist);

    l.rates(gust) = cubic(0.7L, 2e-6L, 500 - s.z(gust));
    l.add(s, panel, wind_at(s), wind(s) + Vec3(0, s.u(0), 0));
    const Mat3& axes = s.bodies[carriage].R;
    const Vec3 line = tag_line(s);
    l.add(s, panel, wind_at(s), line), l.add(s, jib, wind_at(s), -line);
    const Mat3 seen = axes.transpose() * s.bodies[panel].R;
    const Vec3 spin = axes.transpose() * (s.bodies[panel].w - s.bodies[carriage].w);
    const Real wound = cubic(1, 0.8L, std::atan2(seen(1, 0), seen(0, 0)));
    const Vec3 torque = axes * Vec3(-60 * spin.x(), -45 * spin.y(), -300 * wound - 30 * spin.z());
    l.add(s, panel, s.bodies[panel].p, Vec3::Zero(), torque);
    l.add(s, carriage, s.bodies[carriage].p, Vec3::Zero(), -torque);
  }
};

}  // namespace dynalin::cases::newton_euler::foreign_crane
