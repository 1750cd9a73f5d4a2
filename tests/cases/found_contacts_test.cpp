// Points of contact on curves after commands and RELOAD: found again where something has changed, and where nothing has
// they stay to the last bit.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::found_contacts_test {
namespace {

using ::testing::HasSubstr;

const std::string ground = "on a curve\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/9, FLOATING\n";
// y = 2x² where |x| ≤ 1
const std::string bowl =
    "MATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3\n, VALUES=-1,2,0, -0.5,0.5,0, 0,0,0, 0.5,0.5,0, 1,2,0\n"
    "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n";

std::string bead(const std::string& place) {
  return ground + "MARKER/1\n" + bowl + "POINT_MASS/2, MASS=3, CM=2, QG=" + place +
         "\nMARKER/2\nVARIABLE/1, FUNCTION=DX(2)\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1\nEND\n";
}
const std::string trolley =
    ground + "MARKER/1\n" + bowl +
    "PART/2, MASS=2, CM=20, IP=0.3,0.4,0.5, QG=0.5,-0.1,0\nMARKER/20\nMARKER/21, QP=0,0.25,0, REULER=90D,90D,0\n"
    "AXCV/1, I=21, JFLOAT=9, CURVE=1, RM=1\nEND\n";
const std::string disc =
    ground + "MARKER/1\nMARKER/8, PART=2, FLOATING\n" + bowl +
    "MATRIX/2, FULL=RORDER, ROWS=9, COLUMNS=3\n, VALUES=.2,0,0,.1414213562,.1414213562,0,0,.2,0,-.1414213562,"
    ".1414213562,0,-.2,0,0,-.1414213562,-.1414213562,0,0,-.2,0,.1414213562,-.1414213562,0,.2,0,0\n"
    "CURVE/2, CLOSED, MATRIX=2\nPART/2, MASS=3, CM=2, IP=1,1,1, QG=.3,.3,0\nMARKER/2\nJOINT/1, PLANAR, I=2, J=1\n"
    "SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT=8\n"
    "CVCV/1, ICURVE=2, JCURVE=1, IRM=2, JRM=1, IFLOAT=8, JFLOAT=9\nEND\n";
const std::string rocker =
    ground + "MARKER/1, REULER=0,-90D,0\nMARKER/2\n" + bowl +
    "PART/2, MASS=3, CM=20, IP=0.2,0.2,0.2, QG=-.1,0.1,0, REULER=.4,0,0\nMARKER/20, QP=0,0.4,0\nMARKER/21\n"
    "MARKER/29, FLOATING\nJPRIM/1, INLINE, I=20, J=1\nJPRIM/2, PARALLEL_AXES, I=20, J=2\n"
    "PLCV/1, I=1, IFLOAT=9, JFLOAT=29, CURVE=1, RM=21\nEND\n";

class FoundContacts : public Cases {
 protected:
  static void expect_near(const nlohmann::json& found, const nlohmann::json& wanted, double tolerance) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k].get<double>(), wanted[k].get<double>(), tolerance);
  }
  static void expect_same_place(const nlohmann::json& found, const nlohmann::json& wanted, double tolerance = 1e-9) {
    for (const char* what : {"position", "angles"}) {
      for (std::size_t b = 0; b < wanted.at("bodies").size(); ++b)
        expect_near(found.at("bodies")[b].at(what), wanted.at("bodies")[b].at(what), tolerance);
    }
    ASSERT_EQ(found.at("curve_parameters").size(), wanted.at("curve_parameters").size());
    for (std::size_t k = 0; k < wanted.at("curve_parameters").size(); ++k)
      EXPECT_NEAR(found.at("curve_parameters")[k].at("value").get<double>(),
                  wanted.at("curve_parameters")[k].at("value").get<double>(), 1e-7);
  }
  // Taken out for a while at a place that is not the drawn one, and in again: nothing has moved.
  void expect_the_same_after_a_pause(const std::string& dataset, const std::string& element) const {
    SCOPED_TRACE(element);
    const RunResult r = run(dataset, "SIMULATE/DYNAMICS, END=0.2\nSIMULATE/INITIAL\nDEACTIVATE/" + element +
                                         "\nTIME\nACTIVATE/" + element + "\nSIMULATE/INITIAL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    expect_same_place(r.json.at("results").back().at("operating_point"), r.result(1).at("operating_point"));
  }
  void expect_as_if_drawn(const std::string& edit, const std::string& fresh) const {
    SCOPED_TRACE(edit);
    const RunResult edited = run(bead("0.5,0.5,0"), "SIMULATE/INITIAL\n" + edit + "\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(edited.status, 0) << edited.err;
    const RunResult drawn = run(fresh, edit + "\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    expect_same_place(edited.result(2).at("operating_point"), drawn.result(1).at("operating_point"));
    ASSERT_EQ(edited.eigenvalues(2).size(), drawn.eigenvalues(1).size());
    for (std::size_t k = 0; k < drawn.eigenvalues(1).size(); ++k)
      EXPECT_NEAR(std::abs(edited.eigenvalues(2)[k] - drawn.eigenvalues(1)[k]), 0, 1e-9);
  }
};

TEST_F(FoundContacts, what_is_taken_out_and_in_again_moves_nothing) {
  expect_the_same_after_a_pause(bead("1,2,0"), "PTCV, ID=1");
  expect_the_same_after_a_pause(trolley, "AXCV, ID=1");
  expect_the_same_after_a_pause(disc, "CVCV, ID=1");
  expect_the_same_after_a_pause(rocker, "PLCV, ID=1");
}

TEST_F(FoundContacts, a_place_or_a_curve_or_its_marker_that_is_stated_anew_is_met_as_if_drawn_so) {
  expect_as_if_drawn("POINT_MASS/2, QG=0.2,0.08,0", bead("0.5,0.5,0"));
  expect_as_if_drawn("MATRIX/1, VALUES=-1,1,0, -0.5,0.25,0, 0,0,0, 0.5,0.25,0, 1,1,0", bead("0.5,0.5,0"));
  expect_as_if_drawn("MARKER/1, QP=.3,0,0", bead("0.5,0.5,0"));
  expect_as_if_drawn("MARKER/2, QP=-.3,0,0", bead("0.5,0.5,0"));
}

// A point of a model without the contact.
TEST_F(FoundContacts, a_contact_that_was_not_saved_takes_hold_where_the_bodies_are) {
  const RunResult r = run(bead("1,2,0"),
                          "SIMULATE/STATICS\nDEACTIVATE/PTCV, ID=1\nTIME\nSAVE/STATES, FILE=out.save\nACTIVATE/PTCV, "
                          "ID=1\nSIMULATE/DYNAMICS, END=.1\nRELOAD/STATES, FILE=out.save\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_near(r.json.at("results").back().at("operating_point").at("bodies")[0].at("position"), {0, 0, 0}, 1e-7);
  const RunResult system =
      run(bead("1,2,0"),
          "SIMULATE/STATICS\nDEACTIVATE/PTCV, ID=1\nSAVE/SYSTEM, FILE=all.save\nRELOAD/SYSTEM, FILE=all.save\n"
          "ACTIVATE/PTCV, ID=1\nSIMULATE/INITIAL\n");
  ASSERT_EQ(system.status, 0) << system.err;
  expect_near(system.json.at("results").back().at("operating_point").at("bodies")[0].at("position"), {0, 0, 0}, 1e-7);
}

TEST_F(FoundContacts, one_that_nothing_has_touched_stays_to_the_last_bit) {
  const std::string on = "SIMULATE/DYNAMICS, END=0.3\n";
  const RunResult r =
      run(bead("1,2,0"),
          on + "VARIABLE/1, FUNCTION=2*DX(2)\nSAVE/STATES, FILE=a\nRELOAD/STATES, FILE=a\n" + "SIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto &before = r.result(0).at("operating_point"), &after = r.json.at("results").back().at("operating_point");
  EXPECT_EQ(before.at("curve_parameters")[0].at("value"), after.at("curve_parameters")[0].at("value"));
  EXPECT_EQ(before.at("bodies"), after.at("bodies"));
}

}  // namespace
}  // namespace dynalin::cases::found_contacts_test
