// Rigid bodies and mass points whose places are functions of a few coordinates: their motion by Newton and Euler for
// each body, projected on what the coordinates move (d'Alembert), and its linear model. Everything but the places and
// the loads comes of differences of eighth order in long double: an answer for datasets which shares nothing with the
// program.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace dynalin::cases::newton_euler {

using Real = long double;
using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Mat3 = Eigen::Matrix<Real, 3, 3>;
using VecX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Vec6 = Eigen::Matrix<Real, 6, 1>;
using MatX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

inline constexpr Real pi_l = std::numbers::pi_v<Real>;

inline Mat3 about(const Vec3& axis, Real angle) { return Eigen::AngleAxis<Real>(angle, axis).toRotationMatrix(); }
// Of 3-1-3 angles in degrees: its columns are the turned axes.
inline Mat3 euler(Real psi, Real theta, Real phi) {
  const Real d = pi_l / 180;
  return about(Vec3::UnitZ(), psi * d) * about(Vec3::UnitX(), theta * d) * about(Vec3::UnitZ(), phi * d);
}
inline Mat3 exponential(const Vec3& v) {
  return v.norm() == 0 ? Mat3(Mat3::Identity()) : about(v.normalized(), v.norm());
}
inline Vec3 axial(const Mat3& a) {  // of its skew part
  return Vec3(a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1)) / 2;
}
inline Mat3 products(Real xx, Real yy, Real zz, Real xy = 0, Real xz = 0, Real yz = 0) {
  return Mat3{{xx, -xy, -xz}, {-xy, yy, -yz}, {-xz, -yz, zz}};
}

// Of eighth order at 1 to 4 steps to either side.
template <class F>
auto first_difference(F f, Real h) {
  const auto pair = [&](int k) { return (f(k * h) - f(-k * h)).eval(); };
  return ((pair(1) * (Real(4) / 5) - pair(2) / 5 + pair(3) * (Real(4) / 105) - pair(4) / 280) / h).eval();
}
// The first and the second one.
template <class Value, class F>
std::pair<Value, Value> both_differences(F f, Real h) {
  constexpr std::array<Real, 4> odd = {Real(4) / 5, Real(-1) / 5, Real(4) / 105, Real(-1) / 280},
                                even = {Real(8) / 5, Real(-1) / 5, Real(8) / 315, Real(-1) / 560};
  Value second = f(0) * (Real(-205) / 72), first = 0 * second;
  for (std::size_t k = 0; k < 4; ++k) {
    const Real s = static_cast<Real>(k + 1) * h;
    const Value up = f(s), down = f(-s);
    first += odd[k] * (up - down), second += even[k] * (up + down);
  }
  return {first / h, second / (h * h)};
}

class NewtonEuler {
 public:
  struct Body {
    Real mass;
    Mat3 inertia;  // about the mass centre, in the axes that turn
  };
  struct Pose {
    Vec3 p;  // of the mass centre
    Mat3 R;
  };
  struct Point : Pose {
    Vec3 v, w;
    Vec3 of(const Vec3& local) const { return p + R * local; }
    Vec3 speed(const Vec3& local) const { return v + w.cross(R * local); }
  };
  // x = (q, q', z) with controllers' states z, inputs u.
  struct State {
    VecX q, rate, z, u;
    Real time;
    std::vector<Point> bodies;
  };
  class Loads {
   public:
    Loads(std::size_t bodies, Eigen::Index coordinates, Eigen::Index states)
        : along(VecX::Zero(coordinates)), rates(VecX::Zero(states)), wrench_(bodies, Vec6::Zero()) {}
    VecX along, rates;  // generalized forces by coordinate, z'
    void add(const State& s, std::size_t body, const Vec3& at, const Vec3& force, const Vec3& torque = Vec3::Zero()) {
      wrench_[body].head<3>() += force;
      wrench_[body].tail<3>() += torque + (at - s.bodies[body].p).cross(force);
    }
    // Force and torque in the axes of J on body i, at the point of I; the opposite there on body j.
    void press(const State& s, std::size_t i, const Point& I, std::size_t j, const Point& J, const Vec6& f) {
      const Vec3 force = J.R * f.head<3>(), torque = J.R * f.tail<3>();
      add(s, i, I.p, force, torque), add(s, j, I.p, -force, -torque);
    }

   private:
    friend class NewtonEuler;
    std::vector<Vec6> wrench_;
  };

