// Work grows with the text: what was quadratic once. Limits are seconds of this process on one core, many times what is
// needed and a small part of what a search through everything takes.
#include <gmock/gmock.h>

#include <ctime>
#include <numbers>

#include "cases/run.h"
#include "places/sanitizers.h"

namespace dynalin::cases::growth_test {
namespace {

using ::testing::HasSubstr;

class Growth : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    begin_ = std::clock();
  }
  // A sanitizer takes several times as long.
  static constexpr double most_seconds = sanitized ? 60 : 10;
  double seconds() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }
  // A part that slides along z, with a marker K at each of `count` heights.
  static std::string slider(int count, const std::string& law, const std::string& more = "") {
    std::string text =
        "many\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1, QP=0,0,-1\n"
        "PART/2, MASS=2, CM=3, IP=1,1,1\nMARKER/3, PART=2\nJOINT/1, TRANSLATIONAL, I=3, J=1\n";
    for (int k = 0; k < count; ++k) text += "MARKER/" + std::to_string(1000 + k) + ", PART=2\n";
    return text + more + "SFORCE/1, TRANSLATIONAL, I=3, J=1, FUNCTION=" + law + "\nEND\n";
  }
  std::clock_t begin_ = 0;
};

// Each atom is another one; all springs in parallel make one of stiffness 8.
TEST_F(Growth, a_sum_of_very_many_atoms_is_read_and_linearized_quickly) {
  constexpr int atoms = 100'000;
  std::string law = "-8.0E-5*(0";
  for (int k = 0; k < atoms; ++k) law += (k % 8 ? "+DZ(" : "\n, +DZ(") + std::to_string(1000 + k) + ",1)";
  const RunResult r = run(slider(atoms, law + ")+8"), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  // ω² = 8/2; summing 1e5 terms loses at most 1e5 roundings.
  expect_eigenvalues(r.eigenvalues(0), {{0, 2 / (2 * std::numbers::pi)}}, 1e-10);
  EXPECT_LT(seconds(), most_seconds);
}

TEST_F(Growth, very_many_references_to_nothing_are_reported_quickly) {
  constexpr int count = 40'000;
  std::string springs;
  for (int k = 0; k < count; ++k) {
    springs += "SPRINGDAMPER/" + std::to_string(k + 1) + ", TRANSLATIONAL, I=" + std::to_string(5'000'000 + k) +
               ", J=" + std::to_string(1000 + k) + ", K=1\n";
  }
  const RunResult r = run(slider(count, "0", springs), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr(std::to_string(count - 49) + " more errors of the kind [unknown-marker]"));
  EXPECT_LT(r.err.size(), 50'000u) << "only the first are printed";
  EXPECT_LT(seconds(), most_seconds);
}

TEST_F(Growth, a_long_chain_of_markers_in_frames_of_others_is_placed_quickly) {
  constexpr int count = 40'000;
  std::string chain;
  for (int k = 0; k < count; ++k) {
    chain += "MARKER/" + std::to_string(1'000'000 + k) +
             ", PART=2, QP=0,0,1, RM=" + (k + 1 < count ? std::to_string(1'000'001 + k) : "3") + "\n";
  }
  // The first marker is `count` above the last: the force law reads its height over MARKER/1.
  const std::string height = std::to_string(count + 1);
  const RunResult r = run(slider(0, "-8*(DZ(1000000,1)-" + height + ")", chain), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  expect_eigenvalues(r.eigenvalues(0), {{0, 2 / (2 * std::numbers::pi)}});
  EXPECT_LT(seconds(), most_seconds);
}

// Values follow the coordinates where a saddle is looked for, however many there are.
TEST_F(Growth, statics_of_a_force_that_sums_very_many_values_are_quick) {
  constexpr int count = 8000;
  std::string law = "4", values;
  for (int k = 1; k <= count; ++k) {
    values += "VARIABLE/" + std::to_string(k) + ", FUNCTION=-1.0E-3*DZ(3,1)\n";
    law += (k % 8 ? "+VARVAL(" : "\n, +VARVAL(") + std::to_string(k) + ")";
  }
  const RunResult r = run(slider(0, law, values), "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  expect_eigenvalues(r.eigenvalues(1), {{0, std::sqrt(1e-3 * count / 2) / (2 * std::numbers::pi)}}, 1e-10);
  EXPECT_LT(seconds(), most_seconds);
}

// Each reads the one before, and the force the last.
TEST_F(Growth, a_long_chain_of_values_is_followed_quickly) {
  constexpr int count = 50'000;
  std::string values = "VARIABLE/1, FUNCTION=DZ(3,1)-1\n";
  for (int k = 2; k <= count; ++k)
    values += "VARIABLE/" + std::to_string(k) + ", FUNCTION=VARVAL(" + std::to_string(k - 1) + ")\n";
  const RunResult r = run(slider(0, "-8*VARVAL(" + std::to_string(count) + ")", values), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  expect_eigenvalues(r.eigenvalues(0), {{0, 2 / (2 * std::numbers::pi)}}, 1e-10);
  EXPECT_LT(seconds(), most_seconds);
}

// The stability that statics judge in passing has states of controllers as well.
TEST_F(Growth, statics_beside_very_many_differential_states_are_quick) {
  constexpr int count = 4000;
  std::string states;
  for (int k = 1; k <= count; ++k) {
    const std::string id = std::to_string(k);
    states += "DIFF/" + id + ", IC=1, FUNCTION=-DIF(" + id + ")\n";
  }
  const RunResult r = run(slider(0, "8*(1-DZ(3,1))", states), "SIMULATE/STATICS\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  EXPECT_LT(seconds(), most_seconds);
}

// Each list Y is another curve, and all are the line y = x.
TEST_F(Growth, a_statement_of_very_many_repeated_arguments_is_read_quickly) {
  constexpr int curves = 100'000;
  std::string family = "SPLINE/1, X=-2,-1,0,1,2";
  for (int k = 0; k < curves; ++k) family += (k % 4 ? ", Y=" : "\n, Y=") + std::to_string(k) + ",-2,-1,0,1,2";
  const RunResult r = run(slider(0, "-8*(AKISPL(DZ(3,1),0.5,1)-1)", family + "\n"), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  expect_eigenvalues(r.eigenvalues(0), {{0, 2 / (2 * std::numbers::pi)}});
  EXPECT_LT(seconds(), most_seconds);
}

// What is out of the model is told once for all edits that made a model together, and after others anew.
TEST_F(Growth, very_many_edits_take_as_long_as_what_they_change) {
  constexpr int count = 8000;
  std::string springs, commands;
  for (int k = 1; k <= count; ++k) {
    const std::string id = std::to_string(k);
    springs += "SPRINGDAMPER/" + id + ", TRANSLATIONAL, I=3, J=1, K=1, LENGTH=1\n";
    commands += "DEACTIVATE/SPRINGDAMPER, " + (k % 2 ? "ID=" + id : "RANGE=" + id + "," + id) + "\n";
  }
  const RunResult r = run(slider(0, "-8*(DZ(3,1)-1)", springs),
                          commands + "LINEAR/EIGENSOL\nACTIVATE/SPRINGDAMPER, RANGE=7,14\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  expect_eigenvalues(r.eigenvalues(count), {{0, 2 / (2 * std::numbers::pi)}});
  expect_eigenvalues(r.eigenvalues(count + 2), {{0, std::sqrt(8.0) / (2 * std::numbers::pi)}});
  for (const char* line : {"   Deactivated SPRINGDAMPER/1,", "   Deactivated SPRINGDAMPER/8000,",
                           "   Activated SPRINGDAMPER/7.", "   Activated SPRINGDAMPER/14."}) {
    const std::size_t at = r.message.find(line);
    ASSERT_NE(at, std::string::npos) << line;
    EXPECT_EQ(r.message.find(line, at + 1), std::string::npos) << line;
  }
  EXPECT_LT(seconds(), most_seconds);
}

// Body k is held by 4 k in each of its coordinates, and nothing ties it to the others.
TEST_F(Growth, a_force_on_very_many_markers_costs_what_its_matrix_holds) {
  constexpr int count = 500;
  std::string text = "many\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\n", markers, places, values;
  for (int k = 1; k <= count; ++k) {
    const std::string marker = std::to_string(1000 + k), part = std::to_string(k + 1);
    text += "PART/" + part + ", MASS=1, IP=1,1,1, CM=" + marker + "\nMARKER/" + marker + ", PART=" + part + "\n";
    markers += (k > 1 ? "\n, " : "") + marker;
    for (int c = 0; c < 6; ++c) {
      const std::string comma = k == 1 && c == 0 ? "" : c == 0 ? "\n, " : ", ";
      places += comma + std::to_string(6 * (k - 1) + c + 1), values += comma + std::to_string(4 * k);
    }
  }
  const std::string size = std::to_string(6 * count);
  text += "MATRIX/1, SPARSE, ROWS=" + size + ", COLUMNS=" + size + ", I=" + places + "\n, J=" + places +
          "\n, VALUES=" + values + "\nNFORCE/1, J=1, KMATRIX=1, IMARKERS=" + markers + "\nEND\n";
  const RunResult r = run(text, "SIMULATE/STATICS\nLINEAR/EIGENSOL, NMODES=6\n");
  ASSERT_EQ(r.status, 0) << r.err.substr(0, 1000);
  expect_eigenvalues(r.eigenvalues(1), std::vector<std::complex<double>>(6, {0, 2 / (2 * std::numbers::pi)}));
  EXPECT_LT(seconds(), most_seconds);
}

TEST_F(Growth, near_ids_are_named_as_ever) {
  const std::string markers = "MARKER/112, PART=2\nMARKER/1211, PART=2\nMARKER/21, PART=2\nMARKER/5121, PART=2\n";
  const RunResult r =
      run(slider(0, "0", markers + "SPRINGDAMPER/1, TRANSLATIONAL, I=121, J=1, K=1\n"), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.err, HasSubstr("hint: MARKER/1211, MARKER/21 and MARKER/5121 exist"));
}

TEST_F(Growth, markers_that_refer_to_a_circle_or_to_a_faulty_marker_are_reported_once) {
  const RunResult r = run(slider(0, "0",
                                 "MARKER/5, PART=2, RM=6\nMARKER/6, PART=2, RM=7\nMARKER/7, PART=2, RM=6\n"
                                 "MARKER/8, PART=2, RM=9\nMARKER/9, PART=2, RM=1\n"),
                          "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.err, HasSubstr("MARKER/6 refers to itself through RM"));
  EXPECT_THAT(r.err, HasSubstr("MARKER/7 refers to itself through RM"));
  EXPECT_THAT(r.err, HasSubstr("RM of MARKER/9 is on another body"));
  EXPECT_THAT(r.err, ::testing::Not(HasSubstr("MARKER/5 refers")));
  EXPECT_THAT(r.err, ::testing::Not(HasSubstr("RM of MARKER/8")));
}

}  // namespace
}  // namespace dynalin::cases::growth_test
