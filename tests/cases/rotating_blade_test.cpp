// Modal tables of a rotor: a driven hub with two blades on offset hinges, a torsion spring-damper in one hinge and a
// spring-damper between the tips. Everything is worked out here in the two blade angles.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::rotating_blade_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector2cd;

// Blade 1 lies along x, blade 2 along y, hinges at the distance e from the axis, mass centres at l, tips at s from
// them.
struct Rotor {
  double omega = 10, e = 2, m1 = 3, l1 = 10, J1 = 10, s1 = 20, m2 = 2, l2 = 8, J2 = 5, s2 = 15;
  double KT = 900, CT = 200, K = 4, C = 1.5;

  Vector2d tip1() const { return {e + s1, 0}; }
  Vector2d tip2() const { return {0, e + s2}; }
  double length() const { return (tip1() - tip2()).norm(); }
  Vector2d line() const { return (tip1() - tip2()) / length(); }  // from J to I

  std::string dataset() const {
    const auto blade = [&](int id, double m, double l, double J, double s, bool along_y) {
      const auto at = [&](double r) { return along_y ? fmt::format("0,{:.17g},0", r) : fmt::format("{:.17g},0,0", r); };
      return fmt::format(
          "PART/{0}, MASS={1}, CM={0}1, IP=0,0,{2}, WZ={3}\nMARKER/{0}0, QP={4}\nMARKER/{0}1, QP={5}\n"
          "MARKER/{0}2, QP={6}\nMARKER/{0}3, PART=2, QP={4}\nJOINT/{0}, REVOLUTE, I={0}0, J={0}3\n",
          id, m, J, omega, at(e), at(e + l), at(e + s));
    };
    return "Rotor\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND\nPART/1, GROUND\nMARKER/6\n"
           "PART/2\nMARKER/5\nJOINT/1, REVOLUTE, I=5, J=6\n" +
           fmt::format("MOTION/1, ROTATIONAL, JOINT=1, FUNCTION={}*TIME\n", omega) + blade(3, m1, l1, J1, s1, false) +
           blade(4, m2, l2, J2, s2, true) +
           fmt::format("SPRINGDAMPER/1, ROTATION, I=30, J=33, KT={}, CT={}\n", KT, CT) +
           fmt::format("SPRINGDAMPER/2, TRANSLATION, I=32, J=42, K={}, C={}, LENGTH={:.17g}\nEND\n", K, C, length());
  }

  // Of the angles: M q″ + C q′ + K q = 0. A blade turned by q in the hub's frame is drawn back by m e l ω² q.
  Vector2d mass() const { return {J1 + m1 * l1 * l1, J2 + m2 * l2 * l2}; }
  Vector2d stretch() const { return {s1 * line().y(), s2 * line().x()}; }  // ∂length/∂q
  Matrix2d stiffness() const {
    Matrix2d k = K * stretch() * stretch().transpose();
    k(0, 0) += KT + m1 * e * l1 * omega * omega;
    k(1, 1) += m2 * e * l2 * omega * omega;
    return k;
  }
  Matrix2d damping() const {
    Matrix2d c = C * stretch() * stretch().transpose();
    c(0, 0) += CT;
    return c;
  }
};

