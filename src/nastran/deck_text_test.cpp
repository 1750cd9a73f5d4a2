#include "nastran/deck_text.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "nastran/configuration.h"
#include "nastran/sample_deck_test_support.h"
#include "places/source_tree.h"

namespace dynalin::nastran::deck_text_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

ExportOptions options_of(const std::string& configuration, Box box = Box::open) {
  const auto c = read_configuration(std::make_shared<const SourceText>("export.cfg", configuration), box);
  EXPECT_FALSE(c.diagnostics.has_errors()) << render(c.diagnostics);
  return c.value.options;
}
DeckText written(const Deck& deck, const std::string& configuration, const std::string& file = "deck") {
  auto text = deck_text(deck, options_of(configuration, deck.open ? Box::open : Box::closed), file);
  EXPECT_TRUE(text) << (text ? "" : text.error().front());
  return text ? std::move(*text) : DeckText{};
}
// "== name" and the text, one file after the other.
std::string all(const DeckText& text) {
  std::string joined;
  for (const DeckFile& f : text.files) joined += "== " + f.name + "\n" + f.text;
  return joined;
}
std::vector<std::string> names(const DeckText& text) {
  std::vector<std::string> list;
  for (const DeckFile& f : text.files) list.push_back(f.name);
  return list;
}
std::string file(const DeckText& text, const std::string& name) {
  for (const DeckFile& f : text.files) {
    if (f.name == name) return f.text;
  }
  ADD_FAILURE() << "no file " << name;
  return {};
}

// --- whole decks, as files under tests/nastran; DYNALIN_WRITE_DECKS=1 writes them anew ---
struct Golden {
  const char* folder;
  bool open;
  std::string configuration;
  const char* file = "deck";
};
const std::string short_fields = "use_long_format = no\nuse_dmig_long_format = no\n";

std::vector<Golden> goldens() {
  return {
      {"style_A", true, "export_mode_shapes = yes\n"},
      {"style_A_short", true, short_fields},
      {"style_B", true, "file_name_style = B\nsingle_included_dmig = yes\n", "deck.bdf"},
      {"style_C_short", true, short_fields + "file_name_style = C\nuse_adams_ids = no\n"},
      {"one_file_short", true, short_fields + "use_includes = no\n" + sample_response},
      {"closed", false, ""},
      {"closed_response", false, sample_response},
  };
}

TEST(DeckText, is_that_of_the_decks_of_this_folder) {
  const bool write = std::getenv("DYNALIN_WRITE_DECKS") != nullptr;
  for (const Golden& golden : goldens()) {
    const auto folder = nastran_decks() / golden.folder;
    const DeckText text =
        written(golden.open ? sample_open_deck() : sample_closed_deck(), golden.configuration, golden.file);
    if (write) std::filesystem::create_directories(folder);
    std::size_t files = 0;
    for (const DeckFile& f : text.files) {
      if (write) std::ofstream(folder / f.name) << f.text;
      std::stringstream expected;
      expected << std::ifstream(folder / f.name).rdbuf();
      EXPECT_EQ(f.text, expected.str()) << folder / f.name;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files += entry.is_regular_file();
    EXPECT_EQ(files, text.files.size()) << folder;
  }
}

TEST(DeckText, is_the_same_each_time) {
  EXPECT_EQ(all(written(sample_open_deck(), "")), all(written(sample_open_deck(), "")));
}

TEST(DeckText, has_lines_that_fit_their_columns) {
  for (const Golden& golden : goldens()) {
    const Deck deck = golden.open ? sample_open_deck() : sample_closed_deck();
    std::istringstream in(all(written(deck, golden.configuration, golden.file)));
    bool control = false;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("SOL")) control = true;
      if (line == "BEGIN BULK") control = false;
      if (!line.starts_with("$")) {
        EXPECT_LE(line.size(), control ? 72u : 80u) << line;
      }
    }
  }
}

// --- what each directive does to the text ---
struct Effect {
  std::string configuration;
  const char* has;    // with it
  const char* lacks;  // with it; without it the other way round
};

