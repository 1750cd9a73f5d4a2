// Numbers of a dataset as parameters: found by name, read, and replaced in the statement that gives them.
#include "model/parameter.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "analysis/initial.h"
#include "elements/catalogue.h"
#include "linear/linear_system.h"

namespace dynalin::parameter_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string oscillator =
    "Oscillator\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, QP=0, 0, 0\n"
    "PART/2, MASS=2, CM=20, IP=1, 2,\n, 3, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
    "spri/1, trans, i=20, j=1, k=50, c=.4, len=1\nSFORCE/7, TRANSLATIONAL, I=20, J=1, FUNCTION=2*9.81\n"
    "BUSHING/3, I=20, J=1, K=1,2,3, KT=4,5,6\nEND\n";

std::shared_ptr<const Dataset> dataset_of(const std::string& text) {
  auto parsed = parse_dataset(std::make_shared<const SourceText>("model.adm", text));
  EXPECT_FALSE(parsed.diagnostics.has_errors()) << render(parsed.diagnostics);
  return std::make_shared<const Dataset>(std::move(parsed.value));
}
ParameterRef named(const std::string& text) {
  const auto p = parse_parameter(text);
  EXPECT_TRUE(p) << p.error().message;
  return p.value_or(ParameterRef());
}
double value_of(const Dataset& d, const std::string& name) {
  const auto value = parameter(d, named(name), catalogue());
  EXPECT_TRUE(value) << value.error().message;
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}
std::string refusal_of(const Dataset& d, const std::string& name) {
  const auto value = parameter(d, named(name), catalogue());
  EXPECT_FALSE(value) << name;
  return value ? "" : render(value.error());
}
std::shared_ptr<const Dataset> changed(const std::shared_ptr<const Dataset>& d, std::vector<ParameterChange> values) {
  auto out = with_parameters(d, values, catalogue());
  EXPECT_TRUE(out) << render(out.error());
  return out ? out->dataset : nullptr;
}

// The state matrix of the one freedom.
Eigen::MatrixXd state_matrix(const std::shared_ptr<const Dataset>& d) {
  auto model = build_model(d, catalogue());
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  const auto system = System::make(std::move(model.value)).value();
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  const auto linear = linearize(*system, *op, {});
  return linear->A;
}
double squared_frequency(const std::shared_ptr<const Dataset>& d) { return -state_matrix(d)(0, 1); }
double damping_over_mass(const std::shared_ptr<const Dataset>& d) { return -state_matrix(d)(0, 0); }

// An id behind a keyword that needs none says nothing, neither in the dataset nor in the name.
TEST(Parameter, of_what_exists_once_is_found_by_the_keyword) {
  std::string text = oscillator;
  text.replace(text.find("ACCGRAV/"), 8, "ACCGRAV/1, ");
  const auto d = dataset_of(text);
  for (const char* name : {"ACCGRAV KGRAV", "ACCGRAV/1 KGRAV", "ACCGRAV/2 KGRAV"}) EXPECT_EQ(value_of(*d, name), -9.81);
  const auto other = changed(d, {{named("ACCGRAV KGRAV"), -3}});
  ASSERT_TRUE(other);
  EXPECT_EQ(value_of(*other, "ACCGRAV KGRAV"), -3);
}

TEST(Parameter, is_named_by_element_argument_and_number) {
  const ParameterRef k = named("bushing/3 k[2]");
  EXPECT_EQ(k.element, (ElementId{"BUSHING", 3}));
  EXPECT_EQ(k.argument, "K");
  EXPECT_EQ(k.index, 2u);
  EXPECT_EQ(k.text(), "BUSHING/3 K[2]");
  EXPECT_EQ(named("ACCGRAV KGRAV").text(), "ACCGRAV KGRAV");
  EXPECT_EQ(named("SPRI/1  K").text(), "SPRINGDAMPER/1 K");
  for (const char* wrong : {"", "PART/2", "PART/ MASS", "PART/0 MASS", "PART/x MASS", "WHEEL/1 MASS", "PART/2 IP[0]",
                            "PART/2 IP[2", "PART/2 IP]2[", "PART/2 IP[2]x", "PART/2 IP[-1]", "PART/2 MASS IP"})
    EXPECT_FALSE(parse_parameter(wrong)) << wrong;
}

