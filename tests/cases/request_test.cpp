// REQUEST and MREQUEST in every form: values against closed forms in turned frames and against the functions of the
// same name in VARIABLEs; what cannot be evaluated is left out with a warning.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"
#include "elements/requests/lenient.h"

namespace dynalin::cases::request_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double pi = std::numbers::pi;

// A plate that turns about the global z axis at 2 rad/s on a hinge at the origin, (1, 0, 0) from its centre, pushed by
// a force; its marker 22 is tilted. MARKER/2 of the ground lies at (0, 0, 5), turned by 90 degrees about z.
const std::string plate =
    "plate\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,5, REULER=90D,0,0\nMARKER/3, QP=1,0,0\n"
    "PART/2, QG=1,0,0, MASS=2, CM=20, IP=0,0,1, WZ=2\nMARKER/20\nMARKER/21, QP=-1,0,0\n"
    "MARKER/22, QP=0,2,0, REULER=30D,40D,50D\nJOINT/1, REVOLUTE, I=21, J=1\n"
    "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2, FUNCTION=6\n";

class Requests : public Cases {
 protected:
  RunResult with(const std::string& lines, const std::string& commands = "SIMULATE/INITIAL_CONDITIONS\n") const {
    return run(plate + lines + "END\n", commands);
  }
  static json request(const RunResult& r, const std::string& element, std::size_t result = 0) {
    for (const auto& q : r.result(result).at("operating_point").at("requests")) {
      if (q.at("element") == element) return q;
    }
    return {};
  }
  static std::vector<double> values(const RunResult& r, const std::string& element, std::size_t result = 0) {
    const json q = request(r, element, result);
    return q.is_null() ? std::vector<double>() : q.at("values").get<std::vector<double>>();
  }
  static void expect_values(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-12) << k;
  }
};

