// GSE: its compiled routines in all forms against LSE, TFSISO and DIFF; samples against their recursion; statics; and
// what goes wrong.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iterator>
#include <optional>

#include "places/sanitizers.h"
#include "routine/routine_context.h"
#include "routines/with_libraries.h"

namespace dynalin::cases::state_equations_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A slider on a spring. VARIABLEs 1 and 2 are what the controller sees, 9 is an input of the plant; outputs of the
// controller in ARRAY/3 push the slider, VARIABLE/8 is an output of the plant.
const std::string slider = R"(slider
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, REULER=90D,90D,0D
PART/2, MASS=2, CM=20, IP=1,2,3, VX=0.4
MARKER/20, PART=2, QP=0.1,0,0
MARKER/21, PART=2, REULER=90D,90D,0D
JOINT/1, TRANSLATIONAL, I=21, J=2
)";
const std::string plant = slider + R"(VARIABLE/1, FUNCTION=DX(20,1,1)-0.3
VARIABLE/2, FUNCTION=VX(20,1,1)+0.5*VARVAL(9)
VARIABLE/9, FUNCTION=0
PINPUT/1, VARIABLES=9
POUTPUT/1, VARIABLES=8
ARRAY/4, IC, NUMBERS=0.1,-0.2
REQUEST/1, F2=DX(20,1)\F3=VARVAL(7)\F4=VARVAL(8)
)";
const std::string pushed =
    "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)+VARVAL(7)-2*VARVAL(6)\n";
const std::string arrays = "ARRAY/1, X\nARRAY/2, U, VARIABLES=1,2\nARRAY/3, Y\n";
const std::string read_arrays =
    "VARIABLE/7, FUNCTION=ARYVAL(3,1)\nVARIABLE/6, FUNCTION=ARYVAL(3,2)\nVARIABLE/8, "
    "FUNCTION=ARYVAL(3,2)+ARYVAL(1,1)\n";
// A, B, C, D row by row.
const std::string constants = "-3,1,-4,-2.5,1,0.3,-0.5,2,2,-1,0.7,1.2,0,0.4,-0.6,0.1";
const std::string lse = R"(MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=-3,1,-4,-2.5
MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=1,0.3,-0.5,2
MATRIX/3, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=2,-1,0.7,1.2
MATRIX/4, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=0,0.4,-0.6,0.1
LSE/1, X=1, U=2, Y=3, A=1, B=2, C=3, D=4, IC=4
)";
std::string gse(const std::string& routines = "", const std::string& par = constants) {
  return "GSE/1, NS=2, NO=2, X=1, U=2, Y=3, IC=4, FUNCTION=USER(" + par + ")" + routines + "\n";
}

class StateEquations : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"},
                 bool differences = false) const {
    return WithLibraries::with(dataset, {C_STATE_EQUATIONS, CPP_STATE_EQUATIONS}, differences, commands);
  }
  // Eigenvalues; A, B, C, D; the matrices of MKB.
  std::vector<std::string> linear_commands() const {
    return {"LINEAR/EIGENSOL", "LINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=abcd",
            "LINEAR/MKB, PINPUT=1, POUTPUT=1, FILE=mkb"};
  }
  static void expect_same_matrices(const RunResult& a, const RunResult& b, double tolerance) {
    expect_same(a, b, tolerance);
    const auto compare = [&](std::size_t result, const std::string& name) {
      const auto x = a.matrix(result, name), y = b.matrix(result, name);
      ASSERT_EQ(x.size(), y.size()) << name;
      for (std::size_t r = 0; r < x.size(); ++r) {
        ASSERT_EQ(x[r].size(), y[r].size()) << name;
        for (std::size_t c = 0; c < x[r].size(); ++c)
          EXPECT_NEAR(x[r][c], y[r][c], tolerance * std::max(1.0, std::abs(y[r][c]))) << name << r << ' ' << c;
      }
    };
    for (const std::string name : {"A", "B", "C", "D"}) compare(1, name);
    for (const std::string name : {"M", "KB", "P", "C", "D"}) compare(2, name);
  }
  static void expect_same_course(const RunResult& a, const RunResult& b, double tolerance, std::size_t result = 2) {
    const auto x = requested(a, result), y = requested(b, result);
    ASSERT_EQ(x.size(), y.size());
    ASSERT_EQ(x.size(), 3u);
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], tolerance) << k;
  }
  const std::vector<std::string> course = {"INTEGRATOR/GSTIFF, ERROR=1E-7", "SIMULATE/TRANSIENT, END=0.8, STEPS=8",
                                           "SIMULATE/INITIAL"};
};

