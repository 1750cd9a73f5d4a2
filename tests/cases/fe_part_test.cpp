// Beams of finite elements in motion: spectra of closed form and published, loads at which they buckle, large motions.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <numbers>

#include "cases/fe_parts.h"
#include "cases/modal_sums_cases.h"
#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::fe_part_test {
namespace {

constexpr double pi = std::numbers::pi;

// Angular frequencies in ascending order, and how many eigenvalues are zero.
struct Spectrum {
  std::vector<double> frequencies;
  std::size_t zeros = 0;
};
Spectrum spectrum(const library::LinearModel& linear) {
  Spectrum s;
  for (const EigenMode& m : linear.modes(library::ModeShapes::left_out).modes) {
    if (m.eigenvalue_hz == std::complex<double>(0)) {
      ++s.zeros;
    } else if (m.eigenvalue_hz.imag() > 0) {
      s.frequencies.push_back(2 * pi * m.eigenvalue_hz.imag());
    }
  }
  std::ranges::sort(s.frequencies);
  return s;
}
Spectrum spectrum(const std::string& dataset) { return spectrum(study_of(dataset).linearize()); }

library::OperatingPoint equilibrium(const std::string& dataset) { return study_of(dataset).static_equilibrium(); }

}  // namespace

// h/L = 0.1, E/G = 2.6, shear factor 5/6: numbers of an independent program of the same element; each doubling divides
// what is left of the first three by 16 in the end. Bending has each value twice, in two planes.
TEST(FePart, clamped_frequencies_converge_by_the_fourth_power_to_timoshenko) {
  struct Row {
    int n;
    double first, second, third;
  };
  std::vector<std::array<double, 3>> found;
  for (const Row& row : {Row{1, 3.50464996, 31.496, 0},
                         {2, 3.49000783, 21.07447, 64.870},
                         {4, 3.48846671, 20.928917, 55.34094},
                         {8, 3.48836207, 20.908418, 55.01557}}) {
    const std::vector<double> all =
        spectrum(clamped_beam({.elements = row.n, .height = 0.1, .width = 0.1})).frequencies;
    std::vector<double> bending;
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
      if (std::abs(all[k + 1] - all[k]) < 1e-7 * all[k]) bending.push_back(all[k]);
    }
    EXPECT_NEAR(bending[0], row.first, 1e-8);
    EXPECT_NEAR(bending[1], row.second, row.n == 1 ? 1e-3 : 1e-5);
    if (row.n > 1) {
      EXPECT_NEAR(bending[2], row.third, row.n == 2 ? 1e-3 : 1e-5);
    }
    found.push_back({bending[0], bending[1], bending[2]});
  }
  EXPECT_NEAR((found[1][0] - found[2][0]) / (found[2][0] - found[3][0]), 16, 2);
}

TEST(FePart, free_in_space_it_has_twelve_zeros_and_the_frequencies_of_euler) {
  const Spectrum s = spectrum(beam_model(StraightBeam{.elements = 6, .height = 2e-3, .width = 1e-3}.text()));
  EXPECT_EQ(s.zeros, 12u);
  // EI about z is 1, about y a quarter of it.
  EXPECT_NEAR(s.frequencies[0], 0.5 * 4.73004074 * 4.73004074, 3e-4 * 11);
  EXPECT_NEAR(s.frequencies[1], 4.73004074 * 4.73004074, 3e-4 * 22);
}

TEST(FePart, spectra_do_not_know_where_the_model_stands_or_in_which_units) {
  const auto beam = [](const std::string& place, const std::string& moment) {
    StraightBeam b{.elements = 4, .height = 0.04, .width = 0.03};
    b.further = place;
    return beam_model(b.text() + "MARKER/3, PART=1" + (place.empty() ? "" : ", QP=3,-2,5, REULER=40D,70D,-25D") +
                      "\nJOINT/1, FIXED, I=21, J=3\nVTORQUE/1, I=22, JFLOAT=2, RM=3" + moment + "\n");
  };
  const auto bent = [&](const std::string& place) {
    const auto study = study_of(beam(place, ", TX=0.2, TY=0.3, TZ=2"));
    return spectrum(study.linearize(study.static_equilibrium())).frequencies;
  };
  const std::vector<double> here = bent(""), there = bent(", QG=3,-2,5, REULER=40D,70D,-25D");
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(here[k], there[k], 1e-9 * here[k]) << k;

  const StraightBeam steel{.elements = 3, .height = 0.02, .width = 0.03, .E = 2.1e11, .density = 7800};
  StraightBeam in_millimetres = steel;
  in_millimetres.length *= 1e3, in_millimetres.height *= 1e3, in_millimetres.width *= 1e3;
  in_millimetres.E *= 1e-6, in_millimetres.density *= 1e-9;
  std::string mm = clamped_beam(in_millimetres);
  mm.replace(mm.find("UNITS/SYSTEM=MKS"), 16, "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND");
  const auto m = spectrum(clamped_beam(steel)).frequencies, millimetres = spectrum(mm).frequencies;
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(m[k], millimetres[k], 1e-9 * m[k]) << k;
}