std::vector<Effect> effects() {
  const std::string r = sample_response, c = "file_name_style = C\n";
  return {
      {"cmethod_number = 445\n", "CMETHOD = 445\n", "CMETHOD = 101"},
      {"cmethod_number = 445\n", "EIGC*   445 ", "EIGC*   101 "},
      {"number_of_eigenvalues = 40\n", "HESS            MAX\n*                                       40\n", nullptr},
      {"eigc_method = clan\n", "CLAN            MAX", "HESS            MAX"},
      {"eigc_method = clan\nclan_region = 1.5, 4, 6, 4, 1, 20\n",
       "\n*       1.5             4.              6.              4.\n*       1.                              20\n",
       nullptr},
      {"automset = yes\n", "PARAM,AUTOMSET,YES", "PARAM,AUTOMSET,LUSOL"},
      {"disp_plot_punch = plot\n", "DISP(PLOT) = ALL", "DISP(PLOT,PUNCH)"},
      {"disp_plot_punch = punch\n", "DISP(PUNCH) = ALL", "DISP(PLOT,PUNCH)"},
      {"param_post = -1\n", "PARAM,POST,-1\n", "PARAM,POST,0\n"},
      {"title = A deck\n", "TITLE = A deck\n", "ADAMS2NASTRAN"},
      {"subtitle = second\n", "SUBTITLE = second\n", "Simulation time 0.5\n"},
      {"load = 4\n", "LOAD = 4\n", nullptr},
      {"mpc_set = 700\n", "MPC = 700\n", "MPC = 1\n"},
      {"mpc_set = 700\n", "MPC*    700 ", "MPC*    1 "},
      {"spc_set = 10\n", "SPC = 10\n", "SPC = 1\n"},
      {"spc_set = 10\n", "SPC*    10 ", "SPC*    1 "},
      {"tic_set = 500\n", "TIC*    500 ", "TIC*    2 "},
      {"initial_dmig_set = 50\n", "SET 50 = KVVV\nSET 51 = BZZZ\nK2PP = 50\nB2PP = 51\n", "SET 1 ="},
      {"verbatim {\nECHO = BOTH\n}\n", "DISP(PLOT,PUNCH) = ALL\nECHO = BOTH\nBEGIN BULK", nullptr},
      {r + "begin_frequency = 11\n", "FREQ1*  600             11.             49.45           20\n",
       "            49.95 "},
      {r + "end_frequency = 2001\n", "FREQ1*  600             1.              100.            20\n",
       "            49.95 "},
      {r + "end_frequency = 2001\n", "0.              2.2             2001.           2.2\n", "1.+3 "},
      {r + "steps_frequency = 9\n", "FREQ1*  600             1.              111.            9\n",
       "            49.95 "},
      {r + "spacing_frequency = log\n", "FREQ2*  600             1.              1.+3            20\n", "FREQ1"},
      {r + "frequency_card_number = 7\n", "FREQUENCY = 7\n", "FREQUENCY = 600"},
      {r + "frequency_card_number = 7\n", "FREQ1*  7 ", "FREQ1*  600"},
      {r + "set_card_number = 558\n", "SET 558 = 2, 1000031\nSET 559 = 1000031\n", "SET 900 "},
      {r + "set_card_number_increment = 5\n", "SET 905 = 1000031\n", "SET 901 "},
      {r + "dload_card_number = 558\n", "DLOAD = 558\n", "DLOAD = 100\n"},
      {r + "dload_card_number_increment = 5\n", "DLOAD*  105 ", "DLOAD*  101 "},
      {r + "rload1_card_number = 558\n", "RLOAD1* 558             300                             400\n",
       "RLOAD1* 200 "},
      {r + "rload1_card_number_increment = 5\n", "RLOAD1* 205 ", "RLOAD1* 201 "},
      {r + "force_card_number = 558\n", "FORCE*  558             1000021         100             1.\n", "FORCE*  300 "},
      {r + "force_card_number_increment = 5\n", "MOMENT* 305 ", "MOMENT* 301 "},
      {r + "dphase_card_number = 658\n", "DPHASE* 658             1000021         2               45.\n",
       "DPHASE* 400 "},
      {r + "dphase_card_number_increment = 5\nactuator_swept_sine { name = act2 phase_angle = 1 }\n", "DPHASE* 405 ",
       nullptr},
      {r + "tabled1_card_number = 555\n", "TABLED1*555\n", "TABLED1*500\n"},
      {r + "tabled1_card_number_increment = 3\n", "TABLED1*503\n", "TABLED1*501\n"},
      {r, "KSVVV", "KVVV"},
      {r + "split_dmigs = no\n", "KVVV", "KSVVV"},
      {"matrix_entry_zero_tolerance = 1e-9\n", "2.D-9\n", nullptr},
      {"export_mode_shapes = yes\n", "== deck.pch\n", nullptr},
      {c + "export_rbe_connectivity = yes\n", "== deck_RBE2.nas\n", nullptr},
      {c + "export_spc_connectivity = yes\n", "$ RJOINT* 3               1000001         1000021         12345\n",
       "\nRJOINT*"},
      {c + "export_spc_connectivity = yes\n",
       "SPC*    30001           1000031         1236            0.\n*       1000021         1236            0.\n",
       "\nCBUSH*"},
      {c + "export_spc_connectivity = yes\nspc_set_connectivity = 1\n", "\nSPC*    2               1000001 ", nullptr},
      {r + "remove_unused_items = cbush\n", "CBUSH*  6000000", "CBUSH*  6000001"},
      {r + "remove_unused_items = cbush\n", "PBUSH*  6000000", "PBUSH*  6000001"},
      {r + "remove_unused_items = grid\n", "GRID*   1000031", "GRID*   1000099"},
      {c, "== deck_CONNECTIVITY.nas\n", "== deck_MODEL.nas\n"},
      {"main_file_include_extension=.data\n", "== deck.data\n", "== deck.dat\n"},
      {"model_include_extension = .bdf\n", "INCLUDE 'deck_MODEL.bdf'\n", "deck_MODEL.nas"},
      {c + "model_include_extension = .x\n", "== deck_model_PART_3.x\n", ".nas"},
      {"file_include_extension = .bdf2\n", "== deck_KVVV.bdf2\n", ".bdf\n"},
      {"include_directory = myinclude\n", "INCLUDE 'myinclude/deck_MODEL.nas'\n", "'deck_"},
      {"use_includes = no\n", "== deck.dat\n", "INCLUDE"},
      {"single_included_dmig = yes\n", "INCLUDE 'deck_DMIG.bdf'\n", "deck_GRAPHICS"},
      {r + c + "use_short_part_file_names = yes\n", "== deck_PART_3.nas\n", "deck_model_PART"},
      {"use_long_format = no\n", "\nGRID    2               .3333333-2.5    0.\n", "GRID*"},
      {"use_dmig_long_format = no\n", "DMIG    KVVV    2       1               2       1       100.", "DMIG*"},
      {"use_dmig_long_format = no\n", "DMIG    KVVV    0       1       1       0\n", "D0"},
      {"add_space_before_names = yes\n", "\n$ model.JOINT_1\n", "\n$model.JOINT_1\n"},
  };
}

