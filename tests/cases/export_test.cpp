// LINEAR/EXPORT as a command: which files it writes, what it says, and what it refuses.
#include <gmock/gmock.h>

#include "cases/run.h"
#include "command/help.h"
#include "nastran/directive_manual.h"
#include "nastran/directives.h"
#include "places/source_tree.h"

namespace dynalin::cases::export_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string model =
    "oscillator\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n! adams_view_name='seat'\nPART/2, MASS=2, CM=20, "
    "IP=1,1,1\n"
    "! adams_view_name='head'\nMARKER/20\nMARKER/21, QP=0,0,1\nMARKER/22, PART=1, FLOATING\nJOINT/1, TRANSLATIONAL, "
    "I=20, J=1\n"
    "VFORCE/1, I=21, JFLOAT=22, RM=1, FX=0, FY=0, FZ=0\nBUSHING/1, I=20, J=1, K=0,0,8, C=0,0,6\nEND\n";
const std::string response =
    "solution_number = 108\nbegin_frequency = 1\nend_frequency = 9\nsteps_frequency = 8\n"
    "actuator_swept_sine { name = a }\nforce_input_channel { name = in marker_id = 21 dof = z actuator_name = a }\n"
    "displacement_output_channel { name = out marker_name = head }\n"
    "frequency_response_subcase { number = 1 input_channel_names = in output_channel_names = out }\n";

class Export : public Cases {
 protected:
  RunResult run_with(const std::string& configuration, const std::string& type, const std::string& file = "deck") {
    write("export.cfg", configuration);
    return run(model, "LINEAR/EXPORT, TYPE=" + type + ", FILE=" + file + ", CONFIG=export.cfg\n");
  }
};

TEST_F(Export, writes_a_deck_with_a_linear_model_in_matrices) {
  const RunResult r = run(model, "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=deck\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("deck.dat"),
              AllOf(HasSubstr("SOL 107\nCEND\n"), HasSubstr("INCLUDE 'deck_KVVV.bdf'\n"), HasSubstr("ENDDATA\n")));
  // M s² + B s + K of the only freedom: 2, 6 and 8.
  EXPECT_THAT(r.text("deck_MVVV.bdf"), HasSubstr("2.D0\n"));
  EXPECT_THAT(r.text("deck_BVVV.bdf"), HasSubstr("6.D0\n"));
  EXPECT_THAT(r.text("deck_KVVV.bdf"), HasSubstr("8.D0\n"));
  EXPECT_THAT(r.out, AllOf(HasSubstr("Nastran deck, CLOSEDBOX: "), HasSubstr("deck_KVVV.bdf")));
  EXPECT_THAT(r.message, HasSubstr("Nastran deck, CLOSEDBOX"));
}

TEST_F(Export, has_its_files_in_the_json) {
  const RunResult r = run(model, "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=deck\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("export"), "CLOSEDBOX");
  EXPECT_EQ(r.result(0).at("time"), 0);
  EXPECT_EQ(r.result(0).at("files").size(), 5u);
  EXPECT_EQ(r.result(0).at("files").at(0), (folder_ / "deck.dat").string());
  EXPECT_EQ(r.result(0).at("operating_point").at("bodies").size(), 1u);
  for (const auto& file : r.result(0).at("files")) {
    const auto& all = r.json.at("files");
    EXPECT_NE(std::find(all.begin(), all.end(), file), all.end()) << file;
  }
}

TEST_F(Export, writes_the_mechanism_element_by_element) {
  const RunResult r =
      run_with("use_long_format = no\nuse_dmig_long_format = no\nexport_markers_by_name = head\n", "OPENBOX");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("deck_MODEL.nas"), AllOf(HasSubstr("CONM2   "), HasSubstr("head"), HasSubstr("GRID    100002 ")));
  EXPECT_THAT(r.text("deck.dat"), HasSubstr("PARAM,AUTOMSET,LUSOL\n"));
}

TEST_F(Export, reads_its_configuration_relative_to_the_command_file) {
  std::filesystem::create_directories(folder_ / "sub");
  write("sub/export.cfg", "title = from the folder below\n");
  const RunResult r = run(model, "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=sub/deck, CONFIG=sub/export.cfg\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("sub/deck.dat"),
              AllOf(HasSubstr("TITLE = from the folder below\n"), HasSubstr("INCLUDE 'deck_MODEL.nas'\n")));
}

