#include "nastran/configuration.h"

#include <gmock/gmock.h>

#include <numbers>
#include <set>

namespace dynalin::nastran::configuration_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Parsed<Configuration> read(const std::string& text, Box box = Box::open) {
  return read_configuration(std::make_shared<const SourceText>("export.cfg", text), box);
}
ExportOptions options_of(const std::string& text, Box box = Box::open) {
  const auto c = read(text, box);
  EXPECT_FALSE(c.diagnostics.has_errors()) << text << render(c.diagnostics);
  return c.value.options;
}
// "code line:column", of each problem.
std::vector<std::string> problems(const std::string& text, Box box = Box::open) {
  std::vector<std::string> list;
  const auto c = read(text, box);
  for (const Diagnostic& d : c.diagnostics.items()) {
    const auto at = d.at.source->place(d.at.offset);
    list.push_back(std::string(d.code) + " " + std::to_string(at.line) + ":" + std::to_string(at.column));
  }
  return list;
}

const std::string response =
    "solution_number = 108\nbegin_frequency = 1.0\nend_frequency = 10.0\nsteps_frequency = 9\n"
    "actuator_swept_sine {\nname = act\n}\n"
    "force_input_channel {\nname = in\nmarker_id = 1\nactuator_name = act\n}\n"
    "displacement_output_channel {\nname = out\nmarker_id = 2\n}\n"
    "frequency_response_subcase {\nnumber = 100\ninput_channel_names = in\noutput_channel_names = out\n}\n";

// --- every directive: an example of the documentation, what it does to the options, and a value that is wrong ---
struct Row {
  const char* line;
  bool (*taken)(const ExportOptions&);
  const char* wrong;      // its value is reported where it stands
  const char* with = "";  // what it needs to have an effect
};