TEST(Parameter, is_read_as_it_stands_however_it_is_written) {
  const auto d = dataset_of(oscillator);
  EXPECT_EQ(value_of(*d, "PART/2 MASS"), 2);
  EXPECT_EQ(value_of(*d, "PART/2 IP[3]"), 3);
  EXPECT_EQ(value_of(*d, "PART/2 QG[3]"), 1);
  EXPECT_EQ(value_of(*d, "ACCGRAV KGRAV"), -9.81);
  EXPECT_EQ(value_of(*d, "SPRINGDAMPER/1 K"), 50);
  EXPECT_EQ(value_of(*d, "SPRINGDAMPER/1 LENGTH"), 1);
  EXPECT_EQ(value_of(*d, "BUSHING/3 KT[2]"), 5);
}

TEST(Parameter, that_is_not_stated_is_what_holds_without_it) {
  const auto d = dataset_of(oscillator);
  EXPECT_EQ(value_of(*d, "BUSHING/3 C[2]"), 0);
  EXPECT_EQ(value_of(*d, "SPRINGDAMPER/1 FORCE"), 0);
  EXPECT_EQ(value_of(*d, "PART/2 QG[1]"), 0);
  EXPECT_EQ(value_of(*d, "ACCGRAV IGRAV"), 0);
  EXPECT_EQ(
      refusal_of(*d, "PART/2 VX"),
      "error: VX of PART/2 is not stated [unstated-number]\nhint: what holds without it is no number of its own\n");
  EXPECT_THAT(refusal_of(*d, "PART/2 ZG[1]"), HasSubstr("[unstated-number]"));
  // A statement that a dataset need not have.
  const auto weightless = dataset_of("x\nPART/1, GROUND\nEND\n");
  EXPECT_EQ(value_of(*weightless, "ACCGRAV KGRAV"), 0);
  const auto heavy = changed(weightless, {{named("ACCGRAV KGRAV"), -9.81}});
  EXPECT_EQ(value_of(*heavy, "ACCGRAV KGRAV"), -9.81);
  EXPECT_EQ(value_of(*heavy, "ACCGRAV JGRAV"), 0);
}

// Settings of analyses have no id; of several statements the last one decides.
TEST(Parameter, of_a_setting_is_read_and_replaced) {
  const auto d = dataset_of(
      "x\nPART/1, GROUND\nEQUILIBRIUM/ERROR=1E-6, MAXIT=40\nEQUILIBRIUM/ERROR=1E-5\nINTEGRATOR/HMAX=0.1\nEND\n");
  EXPECT_EQ(value_of(*d, "EQUILIBRIUM ERROR"), 1e-5);
  EXPECT_EQ(value_of(*d, "INTEGRATOR HMAX"), 0.1);
  const auto other =
      changed(d, {{named("EQUILIBRIUM ERROR"), 1e-8}, {named("INTEGRATOR KMAX"), 3}, {named("IC ERROR"), 1e-4}});
  EXPECT_EQ(value_of(*other, "EQUILIBRIUM ERROR"), 1e-8);
  const auto settings = build_model(other, catalogue()).value->settings;
  EXPECT_EQ(settings.equilibrium.error, 1e-8);
  EXPECT_EQ(settings.equilibrium.iteration_limit, 40);
  EXPECT_EQ(settings.integrator.largest_order, 3);
  EXPECT_EQ(settings.integrator.largest_step, 0.1);
  EXPECT_EQ(settings.initial_conditions.error, 1e-4);
}

