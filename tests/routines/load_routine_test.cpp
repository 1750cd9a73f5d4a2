// NFORCE and MFORCE by compiled routines, and the modal coordinates that routines read: against the same loads by
// matrices and expressions, in C, Fortran and by formulas.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "routines/with_libraries.h"

namespace dynalin::cases::load_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> linear = {"LINEAR/EIGENSOL"}, statics = {"SIMULATE/STATICS", "LINEAR/EIGENSOL"};

class LoadRoutines : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& commands = linear,
                 const std::vector<std::string>& libraries = {C_LOADS, CPP_LOADS}, bool differences = false) const {
    return WithLibraries::with(dataset, libraries, differences, commands);
  }
};

// --- NFORCE -----------------------------------------------------------------------------------------
// Two parts as seen from a third one, which moves in a bushing; drawn away from rest, and moving.
const std::string three = R"(three
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-2
PART/1, GROUND
MARKER/1
MARKER/11, QP=0,0,1
PART/2, MASS=1, CM=20, IP=1,2,3, QG=0.1,0.2,-0.1, REULER=10D,5D,-8D, VX=0.4, WZ=0.3
MARKER/20
MARKER/21, QP=0.1,0,0.2
PART/3, MASS=2, CM=30, IP=3,1,2, QG=-0.2,0.1,0.1, REULER=-5D,8D,3D
MARKER/30
MARKER/31, QP=0,0.3,0.1, REULER=12D,0,0
PART/4, MASS=3, CM=40, IP=2,2,3, WX=0.2
MARKER/40
MARKER/41, QP=0.1,0.1,-0.2, REULER=0,20D,10D
BUSHING/1, I=40, J=1, K=60,70,80, KT=20,30,40, C=1,1,1
BUSHING/2, I=20, J=11, K=40,50,60, KT=40,30,50
)";
std::string by_matrices() {
  const std::array<double, 6> k = {30, 50, 20, 4, 6, 3}, c = {1, 0.5, 2, 0.2, 0.1, 0.3};
  const std::array<double, 2> from_other = {0.3, 0.1};
  std::string K = "MATRIX/1, FULL=RORDER, ROWS=12, COLUMNS=12, VALUES=",
              C = "MATRIX/2, FULL=RORDER, ROWS=12, COLUMNS=12, VALUES=";
  for (std::size_t row = 0; row < 12; ++row) {
    for (std::size_t column = 0; column < 12; ++column) {
      const bool same = row % 6 == column % 6;
      const double share = row / 6 == column / 6 ? 1 : from_other[row / 6];
      const char* between = row + column == 0 ? "" : column % 6 == 0 ? "\n, " : ",";
      K += fmt::format("{}{}", between, same ? share * k[row % 6] : 0);
      C += fmt::format("{}{}", between, row == column ? c[row % 6] : 0);
    }
  }
  return K + "\n" + C + "\nNFORCE/1, IMARKERS=21,31, J=41, KMATRIX=1, CMATRIX=2\n";
}
const std::string by_routine = "NFORCE/1, IMARKERS=21,31, J=41, FUNCTION=USER(21,31,41)";

TEST_F(LoadRoutines, several_markers_feel_what_matrices_say) {
  for (const auto& commands : {linear, statics}) {
    const std::size_t result = commands.size() - 1;
    const RunResult expected = with(three + by_matrices(), commands);
    for (const char* routine : {"", ", ROUTINE=loads::Nfosubc", ", ROUTINE=load_formulas::several_by_formula"}) {
      const RunResult r = with(three + by_routine + routine + "\n", commands);
      expect_same(r, expected, 1e-8, result);
      EXPECT_THAT(r.err, AllOf(Not(HasSubstr("differenced-routine")), Not(HasSubstr("wrong-derivative")))) << routine;
    }
    // Abbreviated as far as the statement itself allows, whatever arguments of routines begin with.
    expect_same(with(three + "NFORCE/1, I=21,31, J=41, FUNCTION=USER(21,31,41), ROUTINE=loads::Nfosubc\n", commands),
                expected, 1e-8, result);
#ifdef FORTRAN_LOADS
    const RunResult differenced = with(three + by_routine + "\n", commands, {FORTRAN_LOADS}, true);
    expect_same(differenced, expected, 1e-7, result);
    EXPECT_THAT(differenced.err, HasSubstr("differenced-routine"));
#endif
  }
}

