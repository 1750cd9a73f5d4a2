// ENERGY_PER_MODE and MASS_PER_MODE against modes and matrices computed here from the data of each model.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "cases/dataset_text.h"

namespace dynalin::cases {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::MatrixXcd, Eigen::Vector3d, Eigen::VectorXd, Eigen::VectorXcd;
using ::testing::HasSubstr;
using ::testing::Not;
using Index = Eigen::Index;

class ModalSums : public Cases {
 protected:
  // Rows of the table with the title: label and numbers, up to the empty line.
  static std::vector<std::pair<std::string, std::vector<double>>> table(const std::string& text,
                                                                        const std::string& title) {
    std::vector<std::pair<std::string, std::vector<double>>> rows;
    std::size_t at = text.find("  " + title);
    EXPECT_NE(at, std::string::npos) << title;
    if (at == std::string::npos) return rows;
    std::istringstream in(text.substr(at));
    std::string line;
    for (int skip = 0; skip < 3; ++skip) std::getline(in, line);  // title, rule, heads
    while (std::getline(in, line) && line.size() > 10) {
      std::string label = line.substr(2, 8);
      label.erase(0, label.find_first_not_of(' '));
      label.erase(label.find_last_not_of(' ') + 1);
      std::istringstream cells(line.substr(10));
      rows.push_back({label, {}});
      for (double v = 0; cells >> v;) rows.back().second.push_back(v);
    }
    return rows;
  }
  static std::vector<double> row(const std::string& text, const std::string& title, const std::string& label) {
    for (const auto& [l, values] : table(text, title)) {
      if (l == label) return values;
    }
    ADD_FAILURE() << "no row " << label << " in " << title << "\n" << text;
    return std::vector<double>(7, 0.0);
  }
  static std::vector<std::string> labels(const std::string& text, const std::string& title) {
    std::vector<std::string> all;
    for (const auto& r : table(text, title)) all.push_back(r.first);
    return all;
  }
  std::string tables(const std::string& dataset, const std::string& arguments) const {
    const RunResult r = run(dataset, "LINEAR/EIGENSOL, " + arguments + ", TABLE_PRECISION=14\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.wrote("model.txt") ? r.text("model.txt") : std::string();
  }
};

// Energies ----------------------------------------------------------------------------------------------------------

// Three masses on a vertical line between floor and ceiling, each started where and as fast as the data say. `factor`
// is what one unit of force gives in mass·length/time².
struct Line {
  std::array<double, 3> m{1, 2, 1.5};
  std::array<double, 4> k{400, 300, 500, 200}, c{}, free{0.9, 1.3, 1.2, 0.8};
  std::array<double, 3> at{1, 2.1, 3.3}, velocity{0.7, -1.1, 0.4};
  double height = 4.2, gravity = 9.81, factor = 1;
  std::string units = "UNITS/SYSTEM=MKS\n";

  std::string dataset() const {
    std::string s = "Line\n" + units + fmt::format("ACCGRAV/KGRAV={:.17g}\nPART/1, GROUND\nMARKER/1\n", -gravity) +
                    fmt::format("MARKER/2, QP=0,0,{:.17g}\n", height);
    for (std::size_t n = 0; n < 3; ++n) {
      s += fmt::format(
          "PART/{0}, MASS={1}, CM={0}0, IP=1,1,1, QG=0,0,{2:.17g}, VZ={3:.17g}\nMARKER/{0}0\n"
          "JOINT/{0}, TRANSLATIONAL, I={0}0, J=1\n",
          n + 2, m[n], at[n], velocity[n]);
    }
    for (std::size_t n = 0; n < 4; ++n) {
      s += fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}, J={}, K={:.17g}, C={:.17g}, LENGTH={:.17g}\n", n + 1,
                       n == 3 ? 2 : 10 * (n + 2), n == 0 ? 1 : 10 * (n + 1), k[n], c[n], free[n]);
    }
    return s + "END\n";
  }
  Matrix3d mass() const { return Vector3d(m[0], m[1], m[2]).asDiagonal(); }
  Matrix3d tridiagonal(const std::array<double, 4>& x) const {
    Matrix3d T;
    T << x[0] + x[1], -x[1], 0, -x[1], x[1] + x[2], -x[2], 0, -x[2], x[2] + x[3];
    return factor * T;
  }
  // From the place where springs and weight balance.
  Vector3d displacement() const {
    Vector3d load;
    for (std::size_t n = 0; n < 3; ++n)
      load(static_cast<Index>(n)) = factor * (k[n] * free[n] - k[n + 1] * free[n + 1]) - m[n] * gravity;
    load(2) += factor * k[3] * height;
    return Vector3d(at[0], at[1], at[2]) - tridiagonal(k).ldlt().solve(load);
  }
  Vector3d rates() const { return {velocity[0], velocity[1], velocity[2]}; }
};