TEST(DeckText, has_the_effect_of_each_directive) {
  for (const Effect& e : effects()) {
    const bool response = e.configuration.starts_with(sample_response);
    const bool bare = e.configuration == sample_response;
    std::string before = response && !bare ? sample_response : "";
    if (e.configuration.find("file_name_style = C\n") != std::string::npos &&
        e.configuration.size() > before.size() + 20)
      before += "file_name_style = C\n";
    const std::string with = all(written(sample_open_deck(), e.configuration)),
                      without = all(written(sample_open_deck(), before));
    EXPECT_THAT(with, HasSubstr(e.has)) << e.configuration;
    const bool replaces = std::string(e.has) == "== deck.dat\n" || std::string(e.has).starts_with("CBUSH") ||
                          std::string(e.has).starts_with("PBUSH") || std::string(e.has).starts_with("GRID*");
    if (!replaces) {
      EXPECT_THAT(without, Not(HasSubstr(e.has))) << e.configuration;
    }
    if (!e.lacks) continue;
    EXPECT_THAT(with, Not(HasSubstr(e.lacks))) << e.configuration;
    EXPECT_THAT(without, HasSubstr(e.lacks)) << e.configuration;
  }
}

TEST(DeckText, has_the_documented_files_of_each_style) {
  EXPECT_THAT(names(written(sample_open_deck(), "", "path")),
              ElementsAre("path.dat", "path_MODEL.nas", "path_KVVV.bdf", "path_BZZZ.bdf", "path_GRAPHICS.bdf"));
  EXPECT_THAT(names(written(sample_open_deck(), "file_name_style = B\n", "path.ext")),
              ElementsAre("path.ext", "path_MODEL.ext", "path_KVVV.ext", "path_BZZZ.ext", "path_GRAPHICS.ext"));
  EXPECT_THAT(names(written(sample_open_deck(), "file_name_style = C\n", "path")),
              ElementsAre("path.dat", "path_PROPERTY.nas", "path_model_PART_2.nas", "path_model_PART_3.nas",
                          "path_CONNECTIVITY.nas"));
  // Nothing but names differs between A and B.
  const DeckText A = written(sample_open_deck(), "", "path"),
                 B = written(sample_open_deck(), "file_name_style = B\n", "path.ext");
  for (std::size_t k = 1; k < A.files.size(); ++k) EXPECT_EQ(A.files[k].text, B.files[k].text);
}