// Each marker has its rows in the tables of energies, and force functions see it.
TEST_F(LoadRoutines, several_markers_are_seen_in_tables_and_functions) {
  const std::string shown = "REQUEST/1, F2=FX(21,41,41)\\F3=TY(31,0,41)\\F4=FZ(41,21,1)\\F6=TX(41,31,41)\n";
  const std::vector<std::string> tables = {"SIMULATE/STATICS", "LINEAR/EIGENSOL, STRAIN=1,20, DISSIPAT=1,20"};
  const RunResult expected = with(three + by_matrices() + shown, tables),
                  called = with(three + by_routine + "\n" + shown, tables);
  const auto a = requested(expected, 0), b = requested(called, 0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(b[k], a[k], 1e-7 * (1 + std::abs(a[k]))) << k;
  EXPECT_GT(std::abs(a.at(1)) + std::abs(a.at(2)), 0.01);
  for (const char* table : {"STRAIN", "DISSIPAT"}) {
    const auto of = [&](const RunResult& r) {
      for (const auto& t : r.result(1).at("tables"))
        if (t.at("table") == table) return t.at("rows");
      return nlohmann::json();
    };
    std::size_t of_markers = 0;
    ASSERT_EQ(of(called).size(), of(expected).size());
    for (std::size_t k = 0; k < of(expected).size(); ++k) {
      EXPECT_EQ(of(called)[k].at("element"), of(expected)[k].at("element"));
      of_markers += of(called)[k].at("element").get<std::string>().find("NFORCE/1") != std::string::npos;
      const auto x = of(called)[k].at("values").get<std::vector<double>>(),
                 y = of(expected)[k].at("values").get<std::vector<double>>();
      for (std::size_t c = 0; c < y.size(); ++c) EXPECT_NEAR(x[c], y[c], 1e-5) << table << k << c;
    }
    EXPECT_EQ(of_markers, 2u) << table;
  }
}

TEST_F(LoadRoutines, several_markers_without_derivatives_are_refused_by_name) {
  const RunResult refused = with(three + by_routine + ", ROUTINE=without_partials\n");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("NFORCE/1"), HasSubstr("without_partials"),
                                 HasSubstr("gives no derivatives"), HasSubstr("--difference-user-routines")));
  expect_same(with(three + by_routine + ", ROUTINE=without_partials\n", linear, {C_LOADS}, true),
              with(three + by_matrices()), 1e-7);
  EXPECT_THAT(with(three + by_routine + ", ROUTINE=with_wrong_partials\n").err,
              AllOf(HasSubstr("wrong-derivative"), HasSubstr("NFORCE/1"), HasSubstr("DX(21, 41, 41)")));
  EXPECT_THAT(with(three + "NFORCE/1, IMARKERS=21,31, J=41, FUNCTION=3*TIME\n").err,
              AllOf(HasSubstr("unknown-word"), HasSubstr("NFORCE/1")));
}

// --- MFORCE -----------------------------------------------------------------------------------------
// A body with one mode, which a lump of mass 2 has alone, in a bushing; JFLOAT is on a part beside it.
const std::string lump = R"(lump
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-2
PART/1, GROUND
MARKER/1
FLEX_BODY/2, MATRICES=1,2,3,4,5,6,7,8,9,10,11,12,13,14, CRATIO=0, REULER=20D,10D,0, VX=0.3
MARKER/21, FLEX_BODY=2, NODE_ID=1
MARKER/22, FLEX_BODY=2, NODE_ID=2
PART/3, MASS=3, CM=30, IP=2,2,3, QG=0.3,0.2,0.1, WZ=0.2
MARKER/30
MARKER/7, PART=3, FLOATING
MARKER/8, PART=3, FLOATING
BUSHING/1, I=21, J=1, K=60,70,80, KT=20,30,40, C=1,1,1
BUSHING/2, I=30, J=1, K=60,70,80, KT=20,30,40, C=1,1,1
MATRIX/1, NAME=SELNOD, FULL=RORDER, ROWS=2, COLUMNS=4, VALUES=1,0,0,0, 2,1,0,0
MATRIX/2, NAME=T_MODE, FULL=RORDER, ROWS=6, COLUMNS=1, VALUES=0,0,0,1,0,0
MATRIX/3, NAME=R_MODE, FULL=RORDER, ROWS=6, COLUMNS=1, VALUES=0,0,0,0,0,0
MATRIX/4, NAME=GENSTIFF, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=800
MATRIX/5, NAME=INVAR1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=3
MATRIX/6, NAME=INVAR2, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=2,0,0
MATRIX/7, NAME=INVAR3, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=2,0,0
MATRIX/8, NAME=INVAR4, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0
MATRIX/9, NAME=INVAR5, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0
MATRIX/10, NAME=INVAR6, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=2
MATRIX/11, NAME=INVAR7, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=0.1,0,0, 0,2,0, 0,0,2
MATRIX/12, NAME=INVAR8, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=0,0,0, 0,-2,0, 0,0,-2
MATRIX/13, NAME=INVAR9, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=0,0,0, 0,-2,0, 0,0,-2
MATRIX/14, NAME=MODLOAD, FULL=CORDER, ROWS=7, COLUMNS=2, VALUES=0.3,-0.2,0.5,0.1,-0.4,0.2,1
, -0.5,0.6,0.1,0.3,0.2,0.7,0.4
)";
const std::string scale = "2-40*(DX(22,21,21)-1)-3*VX(22,21,21,21)";
const std::string both_loads = "MFORCE/1, FLEX_BODY=2, JFLOAT=7, CASE_INDEX=1, SCALE=" + scale +
                               "\nMFORCE/2, FLEX_BODY=2, JFLOAT=8, CASE_INDEX=2, SCALE=0.5\n";
