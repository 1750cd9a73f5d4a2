// The library as a program of others uses it.
#include <dynalin/dynalin.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "cases/as_others_do.h"

namespace library_test {
namespace {

using dynalin::Error;
using dynalin::as_others_do::error_of;
using dynalin::as_others_do::study_of;
using ::testing::HasSubstr;

const std::string pendulum =
    "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n! adams_view_name='bob'\nPART/2, "
    "MASS=1, CM=20, IP=0.1,0.1,0.1, QG=1,0,0, WZ=0\n"
    "MARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/3, FUNCTION=AZ(21,1)\nVARIABLE/4, "
    "FUNCTION=0\n"
    "SFORCE/1, ROTATIONAL, ACTIONONLY, I=20, J=20, FUNCTION=VARVAL(4)\nPINPUT/1, VARIABLES=4\nPOUTPUT/1, "
    "VARIABLES=3\nEND\n";
const double pendulum_hz = std::sqrt(9.81 / 1.1) / (2 * std::numbers::pi);

TEST(Library, exports_nastran_decks) {
  const auto study = study_of(pendulum);
  const auto linear = study.linearize(study.static_equilibrium());
  const auto deck = dynalin::nastran_deck(linear, dynalin::NastranBox::closed, "deck", "title = mine\nspc_set = 4\n");
  ASSERT_GE(deck.files.size(), 4u);
  EXPECT_EQ(deck.files[0].name, "deck.dat");
  EXPECT_THAT(deck.files[0].text, HasSubstr("TITLE = mine\n"));
  ASSERT_FALSE(deck.remarks.empty());
  EXPECT_EQ(deck.remarks[0].code, "ignored-directive");
  EXPECT_EQ(deck.remarks[0].line, 2u);
  const auto open = dynalin::nastran_deck(linear, dynalin::NastranBox::open, "deck");
  EXPECT_THAT(open.files[1].text, HasSubstr("CONM2*"));

  const auto folder = std::filesystem::temp_directory_path() / ("dynalin_deck_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const auto& file :
       dynalin::export_nastran(linear, dynalin::NastranBox::closed, (folder / "deck").string()).files)
    EXPECT_EQ(std::filesystem::file_size(file.name), file.text.size());
  std::filesystem::remove_all(folder);

  const Error wrong = error_of([&] {
    dynalin::nastran_deck(linear, dynalin::NastranBox::open, "deck", "mpc_set = x\nexport_markers_by_id = 99\n");
  });
  ASSERT_EQ(wrong.problems.size(), 2u);
  EXPECT_EQ(wrong.problems[0].column, 11u);
  const Error unknown = error_of(
      [&] { dynalin::nastran_deck(linear, dynalin::NastranBox::open, "deck", "export_markers_by_id = 99\n"); });
  EXPECT_THAT(unknown.what(), HasSubstr("configuration:1:24: error: MARKER/99 does not exist"));
  EXPECT_THROW(dynalin::export_nastran(linear, dynalin::NastranBox::closed, (folder / "none/deck").string()), Error);
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
  EXPECT_EQ(study.linearize(point).modes(dynalin::ModeShapes::left_out).shapes.cols(), 0);
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

// A cart on a spring: every number by name, and the model with another one is that of the edited text.
const std::string cart =
    "Cart\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, "
    "QP=0,0,1\nMARKER/3, PART=1, QP=0,0,-2\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=21, "
    "J=3, "
    "K=8, LENGTH=3\nBUSHING/7, I=20, J=1, K=0,0,10, KT=1,1,1\nEND\n";

std::complex<double> cart_hz(const dynalin::Model& model) {
  return dynalin::Study(model).linearize().modes().modes[0].eigenvalue_hz;
}
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Library, reads_and_replaces_numbers_by_name) {
  const auto model = dynalin::Model::from_text(cart);
  EXPECT_EQ(model.value("SPRINGDAMPER/1 K"), 8);
  EXPECT_EQ(model.value("BUSHING/7 K[3]"), 10);
  EXPECT_EQ(model.value({{"BUSHING", 7}, "K", 3}), 10);
  EXPECT_EQ(model.value("BUSHING/7 C[3]"), 0);
  EXPECT_EQ(model.value("ACCGRAV KGRAV"), 0);
  EXPECT_EQ(model.value("INTEGRATOR ERROR"), 1e-3);
  EXPECT_EQ(model.value("EQUILIBRIUM IMBALANCE"), 1e-4);
  const auto stiff = model.with("SPRINGDAMPER/1 K", 50);
  EXPECT_EQ(stiff.value("SPRINGDAMPER/1 K"), 50);
  EXPECT_EQ(model.value("SPRINGDAMPER/1 K"), 8);
  EXPECT_EQ(cart_hz(stiff), cart_hz(dynalin::Model::from_text(replaced(cart, "K=8", "K=50"))));
  EXPECT_NEAR(cart_hz(stiff).imag(), std::sqrt(60 / 2.0) / (2 * std::numbers::pi), 1e-14);
  // Several at once, and once more of what came out.
  const auto heavy = stiff.with({{"PART/2 MASS", 5}, {"BUSHING/7 K[3]", 30}, {"BUSHING/7 C[3]", 0.25}});
  EXPECT_EQ(cart_hz(heavy),
            cart_hz(dynalin::Model::from_text(replaced(
                replaced(replaced(cart, "K=8", "K=50"), "K=0,0,10", "K=0,0,30, C=0,0,0.25"), "MASS=2", "MASS=5"))));
  EXPECT_EQ(cart_hz(heavy.with({})), cart_hz(heavy));
  EXPECT_EQ(heavy.title(), "Cart");
}

TEST(Library, refuses_parameters_with_code_and_hint) {
  const auto model = dynalin::Model::from_text(cart);
  const Error spelt = error_of([&] { model.value("SPRINGDAMPER/1 LENGHT"); });
  EXPECT_EQ(spelt.problems.at(0).code, "unknown-argument");
  EXPECT_EQ(spelt.problems.at(0).hint, "did you mean LENGTH?");
  EXPECT_EQ(error_of([&] { model.value("SPRINGDAMPER K"); }).problems.at(0).code, "unknown-element");
  EXPECT_EQ(error_of([&] { model.value("K"); }).problems.at(0).code, "no-parameter");
  const Error two = error_of([&] { model.with({{"PART/9 MASS", 1}, {"PART/2 MASS[2]", 1}}); });
  ASSERT_EQ(two.problems.size(), 2u);
  EXPECT_EQ(two.problems[0].hint, "PART/2 exists");
  // What the number leads to is found by the reader of the element.
  const Error negative = error_of([&] { model.with("PART/2 MASS", -1); });
  EXPECT_EQ(negative.problems.at(0).code, "value-out-of-range");
  EXPECT_THAT(negative.what(), HasSubstr("MASS of PART/2 is -1"));
}

TEST(Library, models_of_a_study_are_made_in_threads) {
  const auto model = dynalin::Model::from_text(cart);
  std::vector<std::complex<double>> found(8);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < found.size(); ++k)
    threads.emplace_back([&, k] { found[k] = cart_hz(model.with("SPRINGDAMPER/1 K", 10.0 * static_cast<double>(k))); });
  for (auto& t : threads) t.join();
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k].imag(), std::sqrt((10 + 10.0 * static_cast<double>(k)) / 2) / (2 * std::numbers::pi), 1e-14);
}