TEST_F(StateEquations, of_linear_routines_are_the_lse_in_every_matrix_and_every_form) {
  const std::string rest = plant + pushed + arrays + read_arrays;
  const RunResult reference = with(rest + lse, linear_commands());
  const RunResult moved = with(rest + lse, course);
  for (const std::string routines :
       {"", ", INTERFACE=state_equations::Stated_deriv,state_equations::,state_equations::Stated_output",
        ", INTERFACE=::implicit_deriv, IMPLICIT", ", ROUTINE=state_equations::gsesub",
        ", "
        "ROUTINE=state_equations::Statedsub,state_equations::Statedxx,state_equations::Statedxu,state_equations::"
        "Statedyx,state_equations::Statedyu"}) {
    const std::string dataset = rest + gse(routines);
    const RunResult called = with(dataset, linear_commands());
    SCOPED_TRACE(routines);
    expect_same_matrices(called, reference, 1e-12);
    EXPECT_THAT(called.err, Not(HasSubstr("differenced-routine")));
    expect_same_course(with(dataset, course), moved, 2e-8);
  }
  const RunResult called = with(rest + gse(), linear_commands());
  std::size_t of_gse = 0;
  for (const auto& s : called.result(1).at("states")) {
    if (s.at("type") != 4) continue;
    ++of_gse;
    EXPECT_EQ(s.at("element"), 1);
    EXPECT_EQ(s.at("coordinate"), of_gse);
  }
  EXPECT_EQ(of_gse, 2u);
}

#ifdef FORTRAN_STATE_EQUATIONS
TEST_F(StateEquations, in_fortran_are_the_same) {
  const std::string rest = plant + pushed + arrays + read_arrays;
  const RunResult reference = with(rest + lse, linear_commands());
  for (const std::string routines : {"", ", ROUTINE=::gsesub"}) {
    SCOPED_TRACE(routines);
    expect_same_matrices(WithLibraries::with(rest + gse(routines), {FORTRAN_STATE_EQUATIONS}, false, linear_commands()),
                         reference, 1e-12);
  }
}
#endif

TEST_F(StateEquations, of_a_transfer_function_are_the_tfsiso_and_the_diffs) {
  // (2 + 3 s + 0.5 s²) / (4 + 1.2 s + s²) in observer form.
  const std::string rest = plant +
                           "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)-7*VARVAL(7)\n"
                           "ARRAY/1, X\nARRAY/2, U, VARIABLES=2\nARRAY/3, Y\n"
                           "VARIABLE/8, FUNCTION=VARVAL(7)\n";
  const std::string read = "VARIABLE/7, FUNCTION=ARYVAL(3,1)\n";
  const std::string tfsiso = read + "TFSISO/1, X=1, U=2, Y=3, NUMERATOR=2,3,0.5, DENOMINATOR=4,1.2,1, IC=4\n";
  const std::string called =
      read + "GSE/1, NS=2, NO=1, X=1, U=2, Y=3, IC=4, FUNCTION=USER(-1.2,1,-4,0,2.4,0,1,0,0.5)\n";
  const std::string diffs =
      "DIFF/1, IC=0.1, FUNCTION=-1.2*DIF(1)+DIF(2)+2.4*VARVAL(2)\nDIFF/2, IC=-0.2, FUNCTION=-4*DIF(1)\n"
      "VARIABLE/7, FUNCTION=DIF(1)+0.5*VARVAL(2)\n";
  const RunResult reference = with(rest + called, linear_commands());
  expect_same_matrices(with(rest + tfsiso, linear_commands()), reference, 1e-12);
  const RunResult moved = with(rest + called, course);
  expect_same_course(with(rest + tfsiso, course), moved, 2e-8);
  const std::string without_arrays = rest.substr(0, rest.find("ARRAY/1")) + "VARIABLE/8, FUNCTION=VARVAL(7)\n";
  expect_same_matrices(with(without_arrays + diffs, linear_commands()), reference, 1e-12);
  expect_same_course(with(without_arrays + diffs, course), moved, 2e-8);
}

