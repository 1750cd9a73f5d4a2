#include "cases/newton_euler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dynalin::cases::newton_euler {

namespace {

constexpr Real step = 0.01L;

// Of eighth order at 1 to 4 steps to either side: the first and the second one.
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

}  // namespace

Mat3 about(const Vec3& axis, Real angle) { return Eigen::AngleAxis<Real>(angle, axis).toRotationMatrix(); }

Mat3 euler(Real psi, Real theta, Real phi) {
  const Real d = pi_l / 180;
  return about(Vec3::UnitZ(), psi * d) * about(Vec3::UnitX(), theta * d) * about(Vec3::UnitZ(), phi * d);
}

Mat3 exponential(const Vec3& v) { return v.norm() == 0 ? Mat3(Mat3::Identity()) : about(v.normalized(), v.norm()); }

NewtonEuler::State NewtonEuler::at(const VecX& x, const VecX& u, Real time) const {
  return at(x, u, time, along(x.head(size()), x.segment(size(), size()), 1, time));
}

NewtonEuler::State NewtonEuler::at(const VecX& x, const VecX& u, Real time, const Moved& ahead) const {
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

std::vector<VecX> NewtonEuler::rates(const VecX& x, const std::vector<VecX>& inputs, Real time) const {
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

Vec3 NewtonEuler::acceleration(std::size_t body, const VecX& x, const VecX& u, Real time) const {
  const Eigen::Index n = size();
  const auto column = static_cast<Eigen::Index>(4 * body);
  const VecX faster = rates(x, u, time).segment(n, n);
  return along(x.head(n), x.segment(n, n), 1, time).second.col(column) +
         along(x.head(n), faster, 0, time).first.col(column);
}

MatX NewtonEuler::by_state(const Function& f, const VecX& x, const VecX& u) const {
  MatX a(f(x, u).size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const Real h = (k < 2 * size() ? scale(k % size()) : 1) * step;
    a.col(k) = first_difference([&](Real d) -> VecX { return f(x + d * VecX::Unit(x.size(), k), u); }, h);
  }
  return a;
}

MatX NewtonEuler::by_input(const Function& f, const VecX& x, const VecX& u) const {
  MatX b(f(x, u).size(), u.size());
  for (Eigen::Index k = 0; k < u.size(); ++k)
    b.col(k) = first_difference([&](Real d) -> VecX { return f(x, u + d * VecX::Unit(u.size(), k)); }, step);
  return b;
}

VecX NewtonEuler::rest(VecX x, const VecX& u, Real time) const {
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

Mat3 NewtonEuler::block(const Columns& c, std::size_t body) {
  return c.middleCols<3>(static_cast<Eigen::Index>(4 * body + 1));
}

NewtonEuler::Moved NewtonEuler::along(const VecX& q, const VecX& way, Real clock, Real time) const {
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

NewtonEuler::Point marker(const NewtonEuler::Point& body, const Vec3& at, const Mat3& axes) {
  NewtonEuler::Point f;
  f.p = body.of(at), f.R = body.R * axes, f.v = body.speed(at), f.w = body.w;
  return f;
}

Relative relative(const NewtonEuler::Point& I, const NewtonEuler::Point& J) {
  const Mat3 R = J.R.transpose() * I.R;
  Relative r;
  r.at.head<3>() = J.R.transpose() * (I.p - J.p);
  r.at.tail<3>() = Vec3(std::atan2(-R(1, 2), R(2, 2)), std::atan2(R(0, 2), R(2, 2)), std::atan2(R(1, 0), R(0, 0)));
  r.rate.head<3>() = J.R.transpose() * (I.v - J.v - J.w.cross(I.p - J.p));
  r.rate.tail<3>() = J.R.transpose() * (I.w - J.w);
  return r;
}

std::vector<std::complex<double>> spectrum(MatX A) {
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

MatX solution(const MatX& A, const MatX& b) { return A.fullPivLu().solve(b); }

Eigen::MatrixXcd response(const MatX& A, const MatX& B, const MatX& C, const MatX& D, Real hz) {
  using MatXc = Eigen::Matrix<std::complex<Real>, Eigen::Dynamic, Eigen::Dynamic>;
  const std::complex<Real> s(0, 2 * pi_l * hz);
  const MatXc shifted = s * MatXc::Identity(A.rows(), A.cols()) - A;
  const MatXc moved = shifted.partialPivLu().solve(B.cast<std::complex<Real>>());
  return (C * moved + D).cast<std::complex<double>>();
}

}  // namespace dynalin::cases::newton_euler