struct Energies {
  double kinetic, potential, power;
};

void expect_row(const std::vector<double>& values, const Energies& e, const Energies& sum, double tolerance = 1e-10) {
  ASSERT_EQ(values.size(), 6u);
  const auto check = [&](std::size_t at, double part, double whole) {
    EXPECT_NEAR(values[at], part, tolerance * std::abs(whole));
    EXPECT_NEAR(values[at + 1], whole == 0 ? 0 : 100 * part / whole, 100 * tolerance);
  };
  check(0, e.kinetic, sum.kinetic), check(2, e.potential, sum.potential), check(4, e.power, sum.power);
}

Energies total(const std::vector<Energies>& list) {
  Energies sum{};
  for (const Energies& e : list) sum.kinetic += e.kinetic, sum.potential += e.potential, sum.power += e.power;
  return sum;
}

// Stiffness-proportional damping (or none): real modes of K φ = ω² M φ with φᵀ M φ = 1, in which everything is a sum
// of squares.
std::vector<Energies> by_real_modes(const Line& line, double beta) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d> solver(line.tridiagonal(line.k), line.mass());
  const Vector3d eta = solver.eigenvectors().transpose() * line.mass() * line.displacement(),
                 rate = solver.eigenvectors().transpose() * line.mass() * line.rates();
  std::vector<Energies> list;
  for (Index i = 0; i < 3; ++i) {
    const double w2 = solver.eigenvalues()(i);
    list.push_back({0.5 * rate(i) * rate(i), 0.5 * w2 * eta(i) * eta(i), beta * w2 * rate(i) * rate(i)});
  }
  return list;
}

TEST_F(ModalSums, energies_of_a_line_in_real_modes) {
  for (const double beta : {0.0, 1e-3}) {
    for (const bool millimetres : {false, true}) {
      Line line;
      if (millimetres) {
        line.units = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n";
        line.factor = 1000, line.gravity = 9806.65, line.height *= 1000;
        for (auto* list : {&line.k, &line.c}) {
          for (double& x : *list) x /= 1000;
        }
        for (double& x : line.free) x *= 1000;
        for (double& x : line.at) x *= 1000;
        for (double& x : line.velocity) x *= 1000;
      }
      for (std::size_t n = 0; n < 4; ++n) line.c[n] = beta * line.k[n];
      const std::string t = tables(line.dataset(), "ENERGY_PER_MODE=ALL");
      const auto expected = by_real_modes(line, beta);
      const Energies sum = total(expected);
      for (std::size_t i = 0; i < 3; ++i)
        expect_row(row(t, "Energies per mode", std::to_string(i + 1)), expected[i], sum);
      // What the springs, masses and dampers hold together.
      const Vector3d x = line.displacement(), v = line.rates();
      const Energies model{0.5 * v.dot(line.mass() * v), 0.5 * x.dot(line.tridiagonal(line.k) * x),
                           v.dot(line.tridiagonal(line.c) * v)};
      for (const char* label : {"Sum", "Model"}) expect_row(row(t, "Energies per mode", label), model, model);
    }
  }
}

