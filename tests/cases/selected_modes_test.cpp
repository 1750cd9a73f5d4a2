// NMODES and BAND of LINEAR/EIGENSOL, through program and library, with and without the state matrix: values, vectors
// and tables are those of the full solution, and whatever is written says which modes these are.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include "cases/replay.h"
#include "cases/run.h"
#include "cases/study_of.h"
#include "library/inside.h"
#include "linear/reach.h"

namespace dynalin::cases::selected_modes_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Complex = std::complex<double>;

class SelectedModes : public Cases {
 protected:
  // With these options, and once more through the library, which has the same JSON.
  RunResult run_with(SessionOptions options, const std::string& dataset, const std::string& commands) const {
    RunResult r = run(dataset, commands, options);
    if (r.status == wrong_input) return r;
    options.file = (folder_ / "model.acf").string();
    options.json = (folder_ / "results.json").string();
    const std::string written = read_file(options.json);
    nlohmann::ordered_json program = nlohmann::ordered_json::parse(written), library = Replay(options).run();
    for (auto* json : {&program, &library}) json->erase("files");
    EXPECT_EQ(program, library) << nlohmann::json::diff(program, library).dump(1).substr(0, 2000);
    return r;
  }
  RunResult sparse(const std::string& dataset, const std::string& commands) const {
    SessionOptions options;
    options.dense_up_to = 0;
    return run_with(options, dataset, commands);
  }
  RunResult dense(const std::string& dataset, const std::string& commands) const {
    return run_with({}, dataset, commands);
  }

  static Complex value(const nlohmann::json& mode) { return {mode.at("real_hz"), mode.at("imag_hz")}; }
  static Eigen::VectorXcd column(const nlohmann::json& list) {
    Eigen::VectorXcd v(static_cast<Eigen::Index>(list.size()));
    for (std::size_t k = 0; k < list.size(); ++k) v(static_cast<Eigen::Index>(k)) = Complex(list[k][0], list[k][1]);
    return v;
  }
  // The same mode, whichever way it was found: vectors but for their phase, numbers but for their last digits.
  static void expect_same_mode(const nlohmann::json& one, const nlohmann::json& other) {
    EXPECT_LE(std::abs(value(one) - value(other)), 1e-13 * std::abs(value(other)));
    for (const char* key : {"structural_zero", "cluster_size", "moves_most"})
      EXPECT_EQ(one.at(key), other.at(key)) << key;
    EXPECT_NEAR(one.at("condition").get<double>() / other.at("condition").get<double>(), 1, 1e-6);
    EXPECT_LT(one.at("error_bound_hz").get<double>(), 1e-12 * std::abs(value(one)));
    for (const char* key : {"vector", "shape"}) {
      const Eigen::VectorXcd a = column(one.at(key)), b = column(other.at(key));
      EXPECT_NEAR(std::abs(a.dot(b)) / (a.norm() * b.norm()), 1, 1e-12) << key;
    }
  }
  // Numbers of tables alike but for rounding, and for the phase of shapes.
  static void expect_same_numbers(const nlohmann::json& one, const nlohmann::json& other) {
    ASSERT_EQ(one.size(), other.size());
    const auto size = [](const nlohmann::json& v) {
      if (v.is_null()) return 0.0;
      return v.is_array() ? std::abs(Complex(v[0], v[1])) : v.get<double>();
    };
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(size(one[k]), size(other[k]), 1e-9);
  }

  static std::vector<double> frequencies(const RunResult& r, std::size_t k) {
    std::vector<double> list;
    for (const auto& m : r.result(k).at("modes")) list.push_back(m.at("imag_hz"));
    return list;
  }
};

constexpr int links = 8;

// Masses on springs in a row between walls, and one that nothing holds: 2 sin(jπ/18)/2π Hz and two zeros.
std::string row(const std::string& more = "") {
  std::string s = "row\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, PART=1, QP=0,0,9\n";
  for (int k = 1; k <= links + 1; ++k) {
    const std::string p = std::to_string(k + 1), m = std::to_string(10 * (k + 1));
    s += "PART/" + p + ", MASS=1, CM=" + m + ", IP=1,1,1, QG=" + (k > links ? "3,0,0" : "0,0," + std::to_string(k)) +
         "\nMARKER/" + m + "\nMARKER/" + m + "1, PART=1\nJOINT/" + p + ", TRANSLATIONAL, I=" + m + ", J=" + m + "1\n";
    if (k > links) s.replace(s.rfind("1, PART=1"), 9, "1, PART=1, QP=3,0,0");
  }
  for (int k = 0; k <= links; ++k) {
    const std::string i = k == 0 ? "1" : std::to_string(10 * (k + 1)),
                      j = k == links ? "2" : std::to_string(10 * (k + 2));
    s += "SPRINGDAMPER/" + std::to_string(k + 1) + ", TRANSLATIONAL, I=" + i + ", J=" + j + ", K=1, LENGTH=1\n";
  }
  return s + more + "RESULTS/XRF\nEND\n";
}
double frequency(int j) { return 2 * std::sin(j * std::numbers::pi / (2 * (links + 1))) / (2 * std::numbers::pi); }