// π² EI/(4 L²), a load that keeps its direction.
TEST(FePart, a_column_buckles_under_eulers_load) {
  const auto lowest = [](double part) {
    const auto study =
        study_of(clamped_beam({.elements = 4, .height = 1e-3, .width = 2e-3},
                              fmt::format("VFORCE/1, I=22, JFLOAT=2, RM=1, FX={:.17g}\n", -part * pi * pi / 4)));
    const auto point = study.static_equilibrium();
    double least = 1e300;
    for (const EigenMode& m : study.linearize(point).modes(library::ModeShapes::left_out).modes) {
      const std::complex<double> square = m.eigenvalue_hz * m.eigenvalue_hz;
      least = std::min(least, -square.real());
    }
    return least;
  };
  EXPECT_GT(lowest(0.999), 0);
  EXPECT_NEAR(lowest(0.5) / lowest(0.0), 0.5, 0.02);
}

TEST(FePart, deflects_like_a_chain_of_beams_where_that_is_little) {
  const double P = 1e-5;
  const auto here = equilibrium(
      clamped_beam({.elements = 2, .height = 0.05, .width = 0.05, .further = ", IXX=1.04166666666667E-6"},
                   fmt::format("GFORCE/1, I=22, JFLOAT=2, RM=1, FX=0\\FY={0}\\FZ={0}\\TX={0}\\TY=0\\TZ={0}\n", P)));
  const double I = std::pow(0.05, 4) / 12;
  std::string chain;
  for (int k = 1; k <= 2; ++k) {
    chain += fmt::format(
        "PART/{0}, MASS=1, CM={1}, IP=1,1,1, QG={2},0,0\nMARKER/{1}\nBEAM/{3}, I={1}, J={4}, LENGTH=0.5, AREA=0.0025, "
        "IXX=1.04166666666667E-6, IYY={5:.17g}, IZZ={5:.17g}, ASY=1.2, ASZ=1.2, EMODULUS={6:.17g}, GMODULUS={7:.17g}\n",
        k + 1, 10 + k, 0.5 * k, k, k == 1 ? 1 : 11, I, 1 / I, 1 / I / 2.6);
  }
  const auto there = equilibrium(beam_model(
      chain + fmt::format("GFORCE/1, I=12, JFLOAT=2, RM=1, FX=0\\FY={0}\\FZ={0}\\TX={0}\\TY=0\\TZ={0}\n", P)));
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_NEAR(here.marker(22).position[k], there.marker(12).position[k], 1e-4 * P);
    EXPECT_NEAR(here.marker(22).axes[0][k], there.marker(12).axes[0][k], 1e-4 * P);
  }
  EXPECT_NEAR(here.marker(22).axes[1][2], there.marker(12).axes[1][2], 1e-4 * P);
}

TEST(FePart, damping_by_stiffness_grows_with_the_frequency) {
  const StraightBeam beam{.elements = 2, .height = 0.1, .width = 0.1, .further = ", CRATIO=0.002"};
  const std::vector<double> undamped = spectrum(clamped_beam({.elements = 2, .height = 0.1, .width = 0.1})).frequencies;
  const auto linear = study_of(clamped_beam(beam)).linearize();
  std::vector<double> real;
  for (const EigenMode& m : linear.modes(library::ModeShapes::left_out).modes) {
    if (!m.is_real) real.push_back(-2 * pi * m.eigenvalue_hz.real());
  }
  std::ranges::sort(real);
  EXPECT_NEAR(real[0], 0.001 * undamped[0] * undamped[0], 1e-7);
  LinearRequest request;
  request.without_damping = true;
  EXPECT_NEAR(spectrum(study_of(clamped_beam(beam)).linearize(request)).frequencies[0], undamped[0], 1e-8);
}