TEST(DeckText, gives_bodies_of_one_name_files_of_their_own) {
  Deck d = sample_open_deck();
  d.bodies[1].name = "model/PART 2";
  EXPECT_THAT(names(written(d, "file_name_style = C\n", "p")), ::testing::Contains("p_model_PART_2_2.nas"));
}

// The cards of each body, its rigid elements and its graphics in its own file, what joins bodies in none of them.
TEST(DeckText, keeps_bodies_apart_in_style_C) {
  const DeckText t = written(sample_open_deck(), "file_name_style = C\n");
  const std::string two = file(t, "deck_model_PART_2.nas"), three = file(t, "deck_model_PART_3.nas");
  for (const char* card :
       {"GRID*   2 ", "GRID*   1000021", "CORD2R* 100", "CONM2*  1 ", "RBE2*   4 ", "TIC*    2               2 "})
    EXPECT_THAT(two, HasSubstr(card));
  for (const char* card :
       {"GRID*   3 ", "GRID*   4000000", "CQUAD4* 7 ", "RBE2*   6 ", "SPC*    1               3               45"})
    EXPECT_THAT(three, HasSubstr(card));
  EXPECT_THAT(two + three, Not(::testing::ContainsRegex("RJOINT|MPC|CBUSH|DMIG|SPOINT|PSHELL")));
  EXPECT_THAT(file(t, "deck_PROPERTY.nas"), ::testing::AllOf(HasSubstr("PBUSH*  6000000"), HasSubstr("PSHELL* 1 "),
                                                             HasSubstr("PROD*   2 "), HasSubstr("MAT1*   1000")));
}

TEST(DeckText, says_that_bodies_without_their_joints_are_apart) {
  const DeckText t = written(sample_open_deck(), "file_name_style = C\nexport_spc_connectivity = yes\n");
  ASSERT_EQ(t.remarks.items().size(), 1u);
  EXPECT_EQ(t.remarks.items().front().code, "export-differs");
  EXPECT_THAT(all(t), Not(HasSubstr("SPC = 3")));
}

TEST(DeckText, selects_what_is_there_and_nothing_else) {
  Deck d = sample_closed_deck();
  d.relations.clear(), d.fixed_points.clear();
  d.matrices[1].entries = {{{2, 0}, {2, 0}, 1e-12}};
  const std::string text = all(written(d, ""));
  EXPECT_THAT(text, Not(::testing::ContainsRegex("MPC =|SPC =|B2PP|BVVV|AUTOMSET")));
  EXPECT_THAT(text, HasSubstr("SET 1 = KVVV\nSET 2 = MVVV\nK2PP = 1\nM2PP = 2\n"));
}

TEST(DeckText, continues_long_lists_behind_a_comma) {
  Deck d = sample_closed_deck();
  for (int k = 0; k < 30; ++k) {
    Matrix m = d.matrices[0];
    m.suffix = "F" + std::to_string(1000 + k);
    d.matrices.push_back(m);
  }
  std::istringstream in(all(written(d, "")));
  std::string line, set;
  while (std::getline(in, line) && !line.starts_with("SET 1")) {
  }
  for (; line.ends_with(","); std::getline(in, line)) {
    EXPECT_LE(line.size(), 72u);
    set += line;
  }
  set += line;
  EXPECT_EQ(std::count(set.begin(), set.end(), 'K'), 31);
}

