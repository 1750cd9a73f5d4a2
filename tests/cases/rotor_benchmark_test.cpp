// Rotors made of parts and BEAMs: an overhung disc on a massless shaft, and two discs on a heavy shaft in isotropic
// bearings (Friswell, Penny, Garvey, Lees, Dynamics of Rotating Machines, examples 5.9.1 and 5.9.5), against published
// values, the same models assembled by hand, and the limit of ever shorter elements.
#include "cases/beam_model.h"
#include "cases/beams.h"

namespace dynalin::cases::rotor_benchmark_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST_F(Beams, overhung_disc_whirls) {
  const double d = 0.02, I = pi * std::pow(d, 4) / 64;
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
                                spin, pi * d * d / 4, 2 * I, I));
    for (const double value : expected) EXPECT_TRUE(contains(list, value, 1e-10)) << spin << ": " << value;
  }
}

struct Rotor {
  int n;  // elements, a multiple of 3
  double rpm, bearing_damping = 0;

  static constexpr double E = 211e9, G = 81.2e9, rho = 7810, d = 0.05, L = 1.5, bearing = 1e6;
  double A() const { return pi * d * d / 4; }
  double I() const { return pi * std::pow(d, 4) / 64; }
  double kappa() const {
    const double nu = E / (2 * G) - 1;
    return 6 * (1 + nu) / (7 + 6 * nu);
  }
  double spin() const { return rpm * pi / 30; }
  double h() const { return L / n; }

  struct Lump {
    double m = 0, J = 0, polar = 0;
  };
  // Discs 0.07 thick on the shaft.
  Lump disc(int k) const {
    const double D = 3 * k == n ? 0.28 : 3 * k == 2 * n ? 0.35 : d, thickness = 0.07;
    const double m = rho * pi / 4 * (D * D - d * d) * thickness;
    return {m, m / 48 * (3 * (D * D + d * d) + 4 * thickness * thickness), m / 8 * (D * D + d * d)};
  }
  Lump node(int k) const {
    const double half = h() / 2, sides = k == 0 || k == n ? 1 : 2;
    Lump sum = disc(k);
    sum.m += sides * rho * A() * half;
    sum.J += sides * (rho * A() * half * half * half / 3 + rho * I() * half);
    sum.polar += sides * 2 * rho * I() * half;
    return sum;
  }

  std::string dataset() const {
    std::string s;
    for (int k = 0; k <= n; ++k) {
      const auto [m, J, polar] = node(k);
      const double x = h() * k;
      s += fmt::format(
          "PART/{0}, MASS={1:.17g}, CM={0}, IP={2:.17g},{3:.17g},{3:.17g}, QG={4:.17g},0,0, VX=0, VY=0, VZ=0, "
          "WX={5:.17g}, WY=0, WZ=0\nMARKER/{0}\n",
          10 + k, m, polar, J, x, spin());
      if (k > 0) {
        s += fmt::format(
            "BEAM/{}, I={}, J={}, LENGTH={:.17g}, AREA={:.17g}, IXX={:.17g}, IYY={:.17g}, IZZ={:.17g}, EMODULUS={}, "
            "GMODULUS={}, ASY={:.17g}, ASZ={:.17g}\n",
            k, 10 + k, 9 + k, h(), A(), 2 * I(), I(), I(), E, G, 1 / kappa(), 1 / kappa());
      }
      if (k == 0 || k == n) {
        s += fmt::format("MARKER/{0}, PART=1, QP={1:.17g},0,0\nBUSHING/{0}, I={2}, J={0}, K=0,{3},{3}, C=0,{4},{4}\n",
                         2 + (k > 0), x, 10 + k, bearing, bearing_damping);
      }
    }
    return s;
  }

  enum class Mass { lumped, consistent };

  // By hand: z = y + i w and its slope in each node, M z″ + (C − iΩP) z′ + K z = 0. Forward whirl has Im λ > 0.
  std::vector<std::complex<double>> by_hand(Mass mass) const {
    const auto size = 2 * n + 2;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size), M = K, P = K, C = K;
    const auto e = element_matrices({E * I(), E * I() / (kappa() * G * A()), rho * A(), rho * I()}, h());
    for (int k = 0; k <= n; ++k) {
      const Lump lump = mass == Mass::lumped ? node(k) : disc(k);
      M(2 * k, 2 * k) += lump.m, M(2 * k + 1, 2 * k + 1) += lump.J, P(2 * k + 1, 2 * k + 1) += lump.polar;
      if (k == n) continue;
      add(K, e.K, k);
      if (mass == Mass::consistent) add(M, e.M, k), add(P, e.P, k);
    }
    for (const int end : {0, 2 * n}) K(end, end) += bearing, C(end, end) += bearing_damping;
    // As 1/λ of the inverse companion matrix, which has the low frequencies to all digits.
    const std::complex<double> i(0, 1);
    Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(2 * size, 2 * size);
    const auto flexibility = K.partialPivLu();
    A.topLeftCorner(size, size) = -flexibility.solve(C) + i * spin() * flexibility.solve(P);
    A.topRightCorner(size, size) = -flexibility.solve(M);
    A.bottomLeftCorner(size, size).setIdentity();
    const Eigen::VectorXcd values = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(A, false).eigenvalues().cwiseInverse();
    return {values.begin(), values.end()};
  }
};