TEST_F(SelectedModes, are_the_nearest_ones_with_zeros_beside_them) {
  for (const bool without_matrix : {false, true}) {
    const auto commands =
        "LINEAR/EIGENSOL, NMODES=3\nLINEAR/EIGENSOL, NMODES=2, NEAR=0.2\nLINEAR/EIGENSOL, BAND=0.1,0.25\n"
        "LINEAR/EIGENSOL, BAND=5,6\n";
    const RunResult r = without_matrix ? sparse(row(), commands) : dense(row(), commands);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto expect = [&](std::size_t k, const std::vector<int>& numbers) {
      const auto f = frequencies(r, k);
      ASSERT_EQ(f.size(), 2 + numbers.size());
      EXPECT_EQ(f[0], 0);
      EXPECT_EQ(f[1], 0);
      EXPECT_TRUE(r.result(k).at("modes").at(1).at("structural_zero"));
      for (std::size_t m = 0; m < numbers.size(); ++m) expect_close(f[m + 2], frequency(numbers[m]), 1e-12);
      EXPECT_EQ(r.result(k).at("selected").at("complete"), true);
    };
    expect(0, {1, 2, 3});
    expect(1, {3, 4});
    expect(2, {2, 3, 4, 5});
    expect(3, {});
    const auto& near = r.result(1).at("selected");
    EXPECT_EQ(near.at("nearest"), 2);
    EXPECT_EQ(near.at("frequency_hz"), 0.2);
    EXPECT_GT(near.at("radius_hz"), std::abs(frequency(3) - 0.2));
    EXPECT_LT(near.at("radius_hz"), std::abs(frequency(5) - 0.2));
    EXPECT_EQ(near.at("found"), 2);
    EXPECT_EQ(near.at("counted"), 2);
    EXPECT_EQ(r.result(0).at("selected").at("found"), 8);  // zeros and conjugates
    EXPECT_EQ(r.result(2).at("selected").at("band_hz"), nlohmann::json({0.1, 0.25}));
    EXPECT_EQ(r.result(2).at("selected").at("found"), 8);
    EXPECT_EQ(r.result(3).at("selected").at("found"), 0);
  }
}

// All that JSON has of a mode is what the full solution has of it.
TEST_F(SelectedModes, are_modes_of_the_full_solution) {
  const std::string damped = row("SFORCE/9, TRANSLATIONAL, ACTIONONLY, I=40, J=1, FUNCTION=-0.1*VZ(40)\n");
  for (const bool without_matrix : {false, true}) {
    const auto commands = "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, BAND=0.1,0.25\n";
    const RunResult r = without_matrix ? sparse(damped, commands) : dense(damped, commands);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto &all = r.result(0).at("modes"), &some = r.result(1).at("modes");
    EXPECT_FALSE(r.result(0).contains("selected"));
    EXPECT_EQ(r.result(0).at("states"), r.result(1).at("states"));
    EXPECT_EQ(r.result(0).at("shape_entries"), r.result(1).at("shape_entries"));
    ASSERT_EQ(some.size(), 6u);
    for (const auto& mode : some) {
      if (mode.at("structural_zero")) continue;
      const auto distance = [&](const auto& other) { return std::abs(value(other) - value(mode)); };
      const auto same = std::ranges::min_element(all, {}, distance);
      if (without_matrix)
        expect_same_mode(mode, *same);
      else
        EXPECT_EQ(mode, *same);
    }
  }
}

