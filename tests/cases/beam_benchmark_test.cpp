// Straight and rotating beams made of parts and BEAMs, against the tables of their discrete models, the same models
// assembled by hand, and the closed forms they converge to.
#include "cases/beam_model.h"
#include "cases/beams.h"

namespace dynalin::cases::beam_benchmark_test {
namespace {

// Unit bending stiffness about both axes.
std::string beam(int id, int i, int j, double length, double EA = 1e6, double asy = 0, double GA = 1e6) {
  return fmt::format(
      "BEAM/{}, I={}, J={}, LENGTH={:.17g}, AREA=1, IXX=1E-3, IYY={:.17g}, IZZ={:.17g}, EMODULUS={:.17g}, "
      "GMODULUS={:.17g}, ASY={:.17g}, ASZ={:.17g}\n",
      id, i, j, length, 1 / EA, 1 / EA, EA, GA, asy, asy);
}

struct Row {
  int n;
  std::array<double, 3> cantilever, free;
};
void PrintTo(const Row& r, std::ostream* out) { *out << r.n << " elements"; }
class Straight : public Beams, public ::testing::WithParamInterface<Row> {};

TEST_P(Straight, cantilever_and_free_beam_have_the_discrete_values_in_both_planes) {
  const auto [n, cantilever, free] = GetParam();
  std::string s;
  for (int k = 1; k <= n; ++k) s += node(k, n).text() + beam(k, 10 + k, k == 1 ? 1 : 9 + k, 1.0 / n);
  auto list = frequencies(s);
  for (const double expected : cantilever) EXPECT_EQ(copies(list, expected, 2e-8), 2) << expected;
  s.clear();
  for (int k = 0; k <= n; ++k) s += node(k, n).text();
  for (int k = 1; k <= n; ++k) s += beam(k, 10 + k, 9 + k, 1.0 / n);
  const auto values = spectrum(s);
  EXPECT_EQ(std::count_if(values.begin(), values.end(), [](auto v) { return std::abs(v) < 0.5; }), 12);
  list = frequencies(values);
  for (const double expected : free) EXPECT_EQ(copies(list, expected, 2e-8), 2) << expected;
}
INSTANTIATE_TEST_SUITE_P(
    table, Straight,
    ::testing::Values(Row{4, {3.379104713, 18.833764919, 47.480587013}, {17.339194065, 41.619430049, 73.827296802}},
                      Row{8, {3.480583997, 21.081004516, 56.731180142}, {20.745182583, 53.901748408, 99.693278964}},
                      Row{16, {3.507079764, 21.784928657, 60.333347982}, {21.934134951, 59.432946216, 114.305238326}},
                      Row{32, {3.513776500, 21.971378316, 61.348222005}, {22.261298914, 61.091355327, 119.153659188}}));

struct Deep {
  double height;  // of a rectangular section, as part of the length
  std::array<double, 3> exact;
};
void PrintTo(const Deep& d, std::ostream* out) { *out << "height " << d.height; }
class Timoshenko : public Beams, public ::testing::WithParamInterface<Deep> {};

TEST_P(Timoshenko, deep_cantilever_has_the_discrete_values_and_converges) {
  const auto [height, exact] = GetParam();
  const double nu = 0.3, kappa = 10 * (1 + nu) / (12 + 11 * nu), gyration = height * height / 12;
  const double EA = 1 / gyration, GA = EA / (2 * (1 + nu));
  std::array<std::vector<double>, 3> series;
  for (const int n : {8, 16, 32}) {
    std::string s;
    for (int k = 1; k <= n; ++k) {
      Node here = node(k, n);
      here.gyration = gyration;
      s += here.text() + beam(k, 10 + k, k == 1 ? 1 : 9 + k, 1.0 / n, EA, 1 / kappa, GA);
    }
    const auto list = frequencies(s);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2), M = K;
    for (int k = 0; k <= n; ++k) {
      Node here = node(k, n);
      here.gyration = gyration;
      M(2 * k, 2 * k) = here.mass(), M(2 * k + 1, 2 * k + 1) = here.inertia();
      if (k > 0) add(K, element_matrices({.shear = 1 / (kappa * GA)}, 1.0 / n).K, k - 1);
    }
    const auto squares = clamped_squares(K, M);
    for (std::size_t k = 0; k < 3; ++k) {
      const double omega = std::sqrt(-squares[k].real());
      EXPECT_EQ(copies(list, omega, 1e-9), 2) << n << ": " << omega;
      series[k].push_back(nearest(list, omega));
    }
  }
  // What is left after two steps of extrapolation grows with the mode.
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(extrapolated(series[k]), exact[k], 3e-7 * std::pow(8, k) * exact[k]);
}
INSTANTIATE_TEST_SUITE_P(table, Timoshenko,
                         ::testing::Values(Deep{0.05, {3.50912832, 21.73886125, 59.78711355}},
                                           Deep{0.1, {3.48875312, 20.92213123, 55.07048965}}));

class Spinning : public Beams {
 protected:
  static constexpr double thin = 1e-6;  // moment of inertia of a node about the beam, a part of the others
  static constexpr double EA_of_fields = 1e6;
  static std::string hub(double lambda) {
    return fmt::format(
        "PART/2, MASS=1, CM=2, IP=1,1,1, WZ={0:.17g}\nMARKER/2\nMARKER/3, PART=1\nJOINT/1, REVOLUTE, I=2, J=3\n"
        "MOTION/1, JOINT=1, FUNCTION={0:.17g}*TIME\n",
        lambda);
  }
  static std::string turning(int k, int n, double x, double lambda) {
    Node here = node(k, n);
    here.x = x, here.polar = thin;
    here.motion = fmt::format(", VX=0, VY={:.17g}, VZ=0, WX=0, WY=0, WZ={:.17g}", lambda * x, lambda);
    return here.text();
  }
  // Tension of element k, between the nodes k − 1 and k.
  static double tension(int k, int n, const std::vector<double>& x, double lambda) {
    double sum = 0;
    for (int j = k; j <= n; ++j) sum += lambda * lambda * node(j, n).mass() * x[static_cast<std::size_t>(j)];
    return sum;
  }
  static std::vector<double> even(int n) {
    std::vector<double> x;
    for (int k = 0; k <= n; ++k) x.push_back(1.0 * k / n);
    return x;
  }
  // Of fields with the stiffness of BEAM, so that the tension of the steady spin is stated and nothing is stretched.
  std::vector<double> unstretched(int n, double lambda) const {
    const double L = 1.0 / n;
    std::string s = hub(lambda);
    for (int k = 1; k <= n; ++k) {
      std::array<std::array<double, 6>, 6> K{};
      K[0][0] = EA_of_fields / L, K[3][3] = 1e-4 / L;
      K[1][1] = K[2][2] = 12 / (L * L * L), K[5][5] = K[4][4] = 4 / L;
      K[1][5] = K[5][1] = -6 / (L * L), K[2][4] = K[4][2] = 6 / (L * L);
      std::string matrix;
      for (std::size_t c = 0; c < 6; ++c) {
        for (std::size_t r = 0; r < 6; ++r) matrix += fmt::format("{}{:.17g}", matrix.empty() ? "" : ",", K[r][c]);
      }
      s += turning(k, n, L * k, lambda) +
           fmt::format("FIELD/{}, I={}, J={}, KMATRIX={}, LENGTH={:.17g},0,0,0,0,0, FORCE={:.17g},0,0,0,0,0\n", k,
                       10 + k, k == 1 ? 2 : 9 + k, matrix, L, -tension(k, n, even(n), lambda));
    }
    return frequencies(s, "LINEAR/EIGENSOL, NOVECTOR, RM=2");
  }
};

struct Spin {
  double lambda;
  int n;
  std::array<double, 3> flap;
};
void PrintTo(const Spin& s, std::ostream* out) { *out << "speed " << s.lambda << ", " << s.n << " elements"; }
class Rotating : public Spinning, public ::testing::WithParamInterface<Spin> {};

TEST_P(Rotating, flap_frequencies_rise_with_the_tension) {
  const auto [lambda, n, flap] = GetParam();
  const auto list = unstretched(n, lambda);
  for (const double expected : flap) {
    EXPECT_TRUE(contains(list, expected, 2e-8)) << expected;
    // In the plane of the spin the centrifugal force turns with the node, which takes λ² away; Coriolis forces couple
    // with stretching, ω² ≥ EA π²/4, and change ω² by about 4 λ²/(EA π²/4) of itself.
    const double lag = std::sqrt(expected * expected - lambda * lambda);
    EXPECT_TRUE(contains(list, lag, 2e-8 + 8 * lambda * lambda / (EA_of_fields * 9.87))) << lag;
  }
}
INSTANTIATE_TEST_SUITE_P(
    table, Rotating,
    ::testing::Values(
        Spin{2, 10, {4.10779863, 21.92645054, 58.78746283}}, Spin{2, 20, {4.12995735, 22.43781639, 61.34737777}},
        Spin{2, 40, {4.13548422, 22.57035069, 62.03830171}}, Spin{2, 80, {4.13686153, 22.60376349, 62.21425597}},
        Spin{6, 10, {7.29035176, 25.67735736, 61.98709089}}, Spin{6, 20, {7.34347234, 26.51998202, 65.43681256}},
        Spin{6, 40, {7.35622830, 26.73662442, 66.36796519}}, Spin{6, 80, {7.35934711, 26.79098171, 66.60473479}},
        Spin{12, 10, {12.9657329, 35.40566858, 71.49504063}}, Spin{12, 20, {13.1240692, 37.05245123, 77.48768815}},
        Spin{12, 40, {13.15919946, 37.4662891, 79.07857464}}, Spin{12, 80, {13.16748014, 37.56907104, 79.48052353}}));

// Flap by hand: nodes held by their rotary inertia against the plane of the spin, tension in the loaded elements.
class Stretched : public Spinning, public ::testing::WithParamInterface<Spin> {
 protected:
  static std::vector<double> flap_by_hand(int n, double lambda, const std::vector<double>& x) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2), M = K;
    const Eigen::Matrix4d element = element_matrices({}, 1.0 / n).K;
    for (int k = 1; k <= n; ++k) {
      const double J = node(k, n).inertia();
      M(2 * k, 2 * k) = node(k, n).mass(), M(2 * k + 1, 2 * k + 1) = J;
      K(2 * k + 1, 2 * k + 1) += lambda * lambda * (1 - thin) * J;
      const auto at = static_cast<std::size_t>(k);
      add(K, loaded_stiffness(element, -tension(k, n, x, lambda), x[at] - x[at - 1]), k - 1);
    }
    std::vector<double> list;
    for (const auto& square : clamped_squares(K, M)) list.push_back(std::sqrt(-square.real()));
    return list;
  }
};

