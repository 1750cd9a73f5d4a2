// What an eigensolution warns of, and what it does not.
#include <gmock/gmock.h>

#include "cases/dataset_text.h"

namespace dynalin::cases::caution_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Caution : public Cases {
 protected:
  static std::string slide(double K, double C, const std::string& more = "") {
    std::ostringstream s;
    s << "Slide\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\n! adams_view_name='carriage'\n"
      << "PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0" << more
      << "\nMARKER/20\nMARKER/21, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=21, J=1\n"
      << "SPRINGDAMPER/1, TRANSLATION, I=20, J=1, K=" << K << ", C=" << C << ", LENGTH=1\nEND\n";
    return s.str();
  }
};

TEST_F(Caution, overdamped_modes_name_their_part) {
  const RunResult over = run(slide(100, 30), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(over.err, HasSubstr("1 mode is overdamped, the slowest is mode 1 of PART/2 (carriage)"));
  EXPECT_THAT(over.message, HasSubstr("overdamped"));
  EXPECT_THAT(run(slide(100, 10), "LINEAR/EIGENSOL\n").err, Not(HasSubstr("overdamped")));
  // Without damping it vibrates.
  EXPECT_THAT(run(slide(100, 30), "LINEAR/EIGENSOL, NODAMPIN\n").err, Not(HasSubstr("overdamped")));
}

// At the limit two values are equal, and rounding decides whether they swing.
TEST_F(Caution, vibrations_at_the_limit_of_swinging_are_not_overdamped) {
  for (const auto& [k, c] : {std::pair(100.0, 20.0), std::pair(4.0, 4.0), std::pair(49.0, 14.0), std::pair(1e-4, 0.02)})
    EXPECT_THAT(run(slide(k, c), "LINEAR/EIGENSOL\n").err, Not(HasSubstr("overdamped"))) << k;
  EXPECT_THAT(run(slide(100, 20.0001), "LINEAR/EIGENSOL\n").err, HasSubstr("1 mode is overdamped"));
  // Equal parts have equal values, which are those of modes of their own.
  std::string two = slide(100, 30);
  two.insert(
      two.find("END"),
      "PART/3, MASS=1, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\nMARKER/31, REULER=90D,90D,0\nJOINT/3, TRANSLATIONAL, "
      "I=31, J=1\nSPRINGDAMPER/3, TRANSLATION, I=30, J=1, K=100, C=30, LENGTH=1\n");
  EXPECT_THAT(run(two, "LINEAR/EIGENSOL\n").err, HasSubstr("2 modes are overdamped"));
}

// Freedoms that nothing holds take no vibration away from those that are held; nor does one that only a damper holds
// bring one.
TEST_F(Caution, overdamped_modes_are_counted_beside_rigid_motion) {
  const std::string ground = "Slides\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  const auto cart = [](int k, double z) {
    return fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=1,1,1, QG=0,0,{1}\nMARKER/{0}0\nJOINT/{0}, TRANSLATIONAL, I={0}0, "
        "J=1\n",
        k, z);
  };
  const std::string between = "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=1, C=4, LENGTH=1\n";
  const std::string held = "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=0.001, LENGTH=1\n";
  const std::string braked = "SPRINGDAMPER/3, TRANSLATIONAL, I=40, J=1, K=0, C=1, LENGTH=3\n";
  for (const std::string& more : {std::string(), held, cart(4, 3), cart(4, 3) + braked, held + cart(4, 3) + cart(5, 4)})
    EXPECT_THAT(run(ground + cart(2, 1) + cart(3, 2) + between + more + "END\n", "LINEAR/EIGENSOL\n").err,
                HasSubstr("1 mode is overdamped"))
        << more;
  EXPECT_THAT(run(ground + cart(4, 3) + braked + cart(2, 1) + "END\n", "LINEAR/EIGENSOL\n").err,
              Not(HasSubstr("overdamped")));
}