TEST(DeckText, keeps_every_grid_that_something_has) {
  Deck d = sample_open_deck();
  d.outputs = {{0, 3}};
  d.grids.push_back({of_body(1, "an output"), 1000100, {1, 1, 1}, 0, ""});
  d.grids.push_back({of_body(1, "rides along"), 1000101, {1, 1, 1}, 0, ""});
  d.rigid_elements[1].dependent = {1000031, 1000100, 1000101};
  d.outputs.push_back({1, 1000100});
  d.grids.push_back({of_body(1, "the end of a bush"), 1000102, {1, 1, 1}, 0, ""});
  d.bushes[0].grid_B = 1000102;
  const std::string text = all(written(d, std::string(sample_response) + "remove_unused_items = cbush, grid\n"));
  for (const char* id : {"2 ", "3 ", "1000021 ", "1000001 ", "1000031 ", "1000100 ", "1000102 ", "4000003 "})
    EXPECT_THAT(text, HasSubstr("GRID*   " + std::string(id)));
  EXPECT_THAT(text, Not(::testing::ContainsRegex("1000099|1000101")));
  EXPECT_THAT(text, HasSubstr("RBE2*   5               3               123456          1000031\n*       1000100\n"));
}

// --- matrices ---
Deck with_matrix(std::vector<Matrix::Entry> entries, std::string suffix = "VVV") {
  Deck d = sample_closed_deck();
  d.matrices = {{of_body(-1, ""), MatrixKind::K, std::move(suffix), std::move(entries)}};
  return d;
}
constexpr Dof a{2, 0}, b{3, 0};

TEST(DeckMatrix, has_rows_under_their_columns) {
  const std::string text = file(written(with_matrix({{a, b, -120}, {b, a, 7}}), ""), "deck_KVVV.bdf");
  EXPECT_THAT(text, HasSubstr("DMIG    KVVV    0       1       2       0\n"
                              "DMIG*   KVVV            2               0\n"
                              "*       3               0               7.D0\n"
                              "DMIG*   KVVV            3               0\n"
                              "*       2               0               -1.2D2\n"));
}

TEST(DeckMatrix, is_one_triangle_where_it_is_symmetric) {
  const std::string text = file(written(with_matrix({{a, a, 1}, {a, b, 2}, {b, a, 2}}), ""), "deck_KVVV.bdf");
  EXPECT_THAT(text, HasSubstr("DMIG    KVVV    0       6       2       0\n"));
  EXPECT_THAT(text,
              HasSubstr("DMIG*   KVVV            2               0\n*       2               0               1.D0\n"
                        "*       3               0               2.D0\n*\n"));
  EXPECT_THAT(text, Not(HasSubstr("DMIG*   KVVV            3 ")));
}

TEST(DeckMatrix, adds_up_in_its_two_parts) {
  const auto t = written(with_matrix({{a, a, 1}, {a, b, 2}, {b, a, 5}}), sample_response);
  EXPECT_THAT(file(t, "deck_KSVVV.bdf"), HasSubstr("DMIG    KSVVV   0       6       2       0\n"));
  EXPECT_THAT(file(t, "deck_KSVVV.bdf"), HasSubstr("*       3               0               3.5D0\n"));
  EXPECT_THAT(file(t, "deck_KAVVV.bdf"), HasSubstr("DMIG    KAVVV   0       1       2       0\n"));
  EXPECT_THAT(file(t, "deck_KAVVV.bdf"), HasSubstr("*       3               0               1.5D0\n"));
  EXPECT_THAT(file(t, "deck_KAVVV.bdf"), HasSubstr("*       2               0               -1.5D0\n"));
  EXPECT_THAT(all(t), HasSubstr("SET 1 = KSVVV, KAVVV\n"));
}

// Rounding must not make a full antisymmetric matrix.
TEST(DeckMatrix, has_no_second_part_of_rounding) {
  const auto t = written(with_matrix({{a, a, 1}, {a, b, 2}, {b, a, 2 + 1e-12}}), sample_response);
  EXPECT_THAT(all(t), HasSubstr("SET 1 = KVVV\n"));
  EXPECT_THAT(all(t), Not(HasSubstr("KAVVV")));
}