TEST_F(ModalSums, percentages_belong_to_the_modes_asked_for) {
  const Line line;
  const auto expected = by_real_modes(line, 0);
  const std::string t = tables(line.dataset(), "ENERGY_PER_MODE=2,3");
  EXPECT_THAT(labels(t, "Energies per mode"), ::testing::ElementsAre("2", "3", "Sum", "Model"));
  const Energies two = total({expected[1], expected[2]}), all = total(expected);
  expect_row(row(t, "Energies per mode", "2"), expected[1], two);
  expect_row(row(t, "Energies per mode", "3"), expected[2], two);
  expect_row(row(t, "Energies per mode", "Sum"), two, two);
  const auto model = row(t, "Energies per mode", "Model");
  EXPECT_NEAR(model[0], all.kinetic, 1e-10 * all.kinetic);
  EXPECT_NEAR(model[1], 100 * all.kinetic / two.kinetic, 1e-8);
  EXPECT_NEAR(model[2], all.potential, 1e-10 * all.potential);
  const std::string one = tables(line.dataset(), "ENERGY_PER_MODE=2");
  EXPECT_THAT(labels(one, "Energies per mode"), ::testing::ElementsAre("2", "Sum", "Model"));
  EXPECT_NEAR(row(one, "Energies per mode", "2")[1], 100, 1e-10);
}

// Dampers out of proportion: complex shapes, whose shares ½ η′_iᴴ Σ_j (ΦᴴMΦ)_ij η′_j are no squares.
TEST_F(ModalSums, energies_of_a_line_in_complex_modes) {
  Line line;
  line.c = {9, 0.5, 6, 0};
  const Matrix3d M = line.mass(), K = line.tridiagonal(line.k), C = line.tridiagonal(line.c);
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  A.topRightCorner<3, 3>().setIdentity();
  A.bottomLeftCorner<3, 3>() = -M.inverse() * K;
  A.bottomRightCorner<3, 3>() = -M.inverse() * C;
  const Eigen::EigenSolver<Eigen::Matrix<double, 6, 6>> solver(A);
  std::vector<std::pair<double, Index>> order;
  for (Index i = 0; i < 6; ++i) {
    if (solver.eigenvalues()(i).imag() > 0) order.emplace_back(solver.eigenvalues()(i).imag(), i);
  }
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), 3u);
  Eigen::Matrix3cd Phi;
  for (Index i = 0; i < 3; ++i)
    Phi.col(i) = solver.eigenvectors().col(order[static_cast<std::size_t>(i)].second).head<3>();
  const Eigen::Vector3cd eta = Phi.inverse() * line.displacement(), rate = Phi.inverse() * line.rates();
  const auto share = [&](const Matrix3d& m, const Eigen::Vector3cd& e, Index i) {
    const Eigen::Matrix3cd modal = Phi.adjoint() * m * Phi;
    return std::real(std::conj(e(i)) * (modal.row(i) * e)(0));
  };
  std::vector<Energies> expected;
  for (Index i = 0; i < 3; ++i)
    expected.push_back({0.5 * share(M, rate, i), 0.5 * share(K, eta, i), share(C, rate, i)});
  const Energies sum = total(expected);
  EXPECT_NEAR(sum.power, line.rates().dot(C * line.rates()), 1e-10 * sum.power);
  const std::string t = tables(line.dataset(), "ENERGY_PER_MODE=ALL");
  for (std::size_t i = 0; i < 3; ++i) expect_row(row(t, "Energies per mode", std::to_string(i + 1)), expected[i], sum);
}

// Two real modes with one shape hold the energy of a slide damped beyond the critical damping.
TEST_F(ModalSums, an_overdamped_slide_has_its_energy_once) {
  const std::string t = tables(
      "Slide\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,1.5, "
      "VZ=3\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=10, C=40, LENGTH=1\nEND\n",
      "ENERGY_PER_MODE=ALL");
  const Energies model{9, 0.5 * 10 * 0.25, 360};
  double kinetic = 0, potential = 0, power = 0;
  for (const char* mode : {"1", "2"}) {
    const auto r = row(t, "Energies per mode", mode);
    kinetic += r[0], potential += r[2], power += r[4];
  }
  EXPECT_NEAR(kinetic, model.kinetic, 1e-12);
  EXPECT_NEAR(potential, model.potential, 1e-12);
  EXPECT_NEAR(power, model.power, 1e-10);
  expect_row(row(t, "Energies per mode", "Model"), model, model);
}

