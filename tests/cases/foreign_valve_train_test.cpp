// The camshaft of a side valve engine with its valve and fuel pump, as a program of the eighties wrote it
// (tests/foreign). Curves through stations are splines of their own here, and a contact on them is where a height is
// largest.
#include <gmock/gmock.h>

#include "cases/foreign.h"
#include "cases/newton_euler.h"

namespace dynalin::cases::newton_euler::foreign_valve_train_test {
namespace {

constexpr Real gravity = 386.0886L, consistency = 9.80665L / 0.0254L;

struct PlanePoint {
  Real x, y, dx, dy, ddx, ddy;  // by the parameter
};

// Through stations at equal steps of its parameter, closed, with two continuous derivatives: second derivatives m at
// the stations follow from (m₋ + 4 m + m₊)/6 = p₋ − 2 p + p₊ with steps of one.
class ClosedSpline {
 public:
  template <class Radius>
  ClosedSpline(int n, Radius radius) : p_(n, 2) {
    for (int i = 0; i < n; ++i) {
      const double b = 2 * std::numbers::pi * i / n, r = radius(b);
      p_.row(i) << static_cast<Real>(std::round(1e5 * r * std::cos(b))) / 1e5L,
          static_cast<Real>(std::round(1e5 * r * std::sin(b))) / 1e5L;
    }
    MatX A = MatX::Zero(n, n), b(n, 2);
    for (int i = 0; i < n; ++i) {
      const int before = (i + n - 1) % n, behind = (i + 1) % n;
      A(i, before) += 1, A(i, i) += 4, A(i, behind) += 1;
      b.row(i) = 6 * (p_.row(before) - 2 * p_.row(i) + p_.row(behind));
    }
    m_ = solution(A, b);
  }
  Real turn() const { return static_cast<Real>(p_.rows()); }
  PlanePoint at(Real u) const {
    const Real whole = std::floor(u), s = u - whole, r = 1 - s;
    const auto n = static_cast<long>(p_.rows()), i = ((static_cast<long>(whole) % n) + n) % n, k = (i + 1) % n;
    const auto value = [&](Eigen::Index c, Real& f, Real& d, Real& dd) {
      const Real a = m_(i, c), b = m_(k, c);
      f = r * p_(i, c) + s * p_(k, c) + ((r * r * r - r) * a + (s * s * s - s) * b) / 6;
      d = p_(k, c) - p_(i, c) + ((1 - 3 * r * r) * a + (3 * s * s - 1) * b) / 6;
      dd = r * a + s * b;
    };
    PlanePoint q;
    value(0, q.x, q.dx, q.ddx), value(1, q.y, q.dy, q.ddy);
    return q;
  }

 private:
  MatX p_, m_;
};

PlanePoint rotated(const PlanePoint& p, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y,   s * p.x + c * p.y,     c * p.dx - s * p.dy,
          s * p.dx + c * p.dy, c * p.ddx - s * p.ddy, s * p.ddx + c * p.ddy};
}

// Akima's of 1970: slopes at the points from four neighbouring lines.
class Akima {
 public:
  Akima(Real from, Real step, std::vector<Real> y) : from_(from), step_(step), y_(std::move(y)) {
    const auto n = static_cast<std::ptrdiff_t>(y_.size());
    std::vector<Real> line(static_cast<std::size_t>(n + 3));
    const auto m = [&](std::ptrdiff_t i) -> Real& { return line[static_cast<std::size_t>(i + 2)]; };
    for (std::ptrdiff_t i = 0; i + 1 < n; ++i)
      m(i) = (y_[static_cast<std::size_t>(i + 1)] - y_[static_cast<std::size_t>(i)]) / step;
    m(-1) = 2 * m(0) - m(1), m(-2) = 2 * m(-1) - m(0), m(n - 1) = 2 * m(n - 2) - m(n - 3),
    m(n) = 2 * m(n - 1) - m(n - 2);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const Real right = std::abs(m(i + 1) - m(i)), left = std::abs(m(i - 1) - m(i - 2));
      t_.push_back(right + left == 0 ? (m(i - 1) + m(i)) / 2 : (right * m(i - 1) + left * m(i)) / (right + left));
    }
  }
  Real operator()(Real x) const {
    const auto i = static_cast<std::size_t>(std::floor((x - from_) / step_));
    const Real s = (x - from_) / step_ - static_cast<Real>(i), r = 1 - s;
    return y_.at(i) * r * r * (1 + 2 * s) + y_.at(i + 1) * s * s * (1 + 2 * r) +
           step_ * (t_.at(i) * r * r * s - t_.at(i + 1) * s * s * r);
  }