TEST(Library, changes_a_model_by_commands) {
  const auto model = dynalin::Model::from_text(cart);
  const auto other = model.edited("SPRINGDAMPER/1, K=50\n! a lock less\ndeactivate/bush, id=7\n");
  EXPECT_NEAR(cart_hz(other).imag(), std::sqrt(50 / 2.0) / (2 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(cart_hz(other.edited("ACTIVATE/BUSHING, ID=7")).imag(), std::sqrt(60 / 2.0) / (2 * std::numbers::pi),
              1e-14);
  EXPECT_EQ(cart_hz(other.with("SPRINGDAMPER/1 K", 8)), cart_hz(model.edited("DEACTIVATE/BUSHING, ID=7")));
  EXPECT_EQ(other.value("SPRINGDAMPER/1 K"), 50);
  const Error wrong = error_of([&] { model.edited("SPRINGDAMPER/9, K=1\nSIMULATE/STATICS\nDEACTIVATE/PART, ID=2"); });
  ASSERT_EQ(wrong.problems.size(), 3u);
  EXPECT_THAT(wrong.what(), HasSubstr("edits:1:1: error: SPRINGDAMPER/9 does not exist"));
  EXPECT_THAT(wrong.what(), HasSubstr("SIMULATE is a command that changes no model"));
  EXPECT_EQ(error_of([&] { model.edited("PART/2, MASS=-1"); }).problems.at(0).code, "value-out-of-range");
}

// The pendulum at rest, let loose with another weight: where it hangs goes on, and so do a stated place and velocity.
TEST(Library, takes_points_over_into_changed_models) {
  const auto before = study_of(pendulum);
  const auto rest = before.static_equilibrium();
  const dynalin::Study after(before.model().with("ACCGRAV JGRAV", -2 * 9.81));
  const auto hanging = after.continued(rest);
  EXPECT_FALSE(hanging.is_consistent());
  EXPECT_NEAR(hanging.part(2).position[1], -1, 1e-12);
  EXPECT_NEAR(after.linearize(hanging).modes().modes[0].eigenvalue_hz.imag(), std::sqrt(2.0) * pendulum_hz, 1e-13);
  const dynalin::Study drawn(before.model().edited("PART/2, QG=1,0,0, WZ=3"));
  const auto moved = drawn.initial_conditions(drawn.continued(rest));
  EXPECT_NEAR(moved.part(2).position[0], 1, 1e-12);
  EXPECT_NEAR(moved.part(2).velocity[1], 3, 1e-12);
}

// Counted while the spring is away, whichever model the point goes on in.
TEST(Library, points_know_their_turns_in_changed_models) {
  const auto model = dynalin::Model::from_text(
      "turns\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/2, PART=1\nPART/2, MASS=1, CM=20, IP=1,1,2, WZ=30\n"
      "MARKER/20, PART=2\nJOINT/1, REVOLUTE, I=20, J=2\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=2, KT=0.1\nEND\n");
  const dynalin::Study away(model.edited("DEACTIVATE/SPRINGDAMPER, ID=1"));
  const auto turned = away.simulate(away.initial_conditions(), {.end = 0.5, .steps = 5}).point;
  for (const auto& back : {model, away.model().edited("ACTIVATE/SPRINGDAMPER, ID=1")}) {
    const dynalin::Study study(back);
    const auto point = study.initial_conditions(study.continued(turned));
    EXPECT_NEAR(point.load({"SPRINGDAMPER", 1}).torque[2], -0.1 * 30 * 0.5, 1e-6);
  }
}

// Two calls that stand as far from the beginnings of two texts are two.
TEST(Library, tells_delays_apart_by_their_texts) {
  const std::string dataset =
      "delays\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nDIFF/1, IC=1, FUNCTION=-DIF(1)\n"
      "DIFF/2, IC=1, FUNCTION=-DELAY(DIF(2),1,1)\nVARIABLE/1, FUNCTION=DIF(1)\nVARIABLE/2, FUNCTION=DIF(2)\nEND\n";
  const std::string edit = "DIFF/1, FUNCTION=-3*DELAY(DIF(1),1,1)";
  const std::size_t before = dataset.find("DELAY(") - edit.find("DELAY(");
  const dynalin::Study study(dynalin::Model::from_text(dataset).edited(std::string(before, '\n') + edit));
  const auto run = study.simulate(study.initial_conditions(), {.end = 0.5, .steps = 5});
  EXPECT_NEAR(run.history.variables.at(0).values.back(), 1 - 3 * 0.5, 1e-6);
  EXPECT_NEAR(run.history.variables.at(1).values.back(), 1 - 0.5, 1e-6);
}

// What any of the edits has stated anew since begins so; what was stated before the point was found does not again.
// Its values would be found in the place of those of the model that is asked.
TEST(Library, refuses_points_of_another_model) {
  const auto before = dynalin::Model::from_text(pendulum);
  const auto point = dynalin::Study(before).static_equilibrium();
  const dynalin::Study after(before.with("ACCGRAV JGRAV", -4 * 9.81)), other = study_of(pendulum);
  const std::vector<std::function<void()>> uses = {
      [&] { after.linearize(point); }, [&] { after.initial_conditions(point); },
      [&] { after.static_equilibrium(point); }, [&] { after.simulate(point, {.end = 0.1}); },
      [&] { other.linearize(point); }};
  for (const auto& use : uses) EXPECT_THAT(error_of(use).what(), HasSubstr("the point belongs to another model"));
  const auto modes = after.linearize(after.continued(point)).modes();
  EXPECT_NEAR(modes.modes.at(0).eigenvalue_hz.imag(), 2 * pendulum_hz, 1e-12);
}

TEST(Library, refuses_requests_that_are_out_of_range) {
  const auto study = study_of(pendulum);
  const auto start = study.initial_conditions();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const auto refuses = [&](const auto& use, const char* why) { EXPECT_THAT(error_of(use).what(), HasSubstr(why)); };
  const auto simulation = [&](dynalin::SimulationRequest request, const char* why) {
    refuses([&] { study.simulate(start, request); }, why);
  };
  simulation({.end = infinite}, "the end, inf");
  simulation({.end = 0}, "the end, 0, is not a time after the present one, 0");
  simulation({.end = 1, .output_step = 0.1, .steps = 10}, "either the time between outputs is stated or their number");
  simulation({.end = 1, .output_step = -0.1}, "output_step is -0.1");
  simulation({.end = 1, .steps = 0}, "steps is 0");
  simulation({.end = 1, .error = nan}, "error is nan");
  simulation({.end = 1, .error = 0}, "error is 0 and must be more than 0");
  simulation({.end = 1, .largest_step = -1}, "largest_step is -1");
  simulation({.end = 1, .first_step = -1}, "first_step is -1");
  simulation({.end = 1, .least_step = -1}, "least_step is -1 and may not be less than 0");
  simulation({.end = 1, .largest_order = 0}, "largest_order is 0 and must be at least 1");
  const auto statics = [&](dynalin::StaticRequest request, const char* why) {
    refuses([&] { study.static_equilibrium(start, request); }, why);
  };
  statics({.error = -1}, "error is -1"), statics({.imbalance = nan}, "imbalance is nan");
  statics({.translation_limit = -1}, "translation_limit is -1");
  statics({.iteration_limit = 0}, "iteration_limit is 0");
  statics({.settling_time = -1}, "settling_time is -1");
  refuses([&] { study.initial_conditions(start, {.error = -1}); }, "error is -1");
  const auto linear = study.linearize(start);
  const auto modes = [&](dynalin::ModeSelection selection, const char* why) {
    refuses([&] { linear.modes(selection); }, why);
  };
  modes(dynalin::ModesInBand{30, 10}, "0 ≤ low < high, not 30 and 10");
  modes(dynalin::ModesInBand{-5, 1}, "not -5 and 1"), modes(dynalin::ModesInBand{0, nan}, "not 0 and nan");
  modes(dynalin::NearestModes{1, -3}, "frequency is -3");
  // All of it at once.
  const Error both = error_of([&] { study.simulate(start, {.end = 1, .error = -1, .largest_step = -2}); });
  EXPECT_THAT(both.what(), ::testing::AllOf(HasSubstr("error is -1"), HasSubstr("largest_step is -2")));
}

TEST(Library, takes_points_over_through_several_edits) {
  const auto before = study_of(pendulum);
  const auto rest = before.static_equilibrium();
  const auto stated = before.model().edited("PART/2, QG=1,0,0, WZ=3");
  const auto heavy = stated.with("ACCGRAV JGRAV", -2 * 9.81);
  const dynalin::Study after(heavy.edited("VARIABLE/3, FUNCTION=2*DX(20,1)"));
  const auto moved = after.initial_conditions(after.continued(rest));
  EXPECT_NEAR(moved.part(2).position[0], 1, 1e-12);
  EXPECT_NEAR(moved.part(2).velocity[1], 3, 1e-12);
  const auto hanging = dynalin::Study(heavy).static_equilibrium();
  EXPECT_NEAR(after.continued(hanging).part(2).position[1], -1, 1e-12);
  // Beside each other: nothing of the one is stated in the other.
  const dynalin::Study beside(before.model().with("ACCGRAV JGRAV", -5));
  EXPECT_NEAR(beside.continued(rest).part(2).position[1], -1, 1e-12);
  EXPECT_NEAR(after.continued(beside.static_equilibrium()).part(2).position[0], 1, 1e-12);
  // A point of the model itself stays what it is.
  EXPECT_TRUE(after.continued(moved).is_consistent());
}

TEST(Library, tables_want_shapes_of_the_model_itself) {
  const auto linear = study_of(pendulum).linearize();
  dynalin::ModalTableRequest request;
  request.modes["KINETIC"] = dynalin::ModeRange::all();
  const auto refused = [&](const dynalin::EigenSolution& modes) {
    try {
      linear.tables(modes, request);
    } catch (const dynalin::Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(linear.modes()), "");
  EXPECT_THAT(refused(linear.modes(dynalin::ModeShapes::left_out)), HasSubstr("they need mode shapes"));
  auto cut = linear.modes();
  cut.vectors.conservativeResize(Eigen::NoChange, 1);
  EXPECT_THAT(refused(cut), HasSubstr("vectors or shapes of other sizes"));
  const auto other = study_of(replaced(pendulum, "VARIABLE/3", "DIFF/7, FUNCTION=-DIF(7)\nVARIABLE/3")).linearize();
  EXPECT_THAT(refused(other.modes()), HasSubstr("the modes are those of another linear model"));
}

TEST(Library, has_the_values_of_requests_at_a_point) {
  const auto study = study_of(replaced(
      pendulum, "VARIABLE/3", "REQUEST/1, DISPLACEMENT, I=20, J=1\nREQUEST/2, F2=2*DX(20,1)\\F6=VZ(20,1)\nVARIABLE/3"));
  const auto drawn = study.initial_conditions();
  const auto requests = drawn.requests();
  ASSERT_EQ(requests.size(), 2u);
  EXPECT_EQ(requests[0].request.text(), "REQUEST/1");
  EXPECT_EQ(requests[0].components.size(), requests[0].values.size());
  const auto value = [](const dynalin::RequestValues& r, const std::string& component) {
    const auto found = std::find(r.components.begin(), r.components.end(), component);
    return r.values.at(static_cast<std::size_t>(found - r.components.begin()));
  };
  EXPECT_NEAR(value(requests[0], "X"), drawn.marker(20).position[0], 1e-14);
  EXPECT_NEAR(value(requests[1], "F2"), 2 * drawn.marker(20).position[0], 1e-14);
  const auto hanging = study.static_equilibrium().requests();
  EXPECT_NEAR(value(hanging[0], "Y"), -1, 1e-12);
}

// A second hinge of the pendulum, further along its axis than the first one allows.
TEST(Library, takes_how_far_redundant_constraints_may_disagree) {
  auto text = replaced(pendulum, "MARKER/1\n", "MARKER/1\nMARKER/2, QP=0,0,1\n");
  text = replaced(text, "MARKER/20\n", "MARKER/20\nMARKER/22, QP=-1,0,1.00001\n");
  const auto study = study_of(replaced(text, "VARIABLE/3", "JOINT/2, REVOLUTE, I=22, J=2\nVARIABLE/3"));
  EXPECT_EQ(error_of([&] { study.initial_conditions(); }).analysis, "initial conditions");
  const auto point = study.initial_conditions(study.as_drawn(), {.error = 1e-3});
  EXPECT_TRUE(point.is_consistent());
  EXPECT_EQ(point.redundant_rows().size(), 5u);
}

TEST(Library, tells_mass_damping_and_stiffness_of_the_whole_and_of_elements) {
  const auto model = dynalin::Model::from_text(cart).with({{"SPRINGDAMPER/1 C", 0.5}, {"BUSHING/7 C[3]", 0.25}});
  const auto linear = dynalin::Study(model).linearize();
  const auto whole = linear.physical_matrices();
  ASSERT_EQ(whole.coordinates.size(), 1u);
  EXPECT_NEAR(whole.force.of_accelerations(0, 0), 2, 1e-14);
  EXPECT_NEAR(whole.force.of_rates(0, 0), 0.75, 1e-14);
  EXPECT_NEAR(whole.force.of_coordinates(0, 0), 18, 1e-13);
  double stiffness = 0;
  for (const auto& [element, force] : linear.element_matrices()) {
    stiffness += force.of_coordinates(0, 0);
    if (element.statement == "SPRINGDAMPER") {
      EXPECT_NEAR(force.of_coordinates(0, 0), 8, 1e-13);
    }
    if (element.statement == "BUSHING") {
      EXPECT_NEAR(force.of_rates(0, 0), 0.25, 1e-14);
    }
    if (element.statement == "PART") {
      EXPECT_NEAR(force.of_accelerations(0, 0), 2, 1e-14);
    }
  }
  EXPECT_NEAR(stiffness, 18, 1e-13);
}

// A body on an unloaded bushing, along x, y, z of its mass centre and ψ, θ, φ of its principal axes: turned by
// J (ψ′, θ′, φ′) with the columns z of the ground, the line of nodes and z of the body, so that M = Jᵀ R I Rᵀ J and
// K = Jᵀ KT J.
TEST(Library, tells_mass_damping_and_stiffness_along_original_coordinates) {
  const double psi = 0.4, theta = 1.1, phi = -0.7;
  const auto study = study_of(
      "Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,2,3\n"
      "MARKER/20, REULER=0.4,1.1,-0.7\nMARKER/21\n"
      "BUSHING/1, I=21, J=1, K=5,6,7, KT=8,9,10, C=0.5,0.6,0.7, CT=0.8,0.9,1\nEND\n");
  const auto found = study.linearize(study.static_equilibrium(), {.original = true}).physical_matrices();
  ASSERT_EQ(found.coordinates.size(), 6u);
  Eigen::Matrix3d J, R;
  J << 0, std::cos(psi), std::sin(psi) * std::sin(theta), 0, std::sin(psi), -std::cos(psi) * std::sin(theta), 1, 0,
      std::cos(theta);
  const auto about = [](const Eigen::Vector3d& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  R = about(Eigen::Vector3d::UnitZ(), psi) * about(Eigen::Vector3d::UnitX(), theta) *
      about(Eigen::Vector3d::UnitZ(), phi);
  const auto of_turns = [&](const Eigen::Matrix3d& m) -> Eigen::Matrix3d { return J.transpose() * m * J; };
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6, 6), C = M, K = M;
  M.topLeftCorner(3, 3) = 2 * Eigen::Matrix3d::Identity();
  M.bottomRightCorner(3, 3) = of_turns(R * Eigen::Vector3d(1, 2, 3).asDiagonal() * R.transpose());
  C.topLeftCorner(3, 3) = Eigen::Vector3d(0.5, 0.6, 0.7).asDiagonal();
  C.bottomRightCorner(3, 3) = of_turns(Eigen::Vector3d(0.8, 0.9, 1).asDiagonal());
  K.topLeftCorner(3, 3) = Eigen::Vector3d(5, 6, 7).asDiagonal();
  K.bottomRightCorner(3, 3) = of_turns(Eigen::Vector3d(8, 9, 10).asDiagonal());
  std::vector<Eigen::Index> order;  // x, y, z, ψ, θ, φ
  for (const auto& label : found.coordinates) order.push_back(label.coordinate - 1);
  for (Eigen::Index r = 0; r < 6; ++r) {
    for (Eigen::Index c = 0; c < 6; ++c) {
      const auto i = order[static_cast<std::size_t>(r)], j = order[static_cast<std::size_t>(c)];
      EXPECT_NEAR(found.force.of_accelerations(r, c), M(i, j), 1e-13) << i << ' ' << j;
      EXPECT_NEAR(found.force.of_rates(r, c), C(i, j), 1e-13) << i << ' ' << j;
      EXPECT_NEAR(found.force.of_coordinates(r, c), K(i, j), 1e-12) << i << ' ' << j;
    }
  }
}

using Elements = std::vector<dynalin::StatedElement>;

Elements cart_elements(double stiffness) {
  return {{{"UNITS", 0}, {{"SYSTEM", "MKS"}}},
          {{"PART", 1}, {"GROUND"}},
          {{"MARKER", 1}, {}},
          {{"MARKER", 3}, {{"PART", 1}, {"QP", {0.0, 0.0, -2.0}}}},
          {{"PART", 2}, {{"MASS", 2.0}, {"CM", 20}, {"IP", {1.0, 1.0, 1.0}}}, "cart"},
          {{"MARKER", 20}, {{"PART", 2}}},
          {{"MARKER", 21}, {{"PART", 2}, {"QP", {0.0, 0.0, 1.0}}}},
          {{"JOINT", 1}, {"TRANSLATIONAL", {"I", 20}, {"J", 1}}},
          {{"SPRINGDAMPER", 1}, {"TRANSLATIONAL", {"I", 21}, {"J", 3}, {"K", stiffness}, {"LENGTH", 3.0}}},
          {{"SFORCE", 4}, {"TRANSLATIONAL", {"I", 20}, {"J", 3}, {"FUNCTION", "-10*(DM(20,3)-2)"}}}};
}

TEST(Library, builds_models_of_statements_without_text) {
  const auto model = dynalin::Model::build("Cart", cart_elements(1.0 / 3));
  EXPECT_EQ(model.title(), "Cart");
  EXPECT_EQ(model.value("SPRINGDAMPER/1 K"), 1.0 / 3);
  EXPECT_NEAR(cart_hz(model).imag(), std::sqrt((10 + 1.0 / 3) / 2) / (2 * std::numbers::pi), 1e-14);
  EXPECT_EQ(dynalin::Study(model).as_drawn().part(2).name, "PART/2 (cart)");
  EXPECT_NEAR(cart_hz(model.with("SPRINGDAMPER/1 K", 8)).imag(), 3 / (2 * std::numbers::pi), 1e-14);
}

TEST(Library, names_statement_and_argument_of_what_is_built_wrongly) {
  const auto fault = [](const dynalin::StatedElement& s) {
    auto all = cart_elements(8);
    all.push_back(s);
    return std::string(error_of([&] { dynalin::Model::build("x", all); }).what());
  };
  EXPECT_THAT(fault({{"PART", 3}, {{"MASS", -1.0}}}), HasSubstr("error: MASS of PART/3 is -1, it must be at least 0"));
  EXPECT_THAT(fault({{"PART", 3}, {{"MAS5", 1.0}}}), HasSubstr("PART has no argument MAS5"));
  EXPECT_THAT(fault({{"WHEEL", 3}, {}}), HasSubstr("WHEEL"));
  EXPECT_THAT(fault({{"BUSHING", 3}, {{"I", 20}, {"J", 77}}}), HasSubstr("MARKER/77"));
  // What is one value cannot become two arguments, or a statement.
  EXPECT_THAT(fault({{"VARIABLE", 3}, {{"FUNCTION", "1, IC=5"}}}), HasSubstr("is read with 2"));
  EXPECT_THAT(fault({{"VARIABLE", 3}, {{"FUNCTION", "1\nPART/9"}}}), HasSubstr("VARIABLE/3: the value of FUNCTION"));
  EXPECT_THAT(fault({{"PART", 3}, {{"MASS", std::numeric_limits<double>::quiet_NaN()}}}),
              HasSubstr("no finite number"));
  EXPECT_THAT(fault({{"PART", 3}, {"GROUND\nEND"}}), HasSubstr("no name of an argument"));
  auto ended = cart_elements(8);
  ended.insert(ended.begin() + 2, dynalin::StatedElement{{"END", 0}});
  EXPECT_THAT(error_of([&] { dynalin::Model::build("x", ended); }).what(), HasSubstr("11 statements are read as 2"));
}

}  // namespace
}  // namespace library_test
