// What is told of wrong decks: code, line and column; and that a right one has nothing.
#include "nastran_reader/check.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "nastran_reader/solve.h"

namespace dynalin::nastran_reader::check_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> told(const Diagnostics& all) {
  std::vector<std::string> out;
  for (const Diagnostic& d : all.items()) {
    std::string place;
    if (d.at.source) {
      const auto at = d.at.source->place(d.at.offset);
      place = std::to_string(at.line) + ":" + std::to_string(at.column);
    }
    out.push_back(std::string(d.severity == Severity::error ? "error " : "warning ") + std::string(d.code) + " " +
                  place);
  }
  return out;
}

std::vector<std::string> of_text(const std::string& text, Purpose purpose = Purpose::check) {
  Diagnostics reading;
  Deck deck = deck_of_text("test.bdf", text, reading);
  return told(prepare(std::move(deck), std::move(reading), purpose).diagnostics);
}

// Bulk data begin on line 6.
std::vector<std::string> of_bulk(const std::string& bulk, Purpose purpose = Purpose::check) {
  return of_text("SOL 107\nCEND\nCMETHOD = 1\nBEGIN BULK\nEIGC,1,HESS,MAX,,,,10\n" + bulk + "ENDDATA\n", purpose);
}
std::vector<std::string> of_control(const std::string& control, const std::string& bulk) {
  return of_text("SOL 107\nCEND\nCMETHOD = 1\n" + control + "BEGIN BULK\nEIGC,1,HESS,MAX,,,,10\n" + bulk + "ENDDATA\n");
}

TEST(Check, says_nothing_of_a_right_deck) {
  EXPECT_THAT(of_control("SPC = 1\nMPC = 2\nK2PP = K\nTITLE = x $ y\nDISP(PLOT,PUNCH) = ALL\n",
                         "PARAM,AUTOSPC,NO\nPARAM,POST,0\nGRID,1\nGRID,2,,,,,,456\nGRID,3\nSPOINT,4\nCONM2,1,2,,1."
                         "\nRBE2,2,1,123456,3\n"
                         "SPC1,1,123456,1\nMPC,2,2,1,1.,4,,2.\nDMIG,K,0,6,1,0\nDMIG,K,4,0,,4,0,1.\n"),
              IsEmpty());
}

struct Wrong {
  const char* name;
  const char* bulk;
  std::vector<std::string> problems;
};

