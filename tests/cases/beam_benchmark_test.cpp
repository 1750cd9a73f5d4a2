// Beams and rotors made of parts and BEAMs, against the tables of their discrete models.
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases {
namespace {

class Beams : public Cases {
 protected:
  std::vector<double> frequencies(const std::string& elements,
                                  const std::string& linear = "LINEAR/EIGENSOL, NOVECTOR") {
    const RunResult r = run("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + elements + "END\n", linear + "\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<double> list;
    zeros_ = 0;
    if (r.status != 0) return list;
    values_ = r.eigenvalues(0);
    for (auto& v : values_) v *= 2 * std::numbers::pi;
    for (const auto& v : values_) {
      if (v.imag() > 0) list.push_back(v.imag());
      if (std::abs(v) < 0.5) ++zeros_;
    }
    std::sort(list.begin(), list.end());
    return list;
  }
  std::size_t zeros_ = 0;
  std::vector<std::complex<double>> values_;
};

bool contains(const std::vector<double>& list, double value, double relative) {
  return std::any_of(list.begin(), list.end(), [&](double x) { return std::abs(x - value) <= relative * value; });
}

// Node k of a uniform beam of unit length, mass and bending stiffness: half of each neighbouring element, as half rods.
std::string node(int k, int n, int elements_here, const std::string& motion = "", double polar = 1) {
  const double h = 0.5 / n, m = elements_here * h, J = elements_here * h * h * h / 3;
  return fmt::format("PART/{0}, MASS={1:.17g}, CM={0}, IP={2:.17g},{3:.17g},{3:.17g}, QG={4:.17g},0,0{5}\nMARKER/{0}\n",
                     10 + k, m, polar * J, J, static_cast<double>(k) / n, motion);
}
std::string beam(int id, int i, int j, int n) {
  return fmt::format(
      "BEAM/{}, I={}, J={}, LENGTH={:.17g}, AREA=1, IXX=1E-3, IYY=1E-6, IZZ=1E-6, EMODULUS=1E6, GMODULUS=1E6\n", id, i,
      j, 1.0 / n);
}

struct Row {
  int n;
  std::array<double, 3> cantilever, free;
};
class Straight : public Beams, public ::testing::WithParamInterface<Row> {};

TEST_P(Straight, cantilever_and_free_beam_have_the_discrete_values_in_both_planes) {
  const auto [n, cantilever, free] = GetParam();
  std::string s;
  for (int k = 1; k <= n; ++k) s += node(k, n, k == n ? 1 : 2) + beam(k, 10 + k, k == 1 ? 1 : 9 + k, n);
  auto list = frequencies(s);
  for (const double expected : cantilever) {
    std::size_t copies = 0;
    for (const double x : list) copies += std::abs(x - expected) <= 2e-8 * expected;
    EXPECT_EQ(copies, 2u) << expected;
  }
  s.clear();
  for (int k = 0; k <= n; ++k) s += node(k, n, k == 0 || k == n ? 1 : 2);
  for (int k = 1; k <= n; ++k) s += beam(k, 10 + k, 9 + k, n);
  list = frequencies(s);
  EXPECT_EQ(zeros_, 12u);
  for (const double expected : free) {
    std::size_t copies = 0;
    for (const double x : list) copies += std::abs(x - expected) <= 2e-8 * expected;
    EXPECT_EQ(copies, 2u) << expected;
  }
}
INSTANTIATE_TEST_SUITE_P(
    table, Straight,
    ::testing::Values(Row{4, {3.379104713, 18.833764919, 47.480587013}, {17.339194065, 41.619430049, 73.827296802}},
                      Row{8, {3.480583997, 21.081004516, 56.731180142}, {20.745182583, 53.901748408, 99.693278964}},
                      Row{16, {3.507079764, 21.784928657, 60.333347982}, {21.934134951, 59.432946216, 114.305238326}}));

struct Spin {
  double lambda;
  int n;
  std::array<double, 3> flap;
};
class Rotating : public Beams, public ::testing::WithParamInterface<Spin> {};

TEST_P(Rotating, flap_frequencies_rise_with_the_tension) {
  const auto [lambda, n, flap] = GetParam();
  // Fields with the stiffness of BEAM, so that the tension of the steady spin is stated and nothing is stretched.
  const double L = 1.0 / n;
  std::string s = fmt::format(
      "PART/2, MASS=1, CM=2, IP=1,1,1, WZ={0:.17g}\nMARKER/2\nMARKER/3, PART=1\nJOINT/1, REVOLUTE, I=2, J=3\nMOTION/1, "
      "JOINT=1, FUNCTION={0:.17g}*TIME\n",
      lambda);
  for (int k = 1; k <= n; ++k) {
    s += node(k, n, k == n ? 1 : 2,
              fmt::format(", VX=0, VY={:.17g}, VZ=0, WX=0, WY=0, WZ={:.17g}", lambda * k / n, lambda), 1e-7);
    double tension = 0;
    for (int j = k; j <= n; ++j) tension += lambda * lambda * (j == n ? 0.5 : 1.0) / n * j / n;
    std::array<std::array<double, 6>, 6> K{};
    K[0][0] = 1e6 / L, K[3][3] = 1 / L;
    K[1][1] = K[2][2] = 12 / (L * L * L), K[5][5] = K[4][4] = 4 / L;
    K[1][5] = K[5][1] = -6 / (L * L), K[2][4] = K[4][2] = 6 / (L * L);
    std::string matrix;
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = 0; r < 6; ++r) matrix += fmt::format("{}{:.17g}", matrix.empty() ? "" : ",", K[r][c]);
    }
    s += fmt::format("FIELD/{}, I={}, J={}, KMATRIX={}, LENGTH={:.17g},0,0,0,0,0, FORCE={:.17g},0,0,0,0,0\n", k, 10 + k,
                     k == 1 ? 2 : 9 + k, matrix, L, -tension);
  }
  const auto list = frequencies(s, "LINEAR/EIGENSOL, NOVECTOR, RM=2");
  for (const double expected : flap) EXPECT_TRUE(contains(list, expected, 2e-8)) << expected;
}
INSTANTIATE_TEST_SUITE_P(table, Rotating,
                         ::testing::Values(Spin{2, 10, {4.10779863, 21.92645054, 58.78746283}},
                                           Spin{2, 20, {4.12995735, 22.43781639, 61.34737777}},
                                           Spin{6, 10, {7.29035176, 25.67735736, 61.98709089}},
                                           Spin{6, 20, {7.34347234, 26.51998202, 65.43681256}},
                                           Spin{12, 10, {12.9657329, 35.40566858, 71.49504063}},
                                           Spin{12, 20, {13.1240692, 37.05245123, 77.48768815}}));

TEST_F(Beams, overhung_disc_whirls) {
  const double d = 0.02, I = std::numbers::pi * std::pow(d, 4) / 64;
  const std::pair<double, std::array<double, 4>> rows[] = {
      {0, {61.527039070706, 61.527039070706, 525.301659371858, 525.301659371858}},
      {100, {57.088182576204, 65.902983332382, 439.933620905318, 631.118820149140}},
      {300, {48.494838840940, 74.066653363228, 323.782360229991, 898.210545707703}},
      {1000, {27.602991467516, 93.523858866, 190.461003213861, 2124.540135815}}};
  for (const auto& [spin, expected] : rows) {
    const auto list =
        frequencies(fmt::format("PART/2, MASS=1, CM=20, IP=1,1,1, WX={0}\nMARKER/20\nMARKER/21, "
                                "REULER=90D,90D,0\nMARKER/2, PART=1, REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=21, J=2\n"
                                "MOTION/1, JOINT=1, FUNCTION={0}*TIME\nPART/3, MASS=10, CM=30, IP=0.1,0.05,0.05, "
                                "QG=0.5,0,0, VX=0, VY=0, VZ=0, WX={0}, WY=0, WZ=0\nMARKER/30\n"
                                "BEAM/1, I=30, J=20, LENGTH=0.5, AREA={1:.17g}, IXX={2:.17g}, IYY={3:.17g}, "
                                "IZZ={3:.17g}, EMODULUS=210E9, GMODULUS=80E9\n",
                                spin, std::numbers::pi * d * d / 4, 2 * I, I));
    for (const double value : expected) EXPECT_TRUE(contains(list, value, 1e-10)) << spin << ": " << value;
  }
}

class TwoDiscs : public Beams {
 protected:
  std::string rotor(int n, double rpm, double damping) const {
    const double E = 211e9, G = 81.2e9, rho = 7810, d = 0.05, L = 1.5, h = 0.5 * L / n, pi = std::numbers::pi;
    const double A = pi * d * d / 4, I = pi * std::pow(d, 4) / 64, nu = E / (2 * G) - 1,
                 kappa = 6 * (1 + nu) / (7 + 6 * nu), spin = rpm * pi / 30;
    std::string s;
    for (int k = 0; k <= n; ++k) {
      const double sides = k == 0 || k == n ? 1 : 2;
      double m = sides * rho * A * h, J = sides * (rho * A * h * h * h / 3 + rho * I * h),
             polar = sides * 2 * rho * I * h;
      const double x = L * k / n;
      for (const auto& [at, D] : {std::pair{0.5, 0.28}, std::pair{1.0, 0.35}}) {
        if (std::abs(x - at) > 1e-9) continue;
        const double disc = rho * pi / 4 * (D * D - d * d) * 0.07;
        m += disc, polar += disc / 8 * (D * D + d * d), J += disc / 48 * (3 * (D * D + d * d) + 4 * 0.07 * 0.07);
      }
      s += fmt::format(
          "PART/{0}, MASS={1:.17g}, CM={0}, IP={2:.17g},{3:.17g},{3:.17g}, QG={4:.17g},0,0, VX=0, VY=0, VZ=0, "
          "WX={5:.17g}, WY=0, WZ=0\nMARKER/{0}\n",
          10 + k, m, polar, J, x, spin);
      if (k > 0) {
        s += fmt::format(
            "BEAM/{}, I={}, J={}, LENGTH={:.17g}, AREA={:.17g}, IXX={:.17g}, IYY={:.17g}, IZZ={:.17g}, EMODULUS={}, "
            "GMODULUS={}, ASY={:.17g}, ASZ={:.17g}\n",
            k, 10 + k, 9 + k, L / n, A, 2 * I, I, I, E, G, 1 / kappa, 1 / kappa);
      }
      if (sides == 1)
        s += fmt::format("MARKER/{0}, PART=1, QP={1:.17g},0,0\nBUSHING/{0}, I={2}, J={0}, K=0,1E6,1E6, C=0,{3},{3}\n",
                         2 + (k > 0), x, 10 + k, damping);
    }
    return s;
  }
};

TEST_F(TwoDiscs, whirl_at_four_thousand_revolutions) {
  const std::pair<int, std::array<double, 4>> rows[] = {{6, {85.4065239, 87.82100755, 250.64621295, 293.27699564}},
                                                        {12, {85.39376502, 87.80216432, 251.50066510, 294.35330821}},
                                                        {24, {85.39047629, 87.79736492, 251.71079574, 294.61799974}}};
  for (const auto& [n, expected] : rows) {
    const auto list = frequencies(rotor(n, 4000, 0));
    for (const double value : expected) EXPECT_TRUE(contains(list, value, 1e-8)) << n << ": " << value;
  }
}

}  // namespace
}  // namespace dynalin::cases