TEST_F(Requests, of_markers_have_the_closed_forms_in_turned_frames) {
  const RunResult r = with(
      "REQUEST/1, DISPLACEMENT, I=22, J=2, RM=2\nREQUEST/2, VELOCITY, I=20, J=1, RM=2\n"
      "REQUEST/3, ACCELERATION, I=20, J=1, RM=2\nREQUEST/4, FORCE, I=20, J=2, RM=2\nREQUEST/5, FORCE, I=21\n"
      "REQUEST/6, D, I=22\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(request(r, "REQUEST/1").at("components"), ElementsAre("MAG", "X", "Y", "Z", "PSI", "THETA", "PHI"));
  EXPECT_THAT(request(r, "REQUEST/2").at("components"), ElementsAre("VM", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"));
  // From (0, 0, 5) to (1, 2, 0); x of MARKER/2 is y of the ground, its y is −x.
  expect_values(values(r, "REQUEST/1"), {std::sqrt(30), 2, -1, -5, (30 - 90) * pi / 180, 40 * pi / 180, 50 * pi / 180});
  // ω × r = (0, 2, 0) at (1, 0, 0).
  expect_values(values(r, "REQUEST/2"), {2, 2, 0, 0, 2, 0, 0, 2});
  // −ω² r = (−4, 0, 0): the force along z turns nothing.
  expect_values(values(r, "REQUEST/3"), {4, 0, 4, 0, 0, 0, 0, 0});
  // 6 along z of MARKER/2.
  expect_values(values(r, "REQUEST/4"), {6, 0, 0, 6, 0, 0, 0, 0});
  // The hinge holds the plate on its circle, against the force and its moment: (-8, 0, -6), (0, -6, 0) or its opposite.
  const auto hinge = values(r, "REQUEST/5");
  EXPECT_NEAR(hinge[0], 10, 1e-12);
  expect_values({hinge[1], hinge[2], hinge[3]}, {-8, 0, -6});
  EXPECT_NEAR(std::fabs(hinge[6]), 6, 1e-12);
  expect_values(values(r, "REQUEST/6"), {std::sqrt(5), 1, 2, 0, 30 * pi / 180, 40 * pi / 180, 50 * pi / 180});
}

TEST_F(Requests, have_the_values_of_the_functions_of_their_names) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> forms = {
      {"DISPLACEMENT", {"DM", "DX", "DY", "DZ", "PSI", "THETA", "PHI"}},
      {"VELOCITY", {"VM", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"}},
      {"ACCELERATION", {"ACCM", "ACCX", "ACCY", "ACCZ", "WDTM", "WDTX", "WDTY", "WDTZ"}},
      {"FORCE", {"FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"}}};
  std::string lines;
  int id = 0, variable = 0;
  for (const auto& [form, names] : forms) {
    const std::string i = form == "FORCE" ? "21" : "22";
    lines += "REQUEST/" + std::to_string(++id) + ", " + form + ", I=" + i + ", J=1, RM=22\n";
    std::string functions = "REQUEST/" + std::to_string(id + 10) + ", ", list;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool along = names[k].find_first_of("M") == std::string::npos && names[k].size() < 5 && names[k] != "PSI" &&
                         names[k] != "PHI";
      const std::string call = names[k] + "(" + i + (along ? ",1,22)" : ",1)");
      lines += "VARIABLE/" + std::to_string(++variable) + ", FUNCTION=" + call + "\n";
      functions += "F" + std::to_string(k + 1) + "=" + call + "\\";
      list += (list.empty() ? "" : ",") + std::to_string(variable);
    }
    lines += functions + "\nREQUEST/" + std::to_string(id + 20) + ", VARIABLES=" + list + "\n";
  }
  const RunResult r = with(lines);
  ASSERT_EQ(r.status, 0) << r.err;
  for (int k = 1; k <= 4; ++k) {
    const auto of_markers = values(r, "REQUEST/" + std::to_string(k));
    ASSERT_GE(of_markers.size(), 7u);
    expect_values(values(r, "REQUEST/" + std::to_string(k + 10)), of_markers);
    expect_values(values(r, "REQUEST/" + std::to_string(k + 20)), of_markers);
    EXPECT_TRUE(std::any_of(of_markers.begin(), of_markers.end(), [](double v) { return v != 0; })) << k;
  }
}

TEST_F(Requests, change_nothing_of_the_model) {
  const std::string with_spring = "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=50, LENGTH=1\n";
  const RunResult without = with(with_spring, "LINEAR/EIGENSOL\n");
  const RunResult r = with(with_spring +
                               "REQUEST/1, F2=SQRT(-DX(20))\\F3=AZ(20,1)\nREQUEST/2, FORCE, I=20\n"
                               "REQUEST/3, ACCELERATION, I=20\n",
                           "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("eigenvalues"), without.result(0).at("eigenvalues"));
}

TEST_F(Requests, that_cannot_be_evaluated_are_left_out_with_a_reason) {
  const auto reason = [&](const std::string& line) {
    const RunResult r = with(line + "\nREQUEST/9, F2=3\n");
    EXPECT_EQ(r.status, 0) << line << r.err;
    EXPECT_EQ(values(r, "REQUEST/9"), std::vector<double>{3}) << line;
    EXPECT_TRUE(request(r, "REQUEST/1").is_null()) << line;
    EXPECT_THAT(r.err, AllOf(HasSubstr("[request-left-out]"), HasSubstr("REQUEST/1 is left out: ")));
    EXPECT_THAT(r.err, HasSubstr("model.adm:13:"));
    return r.err;
  };
  EXPECT_THAT(reason("REQUEST/1, D, I=99"), HasSubstr("it refers to MARKER/99, which does not exist"));
  EXPECT_THAT(reason("REQUEST/1, F2=DX(20)\\F3=DX(98)"), HasSubstr("MARKER/98"));
  EXPECT_THAT(reason("REQUEST/1, F2=FRICTION(1,0,2,0)"), HasSubstr("FRICTION"));
  EXPECT_THAT(reason("REQUEST/1, F2=1+*2"), HasSubstr("model.adm:13:17: warning"));
  EXPECT_THAT(reason("REQUEST/1, VARIABLES=7"), HasSubstr("VARIABLE/7"));
  EXPECT_THAT(reason("REQUEST/1, COMMENT=nothing"), HasSubstr("it asks for nothing"));
  EXPECT_THAT(reason("REQUEST/1, D, V, I=20"), HasSubstr("more than one"));
  EXPECT_THAT(reason("REQUEST/1, V"), HasSubstr("it needs the marker I"));
  EXPECT_THAT(reason("REQUEST/1, FUNCTION=USER(1,2)"), HasSubstr("--user-value"));
  EXPECT_THAT(reason("REQUEST/1, F2=DELAY(DX(20), 0.1, 0)"), HasSubstr("a VARIABLE with this DELAY"));
  EXPECT_THAT(reason("REQUEST/1, F2=PINVAL(5,1)"), HasSubstr("PINPUT/5"));
}

TEST_F(Requests, read_rates_of_states_but_make_no_unknowns) {
  const RunResult r = with(
      "DIFF/1, FUNCTION=3\nDIFF/2, IMPLICIT, FUNCTION=DIF(2)-4\nVARIABLE/1, FUNCTION=DIF1(2)\n"
      "REQUEST/1, F2=DIF1(1)\\F3=DIF1(2)\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(values(r, "REQUEST/1"), (std::vector<double>{3, 0}));
  const RunResult without = with("DIFF/2, IMPLICIT, FUNCTION=DIF(2)-4\nREQUEST/1, F2=DIF1(2)\n");
  EXPECT_EQ(without.status, 0);
  EXPECT_THAT(without.err, HasSubstr("REQUEST/1 is left out: DIF1(2) is the rate of an algebraic value"));
}

TEST_F(Requests, that_call_a_routine_have_the_value_of_the_user) {
  write("model.adm", plate + "REQUEST/1, FUNCTION=USER(1,2,3), ROUTINE=lib::sub\nEND\n");
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  options.commands = {"SIMULATE/INITIAL"};
  options.json = (folder_ / "results.json").string();
  options.user_value = 2.5;
  std::ostringstream out, err;
  EXPECT_EQ(run_session(options, out, err), 0) << err.str();
  const auto point = json::parse(read_file(options.json)).at("results").at(0).at("operating_point");
  EXPECT_EQ(point.at("requests").at(0).at("values"), std::vector<double>(8, 2.5));
}

TEST_F(Requests, without_a_finite_value_are_null_and_named_once) {
  const RunResult r = with("REQUEST/1, F2=SQRT(DX(20)-2)\\F3=4\n", "SIMULATE/INITIAL\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(request(r, "REQUEST/1").at("values"), json::parse("[null, 4.0]"));
  const auto at = r.err.find("F2 of REQUEST/1 has no finite value at time 0: SQRT of -1");
  ASSERT_NE(at, std::string::npos) << r.err;
  EXPECT_EQ(r.err.find("no finite value", at + 30), std::string::npos);
  EXPECT_THAT(r.err, HasSubstr("[undefined-request]"));
}

TEST_F(Requests, are_taken_out_in_again_and_defined_anew_by_commands) {
  const RunResult r = with("REQUEST/1, DISPLACEMENT, I=20\nREQUEST/2, F2=1\n",
                           "SIMULATE/INITIAL\nDEACTIVATE/REQUEST, ID=1\nSIMULATE/INITIAL\nACTIVATE/REQUEST, ID=1\n"
                           "REQUEST/1, F4=7*DX(20)\nREQUEST/2, VELOCITY, I=20\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(values(r, "REQUEST/1").size(), 7u);
  EXPECT_TRUE(request(r, "REQUEST/1", 2).is_null());
  EXPECT_EQ(values(r, "REQUEST/2", 2), std::vector<double>{1});
  expect_values(values(r, "REQUEST/1", 6), {7});
  EXPECT_THAT(request(r, "REQUEST/1", 6).at("components"), ElementsAre("F4"));
  expect_values(values(r, "REQUEST/2", 6), {2, 0, 2, 0, 2, 0, 0, 2});
}

TEST_F(Requests, count_whole_turns) {
  const RunResult r = with("MOTION/1, JOINT=1, FUNCTION=3*PI\nREQUEST/1, F2=AZ(21,1)\nVARIABLE/1, FUNCTION=AZ(21,1)\n",
                           "SIMULATE/STATICS\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(values(r, "REQUEST/1").at(0), r.result(0).at("operating_point").at("variables").at(0).at("value"));
}

TEST_F(Requests, of_many_elements_are_one_for_each) {
  const RunResult r = with(
      "PART/3, QG=1,0,0\nMARKER/30\nJPRIM/1, ATPOINT, I=30, J=3\nJOINT/2, FIXED, I=30, J=3\nVFORCE/1, I=20, JFLOAT=31, "
      "RM=1, FX=1\\FY=0\\FZ=0\n"
      "MARKER/31, FLOATING, PART=1\nMREQUEST/1, VELOCITY, PARTS=ALL, RM=2\nMREQUEST/2, FORCE, JOINTS=1, JPRIMS=ALL, "
      "C=all joints\n"
      "MREQUEST/3, DISPLACEMENT, PART=2\nMREQUEST/4, FORCE, APPFORS=1\nREQUEST/1, VELOCITY, I=20, RM=2\n"
      "REQUEST/2, FORCE, I=21, J=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::vector<std::string> names;
  for (const auto& q : r.result(0).at("operating_point").at("requests")) names.push_back(q.at("element"));
  EXPECT_THAT(names, ElementsAre("REQUEST/1", "REQUEST/2", "MREQUEST/1 PART/2", "MREQUEST/2 JOINT/1",
                                 "MREQUEST/2 JPRIM/1", "MREQUEST/3 PART/2", "MREQUEST/4 SFORCE/1"));
  EXPECT_EQ(values(r, "MREQUEST/1 PART/2"), values(r, "REQUEST/1"));
  EXPECT_EQ(values(r, "MREQUEST/2 JOINT/1"), values(r, "REQUEST/2"));
  expect_values(values(r, "MREQUEST/4 SFORCE/1"), {6, 0, 0, 6, 0, 0, 0, 0});
}

TEST_F(Requests, of_many_elements_are_left_out_like_others) {
  const auto reason = [&](const std::string& line) {
    const RunResult r = with(line + "\n");
    EXPECT_EQ(r.status, 0) << line << r.err;
    EXPECT_TRUE(r.result(0).at("operating_point").at("requests").empty());
    EXPECT_THAT(r.err, HasSubstr("[request-left-out]"));
    return r.err;
  };
  EXPECT_THAT(reason("MREQUEST/1, PARTS=ALL"), HasSubstr("one of DISPLACEMENT"));
  EXPECT_THAT(reason("MREQUEST/1, FORCE"), HasSubstr("none of PARTS"));
  EXPECT_THAT(reason("MREQUEST/1, FORCE, PARTS=2"), HasSubstr("FORCE goes with JOINTS"));
  EXPECT_THAT(reason("MREQUEST/1, FORCE, JOINTS=4"), HasSubstr("JOINT/4"));
  EXPECT_THAT(reason("MREQUEST/1, FORCE, APPFORS=4"), HasSubstr("no applied force 4"));
  EXPECT_THAT(reason("MREQUEST/1, VELOCITY, PARTS=1"), HasSubstr("has no CM"));
}

TEST(TextsOfRequests, are_split_at_commas_outside_of_quotes) {
  EXPECT_THAT(split_texts("a, \"b, c\" ,'d'", ','), ElementsAre("a", "b, c", "d"));
  EXPECT_THAT(split_texts("\"\",,x", ','), ElementsAre("", "", "x"));
  // The mark of continuation is one comma with that at the end of the line before.
  EXPECT_THAT(split_texts("a,\n, b\n, c", ','), ElementsAre("a", "b", "c"));
  EXPECT_THAT(split_texts(":x: y", ':'), ElementsAre("", "x", "y"));
  EXPECT_THAT(split_names(":x:'y:z'"), ElementsAre("", "x", "y:z"));
  EXPECT_THAT(split_names("a:b, c"), ElementsAre("a:b", "c"));
  EXPECT_THAT(split_names("\"a:b\""), ElementsAre("a:b"));
  EXPECT_THAT(split_texts("Peter's tip, left", '\0'), ElementsAre("Peter's tip, left"));
}

}  // namespace
}  // namespace dynalin::cases::request_test
