// Rigid bodies on preloaded springs and dampers that vibrate a little about the rest they are drawn at, written down by
// Newton and Euler for each body: an answer for datasets which shares nothing with the program but their numbers.
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <numbers>
#include <vector>

namespace dynalin::cases {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Of 3-1-3 angles in degrees: its columns are the turned axes.
inline Eigen::Matrix3d turned(double psi, double theta, double phi) {
  const auto about = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
  };
  return about(psi, Eigen::Vector3d::UnitZ()) * about(theta, Eigen::Vector3d::UnitX()) *
         about(phi, Eigen::Vector3d::UnitZ());
}

class SmallVibrations {
 public:
  static constexpr int ground = -1;

  // `inertia` about the mass centre, global axes.
  int add_body(const Eigen::Vector3d& centre, double mass, const Eigen::Matrix3d& inertia) {
    bodies_.push_back({centre, mass, inertia});
    return static_cast<int>(bodies_.size()) - 1;
  }
  // Springs and dampers between I and J, whose points coincide at `at`, along and about the axes of J; `force` along
  // them acts on I at rest. Forces over displacements, the units of mass, length and time of the bodies.
  void add_link(int I, int J, const Eigen::Vector3d& at, const Eigen::Matrix3d& axes, const Matrix6& stiffness,
                const Matrix6& damping, const Eigen::Vector3d& force = Eigen::Vector3d::Zero()) {
    links_.push_back({{I, J, at, axes}, stiffness, damping, force});
  }
  // Leaves I a rotation about z of `axes` against J.
  void add_hinge(int I, int J, const Eigen::Vector3d& at, const Eigen::Matrix3d& axes) {
    hinges_.push_back({I, J, at, axes});
  }