TEST(Parameter, may_be_a_whole_number_or_a_function_that_is_a_number) {
  const auto d = dataset_of(
      "x\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nARRAY/1, IC, SIZE=2, NUMBERS=1,2\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=3.5\nSFORCE/2, TRANSLATIONAL, I=20, J=1, "
      "ACTIONONLY, FUNCTION=2*TIME\nEND\n");
  EXPECT_EQ(value_of(*d, "ARRAY/1 SIZE"), 2);
  EXPECT_EQ(value_of(*d, "SFORCE/1 FUNCTION"), 3.5);
  EXPECT_THAT(refusal_of(*d, "SFORCE/2 FUNCTION"), HasSubstr("no number"));
  EXPECT_EQ(value_of(*changed(d, {{named("SFORCE/1 FUNCTION"), -4}}), "SFORCE/1 FUNCTION"), -4);
  // Lists of any length grow number by number.
  const auto grown = changed(d, {{named("ARRAY/1 SIZE"), 3}, {named("ARRAY/1 NUMBERS[3]"), 7}});
  EXPECT_EQ(value_of(*grown, "ARRAY/1 NUMBERS[3]"), 7);
  EXPECT_EQ(
      value_of(*changed(d, {{named("PART/2 IP[4]"), 0.1}, {named("PART/2 IP[5]"), 0}, {named("PART/2 IP[6]"), 0}}),
               "PART/2 IP[4]"),
      0.1);
  EXPECT_THAT(refusal_of(*d, "ARRAY/1 NUMBERS[4]"), HasSubstr("has 2 values, none is number 4"));
  const std::array<ParameterChange, 1> gap{{{named("ARRAY/1 NUMBERS[4]"), 1}}};
  EXPECT_FALSE(with_parameters(d, gap, catalogue()));
  const std::array<ParameterChange, 1> half{{{named("ARRAY/1 SIZE"), 2.5}}};
  EXPECT_TRUE(build_model(with_parameters(d, half, catalogue())->dataset, catalogue()).diagnostics.has_errors());
}

const std::string splines =
    "Splines\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
    "JOINT/1, TRANSLATIONAL, I=20, J=1\nSPLINE/1, X=-2,-1,1,2, Y=-6,-3,3,6\n"
    "SPLINE/2, X=-2,-1,1,2, Y=0,-6,-3,3,6,\n, Y=1,-8,-4,4,8\nSPLINE/3, FILE=points.txt\n"
    "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-AKISPL(DZ(20,1,1),0,1)-AKISPL(DZ(20,1,1),1,2)\nEND\n";

TEST(Parameter, of_an_argument_that_is_written_several_times_is_a_number_of_one_of_its_lists) {
  EXPECT_EQ(named("SPLINE/2 Y[2][5]").list, 2u);
  EXPECT_EQ(named("SPLINE/2 Y[2][5]").index, 5u);
  EXPECT_EQ(named("SPLINE/2 Y[2][5]").text(), "SPLINE/2 Y[2][5]");
  EXPECT_EQ(named("SPLINE/2 Y[2][1]").text(), "SPLINE/2 Y[2][1]");
  EXPECT_EQ(named("SPLINE/2 Y[1][3]").text(), "SPLINE/2 Y[3]");
  for (const char* wrong : {"SPLINE/2 Y[2][", "SPLINE/2 Y[][1]", "SPLINE/2 Y[0][1]", "SPLINE/2 Y[1][0]",
                            "SPLINE/2 Y[1][2][3]", "SPLINE/2 Y[1]x[2]"})
    EXPECT_FALSE(parse_parameter(wrong)) << wrong;

  const auto d = dataset_of(splines);
  EXPECT_EQ(value_of(*d, "SPLINE/1 Y[3]"), 3);
  EXPECT_EQ(value_of(*d, "SPLINE/1 X[4]"), 2);
  EXPECT_EQ(value_of(*d, "SPLINE/2 Y[4]"), 3);
  EXPECT_EQ(value_of(*d, "SPLINE/2 Y[2][1]"), 1);
  EXPECT_EQ(value_of(*d, "SPLINE/2 Y[2][5]"), 8);
  EXPECT_THAT(refusal_of(*d, "SPLINE/2 Y[3][1]"), HasSubstr("Y of SPLINE/2 is written 2 times, none is number 3"));
  EXPECT_THAT(refusal_of(*d, "SPLINE/2 Y[2][6]"), HasSubstr("Y of SPLINE/2 has 5 values, none is number 6"));
  EXPECT_THAT(refusal_of(*d, "SPLINE/2 X[2][1]"), HasSubstr("X of SPLINE/2 is written once, none is number 2"));
  EXPECT_THAT(refusal_of(*d, "SPLINE/3 Y[2]"), HasSubstr("[unstated-number]"));
}