// The formula is differentiated where the states are, and so is its output where DIF1 asks for its rate.
TEST_F(StateEquations, that_are_not_linear_are_their_diffs_where_they_move) {
  const std::string rest = plant +
                           "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, "
                           "FUNCTION=-50*DX(20,1,1)+20*VARVAL(7)-0.3*DIF1(9)\n"
                           "DIFF/9, IMPLICIT, FUNCTION=DIF(9)-VARVAL(7)\nVARIABLE/8, FUNCTION=VARVAL(7)\n";
  const std::string called = arrays.substr(0, arrays.find("ARRAY/2")) +
                             "ARRAY/2, U, VARIABLES=2\nARRAY/3, Y\nVARIABLE/7, FUNCTION=ARYVAL(3,1)\n"
                             "GSE/1, NS=2, NO=1, X=1, U=2, Y=3, IC=4, FUNCTION=USER(0.7), INTERFACE=";
  const std::string read = "VARIABLE/7, FUNCTION=DIF(1)*DIF(2)+EXP(-VARVAL(2)**2)\n";
  std::vector<std::string> commands = linear_commands();
  commands.insert(commands.end(), {"INTEGRATOR/GSTIFF, ERROR=1E-7", "SIMULATE/TRANSIENT, END=0.4, STEPS=4",
                                   "LINEAR/EIGENSOL", "SIMULATE/INITIAL"});
  const auto compare = [&](const std::string& routines, const std::string& diffs) {
    const RunResult a = with(rest + called + routines, commands), b = with(rest + read + diffs, commands);
    SCOPED_TRACE(routines);
    expect_same_matrices(a, b, 1e-11);
    expect_same(a, b, 1e-7, 5);
    expect_same_course(a, b, 1e-7, 6);
  };
  compare("state_formulas::oscillator_deriv,state_formulas::,state_formulas::product_output\n",
          "DIFF/1, IC=0.1, FUNCTION=DIF(2)\n"
          "DIFF/2, IC=-0.2, FUNCTION=-SIN(DIF(1))-0.7*(DIF(1)**2-1)*DIF(2)+VARVAL(2)\n");
  compare("state_formulas::balance_deriv,state_formulas::,state_formulas::product_output, IMPLICIT\n",
          "DIFF/1, IC=0.1, FUNCTION=DIF(2)/(1+DIF(1)**2)\n"
          "DIFF/2, IC=-0.2, FUNCTION=-DIF(2)**2/(1+DIF(1)**2)-SIN(DIF(1))+VARVAL(2)\n");
}

TEST_F(StateEquations, without_derivatives_are_refused_in_linear_models_unless_differences_are_asked_for) {
  const std::string rest = plant + pushed + arrays + read_arrays;
  const std::string bare = rest + gse(", INTERFACE=::bare_deriv");
  const RunResult refused = with(bare);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("GSE/1: the routine bare_deriv"), HasSubstr("--difference-user-routines"),
                                 HasSubstr("[differenced-routine]")));
  expect_same(with(bare, {"LINEAR/EIGENSOL"}, true), with(rest + lse), 1e-9);
  expect_same_course(with(bare, course), with(rest + lse, course), 2e-8);
}

// Words of a deck: what stands between commas and blanks.
std::vector<std::string> words_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}
std::optional<double> number_in(std::string word) {
  std::replace(word.begin(), word.end(), 'D', 'E');
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' ? std::optional(value) : std::nullopt;
}

TEST_F(StateEquations, are_exported_as_the_lse_is) {
  const std::string rest = plant + pushed + arrays + read_arrays;
  for (const std::string type : {"CLOSEDBOX", "OPENBOX"}) {
    const auto decks = [&](const std::string& controller) {
      const RunResult r = with(rest + controller, {"LINEAR/EXPORT, TYPE=" + type + ", FILE=deck"});
      EXPECT_EQ(r.status, 0) << r.err;
      std::vector<std::string> words;
      if (r.status != 0) return words;
      for (const auto& file : r.result(0).at("files")) {
        const auto more = words_of(read_file(file.get<std::string>()));
        words.insert(words.end(), more.begin(), more.end());
      }
      return words;
    };
    const auto of_gse = decks(gse()), of_lse = decks(lse);
    ASSERT_EQ(of_gse.size(), of_lse.size()) << type;
    std::size_t numbers = 0;
    for (std::size_t k = 0; k < of_gse.size(); ++k) {
      const auto a = number_in(of_gse[k]), b = number_in(of_lse[k]);
      if (a && b) {
        EXPECT_NEAR(*a, *b, 1e-12 * std::max(1.0, std::abs(*b))) << type << k;
        ++numbers;
      }
    }
    EXPECT_GT(numbers, 30u) << type;
  }
}

