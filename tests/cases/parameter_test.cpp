// Numbers of a dataset as parameters: found by name, read, and replaced in the statement that gives them.
#include "model/parameter.h"

#include <gmock/gmock.h>

#include <limits>

#include "analysis/initial.h"
#include "elements/catalogue.h"
#include "linear/linear_system.h"

namespace dynalin {
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
  EXPECT_TRUE(p) << p.error();
  return p.value_or(ParameterRef());
}
double value_of(const Dataset& d, const std::string& name) {
  const auto value = parameter(d, named(name), catalogue());
  EXPECT_TRUE(value) << value.error();
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}
std::string refusal_of(const Dataset& d, const std::string& name) {
  const auto value = parameter(d, named(name), catalogue());
  EXPECT_FALSE(value) << name;
  return value ? "" : value.error();
}
std::shared_ptr<const Dataset> changed(const std::shared_ptr<const Dataset>& d, std::vector<ParameterValue> values) {
  auto out = with_parameters(d, values, catalogue());
  EXPECT_TRUE(out) << out.error().front();
  return out.value_or(nullptr);
}

// λ² of the one freedom, from the state matrix.
double squared_frequency(const std::shared_ptr<const Dataset>& d) {
  auto model = build_model(d, catalogue());
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  const auto system = System::make(std::move(model.value)).value();
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  const auto linear = linearize(*system, *op, {});
  return -linear->A(0, 1);
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

TEST(Parameter, that_is_none_is_refused_with_the_reason) {
  const auto d = dataset_of(oscillator);
  EXPECT_EQ(refusal_of(*d, "PART/9 MASS"), "PART/9 does not exist");
  EXPECT_EQ(refusal_of(*d, "PART/2 COLOUR"), "PART/2 has no argument COLOUR");
  EXPECT_THAT(refusal_of(*d, "SFORCE/7 FUNCTION"), HasSubstr("FUNCTION of SFORCE/7 is expression, no number"));
  EXPECT_THAT(refusal_of(*d, "JOINT/1 I"), HasSubstr("I of JOINT/1 is marker, no number"));
  EXPECT_EQ(refusal_of(*d, "BUSHING/3 C[1]"), "C of BUSHING/3 is not stated");
  EXPECT_EQ(refusal_of(*d, "BUSHING/3 K[4]"), "K of BUSHING/3 has 3 values, none is number 4");
  EXPECT_EQ(refusal_of(*d, "PART/2 MASS[2]"), "MASS of PART/2 has 1 value, none is number 2");
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
  const auto model = build_model(changed(d, {{named("PART/2 MASS"), -1}}), catalogue());
  ASSERT_TRUE(model.diagnostics.has_errors());
  EXPECT_THAT(render(model.diagnostics), HasSubstr("(parameters):1:14: error: MASS of PART/2 is -1"));
}

TEST(Parameter, wrong_changes_are_reported_together) {
  const std::vector<ParameterValue> wrong = {{named("PART/9 MASS"), 1},
                                             {named("BUSHING/3 C[1]"), 1},
                                             {named("PART/2 MASS"), std::numeric_limits<double>::infinity()}};
  const auto out = with_parameters(dataset_of(oscillator), wrong, catalogue());
  ASSERT_FALSE(out);
  EXPECT_THAT(out.error(), ElementsAre("PART/9 does not exist", "C of BUSHING/3 is not stated",
                                       "PART/2 MASS is to be inf, which is no finite number"));
}

}  // namespace
}  // namespace dynalin
