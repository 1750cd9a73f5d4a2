// The library as a program of others uses it.
#include <dynalin/dynalin.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

namespace {

using dynalin::Error;
using ::testing::HasSubstr;

const std::string pendulum =
    "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n! adams_view_name='bob'\nPART/2, "
    "MASS=1, CM=20, IP=0.1,0.1,0.1, QG=1,0,0, WZ=0\n"
    "MARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/3, FUNCTION=AZ(21,1)\nVARIABLE/4, "
    "FUNCTION=0\n"
    "SFORCE/1, ROTATIONAL, ACTIONONLY, I=20, J=20, FUNCTION=VARVAL(4)\nPINPUT/1, VARIABLES=4\nPOUTPUT/1, "
    "VARIABLES=3\nEND\n";
const double pendulum_hz = std::sqrt(9.81 / 1.1) / (2 * std::numbers::pi);

dynalin::Study study_of(const std::string& text) { return dynalin::Study(dynalin::Model::from_text(text)); }

// The single problem of what is thrown.
template <class Action>
Error error_of(const Action& action) {
  try {
    action();
  } catch (const Error& e) {
    return e;
  }
  ADD_FAILURE() << "nothing was thrown";
  return Error("", {});
}

TEST(Library, finds_the_point_and_the_linear_model) {
  const auto study = study_of(pendulum);
  const auto point = study.static_equilibrium();
  EXPECT_GT(point.static_result().iterations, 0);
  EXPECT_NEAR(point.variable(3), -std::numbers::pi / 2, 1e-12);
  EXPECT_TRUE(point.redundant_rows().empty());
  const auto modes = study.linearize(point).modes();
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].eigenvalue_hz.imag(), pendulum_hz, 1e-14);
  EXPECT_EQ(modes.modes[0].moves_most, "PART/2 (bob)");
  EXPECT_EQ(modes.shapes.cols(), 1);
  EXPECT_EQ(study.linearize(point).modes(false).shapes.cols(), 0);
  dynalin::LinearRequest request;
  request.pinput = 1, request.poutput = 1;
  const auto linear = study.linearize(point, request);
  const auto s = linear.state_space();
  EXPECT_NEAR(s.B(0, 0) + s.B(1, 0), 1 / 1.1, 1e-13);
  EXPECT_EQ(s.inputs.at(0).variable, 4);
  EXPECT_EQ(s.pinput, 1);
  const auto form = linear.second_order();
  EXPECT_NEAR(form.K(0, 0), 9.81 / 1.1, 1e-12);
  EXPECT_EQ(form.poutput, 1);
}

TEST(Library, tells_poses_motions_reactions_and_variables_by_id) {
  // Pulled at the bob: the hinge turns at 2 rad/s, and the bob comes down.
  auto text = pendulum;
  text.replace(text.find("WZ=0"), 4, "WZ=2");
  const auto study = study_of(text);
  const auto point = study.initial_conditions();
  EXPECT_EQ(point.time(), 0);
  const auto bob = point.part(2);
  EXPECT_EQ(bob.name, "PART/2 (bob)");
  EXPECT_EQ(bob.position[0], 1);
  EXPECT_NEAR(bob.velocity[1], 2, 1e-13);
  const auto hinge = point.marker(21), tip = point.marker(20);
  EXPECT_NEAR(hinge.velocity[1], 0, 1e-13);
  EXPECT_NEAR(tip.velocity[1], 2, 1e-13);
  EXPECT_NEAR(tip.angular_velocity[2], 2, 1e-13);
  EXPECT_NEAR(tip.acceleration[0], -4, 1e-12);
  EXPECT_NEAR(tip.acceleration[1], -9.81 / 1.1, 1e-12);
  EXPECT_NEAR(tip.angular_acceleration[2], -9.81 / 1.1, 1e-12);
  EXPECT_EQ(point.marker(0).axes[1], (dynalin::Triple{0, 1, 0}));
  // What the hinge exerts on the bob is m a − weight.
  const auto load = point.load({"JOINT", 1});
  EXPECT_NEAR(load.force[0], -4, 1e-12);
  EXPECT_NEAR(load.force[1], 9.81 - 9.81 / 1.1, 1e-12);
  EXPECT_EQ(point.load({"SFORCE", 1}).torque[2], 0);
  EXPECT_EQ(study.model().elements().front().text(), "PART/1");
  EXPECT_EQ(study.model().title(), "Pendulum");
  EXPECT_EQ(study.model().units().length, "METER");

  for (const auto& [wrong, what] :
       std::vector<std::pair<std::function<void()>, std::string>>{{[&] { point.part(7); }, "PART/7"},
                                                                  {[&] { point.marker(7); }, "MARKER/7"},
                                                                  {[&] { point.variable(7); }, "VARIABLE/7"},
                                                                  {[&] {
                                                                     point.load({"JOINT", 7});
                                                                   },
                                                                   "JOINT/7"},
                                                                  {[&] { point.point_mass(2); }, "POINT_MASS/2"}})
    EXPECT_THAT(error_of(wrong).what(), HasSubstr(what + " does not exist"));
  EXPECT_THAT(error_of([&] { point.load({"VARIABLE", 3}); }).what(), HasSubstr("exerts no force"));
}