const std::vector<Row>& rows() {
  using O = ExportOptions;
  static const std::vector<Row> list = {
      {"solution_number = 108", [](const O& o) { return o.solution_number == 108; }, "solution_number = 103"},
      {"eigc_method = clan", [](const O& o) { return o.eigc_method == EigenMethod::clan; }, "eigc_method = CLAN"},
      {"clan_region= 1.2, 4.0, 6.4, 4.0, 1.1, 20",
       [](const O& o) {
         return o.clan_region.size() == 1 && o.clan_region[0].values[2] == 6.4 && o.clan_region[0].count == 20;
       },
       "clan_region = 1, 2, 3", "eigc_method = clan\n"},
      {"number_of_eigenvalues = 40", [](const O& o) { return o.number_of_eigenvalues == 40; },
       "number_of_eigenvalues = 0"},
      {"cmethod_number = 445", [](const O& o) { return o.cmethod_number == 445; }, "cmethod_number = 4.5"},
      {"use_damping = no", [](const O& o) { return !o.use_damping; }, "use_damping = true"},
      {"automset = yes", [](const O& o) { return o.automset == Automset::yes; }, "automset = no"},
      {"split_dmigs = no", [](const O& o) { return !o.split_dmigs; }, "split_dmigs = never", "R"},
      {"matrix_entry_zero_tolerance = 1.e-06", [](const O& o) { return o.matrix_entry_zero_tolerance == 1e-6; },
       "matrix_entry_zero_tolerance = -1"},
      {"disp_plot_punch = plot", [](const O& o) { return o.disp_plot_punch == Output::plot; }, "disp_plot_punch = all"},
      {"param_post = 1", [](const O& o) { return o.param_post == 1; }, "param_post = one"},
      {"title = Export 1.2.22 - Type 722.7-b", [](const O& o) { return o.title == "Export 1.2.22 - Type 722.7-b"; },
       "title = 0123456789012345678901234567890123456789012345678901234567890123456789"},
      {"subtitle = Ann Arbor run - J. P. & L. L.",
       [](const O& o) { return o.subtitle == "Ann Arbor run - J. P. & L. L."; },
       "subtitle = 0123456789012345678901234567890123456789012345678901234567890123456789"},
      {"load = 4", [](const O& o) { return o.load == 4; }, "load = 0"},
      {"mpc_set = 700", [](const O& o) { return o.mpc_set == 700; }, "mpc_set = x"},
      {"spc_set = 10", [](const O& o) { return o.spc_set == 10; }, "spc_set = 999999999"},
      {"tic_set = 500", [](const O& o) { return o.tic_set == 500; }, "tic_set ="},
      {"initial_dmig_set = 50", [](const O& o) { return o.initial_dmig_set == 50; }, "initial_dmig_set = -3"},
      {"debug = yes", [](const O& o) { return o.debug; }, "debug = on"},
      {"begin_frequency = 2.5", [](const O& o) { return o.begin_frequency == 2.5; }, "begin_frequency = 1.0D", "R"},
      {"end_frequency = 1.0E+09", [](const O& o) { return o.end_frequency == 1e9; }, "end_frequency = fast", "R"},
      {"steps_frequency = 50", [](const O& o) { return o.steps_frequency == 50; }, "steps_frequency = 2.5", "R"},
      {"spacing_frequency = log", [](const O& o) { return o.spacing_frequency == Spacing::log; },
       "spacing_frequency = octaves", "R"},
      {"dload_card_number = 558", [](const O& o) { return o.dload_card_number == 558; }, "dload_card_number = 0", "R"},
      {"dload_card_number_increment = 2", [](const O& o) { return o.dload_card_number_increment == 2; },
       "dload_card_number_increment = 0", "R"},
      {"rload1_card_number = 558", [](const O& o) { return o.rload1_card_number == 558; }, "rload1_card_number = -",
       "R"},
      {"rload1_card_number_increment = 2", [](const O& o) { return o.rload1_card_number_increment == 2; },
       "rload1_card_number_increment = 1,2", "R"},
      {"force_card_number = 558", [](const O& o) { return o.force_card_number == 558; }, "force_card_number = F", "R"},
      {"force_card_number_increment = 2", [](const O& o) { return o.force_card_number_increment == 2; },
       "force_card_number_increment = 1e2", "R"},
      {"dphase_card_number = 658", [](const O& o) { return o.dphase_card_number == 658; }, "dphase_card_number = 0",
       "R"},
      {"dphase_card_number_increment = 2", [](const O& o) { return o.dphase_card_number_increment == 2; },
       "dphase_card_number_increment = 0", "R"},
      {"tabled1_card_number = 555", [](const O& o) { return o.tabled1_card_number == 555; }, "tabled1_card_number = 0",
       "R"},
      {"tabled1_card_number_increment = 3", [](const O& o) { return o.tabled1_card_number_increment == 3; },
       "tabled1_card_number_increment = 0", "R"},
      {"frequency_card_number = 770", [](const O& o) { return o.frequency_card_number == 770; },
       "frequency_card_number = 0", "R"},
      {"set_card_number = 558", [](const O& o) { return o.set_card_number == 558; }, "set_card_number = 0", "R"},
      {"set_card_number_increment = 2", [](const O& o) { return o.set_card_number_increment == 2; },
       "set_card_number_increment = 0", "R"},
      {"export_all_markers = yes", [](const O& o) { return o.export_all_markers; }, "export_all_markers = all"},
      {"export_ground_markers = yes", [](const O& o) { return o.export_ground_markers; }, "export_ground_markers = 1"},
      {"export_markers_by_id = 1, 3, 45-52, 88",
       [](const O& o) {
         return o.export_markers_by_id.size() == 4 && o.export_markers_by_id[2].first == 45 &&
                o.export_markers_by_id[2].last == 52 && o.export_markers_by_id[3].last == 88;
       },
       "export_markers_by_id = 9-3"},
      {"export_markers_by_name = model.MARKER_8, model.MARKER_77",
       [](const O& o) {
         return o.export_markers_by_name == std::vector<std::string>{"model.MARKER_8", "model.MARKER_77"};
       },
       "export_markers_by_name = a,,b"},
      {"all_forces_editable = no", [](const O& o) { return !o.all_forces_editable; }, "all_forces_editable = none"},
      {"force_editable_by_id = beam, 979, B979",
       [](const O& o) {
         return o.force_editable.size() == 1 && o.force_editable[0].type == "beam" && o.force_editable[0].id == 979 &&
                o.force_editable[0].suffix == "B979";
       },
       "force_editable_by_id = baem, 979, B979"},
      {"force_editable_by_name = beam, model.BEAM_979, B979",
       [](const O& o) { return o.force_editable.size() == 1 && o.force_editable[0].name == "model.BEAM_979"; },
       "force_editable_by_name = beam, model.BEAM_979, B979012345"},
      {"all_flexbodies_editable = no", [](const O& o) { return !o.all_flexbodies_editable; },
       "all_flexbodies_editable = none"},
      {"flexbody_editable_by_id = 9900, FB9900",
       [](const O& o) { return o.flexbody_editable.size() == 1 && o.flexbody_editable[0].id == 9900; },
       "flexbody_editable_by_id = x, FB9900"},
      {"flexbody_editable_by_name = model.FLEX_BODY_9900, FB9900",
       [](const O& o) {
         return o.flexbody_editable.size() == 1 && o.flexbody_editable[0].name == "model.FLEX_BODY_9900";
       },
       "flexbody_editable_by_name = model.FLEX_BODY_9900"},
      {"forces_dmig_name = FQ", [](const O& o) { return o.forces_dmig_name == "FQ"; }, "forces_dmig_name = F.Q"},
      {"differentials_dmig_name = ZQ", [](const O& o) { return o.differentials_dmig_name == "ZQ"; },
       "differentials_dmig_name = Z Q"},
      {"export_cbush = no", [](const O& o) { return !o.export_cbush; }, "export_cbush = none"},
      {"export_residuals = no", [](const O& o) { return !o.export_residuals; }, "export_residuals = none"},
      {"use_rjoints = no", [](const O& o) { return !o.use_rjoints; }, "use_rjoints = none"},
      {"small_mass = 1", [](const O& o) { return o.small_mass == 1; }, "small_mass = -1"},
      {"export_tic_cards = yes", [](const O& o) { return o.export_tic_cards; }, "export_tic_cards = 2"},
      {"export_mode_shapes = yes", [](const O& o) { return o.export_mode_shapes; }, "export_mode_shapes = 3"},
      {"export_graphics = no", [](const O& o) { return !o.export_graphics; }, "export_graphics = 0"},
      {"export_external = no", [](const O& o) { return !o.export_external; }, "export_external = 0"},
      {"export_spdp = no", [](const O& o) { return !o.export_spdp; }, "export_spdp = 0"},
      {"use_plotel = yes", [](const O& o) { return o.use_plotel; }, "use_plotel = 1"},
      {"use_wireframe = yes", [](const O& o) { return o.use_wireframe; }, "use_wireframe = 1"},
      {"export_rbe_connectivity = yes", [](const O& o) { return o.export_rbe_connectivity; },
       "export_rbe_connectivity = 1", "file_name_style = C\n"},
      {"export_spc_connectivity = yes", [](const O& o) { return o.export_spc_connectivity; },
       "export_spc_connectivity = 1", "file_name_style = C\n"},
      {"spc_set_connectivity = 1", [](const O& o) { return o.spc_set_connectivity == 1; }, "spc_set_connectivity = 0",
       "file_name_style = C\n"},
      {"remove_unused_items = cbush, grid",
       [](const O& o) {
         return o.remove_unused_items == std::vector<std::string>{"cbush", "grid"};
       },
       "remove_unused_items = grids", "R"},
      {"use_adams_ids = no", [](const O& o) { return !o.use_adams_ids; }, "use_adams_ids = 1"},
      {"grid_offset = 1000", [](const O& o) { return o.grid_offset == 1000; }, "grid_offset = -1",
       "use_adams_ids = no\n"},
      {"marker_offset = 30000", [](const O& o) { return o.marker_offset == 30000; }, "marker_offset = a"},
      {"pointmass_offset = 30000", [](const O& o) { return o.pointmass_offset == 30000; }, "pointmass_offset = a"},
      {"spoint_offset = 30000", [](const O& o) { return o.spoint_offset == 30000; }, "spoint_offset = a"},
      {"graphics_grid_offset = 5000", [](const O& o) { return o.graphics_grid_offset == 5000; },
       "graphics_grid_offset = a"},
      {"cord2r_offset = 600", [](const O& o) { return o.cord2r_offset == 600; }, "cord2r_offset = 0"},
      {"conm2_offset = 2000", [](const O& o) { return o.conm2_offset == 2000; }, "conm2_offset = a"},
      {"rjoint_offset = 2000", [](const O& o) { return o.rjoint_offset == 2000; }, "rjoint_offset = a"},
      {"rbe2_offset = 2000", [](const O& o) { return o.rbe2_offset == 2000; }, "rbe2_offset = a"},
      {"cbush_offset = 7000000", [](const O& o) { return o.cbush_offset == 7000000; }, "cbush_offset = a"},
      {"pbush_offset = 2000", [](const O& o) { return o.pbush_offset == 2000; }, "pbush_offset = a"},
      {"cquad4_offset = 2000", [](const O& o) { return o.cquad4_offset == 2000; }, "cquad4_offset = a"},
      {"ctria3_offset = 2000", [](const O& o) { return o.ctria3_offset == 2000; }, "ctria3_offset = a"},
      {"crod_offset = 2000", [](const O& o) { return o.crod_offset == 2000; }, "crod_offset = a"},
      {"prod_offset = 2000", [](const O& o) { return o.prod_offset == 2000; }, "prod_offset = a"},
      {"pshell_offset = 2000", [](const O& o) { return o.pshell_offset == 2000; }, "pshell_offset = a"},
      {"material_card_number = 500", [](const O& o) { return o.material_card_number == 500; },
       "material_card_number = 0"},
      {"file_name_style = C", [](const O& o) { return o.file_name_style == FileStyle::C; }, "file_name_style = D"},
      {"main_file_include_extension=.data", [](const O& o) { return o.main_file_include_extension == ".data"; },
       "main_file_include_extension = /x"},
      {"model_include_extension = .bdf", [](const O& o) { return o.model_include_extension == ".bdf"; },
       "model_include_extension = a/b"},
      {"file_include_extension = .bdf2", [](const O& o) { return o.file_include_extension == ".bdf2"; },
       "file_include_extension = ../b"},
      {"include_directory = myinclude", [](const O& o) { return o.include_directory == "myinclude"; }, nullptr},
      {"use_includes = no", [](const O& o) { return !o.use_includes; }, "use_includes = 0"},
      {"single_included_dmig = yes", [](const O& o) { return o.single_included_dmig; }, "single_included_dmig = 1"},
      {"use_short_part_file_names = yes", [](const O& o) { return o.use_short_part_file_names; },
       "use_short_part_file_names = 1", "R"},
      {"use_long_format = no", [](const O& o) { return !o.use_long_format; }, "use_long_format = 0"},
      {"use_dmig_long_format = no", [](const O& o) { return !o.use_dmig_long_format; }, "use_dmig_long_format = 0"},
      {"use_view_names = no", [](const O& o) { return !o.use_view_names; }, "use_view_names = 0"},
      {"verbose_names = no", [](const O& o) { return !o.verbose_names; }, "verbose_names = 0"},
      {"add_space_before_names = yes", [](const O& o) { return o.add_space_before_names; },
       "add_space_before_names = 1"},
      {"ignore_errors = yes", [](const O& o) { return o.ignore_errors; }, "ignore_errors = 1"},
  };
  return list;
}

