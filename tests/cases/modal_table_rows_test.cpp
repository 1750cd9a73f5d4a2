// Rows of the modal tables: modes in which nothing that has mass moves, roundings that are no shares, labels with long
// ids, and the body that a mode is named after.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/modal_sums_cases.h"

namespace dynalin::cases::modal_table_rows_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ModalTableRows = ModalSumCases;

// Two masses of 1 in a row along x, held sideways, with `more`.
std::string two_masses(const std::string& more) {
  return "Two masses\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0D\nMARKER/2\n"
         "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, REULER=90D,90D,0D\n"
         "PART/3, MASS=1, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\nMARKER/31, REULER=90D,90D,0D\n"
         "JOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, TRANSLATIONAL, I=31, J=1\n"
         "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=3, K=100, LENGTH=1\nMARKER/3, PART=1, QP=-1,0,0\n"
         "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=70, LENGTH=1\n" +
         more + "END\n";
}

// The line that follows a table after its empty line.
bool has_note(const std::string& text, const std::string& note) {
  return text.find("  " + note + "\n") != std::string::npos;
}

TEST_F(ModalTableRows, modes_of_controllers_have_no_mass) {
  const std::vector<std::string> controllers = {
      "DIFF/1, FUNCTION=-3*DIF(1)\nDIFF/2, FUNCTION=-7*DIF(2)+DIF(1)\n",                      // on their own
      "DIFF/1, FUNCTION=-3*DIF(1)+DX(20)\nDIFF/2, FUNCTION=-7*DIF(2)+1E9*DIF(1)\n",           // sensors in a row
      "DIFF/1, FUNCTION=1E6*(DX(20)+VX(30))\nDIFF/2, FUNCTION=DIF(1)-DIF(2)\n",               // integrator
      "DIFF/1, FUNCTION=DIF(2)+DX(30)\nDIFF/2, FUNCTION=-400*DIF(1)-0.1*DIF(2)+VX(20,30)\n",  // a filter that vibrates
  };
  for (const std::string& c : controllers) {
    SCOPED_TRACE(c);
    const RunResult r =
        run(two_masses(c), "LINEAR/EIGENSOL, MASS_PER_MODE=ALL, KINETIC=1,9, STRAIN=1,9, TABLE_PRECISION=9\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const std::string text = r.text("model.txt");
    EXPECT_NEAR(row(text, "Modal effective mass", "Sum")[0], 2, 1e-9);
    EXPECT_THAT(text, HasSubstr("nothing that has mass moves."));
    std::size_t still = 0;
    const auto& modes = r.result(0).at("modes");
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const bool moves = modes[k].at("moves_most").get<std::string>().find("DIFF") == std::string::npos;
      still += !moves;
      const auto numbers = row(text, "Modal participation", std::to_string(k + 1));
      EXPECT_EQ(numbers[0] > 0, moves);
      const std::string head = fmt::format("Energy table for MODE {}\n", k + 1);
      const std::string of_mode =
          text.substr(text.find(head), text.find("Energy table", text.find(head) + 10) - text.find(head));
      EXPECT_EQ(has_note(of_mode, "Nothing that has mass moves in this mode."), !moves) << of_mode;
      EXPECT_EQ(has_note(of_mode, "No element of this table stores energy in this mode."), !moves) << of_mode;
      // The first twelve entries are those of the parts.
      const auto& shape = modes[k].at("shape");
      double motion = 0;
      for (std::size_t e = 0; e < 12; ++e) motion += std::abs(std::complex<double>(shape[e][0], shape[e][1]));
      EXPECT_EQ(motion > 0, moves);
    }
    EXPECT_EQ(still, r.result(0).at("eigenvalues").size() - 4 - (modes.size() == 3 ? 1 : 0)) << modes.size();
  }
}