// Between samples the force is constant, so that motion and samples have a recursion in closed form.
TEST_F(StateEquations, that_are_sampled_follow_their_recursion) {
  constexpr double mass = 2, period = 0.1, offset = 0.05, k1 = -30, k2 = -4, sum = 0.5;
  const std::string model = slider +
                            "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=ARYVAL(3,1)\n"
                            "VARIABLE/1, FUNCTION=DX(20,1,1)\nARRAY/2, U, VARIABLES=1\nARRAY/3, Y\nARRAY/5, X\n"
                            "ARRAY/6, IC, NUMBERS=0.2,-0.3\n"
                            "REQUEST/1, F2=DX(20,1)\\F3=VX(20,1)\\F4=ARYVAL(5,1)\\F6=ARYVAL(5,2)\\F7=ARYVAL(3,1)\n" +
                            fmt::format(
                                "GSE/1, NO=1, Y=3, U=2, ND=2, XD=5, ICD=6, SAMPLE_PERIOD={}, SAMPLE_OFFSET={}, "
                                "FUNCTION=USER({},{},{}), "
                                "INTERFACE=::,::held_update,::held_output\n",
                                period, offset, k1, k2, sum);
  double x = 0.1, v = 0.4, d1 = 0.2, d2 = -0.3, t = 0;
  const auto move = [&](double until) {
    const double a = (k1 * d1 + k2 * d2) / mass, h = until - t;
    x += v * h + a * h * h / 2, v += a * h, t = until;
  };
  for (int n = 0; n < 10; ++n) {
    move(offset + n * period);
    d1 = x, d2 += sum * x;
  }
  move(1.0);
  // One run, and runs that end between samples and at one of them.
  const std::vector<std::vector<std::string>> ways = {
      {"INTEGRATOR/GSTIFF, ERROR=1E-7", "SIMULATE/TRANSIENT, END=1, STEPS=13", "SIMULATE/INITIAL"},
      {"INTEGRATOR/GSTIFF, ERROR=1E-7", "SIMULATE/TRANSIENT, END=0.32, STEPS=2",
       "SIMULATE/TRANSIENT, END=0.55, STEPS=4", "SIMULATE/TRANSIENT, END=1, STEPS=2", "SIMULATE/INITIAL"},
      {"INTEGRATOR/GSTIFF, ERROR=1E-7", "SIMULATE/TRANSIENT, END=0.32, STEPS=2", "SAVE/STATES, FILE=there.save",
       "SIMULATE/TRANSIENT, END=0.9, STEPS=2", "RELOAD/STATES, FILE=there.save", "SIMULATE/TRANSIENT, END=1, STEPS=2",
       "SIMULATE/INITIAL"}};
  for (const auto& commands : ways) {
    const RunResult r = with(model, commands);
    const auto found = requested(r, commands.size() - 1);
    ASSERT_EQ(found.size(), 5u) << r.err;
    EXPECT_NEAR(found[0], x, 1e-9);
    EXPECT_NEAR(found[1], v, 1e-9);
    EXPECT_NEAR(found[2], d1, 1e-9);
    EXPECT_NEAR(found[3], d2, 1e-9);
    EXPECT_NEAR(found[4], k1 * d1 + k2 * d2, 1e-8);
  }
  // A linear model takes them as constants: what is left is a free mass.
  const RunResult linear = with(model, {"SIMULATE/TRANSIENT, END=1, STEPS=13", "LINEAR/EIGENSOL"});
  ASSERT_EQ(linear.status, 0) << linear.err;
  ASSERT_EQ(linear.eigenvalues(1).size(), 2u);
  for (const auto& value : linear.eigenvalues(1)) EXPECT_EQ(std::abs(value), 0);
}

TEST_F(StateEquations, are_sampled_when_their_routine_says_so_and_never_warn_of_dense_events) {
  const std::string model =
      slider +
      "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)\n"
      "ARRAY/3, Y\nARRAY/5, X, SIZE=2\nREQUEST/1, F2=ARYVAL(5,1)\\F3=ARYVAL(5,2)\\F4=ARYVAL(3,2)\n"
      "GSE/1, NO=2, Y=3, ND=2, XD=5, "
      "INTERFACE=::,clock_update,sampled_output, FUNCTION=";
  // 0.1, and 1.5 times as late with each: 0.02 is skipped, as the offset of 0.1 begins.
  const std::string grows = "USER(0,0.5,0,5), SAMPLE_OFFSET=0.1\n";
  const auto last = requested(with(model + grows, {"SIMULATE/TRANSIENT, END=1, STEPS=10", "SIMULATE/INITIAL"}), 1);
  ASSERT_EQ(last.size(), 3u);
  EXPECT_NEAR(last[0], 0.1 * std::pow(1.5, 5), 1e-12);
  EXPECT_EQ(last[1], 6);
  EXPECT_EQ(last[2], 6);
  const RunResult dense = with(model + "USER(0,0,0,5), SAMPLE_PERIOD=0.001\n",
                               {"SIMULATE/TRANSIENT, END=0.4995, STEPS=10", "SIMULATE/INITIAL"});
  const auto counted = requested(dense, 1);
  ASSERT_EQ(counted.size(), 3u);
  EXPECT_EQ(counted[1], 500);
  EXPECT_NEAR(counted[0], 0.499, 1e-15);
  EXPECT_THAT(dense.err, Not(HasSubstr("dense-events")));
}