// A body on a mount, turned, with an offset mass centre and products of inertia: the sum is ½ m v² + ½ ωᵀ J ω.
TEST_F(ModalSums, kinetic_energy_of_a_turned_body) {
  Matrix3d J;
  J << 0.5, -0.05, 0.04, -0.05, 0.7, -0.06, 0.04, -0.06, 0.6;  // off the diagonal the tensor is −IP
  const Vector3d v(0.4, -0.3, 1.2), w_local(1.1, 0.6, -0.8);   // W in the axes of CM, those of the part
  const double kinetic = 0.5 * 3 * v.squaredNorm() + 0.5 * w_local.dot(J * w_local);
  const std::string t = tables(
      "Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=1,2,3\nPART/2, MASS=3, CM=20, "
      "IP=0.5,0.7,0.6,0.05,-0.04,0.06, QG=1,2,3, REULER=0.4,0.9,-0.7, VX=0.4, VY=-0.3, VZ=1.2, WX=1.1, WY=0.6, "
      "WZ=-0.8\nMARKER/20, QP=0.2,-0.3,0.1\nMARKER/21, REULER=0.7,-0.9,-0.4\n"
      "BUSHING/1, I=21, J=1, K=500,700,900, KT=30,40,50, C=1,2,3, CT=0.1,0.2,0.3\nEND\n",
      "ENERGY_PER_MODE=ALL");
  for (const char* label : {"Sum", "Model"}) EXPECT_NEAR(row(t, "Energies per mode", label)[0], kinetic, 1e-11);
}

// Equal frequencies coupled one way: x″ = −(k/m) x, y″ = −(k/m) y + (c/m) x has one shape, (0, 1), for both pairs.
// `turn` mixes the two so that the matrix is not triangular.
std::string one_way(double k, double c, double turn) {
  const double s = std::sin(turn), q = std::cos(turn);
  // K = k 1 − c b aᵀ with a = (cos, sin), b = (−sin, cos).
  const std::array<double, 4> K = {k + c * s * q, c * s * s, -c * q * q, k - c * s * q};
  return fmt::format(
      "One way\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, VZ=1\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1, VZ=2\nMARKER/30\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "JOINT/2, TRANSLATIONAL, I=30, J=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION={:.17g}*DZ(20)+{:.17g}*DZ(30)\n"
      "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION={:.17g}*DZ(20)+{:.17g}*DZ(30)\nEND\n",
      -K[0], -K[1], -K[2], -K[3]);
}

class SingularShapes : public ModalSums, public ::testing::WithParamInterface<std::tuple<double, double>> {};