std::string context(const Row& row) { return std::string(row.with) == "R" ? response : row.with; }

TEST(Configuration, takes_every_directive_and_has_its_documented_default_without_it) {
  for (const Row& row : rows()) {
    EXPECT_FALSE(row.taken({})) << row.line;
    const bool solution = std::string(row.line).starts_with("solution_number");
    EXPECT_TRUE(row.taken(options_of((solution ? response : context(row)) + row.line + "\n"))) << row.line;
  }
}

TEST(Configuration, reports_a_wrong_value_of_every_directive_at_its_place) {
  for (const Row& row : rows()) {
    if (!row.wrong) continue;
    const std::string before = context(row), line = row.wrong;
    const auto lines = std::count(before.begin(), before.end(), '\n') + 1;
    const auto found = problems(before + line + "\n");
    ASSERT_FALSE(found.empty()) << line;
    EXPECT_THAT(found.front(), ::testing::StartsWith("directive-value " + std::to_string(lines) + ":")) << line;
  }
}

TEST(Configuration, tests_every_directive_of_the_table) {
  std::set<std::string> tested;
  for (const Row& row : rows()) {
    const std::string line = row.line;
    tested.insert(line.substr(0, line.find_first_of(" =")));
  }
  for (const DirectiveGroup& group : directive_groups()) {
    for (const Directive& d : group.directives) EXPECT_EQ(tested.erase(std::string(d.name)), 1u) << d.name;
  }
  EXPECT_THAT(tested, IsEmpty());
}