TEST(Library, says_everything_that_is_wrong_and_where) {
  const Error e = error_of([] {
    dynalin::Model::from_text("x\nUNITS/SYSTEM=MKX\nPART/1, GROUND\nJOINT/1, REVOLUTE, I=1, J=2\nEND\n", "some.adm");
  });
  ASSERT_GE(e.problems.size(), 3u);
  EXPECT_TRUE(e.analysis.empty());
  EXPECT_THAT(e.what(), HasSubstr("some.adm:2:"));
  EXPECT_THAT(e.what(), HasSubstr("some.adm:4:"));
  const auto marker = std::ranges::find(e.problems, "unknown-marker", &dynalin::Remark::code);
  ASSERT_NE(marker, e.problems.end());
  EXPECT_EQ(marker->file, "some.adm");
  EXPECT_EQ(marker->line, 4u);
  EXPECT_EQ(marker->column, 22u);
  EXPECT_EQ(marker->severity, dynalin::Remark::Severity::error);

  const Error unread = error_of([] { dynalin::Model::read("no_such_file.adm"); });
  EXPECT_EQ(unread.problems.at(0).file, "no_such_file.adm");
  const auto study = study_of(pendulum);
  dynalin::LinearRequest request;
  request.pinput = 77;
  const Error failed = error_of([&] { study.linearize(request); });
  EXPECT_EQ(failed.analysis, "linear analysis");
  EXPECT_EQ(failed.problems.at(0).message, "PINPUT/77 does not exist");
}

// A point is a value: one does not change while others are made of it.
TEST(Library, several_points_stand_beside_each_other) {
  const auto study = study_of(pendulum);
  const auto drawn = study.as_drawn(), start = study.initial_conditions(drawn), rest = study.static_equilibrium(start);
  EXPECT_FALSE(drawn.is_consistent());
  EXPECT_TRUE(start.is_consistent());
  EXPECT_FALSE(start.is_static());
  EXPECT_TRUE(rest.is_static());
  EXPECT_EQ(start.part(2).position[0], 1);
  EXPECT_NEAR(rest.part(2).position[1], -1, 1e-12);
  const auto beside = study.linearize(start), below = study.linearize(rest);
  EXPECT_EQ(beside.modes().modes[0].eigenvalue_hz, 0.0);
  EXPECT_NEAR(below.modes().modes[0].eigenvalue_hz.imag(), pendulum_hz, 1e-14);
  EXPECT_EQ(beside.operating_point().part(2).position[0], 1);
  EXPECT_EQ(study.linearize().operating_point().is_consistent(), true);
}

TEST(Library, statics_take_what_is_stated_and_tell_their_progress) {
  const auto study = study_of(pendulum);
  int called = 0;
  dynalin::StaticRequest request;
  request.rotation_limit = 0.01;
  request.progress = [&](int, double) { ++called; };
  const auto small_steps = study.static_equilibrium(request);
  EXPECT_GT(called, 0);
  EXPECT_GT(small_steps.static_result().iterations, study.static_equilibrium().static_result().iterations);
}

TEST(Library, threads_share_one_model) {
  const auto shared = study_of(pendulum);
  const auto solve = [&] { return shared.linearize(shared.static_equilibrium()).modes().modes[0].eigenvalue_hz; };
  const auto alone = solve();
  std::vector<std::complex<double>> found(10);
  std::vector<std::thread> threads;
  for (auto& f : found) {
    threads.emplace_back([&f, &solve] {
      for (int k = 0; k < 20; ++k) f = solve();
    });
  }
  for (auto& t : threads) t.join();
  for (const auto& f : found) EXPECT_EQ(f, alone);
}

TEST(Library, records_results_as_the_program_writes_them) {
  const auto study = study_of(pendulum.substr(0, 9) + pendulum.substr(pendulum.find("ACCGRAV")));
  dynalin::Record record(study.model());
  const auto point = study.static_equilibrium();
  record.add("rest", point);
  const auto linear = study.linearize(point);
  record.add("modes", linear, linear.modes());
  record.add("matrices", linear, linear.state_space());
  record.add("impossible", error_of([&] { study.linearize({.pstate = 5}); }));
  const auto json = nlohmann::json::parse(record.to_json());
  EXPECT_EQ(json["results"].size(), 3u);
  EXPECT_EQ(json["results"][0]["command"], "rest");
  EXPECT_TRUE(json["results"][0].contains("stability"));
  EXPECT_TRUE(json["results"][1].contains("modes"));
  EXPECT_TRUE(json["results"][2].contains("A"));
  EXPECT_EQ(json["warnings"][0]["code"], "no-units");
  EXPECT_EQ(json["errors"][0]["message"], "linear analysis: PSTATE/5 does not exist");
  EXPECT_EQ(json["status"], 2);
}

}  // namespace
