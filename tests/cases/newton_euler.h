// Rigid bodies and mass points whose places are functions of a few coordinates: their motion by Newton and Euler for
// each body, projected on what the coordinates move (d'Alembert), and its linear model. Everything but the places and
// the loads comes of differences of eighth order in long double: an answer for datasets which shares nothing with the
// program.
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace dynalin::cases::newton_euler {

using Real = long double;
using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Mat3 = Eigen::Matrix<Real, 3, 3>;
using VecX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Vec6 = Eigen::Matrix<Real, 6, 1>;
using MatX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

inline constexpr Real pi_l = std::numbers::pi_v<Real>;

Mat3 about(const Vec3& axis, Real angle);
// Of 3-1-3 angles in degrees: its columns are the turned axes.
Mat3 euler(Real psi, Real theta, Real phi);
Mat3 exponential(const Vec3& v);
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

  State at(const VecX& x, const VecX& u, Real time) const;
  // x'.
  VecX rates(const VecX& x, const VecX& u, Real time) const { return rates(x, std::vector{u}, time).front(); }
  // For each of several inputs.
  std::vector<VecX> rates(const VecX& x, const std::vector<VecX>& inputs, Real time) const;
  // Of the mass centre.
  Vec3 acceleration(std::size_t body, const VecX& x, const VecX& u, Real time) const;

  // ∂f/∂x and ∂f/∂u of any function of x, u.
  using Function = std::function<VecX(const VecX& x, const VecX& u)>;
  MatX by_state(const Function& f, const VecX& x, const VecX& u) const;
  MatX by_input(const Function& f, const VecX& x, const VecX& u) const;
  Function rates_at(Real time) const {
    return [this, time](const VecX& x, const VecX& u) { return rates(x, u, time); };
  }
  // Of rest, by Newton's method from `x`: positions and states of controllers.
  VecX rest(VecX x, const VecX& u, Real time) const;

 private:
  using Columns = Eigen::Matrix<Real, 3, Eigen::Dynamic>;  // p and R of one body after the other
  struct Moved {
    Columns first, second;
  };
  // With what the motion from there makes of the poses.
  State at(const VecX& x, const VecX& u, Real time, const Moved& ahead) const;
  static Mat3 block(const Columns& c, std::size_t body);
  // Both derivatives of all poses along `way` and, with `clock` 1, time.
  Moved along(const VecX& q, const VecX& way, Real clock, Real time) const;
};

// On a body, `at` and `axes` in its own.
NewtonEuler::Point marker(const NewtonEuler::Point& body, const Vec3& at, const Mat3& axes = Mat3::Identity());
// Displacements and projected angles of I in J, and velocities and angular velocities as J sees them.
struct Relative {
  Vec6 at, rate;
};
Relative relative(const NewtonEuler::Point& I, const NewtonEuler::Point& J);

// Cycles per unit of time.
std::vector<std::complex<double>> spectrum(MatX A);

// x of A x = b, with full pivoting.
MatX solution(const MatX& A, const MatX& b);
// C (s − A)⁻¹ B + D at s = 2π i f.
Eigen::MatrixXcd response(const MatX& A, const MatX& B, const MatX& C, const MatX& D, Real hz);

}  // namespace dynalin::cases::newton_euler