TEST(DeckMatrix, says_what_it_drops) {
  const auto small = written(with_matrix({{a, a, 1e-5}, {b, b, 5e-9}}), "");
  ASSERT_EQ(small.remarks.items().size(), 1u);
  EXPECT_THAT(small.remarks.items().front().message, HasSubstr("up to 5e-09; the largest is 1e-05"));
  EXPECT_THAT(small.details.front(), HasSubstr("the largest entry that is not written is 5e-09"));
  const auto large = written(with_matrix({{a, a, 1}, {b, b, 5e-9}}), "");
  EXPECT_TRUE(large.remarks.items().empty());
  // The rounding that a CBUSH leaves of a force is worth no remark.
  Deck rest = with_matrix({{a, a, 1e-13}});
  rest.bushes = {{of_body(-1, "BUSHING/1"), 7, 7, 4, 1, 0, 0.5, {100, 0, 0, 0, 0, 0}, {}}};
  EXPECT_TRUE(written(rest, "").remarks.items().empty());
  EXPECT_THAT(large.details.front(), HasSubstr("5e-09"));
  EXPECT_THAT(all(large), Not(HasSubstr("5.D-9")));
  EXPECT_THAT(all(written(with_matrix({{a, a, 1}, {b, b, 5e-9}}), "matrix_entry_zero_tolerance = 0\n")),
              HasSubstr("5.D-9"));
}

TEST(DeckMatrix, has_a_name_of_its_own) {
  Deck d = with_matrix({{a, a, 1}}, "abcdefgh");
  d.matrices.push_back(d.matrices[0]);
  d.matrices.push_back(d.matrices[0]);
  d.matrices.back().kind = MatrixKind::M;
  d.matrices.back().suffix = "PT";  // MPT is a data block
  EXPECT_THAT(all(written(d, "")), HasSubstr("SET 1 = KABCDEFG, KABCDEF1\nSET 2 = MPT1\n"));
}

// --- cards ---
TEST(DeckText, writes_products_of_inertia_with_their_signs) {
  EXPECT_THAT(file(written(sample_open_deck(), "use_long_format = no\n"), "deck_MODEL.nas"),
              HasSubstr("CONM2   1       2       0       12.5\n+       4.      -.5     5.      .25     -.125   6.\n"));
}

TEST(DeckText, scales_relations_and_makes_those_of_one_term_fixed_points) {
  const std::string text = file(written(sample_open_deck(), "use_long_format = no\n"), "deck_MODEL.nas");
  EXPECT_THAT(text, HasSubstr("MPC     1       2       1       -.375   3       1       1.\n"
                              "+               3000004 0       -.071429\n"));
  EXPECT_THAT(text, HasSubstr("MPC     1       3       2       .3333333"));
  EXPECT_THAT(text, HasSubstr("$model.JOINT_2\nSPC     1       3       6       0.\n"));
}

TEST(DeckText, has_axes_that_a_reader_finds_again) {
  // The points stand 10000 away, as far as the model reaches.
  EXPECT_THAT(
      file(written(sample_open_deck(), "use_long_format = no\n"), "deck_MODEL.nas"),
      HasSubstr(
          "CORD2R  100     0       0.      0.      1.      0.      0.      10001.\n+       8.+3    6.+3    1.\n"));
}

TEST(DeckText, breaks_long_includes_behind_slashes) {
  const std::string folder = "/a_folder_of_some_length/another_folder_of_some_length/and_a_third_one_below_them";
  const std::string text = file(written(sample_open_deck(), "", folder + "/deck"), folder + "/deck.dat");
  EXPECT_THAT(
      text,
      HasSubstr(
          "INCLUDE "
          "'/a_folder_of_some_length/another_folder_of_some_length/\nand_a_third_one_below_them/deck_MODEL.nas'\n"));
  const auto blank = written(sample_open_deck(), "include_directory =\n", folder + "/deck");
  EXPECT_THAT(file(blank, folder + "/deck.dat"), HasSubstr("INCLUDE 'deck_MODEL.nas'\n"));
  EXPECT_THAT(file(written(sample_open_deck(), "", "sub/deck"), "sub/deck.dat"),
              HasSubstr("INCLUDE 'deck_MODEL.nas'\n"));
  const auto refused = deck_text(sample_open_deck(), {}, std::string(70, 'x'));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().front(), HasSubstr("too long for an INCLUDE statement"));
  EXPECT_FALSE(deck_text(sample_open_deck(), {}, "it's"));
  const auto twice = deck_text(sample_open_deck(), options_of("main_file_include_extension = _MODEL.nas\n"), "deck");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error(), ElementsAre("two files of the export have the name deck_MODEL.nas"));
}