const std::string force = "MFORCE/1, FLEX_BODY=2, JFLOAT=7, FORCE=USER(2)";

TEST_F(LoadRoutines, a_modal_force_is_what_its_cases_are) {
  for (const auto& commands : {linear, statics}) {
    const std::size_t result = commands.size() - 1;
    const RunResult expected = with(lump + both_loads, commands);
    for (const char* routine : {"", ", ROUTINE=loads::Mfosubc", ", ROUTINE=load_formulas::load_by_formula"}) {
      const RunResult r = with(lump + force + routine + "\n", commands);
      expect_same(r, expected, 1e-8, result);
      EXPECT_THAT(r.err, AllOf(Not(HasSubstr("differenced-routine")), Not(HasSubstr("wrong-derivative")))) << routine;
    }
#ifdef FORTRAN_LOADS
    expect_same(with(lump + force + "\n", commands, {FORTRAN_LOADS}, true), expected, 1e-7, result);
#endif
    EXPECT_GT(std::abs(expected.eigenvalues(result).back()), 1);
  }
}

TEST_F(LoadRoutines, a_scale_goes_with_one_of_the_loads) {
  for (const int number : {1, 2}) {
    for (const std::string reaction : {"", ", JFLOAT=7"}) {
      const RunResult expected = with(
          lump + fmt::format("MFORCE/1, FLEX_BODY=2{}, CASE_INDEX={}, SCALE={}\n", reaction, number, scale), statics);
      const std::string call = fmt::format("MFORCE/1, FLEX_BODY=2{}, FUNCTION=USER(2,{}), ROUTINE=", reaction, number);
      for (const char* routine : {"loads::scaled", "loads::Scaledc", "load_formulas::scale_by_formula"}) {
        const RunResult r = with(lump + call + routine + "\n", statics);
        expect_same(r, expected, 1e-8, 1);
        EXPECT_THAT(r.err, AllOf(Not(HasSubstr("differenced-routine")), Not(HasSubstr("wrong-derivative")))) << routine;
      }
    }
  }
  // A load of its own, 0.7 times the first one.
  expect_same(with(lump + "MFORCE/1, FLEX_BODY=2, JFLOAT=7, FUNCTION=USER(2,0,0.7), ROUTINE=scaled\n", statics),
              with(lump + "MFORCE/1, FLEX_BODY=2, JFLOAT=7, CASE_INDEX=1, SCALE=0.7*(" + scale + ")\n", statics), 1e-8,
              1);
}

TEST_F(LoadRoutines, modal_forces_go_along_a_motion) {
  const std::string shown = "REQUEST/1, F2=DX(22,21,21)\\F3=DX(22,1)\\F4=WZ(21,1,1)\\F6=DY(30,1)\\F7=VX(30,1)\n";
  const std::vector<std::string> run = {"SIMULATE/TRANSIENT, END=0.5, STEPS=5", "SIMULATE/INITIAL"};
  const auto expected = requested(with(lump + both_loads + shown, run), 1);
  for (const char* routine : {"", ", ROUTINE=load_formulas::load_by_formula"}) {
    const auto found = requested(with(lump + force + routine + "\n" + shown, run), 1);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 1e-4 * (1 + std::abs(expected[k]))) << routine << k;
  }
}

TEST_F(LoadRoutines, modal_forces_that_go_wrong_are_named) {
  EXPECT_THAT(with(lump + "MFORCE/1, FLEX_BODY=2, FUNCTION=USER(2,3), ROUTINE=scaled\n").err,
              AllOf(HasSubstr("MFORCE/1"), HasSubstr("takes modal load 3, and FLEX_BODY/2 has 2")));
  EXPECT_THAT(with(lump + "MFORCE/1, FLEX_BODY=2, FUNCTION=USER(2), ROUTINE=changes_its_load\n").err,
              AllOf(HasSubstr("wrong-derivative"), HasSubstr("Q(2, 1)")));
  EXPECT_THAT(with(lump + "MFORCE/1, FLEX_BODY=2, CASE_INDEX=1, FORCE=USER(2)\n").err, HasSubstr("excluded-arguments"));
  EXPECT_THAT(with(lump + "MFORCE/1, FLEX_BODY=2, FORCE=TIME\n").err,
              AllOf(HasSubstr("unknown-word"), HasSubstr("FORCE of MFORCE/1")));
  EXPECT_THAT(with(lump + "MFORCE/1, FLEX_BODY=4, FORCE=USER(2)\n").err,
              AllOf(HasSubstr("routine-failed"), HasSubstr("the modes of FLEX_BODY/4, which are not known")));
}

