// MASS_PER_MODE against modes and matrices computed here from the data of each model.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "cases/modal_sums_cases.h"

namespace dynalin::cases::modal_masses_test {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;
using ::testing::Not;
using Index = Eigen::Index;
using ModalMasses = ModalSumCases;

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

class EffectiveMass : public ModalMasses, public ::testing::WithParamInterface<bool> {};

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

TEST_F(ModalMasses, masses_in_percent_of_the_modes_asked_for) {
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
TEST_F(ModalMasses, repeated_frequencies_count_once) {
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
TEST_F(ModalMasses, first_mode_of_a_cantilever) {
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

// Three oscillators on a base of high stiffness, whose frequencies differ by a few roundings: each moves alone, and
// together they have the mass of the model.
TEST_F(ModalMasses, of_oscillators_that_roundings_alone_tell_apart) {
  for (const double apart : {0.0, 1e-14, 1e-12}) {
    std::string s =
        "Oscillators\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/4, MASS=1000, CM=40, IP=1,2,3\nMARKER/40\n"
        "BUSHING/4, I=40, J=1, K=1E16,1.3E16,1.7E16, KT=2.3E16,2.9E16,3.1E16\n";
    for (int n = 0; n < 3; ++n) {
      const int id = n < 2 ? n + 2 : 5;
      const double k = 1 + n * apart;
      s += fmt::format(
          "PART/{0}, MASS=1, CM={0}0, IP=1,2,3, QG={1},0.3,0.7, REULER=0.3,0.4,0.5\nMARKER/{0}0\n"
          "MARKER/{0}1, PART=4, QP={1},0.3,0.7, REULER=0.3,0.4,0.5\n"
          "BUSHING/{0}, I={0}0, J={0}1, K={2:.17g},{3:.17g},{4:.17g}, KT={5:.17g},{6:.17g},{7:.17g}\n",
          id, n, k, 1.3 * k, 1.7 * k, 2.3 * k, 2.9 * k, 3.1 * k);
    }
    const std::string t = tables(s + "END\n", "MASS_PER_MODE=ALL");
    const auto sum = row(t, "Modal effective mass", "Sum"), whole = row(t, "Modal effective mass", "Model");
    for (std::size_t d = 0; d < 6; ++d) EXPECT_NEAR(sum[d], whole[d], 1e-9 * whole[d]) << apart << " " << d;
  }
}

// A body of 1 kg at its held end and 2 kg that its only mode moves away, by 1 a unit: no body moves in it.
TEST_F(ModalMasses, of_a_body_that_bends_about_the_node_that_holds_it) {
  std::string s =
      "Lump\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
      "FLEX_BODY/2, MATRICES=1,2,3,4,5,6,7,8,9,10,11,12,13, CRATIO=0\nMARKER/21, NODE_ID=1\n"
      "JOINT/1, FIXED, I=21, J=1\nPART/3, MASS=5, CM=30, IP=1,1,1, QG=3,0,0\nMARKER/30\nMARKER/9, PART=1, QP=3,0,0\n"
      "BUSHING/1, I=30, J=9, K=10,20,30, KT=40,50,60\n";
  struct Data {
    const char* name;
    int rows, columns;
    const char* values;
  };
  int number = 0;
  for (const Data& m : std::initializer_list<Data>{{"SELNOD", 2, 4, "1,0,0,0, 2,1,0,0"},
                                                   {"T_MODE", 6, 1, "0,0,0,1,0,0"},
                                                   {"R_MODE", 6, 1, "0,0,0,0,0,0"},
                                                   {"GENSTIFF", 1, 1, "800"},
                                                   {"INVAR1", 1, 1, "3"},
                                                   {"INVAR2", 3, 1, "2,0,0"},
                                                   {"INVAR3", 3, 1, "2,0,0"},
                                                   {"INVAR4", 3, 1, "0,0,0"},
                                                   {"INVAR5", 3, 1, "0,0,0"},
                                                   {"INVAR6", 1, 1, "2"},
                                                   {"INVAR7", 3, 3, "0.1,0,0, 0,2,0, 0,0,2"},
                                                   {"INVAR8", 3, 3, "0,0,0, 0,-2,0, 0,0,-2"},
                                                   {"INVAR9", 3, 3, "0,0,0, 0,-2,0, 0,0,-2"}})
    s += fmt::format("MATRIX/{}, NAME={}, FULL=RORDER, ROWS={}, COLUMNS={}, VALUES={}\n", ++number, m.name, m.rows,
                     m.columns, m.values);
  const std::string t = tables(s + "END\n", "MASS_PER_MODE=ALL");
  const auto factors = row(t, "Modal participation factors", "7"), masses = row(t, "Modal effective mass", "7"),
             sum = row(t, "Modal effective mass", "Sum");
  EXPECT_NEAR(factors[0], 2, 1e-12);
  for (std::size_t d = 0; d < 6; ++d) {
    EXPECT_NEAR(std::abs(factors[d + 1]), d == 0 ? 1 : 0, 1e-12) << d;
    EXPECT_NEAR(masses[d], d == 0 ? 2 : 0, 1e-12) << d;
  }
  EXPECT_NEAR(sum[0], 5 + 2, 1e-10);
}

}  // namespace
}  // namespace dynalin::cases::modal_masses_test