  struct Matrices {
    Eigen::MatrixXd M, C, K, coordinates;  // of the motions that hinges leave; these in displacements of bodies
  };
  Matrices matrices() const {
    const auto n = static_cast<Eigen::Index>(6 * bodies_.size());
    Matrices m{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}};
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto at = static_cast<Eigen::Index>(6 * b);
      m.M.block<3, 3>(at, at) = bodies_[b].mass * Eigen::Matrix3d::Identity();
      m.M.block<3, 3>(at + 3, at + 3) = bodies_[b].inertia;
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, k), still = Eigen::VectorXd::Zero(n);
      m.K.col(k) = -loads(unit, still), m.C.col(k) = -loads(still, unit);
    }
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(5 * hinges_.size()), n);
    for (std::size_t h = 0; h < hinges_.size(); ++h) {
      for (Eigen::Index k = 0; k < n; ++k) {
        rows.block<5, 1>(static_cast<Eigen::Index>(5 * h), k) =
            relative(hinges_[h], Eigen::VectorXd::Unit(n, k)).head<5>();
      }
    }
    m.coordinates = Eigen::MatrixXd::Identity(n, n);
    if (!hinges_.empty()) {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
      m.coordinates = (qr.householderQ() * Eigen::MatrixXd::Identity(n, n)).rightCols(n - rows.rows());
    }
    for (Eigen::MatrixXd* a : {&m.M, &m.C, &m.K}) *a = (m.coordinates.transpose() * *a * m.coordinates).eval();
    return m;
  }

  // Cycles per unit of time.
  static std::vector<std::complex<double>> eigenvalues(const Matrices& m) {
    const Eigen::LLT<Eigen::MatrixXd> root(m.M);
    const auto normal = [&](const Eigen::MatrixXd& a) -> Eigen::MatrixXd {
      const Eigen::MatrixXd left = root.matrixL().solve(a);
      return root.matrixL().solve(left.transpose()).transpose();
    };
    const Eigen::MatrixXd K = normal(m.K), C = normal(m.C);
    const Eigen::Index n = K.rows();
    const double fastest = std::sqrt(K.norm());  // displacements in units that make rates of them
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).diagonal().setConstant(fastest);
    A.bottomLeftCorner(n, n) = -K / fastest;
    A.bottomRightCorner(n, n) = -C;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
    std::vector<std::complex<double>> values;
    for (const auto& v : solver.eigenvalues()) values.push_back(v / (2 * std::numbers::pi));
    return values;
  }

  // Displacement along `way` of a point of body `of` per force along it at a point of body `on`.
  std::complex<double> response(const Matrices& m, double omega, int on, const Eigen::Vector3d& pushed, int of,
                                const Eigen::Vector3d& seen, const Eigen::Vector3d& way) const {
    const auto along = [&](int body, const Eigen::Vector3d& at) -> Eigen::VectorXd {
      Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * bodies_.size()));
      load.segment<3>(6 * body) = way;
      load.segment<3>(6 * body + 3) = (at - bodies_[static_cast<std::size_t>(body)].centre).cross(way);
      return m.coordinates.transpose() * load;
    };
    const std::complex<double> s(0, omega);
    const Eigen::MatrixXcd dynamic = s * s * m.M.cast<std::complex<double>>() + s * m.C + m.K;
    const Eigen::VectorXcd moved = dynamic.partialPivLu().solve(along(on, pushed).cast<std::complex<double>>());
    return along(of, seen).cast<std::complex<double>>().dot(moved);
  }

 private:
  struct Body {
    Eigen::Vector3d centre;
    double mass;
    Eigen::Matrix3d inertia;
  };
  struct Hinge {
    int I, J;
    Eigen::Vector3d at;
    Eigen::Matrix3d axes;
  };
  struct Link : Hinge {
    Matrix6 stiffness, damping;
    Eigen::Vector3d force;
  };

  static Eigen::Vector3d turn(int body, const Eigen::VectorXd& q) {
    return body == ground ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(q.segment<3>(6 * body + 3));
  }
  Eigen::Vector3d lever(int body, const Eigen::Vector3d& at) const {
    return body == ground ? at : Eigen::Vector3d(at - bodies_[static_cast<std::size_t>(body)].centre);
  }
  Eigen::Vector3d shift(int body, const Eigen::Vector3d& at, const Eigen::VectorXd& q) const {
    if (body == ground) return Eigen::Vector3d::Zero();
    return q.segment<3>(6 * body) + turn(body, q).cross(lever(body, at));
  }
  // Displacement and rotation of I against J in the axes of J.
  Vector6 relative(const Hinge& l, const Eigen::VectorXd& q) const {
    Vector6 d;
    d << l.axes.transpose() * (shift(l.I, l.at, q) - shift(l.J, l.at, q)),
        l.axes.transpose() * (turn(l.I, q) - turn(l.J, q));
    return d;
  }
  // What forces and moments about mass centres change by. The load at rest turns with J and keeps its point on I, which
  // moves against the centres of both.
  Eigen::VectorXd loads(const Eigen::VectorXd& q, const Eigen::VectorXd& rate) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(q.size());
    for (const Link& l : links_) {
      const Vector6 elastic = -l.stiffness * relative(l, q) - l.damping * relative(l, rate);
      const Eigen::Vector3d rest = l.axes * l.force, force = l.axes * elastic.head<3>() + turn(l.J, q).cross(rest),
                            torque = l.axes * elastic.tail<3>();
      const auto add = [&](int body, double sign) {
        if (body == ground) return;
        const Eigen::Vector3d moved = shift(l.I, l.at, q) - q.segment<3>(6 * body);
        sum.segment<3>(6 * body) += sign * force;
        sum.segment<3>(6 * body + 3) += sign * (lever(body, l.at).cross(force) + moved.cross(rest) + torque);
      };
      add(l.I, 1), add(l.J, -1);
    }
    return sum;
  }

  std::vector<Body> bodies_;
  std::vector<Link> links_;
  std::vector<Hinge> hinges_;
};

}  // namespace dynalin::cases