TEST_F(Export, has_channels_of_frequency_response) {
  for (const std::string type : {"OPENBOX", "CLOSEDBOX"}) {
    const RunResult r = run_with(response, type);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.text("deck.dat"), AllOf(HasSubstr("SOL 108\n"), HasSubstr("SUBCASE 1\n"), HasSubstr("FREQ1*  600 "),
                                          HasSubstr("FORCE*  300 "), Not(HasSubstr("CMETHOD"))))
        << type;
  }
}

TEST_F(Export, says_what_its_configuration_does) {
  const RunResult r = run_with("debug = yes\nmpc_set = 7\nspc_set = 9\n", "CLOSEDBOX");
  ASSERT_EQ(r.status, 0) << r.err;
  for (const std::string* text : {&r.out, &r.message})
    EXPECT_THAT(*text, AllOf(HasSubstr("export.cfg:2: mpc_set = 7: set of the MPC cards"), HasSubstr("matrix KVVV"),
                             HasSubstr("deck.dat: ")));
  EXPECT_THAT(
      r.err,
      HasSubstr("export.cfg:3:1: warning: without effect on this export: spc_set (CLOSEDBOX) [ignored-directive]"));
}

// Whatever exerts a force has matrices of its own where the configuration asks for them.
TEST_F(Export, a_cable_is_singled_out) {
  write("export.cfg", "all_forces_editable = no\nforce_editable_by_id = cable, 4, CAB\n");
  const RunResult r = run(
      "cable\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=-3,0,4\nMARKER/2, QP=3,0,4\nPART/2, MASS=2, CM=20, "
      "IP=1,1,1\nMARKER/20\nBUSHING/1, I=20, J=3, K=1,1,1, KT=1,1,1\nMARKER/3, PART=1\nCABLE/4, MARKERS=1,20,2, K=50, "
      "LENGTH=9\nEND\n",
      "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("deck_KCAB.bdf"));
  EXPECT_FALSE(r.wrote("deck_KB1.bdf"));
}

struct Refused {
  std::string configuration, type, error;
};

TEST_F(Export, refuses_what_the_model_does_not_have_at_its_place) {
  for (const Refused& w : {
           Refused{"mpc_set = x\ngird_offset = 3\n", "OPENBOX", "export.cfg:1:11: error: mpc_set takes an integer"},
           Refused{"mpc_set = x\ngird_offset = 3\n", "OPENBOX",
                   "export.cfg:2:1: error: there is no directive gird_offset"},
           Refused{"export_markers_by_id = 1-99, 7\n", "OPENBOX", "export.cfg:1:30: error: MARKER/7 does not exist"},
           Refused{"export_markers_by_id = 22\n", "CLOSEDBOX", "export.cfg:1:24: error: MARKER/22 is floating"},
           Refused{"export_markers_by_name = head, haed\n", "OPENBOX",
                   "export.cfg:1:32: error: no marker has the name haed"},
           Refused{"export_markers_by_name = head, haed\n", "OPENBOX", "hint: head exists"},
           Refused{"force_editable_by_id = bushing, 2, B2\n", "OPENBOX",
                   "export.cfg:1:24: error: BUSHING/2 does not exist"},
           Refused{"force_editable_by_name = sforce, x, B2\n", "OPENBOX",
                   "export.cfg:1:26: error: no SFORCE has the name x"},
           Refused{"flexbody_editable_by_id = 2, B2\n", "OPENBOX",
                   "export.cfg:1:27: error: FLEX_BODY/2 does not exist"},
           Refused{"force_editable_by_id = bushing, 1, OWN\nforce_editable_by_id = vforce, 1, own\n", "OPENBOX",
                   "export.cfg:2:24: error: own ends the names of another element's matrices already"},
           Refused{"force_editable_by_id = part, 2, P2\n", "OPENBOX", "export.cfg:1:24: error: "},
           Refused{"force_editable_by_id = bushing, 1, VVV\n", "OPENBOX",
                   "export.cfg:1:24: error: VVV ends the names of the matrices of all others already"},
           Refused{response + "displacement_output_channel { name = o marker_id = 5 }\n", "CLOSEDBOX",
                   "export.cfg:9:52: error: MARKER/5 does not exist"},
           Refused{response + "force_input_channel { name = i marker_by_name = hed actuator_name = a }\n", "CLOSEDBOX",
                   "export.cfg:9:49: error: no marker has the name hed"},
       }) {
    const RunResult r = run_with(w.configuration, w.type);
    EXPECT_EQ(r.status, 1) << w.configuration;
    EXPECT_THAT(r.err, HasSubstr(w.error));
    EXPECT_FALSE(r.wrote("model.msg"));
    EXPECT_FALSE(r.wrote("deck.dat"));
  }
}

// As many markers are called cm as there are parts.
std::string named_twice(const std::string& title) {
  return title +
         "\nUNITS/SYSTEM=MKS\n! adams_view_name='ground'\nPART/1, GROUND\n! adams_view_name='M'\nMARKER/1\n"
         "! adams_view_name='arm'\nPART/2, MASS=1, CM=20, IP=1,1,1\n! adams_view_name='cm'\nMARKER/20\n"
         "! adams_view_name='wheel'\nPART/3, MASS=1, CM=30, IP=1,1,1\n! adams_view_name='cm'\nMARKER/30, QP=1,0,0\n"
         "! adams_view_name='SPRING_1.sforce'\nSFORCE/1, TRANSLATIONAL, I=30, J=1, FUNCTION=-DM(30,1)\n"
         "! adams_view_name='SPRING_2.sforce'\nSFORCE/2, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-DX(20)\n"
         "BUSHING/1, I=20, J=30, K=1,2,3, KT=1,2,3\nBUSHING/2, I=20, J=1, K=1,2,3, KT=1,2,3\nEND\n";
}

TEST_F(Export, names_stand_alone_or_with_their_path) {
  const std::string command = "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n";
  for (const char* name : {"wheel.cm", "car.wheel.cm", ".car.wheel.cm", "car.M", "M", "ground.M", "car.ground.M"}) {
    write("export.cfg", std::string("export_markers_by_name = ") + name + "\n");
    EXPECT_EQ(run(named_twice("Adams View model name: car"), command).status, 0) << name;
  }
  for (const char* name : {"SPRING_1.sforce", "car.SPRING_1.sforce"}) {
    write("export.cfg", std::string("force_editable_by_name = sforce, ") + name + ", OWN\n");
    const RunResult r = run(named_twice("Adams View model name: car"), command);
    EXPECT_EQ(r.status, 0) << name << r.err;
    EXPECT_TRUE(r.wrote("deck_KOWN.bdf") || r.wrote("deck_KSOWN.bdf")) << name;
  }
  // The marker of the wheel stands at 1, that of the arm at 0.
  write("export.cfg", "grid_offset = 501\nexport_markers_by_name = wheel.cm\n");
  EXPECT_EQ(run(named_twice("A car"), "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=deck, CONFIG=export.cfg\n").status, 0);
  EXPECT_THAT(read_file(folder_ / "deck_MODEL.nas"), ::testing::ContainsRegex("GRID\\*? .*1\\.D?0?"));
}

TEST_F(Export, a_name_that_several_have_is_refused_at_its_place) {
  const std::string channels =
      "solution_number = 108\nbegin_frequency = 1\nend_frequency = 9\nsteps_frequency = 8\n"
      "actuator_swept_sine { name = a }\nforce_input_channel { name = in marker_name = M actuator_name = a }\n"
      "frequency_response_subcase { number = 1 input_channel_names = in output_channel_names = out }\n";
  const std::string both = "car.arm.cm (MARKER/20), car.wheel.cm (MARKER/30)";
  for (const Refused& w : {
           Refused{"export_markers_by_name = M, cm\n", "OPENBOX",
                   "export.cfg:1:29: error: cm is the name of 2: " + both},
           Refused{"export_markers_by_name = car.cm\n", "CLOSEDBOX",
                   "export.cfg:1:26: error: car.cm is the name of 2: "},
           Refused{"force_editable_by_name = sforce, sforce, OWN\n", "OPENBOX",
                   "export.cfg:1:26: error: sforce is the name of 2: car.SPRING_1.sforce (SFORCE/1), "},
           Refused{channels + "displacement_output_channel { name = out marker_name = cm }\n", "CLOSEDBOX",
                   "export.cfg:8:56: error: cm is the name of 2: " + both},
           Refused{channels + "displacement_output_channel { name = out marker_id = 20 marker_name = wheel.cm }\n",
                   "CLOSEDBOX",
                   "export.cfg:8:71: error: marker_id is MARKER/20 (cm), and marker_name wheel.cm is MARKER/30 (cm)"},
           Refused{"export_markers_by_name = Wheel.cm\n", "OPENBOX",
                   "export.cfg:1:26: error: no marker has the name Wheel.cm"},
           Refused{"export_markers_by_name = .wheel.cm\n", "OPENBOX", "error: no marker has the name .wheel.cm"},
       }) {
    write("export.cfg", w.configuration);
    const RunResult r = run(named_twice("Adams View model name: car"),
                            "LINEAR/EXPORT, TYPE=" + w.type + ", FILE=deck, CONFIG=export.cfg\n");
    EXPECT_EQ(r.status, 1) << w.configuration;
    EXPECT_THAT(r.err, HasSubstr(w.error));
  }
  // Where errors are to be ignored it is left out, and said.
  write("export.cfg", "ignore_errors = yes\nexport_markers_by_name = M, cm\n");
  const RunResult r =
      run(named_twice("Adams View model name: car"), "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("cm is the name of 2: " + both + "; the export goes on without it"));
}

TEST_F(Export, goes_on_without_what_is_wrong_where_that_is_asked_for) {
  const RunResult r = run_with("ignore_errors = yes\nexport_markers_by_id = 20, 7\nmpc_set = x\n", "CLOSEDBOX");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, AllOf(HasSubstr("MARKER/7 does not exist; the export goes on without it"),
                           HasSubstr("mpc_set takes an integer, not \"x\"; it is left out")));
  EXPECT_THAT(r.text("deck.dat"), HasSubstr("MPC = 1\n"));
}

TEST_F(Export, overwrites_nothing_that_the_run_reads) {
  EXPECT_THAT(run_with("main_file_include_extension = .cfg\n", "CLOSEDBOX", "export").err,
              HasSubstr("would overwrite"));
  EXPECT_EQ(read_file(folder_ / "export.cfg"), "main_file_include_extension = .cfg\n");
  // The name of a matrix is known only when there is one.
  write("deck_KVVV.bdf", "title = kept\n");
  const RunResult r = run(model, "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=deck, CONFIG=deck_KVVV.bdf\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("deck_KVVV.bdf would overwrite "));
  EXPECT_EQ(read_file(folder_ / "deck_KVVV.bdf"), "title = kept\n");
  EXPECT_FALSE(r.wrote("deck.dat"));
}

TEST_F(Export, refuses_a_closed_box_where_nothing_can_move) {
  std::string fixed = model;
  fixed.replace(fixed.find("TRANSLATIONAL, I=20"), 19, "FIXED, I=20");
  const RunResult closed = run(fixed, "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=deck\n");
  EXPECT_EQ(closed.status, 2);
  EXPECT_THAT(closed.err, HasSubstr("no degrees of freedom: it can be exported as OPENBOX"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deck.dat"));
  EXPECT_EQ(run(fixed, "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck\n").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "deck.dat"));
}

// --- what is exported and does not do what it looks like ---
TEST_F(Export, names_input_channels_that_excite_nothing) {
  const std::string points =
      "Points\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0\nPOINT_MASS/4, MASS=1, CM=40\n"
      "MARKER/40, POINT_MASS=4\nPART/5, MASS=1, CM=50, IP=1,1,1\nMARKER/50\nMARKER/51, REULER=90D,90D,0\n"
      "JOINT/1, TRANSLATIONAL, I=51, J=2\nBUSHING/1, I=50, J=1, K=9,9,9\nBUSHING/2, I=40, J=1, K=9,9,9\nEND\n";
  const auto warnings = [&](int marker, const std::string& dof, const std::string& type) {
    write("export.cfg",
          "solution_number = 108\nbegin_frequency = 1\nend_frequency = 9\nsteps_frequency = 8\n"
          "actuator_swept_sine { name = a }\nforce_input_channel { name = shaker marker_id = " +
              std::to_string(marker) + " dof = " + dof +
              " actuator_name = a }\ndisplacement_output_channel { name = out marker_id = 50 }\n"
              "frequency_response_subcase { number = 1 input_channel_names = shaker output_channel_names = out }\n");
    const RunResult r = run(points, "LINEAR/EXPORT, TYPE=" + type + ", FILE=deck, CONFIG=export.cfg\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  };
  for (const char* type : {"OPENBOX", "CLOSEDBOX"}) {
    SCOPED_TRACE(type);
    EXPECT_THAT(warnings(40, "rx", type),
                HasSubstr("warning: input channel shaker excites nothing: MARKER/40 is on POINT_MASS/4, which does not "
                          "turn [idle-channel]"));
    EXPECT_THAT(warnings(1, "x", type), HasSubstr("input channel shaker excites nothing: MARKER/1 is on the ground"));
    EXPECT_THAT(warnings(40, "y", type), Not(HasSubstr("excites nothing")));
    EXPECT_THAT(warnings(50, "x", type), Not(HasSubstr("excites nothing")));
  }
  EXPECT_THAT(warnings(50, "ry", "CLOSEDBOX"),
              HasSubstr("input channel shaker excites nothing: constraints hold MARKER/50 there"));
}

TEST_F(Export, says_which_grids_have_other_numbers_than_asked_for) {
  EXPECT_THAT(run_with("export_ground_markers = yes\n", "OPENBOX").err, Not(HasSubstr("taken-number")));
  // That of PART/2 is GRID 100002, which MARKER/20 would have.
  const RunResult r = run_with("marker_offset = 99982\n", "OPENBOX");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err,
              AllOf(HasSubstr("marker_offset 99982 and the ids of markers make numbers that other grids have"),
                    HasSubstr("(MARKER/20 (head): GRID 100003, MARKER/21: GRID 100004)"), HasSubstr("[taken-number]")));
}

// --- the manual ---
TEST_F(Export, has_all_directives_on_its_page_as_they_are) {
  const auto page = element_pages().parent_path() / "nastran.md";
  const std::string text = read_file(page), wanted = nastran::directive_pages();
  if (text.find(wanted) == std::string::npos) std::ofstream(folder_.parent_path() / "directives.md") << wanted;
  EXPECT_NE(text.find(wanted), std::string::npos)
      << "behind ## Directives " << page << " needs what is in " << folder_.parent_path() / "directives.md";
}

TEST_F(Export, runs_the_configuration_of_its_page) {
  const std::string text = read_file(element_pages().parent_path() / "nastran.md");
  const auto begin = text.find("```cfg\n") + 7;
  std::string other = model;
  other.replace(other.find("MARKER/22, PART=1, FLOATING"), 27, "MARKER/31, PART=2\nMARKER/22, PART=1, FLOATING");
  write("export.cfg", text.substr(begin, text.find("```", begin) - begin));
  const RunResult r = run(other, "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n");
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(Export, is_explained_on_the_terminal) {
  std::ostringstream all, one, slip, err;
  EXPECT_EQ(print_help("export", all, err), done);
  for (const std::string_view name : nastran::directive_names()) {
    EXPECT_THAT(all.str(), HasSubstr("    " + std::string(name) + " ")) << name;
    std::ostringstream page;
    EXPECT_EQ(print_help(name, page, err), done) << name;
  }
  EXPECT_EQ(print_help("grid_offset", one, err), done);
  EXPECT_THAT(one.str(), HasSubstr("    grid_offset = integer\n        the first GRID or SPOINT, where they are "
                                   "counted; default 1; without effect with use_adams_ids = yes"));
  EXPECT_EQ(print_help("gird_offset", slip, err), wrong_usage);
  EXPECT_THAT(err.str(), HasSubstr("grid_offset exists"));
}

}  // namespace
}  // namespace dynalin::cases::export_test