TEST_P(SingularShapes, are_refused_and_no_table_is_written) {
  const auto [coupling, turn] = GetParam();
  const std::string text = one_way(100, coupling, turn);
  const RunResult r = run(text, "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("modal matrix is singular"));
  if (r.wrote("model.txt")) {
    EXPECT_THAT(r.text("model.txt"), Not(HasSubstr("Energies per mode"))) << r.text("model.txt");
  }
}
INSTANTIATE_TEST_SUITE_P(couplings, SingularShapes,
                         ::testing::Combine(::testing::Values(1.0, 30.0, 100.0), ::testing::Values(0.0, 0.5, 2.0)));

// Without the coupling the shapes of the same pair of frequencies are any two, and the energies are fine.
TEST_F(ModalSums, equal_frequencies_are_not_singular) {
  const std::string t = tables(one_way(100, 0, 0.5), "ENERGY_PER_MODE=ALL");
  const Energies model{2.5, 0, 0};
  EXPECT_NEAR(row(t, "Energies per mode", "Sum")[0], model.kinetic, 1e-12);
}

TEST_F(ModalSums, velocity_constraints_are_refused) {
  const RunResult r =
      run("Sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, "
          "VX=1\nMARKER/20\nJOINT/1, PLANAR, I=20, J=1\nGCON/1, FUNCTION=VY(20,0,20)\nEND\n",
          "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("velocity constraints"));
  EXPECT_FALSE(r.wrote("model.txt"));
}

// Masses ------------------------------------------------------------------------------------------------------------

Matrix3d cross_matrix(const Vector3d& p) {
  Matrix3d m;
  m << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
  return m;
}
std::string numbers(const Vector3d& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z()); }

// Bodies in a row on mounts whose ends coincide, all axes parallel to ground's: translation of the origin and rotation
// of each are its six coordinates.
struct Row {
  struct Body {
    double mass;
    Vector3d origin, centre;  // centre from the origin
    Matrix3d inertia;         // about the mass centre
    Vector3d mount;           // from the origin
    Vector3d K, KT;
  };
  std::vector<Body> bodies;
  Vector3d frame_at{0, 0, 0};
  Matrix3d frame = Matrix3d::Identity();
  std::string frame_angles = "0,0,0";

  std::string dataset() const {
    std::string s =
        "Row\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/9, QP=" + numbers(frame_at) + ", REULER=" + frame_angles + "\n";
    for (std::size_t n = 0; n < bodies.size(); ++n) {
      const Body& b = bodies[n];
      const Matrix3d& J = b.inertia;
      const Vector3d at = b.origin + b.mount;
      s +=
          fmt::format("PART/{0}, MASS={1}, CM={0}0, QG={2}, IP={3:.17g},{4:.17g},{5:.17g},{6:.17g},{7:.17g},{8:.17g}\n",
                      n + 2, b.mass, numbers(b.origin), J(0, 0), J(1, 1), J(2, 2), -J(0, 1), -J(0, 2), -J(1, 2));
      s += fmt::format("MARKER/{0}0, QP={1}\nMARKER/{0}1, QP={2}\n", n + 2, numbers(b.centre), numbers(b.mount));
      s += fmt::format("MARKER/{}2, PART={}, QP={}\n", n + 2, n + 1,
                       numbers(n == 0 ? at : Vector3d(at - bodies[n - 1].origin)));
      s += fmt::format("BUSHING/{0}, I={0}1, J={0}2, K={1}, KT={2}\n", n + 2, numbers(b.K), numbers(b.KT));
    }
    return s + "END\n";
  }
  Index size() const { return 6 * static_cast<Index>(bodies.size()); }
  MatrixXd mass() const {
    MatrixXd M = MatrixXd::Zero(size(), size());
    for (std::size_t n = 0; n < bodies.size(); ++n) {
      const Body& b = bodies[n];
      const Matrix3d X = cross_matrix(b.centre);
      auto block = M.block<6, 6>(6 * static_cast<Index>(n), 6 * static_cast<Index>(n));
      block.topLeftCorner<3, 3>() = b.mass * Matrix3d::Identity();
      block.topRightCorner<3, 3>() = -b.mass * X;
      block.bottomLeftCorner<3, 3>() = b.mass * X;
      block.bottomRightCorner<3, 3>() = b.inertia - b.mass * X * X;
    }
    return M;
  }
  MatrixXd stiffness() const {
    MatrixXd K = MatrixXd::Zero(size(), size());
    for (std::size_t n = 0; n < bodies.size(); ++n) {
      const Body& b = bodies[n];
      Eigen::Matrix<double, 6, Eigen::Dynamic> G = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, size());
      const auto motion = [&](std::size_t body, const Vector3d& arm, double sign) {
        const auto c = 6 * static_cast<Index>(body);
        G.block<3, 3>(0, c) = sign * Matrix3d::Identity();
        G.block<3, 3>(0, c + 3) = -sign * cross_matrix(arm);
        G.block<3, 3>(3, c + 3) = sign * Matrix3d::Identity();
      };
      motion(n, b.mount, 1);
      if (n > 0) motion(n - 1, b.origin + b.mount - bodies[n - 1].origin, -1);
      Eigen::Matrix<double, 6, 1> law;
      law << b.K, b.KT;
      K += G.transpose() * law.asDiagonal() * G;
    }
    return K;
  }
  // Columns: along and about the axes of the frame.
  MatrixXd rigid() const {
    MatrixXd r = MatrixXd::Zero(size(), 6);
    for (std::size_t n = 0; n < bodies.size(); ++n) {
      const auto at = 6 * static_cast<Index>(n);
      r.block<3, 3>(at, 0) = frame;
      r.block<3, 3>(at, 3) = -cross_matrix(bodies[n].origin - frame_at) * frame;
      r.block<3, 3>(at + 3, 3) = frame;
    }
    return r;
  }
};