 private:
  Real from_, step_;
  std::vector<Real> y_, t_;
};

// k gᵉ with a damper that a cubic step brings in.
Real pressure(Real g, Real rate, Real k, Real c, Real full) {
  if (g <= 0) return 0;
  const Real s = std::min(Real(1), g / full);
  return std::max(Real(0), k * std::pow(g, Real(1.5)) + c * s * s * (3 - 2 * s) * rate);
}

class ValveTrain : public Foreign {
 protected:
  enum Coordinate { shaft, valve };
  const ClosedSpline plate{24, [](double b) { return 0.8 + 0.12 * std::cos(b) + 0.03 * std::cos(2 * b); }},
      groove{20, [](double b) { return 0.9 + 0.16 * std::cos(b) + 0.05 * std::sin(2 * b); }};
  const Akima spring{-0.1L, 0.05L, {20, 24, 28.5L, 33.5L, 39, 45.5L, 53, 62, 73}};

  // The face y + 0.15 x² rests on the highest point of the plate cam.
  Real tappet(Real angle) const {
    const auto height = [&](const PlanePoint& p) { return p.y - 0.15L * p.x * p.x; };
    const Real upright = (0.25L - angle / (2 * pi_l)) * plate.turn();  // what is above the shaft's axis
    Real u = upright;
    for (int k = -6; k <= 6; ++k) {
      const Real v = upright + 0.5L * k;
      if (height(rotated(plate.at(v), angle)) > height(rotated(plate.at(u), angle))) u = v;
    }
    PlanePoint p{};
    for (int k = 0; k < 12; ++k) {
      p = rotated(plate.at(u), angle);
      const Real slope = p.dy - 0.3L * p.x * p.dx, bend = p.ddy - 0.3L * (p.x * p.ddx + p.dx * p.dx),
                 way = -slope / bend;
      u += way;
      if (std::abs(way) < 1e-17L) break;
    }
    return height(rotated(plate.at(u), angle));
  }
  // The roller of the pump runs in the groove, 0.1 beside the shaft.
  Real pump(Real angle) const {
    const Real turned = angle + 40 * pi_l / 180;
    Real u = -turned / (2 * pi_l) * groove.turn() + 0.1L;
    PlanePoint p{};
    for (int k = 0; k < 30; ++k) {
      p = rotated(groove.at(u), turned);
      const Real way = -(p.y - 0.1L) / p.dy;
      u += way;
      if (std::abs(way) < 1e-17L) break;
    }
    return rotated(groove.at(u), turned).x;
  }
  Real seat(Real y, Real v) const { return pressure(2.25L - y, -v, 2e4L, 0.8L, 0.02L); }
  Real push(Real y, Real v, Real below, Real rising) const {
    return pressure(below + 1.5L - y, rising - v, 4e4L, 1.2L, 0.01L);
  }
  Real on_valve(Real y, Real v, Real below, Real rising) const {
    return seat(y, v) + push(y, v, below, rising) - spring(y - 2.25L) - 0.05L * v - 0.4L * gravity / consistency;
  }