const std::vector<Wrong>& wrong_bulk() {
  static const std::vector<Wrong> rows = {
      // 1. forms of fields
      {"integer_for_real", "GRID,1,,1,2.,3.\n", {"error field-form 6:9"}},
      {"real_for_integer", "GRID,1.\n", {"error field-form 6:6"}},
      {"embedded_blank", "GRID    1               1. 5\n", {"error field-form 6:25"}},
      {"no_number", "GRID    1               1x.5\n", {"error field-form 6:25"}},
      {"number_over_the_border",
       "GRID    1              1.5\n",
       {"warning field-overflow 6:24", "error undefined-card-id 6:24"}},
      {"too_long_in_free_field", "GRID,1,,1.2345678\n", {"error field-overflow 6:9"}},
      {"too_many_in_free_field", "GRID,1,,,,,,,,,5\n", {"error field-overflow 6:16"}},
      {"beyond_the_line",
       "GRID    1                                                               +A      here\n",
       {"warning field-overflow 6:81"}},
      {"missing_number", "GRID,,,1.,2.\n", {"error field-missing 6:6"}},
      {"zero_number", "GRID,0\n", {"error field-range 6:6"}},
      {"wrong_component_digits", "GRID,1,,,,,,127\n", {"error field-range 6:13"}},
      {"nonsense_where_nothing_is_read", "MAT1,1,1.,,.3,,,,,\n,1x\n", {"error field-form 7:2"}},
      {"mass_with_a_ninth_field", "GRID,1\nCONM2,1,1,,1.,.1,.2,.3,77.\n", {"error field-form 7:24"}},
      {"inertia_with_an_eighth_field", "GRID,1\nCONM2,1,1,,1.\n,1.,,1.,,,1.,5.\n", {"error field-form 8:14"}},
      {"mass_with_a_third_row", "GRID,1\nCONM2,1,1,,1.\n,1.,,1.,,,1.\n,,3.\n", {"error field-form 9:3"}},
      {"two_springs_on_a_card", "SPOINT,1,2\nCELAS4,1,5.,1,,2,5.,2\n", {"error field-form 7:16"}},
      {"joint_with_more", "GRID,1\nGRID,2\nRJOINT,1,1,2,123,5\n", {"error field-form 8:18"}},
      {"frequencies_with_more", "FREQ1,5,1.,1.,3,7\n", {"error field-form 6:17"}},
      {"load_with_a_ninth_field", "SPOINT,1\nDAREA,3,1,,1.\nRLOAD1,2,3,,,1.,,LOAD,5\n", {"error field-form 8:23"}},
      {"parameter_with_more", "PARAM,AUTOSPC,NO,,5\n", {"error field-form 6:19"}},
      {"header_with_an_eighth_field",
       "SPOINT,1\nDMIG,K,0,6,1,0,,7\n",
       {"error field-form 7:17", "warning dmig-header 7:6", "warning unselected-set 7:6"}},
      {"second_system_without_number",
       "GRID,1\nGRID,2,,1.\nGRID,3,,,1.\nCORD1R,1,1,2,3,,1,2,3\n",
       {"error field-missing 9:17"}},
      {"displacement_without_point",
       "GRID,1\nSPC,1,1,123,,,123\n",
       {"error field-missing 7:15", "warning unselected-set 7:1"}},
      {"component_without_point", "GRID,1\nCELAS2,1,2.,1,3,,3\n", {"error field-missing 7:18"}},
      {"value_without_property", "PDAMP,1,2.,,3.\n", {"error field-missing 6:13"}},
      {"values_without_letter", "PBUSH,1,K,1.\n,,,2.\n", {"error field-missing 7:4"}},
      {"area_without_point", "SPOINT,1\nDAREA,3,1,,1.,,,2.\n", {"error field-missing 7:17"}},
      {"grid_behind_expansion", "GRID,1\nGRID,2\nGRID,3\nRBE2,1,1,123456,2,1.,3\n", {"error field-form 9:22"}},
      {"expansion_and_its_temperature", "GRID,1\nGRID,2\nRBE2,1,1,123456,2,1.,20.\n", {}},
      {"point_behind_a_range", "GRID,1\nGRID,2\nGRID,3\nSPC1,1,3,1,THRU,2,,3\n", {"warning unselected-set 9:1"}},
      {"table_behind_its_end", "TABLED1,5\n,0.,1.,1.,1.,ENDT,3.\n", {"error load-rules 7:19"}},
      {"lost_tag", "GRID,1,,,,,,,,+A\n+B,1\n", {"error lost-continuation 7:1"}},
      // 2. numbers that stand twice
      {"point_twice", "GRID,1\nSPOINT,1\n", {"error duplicate-card-id 7:8"}},
      {"element_twice_over_all_kinds",
       "GRID,1\nGRID,2\nCONM2,5,1,,1.\nPLOTEL,5,1,2\n",
       {"error duplicate-card-id 9:8"}},
      {"system_twice",
       "CORD2R,1,,0.,0.,0.,0.,0.,1.\n,1.\nCORD2R,1,,0.,0.,0.,0.,0.,1.\n,1.\n",
       {"error duplicate-card-id 8:8"}},
      {"property_twice", "PBUSH,1,K,1.\nPBUSH,1,K,1.\n", {"error duplicate-card-id 7:7"}},
      // 3. references
      {"no_grid", "CONM2,1,7,,1.\n", {"error undefined-card-id 6:9"}},
      {"grid_that_is_scalar", "SPOINT,7\nCONM2,1,7,,1.\n", {"error undefined-card-id 7:9"}},
      {"no_system", "GRID,1,,0.,0.,0.,8\n", {"error undefined-card-id 6:18"}},
      {"no_property", "GRID,1\nCBUSH,1,9,1,,,,,0\n", {"error undefined-card-id 7:9"}},
      {"no_scalar_property", "SPOINT,1\nCELAS1,1,9,1\n", {"error undefined-card-id 7:10"}},
      {"no_material", "PSHELL,1,7,.1\n", {"error undefined-card-id 6:10"}},
      {"no_shell_property", "GRID,1\nGRID,2,,1.\nGRID,3,,,1.\nCTRIA3,1,5,1,2,3\n", {"error undefined-card-id 9:10"}},
      {"no_mpc_point", "MPC,2,7,1,1.\n", {"error undefined-card-id 6:7", "warning unselected-set 6:1"}},
      {"range_of_points",
       "GRID,5\nSPC1,1,,1,THRU,99999999\n",
       {"error wrong-component 7:8", "warning unselected-set 7:1"}},
      {"range_backwards", "SPC1,1,3,9,THRU,1\n", {"error field-range 6:12"}},
      {"component_missing", "GRID,1\nCELAS2,1,2.,1\n", {"error wrong-component 7:14"}},
      {"component_of_scalar", "SPOINT,1\nCELAS2,1,2.,1,3\n", {"error wrong-component 7:15"}},
      // 6.
      {"first_coefficient_zero", "SPOINT,1\nMPC,1,1,,0.\n", {"error field-range 7:10"}},
      {"dependent_twice", "GRID,1\nGRID,2\nGRID,3\nRBE2,1,1,3,3\nRJOINT,2,2,3,345\n", {"error dependent-twice 10:12"}},
      {"dependent_and_held", "GRID,1\nGRID,2,,,,,,3\nRBE2,1,1,123,2\n", {"error dependent-twice 8:14"}},
      {"dependent_twice_with_automset",
       "PARAM,AUTOMSET,YES\nGRID,1\nGRID,2\nGRID,3\nRBE2,1,1,3,3\nRJOINT,2,2,3,345\n",
       {}},
      // 7. 8. 9.
      {"apart_joint", "GRID,1\nGRID,2,,.1\nRJOINT,1,1,2,123\n", {"error apart-joint 8:8"}},
      {"bush_without_length", "GRID,1\nGRID,2\nCBUSH,1,9,1,2,0.,0.,1.\nPBUSH,9,K,1.\n", {"error bush-axes 8:7"}},
      {"bush_to_ground", "GRID,1\nCBUSH,1,9,1\nPBUSH,9,K,1.\n", {"error bush-axes 7:7"}},
      {"bush_sideways", "GRID,1\nGRID,2,,1.\nCBUSH,1,9,1,2\nPBUSH,9,K,1.,,2.\n", {"error bush-axes 8:7"}},
      {"bush_along", "GRID,1\nGRID,2,,1.\nCBUSH,1,9,1,2\nPBUSH,9,K,1.,,,2.\n", {}},
      {"bush_orientation_along", "GRID,1\nGRID,2,,1.\nCBUSH,1,9,1,2,3.,0.,0.\nPBUSH,9,K,1.\n", {"error bush-axes 8:7"}},
      {"pbush_letter_in_field_2", "PBUSH,9,K,1.\n,B,1.\n", {"error field-form 7:2"}},
      {"a_is_b", "CORD2R,1,,0.,0.,0.,0.,0.,0.\n,1.\n", {"error degenerate-axes 6:8"}},
      {"c_on_the_axis", "CORD2R,1,,0.,0.,0.,0.,0.,1.\n,,,2.\n", {"error degenerate-axes 6:8"}},
      {"no_continuation", "CORD2R,1,,0.,0.,0.,0.,0.,1.\n", {"error field-missing 6:1"}},
      {"systems_in_a_circle",
       "CORD2R,1,2,0.,0.,0.,0.,0.,1.\n,1.\nCORD2R,2,1,0.,0.,0.,0.,0.,1.\n,1.\n",
       {"error degenerate-axes 6:8"}},
      // 10.
      {"mpc_not_selected", "SPOINT,1,2\nMPC,1,1,,1.,2,,1.\n", {"warning unselected-set 7:1"}},
      {"spc_not_selected", "GRID,1\nSPC,1,1,123\n", {"warning unselected-set 7:1"}},
      {"dmig_not_selected", "SPOINT,1\nDMIG,K,0,6,1,0\nDMIG,K,1,0,,1,0,1.\n", {"warning unselected-set 7:6"}},
      // 11.
      {"dload_is_an_rload1", "SPOINT,1\nDAREA,3,1,,1.\nRLOAD1,2,3,,,1.\nDLOAD,2,1.,1.,2\n", {"error load-rules 9:7"}},
      {"dload_twice_the_same",
       "SPOINT,1\nDAREA,3,1,,1.\nRLOAD1,2,3,,,1.\nDLOAD,4,1.,1.,2,1.,2\n",
       {"error load-rules 9:20"}},
      {"table_without_end", "TABLED1,5\n,0.,1.,1.,1.\n", {"error load-rules 7:11"}},
      {"table_of_one_point", "TABLED1,5\n,0.,1.,ENDT\n", {"error load-rules 6:1"}},
      {"freq2_from_zero", "FREQ2,5,0.,1.,3\n", {"error load-rules 6:9"}},
      {"rload1_without_table", "SPOINT,1\nDAREA,3,1,,1.\nRLOAD1,2,3,,,9\n", {"error undefined-card-id 8:14"}},
      {"rload1_without_excitation", "RLOAD1,2,3,,,1.\n", {"error undefined-card-id 6:10"}},
      {"tic_twice", "SPOINT,1\nTIC,2,1,,1.\nTIC,2,1,,1.\n", {"error duplicate-card-id 8:7"}},
      // 14.
      {"eigc_twice_a_number", "EIGC,2,CLAN,MAX,,,,5\n,1.,1.,,,,,5\n", {"error eigc-rules 6:20"}},
      {"eigc_hess_continued", "EIGC,2,HESS,MAX,,,,5\n,1.\n", {"error eigc-rules 6:8"}},
      {"unknown_card", "FOO,1\nFOO,2\nBAR,1\n", {"warning unknown-card 8:1", "warning unknown-card 6:1"}},
  };
  return rows;
}