// Constants have no derivatives that anybody asks for.
TEST_F(StateEquations, need_no_derivatives_by_discrete_states) {
  for (const char* derivatives : {"5", "0"}) {
    const RunResult r = with(slider +
                                 "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)+ARYVAL(3,1)\n"
                                 "ARRAY/3, Y\nARRAY/5, X, SIZE=2\nGSE/1, NO=2, Y=3, ND=2, XD=5, SAMPLE_PERIOD=0.1, "
                                 "INTERFACE=::,clock_update,sampled_output, FUNCTION=USER(0,0,0," +
                                 derivatives + ")\n",
                             {"LINEAR/EIGENSOL"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, Not(HasSubstr("gives no derivatives"))) << derivatives;
    ASSERT_EQ(r.eigenvalues(0).size(), 2u);
    EXPECT_NEAR(std::abs(r.eigenvalues(0)[0]) * 2 * M_PI, 5, 1e-12);
  }
}

// What is read at the same instant as it is sampled is what it was before, however the instants are rounded.
TEST_F(StateEquations, of_two_elements_are_sampled_at_once) {
  const auto controller = [](int id, int u, int xd, const std::string& instants) {
    return fmt::format(
        "ARRAY/{2}, X\nARRAY/{1}3, Y\nGSE/{0}, NO=1, Y={1}3, U={1}, ND=2, XD={2}, {3}, FUNCTION=USER(1,0,0), "
        "INTERFACE=::,held_update,held_output\n",
        id, u, xd, instants);
  };
  const std::string model =
      slider +
      "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)\nVARIABLE/1, FUNCTION=TIME\n"
      "VARIABLE/2, FUNCTION=ARYVAL(5,1)\nARRAY/1, U, VARIABLES=1\nARRAY/2, U, VARIABLES=2\n"
      "REQUEST/1, F2=ARYVAL(5,1)\\F3=ARYVAL(6,1)\n";
  // Also where one of them has had samples already and the other none.
  struct Samplers {
    std::string first, second;
    double of_first, of_second;
  };
  const std::string every = "SAMPLE_PERIOD=0.1", late = "SAMPLE_PERIOD=0.1, SAMPLE_OFFSET=0.8",
                    binary = "SAMPLE_PERIOD=0.25", late_binary = "SAMPLE_PERIOD=0.25, SAMPLE_OFFSET=0.75",
                    offset = "SAMPLE_PERIOD=0.1, SAMPLE_OFFSET=0.1", thirds = "SAMPLE_PERIOD=0.3/3, SAMPLE_OFFSET=0.1";
  for (const auto& [first, second, of_first, of_second] :
       {Samplers{offset, thirds, 0.8, 0.7}, Samplers{thirds, offset, 0.8, 0.7}, Samplers{every, late, 0.8, 0.7},
        Samplers{late, every, 0.8, 0}, Samplers{binary, late_binary, 0.75, 0.5},
        Samplers{late_binary, binary, 0.75, 0}}) {
    const auto found = requested(with(model + controller(1, 1, 5, first) + controller(2, 2, 6, second),
                                      {"SIMULATE/TRANSIENT, END=0.85, STEPS=10", "SIMULATE/INITIAL"}),
                                 1);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], of_first, 1e-11) << first << "; " << second;
    EXPECT_NEAR(found[1], of_second, 1e-11) << first << "; " << second;
  }
}

// An output at the instant of a sample shows what was before it, one where a run begins what is then.
TEST_F(StateEquations, show_at_the_instant_of_a_sample_what_was_before) {
  const std::string model = slider +
                            "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)\n"
                            "ARRAY/3, Y\nARRAY/5, X\nREQUEST/1, F2=ARYVAL(5,1)\\F3=ARYVAL(5,2)\n"
                            "GSE/1, NO=2, Y=3, ND=2, XD=5, "
                            "INTERFACE=::,clock_update,sampled_output, "
                            "FUNCTION=USER(0,0,0,5), SAMPLE_PERIOD=0.1\n";
  const RunResult r = with(model, {"SIMULATE/TRANSIENT, END=0.7, STEPS=7", "SIMULATE/INITIAL",
                                   "SIMULATE/TRANSIENT, END=0.75, STEPS=1", "SIMULATE/INITIAL"});
  const auto at = requested(r, 1), behind = requested(r, 3);
  ASSERT_EQ(at.size(), 2u);
  ASSERT_EQ(behind.size(), 2u);
  EXPECT_EQ(at[1], 7);
  EXPECT_EQ(behind[1], 8);
  EXPECT_NEAR(behind[0], 0.7, 1e-12);
}