  Real consistency = 1;  // force times this is mass times acceleration
  VecX scale;            // of what each coordinate may be moved by to difference: a hundredth of it
  Real time_scale = 1;
  Eigen::Index states = 0;
  std::vector<Body> bodies;
  std::function<std::vector<Pose>(const VecX& q, Real time)> poses;
  std::function<void(const State&, Loads&)> loads;

  Eigen::Index size() const { return scale.size(); }

  State at(const VecX& x, const VecX& u, Real time) const {
    return at(x, u, time, along(x.head(size()), x.segment(size(), size()), 1, time));
  }
  // x'.
  VecX rates(const VecX& x, const VecX& u, Real time) const { return rates(x, std::vector{u}, time).front(); }
  // For each of several inputs.
  std::vector<VecX> rates(const VecX& x, const std::vector<VecX>& inputs, Real time) const {
    const Eigen::Index n = size();
    const Moved ahead = along(x.head(n), x.segment(n, n), 1, time);
    State s = at(x, inputs.front(), time, ahead);
    std::vector<Moved> ways;
    for (Eigen::Index k = 0; k < n; ++k) ways.push_back(along(s.q, VecX::Unit(n, k), 0, time));
    MatX M = MatX::Zero(n, n);
    VecX inertial = VecX::Zero(n);
    std::vector<Columns> moves(bodies.size(), Columns(3, n)), turns = moves;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Point& p = s.bodies[b];
      const auto column = static_cast<Eigen::Index>(4 * b);
      for (Eigen::Index k = 0; k < n; ++k) {
        const Columns& way = ways[static_cast<std::size_t>(k)].first;
        moves[b].col(k) = way.col(column), turns[b].col(k) = axial(block(way, b) * p.R.transpose());
      }
      const Mat3 J = p.R * bodies[b].inertia * p.R.transpose() / consistency;
      const Real m = bodies[b].mass / consistency;
      // What accelerates with the second rates of the coordinates at zero: R'' Rᵀ has α as its skew part.
      const Vec3 a = ahead.second.col(column), alpha = axial(block(ahead.second, b) * p.R.transpose());
      inertial += moves[b].transpose() * (m * a) + turns[b].transpose() * (J * alpha + p.w.cross(J * p.w));
      M += m * moves[b].transpose() * moves[b] + turns[b].transpose() * J * turns[b];
    }
    const auto masses = M.ldlt();
    std::vector<VecX> found;
    for (const VecX& u : inputs) {
      s.u = u;
      Loads load(bodies.size(), n, states);
      loads(s, load);
      VecX f = load.along - inertial;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        f += moves[b].transpose() * load.wrench_[b].head<3>() + turns[b].transpose() * load.wrench_[b].tail<3>();
      }
      VecX out(x.size());
      out << s.rate, masses.solve(f), load.rates;
      found.push_back(std::move(out));
    }
    return found;
  }
  // Of the mass centre.
  Vec3 acceleration(std::size_t body, const VecX& x, const VecX& u, Real time) const {
    const Eigen::Index n = size();
    const auto column = static_cast<Eigen::Index>(4 * body);
    const VecX faster = rates(x, u, time).segment(n, n);
    return along(x.head(n), x.segment(n, n), 1, time).second.col(column) +
           along(x.head(n), faster, 0, time).first.col(column);
  }

  // ∂f/∂x and ∂f/∂u of any function of x, u.
  using Function = std::function<VecX(const VecX& x, const VecX& u)>;
  MatX by_state(const Function& f, const VecX& x, const VecX& u) const {
    MatX a(f(x, u).size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const Real h = (k < 2 * size() ? scale(k % size()) : 1) * step;
      a.col(k) = first_difference([&](Real d) -> VecX { return f(x + d * VecX::Unit(x.size(), k), u); }, h);
    }
    return a;
  }
  MatX by_input(const Function& f, const VecX& x, const VecX& u) const {
    MatX b(f(x, u).size(), u.size());
    for (Eigen::Index k = 0; k < u.size(); ++k)
      b.col(k) = first_difference([&](Real d) -> VecX { return f(x, u + d * VecX::Unit(u.size(), k)); }, step);
    return b;
  }
  Function rates_at(Real time) const {
    return [this, time](const VecX& x, const VecX& u) { return rates(x, u, time); };
  }
  // Of rest, by Newton's method from `x`: positions and states of controllers.
  VecX rest(VecX x, const VecX& u, Real time) const {
    const Eigen::Index n = size();
    x.segment(n, n).setZero();
    for (int k = 0; k < 30; ++k) {
      const VecX f = rates(x, u, time);
      const MatX A = by_state(rates_at(time), x, u);
      MatX J(n + states, n + states);
      J << A.block(n, 0, n, n), A.block(n, 2 * n, n, states), A.block(2 * n, 0, states, n),
          A.block(2 * n, 2 * n, states, states);
      const VecX d = J.fullPivLu().solve(f.tail(n + states));
      x.head(n) -= d.head(n), x.tail(states) -= d.tail(states);
      if (d.norm() < 1e-14L * (1 + x.norm())) break;
    }
    return x;
  }

 private:
  static constexpr Real step = 0.01L;
  using Columns = Eigen::Matrix<Real, 3, Eigen::Dynamic>;  // p and R of one body after the other
  struct Moved {
    Columns first, second;
  };
  // With what the motion from there makes of the poses.
  State at(const VecX& x, const VecX& u, Real time, const Moved& ahead) const {
    const Eigen::Index n = size();
    State s{x.head(n), x.segment(n, n), x.tail(states), u, time, {}};
    const std::vector<Pose> now = poses(s.q, time);
    for (std::size_t b = 0; b < now.size(); ++b) {
      Point p;
      p.p = now[b].p, p.R = now[b].R;
      p.v = ahead.first.col(static_cast<Eigen::Index>(4 * b));
      p.w = axial(block(ahead.first, b) * now[b].R.transpose());
      s.bodies.push_back(p);
    }
    return s;
  }
  static Mat3 block(const Columns& c, std::size_t body) {
    return c.middleCols<3>(static_cast<Eigen::Index>(4 * body + 1));
  }
  // Both derivatives of all poses along `way` and, with `clock` 1, time.
  Moved along(const VecX& q, const VecX& way, Real clock, Real time) const {
    Real largest = clock / time_scale;
    for (Eigen::Index k = 0; k < q.size(); ++k) largest = std::max(largest, std::abs(way(k)) / scale(k));
    const Real h = step / (largest == 0 ? 1 : largest);
    const auto places = [&](Real s) -> Columns {
      const std::vector<Pose> at = poses(q + s * way, time + clock * s);
      Columns c(3, static_cast<Eigen::Index>(4 * at.size()));
      for (std::size_t b = 0; b < at.size(); ++b) {
        c.col(static_cast<Eigen::Index>(4 * b)) = at[b].p;
        c.middleCols<3>(static_cast<Eigen::Index>(4 * b + 1)) = at[b].R;
      }
      return c;
    };
    if (clock == 0) return {first_difference(places, h), {}};
    auto both = both_differences<Columns>(places, h);
    return {std::move(both.first), std::move(both.second)};
  }
};