Matrix3d inertia(double xx, double yy, double zz, double xy, double xz, double yz) {
  Matrix3d J;
  J << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return J;
}

Row three_bodies() {
  Row row;
  row.bodies = {{2,
                 {0.5, 0.1, 0.2},
                 {0.1, -0.05, 0.2},
                 inertia(0.2, 0.3, 0.25, 0.02, -0.01, 0.03),
                 {-0.2, 0.1, 0},
                 {900, 700, 1100},
                 {60, 80, 50}},
                {1.2,
                 {1.1, 0, 0.5},
                 {0, 0.15, -0.1},
                 inertia(0.1, 0.12, 0.15, -0.01, 0.02, 0.005),
                 {-0.3, 0, -0.1},
                 {500, 650, 400},
                 {20, 30, 40}},
                {0.7,
                 {1.6, -0.2, 0.9},
                 {0.08, 0.03, 0.04},
                 inertia(0.05, 0.04, 0.06, 0, 0, 0.01),
                 {-0.1, -0.1, -0.2},
                 {300, 250, 350},
                 {9, 7, 11}}};
  return row;
}

Row in_turned_frame(Row row) {
  row.frame_at = {-3, 2, 0.7};
  row.frame = (Eigen::AngleAxisd(0.5, Vector3d::UnitZ()) * Eigen::AngleAxisd(1.1, Vector3d::UnitX()) *
               Eigen::AngleAxisd(-0.3, Vector3d::UnitZ()))
                  .toRotationMatrix();
  row.frame_angles = "0.5,1.1,-0.3";
  return row;
}

// Total mass three times, and the inertia of the whole about the axes of the frame.
std::array<double, 6> of_rigid_model(const Row& row) {
  std::array<double, 6> out{};
  for (const Row::Body& b : row.bodies) {
    const Vector3d p = row.frame.transpose() * (b.origin + b.centre - row.frame_at);
    const Matrix3d J = row.frame.transpose() * b.inertia * row.frame;
    for (Index d = 0; d < 3; ++d) {
      out[static_cast<std::size_t>(d)] += b.mass;
      out[static_cast<std::size_t>(d) + 3] += J(d, d) + b.mass * (p.squaredNorm() - p(d) * p(d));
    }
  }
  return out;
}

class EffectiveMass : public ModalSums, public ::testing::WithParamInterface<bool> {};