// A command that states instants begins them anew, from what is known of the discrete states; no other does.
TEST_F(StateEquations, are_sampled_when_a_command_says_so) {
  const std::string model = slider +
                            "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)\n"
                            "ARRAY/3, Y\nARRAY/5, X\nREQUEST/1, F2=ARYVAL(5,1)\\F3=ARYVAL(5,2)\n"
                            "GSE/1, NO=2, Y=3, ND=2, XD=5, INTERFACE=::,clock_update,sampled_output, "
                            "FUNCTION=USER(0,0,0,5), ";
  struct Case {
    std::string instants, command;
    double last, count;
  };
  for (const auto& [instants, command, last, count] : {
           Case{"SAMPLE_PERIOD=1, SAMPLE_OFFSET=0.7", "GSE/1, SAMPLE_OFFSET=0.4", 0.4, 1},
           // Not before the offset, whatever there was.
           Case{"SAMPLE_PERIOD=0.1, SAMPLE_OFFSET=0.1", "GSE/1, SAMPLE_OFFSET=0.65", 0.85, 3 + 3},
           // Where the simulation begins, and then counted from the offset.
           Case{"SAMPLE_PERIOD=100", "GSE/1, SAMPLE_PERIOD=0.1", 0.8, 1 + 6},
           Case{"SAMPLE_PERIOD=0.2, SAMPLE_OFFSET=0.1", "PART/2, MASS=3", 0.7, 4},
       }) {
    const auto found =
        requested(with(model + instants + "\n", {"SIMULATE/TRANSIENT, END=0.35, STEPS=1", command,
                                                 "SIMULATE/TRANSIENT, END=0.88, STEPS=1", "SIMULATE/INITIAL"}),
                  3);
    ASSERT_EQ(found.size(), 2u) << command;
    EXPECT_NEAR(found[0], last, 1e-11) << command;
    EXPECT_EQ(found[1], count) << command;
  }
}