class RotatingBlade : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    const RunResult r = run(rotor_.dataset(),
                            "LINEAR/EIGENSOL, COORDS=1,2, KINETIC=1,2, STRAIN=1,2, DISSIPAT=1,2, TABLE_PRECISION=14\n");
    ASSERT_EQ(r.status, 0) << r.err;
    values_ = r.eigenvalues(0);
    text_ = r.text("model.txt");
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
    A.topRightCorner<2, 2>().setIdentity();
    A.bottomLeftCorner<2, 2>() = -(rotor_.mass().cwiseInverse().asDiagonal() * rotor_.stiffness());
    A.bottomRightCorner<2, 2>() = -(rotor_.mass().cwiseInverse().asDiagonal() * rotor_.damping());
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
    std::vector<std::pair<double, Eigen::Index>> order;
    for (Eigen::Index i = 0; i < 4; ++i) {
      if (solver.eigenvalues()(i).imag() > 0) order.emplace_back(solver.eigenvalues()(i).imag(), i);
    }
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      lambda_[k] = solver.eigenvalues()(order[k].second);
      angle_[k] = solver.eigenvectors().col(order[k].second).head<2>();
      // The entry of (q′, q) of largest modulus is 1.
      Complex largest = 0;
      for (const Complex& v : {angle_[k](0), angle_[k](1)}) {
        for (const Complex& entry : {v, lambda_[k] * v}) {
          if (std::abs(entry) > std::abs(largest)) largest = entry;
        }
      }
      angle_[k] /= largest;
    }
  }

  Vector2cd rate(std::size_t k) const { return lambda_[k] * angle_[k]; }

  std::vector<double> row(const std::string& title, const std::string& label, std::size_t n) const {
    std::size_t at = 0;
    for (std::size_t k = 0; k <= n; ++k) at = text_.find(title, at + 1);
    at = text_.find("\n  " + label, at);
    EXPECT_NE(at, std::string::npos) << title << label;
    if (at == std::string::npos) return std::vector<double>(12, std::nan(""));
    const std::size_t bar = text_.find('|', at);
    std::string cells = text_.substr(bar + 1, text_.find('\n', at + 1) - bar - 1);
    std::replace(cells.begin(), cells.end(), '|', ' ');
    std::istringstream in(cells);
    std::vector<double> values;
    for (double v = 0; in >> v;) values.push_back(v);
    return values;
  }
  // Of the hinge and of the spring-damper between the tips, which works along x and y.
  void expect_shares(const std::string& table, std::size_t k, double hinge, double x, double y) const {
    const double percent = 100 / (hinge + x + y);
    EXPECT_NEAR(row(table, "SPRI/1", k).at(0), percent * hinge, 1e-10);
    const auto cells = row(table, "SPRI/2", k);
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_NEAR(cells[0], percent * (x + y), 1e-10);
    EXPECT_NEAR(cells[1], percent * x, 1e-10);
    EXPECT_NEAR(cells[2], percent * y, 1e-10);
    EXPECT_NEAR(cells[3], 0, 1e-10);
  }
  double header(const std::string& name, std::size_t n) const {
    std::size_t at = text_.find("Energy table for MODE " + std::to_string(n + 1));
    at = text_.find(name, at);
    return std::stod(text_.substr(text_.find('=', at) + 1));
  }

  // Motion of the tip of blade 1 against that of blade 2, and what the spring-damper answers to it.
  Vector2cd between_tips(const Vector2cd& q) const { return {rotor_.s2 * q(1), rotor_.s1 * q(0)}; }

  Rotor rotor_;
  std::vector<Complex> values_;
  std::string text_;
  std::array<Complex, 2> lambda_;
  std::array<Vector2cd, 2> angle_;
};

TEST_F(RotatingBlade, eigenvalues) {
  ASSERT_EQ(values_.size(), 4u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LE(std::abs(values_[2 * k] - lambda_[k] / (2 * std::numbers::pi)), 1e-13 * std::abs(lambda_[k]));
    EXPECT_GT(std::abs(lambda_[k].real()), 0.01 * std::abs(lambda_[k]));
  }
}

TEST_F(RotatingBlade, header) {
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector2cd v = rate(k);
    const double T = 0.5 * (rotor_.mass()(0) * std::norm(v(0)) + rotor_.mass()(1) * std::norm(v(1)));
    const double w = std::abs(lambda_[k]);
    const double digits = 6e-6;  // the header has six
    EXPECT_NEAR(header("Kinetic energy", k), T, digits * T);
    EXPECT_NEAR(header("Generalized stiffness", k), 2 * T, digits * 2 * T);
    EXPECT_NEAR(header("Generalized mass", k), 2 * T / (w * w), digits * 2 * T / (w * w));
    EXPECT_NEAR(header("Damping ratio", k), -lambda_[k].real() / w, digits);
    EXPECT_NEAR(header("Undamped natural freq.", k), w / (2 * std::numbers::pi), digits * w);
  }
}