// A stiff beam on a hinge swings like the rod that it is.
TEST(FePart, swings_like_a_rigid_rod) {
  const std::string hinge = "ACCGRAV/JGRAV=-9.81\nMARKER/3, PART=1\nJOINT/1, REVOLUTE, I=21, J=3\n";
  const StraightBeam beam{.elements = 2, .height = 0.05, .width = 0.05, .E = 2e9, .density = 2000, .further = ", WZ=2"};
  const double m = 2000 * 0.0025, J = m / 12 * (1 + 0.0025), Jx = m / 6 * 0.0025;
  const std::string rod = fmt::format(
      "PART/2, MASS={:.17g}, CM=20, IP={:.17g},{:.17g},{:.17g}, WZ=2, VY=1\nMARKER/20, QP=0.5,0,0\n"
      "MARKER/21\nMARKER/22, QP=1,0,0\n",
      m, Jx, J, J);
  const auto end = [&](const std::string& body) {
    return study_of(beam_model(body + hinge)).simulate({.end = 0.7, .error = 1e-6}).point.marker(22).position;
  };
  const Triple a = end(beam.text()), b = end(rod);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2e-3) << k;
}

// Angular frequencies as seen from axes that turn with ω: with u = T u_r, T′ = ω × T, of every position, rotation and
// slope, s = S s_r makes A into S⁻¹ (A S − S′). Rotations of middles are seen from the beam already.
std::vector<double> frequencies_in_turning_axes(const StateSpace& system, const Triple& omega, int nodes) {
  const auto n = static_cast<Eigen::Index>(system.states.size());
  const int beam = 12 * nodes - 3;
  std::map<std::pair<int, bool>, Eigen::Index> at;
  for (Eigen::Index k = 0; k < n; ++k) {
    const StateLabel& s = system.states[static_cast<std::size_t>(k)];
    at[{s.coordinate - 1 - (s.is_rate ? beam : 0), s.is_rate}] = k;
  }
  Eigen::Matrix3d W;
  W << 0, -omega[2], omega[1], omega[2], 0, -omega[0], -omega[1], omega[0], 0;
  const Eigen::Matrix3d W2 = W * W;
  Eigen::MatrixXd S = Eigen::MatrixXd::Identity(n, n), S1 = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [row, i] : at) {
    for (int b = 0; b < 3 && row.first < 9 * nodes; ++b) {
      const int a = row.first % 3, column = row.first - a + b;
      // A coordinate that is held does not move.
      const auto place = at.find({column, false}), rate = at.find({column, true});
      if (place == at.end()) continue;
      if (!row.second) S1(i, place->second) = W(a, b);
      if (row.second) S(i, place->second) = W(a, b), S1(i, place->second) = W2(a, b), S1(i, rate->second) = W(a, b);
    }
  }
  const Eigen::MatrixXd A = S.partialPivLu().solve(system.A * S - S1);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
  std::vector<double> list;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double frequency = solver.eigenvalues()(k).imag();
    if (frequency > 0) list.push_back(frequency);
  }
  return list;
}

// λ = Ω √(ρA L⁴/EI) = 6: 7.36037302 and 26.80908169 of flapping (Wright, Smith, Thresher, Wang 1982). The spin
// stretches the beam in a damped run. In the plane of the spin, seen from there, the centrifugal force turns with the
// beam, which takes λ² from the square of a frequency; states along global axes do not show that.
TEST(FePart, a_rotating_beam_flaps_and_lags_as_fast_as_published) {
  const StraightBeam beam{.elements = 6, .height = 0.02, .width = 0.02, .further = ", WZ=6, CRATIO=0.002"};
  const auto study = study_of(
      beam_model(beam.text() + "JOINT/1, REVOLUTE, I=21, J=1\nMOTION/1, JOINT=1, ROTATION, FUNCTION=6*TIME\n"));
  const auto start = study.initial_conditions();
  EXPECT_NEAR(start.marker(22).velocity[1], 6, 1e-12);
  const auto point = study.simulate(start, {.end = 0.15, .error = 1e-5}).point;
  LinearRequest request;
  request.without_damping = true;
  const auto linear = study.linearize(point, request);
  const auto expect = [](const std::vector<double>& all, double expected) {
    double nearest = 1e300;
    for (const double x : all) nearest = std::abs(x - expected) < std::abs(nearest - expected) ? x : nearest;
    EXPECT_NEAR(nearest, expected, 4e-3 * expected);
  };
  const std::vector<double> turning = frequencies_in_turning_axes(linear.state_space(), {0, 0, 6}, 7);
  for (const double flap : {7.36037302, 26.80908169}) {
    expect(spectrum(linear).frequencies, flap);
    expect(turning, flap);
    expect(turning, std::sqrt(flap * flap - 36));
  }
}

