// Force elements against the same forces written as expressions, and closed forms; in a loaded and moving mechanism.
#include <gmock/gmock.h>

#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::force_test {
namespace {

class Forces : public Cases {
 protected:
  std::vector<std::complex<double>> solve(const std::string& elements) const {
    const RunResult r = run(two_bodies(elements), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(1) : std::vector<std::complex<double>>();
  }
};

using Table = std::array<std::array<double, 6>, 6>;
constexpr std::array<const char*, 6> components = {"FX", "FY", "FZ", "TX", "TY", "TZ"};
const std::array<std::string, 6> displacement = {"DX(31,21,21)", "DY(31,21,21)", "DZ(31,21,21)",
                                                 "AX(31,21)",    "AY(31,21)",    "AZ(31,21)"};
const std::array<std::string, 6> rate = {"VX(31,21,21,21)", "VY(31,21,21,21)", "VZ(31,21,21,21)",
                                         "WX(31,21,21)",    "WY(31,21,21)",    "WZ(31,21,21)"};

// −K (y − length) − C y′ + force on marker 31, in the axes of 21, by expressions.
std::string as_expressions(const Table& K, const Table& C, const std::array<double, 6>& length,
                           const std::array<double, 6>& force) {
  std::string s = "MARKER/29, PART=2, FLOATING\nGFORCE/1, I=31, JFLOAT=29, RM=21";
  for (std::size_t r = 0; r < 6; ++r) {
    s += fmt::format(", {}={:.17g}", components[r], force[r]);
    for (std::size_t c = 0; c < 6; ++c) {
      s += fmt::format("-({:.17g})*({}-({:.17g}))-({:.17g})*{}", K[r][c], displacement[c], length[c], C[r][c], rate[c]);
    }
    if (r < 5) s += "\\";
  }
  return s + "\n";
}
std::string list(const Table& m) {
  std::string s;
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t r = 0; r < 6; ++r) s += fmt::format("{}{:.17g}", s.empty() ? "" : ",", m[r][c]);
  }
  return s;
}
Table full(double size, double skew) {
  Table m{};
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) {
      m[r][c] = size * ((r == c ? 2.0 : 0.3 * std::sin(1.0 + 2.0 * static_cast<double>(r + c))) +
                        skew * (static_cast<double>(r) - static_cast<double>(c)) / 5);
    }
  }
  return m;
}

TEST_F(Forces, bushing_is_its_law) {
  Table K{}, C{};
  const std::array<double, 6> k = {30, 50, 20, 4, 6, 3}, c = {1, 0.5, 2, 0.2, 0.1, 0.3};
  for (std::size_t n = 0; n < 6; ++n) K[n][n] = k[n], C[n][n] = c[n];
  expect_same(
      solve("BUSHING/1, I=31, J=21, K=30,50,20, KT=4,6,3, C=1,0.5,2, CT=0.2,0.1,0.3, FORCE=7,-5,9, TORQUE=2,1,-3\n"),
      solve(as_expressions(K, C, {}, {7, -5, 9, 2, 1, -3})));
}

TEST_F(Forces, field_is_its_law_with_matrices_by_columns) {
  const Table K = full(9, 0.5), C = full(0.3, -0.2);
  const std::string field =
      "FIELD/1, I=31, J=21, KMATRIX=" + list(K) + ", FORCE=7,-5,9,2,1,-3, LENGTH=0.1,0.2,-0.3,0.2,-0.1,0.4";
  const std::array<double, 6> force = {7, -5, 9, 2, 1, -3}, length = {0.1, 0.2, -0.3, 0.2, -0.1, 0.4};
  expect_same(solve(field + ", CMATRIX=" + list(C) + "\n"), solve(as_expressions(K, C, length, force)));
  Table part = K;
  for (auto& row : part) {
    for (double& v : row) v *= 0.02;
  }
  expect_same(solve(field + ", CRATIO=0.02\n"), solve(as_expressions(K, part, length, force)));
}