// The two examples of the documentation.
TEST(Configuration, reads_the_example_of_solution_107) {
  const auto c = read(
      "$ Configuration file prepared by J.Smith\n$ Model 1.45-7-a_2.33.XPRWS/USA@@3410001109ABD-7a'StrA7'/88\n$\n"
      "solution_number = 107\nuse_damping = yes\ngrid_offset = 1000\n$\n$ All MARKERS in specified range\n"
      "export_markers_by_id = 1-99\n$\nexport_marker_by_name = model.PART_999.MARKER_919\n$\n"
      "force_editable_by_id = sforce, 7, SF7\n$ End\n");
  ASSERT_FALSE(c.diagnostics.has_errors()) << render(c.diagnostics);
  EXPECT_EQ(c.value.options.export_markers_by_id.front().last, 99);
  EXPECT_THAT(c.value.options.export_markers_by_name, ElementsAre("model.PART_999.MARKER_919"));
  EXPECT_EQ(c.value.options.force_editable.front().suffix, "SF7");
  // Ids of the dataset are in use, so that nothing is counted from grid_offset.
  EXPECT_THAT(c.diagnostics.items().front().message, HasSubstr("grid_offset (use_adams_ids = yes"));
  EXPECT_EQ(c.value.options.grid_offset, 1);
  EXPECT_EQ(options_of("grid_offset = 1000\n", Box::closed).grid_offset, 1000);
}