TEST_P(EffectiveMass, of_all_modes_is_the_mass_of_the_model) {
  const Row model = GetParam() ? in_turned_frame(three_bodies()) : three_bodies();
  const std::string frame = GetParam() ? " in MARKER/9" : " in global axes";
  const std::string t = tables(model.dataset(), std::string("MASS_PER_MODE=ALL") + (GetParam() ? ", MODAL_RM=9" : ""));
  const MatrixXd M = model.mass(), r = model.rigid();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(model.stiffness(), M);
  const auto whole = of_rigid_model(model);
  for (Index i = 0; i < model.size(); ++i) {
    const VectorXd phi = solver.eigenvectors().col(i);  // φᵀ M φ = 1
    // The coordinates of the tables: mass centres and rotations; the largest is 1.
    double largest = 0;
    for (std::size_t n = 0; n < model.bodies.size(); ++n) {
      const Vector3d u = phi.segment<3>(6 * static_cast<Index>(n)),
                     turn = phi.segment<3>(6 * static_cast<Index>(n) + 3);
      const Vector3d centre = u + turn.cross(model.bodies[n].centre);
      for (const double x : {centre.x(), centre.y(), centre.z(), turn.x(), turn.y(), turn.z()}) {
        if (std::abs(x) > std::abs(largest)) largest = x;
      }
    }
    const std::string mode = std::to_string(i + 1);
    const auto factors = row(t, "Modal participation factors" + frame, mode),
               masses = row(t, "Modal effective mass" + frame, mode);
    ASSERT_EQ(factors.size(), 7u);
    ASSERT_EQ(masses.size(), 6u);
    EXPECT_NEAR(factors[0], 1 / (largest * largest), 1e-9 / (largest * largest)) << mode;
    const VectorXd L = r.transpose() * M * phi;
    for (std::size_t d = 0; d < 6; ++d) {
      const double l = L(static_cast<Index>(d));
      EXPECT_NEAR(factors[d + 1], l * largest, 1e-9 * std::abs(largest) * std::sqrt(whole[d])) << mode;
      EXPECT_NEAR(masses[d], l * l, 1e-9 * whole[d]) << mode;
    }
  }
  for (const char* label : {"Sum", "Model"}) {
    const auto values = row(t, "Modal effective mass" + frame, label);
    for (std::size_t d = 0; d < 6; ++d) EXPECT_NEAR(values[d], whole[d], 1e-10 * whole[d]) << label;
  }
  EXPECT_THAT(labels(t, "Modal participation factors" + frame), Not(::testing::Contains("imag.")));
}
INSTANTIATE_TEST_SUITE_P(frames, EffectiveMass, ::testing::Bool());

TEST_F(ModalSums, masses_in_percent_of_the_modes_asked_for) {
  const Row model = three_bodies();
  const MatrixXd M = model.mass();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(model.stiffness(), M);
  const MatrixXd L = model.rigid().transpose() * M * solver.eigenvectors();
  const std::string t = tables(model.dataset(), "MASS_PER_MODE=3,5"), title = "Modal effective mass";
  const auto rows = table(t, title);
  ASSERT_EQ(rows.size(), 8u);  // two a mode, Sum, Model
  for (std::size_t d = 0; d < 6; ++d) {
    const auto squares = [&](Index mode) { return L(static_cast<Index>(d), mode) * L(static_cast<Index>(d), mode); };
    const double sum = squares(2) + squares(3) + squares(4);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(rows[2 * k].first, std::to_string(k + 3));
      EXPECT_NEAR(rows[2 * k + 1].second[d], 100 * squares(static_cast<Index>(k) + 2) / sum, 1e-7);
    }
    EXPECT_NEAR(rows[6].second[d], sum, 1e-9 * of_rigid_model(model)[d]);
    EXPECT_NEAR(rows[7].second[d], of_rigid_model(model)[d], 1e-10 * of_rigid_model(model)[d]);
  }
}