// Its velocity is that of the origin of the part, about which it turns.
TEST(FePart, starts_in_motion_about_its_own_origin) {
  const StraightBeam beam{.elements = 2, .height = 0.1, .width = 0.1, .further = ", QG=2,3,5, WZ=4, VX=1"};
  const auto start = study_of(beam_model(beam.text())).initial_conditions();
  for (const auto& [marker, velocity] : {std::pair<int, Triple>{21, {1, 0, 0}}, {22, {1, 4, 0}}}) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(start.marker(marker).velocity[k], velocity[k], 1e-13) << marker;
  }
}

class FePartFiles : public ModalSumCases {};

// Of a FIELD, by columns.
std::string diagonal_of_field(double value) {
  std::string text;
  for (int k = 0; k < 36; ++k) text += fmt::format("{}{}", k == 0 ? "" : ",", k % 7 == 0 ? value : 0.0);
  return text;
}

// A beam of mass 1 with bodies of 2 and 3 at its ends, and another beam: all of their modes together carry all of them.
TEST_F(FePartFiles, effective_masses_of_beams_and_bodies_add_up) {
  const StraightBeam first{.elements = 2, .height = 0.1, .width = 0.1},
      second{.elements = 1, .length = 2, .height = 0.1, .width = 0.1, .further = ", QG=1,0,0", .id = 3};
  const std::string model = beam_model(
      first.text() + second.text() +
      "PART/4, MASS=2, CM=40, IP=1,1,1\nMARKER/40\nPART/5, MASS=3, CM=50, IP=1,1,1, QG=3,0,0\nMARKER/50\n"
      "JOINT/1, FIXED, I=21, J=40\nJOINT/2, FIXED, I=22, J=31\nJOINT/3, SPHERICAL, I=32, J=50\n"
      "BUSHING/1, I=40, J=1, K=3,4,5, KT=1,2,3, C=0,0,0, CT=0,0,0\nBUSHING/2, I=50, J=6, K=7,2,1, KT=3,2,1, C=0,0,0"
      ", CT=0,0,0\nMARKER/6, PART=1, QP=3,0,0\n");
  const std::string text = tables(model, "MASS_PER_MODE=ALL");
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(row(text, "Modal effective mass", "Sum")[k], 1 + 2 + 2 + 3, 1e-6) << k;
}