TEST(Configuration, reads_the_example_of_solution_108) {
  const ExportOptions o = options_of(
      "actuator_swept_sine {\nname = act1\nmagnitude = 2.2\nphase_angle = 45D $ 45 degrees\n}\n"
      "force_input_channel {\nname = inp1\nmarker_id = 88\ndof = X\nactuator_name = act1\n}\n"
      "force_input_channel {\nname = inp2\nmarker_id = 88\ndof = RZ\nactuator_name = act1\n}\n"
      "displacement_output_channel {\nname = out1\nmarker_id = 77\n}\n"
      "frequency_response_subcase {\nnumber = 100\ninput_channel_names = inp1, inp2\noutput_channel_names = out1\n}\n"
      "frequency_response_subcase {\nnumber = 200\ninput_channel_names = inp1\noutput_channel_names = out1\n}\n"
      "solution_number = 108\nbegin_frequency = 1.0\nend_frequency = 1000.0\nsteps_frequency = 20\n"
      "spacing_frequency = log\nuse_damping = yes\ngrid_offset = 1000\n$\n$ End\n");
  ASSERT_EQ(o.actuator_swept_sine.size(), 1u);
  EXPECT_DOUBLE_EQ(o.actuator_swept_sine[0].phase_angle, std::numbers::pi / 4);
  ASSERT_EQ(o.force_input_channel.size(), 2u);
  EXPECT_EQ(o.force_input_channel[0].dof, 1);
  EXPECT_EQ(o.force_input_channel[1].dof, 6);
  EXPECT_EQ(o.force_input_channel[1].mode, Axes::local);
  EXPECT_EQ(o.displacement_output_channel[0].marker_id, 77);
  EXPECT_THAT(o.frequency_response_subcase[0].input_channel_names, ElementsAre("inp1", "inp2"));
  EXPECT_EQ(o.frequency_response_subcase[1].number, 200);
}

// As the list of directives has them.
TEST(Configuration, reads_blocks_and_directives_on_one_line) {
  const ExportOptions o = options_of(
      response +
      "actuator_swept_sine { name = actuator_1 magnitude = 2.2 phase_angle = 45D }\n"
      "displacement_output_channel { name = oc_1 marker_by_name = model.MARKER_77 mode = global }\n"
      "force_input_channel { name = ic_1 marker_by_name = model.MARKER_88 dof = rx actuator_name = actuator_1 mode = "
      "local }\n"
      "frequency_response_subcase { number = 107 input_channel_names = ic_1, in output_channel_names = oc_1, out }\n"
      "spacing_frequency = linear spacing_frequency = log\n");
  EXPECT_EQ(o.actuator_swept_sine.back().magnitude, 2.2);
  EXPECT_EQ(o.displacement_output_channel.back().marker_name, "model.MARKER_77");
  EXPECT_EQ(o.displacement_output_channel.back().mode, Axes::global);
  EXPECT_EQ(o.force_input_channel.back().dof, 4);
  EXPECT_THAT(o.frequency_response_subcase.back().output_channel_names, ElementsAre("oc_1", "out"));
  EXPECT_EQ(o.spacing_frequency, Spacing::log);
}