// Two equal masses on equal mounts next to each other: every frequency comes twice (those of one mass are equal, too),
// shapes are any combinations, and yet masses sum up once.
TEST_F(ModalSums, repeated_frequencies_count_once) {
  Row model;
  for (const double y : {-1.0, 1.0})
    model.bodies.push_back({2,
                            {0, y, 0.3},
                            {0, 0, 0},
                            0.8 * Matrix3d::Identity(),
                            {0, 0, 0},
                            {500, 500, 500},
                            {500 * 0.4, 500 * 0.4, 500 * 0.4}});
  // Both on ground.
  std::string s = model.dataset();
  const std::string second = "MARKER/32, PART=2, QP=0,2,0";
  ASSERT_NE(s.find(second), std::string::npos);
  s.replace(s.find(second), second.size(), "MARKER/32, PART=1, QP=0,1,0.3");
  const RunResult r = run(s, "LINEAR/EIGENSOL, MASS_PER_MODE=ALL, TABLE_PRECISION=14\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.eigenvalues(0);
  for (const auto& v : values) EXPECT_NEAR(std::abs(v), std::sqrt(250.0) / 2 / 3.14159265358979324, 1e-12);
  const std::string t = r.text("model.txt");
  const auto whole = of_rigid_model(model);
  const auto sum = row(t, "Modal effective mass", "Sum");
  for (std::size_t d = 0; d < 6; ++d) EXPECT_NEAR(sum[d], whole[d], 1e-10 * whole[d]);
  for (int i = 1; i <= 12; ++i) {
    const auto factors = row(t, "Modal participation factors", std::to_string(i)),
               masses = row(t, "Modal effective mass", std::to_string(i));
    // All masses and inertias lie between 0.8 and 2: a shape with largest entry 1 holds between 0.8 and 2·(6 + 6).
    EXPECT_GE(factors[0], 0.8 - 1e-12) << i;
    for (std::size_t d = 0; d < 6; ++d)
      EXPECT_NEAR(masses[d], factors[d + 1] * factors[d + 1] * factors[0], 1e-10 * whole[d]) << i;
  }
}

// Discrete cantilever: n equal rods in a plane with rotational springs between them, coordinates the angles. The first
// mode of a long one carries about 61 % of the mass across.
TEST_F(ModalSums, first_mode_of_a_cantilever) {
  constexpr int n = 12;
  const double l = 1.0 / n, m = 1.0 / n, J = m * l * l / 12, k = n;
  std::string s = "Cantilever\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int i = 0; i < n; ++i) {
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}0, IP={2:.17g},{2:.17g},{2:.17g}, QG={3:.17g},0,0\nMARKER/{0}0, "
        "QP={4:.17g},0,0\nMARKER/{0}1\nMARKER/{0}2, QP={5:.17g},0,0\nJOINT/{0}, REVOLUTE, I={0}1, J={6}\n"
        "SPRINGDAMPER/{0}, ROTATION, I={0}1, J={6}, KT={7}\n",
        i + 2, m, J, i * l, l / 2, l, i == 0 ? std::string("1") : fmt::format("{}2", i + 1), k);
  }
  const std::string t = tables(s + "END\n", "MASS_PER_MODE=1");
  // Rod i has the angle θ_i; its mass centre moves across by l Σ_{j<i} θ_j + l/2 θ_i.
  MatrixXd B = MatrixXd::Zero(n, n), D = MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) B(i, j) = l;
    B(i, i) = l / 2;
    if (i > 0) D(i, i - 1) = -1;
  }
  const MatrixXd M = m * B.transpose() * B + J * MatrixXd::Identity(n, n), K = k * D.transpose() * D;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(K, M);
  const VectorXd phi = solver.eigenvectors().col(0);
  const double across = m * (B * phi).sum();
  double about = 0;
  for (int i = 0; i < n; ++i) about += m * (i + 0.5) * l * (B.row(i) * phi)(0) + J * phi(i);
  const auto masses = row(t, "Modal effective mass", "1"), whole = row(t, "Modal effective mass", "Model");
  EXPECT_NEAR(masses[1], across * across, 1e-11);
  EXPECT_NEAR(masses[5], about * about, 1e-11);
  for (const std::size_t d : {0u, 2u, 3u, 4u}) EXPECT_NEAR(masses[d], 0, 1e-12);
  EXPECT_NEAR(whole[1], 1, 1e-12);
  EXPECT_NEAR(whole[5], 1.0 / 3, 1e-12);
  EXPECT_NEAR(masses[1], 0.613, 0.03);  // of the continuous beam
  const double tip = phi.cwiseAbs().maxCoeff();
  const auto factors = row(t, "Modal participation factors", "1");
  EXPECT_NEAR(factors[0], 1 / (tip * tip), 1e-10);
  EXPECT_NEAR(std::abs(factors[2]), std::abs(across * tip), 1e-11);
  EXPECT_NEAR(factors[2] * factors[6], across * about * tip * tip, 1e-11);
}

}  // namespace
}  // namespace dynalin::cases