TEST_F(SelectedModes, say_which_they_are_wherever_modes_are_written) {
  const RunResult r = dense(row(), "LINEAR/EIGENSOL, NMODES=3\nLINEAR/EIGENSOL, BAND=0.1,0.25\n");
  ASSERT_EQ(r.status, 0) << r.err;
  for (const std::string& text : {r.out, r.message}) {
    EXPECT_THAT(text, HasSubstr("  the 3 modes nearest to 0 cycles/"));
    EXPECT_THAT(text,
                HasSubstr("  eigenvalues there: 8 found, 8 counted (all eigenvalues computed)\n  complete: true\n"));
    EXPECT_THAT(text, HasSubstr("  all modes from 0.1 to 0.25 cycles/"));
  }
  const std::string res = r.text("model.res");
  EXPECT_NE(res.find("<dl:Selected nearest=\"3\" frequency=\"0\" radius=\""), std::string::npos);
  EXPECT_NE(res.find("<dl:Selected low=\"0.10000000000000001\" high=\"0.25\" found=\"8\" counted=\"8\" "
                     "complete=\"1\" />"),
            std::string::npos);
  EXPECT_THAT(dense(row(), "LINEAR/EIGENSOL\n").message, Not(HasSubstr("complete")));
}

TEST_F(SelectedModes, have_the_tables_that_are_asked_for_by_their_own_numbers) {
  const RunResult all = dense(row(), "LINEAR/EIGENSOL, COORDS=7, KINETIC=7, STRAIN=7, MRANGE=7, MLIST=20,30\n");
  for (const bool without_matrix : {false, true}) {
    const auto commands =
        "LINEAR/EIGENSOL, NMODES=1, NEAR=0.25, COORDS=3, FKINETIC=0.1,9, STRAIN=3, MRANGE=3, MLIST=20,30\n";
    const RunResult r = without_matrix ? sparse(row(), commands) : dense(row(), commands);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto &one = r.result(0).at("tables"), &other = all.result(0).at("tables");
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].at("table"), other[k].at("table"));
      ASSERT_EQ(one[k].at("rows").size(), other[k].at("rows").size());
      for (std::size_t row_number = 0; row_number < one[k].at("rows").size(); ++row_number) {
        if (one[k].at("table") == "MODE") continue;
        const auto &mine = one[k].at("rows")[row_number], &its = other[k].at("rows")[row_number];
        EXPECT_EQ(mine.at("element"), its.at("element"));
        expect_same_numbers(mine.at("values"), its.at("values"));
      }
    }
  }
  EXPECT_THAT(dense(row(), "LINEAR/EIGENSOL, NMODES=2, COORDS=5\n").err, HasSubstr("the eigensolution has 4 modes"));
}

