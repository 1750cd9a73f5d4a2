// Tables of modes in which something is zero but for rounding: it has no share, whatever units and angles are.
#include <gmock/gmock.h>

#include "cases/modal_sums_cases.h"

namespace dynalin::cases::rounding_shares_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using RoundingShares = ModalSumCases;

// A slider on a plane at odd angles, on springs; a controller pushes it along MARKER/4.
std::string slider(const std::string& direction, const std::string& state, const std::string& force) {
  return "Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=1.91,0.81,0.12\nMARKER/4, REULER=" + direction +
         "\nMARKER/3, QP=1,.2,.3\nPART/2, MASS=1, VX=1, VY=.5, CM=20, IP=1,1,1\nMARKER/20\n"
         "MARKER/21, REULER=1.91,0.81,0.12\nMARKER/22, QP=.1,.3,.2\nMARKER/23, QP=.2,-.3,.1\nJOINT/1, PLANAR, I=21, "
         "J=1\n"
         "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=3, K=10, C=.1, LENGTH=1\n"
         "SPRINGDAMPER/2, TRANSLATIONAL, I=22, J=3, K=10, C=.1, LENGTH=1\n"
         "SPRINGDAMPER/3, TRANSLATIONAL, I=23, J=3, K=10, C=.1, LENGTH=1\n"
         "DIFF/7, FUNCTION=" +
         state + "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=4, FUNCTION=" + force + "\nEND\n";
}
const std::string along_normal = "1.91,0.81,0.17", aside = "0.3,0.7,0.9";

TEST_F(RoundingShares, a_controller_that_pushes_against_a_guide_moves_no_mass) {
  const std::string still = slider(along_normal, "-0.1*DIF(7)+DX(20)", "-5*DIF(7)"),
                    without = slider(along_normal, "-0.1*DIF(7)+DX(20)", "0");
  const std::string tables = ", KINETIC=1,9, DISSIPAT=1,9, STRAIN=1,9, MASS_PER_MODE=ALL, TABLE_PRECISION=5";
  for (const char* option : {"", ", ORIGINAL", ", RM=20", ", NMODES=6, NEAR=0.05"}) {
    SCOPED_TRACE(option);
    const std::string command = "LINEAR/EIGENSOL" + tables + option + "\n";
    const RunResult r = run(still, command);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& modes = r.result(0).at("modes");
    std::size_t of_controller = 0;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      if (modes[k].at("moves_most") != "DIFF/7") continue;
      of_controller = k + 1;
      for (std::size_t e = 0; e < 6; ++e) EXPECT_EQ(modes[k].at("shape")[e][0], 0) << e;
    }
    ASSERT_GT(of_controller, 0u) << modes;
    const std::string text = r.text("model.txt");
    const std::string mode = std::to_string(of_controller);
    for (const double x : row(text, "Modal effective mass", mode)) EXPECT_EQ(x, 0);
    EXPECT_THAT(text, HasSubstr("Mode " + mode + ": nothing that has mass moves."));
    EXPECT_THAT(text, HasSubstr("Nothing that has mass moves in this mode."));
  }
  // What the slider does is as without the force.
  const auto sum_of = [&](const std::string& model) {
    const RunResult r = run(model, "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL, TABLE_PRECISION=9\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return row(r.text("model.txt"), "Energies per mode", "Model");
  };
  const std::vector<double> one = sum_of(still), other = sum_of(without);
  ASSERT_EQ(one.size(), 6u);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 1e-9 * std::abs(other[k])) << k;
}

TEST_F(RoundingShares, energies_do_not_depend_on_the_units_of_a_controller) {
  std::vector<std::vector<double>> rows;
  for (const char* unit : {"1", "1E9", "1E18", "1E-18"}) {
    const RunResult r =
        run(slider(aside, std::string("-0.1*DIF(7)+") + unit + "*DX(20)", std::string("-0.1*DIF(7)/") + unit),
            "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL, TABLE_PRECISION=9\n");
    ASSERT_EQ(r.status, 0) << unit << r.err;
    std::vector<double> all;
    for (const char* mode : {"1", "4", "5", "Model"}) {
      for (const double x : row(r.text("model.txt"), "Energies per mode", mode)) all.push_back(x);
    }
    rows.push_back(all);
  }
  for (const auto& other : rows) {
    ASSERT_EQ(other.size(), rows[0].size());
    for (std::size_t k = 0; k < other.size(); ++k)
      EXPECT_NEAR(other[k], rows[0][k], 1e-7 * std::abs(rows[0][k]) + 1e-9);
  }
}