TEST_F(Forces, beam_has_timoshenkos_stiffness) {
  const double L = 0.6, A = 0.01, Ixx = 0.02, Iyy = 0.03, Izz = 0.05, E = 40, G = 15, ASY = 1.2, ASZ = 1.5;
  const double py = 12 * E * Izz * ASY / (G * A * L * L), pz = 12 * E * Iyy * ASZ / (G * A * L * L);
  Table K{}, C{};
  K[0][0] = E * A / L, K[3][3] = G * Ixx / L;
  K[1][1] = 12 * E * Izz / (L * L * L * (1 + py)), K[1][5] = K[5][1] = -6 * E * Izz / (L * L * (1 + py)),
  K[5][5] = (4 + py) * E * Izz / (L * (1 + py));
  K[2][2] = 12 * E * Iyy / (L * L * L * (1 + pz)), K[2][4] = K[4][2] = 6 * E * Iyy / (L * L * (1 + pz)),
  K[4][4] = (4 + pz) * E * Iyy / (L * (1 + pz));
  std::string lower;
  for (std::size_t c = 0, n = 1; c < 6; ++c) {
    for (std::size_t r = c; r < 6; ++r, ++n)
      C[r][c] = C[c][r] = 0.01 * static_cast<double>(n),
      lower += fmt::format("{}{}", n > 1 ? "," : "", 0.01 * static_cast<double>(n));
  }
  const std::string beam =
      "BEAM/1, I=31, J=21, LENGTH=0.6, AREA=0.01, IXX=0.02, IYY=0.03, IZZ=0.05, EMOD=40, GMOD=15, ASY=1.2, ASZ=1.5, "
      "CMATRIX=" +
      lower + "\n";
  expect_same(solve(beam), solve(as_expressions(K, C, {L, 0, 0, 0, 0, 0}, {})));
}

// What marker 31 feels, read by another force, against the same from the GFORCE.
TEST_F(Forces, nforce_is_seen_by_force_functions) {
  const Table K = full(9, 0.5), C = full(0.3, -0.2);
  const std::array<double, 6> force = {7, -5, 9, 2, 1, -3};
  // Marker 20 sees what the others do as well: two markers, the second through GFORCEs that read both.
  std::vector<double> k, c;
  for (std::size_t column = 0; column < 12; ++column) {
    for (std::size_t row = 0; row < 12; ++row) {
      const double size = row / 6 == column / 6 ? 1.0 : 0.3;
      k.push_back(size * K[row % 6][column % 6]), c.push_back(size * C[row % 6][column % 6]);
    }
  }
  const auto matrix = [](int id, const std::vector<double>& values) {
    std::string s = fmt::format("MATRIX/{}, FULL=CORDER, ROWS={}, COLUMNS={}, VALUES=", id, 12, values.size() / 12);
    for (std::size_t i = 0; i < values.size(); ++i)
      s += fmt::format("{}{:.17g}", i ? (i % 6 ? "," : "\n, ") : "", values[i]);
    return s + "\n";
  };
  std::vector<double> preload(force.begin(), force.end());
  preload.insert(preload.end(), {1, 2, -3, 0.5, -1, 1.5});
  const std::string nforce = matrix(1, k) + matrix(2, c) + matrix(3, preload) +
                             "NFORCE/1, IMARKERS=31,22, J=4, KMATRIX=1, CMATRIX=2, FORCE=3\n";
  const std::array<const char*, 6> measure = {"DX({0},4,4)", "DY({0},4,4)", "DZ({0},4,4)",
                                              "AX({0},4)",   "AY({0},4)",   "AZ({0},4)"};
  const std::array<const char*, 6> speed = {"VX({0},4,4,4)", "VY({0},4,4,4)", "VZ({0},4,4,4)",
                                            "WX({0},4,4)",   "WY({0},4,4)",   "WZ({0},4,4)"};
  const std::array<int, 2> markers = {31, 22};
  std::string gforce;
  for (std::size_t b = 0; b < 2; ++b) {
    gforce +=
        fmt::format("MARKER/{}, PART=1, FLOATING\nGFORCE/{}, I={}, JFLOAT={}, RM=4", 28 + b, 1 + b, markers[b], 28 + b);
    for (std::size_t r = 0; r < 6; ++r) {
      gforce += fmt::format(", {}={:.17g}", components[r], preload[6 * b + r]);
      for (std::size_t col = 0; col < 12; ++col) {
        const int m = markers[col / 6];
        gforce += fmt::format("\n, -({:.17g})*{}-({:.17g})*{}", k[12 * col + 6 * b + r],
                              fmt::format(fmt::runtime(measure[col % 6]), m), c[12 * col + 6 * b + r],
                              fmt::format(fmt::runtime(speed[col % 6]), m));
      }
      if (r < 5) gforce += "\\";
    }
    gforce += "\n";
  }
  const std::string reader =
      "SFORCE/1, TRANSLATIONAL, I=30, J=2, FUNCTION=0.2*FX(31,0,21)-0.1*TY(31,0,20)+0.05*FM(31)+0.03*FX(22,{0},30)\n";
  const auto own = solve(nforce + fmt::format(fmt::runtime(reader), 4));
  expect_same(own, solve(gforce + fmt::format(fmt::runtime(reader), 29)));
  EXPECT_NE(own, solve(nforce));
}