TEST_F(SelectedModes, share_effective_masses_with_modes_that_are_left_out) {
  const RunResult r = dense(row(), "LINEAR/EIGENSOL, NMODES=3, MASS_PER_MODE=ALL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.text("model.txt"), HasSubstr("what Sum lacks of Model is in modes that were not asked for"));
  const RunResult all = dense(row(), "LINEAR/EIGENSOL, MASS_PER_MODE=ALL\n");
  EXPECT_THAT(all.text("model.txt"), Not(HasSubstr("not asked for")));
  const auto &some_rows = r.result(0).at("tables")[1].at("rows"), &all_rows = all.result(0).at("tables")[1].at("rows");
  for (std::size_t k = 0; k < some_rows.size(); ++k) EXPECT_EQ(some_rows[k], all_rows[k]);
  const RunResult energies = dense(row(), "LINEAR/EIGENSOL, NMODES=3, ENERGY_PER_MODE=ALL\n");
  EXPECT_EQ(energies.status, wrong_input);
  EXPECT_THAT(energies.err, HasSubstr("model.acf:3:28: error: NMODES and ENERGY_PER_MODE exclude each other"));
}

TEST_F(SelectedModes, say_that_there_are_fewer_than_asked_for) {
  const RunResult r = dense(row(), "LINEAR/EIGENSOL, NMODES=50\n");
  EXPECT_THAT(r.err, HasSubstr("50 modes are asked for, the model has 8 besides 2 that are zero by structure"));
  EXPECT_EQ(r.result(0).at("modes").size(), 10u);
}

// Values are refined and bounded whether or not vectors are wanted.
TEST_F(SelectedModes, have_the_same_values_without_vectors) {
  for (const bool without_matrix : {false, true}) {
    const auto commands =
        "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, NOVECTOR\nLINEAR/EIGENSOL, NMODES=8\n"
        "LINEAR/EIGENSOL, NMODES=8, NOVECTOR\n";
    const RunResult r = without_matrix ? sparse(row(), commands) : dense(row(), commands);
    ASSERT_EQ(r.status, 0) << r.err;
    for (const std::size_t k : {0u, 2u}) {
      const auto &with = r.result(k).at("modes"), &without = r.result(k + 1).at("modes");
      ASSERT_EQ(with.size(), without.size());
      EXPECT_TRUE(with[0].contains("vector"));
      EXPECT_FALSE(without[0].contains("vector"));
      for (std::size_t m = 0; m < with.size(); ++m) {
        for (const char* key : {"real_hz", "imag_hz", "error_bound_hz", "condition", "refined", "cluster_size"})
          EXPECT_EQ(without[m].at(key), with[m].at(key)) << key;
      }
    }
    const auto &all = r.result(1).at("modes"), &some = r.result(3).at("modes");
    ASSERT_EQ(some.size(), all.size());
    for (std::size_t m = 0; m < all.size(); ++m)
      EXPECT_LE(std::abs(value(some[m]) - value(all[m])), 1e-14 * std::abs(value(all[m])));
  }
}

TEST_F(SelectedModes, of_a_whole_run_are_asked_for_on_the_command_line) {
  write("model.adm", row());
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  options.commands = {"LINEAR/EIGENSOL", "LINEAR/EIGENSOL, BAND=0.1,0.25", "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL"};
  options.json = (folder_ / "results.json").string();
  options.modes = 2;
  std::ostringstream out, err;
  ASSERT_EQ(run_session(options, out, err), 0) << err.str();
  const auto results = nlohmann::json::parse(read_file(options.json)).at("results");
  EXPECT_EQ(results[0].at("modes").size(), 4u);
  EXPECT_EQ(results[0].at("selected").at("nearest"), 2);
  EXPECT_EQ(results[1].at("modes").size(), 6u);
  EXPECT_FALSE(results[2].contains("selected"));  // it shares out an energy among all modes
}

// Controllers that drive no body have modes in which nothing moves, and bodies have no rounding in them.
TEST_F(SelectedModes, of_controllers_leave_bodies_where_they_are) {
  const std::string controlled =
      row("DIFF/1, FUNCTION=-3*DIF(1)+DIF(2)+DZ(20)\nDIFF/2, FUNCTION=-DIF(1)-0.5*DIF(2)\nDIFF/3, "
          "FUNCTION=-0.3*DIF(3)+VZ(30)\n"
          "SFORCE/9, TRANSLATIONAL, ACTIONONLY, I=90, J=1, FUNCTION=-0.1*DIF(3)\n");
  const auto commands = "LINEAR/EIGENSOL, NMODES=12, COORDS=1,14\n";
  const RunResult with = dense(controlled, commands), without = sparse(controlled, commands);
  ASSERT_EQ(with.status, 0) << with.err;
  const auto &modes = with.result(0).at("modes"), &others = without.result(0).at("modes");
  ASSERT_EQ(modes.size(), others.size());
  int still = 0;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    if (!modes[m].at("structural_zero")) expect_same_mode(others[m], modes[m]);
    const std::string mover = modes[m].at("moves_most");
    if (mover != "DIFF/1" && mover != "DIFF/2") continue;
    ++still;
    for (const auto* mode : {&modes[m], &others[m]}) {
      const Eigen::VectorXcd shape = column(mode->at("shape"));
      EXPECT_TRUE(shape.head(shape.size() - 3).isZero(0)) << shape;
    }
  }
  EXPECT_EQ(still, 2);
}

// A flat parallelogram at its change point, held by springs: the warning does not need the state matrix.
TEST_F(SelectedModes, warn_of_what_the_full_solution_warns_of) {
  const std::string flat =
      "four-bar\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=2,0,0\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=1,0,0\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\nMARKER/31, QP=2,0,0\n"
      "PART/4, MASS=1, CM=40, IP=1,1,1, QG=2,0,0\nMARKER/40\nMARKER/41, QP=1,0,0\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=21\nJOINT/3, REVOLUTE, I=41, J=31\n"
      "JOINT/4, REVOLUTE, I=40, J=2\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=10\nEND\n";
  const RunResult all = dense(flat, "LINEAR/EIGENSOL\n"), some = sparse(flat, "LINEAR/EIGENSOL, NMODES=4\n");
  ASSERT_EQ(all.status, 0) << all.err;
  ASSERT_THAT(all.err, HasSubstr("[singular-configuration]"));
  ASSERT_EQ(some.status, 0) << some.err;
  EXPECT_THAT(some.err, HasSubstr("[singular-configuration]"));
}

