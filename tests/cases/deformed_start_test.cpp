// Models of flexible bodies that start deformed: what is measured from the configuration as drawn, marker tables, and
// points that are saved and reloaded.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::deformed_start_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Two nodes, one apart along z. Mode 1 moves the second along z, 2 turns it about z, 3 moves it along x and turns it.
const std::string modes = R"(** RECORD GROUP 1, HEADER
** three shapes
  REV0 2 3 0 0 0
**
** RECORD GROUP 2
1 2
** RECORD GROUP 5
0 0
** RECORD GROUP 6
0 0
** RECORD GROUP 7
0 1
** RECORD GROUP 8
** MODE 1
0 0 0 0 0 0
0 0 1 0 0 0
** MODE 2
0 0 0 0 0 0
0 0 0 0 0 1
** MODE 3
0 0 0 0 0 0
1 0 0 0 1.5 0
** RECORD GROUP 9
2 0 0
0 0.5 0
0 0 3.125
** RECORD GROUP 10
800 0 0
0 50 0
0 0 300
** RECORD GROUP 11
1 1 1 0.1 0.1 0.1
2 2 2 0.5 0.5 0.5
** END OF FILE
)";
std::string body(const std::string& displacements, const std::string& further) {
  return "Bent\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/4, PART=1, QP=0,0,1\n"
         "FLEX_BODY/2, MNF_FILE=three.fem, DMODE=" +
         displacements + ", CRATIO=0\nMARKER/21, FLEX_BODY=2, NODE_ID=1\nMARKER/22, FLEX_BODY=2, NODE_ID=2\n" +
         further + "END\n";
}
const std::string held = "JOINT/1, FIXED, I=21, J=1\n";

class DeformedStart : public Cases {
 protected:
  RunResult with(const std::string& dataset, const std::string& commands) const {
    write("three.fem", modes);
    return run(dataset, commands);
  }
  // DX, DY, DZ of marker 22 and how far it is turned about z.
  static std::vector<double> place(const RunResult& r, std::size_t result) {
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.json.is_null()) return {0, 0, 0, 0};
    return r.result(result).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  }
};
const std::string observed =
    "VARIABLE/1, FUNCTION=DX(22,1)\nVARIABLE/2, FUNCTION=DY(22,1)\nVARIABLE/3, FUNCTION=DZ(22,1)\n"
    "VARIABLE/4, FUNCTION=AZ(22,1)\nREQUEST/1, VARIABLES=1,2,3,4\n";

TEST_F(DeformedStart, is_where_a_motion_by_rates_begins) {
  for (const char* by : {"VELOCITY", "ACCELERATION"}) {
    const std::string turns = fmt::format(
        "JOINT/2, CYLINDRICAL, I=22, J=4\nMOTION/1, JOINT=2, ROTATION, {}, "
        "FUNCTION=0*TIME\nMOTION/2, JOINT=2, TRANSLATION, {}, FUNCTION=0\n",
        by, by);
    const auto at = place(with(body("0.03,0.1,0", held + turns + observed), "SIMULATE/INITIAL_CONDITIONS\n"), 0);
    EXPECT_NEAR(at.at(2), 1.03, 1e-10) << by;
    EXPECT_NEAR(at.at(3), 0.1, 1e-10) << by;
  }
}

TEST_F(DeformedStart, is_what_a_screw_is_measured_from) {
  const std::string nut = "PART/3, MASS=1, CM=3, IP=1,1,1\nMARKER/3\n";
  const RunResult r = with(body("0.02,0.1,0", held + nut + "JOINT/2, SCREW, I=22, J=3, PITCH=0.3\n" + observed),
                           "SIMULATE/INITIAL_CONDITIONS\n");
  const auto at = place(r, 0);
  EXPECT_NEAR(at.at(2), 1.02, 1e-9);
  EXPECT_NEAR(at.at(3), 0.1, 1e-9);
  EXPECT_THAT(r.err, Not(HasSubstr("drawn-open")));
}

// Of masses 1 and 2 at the origin and at (0.02, 0, 1), seen from there: 1 · 1² along y and z, 0.02² beside it.
TEST_F(DeformedStart, is_where_the_marker_of_effective_masses_stands) {
  const RunResult r = with(body("0,0,0.02", ""), "LINEAR/EIGENSOL, MASS_PER_MODE=ALL, MODAL_RM=22\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string table = r.text("model.txt");
  // The marker is turned by 1.5 · 0.02 about y.
  const double t = 0.03, x = -0.02, z = -1, along = x * std::cos(t) - z * std::sin(t),
               across = x * std::sin(t) + z * std::cos(t);
  EXPECT_THAT(table, HasSubstr(fmt::format("{:.5E}", 0.6 + along * along))) << table;
  EXPECT_THAT(table, HasSubstr(fmt::format("{:.5E}", 0.6 + across * across))) << table;
}

TEST_F(DeformedStart, a_point_of_another_body_file_is_no_equilibrium) {
  const std::string dataset = body("0,0,0", held + "ACCGRAV/IGRAV=-3, KGRAV=-9\n" + observed);
  ASSERT_EQ(with(dataset, "SIMULATE/STATICS\nSAVE/SYSTEM, FILE=bent.save\n").status, 0);
  std::string softer = modes;
  softer.replace(softer.find("0 0 300"), 7, "0 0 150");
  const std::string again = "RELOAD/SYSTEM, FILE=bent.save\nLINEAR/EIGENSOL\nSIMULATE/STATICS\n";
  const auto reloaded = [&](const std::string& file) {
    write("three.fem", file);
    write("again.acf", again);
    return run_file("again.acf");
  };
  EXPECT_THAT(reloaded(modes).err, Not(HasSubstr("accelerating-point")));
  const RunResult r = reloaded(softer);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("three.fem has changed since"));
  EXPECT_THAT(r.err, HasSubstr("[accelerating-point]"));
}

}  // namespace
}  // namespace dynalin::cases::deformed_start_test