// What an integration leaves of velocities where nothing moves is no energy.
TEST_F(RoundingShares, a_point_that_rests_behind_a_simulation_has_no_energy_to_share) {
  const std::string pair =
      "Pair\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=40, CM=20, IP=1,1,1, QG=0,0,0.3\nMARKER/20\nPART/3, MASS=300, CM=30, IP=9,9,9, QG=0,0,0.8\n"
      "MARKER/30\nJOINT/1, TRANSLATIONAL, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=30, J=20\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=180000, C=50, LENGTH=0.3\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=18000, C=1500, LENGTH=0.7\nEND\n";
  const std::string share = "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL\n", energies = "Energies per mode",
                    line = "The model is at rest";
  const RunResult still = run(pair, "SIMULATE/STATICS\nSIMULATE/DYNAMICS, END=0.1, STEPS=2\n" + share);
  ASSERT_EQ(still.status, 0) << still.err;
  for (const auto& [label, values] : table(still.text("model.txt"), energies))
    EXPECT_THAT(values, ::testing::Each(0)) << label;
  EXPECT_THAT(still.text("model.txt"), HasSubstr(line));
  // A millionth of the length of the model is some.
  const RunResult moves =
      run(pair, "SIMULATE/STATICS\nACCGRAV/KGRAV=-9.810001\nSIMULATE/DYNAMICS, END=0.1, STEPS=2\n" + share);
  ASSERT_EQ(moves.status, 0) << moves.err;
  for (const double v : row(moves.text("model.txt"), energies, "Model")) EXPECT_GT(v, 0);
  EXPECT_THAT(moves.text("model.txt"), Not(HasSubstr(line)));
}

// A point between three springs in one tilted plane: across it no damper does anything.
const std::string tilted =
    "Plane\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=1,0.2,0.3\nMARKER/2, QP=-0.3,0.9,0.1\n"
    "MARKER/3, QP=-0.7,-1.1,-0.4\nPOINT_MASS/2, MASS=1, CM=20, QG=0,0,0\nMARKER/20, POINT_MASS=2\n";

TEST_F(RoundingShares, dampers_across_a_motion_dissipate_nothing) {
  const RunResult r = run(tilted +
                              "SPRINGDAMPER/1, TRANSLATIONAL, I=1, J=20, K=100, C=1, LENGTH=0.5\n"
                              "SPRINGDAMPER/2, TRANSLATIONAL, I=2, J=20, K=120, C=2, LENGTH=0.5\n"
                              "SPRINGDAMPER/3, TRANSLATIONAL, I=3, J=20, K=90, C=1, LENGTH=0.5\nEND\n",
                          "LINEAR/EIGENSOL, DISSIPAT=1, TABLE_PRECISION=5\nLINEAR/EIGENSOL, DISSIPAT=2,3\n");
  ASSERT_EQ(r.status, 0) << r.err;
  for (const auto& of : r.result(0).at("tables")) {
    if (of.at("table") != "DISSIPAT") continue;
    for (const auto& row : of.at("rows")) EXPECT_EQ(row.at("values")[0], 0) << row;
  }
  const std::string note = "No element of this table dissipates power in this mode.", text = r.text("model.txt");
  EXPECT_NE(text.find(note), std::string::npos);
  EXPECT_EQ(text.find(note), text.rfind(note));  // of the first mode alone
}