  // Of the shaft and the valve, with an input that turns the shaft; where the valve is `fixed` it goes with the tappet.
  NewtonEuler free_shaft(bool fixed = false) const {
    NewtonEuler n;
    n.consistency = consistency;
    n.bodies = {{3.2L, products(2.5L, 2.6L, 1.85L) - about_centre()},
                {0.25L, products(1, 1, 1)},
                {0.4L, products(1, 1, 1)},
                {0.6L, products(1, 1, 1)}};
    n.scale = fixed ? VecX{{0.05L}} : VecX{{0.05L, 0.02L}};
    n.time_scale = 1e-3L;
    n.poses = [this, fixed](const VecX& q, Real) {
      const Mat3 R = about(Vec3::UnitZ(), q(shaft)), I = Mat3::Identity();
      const Real below = tappet(q(shaft));
      return std::vector<NewtonEuler::Pose>{{R * Vec3(0.02L, 0.01L, 0.7L), R},
                                            {Vec3(0, below, 0), I},
                                            {Vec3(0, 2.6L + (fixed ? below + 1.498L : q(valve)), 0), I},
                                            {Vec3(pump(q(shaft)), 0.1L, 1.5L), I}};
    };
    n.loads = [this, fixed](const NewtonEuler::State& s, NewtonEuler::Loads& l) {
      for (std::size_t b = 0; b < 4; ++b) l.add(s, b, s.bodies[b].p, Vec3(0, -masses[b] * gravity / consistency, 0));
      l.add(s, 0, Vec3::Zero(), Vec3::Zero(),
            Vec3(0, 0, s.u(0) - 30 * std::sin(s.q(shaft) - 0.35L) - 0.04L * s.rate(shaft)));
      const Real y = s.bodies[2].p.y() - 2.6L, v = s.bodies[2].v.y(), x = s.bodies[3].p.x();
      const Real N = fixed ? 0 : push(y, v, s.bodies[1].p.y(), s.bodies[1].v.y());
      l.add(s, 1, s.bodies[1].p, Vec3(0, -N, 0));
      l.add(s, 2, s.bodies[2].p, Vec3(0, N + seat(y, v) - spring(y - 2.25L) - 0.05L * v, 0));
      l.add(s, 3, s.bodies[3].p, Vec3(-(10 + x * (30 + x * (12 + x * 40))) - 0.02L * s.bodies[3].v.x(), 0, 0));
    };
    return n;
  }
  static constexpr Real masses[] = {3.2L, 0.25L, 0.4L, 0.6L};
  // m (d·d − d dᵀ).
  static Mat3 about_centre() {
    const Vec3 d(0.02L, 0.01L, 0.7L);
    return 3.2L * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  static Real angle(Real t) { return 300 * t + 2000 * t * t; }
  static Real speed(Real t) { return 300 + 4000 * t; }
  // Of the shaft and the valve at the point of a result; whole turns of the shaft do not matter.
  static VecX point(const nlohmann::json& result) {
    const nlohmann::json &a = body_of(result, "PART/2"), &v = body_of(result, "PART/4");
    return VecX{{a.at("angles").at(0).get<double>(), v.at("position").at(1).get<double>(),
                 a.at("angular_velocity").at(2).get<double>(), v.at("velocity").at(1).get<double>()}};
  }
  static MatX valve_alone(const MatX& A) {
    MatX a(2, 2);
    a << A(1, 1), A(1, 3), A(3, 1), A(3, 3);
    return a;
  }
};

TEST_F(ValveTrain, valve_train) {
  const RunResult r = run_foreign("valve_train");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto ways = all_with(r, "history"), modes = all_with(r, "eigenvalues"), matrices = all_with(r, "A");
  ASSERT_EQ(ways.size(), 4u);
  ASSERT_EQ(modes.size(), 5u);
  ASSERT_EQ(matrices.size(), 2u);
  const NewtonEuler both = free_shaft(), one = free_shaft(true);
  const VecX none = VecX::Zero(1), unit = VecX::Ones(1);

  // Driven: places, and what torque the drive gives.
  const nlohmann::json& driven = ways[0]->at("history");
  for (std::size_t k = 0; k < driven.at("times").size(); ++k) {
    const auto value = [&](const char* variable) -> double { return driven.at("variables").at(variable).at(k); };
    const Real t = driven.at("times").at(k).get<double>();
    EXPECT_NEAR(value("7"), static_cast<double>(tappet(angle(t))), 1e-12);
    const VecX x{{angle(t), speed(t)}};
    const Real with = one.rates(x, unit, t)(1), without = one.rates(x, none, t)(1);
    EXPECT_NEAR(value("4"), static_cast<double>((4000 - without) / (with - without)), 1e-6) << t;
  }
  // The valve by itself, from tappet to seat and away, by Runge and Kutta in steps of 4 µs.
  Real t = 0.008L, y = tappet(angle(t)) + 1.498L, v = 0, hit = 0;
  const auto rising = [&](Real at) {
    return speed(at) * first_difference([&](Real d) { return VecX{{tappet(angle(at) + d)}}; }, 0.002L)(0);
  };
  v = rising(t);
  const auto faster = [&](Real at, Real height, Real up) {
    return on_valve(height, up, tappet(angle(at)), rising(at)) * consistency / 0.4L;
  };
  const auto go_to = [&](Real end) {
    const int steps = static_cast<int>(std::ceil((end - t) / 4e-6L));
    const Real h = (end - t) / steps;
    for (int k = 0; k < steps; ++k, t += h) {
      const Real before = seat(y, v);
      const Real a = faster(t, y, v), b = faster(t + h / 2, y + h / 2 * v, v + h / 2 * a),
                 c = faster(t + h / 2, y + h / 2 * (v + h / 2 * a), v + h / 2 * b),
                 d = faster(t + h, y + h * (v + h / 2 * b), v + h * c);
      y += h * (v + h / 6 * (a + b + c)), v += h / 6 * (a + 2 * b + 2 * c + d);
      if (before < 20 && seat(y, v) >= 20) hit = t + h * (20 - before) / (seat(y, v) - before);
    }
    t = end;
  };
  for (std::size_t k = 1; k < 4; ++k) {
    go_to(ways[k]->at("operating_point").at("time").get<double>());
    const VecX there = point(*ways[k]);
    EXPECT_NEAR(static_cast<double>(there(1)), static_cast<double>(y), 1e-6);
    EXPECT_NEAR(static_cast<double>(there(3)), static_cast<double>(v), 1e-3);
    if (k == 1) {
      EXPECT_NEAR(static_cast<double>(y), 2.27, 1e-6);  // the sensor has found this instant
    }
    expect_spectrum(*modes[k - 1], spectrum(valve_alone(both.by_state(both.rates_at(0), there, none))), 1e-8, 0);
  }
  EXPECT_NEAR(ways[3]->at("history").at("variables").at("6").back().get<double>(), static_cast<double>(hit), 1e-8);

  // The shaft is free, first on its way, then at rest.
  const NewtonEuler::Function outputs = [&](const VecX& x, const VecX& u) -> VecX {
    const NewtonEuler::State s = both.at(x, u, 0);
    return VecX{
        {x(1) - 2.25L, push(x(1), x(3), s.bodies[1].p.y(), s.bodies[1].v.y()), both.acceleration(3, x, u, 0).x()}};
  };
  for (const bool rest : {false, true}) {
    const VecX there = point(*modes[rest ? 4 : 3]);
    const MatX A = both.by_state(both.rates_at(0), there, none), B = both.by_input(both.rates_at(0), there, none);
    expect_spectrum(*modes[rest ? 4 : 3], spectrum(A), 1e-7, 0);
    const MatX C = both.by_state(outputs, there, none), D = both.by_input(outputs, there, none);
    expect_response(
        *matrices[rest ? 1 : 0], {0.3, 11.0, 90.0, 420.0}, [&](double hz) { return response(A, B, C, D, hz); }, 1e-6);
    if (rest) {
      const VecX found = both.rest(there, none, 0);
      EXPECT_NEAR(static_cast<double>(found(0)), static_cast<double>(there(0)), 1e-10);
      EXPECT_NEAR(static_cast<double>(found(1)), static_cast<double>(there(1)), 1e-10);
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::newton_euler::foreign_valve_train_test