TEST(Check, tells_what_is_wrong_with_bulk_data_at_its_place) {
  for (const Wrong& w : wrong_bulk()) EXPECT_EQ(of_bulk(w.bulk), w.problems) << w.name << "\n" << w.bulk;
}

TEST(Check, tells_what_is_wrong_with_direct_matrices) {
  const std::string points = "PARAM,AUTOSPC,NO\nSPOINT,1,2\n";
  const auto k = [&](const std::string& lines, const std::string& use = "K2PP = K\n") {
    return of_control(use, points + lines);
  };
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n"), IsEmpty());
  EXPECT_THAT(k(""), ElementsAre("error case-selection 4:8"));
  EXPECT_THAT(k("DMIG,K,1,0,,1,0,1.\n"), ElementsAre("error dmig-header 9:6"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n"), ElementsAre("error dmig-header 10:1"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\n"), ElementsAre("warning dmig-header 9:6"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n,1,0,2.\n"), ElementsAre("error dmig-term 11:6"));
  EXPECT_THAT(k("DMIG,K,0,6,1,0\nDMIG,K,1,0,,2,0,1.\nDMIG,K,2,0,,1,0,1.\n"), ElementsAre("error dmig-term 11:17"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.,2.\n"), ElementsAre("error dmig-term 10:20"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,1,1,,1,0,1.\n"), ElementsAre("error wrong-component 10:10"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1\n"), ElementsAre("error field-form 10:17"));
  EXPECT_THAT(k("DMIG,K,0,1,2,0\nDMIG,K,1,0,,1,0,1.\n"), ElementsAre("warning dmig-term 10:17"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n", "K2GG = K\n"), ElementsAre("error dmig-header 4:8"));
  EXPECT_THAT(k("DMIG,K,0,2,1,0\nDMIG,K,1,0,,1,0,1.\n"), ElementsAre("error dmig-header 4:8"));
  EXPECT_THAT(k("DMIG,K,0,1,1,0\nDMIG,K,9,0,,1,0,1.\n"), ElementsAre("error undefined-card-id 10:8"));
  EXPECT_THAT(of_control("K2PP = K\n", "SPOINT,1\nDMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n"),
              ElementsAre("warning autospc-on 4:8"));
}

TEST(Check, tells_what_is_wrong_with_case_control) {
  EXPECT_THAT(of_control("MPC = 4\n", ""), ElementsAre("error case-selection 4:7"));
  EXPECT_THAT(of_control("SPC = 4\n", ""), ElementsAre("error case-selection 4:7"));
  EXPECT_THAT(of_control("SPC = x\n", ""), ElementsAre("error case-command 4:7"));
  EXPECT_THAT(of_control("K2PP = 7\n", ""), ElementsAre("error undefined-card-id 4:8"));
  EXPECT_THAT(of_control("K2PP = K, 2.0*K\n", "PARAM,AUTOSPC,NO\nSPOINT,1\nDMIG,K,0,1,1,0\nDMIG,K,1,0,,1,0,1.\n"),
              ElementsAre("error case-command 4:8"));
  EXPECT_THAT(of_control("SUBCASE 1\nSPC = 1\nSUBCASE 2\nSPC = 2\n", "GRID,1\nSPC,1,1,1\nSPC,2,1,2\n"),
              ElementsAre("error case-command 7:7"));
  EXPECT_THAT(of_control("DISP = 5\n", ""), ElementsAre("error case-selection 4:8"));
  EXPECT_THAT(of_text("SOL 107\nCEND\nBEGIN BULK\nENDDATA\n"), ElementsAre("warning unselected-set 1:5"));
  EXPECT_THAT(of_text("SOL 107\nCEND\nCMETHOD=2\nBEGIN BULK\nENDDATA\n"), ElementsAre("error case-selection 3:9"));
  EXPECT_THAT(of_text("SOL 108\nCEND\nFREQ=2\nBEGIN BULK\nENDDATA\n"),
              ElementsAre("error case-selection 3:6", "warning unselected-set 1:5"));
  EXPECT_THAT(of_text("SOL 107\nCEND\nSPC=1\n"), ElementsAre("error deck-section 2:1", "warning deck-section 3:1"));
  EXPECT_THAT(of_text("GRID,1\n"), ElementsAre("warning deck-section 1:1", "warning deck-section 1:1"));
  EXPECT_THAT(of_text(""), ElementsAre("error deck-section 1:1"));
}

TEST(Check, tells_of_the_solver_what_it_would_leave_out) {
  EXPECT_THAT(of_bulk("FOO,1\n", Purpose::solve), ElementsAre("error unassembled-card 6:1"));
  EXPECT_THAT(of_bulk("FOO,1\n", Purpose::solve_what_is_known), ElementsAre("warning unknown-card 6:1"));
  const std::string shell = "GRID,1\nGRID,2,,1.\nGRID,3,,,1.\nCTRIA3,1,5,1,2,3\n";
  EXPECT_THAT(of_bulk(shell + "PSHELL,5,6,.1\nMAT1,6,1.,,.3\n", Purpose::solve),
              ElementsAre("error unassembled-card 9:8"));
  EXPECT_THAT(of_bulk(shell + "PSHELL,5,6,.1\nMAT1,6,1.,,.3\nRBE2,2,1,123456,2,3\n", Purpose::solve), IsEmpty());
  EXPECT_THAT(of_bulk(shell + "PSHELL,5,6,.1\nMAT1,6,1.,,.3,2.\nRBE2,2,1,123456,2,3\n", Purpose::solve),
              ElementsAre("error unassembled-card 10:8"));
  EXPECT_THAT(of_bulk("PARAM,G,.02\n", Purpose::solve), ElementsAre("error unassembled-card 6:9"));
  EXPECT_THAT(of_bulk("PARAM,G,0.\n", Purpose::solve), IsEmpty());
  EXPECT_THAT(of_bulk("PBUSH,1,GE,.1\n", Purpose::solve), ElementsAre("error unassembled-card 6:9"));
  EXPECT_THAT(of_bulk("PBUSH,1,GE,.1\n"), ElementsAre("warning unassembled-card 6:9"));
  EXPECT_THAT(of_text("SOL 107\nCEND\nCMETHOD=1\nTFL=3\nBEGIN BULK\nEIGC,1,HESS\nENDDATA\n", Purpose::solve),
              ElementsAre("error unassembled-card 4:1"));
  // Of a dependent component that stands twice the result is the same.
  EXPECT_THAT(of_bulk("GRID,1\nGRID,2\nGRID,3\nRBE2,1,1,3,3\nRJOINT,2,2,3,345\n", Purpose::solve),
              ElementsAre("warning dependent-twice 10:12"));
}

TEST(Check, tells_of_constraints_that_nearly_follow_from_others) {
  const std::string bulk = "SPOINT,1,2,3\nMPC,1,1,,1.,2,,1.\nMPC,1,2,,1.,3,,1.\nMPC,1,3,,1.,1,,";
  EXPECT_THAT(of_control("MPC = 1\n", bulk + "-1.\n"), IsEmpty());
  EXPECT_THAT(of_control("MPC = 1\n", bulk + "-1.00001\n").back().substr(0, 28), "warning nearly-dependent-row");
}

// Files in a folder of their own.
class Included : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("decks" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "deep");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Prepared read(const std::string& name) { return prepare((folder_ / name).string(), Purpose::check); }

  std::filesystem::path folder_;
};

TEST_F(Included, files_stand_where_they_are_named) {
  write("main.bdf", "SOL 107\nINCLUDE 'control.inc'\nBEGIN BULK\ninclude 'deep/\n   grids.bdf'\nENDDATA\n");
  write("control.inc", "CEND\nCMETHOD=1\n");
  write("deep/grids.bdf", "INCLUDE more.bdf $ from here\nGRID,1\n");
  write("deep/more.bdf", "GRID,2\nINCLUDE 'eigc.bdf'\n");
  write("eigc.bdf", "EIGC,1,HESS,MAX,,,,1\n");
  const Prepared p = read("main.bdf");
  EXPECT_THAT(told(p.diagnostics), IsEmpty());
  ASSERT_EQ(p.deck.grids.size(), 2u);
  EXPECT_EQ(p.deck.grids[0].id.id, 2);
  EXPECT_EQ(p.deck.methods.size(), 1u);
}

TEST_F(Included, files_that_are_wrong_are_told) {
  write("main.bdf", "INCLUDE 'a.bdf'\nINCLUDE 'none.bdf'\nINCLUDE '\nGRID,1\n");
  write("a.bdf", "INCLUDE 'main.bdf'\n");
  EXPECT_THAT(told(read("main.bdf").diagnostics),
              ElementsAre("error include-cycle 1:10", "error include-missing 2:10", "error include-missing 3:10"));
  for (int k = 0; k < 12; ++k) write("n" + std::to_string(k), "INCLUDE 'n" + std::to_string(k + 1) + "'\n");
  EXPECT_THAT(told(read("n0").diagnostics), ElementsAre("error include-depth 1:10"));
  write("long.bdf", "INCLUDE '" + std::string(70, 'x') + "'\n");
  EXPECT_THAT(told(read("long.bdf").diagnostics),
              ElementsAre("error include-long-line 1:73", "error include-missing 1:10"));
  EXPECT_THAT(told(read("nothing").diagnostics), ElementsAre("error include-missing "));
}

}  // namespace
}  // namespace dynalin::nastran_reader::check_test