TEST_F(Forces, nforce_is_fields_that_see_each_other) {
  const Table K = full(9, 0.5), C = full(0.3, -0.2);
  const auto matrix = [](int id, const std::vector<double>& values, std::size_t rows, std::size_t columns) {
    std::string s = fmt::format("MATRIX/{}, FULL=CORDER, ROWS={}, COLUMNS={}, VALUES=", id, rows, columns);
    for (std::size_t k = 0; k < values.size(); ++k) s += fmt::format("{}{:.17g}", k ? "," : "", values[k]);
    return s + "\n";
  };
  const auto flat = [](const Table& m) {
    std::vector<double> v;
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = 0; r < 6; ++r) v.push_back(m[r][c]);
    }
    return v;
  };
  // One marker: a FIELD.
  expect_same(solve(matrix(1, flat(K), 6, 6) + matrix(2, flat(C), 6, 6) + matrix(3, {7, -5, 9, 2, 1, -3}, 6, 1) +
                    matrix(4, {0.1, 0.2, -0.3, 0.2, -0.1, 0.4}, 6, 1) +
                    "NFORCE/1, IMARKERS=31, J=21, KMATRIX=1, CMATRIX=2, FORCE=3, LENGTH=4\n"),
              solve(as_expressions(K, C, {0.1, 0.2, -0.3, 0.2, -0.1, 0.4}, {7, -5, 9, 2, 1, -3})));
  // Two markers on ground-based J: the expressions read both.
  std::vector<double> K2(144), C2(144);
  for (std::size_t c = 0; c < 12; ++c) {
    for (std::size_t r = 0; r < 12; ++r)
      K2[12 * c + r] = 5 * ((r == c) + 0.2 * std::cos(static_cast<double>(3 * r + c))),
                  C2[12 * c + r] = 0.1 * K2[12 * c + r];
  }
  std::string expressions = "MARKER/5, PART=1, FLOATING\nMARKER/6, PART=1, FLOATING\n";
  const std::array<int, 2> markers = {21, 31};
  for (std::size_t k = 0; k < 2; ++k) {
    expressions += fmt::format("GFORCE/{}, I={}, JFLOAT={}, RM=1", k + 1, markers[k], 5 + k);
    for (std::size_t r = 0; r < 6; ++r) {
      expressions += fmt::format(", {}=0", components[r]);
      for (std::size_t c = 0; c < 12; ++c) {
        const int m = markers[c / 6];
        const char axis = "XYZ"[c % 3];
        const std::string y = c % 6 < 3 ? fmt::format("D{}({},1,1)", axis, m) : fmt::format("A{}({},1)", axis, m);
        const std::string v = c % 6 < 3 ? fmt::format("V{}({},1,1,1)", axis, m) : fmt::format("W{}({},1,1)", axis, m);
        expressions += fmt::format("-({:.17g})*{}-({:.17g})*{}", K2[12 * c + 6 * k + r], y, C2[12 * c + 6 * k + r], v);
      }
      if (r < 5) expressions += "\\";
    }
    expressions += "\n";
  }
  expect_same(solve(matrix(1, K2, 12, 12) + "NFORCE/1, IMARKERS=21,31, J=1, KMATRIX=1, CRATIO=0.1\n"),
              solve(expressions));
}

TEST_F(Forces, general_forces_are_the_sum_of_vector_forces_and_torques) {
  const std::string markers = "MARKER/29, PART=2, FLOATING\nMARKER/28, PART=2, FLOATING\n";
  const std::string fx = "5*VX(31,21)-20*DX(31,21,31)", fy = "3+DM(31,22)**2", tz = "-2*WZ(31,21)+1.5";
  const auto whole = solve(markers + "GFORCE/1, I=31, JFLOAT=29, RM=22, FX=" + fx + "\\FY=" + fy + "\\TZ=" + tz + "\n");
  expect_same(whole, solve(markers + "VFORCE/1, I=31, JFLOAT=29, RM=22, FX=" + fx + "\\FY=" + fy +
                           "\nVTORQUE/1, I=31, JFLOAT=28, RM=22, TZ=" + tz + "\n"));
  expect_same(whole, solve(markers + "GFORCE/1, I=31, JFLOAT=29, RM=22, FXYZ=[" + fx + "," + fy +
                           ",0]\\TXYZ=[0,0,1]*(" + tz + ")\n"));
  // RM on a third body, here ground, that turns nothing; and against single forces without reaction.
  EXPECT_NE(whole.size(), 0u);
  expect_same(solve("MARKER/9, PART=1, FLOATING\nGFORCE/1, I=31, JFLOAT=9, RM=21, FZ=" + fx + "\\TZ=" + tz + "\n"),
              solve("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=31, J=21, FUNCTION=" + fx +
                    "\nSFORCE/2, ROTATIONAL, ACTIONONLY, I=31, J=21, FUNCTION=" + tz + "\n"));
}

