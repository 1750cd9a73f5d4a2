// SAVE and RELOAD: a point, or a model with its point, goes on in the same run, in another one, in another model; files
// that are not what SAVE wrote are refused before anything runs.
#include <gmock/gmock.h>

#include "cases/flexible.h"
#include "cases/run.h"
#include "output/saved_file.h"

namespace dynalin::cases::save_reload_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A swinging pendulum with a state and a turn count, whose numbers are no round ones.
const std::string head =
    "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1.3, CM=20, "
    "IP=0.1,0.2,0.3, QG=0.7,-0.2,0, WZ=0.37\nMARKER/20\nMARKER/21, QP=-0.7,0.2,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
    "DIFF/1, FUNCTION=-3*DIF(1)+VX(20,1), IC=0.1234567\nVARIABLE/1, FUNCTION=AZ(20,1)+DIF(1)\n";
const std::string pendulum = head + "END\n";

class SaveReload : public Cases {
 protected:
  nlohmann::json point(const RunResult& r, std::size_t k) const { return r.result(k).at("operating_point"); }
  RunResult commands(const std::string& file, const std::string& text) const {
    write(file, text);
    return run_file(file);
  }
};

TEST_F(SaveReload, states_come_back_to_the_last_bit_in_the_same_run) {
  const RunResult r = run(pendulum,
                          "SIMULATE/INITIAL\nSAVE/STATES, FILE=a.save, TITLE=before all\nSIMULATE/STATICS\n"
                          "RELOAD/STATES, FILE=a.save\nSIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("a.save"));
  EXPECT_NE(point(r, 0), point(r, 2));
  EXPECT_EQ(point(r, 0), point(r, 4));
  EXPECT_EQ(point(r, 0), point(r, 5));
  EXPECT_THAT(r.message, HasSubstr("Reloaded the states at time"));
  EXPECT_THAT(r.err, Not(HasSubstr("reloaded-in-part"))) << r.err;
}

// A body whose file has got another mode keeps its place, not its shape.
TEST_F(SaveReload, a_body_of_other_modes_is_said_to_have_these) {
  const Vector up{0, 1, 0}, none{};
  const auto body = [&](std::vector<Vector> first, std::vector<Vector> second) {
    const auto modes = static_cast<Eigen::Index>(first.size());
    const std::vector<Vector> still(first.size(), none);
    const std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 1, {.1, .1, .1}, std::move(first), still},
                                             {2, {1, 0, 0}, 1, {.1, .1, .1}, std::move(second), still}};
    write("body.fem", modal_text(nodes, 1e3 * Eigen::MatrixXd::Identity(modes, modes)));
  };
  const std::string dataset =
      "Body\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=body.fem\n"
      "MARKER/21, NODE_ID=1\nJOINT/1, FIXED, I=21, J=1\nEND\n";
  body({none}, {up});
  ASSERT_EQ(run(dataset, "SIMULATE/STATICS\nSAVE/STATES, FILE=one.save\n").status, 0);
  body({none, none}, {up, {0, 0, 1}});
  const RunResult r = run(dataset, "RELOAD/STATES, FILE=one.save\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("has other coordinates of FLEX_BODY/2 than the model"));
  EXPECT_THAT(r.err, Not(HasSubstr("does not have")));
  EXPECT_THAT(r.err, Not(HasSubstr("has no values of")));
}

// Nodes of a beam that has another number of them stand elsewhere.
TEST_F(SaveReload, a_beam_of_other_nodes_starts_as_drawn) {
  const auto beam = [](const std::string& nodes) {
    return "Beam\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\n"
           "MATERIAL/1, DENSITY=2700, YOUNGS_MODULUS=7E9, POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, MATERIAL=1, " +
           nodes +
           ", AREA=4E-4, IYY=3E-8, IZZ=1E-8\nMARKER/21, FE_PART=2, NODE_LABEL=1\n"
           "MARKER/22, FE_PART=2, NODE_LABEL=5, QP=1,0,0\nJOINT/1, FIXED, I=21, J=1\nVARIABLE/1, FUNCTION=DX(22)\n"
           "REQUEST/1, VARIABLES=1\nEND\n";
  };
  const std::string five = beam("NODE_LABELS=1,2,3,4,5, X=0,.25,.5,.75,1"), three = "NODE_LABELS=1,3,5, X=0,.5,1";
  const auto reach = [&](const RunResult& r, std::size_t k) {
    EXPECT_EQ(r.status, 0) << r.err;
    return point(r, k).at("requests").at(0).at("values").at(0).get<double>();
  };
  ASSERT_EQ(run(five, "SIMULATE/STATICS\nSAVE/STATES, FILE=five.save\n").status, 0);
  const RunResult r = run(beam(three), "RELOAD/STATES, FILE=five.save\nSIMULATE/INITIAL_CONDITIONS\n");
  EXPECT_NEAR(reach(r, 1), 1, 1e-9);
  EXPECT_THAT(r.err, HasSubstr("FE_PART/2, which start as the model states them"));
  const RunResult edited = run(five, "SIMULATE/STATICS\nFE_PART/2, " + three + "\nSIMULATE/INITIAL_CONDITIONS\n");
  EXPECT_NEAR(reach(edited, 2), 1, 1e-9);
}