TEST_F(StateEquations, rest_in_statics_unless_they_are_held) {
  const std::string rest = plant + pushed + arrays + read_arrays;
  const std::vector<std::string> statics = {"SIMULATE/STATIC", "SIMULATE/INITIAL"};
  const auto free = requested(with(rest + gse(), statics), 1), free_lse = requested(with(rest + lse, statics), 1);
  const auto held = requested(with(rest + gse(", STATIC_HOLD"), statics), 1);
  std::string held_lse = rest + lse;
  held_lse.insert(held_lse.size() - 1, ", STATIC_HOLD");
  const auto held_reference = requested(with(held_lse, statics), 1);
  ASSERT_EQ(free.size(), 3u);
  ASSERT_EQ(held.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(free[k], free_lse[k], 1e-10) << k;
    EXPECT_NEAR(held[k], held_reference[k], 1e-10) << k;
  }
  EXPECT_GT(std::abs(free[0] - held[0]), 1e-3);
  // A command may say the same.
  const auto commanded =
      requested(with(rest + gse(), {"GSE/1, STATIC_HOLD", "SIMULATE/STATIC", "SIMULATE/INITIAL"}), 2);
  ASSERT_EQ(commanded.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(commanded[k], held[k], 1e-12) << k;
  // Implicit equations are solved with x′ = 0.
  const auto implicit = requested(with(rest + gse(", INTERFACE=::implicit_deriv, IMPLICIT"), statics), 1);
  ASSERT_EQ(implicit.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(implicit[k], free[k], 1e-10) << k;
  // At work in statics alone: what comes afterwards pushes with what they found.
  const std::string only = rest + gse(", STATICS_ONLY");
  const auto after =
      requested(with(only, {"SIMULATE/STATIC", "SIMULATE/TRANSIENT, END=0.5, STEPS=5", "SIMULATE/INITIAL"}), 2);
  ASSERT_EQ(after.size(), 3u);
  constexpr double by_speed = 0.4 * 0.4;  // of an output by VX, which is not there in statics
  EXPECT_NEAR(after[1], free[1] - by_speed, 1e-9);
  // States that keep what statics found have no rates.
  const RunResult kept = with(only, {"SIMULATE/STATIC", "SIMULATE/INITIAL"});
  for (const auto& state : kept.result(1).at("operating_point").at("states"))
    EXPECT_EQ(state.at("rate").get<double>(), 0) << state;
  const auto at_once = requested(with(only, statics), 1);
  ASSERT_EQ(at_once.size(), 3u);
  EXPECT_NEAR(at_once[1], free[1] - by_speed, 1e-9);
  // So it is where the velocity comes from a MOTION.
  const auto driven = [&](const std::string& speed) {
    std::string model = only;
    model.replace(model.find("VX(20,1,1)"), 10, "VX(30,1,1)");
    model.replace(model.find(", VX=0.4"), 8, "");
    return requested(with(model +
                              "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nMARKER/31, REULER=90D,90D,0D\n"
                              "JOINT/3, TRANSLATIONAL, I=31, J=2\nMOTION/3, JOINT=3, FUNCTION=" +
                              speed + "*TIME\n",
                          statics),
                     1);
  };
  const auto fast = driven("0.3"), still = driven("0");
  ASSERT_EQ(fast.size(), 3u);
  ASSERT_EQ(still.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(fast[k], still[k], 1e-10) << k;
  const RunResult linear = with(only, {"SIMULATE/STATIC", "LINEAR/EIGENSOL"});
  ASSERT_EQ(linear.status, 0) << linear.err;
  const double hz = std::sqrt(50.0 / 2) / (2 * M_PI);
  ASSERT_EQ(linear.eigenvalues(1).size(), 2u);
  EXPECT_NEAR(std::abs(linear.eigenvalues(1)[0]), hz, 1e-10);
  // Nor is it sampled.
  const std::string clock =
      slider +
      "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=-50*DX(20,1,1)\n"
      "ARRAY/3, Y\nARRAY/5, X\nARRAY/6, IC, NUMBERS=7,8\nREQUEST/1, F2=ARYVAL(5,1)\\F3=ARYVAL(5,2)\n"
      "GSE/1, NO=2, Y=3, ND=2, XD=5, ICD=6, INTERFACE=::,clock_update,sampled_output, STATICS_ONLY, "
      "FUNCTION=USER(0,0,0,5), SAMPLE_PERIOD=0.1\n";
  const std::vector<double> initial = {7, 8};
  EXPECT_EQ(requested(with(clock, {"SIMULATE/TRANSIENT, END=0.5, STEPS=5", "SIMULATE/INITIAL"}), 1), initial);
}

TEST_F(StateEquations, that_have_no_value_name_their_element) {
  const std::string rest = plant + pushed + arrays + read_arrays;
  EXPECT_THAT(with(rest + gse(", INTERFACE=::lost_deriv")).err,
              AllOf(HasSubstr("GSE/1: the routine lost_deriv"), HasSubstr("no finite number")));
  const RunResult greedy = with(rest + gse(", INTERFACE=::greedy_deriv"));
  EXPECT_EQ(greedy.status, 1);
  EXPECT_THAT(greedy.err, AllOf(HasSubstr("[routine-failed]"), HasSubstr("asks for 3 numbers where its GSE has 2")));
  const std::string singular =
      gse(", INTERFACE=::implicit_deriv, IMPLICIT", "-3,1,-4,-2.5,1,0.3,-0.5,2,2,-1,0.7,1.2,0,0.4,-0.6,-0.1");
  const RunResult undetermined = with(rest + singular);
  EXPECT_EQ(undetermined.status, 2);
  EXPECT_THAT(undetermined.err, HasSubstr("the implicit equations of GSE/1 do not determine the rates"));
  const std::string sampled = slider +
                              "ARRAY/3, Y\nARRAY/5, X\nGSE/1, NO=1, Y=3, ND=1, XD=5, FUNCTION=USER(0,0,0,5), "
                              "INTERFACE=";
  const std::vector<std::string> move = {"SIMULATE/TRANSIENT, END=1, STEPS=5"};
  const RunResult lost = with(
      sampled + "state_equations::,state_equations::lost_update,state_equations::sampled_output, SAMPLE_PERIOD=0.1\n",
      move);
  EXPECT_EQ(lost.status, 2);
  EXPECT_THAT(lost.err, AllOf(HasSubstr("GSE/1: the routine lost_update"), HasSubstr("discrete state 1")));
  const RunResult stuck = with(
      sampled +
          "state_equations::,state_equations::clock_update,state_equations::sampled_output, SAMPLE_PERIOD=0.3-TIME\n",
      move);
  EXPECT_EQ(stuck.status, 2);
  EXPECT_THAT(stuck.err, AllOf(HasSubstr("GSE/1: the time between its samples is"), HasSubstr("must be positive")));
  // Nor is a sample after the one before if it is next to nothing later.
  for (const std::string period : {"1E-17", "1E-300", "(1E-17+0*TIME)"}) {
    const RunResult held = with(
        sampled + "state_equations::,state_equations::clock_update,state_equations::sampled_output, SAMPLE_PERIOD=" +
            period + ", SAMPLE_OFFSET=0.05\n",
        move);
    EXPECT_EQ(held.status, 2) << period;
    EXPECT_THAT(held.err, AllOf(HasSubstr("GSE/1: the time between its samples is 1e-"),
                                HasSubstr("must be more than 1e-12 of TIME")))
        << period;
  }
  // Time passes in no number of such samples.
  const RunResult crowded = with(
      sampled +
          "state_equations::,state_equations::clock_update,state_equations::sampled_output, SAMPLE_PERIOD=1E-300\n",
      move);
  EXPECT_EQ(crowded.status, 2);
  EXPECT_THAT(crowded.err, HasSubstr("must be more than 1e-12 of TIME"));
  const RunResult close =
      with(sampled +
               "state_equations::,state_equations::clock_update,state_equations::sampled_output, SAMPLE_PERIOD=1E-14\n",
           move);
  EXPECT_EQ(close.status, 2);
  EXPECT_THAT(close.err, HasSubstr("10000 events within a billionth of the run"));
}

TEST_F(StateEquations, that_do_not_fit_are_refused_at_their_place) {
  const auto said = [&](const std::string& statements,
                        const std::vector<std::string>& libraries = {C_STATE_EQUATIONS}) {
    const RunResult r = WithLibraries::with(slider +
                                                "VARIABLE/1, FUNCTION=1\nARRAY/1, X\nARRAY/2, U, VARIABLES=1\n"
                                                "ARRAY/3, Y\nARRAY/4, IC, NUMBERS=1,2,3\n" +
                                                statements + "\n",
                                            libraries, false, {"LINEAR/EIGENSOL"});
    EXPECT_EQ(r.status, 1) << statements << r.err;
    return r.err;
  };
  const std::string call = ", FUNCTION=USER(1,2,3,4,5,6,7,8,9)";
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, U=2" + call), HasSubstr("15:19: error: NS of GSE/1 needs X"));
  EXPECT_THAT(said("GSE/1, NO=1, NS=2, X=1, U=2" + call), HasSubstr("15:8: error: NO of GSE/1 needs Y"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, X=1, U=2" + call), HasSubstr("15:19: error: X of GSE/1 needs NS"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, XD=1, U=2" + call), HasSubstr("15:19: error: XD of GSE/1 needs ND"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, IC=4" + call),
              AllOf(HasSubstr("15:35: error: IC of GSE/1 must hold 2 numbers"), HasSubstr("[wrong-size]")));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=3, U=2" + call), HasSubstr("X of GSE/1 must be of type X"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=1" + call), HasSubstr("U of GSE/1 must be of type U"));
  EXPECT_THAT(said("ARRAY/5, X, SIZE=3\nGSE/1, NO=1, Y=3, NS=2, X=5, U=2" + call),
              HasSubstr("SIZE of ARRAY/5 is 3, GSE/1 needs 2"));
  for (const std::string missing : {"X=77, U=2", "X=1, U=77"}) {
    EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, " + missing + call),
                AllOf(HasSubstr("GSE/1 refers to ARRAY/77, which does not exist"), Not(HasSubstr("routine"))));
  }
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, FUNCTION=DX(20,1)"), HasSubstr("FUNCTION of GSE/1 is USER(…)"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3"), HasSubstr("GSE/1 needs FUNCTION"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=20000, X=1, U=2" + call), HasSubstr("[value-out-of-range]"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, INTERFACE=::nobody" + call),
              HasSubstr("15:45: error: GSE/1 calls ::nobody, and no library has it [missing-routine]"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, INTERFACE=::,::nobody,::" + call),
              HasSubstr("GSE/1 calls ::nobody, and no library has it [missing-routine]"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, ROUTINE=::gsesub,::gsexy" + call),
              HasSubstr("GSE/1 calls ::gsexy, and no library has it [missing-routine]"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, INTERFACE=::,::,::,::,::" + call),
              HasSubstr("INTERFACE of GSE/1 names 4 routines at most, not 5 [wrong-count]"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, INTERFACE=::, ROUTINE=::gsesub" + call),
              HasSubstr("GSE/1 names routines by INTERFACE or by ROUTINE, not both [excluded-arguments]"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, ND=1, XD=1, U=2, "
                   "INTERFACE=state_equations::,state_equations::nobody,state_equations::sampled_output" +
                   call),
              AllOf(HasSubstr("[missing-routine]"), HasSubstr("GSE/1 calls state_equations::nobody")));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, ND=1, XD=1, U=2, SAMPLE_PERIOD=0, "
                   "INTERFACE=state_equations::,state_equations::,state_equations::sampled_output" +
                   call),
              HasSubstr("SAMPLE_PERIOD of GSE/1 must be positive"));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2" + call, {}),
              AllOf(HasSubstr("[missing-routine]"), HasSubstr("GSE/1 calls compiled routines")));
  EXPECT_THAT(said("GSE/1, NO=1, Y=3, NS=2, X=1, U=2, FUNCTION=USER(1"), HasSubstr("[unbalanced-parenthesis]"));
}

TEST_F(StateEquations, that_crash_are_named_before_the_program_dies) {
  if (sanitized) GTEST_SKIP() << "the sanitizer takes the signal";
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        name_routine_of_crash();
        with(plant + pushed + arrays + read_arrays + gse(", INTERFACE=::crashing_deriv"));
      },
      ::testing::KilledBySignal(SIGSEGV), "the routine crashing_deriv of .*, called for GSE/1");
}

}  // namespace
}  // namespace dynalin::cases::state_equations_test