TEST(Parameter, of_a_spline_replaced_reaches_the_linear_model) {
  const auto d = dataset_of(std::string(splines).erase(splines.find("SPLINE/3"), 26));
  const auto stiffness = [](const std::shared_ptr<const Dataset>& of) { return 2 * squared_frequency(of); };
  EXPECT_NEAR(stiffness(d), 3 + 4, 1e-13);
  // Both curves stay straight.
  const auto other = changed(d, {{named("SPLINE/1 Y[1]"), -10},
                                 {named("SPLINE/1 Y[2]"), -5},
                                 {named("SPLINE/1 Y[3]"), 5},
                                 {named("SPLINE/1 Y[4]"), 10},
                                 {named("SPLINE/2 Y[2][2]"), -14},
                                 {named("SPLINE/2 Y[2][3]"), -7},
                                 {named("SPLINE/2 Y[2][4]"), 7},
                                 {named("SPLINE/2 Y[2][5]"), 14}});
  EXPECT_NEAR(stiffness(other), 5 + 7, 1e-13);
  EXPECT_EQ(value_of(*other, "SPLINE/2 Y[2]"), -6);
  EXPECT_EQ(value_of(*other, "SPLINE/2 Y[2][1]"), 1);
  // The z of a curve is its first number, and the reader checks that they ascend.
  EXPECT_EQ(value_of(*changed(other, {{named("SPLINE/2 Y[2][1]"), 3}}), "SPLINE/2 Y[2][5]"), 14);
}

TEST(Parameter, that_is_none_is_refused_with_the_reason) {
  const auto d = dataset_of(oscillator);
  EXPECT_EQ(refusal_of(*d, "PART/9 MASS"), "error: PART/9 does not exist [unknown-element]\nhint: PART/2 exists\n");
  EXPECT_EQ(refusal_of(*d, "PART/2 MAS5"),
            "error: PART/2 has no argument MAS5 [unknown-argument]\nhint: did you mean MASS?\n");
  EXPECT_THAT(refusal_of(*d, "SFORCE/7 FUNCTION"),
              HasSubstr("FUNCTION of SFORCE/7 is no number (expression) [expected-number]"));
  EXPECT_THAT(refusal_of(*d, "JOINT/1 I"), HasSubstr("I of JOINT/1 is no number (marker)"));
  EXPECT_THAT(refusal_of(*d, "BUSHING/3 K[4]"),
              HasSubstr("K of BUSHING/3 has 3 values, none is number 4 [wrong-count]"));
  EXPECT_THAT(refusal_of(*d, "BUSHING/3 C[4]"), HasSubstr("C of BUSHING/3 has 3 values, none is number 4"));
  EXPECT_THAT(refusal_of(*d, "PART/2 MASS[2]"), HasSubstr("MASS of PART/2 has 1 value, none is number 2"));
  EXPECT_THAT(render(parse_parameter("SPRINGDAMPR/1 K").error()),
              HasSubstr("names no parameter [no-parameter]\nhint: did you mean SPRINGDAMPER?"));
}

// Arguments of one kind of a statement are known to the others.
TEST(Parameter, of_another_kind_of_the_statement_is_told_to_be_one) {
  const auto d = dataset_of(oscillator);
  EXPECT_EQ(refusal_of(*d, "SPRINGDAMPER/1 CT"),
            "error: SPRINGDAMPER/1 has no argument CT [unknown-argument]\nhint: CT goes with ROTATIONAL\n");
  EXPECT_EQ(refusal_of(*d, "SPRI/1 tor"),
            "error: SPRINGDAMPER/1 has no argument TORQUE [unknown-argument]\nhint: TORQUE goes with ROTATIONAL\n");
}