TEST_F(Forces, force_functions_see_what_the_element_does) {
  // A force on part 2 that reads components of another element, against the same component by expression.
  const std::string law =
      "BUSHING/1, I=31, J=21, K=30,50,20, KT=4,6,3, C=1,0.5,2, CT=0.2,0.1,0.3, FORCE=7,-5,9, TORQUE=2,1,-3\n";
  const auto reader = [&](const std::string& elements, const std::string& f) {
    return solve(elements + "SFORCE/9, ROTATIONAL, ACTIONONLY, I=22, J=22, FUNCTION=0.3*(" + f + ")\n");
  };
  const std::string x = "(7-30*DX(31,21,21)-VX(31,21,21,21))", y = "(-5-50*DY(31,21,21)-0.5*VY(31,21,21,21))",
                    tz = "(-3-3*AZ(31,21)-0.3*WZ(31,21,21))";
  expect_same(reader(law, "BUSH(1,0,2,21)"), reader(law, x));
  expect_same(reader(law, "BUSH(1,1,8,21)"), reader(law, "-" + tz + "-DX(31,21,21)*" + y + "+DY(31,21,21)*" + x));
  expect_same(reader(law, "FX(31,21,21)+TZ(31,21,21)"), reader(law, x + "+" + tz + "+SPDP(4,0,2,21)"));
  const std::string g =
      "MARKER/29, PART=2, FLOATING\nGFORCE/1, I=31, JFLOAT=29, RM=22, FX=5*VX(31,21)-20*DX(31,21,31)\\TY=2*DM(31,20)\n";
  expect_same(reader(g, "GFORCE(1,0,2,22)"), reader(g, "5*VX(31,21)-20*DX(31,21,31)"));
  expect_same(reader(g, "GFORCE(1,1,7,22)"), reader(g, "-2*DM(31,20)"));
  expect_same(reader(g, "FX(29,0,22)"), reader(g, "20*DX(31,21,31)-5*VX(31,21)"));
  // The floating marker is where I is.
  expect_same(reader(g, "DX(29,21)"), reader(g, "DX(31,21)"));
}

// --- closed forms ------------------------------------------------------------------------------------------------

TEST_F(Forces, tip_mass_on_a_beam) {
  // A point-like body at the end of a cantilever: ω² = 3 E I/(m L³) across, E A/(m L) along, with negligible inertia.
  const double E = 200, I = 0.3, A = 2, L = 1.5, m = 0.7, J = 0.2;
  const RunResult r = run(
      fmt::format("Cantilever\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS={}, CM=20, IP={},{},{}, "
                  "QG=1.5,0,0\nMARKER/20\n"
                  "BEAM/1, I=20, J=1, LENGTH=1.5, AREA=2, IXX=0.4, IYY=0.3, IZZ=0.3, EMODULUS=200, GMODULUS=80\nEND\n",
                  m, J, J, J),
      "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const double k = E * I / (L * L * L);
  // Bending in one plane: [12 −6L; −6L 4L²] k against diag(m, J).
  const double a = m * J, b = -(12 * k * J + 4 * L * L * k * m), c = 12 * L * L * k * k;
  std::vector<double> expected = {std::sqrt(E * A / L / m), std::sqrt(80 * 0.4 / L / J)};
  for (const double sign : {1.0, -1.0}) {
    const double w = std::sqrt((-b + sign * std::sqrt(b * b - 4 * a * c)) / (2 * a));
    expected.push_back(w), expected.push_back(w);
  }
  std::sort(expected.begin(), expected.end());
  std::vector<double> found;
  for (const auto& v : r.eigenvalues(0)) {
    if (v.imag() > 0) found.push_back(2 * std::numbers::pi * v.imag());
  }
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 6u);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(found[n], expected[n], 1e-11 * expected[n]);
}