// On a body, `at` and `axes` in its own.
inline NewtonEuler::Point marker(const NewtonEuler::Point& body, const Vec3& at, const Mat3& axes = Mat3::Identity()) {
  NewtonEuler::Point f;
  f.p = body.of(at), f.R = body.R * axes, f.v = body.speed(at), f.w = body.w;
  return f;
}
// Displacements and projected angles of I in J, and velocities and angular velocities as J sees them.
struct Relative {
  Vec6 at, rate;
};
inline Relative relative(const NewtonEuler::Point& I, const NewtonEuler::Point& J) {
  const Mat3 R = J.R.transpose() * I.R;
  Relative r;
  r.at.head<3>() = J.R.transpose() * (I.p - J.p);
  r.at.tail<3>() = Vec3(std::atan2(-R(1, 2), R(2, 2)), std::atan2(R(0, 2), R(2, 2)), std::atan2(R(1, 0), R(0, 0)));
  r.rate.head<3>() = J.R.transpose() * (I.v - J.v - J.w.cross(I.p - J.p));
  r.rate.tail<3>() = J.R.transpose() * (I.w - J.w);
  return r;
}

// Cycles per unit of time.
inline std::vector<std::complex<double>> spectrum(MatX A) {
  // Rows and columns of like size: controllers count in other units than millimetres and radians.
  for (int sweep = 0; sweep < 10; ++sweep) {
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
      const Real own = std::abs(A(k, k)), row = A.row(k).lpNorm<1>() - own, column = A.col(k).lpNorm<1>() - own;
      if (row <= 0 || column <= 0) continue;
      const Real factor = std::exp2(std::round(std::log2(row / column) / 2));
      A.col(k) *= factor, A.row(k) /= factor;
    }
  }
  const Eigen::EigenSolver<MatX> solver(A, false);
  std::vector<std::complex<double>> values;
  for (const auto& v : solver.eigenvalues())
    values.emplace_back(static_cast<double>(v.real() / (2 * pi_l)), static_cast<double>(v.imag() / (2 * pi_l)));
  return values;
}

}  // namespace dynalin::cases::newton_euler