TEST_P(Stretched, beams_stretch_by_their_tension) {
  const auto [lambda, n, printed] = GetParam();
  const auto stiff = flap_by_hand(n, lambda, even(n));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(stiff[k], printed[k], 1e-8 * printed[k]);
  // Steady spin: EA (x_k − x_(k−1) − L)/L is the centrifugal force of all nodes from k on.
  const double EA = 1e5, L = 1.0 / n;
  Eigen::MatrixXd balance = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    balance(k, k) += EA / L;
    if (k > 0) balance(k, k - 1) -= EA / L;
    for (int j = k; j < n; ++j) balance(k, j) -= lambda * lambda * node(j + 1, n).mass();
  }
  const Eigen::VectorXd places = balance.partialPivLu().solve(Eigen::VectorXd::Constant(n, EA));
  std::vector<double> x{0};
  x.insert(x.end(), places.begin(), places.end());
  std::string s = hub(lambda);
  for (int k = 1; k <= n; ++k) {
    s += turning(k, n, x[static_cast<std::size_t>(k)], lambda) + beam(k, 10 + k, k == 1 ? 2 : 9 + k, L, EA);
  }
  const auto list = frequencies(s, "LINEAR/EIGENSOL, NOVECTOR, RM=2");
  const auto stretched = flap_by_hand(n, lambda, x);
  EXPECT_GT(std::abs(stretched[0] - stiff[0]), 1e-6 * stiff[0]);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(contains(list, stretched[k], 1e-9)) << stretched[k];
}
INSTANTIATE_TEST_SUITE_P(table, Stretched,
                         ::testing::Values(Spin{2, 20, {4.12995735, 22.43781639, 61.34737777}},
                                           Spin{12, 10, {12.9657329, 35.40566858, 71.49504063}},
                                           Spin{12, 20, {13.1240692, 37.05245123, 77.48768815}}));

TEST_F(Spinning, flap_frequencies_lead_to_those_of_the_continuous_beam) {
  const std::pair<double, std::array<double, 3>> rows[] = {{0, {3.51601527, 22.03449156, 61.69721441}},
                                                           {1, {3.68164682, 22.18101118, 61.84176259}},
                                                           {5, {6.44954474, 25.44608033, 65.20504052}},
                                                           {12, {13.17015049, 37.60311233, 79.61447849}}};
  for (const auto& [lambda, exact] : rows) {
    std::array<std::vector<double>, 3> series;
    for (const int n : {10, 20, 40}) {
      const auto list = unstretched(n, lambda);
      // Coarse values lie below by up to 7 % and apart from the lag frequencies by more.
      for (std::size_t k = 0; k < 3; ++k) series[k].push_back(nearest(list, exact[k]));
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(extrapolated(series[k]), exact[k], 1e-4 * exact[k]) << lambda;
  }
}

}  // namespace
}  // namespace dynalin::cases::beam_benchmark_test