TEST(Configuration, keeps_the_lines_of_verbatim_as_they_are) {
  EXPECT_THAT(options_of("verbatim {\n$ Added cards\n  ECHO=BOTH\n\n}\n").verbatim,
              ElementsAre("$ Added cards", "  ECHO=BOTH"));
  EXPECT_THAT(options_of("verbatim { ECHO=BOTH }\nverbatim {LINE = 50\n}\n").verbatim,
              ElementsAre("ECHO=BOTH", "LINE = 50"));
  EXPECT_THAT(problems("debug = yes\nverbatim { ECHO\n"), ElementsAre("directive-syntax 2:1"));
}

TEST(Configuration, takes_the_last_of_two_and_all_of_a_list) {
  EXPECT_EQ(options_of("mpc_set = 3\nmpc_set = 4\n").mpc_set, 4);
  EXPECT_EQ(options_of("export_markers_by_id = 1\nexport_markers_by_id = 2, 3\n").export_markers_by_id.size(), 2u);
  EXPECT_EQ(options_of("eigc_method = clan\nclan_region = 1,2,3,4,5,6\nclan_region = 1,2,3,4,5,7\n").clan_region.size(),
            2u);
  EXPECT_EQ(
      options_of("force_editable_by_id = sforce, 7, A\nforce_editable_by_name = beam, b, B\n").force_editable.size(),
      2u);
  const ExportOptions o = options_of(response + "actuator_swept_sine { name = act magnitude = 7 }\n");
  ASSERT_EQ(o.actuator_swept_sine.size(), 1u);
  EXPECT_EQ(o.actuator_swept_sine[0].magnitude, 7);
}

TEST(Configuration, reports_all_problems_in_one_run) {
  EXPECT_THAT(
      problems(
          "gird_offset = 3\nmpc_set = many\n= 4\nuse_includes\ndebug { x = 1 }\nforce_input_channel = 3\n"
          "actuator_swept_sine { nmae = a }\nactuator_swept_sine { magnitude = 3 }\nactuator_swept_sine { name a }\n"
          "actuator_swept_sine { name =\n"),
      ElementsAre("unknown-directive 1:1", "directive-syntax 3:1", "directive-syntax 4:1", "directive-syntax 5:1",
                  "directive-syntax 6:1", "unknown-directive 7:23", "missing-directive 8:1", "directive-syntax 9:23",
                  "directive-value 10:23", "directive-syntax 10:1", "directive-value 2:11"));
  const auto c = read("gird_offset = 3\n");
  EXPECT_THAT(render(c.diagnostics), HasSubstr("export.cfg:1:1: error: there is no directive gird_offset"));
  EXPECT_THAT(render(c.diagnostics), HasSubstr("grid_offset exists"));
  EXPECT_THAT(render(read("use_includes = Yes\n").diagnostics), HasSubstr("hint: use_includes = yes"));
}

TEST(Configuration, needs_a_load_and_frequencies_for_solution_108) {
  const auto found = problems("solution_number = 108\n");
  EXPECT_EQ(std::count(found.begin(), found.end(), "missing-directive 1:19"), 7);
  EXPECT_THAT(problems(response + "end_frequency = 0.5\n"), ElementsAre("directive-value 22:17"));
  EXPECT_THAT(problems(response + "begin_frequency = 0\nspacing_frequency = log\n"),
              ElementsAre("directive-value 22:19"));
  EXPECT_THAT(
      problems(response + "frequency_response_subcase { number = 3 input_channel_names = i output_channel_names = "
                          "out, uot }\n"),
      ElementsAre("unknown-channel 22:63", "unknown-channel 22:93"));
  EXPECT_THAT(problems(response + "force_input_channel { name = b marker_id = 3 actuator_name = atc }\n"),
              ElementsAre("unknown-channel 22:62"));
  EXPECT_THAT(problems(response + "force_input_channel { name = b actuator_name = act }\n"),
              ElementsAre("missing-directive 22:1"));
}