TEST_F(FePartFiles, states_have_code_27_and_energies_a_row) {
  const RunResult r = run(clamped_beam({.elements = 1, .height = 0.1, .width = 0.1}),
                          "LINEAR/EIGENSOL, KINETIC=1, STRAIN=1, COORDS=1\nLINEAR/STATEMAT, RM=1, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto labels = r.labels(1);
  ASSERT_EQ(labels.size(), 30u);  // 21 coordinates less six
  EXPECT_EQ(labels[0], "derivative of Global rotation AX(node 2) FE_PART/2");
  EXPECT_EQ(labels[1], "Global rotation AX(node 2) FE_PART/2");
  const std::string states = r.text("m");
  EXPECT_NE(states.find("STATES"), std::string::npos);
  const std::string tables = r.text("model.txt");
  EXPECT_NE(tables.find("FE_PART/2,2"), std::string::npos) << tables;
  EXPECT_NE(tables.find("FE_P/2       | 100.00"), std::string::npos) << tables;
}

// A shaft with a disc twists as sin βx with βL tan βL = J/J_D, and both have their shares of the kinetic energy.
TEST_F(FePartFiles, share_the_kinetic_energy_of_twisting_with_a_disc) {
  const StraightBeam shaft{.elements = 5, .height = 0.1, .width = 0.1};
  const double own = shaft.mass_by_volume() * (shaft.yy() + shaft.zz()) * shaft.length, disc = 0.5 * own;
  double low = 0, high = std::numbers::pi / 2;
  for (int k = 0; k < 60; ++k) {
    const double angle = 0.5 * (low + high);
    (angle * std::tan(angle) < own / disc ? low : high) = angle;
  }
  const double of_shaft = own * (0.5 - std::sin(2 * low) / (4 * low)), of_disc = disc * std::pow(std::sin(low), 2);
  const RunResult r = run(clamped_beam(shaft, fmt::format("PART/4, MASS=1E-9, CM=40, IP={:.17g},{:.17g},{:.17g}, "
                                                          "QG=1,0,0\nMARKER/40\nJOINT/2, FIXED, I=40, J=22\n",
                                                          disc, 1e-4 * disc, 1e-4 * disc)),
                          "LINEAR/EIGENSOL, KINETIC=1,12\n");
  ASSERT_EQ(r.status, 0) << r.err;
  double largest = 0, beside = 0;
  for (const auto& table : r.result(0).at("tables")) {
    std::map<std::string, double> share;
    for (const auto& row : table.at("rows")) {
      if (row.contains("element")) share[row.at("element")] = row.at("values").back();
    }
    if (share["PART/4"] > largest) largest = share["PART/4"], beside = share["FE_PART/2"];
  }
  EXPECT_NEAR(largest, 100 * of_disc / (of_disc + of_shaft), 0.05);
  EXPECT_NEAR(beside, 100 - largest, 1e-6);
}

TEST_F(FePartFiles, rows_of_energy_stand_in_the_order_of_statements) {
  const RunResult r = run(clamped_beam({.elements = 1, .height = 0.1, .width = 0.1},
                                       "MARKER/8, PART=1\nFIELD/1, I=22, J=8, CMATRIX=" + diagonal_of_field(1) +
                                           ", KMATRIX=" + diagonal_of_field(100) +
                                           "\nBUSHING/1, I=22, J=8, K=1,1,1, C=1,1,1, KT=1,1,1, CT=1,1,1\n"
                                           "VFORCE/1, I=22, JFLOAT=9, RM=8, FX=-DX(22,8)\\FY=0\\FZ=0\n"
                                           "MARKER/9, PART=1, FLOATING\n"),
                          "LINEAR/EIGENSOL, STRAIN=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::vector<std::string> statements;
  for (const auto& table : r.result(0).at("tables")) {
    // The rows of the summary stand for modes, not for elements.
    for (const auto& line : table.at("rows")) {
      if (line.contains("element")) statements.push_back(line.at("element"));
    }
  }
  EXPECT_THAT(statements, ::testing::ElementsAre("BUSHING/1", "FE_PART/2", "FIELD/1", "VFORCE/1"));
}

TEST_F(FePartFiles, results_files_and_faults_name_its_nodes) {
  const StraightBeam beam{.elements = 1, .height = 0.1, .width = 0.1};
  const RunResult r = run(clamped_beam(beam, "RESULTS/XRF\n"), "SIMULATE/DYNAMIC, END=0.01, STEPS=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string results = r.text("model.res");
  for (const char* node : {"FE_PART_2_node_1", "FE_PART_2_node_2"})
    EXPECT_NE(results.find(fmt::format("entity=\"{}\" entType=\"FE_PART\" objectId=\"2\"", node)), std::string::npos);
  const RunResult marker = run(clamped_beam(beam, "MARKER/9, FE_PART=2, NODE_LABEL=7\n"), "LINEAR/EIG\n");
  EXPECT_EQ(marker.status, 1);
  EXPECT_NE(marker.err.find("FE_PART/2 has no node 7"), std::string::npos) << marker.err;
}

// Half a turn is where a rotation between two nodes has no direction; the formula ends before.
TEST_F(FePartFiles, nodes_that_are_turned_too_far_are_named) {
  for (const auto& [angle, said] :
       {std::pair{"150D", ""}, {"179D", "by 179 degrees"}, {"180D", "by half a turn or more"}}) {
    const RunResult r = run(std::string("Turned\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMATERIAL/1, DENSITY=7800, "
                                        "YOUNGS_MODULUS=2E11, POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, MATERIAL=1, "
                                        "NODE_LABELS=1,2,3, X=0,0.5,1, AREA=1E-4, IYY=1E-9, IZZ=1E-9, THETA=0,") +
                                angle + ",0\nMARKER/21, FE_PART=2, NODE_LABEL=1\nJOINT/1, FIXED, I=21, J=1\nEND\n",
                            "LINEAR/EIGENSOL, NMODES=2\n");
    EXPECT_EQ(r.status, *said == 0 ? 0 : 2) << angle << r.err;
    if (*said == 0) continue;
    EXPECT_NE(r.err.find("nodes 1 and 2 of FE_PART/2 are turned against each other " + std::string(said)), r.err.npos)
        << r.err;
  }
}

}  // namespace dynalin::cases::fe_part_test