TEST_F(RotatingBlade, coordinates) {
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector2cd& q = angle_[k];
    const std::array<Complex, 6> first = {0, rotor_.l1 * q(0), 0, 0, 0, q(0)},
                                 second = {-rotor_.l2 * q(1), 0, 0, 0, 0, q(1)};
    const Complex largest = std::abs(first[1]) > std::abs(second[0]) ? first[1] : second[0];
    for (const auto& [label, expected] : {std::pair("PART/3", first), std::pair("PART/4", second)}) {
      const auto cells = row("Normalized coordinates", label, k);
      ASSERT_EQ(cells.size(), 12u);
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_LE(std::abs(std::polar(cells[2 * c], cells[2 * c + 1] * std::numbers::pi / 180) - expected[c] / largest),
                  1e-12)
            << label << " " << c << " mode " << k + 1;
      }
    }
    EXPECT_EQ(row("Normalized coordinates", "PART/2", k), std::vector<double>(12, 0.0));
  }
}

TEST_F(RotatingBlade, kinetic_energy) {
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector2cd v = rate(k);
    const double y1 = rotor_.m1 * rotor_.l1 * rotor_.l1 * std::norm(v(0)), r1 = rotor_.J1 * std::norm(v(0)),
                 x2 = rotor_.m2 * rotor_.l2 * rotor_.l2 * std::norm(v(1)), r2 = rotor_.J2 * std::norm(v(1));
    const double percent = 100 / (y1 + r1 + x2 + r2);
    const std::vector<double> first = {0, y1, 0, 0, 0, r1, 0, 0, 0, y1 + r1},
                              second = {x2, 0, 0, 0, 0, r2, 0, 0, 0, x2 + r2};
    for (const auto& [label, expected] : {std::pair("PART/3", first), std::pair("PART/4", second)}) {
      const auto cells = row("of Kinetic energy", label, k);
      ASSERT_EQ(cells.size(), 10u);
      for (std::size_t c = 0; c < 10; ++c) EXPECT_NEAR(cells[c], percent * expected[c], 1e-10) << label << " " << c;
    }
  }
}

TEST_F(RotatingBlade, dissipated_power) {
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector2cd v = rate(k), u = between_tips(v);
    const Vector2d n = rotor_.line();
    const Complex along = n.x() * u.x() + n.y() * u.y();
    const double hinge = rotor_.CT * std::norm(v(0)), x = std::real(std::conj(u.x()) * rotor_.C * along * n.x()),
                 y = std::real(std::conj(u.y()) * rotor_.C * along * n.y());
    expect_shares("dissipative energy", k, hinge, x, y);
  }
}

// A damper between points that turn with each other would add what its line, turned, sees of their velocities.
class UndampedTips : public RotatingBlade {
 protected:
  void SetUp() override {
    rotor_.C = 0;
    RotatingBlade::SetUp();
  }
};

TEST_F(UndampedTips, strain_energy) {
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector2cd q = angle_[k], u = between_tips(q);
    const Vector2d n = rotor_.line();
    const Complex along = n.x() * u.x() + n.y() * u.y();
    const double hinge = rotor_.KT * std::norm(q(0)), x = std::real(std::conj(u.x()) * rotor_.K * along * n.x()),
                 y = std::real(std::conj(u.y()) * rotor_.K * along * n.y());
    expect_shares("strain energy", k, hinge, x, y);
  }
}

}  // namespace
}  // namespace dynalin::cases::rotating_blade_test