// Axes that nothing turns have angles of zero; those that points give have none.
TEST(Parameter, of_axes_that_are_not_stated_is_an_angle_of_zero) {
  const auto d = dataset_of(
      "x\nPART/1, GROUND\nMARKER/1\nMARKER/2, PART=1, ZP=1,0,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "POINT_MASS/3, MASS=1, CM=30, ZG=0,1,0, XG=1,0,0\nMARKER/30, POINT_MASS=3\nEND\n");
  for (const char* name : {"MARKER/1 REULER[2]", "PART/2 REULER[3]", "MARKER/30 REULER[1]", "MARKER/1 QP[3]"})
    EXPECT_EQ(value_of(*d, name), 0) << name;
  EXPECT_EQ(refusal_of(*d, "MARKER/2 REULER[2]"),
            "error: REULER of MARKER/2 is not stated [unstated-number]\nhint: ZP is, which stands instead of it\n");
  EXPECT_THAT(refusal_of(*d, "POINT_MASS/3 REULER[2]"), HasSubstr("[unstated-number]"));
  const auto turned = changed(d, {{named("MARKER/1 REULER[2]"), 0.5}, {named("PART/2 REULER[1]"), 0.25}});
  auto model = build_model(turned, catalogue());
  ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  const Model& m = *model.value;
  EXPECT_NEAR(m.marker(*m.find_marker(1)).place.R_BM(2, 1), std::sin(0.5), 1e-15);
  EXPECT_NEAR(m.body(*m.find_body("PART", 2)).pose.R(1, 0), std::sin(0.25), 1e-15);
}

// As any list of open length, that of one curve grows behind its last number.
TEST(Parameter, behind_the_last_of_a_curve_makes_it_longer) {
  const auto d = dataset_of(splines);
  const auto longer = changed(d, {{named("SPLINE/1 X[5]"), 3},
                                  {named("SPLINE/1 Y[5]"), 9},
                                  {named("SPLINE/2 X[5]"), 3},
                                  {named("SPLINE/2 Y[6]"), 9},
                                  {named("SPLINE/2 Y[2][6]"), 12}});
  EXPECT_EQ(value_of(*longer, "SPLINE/1 Y[5]"), 9);
  EXPECT_EQ(value_of(*longer, "SPLINE/1 Y[4]"), 6);
  EXPECT_EQ(value_of(*longer, "SPLINE/2 Y[6]"), 9);
  EXPECT_EQ(value_of(*longer, "SPLINE/2 Y[2][6]"), 12);
  EXPECT_EQ(value_of(*longer, "SPLINE/2 Y[2][5]"), 8);
  for (const char* gap : {"SPLINE/1 Y[6]", "SPLINE/2 Y[3][1]", "SPLINE/2 Y[2][7]", "SPLINE/3 Y[2]"}) {
    const std::array<ParameterChange, 1> change{{{named(gap), 1}}};
    EXPECT_FALSE(with_parameters(d, change, catalogue())) << gap;
  }
}

TEST(Parameter, replaced_changes_that_number_and_nothing_else) {
  const auto d = dataset_of(oscillator);
  const auto other = changed(d, {{named("BUSHING/3 K[3]"), 7.25},
                                 {named("BUSHING/3 K[1]"), -1e-300},
                                 {named("SPRINGDAMPER/1 K"), 0.1},
                                 {named("PART/2 IP[2]"), 1.0 / 3}});
  EXPECT_EQ(value_of(*other, "BUSHING/3 K[1]"), -1e-300);
  EXPECT_EQ(value_of(*other, "BUSHING/3 K[2]"), 2);
  EXPECT_EQ(value_of(*other, "BUSHING/3 K[3]"), 7.25);
  EXPECT_EQ(value_of(*other, "SPRINGDAMPER/1 K"), 0.1);
  EXPECT_EQ(value_of(*other, "SPRINGDAMPER/1 C"), 0.4);
  EXPECT_EQ(value_of(*other, "PART/2 IP[1]"), 1);
  EXPECT_EQ(value_of(*other, "PART/2 IP[2]"), 1.0 / 3);
  EXPECT_EQ(value_of(*other, "PART/2 IP[3]"), 3);
  EXPECT_EQ(value_of(*d, "BUSHING/3 K[3]"), 3) << "the first dataset stays as it is";
  // Once more on what was replaced before.
  EXPECT_EQ(value_of(*changed(other, {{named("BUSHING/3 K[2]"), 8}}), "BUSHING/3 K[3]"), 7.25);
}

TEST(Parameter, replaced_reaches_the_linear_model) {
  const auto d = dataset_of(oscillator);
  EXPECT_NEAR(squared_frequency(d), (50 + 3) / 2.0, 1e-12);
  EXPECT_NEAR(squared_frequency(changed(d, {{named("SPRINGDAMPER/1 K"), 150}})), (150 + 3) / 2.0, 1e-12);
  EXPECT_NEAR(squared_frequency(changed(d, {{named("PART/2 MASS"), 4}, {named("BUSHING/3 K[3]"), 30}})), 80 / 4.0,
              1e-12);
}

TEST(Parameter, stated_for_the_first_time_is_taken_and_checked_by_its_reader) {
  const auto d = dataset_of(oscillator);
  EXPECT_EQ(value_of(*changed(d, {{named("SPRINGDAMPER/1 FORCE"), 3}}), "SPRINGDAMPER/1 FORCE"), 3);
  const auto damped = changed(d, {{named("BUSHING/3 C[3]"), 0.5}});
  EXPECT_EQ(value_of(*damped, "BUSHING/3 C[2]"), 0);
  EXPECT_EQ(value_of(*damped, "BUSHING/3 C[3]"), 0.5);
  EXPECT_NEAR(damping_over_mass(damped), (0.4 + 0.5) / 2, 1e-13);
  EXPECT_EQ(value_of(*changed(d, {{named("PART/2 VX"), 7}}), "PART/2 VX"), 7);
  const auto model = build_model(changed(d, {{named("PART/2 MASS"), -1}}), catalogue());
  ASSERT_TRUE(model.diagnostics.has_errors());
  EXPECT_THAT(render(model.diagnostics), HasSubstr("(parameters):1:14: error: MASS of PART/2 is -1"));
}

// What a command that defines the argument anew would end, a parameter ends as well.
TEST(Parameter, takes_the_place_of_other_arguments_as_a_command_does) {
  std::string text = oscillator;
  text.insert(text.find("END"),
              "BEAM/5, I=20, J=1, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1, GMOD=1, CMATRIX=21*\n");
  std::string ones = "1";
  for (int k = 1; k < 21; ++k) ones += ",0";
  text.replace(text.find("21*"), 3, ones);
  const auto d = dataset_of(text);
  EXPECT_EQ(value_of(*d, "BEAM/5 CMATRIX[1]"), 1);
  const auto other = changed(d, {{named("BEAM/5 CRATIO"), 0.25}});
  EXPECT_EQ(value_of(*other, "BEAM/5 CRATIO"), 0.25);
  EXPECT_THAT(refusal_of(*other, "BEAM/5 CMATRIX[1]"), HasSubstr("not stated"));
  EXPECT_FALSE(build_model(other, catalogue()).diagnostics.has_errors());
}

TEST(Parameter, wrong_changes_are_reported_together) {
  const std::vector<ParameterChange> wrong = {{named("PART/9 MASS"), 1},
                                              {named("PART/2 ZG[1]"), 1},
                                              {named("PART/2 MASS"), std::numeric_limits<double>::infinity()}};
  const auto out = with_parameters(dataset_of(oscillator), wrong, catalogue());
  ASSERT_FALSE(out);
  std::vector<std::string> said;
  for (const Diagnostic& problem : out.error().items()) said.push_back(problem.message);
  EXPECT_THAT(said, ElementsAre("PART/9 does not exist", "ZG of PART/2 is not stated",
                                "PART/2 MASS is to be inf, which is no finite number"));
}

}  // namespace
}  // namespace dynalin::parameter_test