// The coordinate that moves something furthest is found without looking at all of them: the first of hinged links on
// a line turns them all.
TEST_F(SelectedModes, know_what_moves_out_of_proportion) {
  std::string chain = "chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 1; k <= 6; ++k) {
    const std::string p = std::to_string(k + 1), m = std::to_string(10 * (k + 1)), x = std::to_string(k - 1);
    chain += "PART/" + p + ", MASS=1, CM=" + m + "0, IP=1,1,1, QG=" + x + ",0,0\nMARKER/" + m +
             "0, QP=0.5,0,0\nMARKER/" + m + "\nMARKER/" + m + "1, QP=1,0,0\nJOINT/" + p + ", REVOLUTE, I=" + m +
             ", J=" + (k == 1 ? "1" : std::to_string(10 * k) + "1") + "\n";
  }
  const library::Study study = study_of(chain + "END\n");
  const auto searched = study.linearize(LinearRequest{.dense_up_to = 0}), known = study.linearize();
  const Linearization &without = searched.inside().linear, &with = known.inside().linear;
  ASSERT_FALSE(without.has_state_matrix());
  ASSERT_TRUE(with.has_state_matrix());
  const auto one = largest_disproportion(*without.system, without.linear, 0),
             other = largest_disproportion(*with.system, with.linear, 0);
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->times, other->times, 1e-12 * other->times);
  EXPECT_FALSE(largest_disproportion(*without.system, without.linear, 2 * one->times));
}

// Hinged bodies with a spring and a damper each, frequencies spread evenly: what is next to the border of a band is as
// near as what is inside, and a sixth of all is inside.
TEST_F(SelectedModes, of_a_dense_band_are_counted_beside_the_full_solution) {
  constexpr int count = 800;
  constexpr double damping_ratio = 0.01, low = 1, high = 1.5;
  std::string dataset = "hinged bodies\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n";
  std::vector<double> inside;
  for (int k = 2; k < count + 2; ++k) {
    const double undamped = 0.1 + 3 * std::fmod(0.6180339887 * k, 1.0), omega = 2 * std::numbers::pi * undamped;
    const double damped = undamped * std::sqrt(1 - damping_ratio * damping_ratio);
    if (damped > low && damped < high) inside.push_back(damped);
    dataset += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=1,1,1, QG={0},0,0\nMARKER/{0}0, PART={0}\nMARKER/{0}1, PART=1, QP={0},0,0\n"
        "JOINT/{0}, REVOLUTE, I={0}0, J={0}1\n"
        "SFORCE/{0}, ROTATIONAL, I={0}0, J={0}1, FUNCTION=-({1})*AZ({0}0,{0}1)-({2})*WZ({0}0,{0}1)\n",
        k, omega * omega, 2 * damping_ratio * omega);
  }
  const RunResult r = run(dataset + "END\n", fmt::format("LINEAR/EIGENSOL, NOVECTOR, BAND={},{}\nSTOP\n", low, high));
  ASSERT_EQ(r.status, 0) << r.err;
  const auto& selected = r.result(0).at("selected");
  EXPECT_EQ(selected.at("counted_by"), "winding_number");
  EXPECT_EQ(selected.at("complete"), true);
  EXPECT_EQ(selected.at("counted"), 2 * inside.size());
  std::vector<double> found = frequencies(r, 0);
  std::sort(inside.begin(), inside.end()), std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), inside.size());
  for (std::size_t k = 0; k < inside.size(); ++k) EXPECT_NEAR(found[k], inside[k], 1e-10 * inside[k]);
}

TEST_F(SelectedModes, cost_of_the_full_solution_is_said_above_a_size) {
  EXPECT_TRUE(cost_of_all_modes(3000).items().empty());
  const Diagnostics said = cost_of_all_modes(12012);
  ASSERT_EQ(said.items().size(), 1u);
  EXPECT_EQ(said.items()[0].message, "all eigenvalues of 12012 states take about 58 min and 38 GB");
  EXPECT_THAT(said.items()[0].hint, HasSubstr("NMODES=20"));
  EXPECT_THAT(said.items()[0].hint, HasSubstr("BAND=f1,f2"));
}

TEST(LargeEigensolutions, say_beforehand_what_they_cost) {
  EXPECT_TRUE(cost_of_all_modes(3000).items().empty());
  const Diagnostics said = cost_of_all_modes(4000);
  ASSERT_EQ(said.items().size(), 1u);
  const Diagnostic& remark = said.items()[0];
  EXPECT_EQ(remark.code, "large-eigensolution");
  EXPECT_THAT(remark.message, HasSubstr("4000 states take about 2 min and 4.2 GB"));
  EXPECT_THAT(remark.hint, HasSubstr("NMODES=20"));
}

}  // namespace
}  // namespace dynalin::cases::selected_modes_test