// A controller that moves the carriage has real modes, and without damping there is no vibration behind them.
TEST_F(Caution, controllers_are_no_overdamped_modes) {
  std::string controlled = slide(100, 1);
  controlled.insert(controlled.find("END"),
                    "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=DIF(2)\nDIFF/1, FUNCTION=VX(20)-0.5*DIF(1)\n"
                    "DIFF/2, FUNCTION=-9*DIF(2)-5*DIF(1)\n");
  const RunResult r = run(controlled, "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, Not(HasSubstr("overdamped")));
  controlled.replace(controlled.find(", C=1,"), 6, ", C=30,");
  EXPECT_THAT(run(controlled, "LINEAR/EIGENSOL\n").err, HasSubstr("1 mode is overdamped"));
}

TEST_F(Caution, accelerating_and_turning_points_name_the_part) {
  // The spring is drawn 0.5 too long: 50 length/time².
  std::string pulled = slide(100, 0);
  pulled.replace(pulled.find("LENGTH=1"), 8, "LENGTH=.5");
  EXPECT_THAT(
      run(pulled, "LINEAR/EIGENSOL\n").err,
      HasSubstr("most of all PART/2 (carriage) (acceleration of its mass centre 50 meter/s², angular velocity 0"));
  std::string without = pulled;
  without.erase(without.find("UNITS"), 17);
  EXPECT_THAT(run(without, "LINEAR/EIGENSOL\n").err,
              HasSubstr("50 length/time², angular velocity 0 rad/time, angular acceleration 0 rad/time²)"));
  EXPECT_THAT(run(pulled, "SIMULATE/STATIC\nLINEAR/EIGENSOL\n").err, Not(HasSubstr("accelerates")));
  EXPECT_THAT(run(slide(100, 0, ", VX=3"), "LINEAR/EIGENSOL\n").err, Not(HasSubstr("accelerates")));
  const RunResult top =
      run("Top\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,2, WZ=7\nMARKER/20\n"
          "JOINT/1, REVOLUTE, I=20, J=1\nEND\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_THAT(top.err, HasSubstr("PART/2 (acceleration of its mass centre 0 meter/s², angular velocity 7 rad/s, "
                                 "angular acceleration 0 rad/s²)"));
}

// What counts of a body is its mass centre, wherever its author put the origin, and how its rotation speeds up.
TEST_F(Caution, of_acceleration_look_at_mass_centre_and_angular_acceleration) {
  const auto disc = [&](const std::string& more, const std::string& torque) {
    return run("Disc\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,2, QG=-3,0,0" + more +
                   "\nMARKER/20, QP=3,0,0\nJOINT/1, REVOLUTE, I=20, J=1\n"
                   "SFORCE/1, ROTATIONAL, ACTIONONLY, I=20, J=20, FUNCTION=" +
                   torque + "\nEND\n",
               "LINEAR/EIGENSOL\n")
        .err;
  };
  EXPECT_THAT(disc("", "10"), HasSubstr("(acceleration of its mass centre 0 meter/s², angular velocity 0 rad/s, "
                                        "angular acceleration 5 rad/s²)"));
  EXPECT_THAT(disc(", WZ=2", "-9*AZ(20,1)"),
              HasSubstr("(acceleration of its mass centre 0 meter/s², angular velocity 2 "));
  EXPECT_THAT(disc("", "0"), Not(HasSubstr("accelerates")));
}

// Two cranks of length 1 and a coupler of length 2 between hinges 2 apart, all on one line: the parallelogram may go
// over into its mirror image, and the row that is redundant here is not so beside it.
TEST_F(Caution, change_points_of_a_four_bar_are_singular) {
  const auto four_bar = [](double angle) {
    std::ostringstream s;
    s.precision(17);
    const double c = std::cos(angle), w = std::sin(angle);
    s << "Four-bar\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=2,0,0\n"
      << "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=" << c << "," << w << ",0\n"
      << "PART/3, MASS=1, CM=30, IP=1,1,1, QG=" << c << "," << w << ",0\nMARKER/30\nMARKER/31, QP=2,0,0\n"
      << "PART/4, MASS=1, CM=40, IP=1,1,1, QG=2,0,0\nMARKER/40\nMARKER/41, QP=" << c << "," << w << ",0\n"
      << "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=21\nJOINT/3, REVOLUTE, I=41, J=31\n"
      << "JOINT/4, REVOLUTE, I=40, J=2\nEND\n";
    return s.str();
  };
  const RunResult flat = run(four_bar(0), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(flat.status, 0) << flat.err;
  EXPECT_THAT(flat.err, HasSubstr("the configuration is singular"));
  EXPECT_THAT(flat.err, HasSubstr("1 more degree of freedom than nearby"));
  // Three rows of a planar loop are redundant everywhere.
  const RunResult open = run(four_bar(0.7), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(open.err, Not(HasSubstr("singular")));
}

TEST_F(Caution, results_file_holds_the_modes_on_request) {
  std::string text = slide(100, 2);
  EXPECT_FALSE(run(text, "LINEAR/EIGENSOL\n").wrote("model.res"));
  text.insert(text.find("END\n"), "RESULTS/XRF, DECIMALPLACES=6\n");
  const RunResult r = run(text, "LINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string xml = r.text("model.res");
  EXPECT_THAT(xml,
              HasSubstr("<Results xmlns=\"http://www.mscsoftware.com/:xrf10\" xmlns:dl=\"urn:dynalin:linear:1\">"));
  // −1 ± √(100 − 1) i over 2π.
  EXPECT_THAT(xml, HasSubstr("<dl:Mode number=\"1\" real=\"-0.159155\" imag=\"1.58357\" frequency=\"1.59155\" "
                             "dampingRatio=\"0.1\""));
  EXPECT_THAT(xml, HasSubstr("<dl:Entity name=\"carriage\" entType=\"PART\" objectId=\"2\">\n"
                             "<dl:Component name=\"X\">1 0</dl:Component>\n"
                             "<dl:Component name=\"Y\">0 0</dl:Component>"));
  EXPECT_THAT(
      xml, HasSubstr("<dl:Matrix name=\"A\" rows=\"2\" columns=\"2\" order=\"column\">\n-2 1\n-100 0\n</dl:Matrix>"));
  EXPECT_THAT(xml, HasSubstr("</Analysis>\n</Results>\n"));
  // The same shapes in JSON.
  const auto& mode = r.result(0).at("modes").at(0);
  EXPECT_EQ(r.result(0).at("shape_entries").at(0).at("quantity"), "X");
  EXPECT_NEAR(mode.at("shape").at(0).at(0).get<double>(), 1, 1e-15);
}

}  // namespace
}  // namespace dynalin::cases::caution_test
