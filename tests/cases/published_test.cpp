// Every example of the LINEAR command's document whose data it gives, at the values verified to twelve digits.
#include "cases/decks.h"
#include "places/source_tree.h"

namespace dynalin::cases::published_test {
namespace {

using Published = ProgramLibraryAndDecks;
using Complex = std::complex<double>;

TEST_F(Published, rotating_slider_in_global_and_in_relative_coordinates) {
  const RunResult r = run_example("rotating_slider", "rotating_slider.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(0), {0, 0, Complex(0, 3.074549302168)}, 2e-13);
  expect_eigenvalues(r.eigenvalues(1), {0, 0, Complex(0, 2.630555800663)}, 2e-13);
  EXPECT_EQ(r.labels(0)[1], "Global rotation AZ(BCS) PART/2");
  EXPECT_EQ(r.labels(0)[3], "Global displacement DX(BCS) PART/3");
  EXPECT_EQ(r.labels(1)[1], "Relative rotation AZ(GROUND,5) PART/2");
  EXPECT_EQ(r.labels(1)[3], "Relative displacement DX(BCS,5,5) PART/3");
}

TEST_F(Published, rotating_slider_state_matrices_have_the_closed_form) {
  const auto dataset = read_file(examples_folder() / "rotating_slider/rotating_slider.adm");
  const RunResult r = run(dataset, "LINEAR/STATEMAT, FILE=a\nLINEAR/STATEMAT, FILE=b, RM=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  // J α″ = −2 m u u′ α′ with J = 323; the default coordinate adds −α′² to the spring.
  const std::vector<std::vector<double>> global = {
      {0, 0, -600.0 / 323, 0}, {1, 0, 0, 0}, {200, 0, 0, -5.0 / 3}, {0, 0, 1, 0}};
  const std::vector<std::vector<double>> relative = {
      {0, 0, 600.0 / 323, 0}, {1, 0, 0, 0}, {-200, 0, 0, 295.0 / 3}, {0, 0, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      expect_close(r.matrix(0, "A")[i][j], global[i][j], 1e-13);
      expect_close(r.matrix(1, "A")[i][j], relative[i][j], 1e-13);
    }
  }
}

TEST_F(Published, driven_blade_in_the_angle_and_in_a_coordinate_of_its_own) {
  const RunResult r = run_example("driven_blade", "driven_blade.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(0), {Complex(0, 0.7001883973744)}, 1e-12);
  expect_eigenvalues(r.eigenvalues(1), {Complex(0, 1.738762025947)}, 1e-12);
  EXPECT_EQ(r.labels(0)[1], "Global rotation AZ(BCS) PART/3");
  EXPECT_EQ(r.labels(1)[1], "PSTATE VARIABLE VAR/1 DY(10)");
  EXPECT_EQ(r.result(1)["states"][0]["type"], 11);
  EXPECT_EQ(r.result(1)["states"][1]["type"], 10);
}

TEST_F(Published, spring_pendulum_finds_its_equilibrium_and_eigenvalue) {
  const auto example = read_file(examples_folder() / "spring_pendulum/spring_pendulum.adm");
  const RunResult r = run_example("spring_pendulum", "spring_pendulum.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  const Complex expected(-0.0448686373285978, 0.95828903953554);
  expect_eigenvalues(r.eigenvalues(1), {expected}, 1e-12);
  expect_eigenvalues(r.eigenvalues(2), {expected}, 1e-12);
  EXPECT_EQ(r.labels(1)[1], "Global rotation AZ(BCS) PART/2");
  EXPECT_EQ(r.labels(2)[1], "PSTATE VARIABLE VAR/5 DX(7)");
  // The pose itself, through the output row of a measure at it: ∂DX/∂AZ is the height below the hinge, and
  // ∂DY/∂AZ the distance to its right.
  std::string text = example.substr(0, example.rfind("END"));
  text += "VARIABLE/6, FUNCTION=DX(7)\nVARIABLE/7, FUNCTION=DY(7)\nPOUTPUT/1, VARIABLES=6,7\nEND\n";
  const RunResult pose = run(text, "SIM/STAT\nLINEAR/STATEMAT, POUTPUT=1, FILE=pose\n");
  ASSERT_EQ(pose.status, 0) << pose.err;
  expect_close(pose.matrix(1, "C")[0][1], 206.12823468637, 1e-12);
  expect_close(pose.matrix(1, "C")[1][1], 3.3392911044706, 1e-11);
}

const std::vector<Complex> open_loop_modes = {0.05009093452196, -0.05009247158884, -31.83098861838,
                                              Complex(-0.3179942710765, 0.6361891642241)};

TEST_F(Published, cart_pendulum_with_its_actuator) {
  const RunResult r = run_example("cart_pendulum", "pendulum.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1), open_loop_modes, 1e-11);
  // The document's own print was made with a seven-digit 1/2π.
  EXPECT_NEAR(r.eigenvalues(1)[0].real() * 0.1591549 * 2 * M_PI, 5.00909210E-02, 1e-10);
}

TEST_F(Published, cart_pendulum_open_loop_has_an_exact_zero_more) {
  const RunResult r = run_example("cart_pendulum", "open_loop.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  std::vector<Complex> expected = open_loop_modes;
  expected.insert(expected.begin(), 0.0);
  expect_eigenvalues(r.eigenvalues(1), expected, 1e-11);
}

TEST_F(Published, cart_pendulum_state_matrices_entry_by_entry) {
  const RunResult r = run_example("cart_pendulum", "open_loop.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  const double a13 = -100.0 / 1011, a33 = 110.0 / 1011, act = 4.02439896739235914e-02;
  const std::vector<std::vector<double>> A = {
      {-4040.0 / 1011, -20200.0 / 1011, 0, a13, act, 0},
      {1, 0, 0, 0, 0, 0},
      {3.95647873392680538e-01, 1.97823936696340263, 0, a33, -4.42683886413159505e-02, 0},
      {0, 0, 1, 0, 0, 0},
      {0, 0, 0, 0, -200, 0},
      {0, 0, 0, 10, 0, 0}};
  const std::vector<std::vector<double>> C = {{0, 0, 0, 10, 0, 0}, {0, 0, 10, 0, 0, 0}, {0, 0, 0, 0, 0, 1}};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) expect_close(r.matrix(2, "A")[i][j], A[i][j], 1e-14);
    expect_close(r.matrix(2, "B")[i][0], i == 4 ? 2000.0 : 0.0, 1e-14);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 6; ++j) expect_close(r.matrix(2, "C")[i][j], C[i][j], 1e-14);
    EXPECT_EQ(r.matrix(2, "D")[i][0], 0.0);
  }
  const std::vector<std::array<int, 3>> states = {{21, 1, 7}, {21, 1, 1}, {21, 2, 11},
                                                  {21, 2, 5}, {3, 1, 1},  {3, 2, 1}};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(r.result(2)["states"][k]["type"], states[k][0]);
    EXPECT_EQ(r.result(2)["states"][k]["element"], states[k][1]);
    EXPECT_EQ(r.result(2)["states"][k]["coordinate"], states[k][2]);
  }
}

TEST_F(Published, state_matrix_file_has_the_fsave_layout) {
  const RunResult r = run_example("cart_pendulum", "open_loop.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  std::istringstream in(r.text("open_loop.mat"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 3u + 1 + 12 + 1 + 2 + 1 + 6 + 1 + 1 + 1 + 6 + 1 + 1 + 1 + 2);
  EXPECT_EQ(lines[0].substr(0, 42), "MATRIXx                      VERSION   700");
  EXPECT_EQ(lines[0].substr(39, 12), "700    7    ");
  EXPECT_EQ(lines[1], "A             6    6B             6    1C             3    6D             3    1");
  EXPECT_EQ(lines[2], "STATES        3    6PINPUT        2    1POUTPUT       4    1");
  EXPECT_EQ(lines[3], "A             6    6    0(3(1PE25.17))       ");
  // Values by columns: the first three are A(1,1), A(2,1), A(3,1).
  const auto number = [&](std::size_t line, std::size_t k) { return std::stod(lines[line].substr(25 * k, 25)); };
  expect_close(number(4, 0), -4040.0 / 1011, 1e-14);
  EXPECT_EQ(lines[4].substr(25, 25), "  1.00000000000000000e+00");
  expect_close(number(4, 2), 3.95647873392680538e-01, 1e-14);
  EXPECT_EQ(lines[16], "B             6    1    0(3(1PE25.17))       ");
  EXPECT_EQ(lines[18], "  0.00000000000000000e+00  2.00000000000000000e+03  0.00000000000000000e+00");
  EXPECT_EQ(lines[29], "  2.10000000000000000e+01  1.00000000000000000e+00  7.00000000000000000e+00");
  EXPECT_EQ(lines[36], "  1.00000000000000000e+00  2.00000000000000000e+00");
  EXPECT_EQ(lines.back(), "  3.00000000000000000e+01");
}

TEST_F(Published, matlab_format_writes_one_matrix_a_file) {
  std::filesystem::copy(examples_folder() / "cart_pendulum", folder_, std::filesystem::copy_options::recursive);
  write("model.acf", "open_loop\nmodel\nSIM/STAT\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FORMAT=MATLAB FILE=plant\n");
  const RunResult r = run_file("model.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  for (const char* suffix : {"a", "b", "c", "d", "st", "pi", "po"})
    EXPECT_TRUE(r.wrote(std::string("plant") + suffix)) << suffix;
  EXPECT_EQ(r.text("plantpo"),
            "1.00000000000000000e+00\n1.00000000000000000e+01\n2.00000000000000000e+01\n3.00000000000000000e+01\n");
  EXPECT_EQ(r.text("plantst").substr(0, 72),
            "2.10000000000000000e+01 1.00000000000000000e+00 7.00000000000000000e+00\n");
}

TEST_F(Published, cart_pendulum_closed_loop_is_stable) {
  const RunResult r = run_example("cart_pendulum", "closed_loop.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1),
                     {-0.5352339047128, -31.8270832847, Complex(-0.2373970644161, 0.07544884221599),
                      Complex(-0.007377987186762, 0.1516113433946), Complex(-0.547796218063, 0.5127453303115),
                      Complex(-0.2434664774643, 0.5713141189687), Complex(-24.6528379746, 10.06148215491)},
                     1e-11);
}

TEST_F(Published, message_file_lists_states_and_eigenvalues) {
  const RunResult r = run_example("rotating_slider", "rotating_slider.acf");
  EXPECT_NE(r.message.find(" command: LINEAR/EIGENSOL, RM=5\n"), std::string::npos);
  EXPECT_NE(r.message.find("  Option RM=5 was used.\n"), std::string::npos);
  EXPECT_NE(r.message.find("        4 kinematic states (displacement and velocities)\n"), std::string::npos);
  EXPECT_NE(
      r.message.find("        1 Global rotation AZ(BCS)   PART/2\n        2 Global displacement DX(BCS)   PART/3\n"),
      std::string::npos);
  EXPECT_NE(r.message.find("                 E I G E N V A L U E S  at time = 0.00000E+00\n"), std::string::npos);
  EXPECT_NE(r.message.find("         1              0.00000E+00\n"), std::string::npos);
  EXPECT_NE(r.message.find("    +/-        3.07455E+00\n"), std::string::npos);
  EXPECT_NE(r.message.find("    +/-        2.63056E+00\n"), std::string::npos);
}

}  // namespace
}  // namespace dynalin::cases::published_test