// --- modal coordinates ------------------------------------------------------------------------------
// Other statements read them, and their rates: here by a VARIABLE whose rate is read, and in a request.
TEST_F(LoadRoutines, modal_coordinates_are_measures) {
  const std::string reading = "VARIABLE/1, FUNCTION=";
  const std::string of_rate =
      "VARIABLE/2, FUNCTION=DIF1(1)\nDIFF/1, IMPLICIT, FUNCTION=DIF(1)-VARVAL(1)\n"
      "SFORCE/1, TRANSLATION, ACTIONONLY, I=30, J=1, FUNCTION=0.1*VARVAL(2)+0.3*VARVAL(1)\nREQUEST/1, VARIABLES=1,2\n";
  const RunResult expected = with(lump + reading + scale + "\n" + of_rate),
                  called = with(lump + reading + "USER(2), ROUTINE=load_formulas::scale_alone\n" + of_rate);
  expect_same(called, expected, 1e-8);
  const auto a = requested(expected, 0), b = requested(called, 0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(b[k], a[k], 1e-9 * (1 + std::abs(a[k]))) << k;
  EXPECT_THAT(with(lump + reading + "USER(3), ROUTINE=load_formulas::scale_alone\n").err,
              AllOf(HasSubstr("Q(3)"), HasSubstr("no quantity of the model")));
}

// --- data, and what is missing ----------------------------------------------------------------------
TEST_F(LoadRoutines, matrices_are_data) {
  const std::string model =
      "data\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\n"
      "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=3, VALUES=1,2,3,0,5,6\n"
      "MATRIX/2, SPARSE, ROWS=4, COLUMNS=3, I=1,4,2, J=2,3,1, VALUES=7,8,9\nREQUEST/1, VARIABLES=1\n";
  const auto value = [&](int id, int what, int number) {
    const RunResult r =
        with(model + fmt::format("VARIABLE/1, FUNCTION=USER({},{},{}), ROUTINE=of_a_matrix\n", id, what, number),
             {"SIMULATE/INITIAL"});
    return requested(r, 0).at(0);
  };
  const std::vector<std::vector<double>> expected_info = {{1, 2, 3, 6, 0}, {2, 4, 3, 3, 0}};
  for (int id = 1; id <= 2; ++id) {
    for (int k = 0; k < 5; ++k)
      EXPECT_EQ(value(id, 0, k), expected_info[static_cast<std::size_t>(id - 1)][static_cast<std::size_t>(k)])
          << id << k;
  }
  EXPECT_EQ(value(3, 0, 4), 1);
  const std::vector<double> full = {1, 0, 2, 5, 3, 6}, of_sparse = {0, 9, 0, 0, 7, 0, 0, 0, 0, 0, 0, 8};
  for (std::size_t k = 0; k < full.size(); ++k) EXPECT_EQ(value(1, 1, static_cast<int>(k)), full[k]);
  for (std::size_t k = 0; k < of_sparse.size(); ++k) EXPECT_EQ(value(2, 1, static_cast<int>(k)), of_sparse[k]);
  EXPECT_EQ(value(2, 2, 0), 219);
  EXPECT_EQ(value(2, 2, 1), 127);
  EXPECT_EQ(value(2, 2, 2), 438);
  EXPECT_EQ(value(1, 2, 1), 210);
  EXPECT_EQ(value(1, 3, 0), 1);
  EXPECT_EQ(value(2, 4, 0), 1);
  EXPECT_EQ(value(3, 1, -1), 1);
}

TEST_F(LoadRoutines, partial_derivatives_of_a_gse_that_are_not_there_are_named) {
  const std::string gse =
      "VARIABLE/1, FUNCTION=VX(30)\nARRAY/1, X\nARRAY/2, U, VARIABLES=1\nARRAY/3, Y\n"
      "GSE/1, NO=1, NS=1, X=1, U=2, Y=3, FUNCTION=USER(1)\n";
  const RunResult r = with(lump + gse);
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("GSE/1"), HasSubstr("gives no derivatives and has no gsexx, gsexu, gseyx, gseyu "
                                                         "beside it")));
}

}  // namespace
}  // namespace dynalin::cases::load_routine_test