TEST_F(RoundingShares, springs_across_a_motion_store_nothing) {
  // As long as they are free they hold the point in the plane, and not across it.
  const RunResult r = run(tilted +
                              "SPRINGDAMPER/1, TRANSLATIONAL, I=1, J=20, K=100, LENGTH=1.0630145812734649\n"
                              "SPRINGDAMPER/2, TRANSLATIONAL, I=2, J=20, K=120, LENGTH=0.95393920141694564\n"
                              "SPRINGDAMPER/3, TRANSLATIONAL, I=3, J=20, K=90, LENGTH=1.3638181696985856\nEND\n",
                          "LINEAR/EIGENSOL, STRAIN=1, TABLE_PRECISION=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("model.txt"), HasSubstr("No element of this table stores energy in this mode."));
}

// A pair that moves as one has a damper between that moves a billionth as far: its power is the square of that, and no
// rounding.
TEST_F(RoundingShares, a_damper_that_hardly_moves_dissipates_all_the_same) {
  const RunResult r =
      run("Pair\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\nMARKER/3, QP=-1,0,0\n"
          "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, REULER=90D,90D,0\nPART/3, MASS=1E-8, CM=30, "
          "IP=1,1,1, QG=1,0,0\nMARKER/30\nMARKER/31, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, "
          "TRANSLATIONAL, I=31, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=3, K=1, LENGTH=1\n"
          "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=10, C=0.01, LENGTH=1\nEND\n",
          "LINEAR/EIGENSOL, DISSIPAT=3, TABLE_PRECISION=9\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("model.txt"), Not(HasSubstr("No element of this table dissipates")));
  for (const auto& of : r.result(0).at("tables")) {
    if (of.at("table") == "DISSIPAT") {
      EXPECT_EQ(of.at("rows")[0].at("values")[0], 0);
      EXPECT_NEAR(of.at("rows")[1].at("values")[0].get<double>(), 100, 1e-9);
    }
  }
}

TEST_F(RoundingShares, dampers_that_cancel_have_no_shares_and_are_not_nothing) {
  const RunResult r =
      run("Beside\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=-1,0,0\nMARKER/3, REULER=90D,90D,0\n"
          "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/22, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=22, J=3\n"
          "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=14, C=1, LENGTH=1\n"
          "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=20, J=3, FUNCTION=VX(20)-4*DX(20)\nEND\n",
          "LINEAR/EIGENSOL, DISSIPAT=1, STRAIN=1, TABLE_PRECISION=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string text = r.text("model.txt");
  EXPECT_THAT(text, HasSubstr("The powers of these elements cancel in this mode: none has a share."));
  EXPECT_THAT(text, Not(HasSubstr("No element of this table")));
  for (const auto& of : r.result(0).at("tables")) {
    if (of.at("table") != "DISSIPAT") continue;
    for (const auto& row : of.at("rows")) EXPECT_TRUE(row.at("values")[0].is_null());
  }
}

// --- the old format of mode shapes ---
TEST_F(RoundingShares, what_is_printed_as_zero_has_no_phase) {
  // The second mass moves 0.003 of the first one, in opposite phase; a damper gives it one of its own.
  const RunResult r =
      run("Line\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=1, CM=20, QG=1,0,0\n"
          "MARKER/20, POINT_MASS=2\nPOINT_MASS/3, MASS=1, CM=30, QG=2,0,0\nMARKER/30, POINT_MASS=3\n"
          "BUSHING/1, I=20, J=1, K=100,1E4,1E4\nBUSHING/2, I=30, J=1, K=5,1E4,1E4\n"
          "SPRINGDAMPER/1, TRANSLATIONAL, I=30, J=20, K=0.3, C=0.1, LENGTH=1\nEND\n",
          "LINEAR/EIGENSOL, COORDS=1,6\nLINEAR/EIGENSOL, COORDS=1,6, TABLE_PRECISION=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::istringstream in(r.text("model.txt"));
  std::string line;
  std::size_t zeros = 0;
  while (std::getline(in, line) && line.find("e+") == std::string::npos) {
    if (line.find("POIN/") == std::string::npos && line.find("POINT_MASS/") == std::string::npos) continue;
    std::istringstream cells(line.substr(line.find('|') + 1));
    double magnitude = 0, phase = 0;
    while (cells >> magnitude >> phase) {
      if (magnitude != 0) continue;
      ++zeros;
      EXPECT_EQ(phase, 0) << line;
    }
  }
  EXPECT_GT(zeros, 10u);
}

TEST_F(RoundingShares, states_stand_in_the_table_as_in_the_linear_model) {
  const RunResult r =
      run("States\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nTFSISO/1, X=51, U=52, Y=53, NUM=1, DEN=3,2,1\nARRAY/51, X\n"
          "ARRAY/52, U, VARIABLES=20\nARRAY/53, Y\nVARIABLE/20, FUNCTION=DIF(2)\n"
          "DIFF/2, FUNCTION=-2*DIF(2)+DIF(1)\nDIFF/1, FUNCTION=-DIF(1)\nEND\n",
          "LINEAR/EIGENSOL, COORDS=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::vector<int> in_table, in_model;
  for (const auto& of : r.result(0).at("tables")) {
    if (of.at("table") != "COORDS") continue;
    for (const auto& row : of.at("rows")) {
      const std::string element = row.at("element");
      in_table.push_back(std::stoi(element.substr(element.find('/') + 1)));
    }
  }
  for (const auto& state : r.result(0).at("states")) in_model.push_back(state.at("element"));
  EXPECT_EQ(in_table, in_model);
}

}  // namespace
}  // namespace dynalin::cases::rounding_shares_test