TEST_F(SaveReload, a_static_solution_is_one_after_reloading) {
  const RunResult r = run(pendulum,
                          "SIMULATE/STATICS\nLINEAR/EIGENSOL, ORIGINAL\nSAVE/STATES, FILE=a.save\nSIMULATE/INITIAL\n"
                          "RELOAD/STATES, FILE=a.save\nLINEAR/EIGENSOL, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(1).at("eigenvalues"), r.result(5).at("eigenvalues"));
  EXPECT_EQ(point(r, 1), point(r, 5));
}

TEST_F(SaveReload, a_system_reloads_without_its_dataset_and_goes_on_with_edits_and_settings) {
  const RunResult first = run(pendulum,
                              "PART/2, MASS=2.7 ! heavier\nDIFF/1, &\n ! a note\n, FUNCTION=-4*DIF(1)\n"
                              "EQUILIBRIUM/ALIMIT=1D\nENVIRONMENT/NAME=MSC_LINEAR_PBCS_STATES\nSIMULATE/INITIAL\n"
                              "SAVE/SYSTEM, FILE=whole.save\nLINEAR/EIGENSOL\nSIMULATE/STATICS\n");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.json.at("files").dump(), HasSubstr("whole.save"));
  std::filesystem::remove(folder_ / "model.adm");
  const RunResult r = commands("later.acf", "RELOAD/SYSTEM, FILE=whole.save\nLINEAR/EIGENSOL\nSIMULATE/STATICS\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(1).at("eigenvalues"), first.result(6).at("eigenvalues"));
  EXPECT_EQ(r.result(1).at("states"), first.result(6).at("states")) << "the environment is part of it";
  EXPECT_EQ(point(r, 1), point(first, 6));
  EXPECT_EQ(r.result(2).at("iterations"), first.result(7).at("iterations")) << "the settings are part of it";
  EXPECT_TRUE(r.wrote("whole.msg"));
}

// Method of steps: y' = -y(t - 0.5) with y = 1 before the start goes on from its past, which no state shows.
TEST_F(SaveReload, the_past_that_delays_read_goes_on) {
  const std::string late =
      "Late\nPART/1, GROUND\nDIFF/1, FUNCTION=-DELAY(DIF(1), 0.5, 1), IC=1\n"
      "VARIABLE/1, FUNCTION=DIF(1)\nEND\n";
  const RunResult first = run(late,
                              "SIMULATE/DYNAMICS, END=0.75, STEPS=3\nSAVE/SYSTEM, FILE=past.save\n"
                              "SIMULATE/DYNAMICS, END=2, STEPS=5\n");
  ASSERT_EQ(first.status, 0) << first.err;
  const RunResult r = commands("later.acf", "RELOAD/SYSTEM, FILE=past.save\nSIMULATE/DYNAMICS, END=2, STEPS=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(1).at("history"), first.result(2).at("history"));
  const double half = first.result(0).at("history").at("variables").at("1").back();
  EXPECT_NEAR(half, 0.25 + 0.5 * 0.25 * 0.25, 1e-4) << "1 - t to 0.5, then with the slope -(1 - (t - 0.5))";
}

TEST_F(SaveReload, a_system_that_the_run_itself_saves_is_loaded_when_its_turn_comes) {
  const RunResult r =
      run(pendulum,
          "SIMULATE/INITIAL\nSAVE/SYSTEM, FILE=s\nPART/2, MASS=5\nSIMULATE/STATICS\n"
          "RELOAD/SYSTEM, FILE=s\nLINEAR/EIGENSOL\nPART/2, MASS=2\nVARIABLE/1, FUNCTION=3\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(point(r, 5), point(r, 0));
  const RunResult wrong =
      run(pendulum, "SIMULATE/INITIAL\nSAVE/SYSTEM, FILE=t\nRELOAD/SYSTEM, FILE=t\nLINEAR/EIGENSOL, RM=77\n");
  EXPECT_EQ(wrong.status, 2) << "known only when it runs";
  EXPECT_THAT(wrong.err, HasSubstr("refers to MARKER/77, which does not exist"));
  EXPECT_THAT(wrong.message, HasSubstr("Ended early"));
}

TEST_F(SaveReload, states_go_to_the_elements_that_are_there_and_the_others_are_named) {
  ASSERT_EQ(run(pendulum, "SIMULATE/STATICS\nSAVE/STATES, FILE=s\n").status, 0);
  std::string other = head;
  other.replace(other.find("DIFF/1"), 6, "DIFF/7");
  while (other.find("DIF(1)") != std::string::npos) other.replace(other.find("DIF(1)"), 6, "DIF(7)");
  write("other.adm", other + "END\n");
  const RunResult r = commands("go.acf", "other\ngo\nRELOAD/STATES, FILE=s\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("s has values of DIFF/1, which the model does not have"));
  EXPECT_THAT(r.err, HasSubstr("s has no values of DIFF/7, which start as the model states them"));
  EXPECT_NEAR(point(r, 1)["bodies"][0]["position"][0].get<double>(), 0, 1e-12) << "hangs";
}

// A part and a hinge that the file does not know start with the velocities that the model states; the others go on.
TEST_F(SaveReload, what_was_not_saved_starts_with_its_velocity) {
  const RunResult first = run(pendulum, "SIMULATE/DYNAMICS, END=0.3\nSAVE/STATES, FILE=s\n");
  ASSERT_EQ(first.status, 0) << first.err;
  write("more.adm", head +
                        "PART/3, MASS=2, CM=30, IP=1,1,1, QG=5,0,0, VX=0.5, WY=-4\nMARKER/30\n"
                        "PART/4, MASS=2, CM=40, IP=1,1,1, QG=9,0,0\nMARKER/40\nMARKER/9, PART=1, QP=9,0,0\n"
                        "JOINT/4, REVOLUTE, I=40, J=9, IC=0.2,7\nEND\n");
  const RunResult r = commands("go.acf", "more\ngo\nRELOAD/STATES, FILE=s\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("s has no values of PART/3, PART/4, JOINT/4, which start as the model states them"));
  const auto bodies = point(r, 1).at("bodies");
  EXPECT_NEAR(bodies[1].at("velocity")[0].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(bodies[1].at("angular_velocity")[1].get<double>(), -4, 1e-12);
  EXPECT_NEAR(bodies[2].at("angular_velocity")[2].get<double>(), 7, 1e-12);
  EXPECT_NEAR(bodies[2].at("axes")[0][0].get<double>(), std::cos(0.2), 1e-12);
  const double moved = point(first, 0).at("bodies")[0].at("angular_velocity")[2];
  EXPECT_NEAR(bodies[0].at("angular_velocity")[2].get<double>(), moved, 1e-9) << "not as it is stated";
}

TEST_F(SaveReload, further_output_files_begin_with_a_prefix_and_a_title) {
  const RunResult r = run(pendulum,
                          "SIMULATE/STATICS\nSAVE/STATES, FILE=s\nRELOAD/STATES, FILE=s, OUTPUT_PREFIX=second, "
                          "TITLE=another one\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("second.msg"), HasSubstr("another one"));
  EXPECT_THAT(r.text("second.msg"), HasSubstr("E I G E N V A L U E S"));
  EXPECT_THAT(r.message, Not(HasSubstr("E I G E N V A L U E S")));
  ASSERT_EQ(r.json.at("results").size(), 4u) << "one of each command";
  EXPECT_EQ(r.result(2).at("model"), "another one");
}

// The result of RELOAD that begins further files says which model follows, and the time of the point.
TEST_F(SaveReload, with_a_prefix_has_one_result) {
  const RunResult r = run(pendulum,
                          "SIMULATE/DYNAMICS, END=0.5\nSAVE/SYSTEM, FILE=s\nRELOAD/STATES, FILE=s, OUTPUT_PREFIX=p\n"
                          "RELOAD/SYSTEM, FILE=s, OUTPUT_PREFIX=q\nRELOAD/STATES, FILE=s\n");
  ASSERT_EQ(r.status, 0) << r.err;
  ASSERT_EQ(r.json.at("results").size(), 5u);
  for (const std::size_t k : {2u, 3u, 4u}) {
    EXPECT_EQ(r.result(k).contains("model"), k < 4) << k;
    EXPECT_EQ(r.result(k).at("time"), 0.5) << k;
  }
}

TEST_F(SaveReload, files_that_save_did_not_write_so_are_refused_before_anything_runs) {
  ASSERT_EQ(run(pendulum, "SIMULATE/STATICS\nSAVE/STATES, FILE=s\n").status, 0);
  const std::string good = read_file(folder_ / "s");
  const auto refused = [&](const std::string& text, const std::string& why) {
    write("bad", text);
    std::filesystem::remove(folder_ / "model.msg");
    const RunResult r = run(pendulum, "SIMULATE/INITIAL\nRELOAD/STATES, FILE=bad\n");
    EXPECT_EQ(r.status, 1) << why;
    EXPECT_THAT(r.err, HasSubstr("model.acf:4:21: error: bad cannot be reloaded: " + why));
    EXPECT_THAT(r.err, HasSubstr("[unusable-save]"));
    EXPECT_FALSE(r.wrote("model.msg"));
  };
  refused(good.substr(0, good.size() / 2), "it is cut off");
  refused("", "it was not written by SAVE");
  refused("PART/1, GROUND\n", "it was not written by SAVE");
  refused("{\"results\": []}", "it was not written by SAVE");
  std::string version = good;
  version.replace(version.find("\"version\": 3"), 12, "\"version\": 9");
  refused(version, "it is of version 9, and this program reads version 3");
  std::string altered = good;
  altered.replace(altered.find("\"iterations\": "), 14, "\"iterations\": 1");
  refused(altered, "it was altered");
  std::string lost = good;
  lost.replace(lost.find("\"multipliers\""), 13, "\"multipliara\"");
  refused(lost, "it was altered");
  const RunResult system = run(pendulum, "RELOAD/SYSTEM, FILE=s\n");
  EXPECT_EQ(system.status, 1);
  EXPECT_THAT(system.err, HasSubstr("it has states and no model"));
  EXPECT_EQ(run(pendulum, "RELOAD/STATES, FILE=nowhere\n").status, 1);
  EXPECT_EQ(run(pendulum, "SAVE/STATES\n").status, 1);
  EXPECT_EQ(run(pendulum, "SAVE/STATES, SYSTEM, FILE=a\n").status, 1);
  EXPECT_EQ(run(pendulum, "RELOAD/STATES, FILE=s, TITLE=x\n").status, 1) << "a title without files to stand in";
}

TEST_F(SaveReload, a_file_that_another_tool_has_laid_out_anew_is_still_the_same) {
  const RunResult first = run(pendulum, "SIMULATE/STATICS\nSAVE/STATES, FILE=s\n");
  ASSERT_EQ(first.status, 0) << first.err;
  write("t", nlohmann::ordered_json::parse(read_file(folder_ / "s")).dump());
  const RunResult r = run(pendulum, "RELOAD/STATES, FILE=t\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
}

// Bytes that are no UTF-8, and numbers that hardly are any.
TEST(SavedFile, keeps_texts_byte_by_byte_and_numbers_bit_by_bit) {
  SavedFile file;
  file.title = "K\xE4se \x80 ";
  file.model_title = "K\xC3\xA4se";
  file.system = SavedFile::Model{};
  file.system->text = "a\xFF\nb\t\"";
  file.point.time = 0.1 + 0.2;
  file.point.states = {{{"DIFF", 1, "1", 0}, -0.0, 5e-324}, {{"DIFF", 2, "1", 1}, 1.7976931348623157e308, 1.0 / 3}};
  const auto text = saved_text(file);
  ASSERT_TRUE(text);
  const auto back = read_saved(*text);
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->title, file.title);
  EXPECT_EQ(back->model_title, file.model_title);
  EXPECT_EQ(back->system->text, file.system->text);
  EXPECT_EQ(back->point.time, file.point.time);
  ASSERT_EQ(back->point.states.size(), 2u);
  EXPECT_TRUE(std::signbit(back->point.states[0].value));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(back->point.states[k].of, file.point.states[k].of);
    EXPECT_EQ(back->point.states[k].rate, file.point.states[k].rate);
    EXPECT_EQ(back->point.states[k].value, file.point.states[k].value);
  }
  file.point.time = std::nan("");
  EXPECT_FALSE(saved_text(file));
}

}  // namespace
}  // namespace dynalin::cases::save_reload_test