class WrongForces : public Cases, public ::testing::WithParamInterface<std::pair<const char*, const char*>> {};
TEST_P(WrongForces, are_named_with_their_code) {
  const auto [statement, code] = GetParam();
  const RunResult r = run(two_bodies(std::string(statement) + "\n"), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, ::testing::HasSubstr(fmt::format("[{}]", code))) << statement;
  EXPECT_FALSE(r.wrote("model.msg"));
}
INSTANTIATE_TEST_SUITE_P(
    all, WrongForces,
    ::testing::Values(
        std::pair("BUSHING/1, I=31, J=21, K=1,2", "wrong-count"),
        std::pair("BUSHING/1, I=31, J=21, K=1,-2,3", "value-out-of-range"),
        std::pair("BUSHING/1, I=31, J=30, K=1,2,3", "same-body"), std::pair("FIELD/1, I=31, J=21", "missing-argument"),
        std::pair("FIELD/1, I=31, J=21, KMATRIX=1,2,3", "wrong-count"),
        std::pair("FIELD/1, I=31, J=21, FUNCTION=USER(1)", "missing-routine"),
        std::pair("BEAM/1, I=31, J=21, LENGTH=0, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1, GMOD=1", "value-out-of-range"),
        std::pair("BEAM/1, I=31, J=21, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1, GMOD=1, CRATIO=1, CMATRIX=1",
                  "excluded-arguments"),
        std::pair("BEAM/1, I=31, J=21, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1, GMOD=1, FORMULATION=NONLINEAR",
                  "argument-not-built"),
        std::pair("VFORCE/1, I=31, JFLOAT=21, RM=1, FX=1", "fixed-marker"),
        std::pair("MARKER/29, PART=2, FLOATING\nVFORCE/1, I=31, JFLOAT=29, RM=1", "missing-argument"),
        std::pair("MARKER/29, PART=3, FLOATING\nVFORCE/1, I=31, JFLOAT=29, RM=1, FX=2", "same-body"),
        std::pair("MARKER/29, PART=2, FLOATING\nVFORCE/1, I=29, JFLOAT=29, RM=1, FX=2", "floating-marker"),
        std::pair("MARKER/29, PART=2, FLOATING\nGFORCE/1, I=31, JFLOAT=29, RM=1, FX=2\\FXYZ=[1,2,3]",
                  "excluded-arguments"),
        std::pair("MARKER/29, PART=2, FLOATING\nGFORCE/1, I=31, JFLOAT=29, RM=1, FXYZ=3", "vector-mismatch"),
        std::pair("MATRIX/1, FULL=CORDER, ROWS=2, COLUMNS=1, VALUES=1,2\nNFORCE/1, IMARKERS=31, J=21, KMATRIX=1",
                  "wrong-size"),
        std::pair("MATRIX/1, FULL=CORDER, ROWS=2, COLUMNS=1, VALUES=1,2\nNFORCE/1, IMARKERS=31,77, J=21, KMATRIX=1",
                  "unknown-marker")));

// Free of force where its markers meet, a spring pulls back whichever way they part; others have no direction there.
TEST_F(Forces, springs_without_length_hold_what_is_drawn_in_their_place) {
  const auto spring = [&](const std::string& of) {
    return run(
        "Spring\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=4, CM=2\nMARKER/2\nSPRINGDAMPER/1, "
        "TRANSLATIONAL, I=2, J=1, " +
            of + "\nEND\n",
        "SIMULATE/STATICS\nLINEAR/EIGENSOL, KINETIC=1, STRAIN=1\nSIMULATE/DYNAMICS, END=1, STEPS=1\n");
  };
  const double hz = std::sqrt(100.0 / 4) / (2 * std::numbers::pi);
  for (const std::string of : {"K=100", "K=100, LENGTH=0.5, FORCE=-50"}) {
    const RunResult r = spring(of);
    ASSERT_EQ(r.status, 0) << r.err;
    ASSERT_EQ(r.eigenvalues(1).size(), 6u);
    for (const auto& value : r.eigenvalues(1)) EXPECT_NEAR(std::abs(value.imag()), hz, 1e-12) << of;
  }
  for (const std::string of : {"K=100, LENGTH=0.5", "K=100, C=1", "FORCE=2"}) {
    const RunResult r = spring(of);
    EXPECT_EQ(r.status, 2) << of;
    EXPECT_THAT(r.err, ::testing::HasSubstr("the markers of SPRINGDAMPER/1 coincide")) << of;
  }
}

}  // namespace
}  // namespace dynalin::cases::force_test