TEST(DeckText, fails_with_everything_that_no_card_can_hold) {
  Deck d = sample_open_deck();
  d.grids[1].position.y = std::nan("");
  d.masses[1].mass = std::numeric_limits<double>::infinity();
  d.matrices[0].entries[0].value = std::nan("");
  d.relations[2].terms[1].coefficient = std::nan("");
  d.shells[0].id = 100'000'000;
  const auto text = deck_text(d, {}, "deck");
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error(),
              ::testing::UnorderedElementsAre(
                  "GRID of centre of mass of model.PART_2: a value is not finite",
                  "CONM2 of model.PART_3: a value is not finite", "DMIG of all forces: a value is not finite",
                  HasSubstr("MPC of model.JOINT_3: a value is not finite"),
                  "CQUAD4 of model.BOX_1: the number 100000000 does not fit into eight columns",
                  HasSubstr("use_adams_ids = no")));
}

// --- frequency response ---
TEST(DeckText, never_gives_two_loads_one_number) {
  std::string many = sample_response;
  for (int k = 0; k < 120; ++k)
    many += "frequency_response_subcase { number = " + std::to_string(1000 + k) +
            " input_channel_names = inp1 output_channel_names = out1 }\n";
  std::istringstream in(file(written(sample_open_deck(), many), "deck.dat"));
  std::map<std::string, int> numbers, sets;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("DLOAD*") || line.starts_with("RLOAD1*")) ++numbers[line.substr(8, 16)];
    if (line.starts_with("SET ")) ++sets[line.substr(0, line.find('='))];
  }
  EXPECT_EQ(numbers.size(), 124u);
  for (const auto& [number, times] : numbers) EXPECT_EQ(times, 1) << number;
  EXPECT_EQ(sets.size(), 124u);
  const std::string clash = std::string(sample_response) + "initial_dmig_set = 900\n";
  EXPECT_THAT(all(written(sample_open_deck(), clash)), HasSubstr("SET 902 = 2, 1000031\n"));
}

TEST(DeckText, leaves_subcases_out_that_have_no_channel_left) {
  Deck d = sample_open_deck();
  d.inputs.erase(d.inputs.begin());
  const DeckText t = written(d, sample_response);
  EXPECT_THAT(all(t), Not(HasSubstr("SUBCASE 200")));
  EXPECT_THAT(all(t), HasSubstr("SUBCASE 100\n  LABEL = inp2 -> out1 out2\n  DLOAD = 100\n  DISP(PLOT,PUNCH) = 900\n"));
  ASSERT_EQ(t.remarks.items().size(), 1u);
  EXPECT_THAT(t.remarks.items().front().message, HasSubstr("subcase 200 has no input channel"));
}

// --- mode shapes ---
TEST(DeckText, has_mode_shapes_in_records_of_a_punch_file) {
  const std::string text = file(written(sample_open_deck(), "export_mode_shapes = yes\n"), "deck.pch");
  std::istringstream in(text);
  int records = 0;
  for (std::string line; std::getline(in, line);) {
    EXPECT_EQ(line.size(), 80u) << line;
    EXPECT_EQ(std::atoi(line.substr(72).c_str()), ++records);
  }
  EXPECT_EQ(records, 2 * (7 + 3 * 4));
  EXPECT_THAT(text, HasSubstr("\n$EIGENVALUE = ( -0.1719612E+00,  0.6601065E+01) MODE =     1                   7\n"));
  EXPECT_THAT(text, HasSubstr("\n         2       G     -1.719612E-01     -3.439225E-01     -5.158837E-01       8\n"
                              "-CONT-                 -6.878449E-01"));
  EXPECT_THAT(text, HasSubstr("\n   3000004       S     -1.719612E-01      0.000000E+00      0.000000E+00      16\n"));
}

}  // namespace
}  // namespace dynalin::nastran::deck_text_test