TEST_F(ModalTableRows, a_controller_that_drives_a_body_a_little_still_moves_it) {
  // The actuator's pole is far off: the body answers with 1e-13 of its state, which is no rounding.
  const RunResult r =
      run(two_masses(
              "DIFF/1, FUNCTION=-1E5*DIF(1)\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=1E-3*DIF(1)\n"),
          "LINEAR/EIGENSOL, KINETIC=1, MASS_PER_MODE=ALL, TABLE_PRECISION=9\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string text = r.text("model.txt");
  EXPECT_THAT(text, Not(HasSubstr("othing that has mass moves")));
  EXPECT_EQ(r.result(0).at("modes")[0].at("moves_most"), "PART/2");
  const auto numbers = row(text, "Modal participation", "1");
  EXPECT_NEAR(numbers[0], std::pow(1e-3 / 1e10, 2), 1e-5 * 1e-26);
}

TEST_F(ModalTableRows, directions_that_nothing_moves_in_have_no_percentages) {
  const std::string text = tables(two_masses(""), "MASS_PER_MODE=ALL, STRAIN=1,2, DISSIPAT=1,2");
  EXPECT_EQ(row(text, "Modal effective mass", "Sum")[1], 0);
  EXPECT_EQ(row(text, "Modal effective mass", "perc.")[1], 0);
  EXPECT_EQ(row(text, "Modal effective mass", "perc.")[2], 0);
  EXPECT_TRUE(has_note(text, "No element of this table dissipates power in this mode."));
  EXPECT_FALSE(has_note(text, "No element of this table stores energy in this mode."));
}

TEST_F(ModalTableRows, a_rigid_body_motion_strains_nothing) {
  // Both parts with a spring and a torsion spring between them, far from the origin, free in space.
  const RunResult r =
      run("Free\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nPART/2, MASS=1, CM=20, IP=1,2,3, "
          "QG=100,20,-50\nMARKER/20\nMARKER/21, QP=1,0,0\n"
          "PART/3, MASS=2, CM=30, IP=3,2,1, QG=102,21,-49\nMARKER/30\nMARKER/31, QP=-0.3,0.2,0.1\n"
          "SPRINGDAMPER/1, TRANSLATIONAL, I=31, J=21, K=1E4, C=3, LENGTH=1.7720045146669352\n"
          "BUSHING/1, I=30, J=32, K=10,20,30, KT=3,4,5, C=1,1,1, CT=1,1,1\nMARKER/32, PART=2, QP=2,1,1\n"
          "SFORCE/1, TRANSLATIONAL, I=30, J=20, FUNCTION=-50*(DM(30,20)-2.449489742783178)\nEND\n",
          "LINEAR/EIGENSOL, STRAIN=1,6, DISSIPAT=1,6\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string text = r.text("model.txt");
  std::size_t notes = 0;
  for (std::size_t at = text.find("No element of this table stores"); at != std::string::npos;
       at = text.find("No element of this table stores", at + 1))
    ++notes;
  EXPECT_EQ(notes, 6u) << text;
}

TEST_F(ModalTableRows, labels_never_lose_digits_of_an_id) {
  const RunResult r =
      run("Long ids\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,1,0\nPOINT_MASS/1001, MASS=1, CM=1001, "
          "QG=0,1,0\nMARKER/1001, POINT_MASS=1001\n"
          "POINT_MASS/1002, MASS=2, CM=1234567890, QG=0,2,0\nMARKER/1234567890, POINT_MASS=1002\nPOINT_MASS/123456789, "
          "MASS=2, CM=77, "
          "QG=0,3,0\nMARKER/77, POINT_MASS=123456789\n"
          "SPRINGDAMPER/123456789, TRANSLATIONAL, I=1001, J=1, K=9, LENGTH=1\nSPRINGDAMPER/2, TRANSLATIONAL, "
          "I=1234567890, J=1001, K=9, LENGTH=1\n"
          "SPRINGDAMPER/3, TRANSLATIONAL, I=77, J=1234567890, K=9, LENGTH=1\n"
          "VARIABLE/1, FUNCTION=DY(77)\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
          "TFSISO/12345678, X=2, U=1, Y=3, NUM=1, DEN=6,11,6,1\nEND\n",
          "LINEAR/EIGENSOL, COORDS=4, KINETIC=4, STRAIN=4, DISSIPAT=4, MLIST=1234567890,1001, MRANGE=4\n"
          "LINEAR/EIGENSOL, COORDS=4, KINETIC=4, STRAIN=4, TABLE_PRECISION=6, NAMES\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string text = r.text("model.txt");
  for (const char* label :
       {"POIN/1001", "POIN/1002", "POIN/123456789", "SPRI/123456789", "MARK/1234567890", "TFSI/12345678,3"}) {
    std::size_t count = 0;
    for (std::size_t at = text.find(std::string("\n  ") + label + " "); at != std::string::npos;
         at = text.find(std::string("\n  ") + label + " ", at + 1))
      ++count;
    std::size_t tight = 0;
    for (std::size_t at = text.find(std::string("\n  ") + label + "|"); at != std::string::npos;
         at = text.find(std::string("\n  ") + label + "|", at + 1))
      ++tight;
    EXPECT_GT(count + tight, 0u) << label << text;
  }
  // Bars stand below each other, also where the column is wide.
  std::istringstream in(text);
  std::string line, rule;
  while (std::getline(in, line)) {
    if (line.find('+') != std::string::npos && line.find("--") != std::string::npos &&
        line.find("/") == std::string::npos && line[line.find_first_not_of(' ')] == '+')
      rule = line;
    if (line.find('/') != std::string::npos && line.find('|') != std::string::npos) {
      EXPECT_EQ(line.find('|'), rule.find('+')) << line << "\n" << rule;
      EXPECT_EQ(line.rfind('|'), rule.rfind('+')) << line << "\n" << rule;
    }
  }
}

TEST_F(ModalTableRows, a_mode_is_named_after_the_body_with_most_kinetic_energy) {
  // A heavy body on a spring, a light wheel below it, and a light arm that swings far with either: bounce and wheel
  // hop.
  const RunResult r =
      run("Quarter car\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/10, PART=1, QP=0,0,1\nPART/2, MASS=400, "
          "CM=20, QG=0,0,1, IP=1,1,1\nMARKER/20\n"
          "PART/3, MASS=40, CM=30, QG=1,0,0, IP=1,1,1\nMARKER/30\nPART/4, MASS=0.3, CM=40, IP=0.001,0.001,0.001, "
          "QG=0,0,1\nMARKER/40, QP=0.5,0,0\n"
          "MARKER/41\nMARKER/42, QP=0.1,0,0\nMARKER/21, PART=2\nJOINT/1, TRANSLATIONAL, I=20, J=10\nJOINT/2, "
          "TRANSLATIONAL, I=30, J=11\nMARKER/11, PART=1, QP=1,0,0\n"
          "JOINT/3, REVOLUTE, I=43, J=22\nMARKER/43, PART=4, REULER=0,90D,0\nMARKER/22, PART=2, REULER=0,90D,0\n"
          "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=12, K=16000, LENGTH=1\nMARKER/12, PART=1\n"
          "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=-160000*DZ(30)\n"
          "BUSHING/1, I=42, J=32, K=0,0,1E6\nMARKER/32, PART=3, QP=-0.9,0,1\nEND\n",
          "LINEAR/EIGENSOL, KINETIC=1,3, TABLE_PRECISION=6\n");
  ASSERT_EQ(r.status, 0) << r.err;
  // The table of the same mode says who has most.
  const std::string text = r.text("model.txt");
  const auto& modes = r.result(0).at("modes");
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::size_t at = text.find(fmt::format("MODE {}\n", k + 1));
    double most = 0;
    std::string name;
    for (const char* part : {"PART/2", "PART/3", "PART/4"}) {
      const std::size_t line = text.find(part, at), end = text.find('\n', line);
      const std::string cells = text.substr(line, end - line);
      const double share = std::stod(cells.substr(cells.rfind('|', cells.size() - 2) + 1));
      if (share > most) most = share, name = part;
    }
    EXPECT_EQ(modes[k].at("moves_most"), name) << k;
    EXPECT_GT(most, 50);
  }
  EXPECT_EQ(modes[0].at("moves_most"), "PART/2");
  EXPECT_EQ(modes[1].at("moves_most"), "PART/3");
  // The arm's rotation is the largest entry of either shape.
  const auto& shape = modes[0].at("shape");
  EXPECT_EQ(shape[16][0].get<double>(), 1);
}

// Two wheels that gears hold together about a common axis turn alike but for roundings: a spring between them has none
// of an energy that is nothing.
TEST_F(ModalTableRows, roundings_of_a_turn_are_no_share) {
  const std::string axis = "REULER=0.3,0.7,1.1";
  for (const double ratio : {3.7, 0.7, 1.9, 2.3, 0.3}) {
    std::string model = "Wheels\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, " + axis + "\n";
    for (const int k : {2, 3, 4})
      model += fmt::format("PART/{0}, MASS=1, CM={0}0, IP=1,2,3\nMARKER/{0}0, {1}\nJOINT/{0}, REVOLUTE, I={0}0, J=1\n",
                           k, axis);
    model += fmt::format(
        "COUPLER/1, JOINTS=2,3, TYPE=R:R, SCALES=1,-{0}\nCOUPLER/2, JOINTS=3,4, TYPE=R:R, SCALES={0},-1\n"
        "SPRINGDAMPER/1, ROTATIONAL, I=20, J=40, KT=2E9\nEND\n",
        ratio);
    const RunResult r = run(model, "LINEAR/EIGENSOL, STRAIN=1\n");
    ASSERT_EQ(r.status, 0) << r.err;
    for (const auto& table : r.result(0).at("tables")) {
      if (table.at("table") != "STRAIN") continue;
      for (const auto& value : table.at("rows")[0].at("values")) {
        if (value.is_null()) continue;
        EXPECT_EQ(value.get<double>(), 0) << ratio;
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::modal_table_rows_test