std::complex<double> nearest_to(const std::vector<std::complex<double>>& list, std::complex<double> value) {
  return *std::min_element(list.begin(), list.end(),
                           [&](auto a, auto b) { return std::abs(a - value) < std::abs(b - value); });
}
// The first eigenvalues with Im λ > 0 of either whirl, ascending.
std::vector<std::complex<double>> lowest(std::vector<std::complex<double>> list, std::size_t count) {
  for (auto& v : list) v = {v.real(), std::abs(v.imag())};
  std::sort(list.begin(), list.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
  std::erase_if(list, [](auto v) { return v.imag() < 1; });
  list.resize(std::min(count, list.size()));
  return list;
}

class TwoDiscs : public Beams {};

TEST_F(TwoDiscs, whirl_at_four_thousand_revolutions) {
  const std::pair<int, std::array<double, 4>> rows[] = {{6, {85.4065239, 87.82100755, 250.64621295, 293.27699564}},
                                                        {12, {85.39376502, 87.80216432, 251.50066510, 294.35330821}},
                                                        {24, {85.39047629, 87.79736492, 251.71079574, 294.61799974}},
                                                        {48, {85.38964791, 87.79615952, 251.76310606, 294.68389311}}};
  for (const auto& [n, expected] : rows) {
    const auto list = frequencies(Rotor{n, 4000}.dataset());
    for (const double value : expected) EXPECT_TRUE(contains(list, value, 1e-8)) << n << ": " << value;
  }
}

TEST_F(TwoDiscs, have_the_bending_eigenvalues_of_the_model_by_hand_with_and_without_damping) {
  for (const Rotor& rotor :
       {Rotor{6, 0}, Rotor{6, 2000}, Rotor{6, 4000, 3e3}, Rotor{12, 4000, 3e3}, Rotor{6, 9000, 500}}) {
    const auto values = spectrum(rotor.dataset());
    std::size_t compared = 0;
    for (const auto& expected : rotor.by_hand(Rotor::Mass::lumped)) {
      if (std::abs(expected) > 5000) continue;  // by hand these come with fewer digits
      ++compared;
      for (const auto& value : {expected, std::conj(expected)}) {
        EXPECT_LE(std::abs(nearest_to(values, value) - value), 1e-8 * std::abs(value)) << value;
      }
    }
    EXPECT_GE(compared, 12u);
  }
}

// The published model has consistent mass: the hand's matrices have its values, and elements of either kind lead to
// the same limit.
TEST_F(TwoDiscs, lead_to_the_limit_of_the_published_model) {
  using Complex = std::complex<double>;
  const std::pair<Rotor, std::vector<Complex>> rows[] = {
      {{6, 0}, {{0, 86.658114351}, {0, 86.658114351}, {0, 274.312853913}, {0, 274.312853913}, {0, 716.786312207}}},
      {{6, 2000},
       {{0, 86.041462884},
        {0, 87.242095465},
        {0, 263.282375801},
        {0, 284.801086564},
        {0, 657.499261357},
        {0, 774.399078697}}},
      {{6, 4000},
       {{0, 85.389466997},
        {0, 87.795863704},
        {0, 251.784604130},
        {0, 294.713330871},
        {0, 600.179361954},
        {0, 827.075361927}}},
      {{48, 4000},
       {{0, 85.3893717}, {0, 87.7957578}, {0, 251.7805433}, {0, 294.7058701}, {0, 600.0817961}, {0, 826.6589683}}},
      {{6, 4000, 3e3},
       {{-4.083081144, 85.965809537},
        {-4.741739614, 88.414705855},
        {-74.101769274, 263.786350643},
        {-78.810421954, 318.235036257},
        {-402.590858537, 655.012042921}}}};
  for (const auto& [rotor, published] : rows) {
    const auto hand = lowest(rotor.by_hand(Rotor::Mass::consistent), 8);
    for (const auto& value : published) {
      EXPECT_LE(std::abs(nearest_to(hand, value) - value), rotor.n == 48 ? 6e-8 : 1e-10 * std::abs(value)) << value;
    }
    // At that speed the limit is looked at with six elements published.
    if (rotor.n == 48) continue;
    const auto limit = lowest(Rotor{48, rotor.rpm, rotor.bearing_damping}.by_hand(Rotor::Mass::consistent), 8);
    std::vector<std::vector<double>> real(published.size()), imag(published.size());
    for (const int n : {9, 18, 36}) {
      const auto values = spectrum(Rotor{n, rotor.rpm, rotor.bearing_damping}.dataset());
      for (std::size_t k = 0; k < published.size(); ++k) {
        const Complex value = nearest_to(values, nearest_to(limit, published[k]));
        real[k].push_back(value.real()), imag[k].push_back(value.imag());
      }
    }
    for (std::size_t k = 0; k < published.size(); ++k) {
      const Complex expected = nearest_to(limit, published[k]);
      // Nine elements are too few for the third pair, which also comes close to a mode along the shaft.
      if (std::abs(expected) > 400) continue;
      EXPECT_LE(std::abs(Complex(extrapolated(real[k]), extrapolated(imag[k])) - expected), 1e-6 * std::abs(expected))
          << expected;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::rotor_benchmark_test
