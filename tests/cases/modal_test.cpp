// Modal tables, their headers and the second-order matrices, against published blocks and hand computations.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <numbers>

#include "cases/dataset_text.h"
#include "places/source_tree.h"

namespace dynalin::cases::modal_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Modal : public Cases {
 protected:
  // Numbers of the row that begins with the label, in the n-th table with the title.
  static std::vector<double> row(const std::string& text, const std::string& title, const std::string& label,
                                 int n = 0) {
    std::size_t at = 0;
    for (int k = 0; k <= n; ++k) {
      at = text.find(title, at + 1);
      if (at == std::string::npos) return {};
    }
    at = text.find("\n  " + label, at);
    if (at == std::string::npos) return {};
    const std::size_t bar = text.find('|', at), end = text.find('\n', at + 1);
    std::string cells = text.substr(bar + 1, end - bar - 1);
    std::replace(cells.begin(), cells.end(), '|', ' ');
    std::istringstream in(cells);
    std::vector<double> values;
    for (double v = 0; in >> v;) values.push_back(v);
    return values;
  }
};

TEST_F(Modal, header_of_two_masses_between_walls) {
  const RunResult r =
      run("Two masses\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,3\nPART/2, MASS=1, CM=20, "
          "IP=1,1,1, QG=0,0,1\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=0,0,2\nMARKER/30\n"
          "JOINT/1, TRANSLATIONAL, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=30, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, "
          "J=1, K=1E4, LENGTH=1\nSPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=1E4, LENGTH=1\n"
          "SPRINGDAMPER/3, TRANSLATIONAL, I=2, J=30, K=1E4, LENGTH=1\nEND\n",
          "linear/eigen, coords=1,2, kinetic=1,2, dissipat=1,2, strain=1,2\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string t = r.text("model.txt");
  EXPECT_THAT(t, HasSubstr("  Energy table for MODE 1\n"));
  EXPECT_THAT(t, HasSubstr("  Undamped natural freq. =    1.59155E+01 Cycles per unit time\n"
                           "  Generalized stiffness  =    2.00000E+00 User mass/time^2\n"
                           "  Generalized mass       =    2.00000E-04 User mass\n"
                           "  Kinetic energy         =    1.00000E+00 User mass/time^2\n"));
  EXPECT_THAT(row(t, "Normalized coordinates", "PART/3"), ::testing::ElementsAre(0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(row(t, "Normalized coordinates", "PART/3", 1),
              ::testing::ElementsAre(0, 0, 0, 0, 1, 180, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(row(t, "of Kinetic energy", "PART/2"), ::testing::ElementsAre(0, 0, 50, 0, 0, 0, 0, 0, 0, 50));
  EXPECT_THAT(row(t, "strain energy", "SPRI/1"), ::testing::ElementsAre(50, 0, 0, 50));
  EXPECT_THAT(row(t, "strain energy", "SPRI/2"), ::testing::ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(row(t, "strain energy", "SPRI/2", 1), ::testing::ElementsAre(66.67, 0, 0, 66.67));
  EXPECT_THAT(row(t, "dissipative energy", "SPRI/1"), ::testing::ElementsAre(0, 0, 0, 0));
}

TEST_F(Modal, published_headers_of_the_pendulum_in_both_coordinates) {
  std::filesystem::copy(examples_folder() / "spring_pendulum", folder_,
                        std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
  const std::string file = "spring_pendulum.acf";
  std::string commands = read_file(folder_ / file);
  const std::string word = "EIGENSOL";
  for (std::size_t at = commands.find(word); at != std::string::npos; at = commands.find(word, at + word.size())) {
    commands.insert(at + word.size(), ", COORDS=1");
  }
  write(file, commands);
  const RunResult r = run_file(file);
  ASSERT_EQ(r.status, 0) << r.err << commands;
  std::string t;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() == ".txt") t = read_file(entry.path());
  }
  EXPECT_THAT(
      t,
      HasSubstr(
          "  Damping ratio          =    4.67704E-02\n  Undamped natural freq. =    9.59339E-01 Cycles per unit time\n"
          "  Generalized stiffness  =    1.74065E+05 User mass/time^2\n  Generalized mass       =    4.79080E+03 User "
          "mass\n"
          "  Kinetic energy         =    8.70325E+04 User mass/time^2\n"));
  EXPECT_THAT(t, HasSubstr("  Generalized stiffness  =    4.09672E+00 User mass/time^2\n  Generalized mass       =    "
                           "1.12754E-01 User mass\n"
                           "  Kinetic energy         =    2.04836E+00 User mass/time^2\n"));
}

// Three masses in a row with different dampers; what each damper dissipates is c |Δv|².
TEST_F(Modal, dissipation_of_a_damped_chain_by_hand) {
  const std::array<double, 3> m = {1, 2, 1.5}, k = {400, 300, 500}, c = {2, 5, 1};
  std::string s = "Chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int n = 0; n < 3; ++n) {
    s += fmt::format(
        "PART/{0}, MASS={1}, CM={0}0, IP=1,1,1, QG=0,0,{2}\nMARKER/{0}0\nJOINT/{0}, TRANSLATIONAL, I={0}0, J=1\n",
        n + 2, m[static_cast<std::size_t>(n)], n + 1);
    s += fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}0, J={}, K={}, C={}, LENGTH=1\n", n + 1, n + 2,
                     n == 0 ? 1 : 10 * (n + 1), k[static_cast<std::size_t>(n)], c[static_cast<std::size_t>(n)]);
  }
  const RunResult r = run(s + "END\n", "LINEAR/EIGENSOL, STRAIN=1,3, DISSIPAT=1,3, KINETIC=1,3, TABLE_PRECISION=9\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string t = r.text("model.txt");
  Eigen::Matrix3d K, C;
  const auto tri = [](const std::array<double, 3>& x) {
    Eigen::Matrix3d T;
    T << x[0] + x[1], -x[1], 0, -x[1], x[1] + x[2], -x[2], 0, -x[2], x[2];
    return T;
  };
  K = tri(k), C = tri(c);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
  const Eigen::Vector3d inverse(1 / m[0], 1 / m[1], 1 / m[2]);
  A.topRightCorner<3, 3>().setIdentity();
  A.bottomLeftCorner<3, 3>() = -(inverse.asDiagonal() * K);
  A.bottomRightCorner<3, 3>() = -(inverse.asDiagonal() * C);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index n = 0; n < 6; ++n) {
    if (solver.eigenvalues()(n).imag() > 0) order.emplace_back(solver.eigenvalues()(n).imag(), n);
  }
  std::sort(order.begin(), order.end());
  for (int mode = 0; mode < 3; ++mode) {
    const Eigen::Vector3cd u = solver.eigenvectors().col(order[static_cast<std::size_t>(mode)].second).head<3>();
    std::array<double, 3> stretch = {std::norm(u(0)), std::norm(u(1) - u(0)), std::norm(u(2) - u(1))};
    double strain = 0, power = 0, kinetic = 0;
    for (std::size_t n = 0; n < 3; ++n)
      strain += k[n] * stretch[n], power += c[n] * stretch[n],
          kinetic += m[n] * std::norm(u(static_cast<Eigen::Index>(n)));
    for (std::size_t n = 0; n < 3; ++n) {
      const std::string label = "SPRI/" + std::to_string(n + 1);
      EXPECT_NEAR(row(t, "strain energy", label, mode).at(0), 100 * k[n] * stretch[n] / strain, 1e-6);
      EXPECT_NEAR(row(t, "dissipative energy", label, mode).at(0), 100 * c[n] * stretch[n] / power, 1e-6);
      EXPECT_NEAR(row(t, "of Kinetic energy", "PART/" + std::to_string(n + 2), mode).at(9),
                  100 * m[n] * std::norm(u(static_cast<Eigen::Index>(n))) / kinetic, 1e-6);
    }
  }
}

// A mass on inclined springs; one of them is a force that sees the displacement through two VARIABLEs.
TEST_F(Modal, strain_follows_variables_between_force_and_displacement) {
  const auto text = [](bool by_variable) {
    return std::string(
               "Inclined\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=1,0,0\nMARKER/2, QP=-0.5,0.8,0\nMARKER/3, "
               "QP=0,0,1\nPOINT_MASS/2, MASS=2, CM=20\nMARKER/20\n"
               "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\nSPRINGDAMPER/3, TRANSLATIONAL, I=20, J=3, "
               "K=70, LENGTH=1\n") +
           (by_variable ? "VARIABLE/1, FUNCTION=DM(20,2)\nVARIABLE/2, FUNCTION=VARVAL(1)-SQRT(0.89)\nSFORCE/2, "
                          "TRANSLATIONAL, I=20, J=2, FUNCTION=-250*VARVAL(2)\n"
                        : "SPRINGDAMPER/2, TRANSLATIONAL, I=20, J=2, K=250, LENGTH=0.94339811320566038\n") +
           "END\n";
  };
  const std::string commands = "LINEAR/EIGENSOL, STRAIN=1,3, KINETIC=1,3, TABLE_PRECISION=8\n";
  const RunResult spring = run(text(false), commands);
  const std::string by_spring = spring.text("model.txt");
  const RunResult variable = run(text(true), commands);
  const std::string by_variable = variable.text("model.txt");
  ASSERT_EQ(spring.status + variable.status, 0) << spring.err << variable.err;
  for (int mode = 0; mode < 3; ++mode) {
    const auto a = row(by_spring, "strain energy", "SPRI/2", mode),
               b = row(by_variable, "strain energy", "SFOR/2", mode);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-6);
    double total = 0;
    for (const char* label : {"SPRI/1", "SPRI/2", "SPRI/3"})
      total += row(by_spring, "strain energy", label, mode).at(0);
    EXPECT_NEAR(total, 100, 1e-6);
  }
}

// −300 (z − τ z′): stiffness like a spring, and damping of the wrong sign.
TEST_F(Modal, a_delayed_force_stores_energy_and_feeds_power) {
  const RunResult r =
      run("Delayed\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,-1\nPART/2, MASS=2, CM=20, IP=1,1,1\n"
          "MARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
          "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=100, C=5, LENGTH=1\n"
          "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-300*DELAY(DZ(20,1),0.01,0)\nEND\n",
          "LINEAR/EIGENSOL, STRAIN=1, DISSIPAT=1, TABLE_PRECISION=9\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string t = r.text("model.txt");
  EXPECT_NEAR(row(t, "strain energy", "SPRI/1", 0).at(0), 25, 1e-6);
  EXPECT_NEAR(row(t, "strain energy", "SFOR/1", 0).at(0), 75, 1e-6);
  EXPECT_NEAR(row(t, "dissipative energy", "SPRI/1", 0).at(0), 250, 1e-6);
  EXPECT_NEAR(row(t, "dissipative energy", "SFOR/1", 0).at(0), -150, 1e-6);
}

TEST_F(Modal, tables_of_a_moving_mechanism_add_up_to_a_hundred) {
  const RunResult r = run(
      two_bodies("BUSHING/1, I=31, J=21, K=30,50,20, KT=4,6,3, C=1,0.5,2, CT=0.2,0.1,0.3\nDIFF/7, "
                 "FUNCTION=-DIF(7)+DX(31)\nSFORCE/1, ROTATIONAL, ACTIONONLY, I=30, J=30, FUNCTION=-2*WZ(30)+DIF(7)\n"),
      "LINEAR/EIGENSOL, COORDS=1,13, KINETIC=1,13, STRAIN=1,13, DISSIPAT=1,13, TABLE_PRECISION=10, NAMES\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string t = r.text("model.txt");
  for (int mode = 0; mode < 6; ++mode) {
    double kinetic = 0, strain = 0, power = 0;
    for (const char* part : {"PART/2", "PART/3"}) kinetic += row(t, "of Kinetic energy", part, mode).at(9);
    for (const char* label : {"BUSH/1", "SFOR/1", "SPRI/1", "SPRI/2", "SPRI/3", "SPRI/4", "SPRI/5", "SPRI/6"}) {
      strain += row(t, "strain energy", label, mode).at(0), power += row(t, "dissipative energy", label, mode).at(0);
    }
    EXPECT_NEAR(kinetic, 100, 1e-7);
    EXPECT_NEAR(strain, 100, 1e-7);
    EXPECT_NEAR(power, 100, 1e-7);
    EXPECT_EQ(row(t, "Normalized coordinates", "DIFF/7", mode).size(), 2u);
  }
}

TEST_F(Modal, markers_move_with_their_bodies) {
  const RunResult r = run(
      two_bodies(""),
      "LINEAR/EIGENSOL, COORDS=3, MLIST=20,21,1, MRANGE=3, TABLE_PRECISION=9\nLINEAR/EIGENSOL, MLIST=77, MRANGE=1\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("MARKER/77"));
  const RunResult sound =
      run(two_bodies(""), "LINEAR/EIGENSOL, COORDS=3, MLIST=20,21,1, MRANGE=3, TABLE_PRECISION=9\n");
  ASSERT_EQ(sound.status, 0) << sound.err;
  const std::string t = sound.text("model.txt");
  // MARKER/20 is the mass centre of PART/2; ground does not move; MARKER/21 turns with the part.
  const auto part = row(t, "Normalized coordinates", "PART/2"), centre = row(t, "Marker mode table", "MARKER/20"),
             other = row(t, "Marker mode table", "MARKER/21");
  EXPECT_EQ(part, centre);
  EXPECT_EQ(row(t, "Marker mode table", "MARKER/1 "), std::vector<double>(12, 0.0));
  ASSERT_EQ(other.size(), 12u);
  EXPECT_NE(other[0], part[0]);
  for (std::size_t k = 6; k < 12; ++k) EXPECT_EQ(other[k], part[k]);
}

// Below the title of View a model has a name, and a marker that of its part.
TEST_F(Modal, names_of_view_are_whole) {
  const std::string wheel =
      "\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n! adams_view_name='wheel'\nPART/2, MASS=1, CM=20, IP=1,1,1\n"
      "! adams_view_name='cm'\nMARKER/20\n! adams_view_name='tire'\nBUSHING/1, I=20, J=1, K=9,9,9, KT=1,1,1\nEND\n";
  const std::string command = "LINEAR/EIGENSOL, COORDS=1, STRAIN=1, MRANGE=1, MLIST=20, TABLE_PRECISION=4, NAMES\n";
  const auto table = [&](const std::string& title) {
    const RunResult r = run(title + wheel, command);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.text("model.txt");
  };
  const std::string car = table("ADAMS/View model name: car");
  for (const char* name : {"| car.wheel\n", "| car.wheel.cm\n", "| car.tire\n"}) EXPECT_THAT(car, HasSubstr(name));
  EXPECT_THAT(table("A car"), HasSubstr("| cm\n"));
}

// A dot in a name does not make it whole, as those of what View makes by the way (SPRING_1.sforce); the model's does.
TEST_F(Modal, names_of_view_with_dots_are_whole_as_well) {
  const RunResult r = run(
      "ADAMS/View model name: car\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n! "
      "adams_view_name='front.wheel'\nPART/2, "
      "MASS=1, CM=20, IP=1,1,1\n! adams_view_name='front.wheel.cm'\nMARKER/20\n! adams_view_name='car.tire'\n"
      "BUSHING/1, I=20, J=1, K=9,9,9, KT=1,1,1\n! adams_view_name='stop.sforce'\nSFORCE/1, TRANSLATIONAL, I=20, J=1, "
      "ACTIONONLY, FUNCTION=-DZ(20)\nEND\n",
      "LINEAR/EIGENSOL, COORDS=1, STRAIN=1, MRANGE=1, MLIST=20, TABLE_PRECISION=4, NAMES\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string t = r.text("model.txt");
  for (const char* name : {"| car.front.wheel\n", "| car.front.wheel.cm\n", "| car.tire\n", "| car.stop.sforce\n"})
    EXPECT_THAT(t, HasSubstr(name));
}

TEST_F(Modal, ranges_of_frequency_that_hold_no_mode_are_warned_of) {
  const RunResult r = run(two_bodies(""), "LINEAR/EIGENSOL, FKINETIC=1000,2000\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("FKINETIC asks for modes between 1000 and 2000 cycles/s, none is there"));
}

TEST_F(Modal, ranges_of_frequency_skip_real_modes) {
  const RunResult r = run(two_bodies("DIFF/7, FUNCTION=-DIF(7)\n"),
                          "LINEAR/EIGENSOL, FKINETIC=0.0001,1000\nLINEAR/EIGENSOL, KINETIC=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string t = r.text("model.txt");
  std::size_t tables = 0, complex = 0;
  for (std::size_t at = t.find("of Kinetic energy\n"); at != std::string::npos;
       at = t.find("of Kinetic energy\n", at + 1))
    ++tables;
  for (const auto& v : r.eigenvalues(0)) complex += v.imag() > 0;
  EXPECT_EQ(tables, complex + 1);
}

TEST_F(Modal, second_order_matrices_have_the_same_transfer_function) {
  const std::string more =
      "VARIABLE/1, FUNCTION=0\nVARIABLE/2, FUNCTION=DX(31,21)+0.1*VY(30)+0.3*VARVAL(1)\nVARIABLE/3, "
      "FUNCTION=DIF(1)+ACCZ(30)\nSFORCE/1, TRANSLATIONAL, I=30, J=20, FUNCTION=VARVAL(1)+2*DIF(1)\n"
      "DIFF/1, FUNCTION=-2*DIF(1)+VARVAL(2)\nPINPUT/4, VARIABLES=1\nPOUTPUT/5, VARIABLES=2,3\n";
  const RunResult r = run(two_bodies(more),
                          "LINEAR/STATEMAT, FILE=s, PINPUT=4, POUTPUT=5\nLINEAR/MKB, FILE=k, PINPUT=4, "
                          "POUTPUT=5\nLINEAR/MKB, FILE=k2, FORMAT=MATLAB, PINPUT=4, POUTPUT=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto get = [&](std::size_t n, const char* name) {
    const auto rows = r.matrix(n, name);
    Eigen::MatrixXcd m(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows[0].size()));
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    return m;
  };
  const Eigen::MatrixXcd A = get(0, "A"), B = get(0, "B"), C = get(0, "C"), D = get(0, "D");
  const Eigen::MatrixXcd M = get(1, "M"), damping = get(1, "B"), K = get(1, "K"), P = get(1, "P"), C2 = get(1, "C"),
                         D2 = get(1, "D");
  const auto n = M.rows();
  for (const std::complex<double> s : {std::complex(0.3, 5.0), std::complex(-1.0, 0.7), std::complex(2.0, 30.0)}) {
    const Eigen::MatrixXcd I = Eigen::MatrixXcd::Identity(A.rows(), A.rows());
    const Eigen::MatrixXcd first = C * (s * I - A).lu().solve(B) + D;
    const Eigen::MatrixXcd second =
        (C2.leftCols(n) + s * C2.rightCols(n)) * (s * s * M + s * damping + K).lu().solve(P) + D2;
    EXPECT_LE((first - second).norm(), 1e-10 * first.norm());
  }
  for (const char* name : {"k", "k2m", "k2kb", "k2p", "k2c", "k2d", "k2st", "k2pi", "k2po"})
    EXPECT_TRUE(r.wrote(name)) << name;
  EXPECT_THAT(r.text("k"), HasSubstr("KB "));
}

TEST_F(Modal, second_order_form_is_refused_with_velocity_constraints) {
  const RunResult r =
      run("Sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, "
          "VX=1\nMARKER/20\nJOINT/1, PLANAR, I=20, J=1\nGCON/1, FUNCTION=VY(20,0,20)\nEND\n",
          "LINEAR/MKB, FILE=k\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("velocity constraints"));
  EXPECT_FALSE(r.wrote("k"));
}

TEST_F(Modal, every_mode_says_how_sensitive_and_how_exact_it_is) {
  const RunResult r =
      run(two_bodies("BUSHING/1, I=31, J=21, K=30,50,20, KT=4,6,3, C=1,0.5,2, CT=0.2,0.1,0.3\n"), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  for (const auto& m : r.result(0).at("modes")) {
    EXPECT_GE(m.at("condition").get<double>(), 1.0 - 1e-12);
    EXPECT_LT(m.at("backward_error").get<double>(), 1e-14);
    EXPECT_EQ(m.at("vector").size(), r.labels(0).size());
  }
}

}  // namespace
}  // namespace dynalin::cases::modal_test