TEST(Configuration, leaves_room_for_two_letters_before_names_of_split_matrices) {
  EXPECT_THAT(problems("force_editable_by_id = sforce, 7, SEVENTH\n"), IsEmpty());
  EXPECT_THAT(problems(response + "force_editable_by_id = sforce, 7, SEVENTH\n"), ElementsAre("directive-value 22:24"));
  EXPECT_THAT(problems(response + "split_dmigs = no\nforce_editable_by_id = sforce, 7, SEVENTH\n"), IsEmpty());
}

TEST(Configuration, says_once_what_has_no_effect_and_leaves_it_out) {
  const auto c = read("spc_set = 5\nuse_wireframe = yes\ncmethod_number = 7\nsteps_frequency = 3\n", Box::closed);
  ASSERT_EQ(c.diagnostics.items().size(), 1u);
  const Diagnostic& d = c.diagnostics.items().front();
  EXPECT_EQ(d.code, "ignored-directive");
  EXPECT_EQ(d.severity, Severity::warning);
  EXPECT_EQ(d.message, "without effect on this export: spc_set, use_wireframe (CLOSEDBOX); steps_frequency (SOL 107)");
  EXPECT_EQ(d.notes.size(), 3u);
  EXPECT_EQ(c.value.options.spc_set, 1);
  EXPECT_FALSE(c.value.options.use_wireframe);
  EXPECT_EQ(c.value.options.cmethod_number, 7);
  EXPECT_FALSE(c.value.options.steps_frequency);
  // One directive may decide over another wherever it stands.
  EXPECT_TRUE(options_of("export_residuals = no\n").export_residuals == false);
  EXPECT_TRUE(options_of("export_residuals = no\nexport_cbush = no\n").export_residuals);
  EXPECT_THAT(problems("file_include_extension = .x\nfile_name_style = B\n"), ElementsAre("ignored-directive 1:1"));
  // What is without effect itself decides over nothing.
  EXPECT_EQ(options_of("model_include_extension = .x\nfile_name_style = B\n", Box::closed).model_include_extension,
            ".x");
  EXPECT_THAT(problems("actuator_swept_sine { name = a }\n"), ElementsAre("ignored-directive 1:1"));
}

TEST(Configuration, turns_errors_into_warnings_where_that_is_asked_for) {
  const auto c = read("mpc_set = x\ngird_offset = 4\nspc_set = 3\nignore_errors = yes\n");
  EXPECT_FALSE(c.diagnostics.has_errors());
  EXPECT_EQ(c.diagnostics.items().size(), 2u);
  EXPECT_THAT(c.diagnostics.items().front().message, HasSubstr("it is left out"));
  EXPECT_EQ(c.value.options.mpc_set, 1);
  EXPECT_EQ(c.value.options.spc_set, 3);
}

TEST(Configuration, echoes_each_directive_for_debug) {
  const auto c = read("debug = yes\nmpc_set = 7\nsteps_frequency = 9\n");
  ASSERT_EQ(c.value.echo.size(), 3u);
  EXPECT_EQ(c.value.echo[1], "export.cfg:2: mpc_set = 7: set of the MPC cards (default 1)");
  EXPECT_THAT(c.value.echo[2], HasSubstr("without effect with SOL 107"));
  EXPECT_THAT(read("mpc_set = 7\n").value.echo, IsEmpty());
}

TEST(Configuration, has_blanks_comments_and_line_ends_of_all_kinds) {
  const ExportOptions o =
      options_of("\tmpc_set=7$ seven\r\n  spc_set  =  8  \r$ x = y\ninclude_directory =\ntitle = \"a, b\"\n");
  EXPECT_EQ(o.mpc_set, 7);
  EXPECT_EQ(o.spc_set, 8);
  EXPECT_EQ(o.include_directory, "");
  EXPECT_EQ(o.title, "a, b");
  EXPECT_EQ(options_of("").mpc_set, 1);
}

TEST(Configuration, survives_the_end_of_the_file_at_any_place) {
  const std::string text = response + "verbatim { A\n B }\nclan_region = 1,2,3,4,5,6\nexport_markers_by_id = 1-4,7\n";
  for (std::size_t n = 0; n <= text.size(); ++n) read(text.substr(0, n));
  for (std::size_t n = 0; n < text.size(); ++n) {
    for (const char c : {'{', '}', '=', ',', '$', '\n', '\0', '-'}) {
      std::string other = text;
      other[n] = c;
      read(other);
    }
  }
}

}  // namespace
}  // namespace dynalin::nastran::configuration_test
