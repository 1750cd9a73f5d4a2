// Columns under load: Euler's, whose load keeps its direction, and Beck's, whose load turns with the tip. The same
// discrete model is assembled by hand, and its critical loads lead to those of the continuous column.
#include "cases/beam_model.h"
#include "cases/beams.h"

namespace dynalin::cases::column_benchmark_test {
namespace {

enum class Load { dead, follower };

// A column of unit length, mass and bending stiffness about z, clamped at 0, with the force P at its end towards 0.
struct Column {
  Load load = Load::dead;
  int n = 1;
  double P = 0;
  double EA = 1e6;

  double arm() const { return (1 - P / EA) / n; }  // distance of neighbouring nodes in equilibrium

  // About y it is twice as stiff, so that the planes are told apart.
  std::string dataset() const {
    std::string s;
    for (int k = 1; k <= n; ++k) {
      Node here = node(k, n);
      here.x = arm() * k;
      s += here.text();
      s += fmt::format(
          "BEAM/{}, I={}, J={}, LENGTH={:.17g}, AREA=1, IXX=1E-3, IYY={:.17g}, IZZ={:.17g}, EMODULUS={:.17g}, "
          "GMODULUS=1E6\n",
          k, 10 + k, k == 1 ? 1 : 9 + k, 1.0 / n, 2 / EA, 1 / EA, EA);
    }
    return s + fmt::format("MARKER/2, PART=1, FLOATING\nVFORCE/1, I={}, JFLOAT=2, RM={}, FX={:.17g}\n", 10 + n,
                           load == Load::dead ? 1 : 10 + n, -P);
  }

  // λ² of bending in one plane, by hand. The tip's force is −P x of its own axes, or of ground: the follower has the
  // transverse component −P θ.
  std::vector<std::complex<double>> squares(double EI) const {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2), M = K;
    const Eigen::Matrix4d element = loaded_stiffness(element_matrices({.EI = EI}, 1.0 / n).K, P, arm());
    for (int k = 1; k <= n; ++k) {
      M(2 * k, 2 * k) = node(k, n).mass(), M(2 * k + 1, 2 * k + 1) = node(k, n).inertia();
      add(K, element, k - 1);
    }
    if (load == Load::follower) K(2 * n, 2 * n + 1) += P;
    return clamped_squares(K, M);
  }

  bool stable() const {
    const auto list = squares(1);
    return std::all_of(list.begin(), list.end(), [](auto s) { return s.real() < 0 && std::abs(s.imag()) < 1e-6; });
  }
  // The load at which the column by hand loses stability, between two others.
  static double critical(Load load, int n, double low, double high) {
    for (int k = 0; k < 45; ++k) {
      const double middle = (low + high) / 2;
      (Column{load, n, middle}.stable() ? low : high) = middle;
    }
    return low;
  }
};

class Columns : public Beams {
 protected:
  // The first eigenvalues of both planes are those of the model by hand, all four roots where they are complex.
  void agrees(const Column& column, std::size_t modes) const {
    const auto values = spectrum(column.dataset());
    for (const double EI : {1.0, 2.0}) {
      const auto squares = column.squares(EI);
      for (std::size_t k = 0; k < modes; ++k) {
        const auto root = std::sqrt(squares[k]);
        for (const auto& value : {root, -root}) {
          EXPECT_TRUE(contains(values, value, 1e-7)) << "P " << column.P << ", EI " << EI << ": " << value;
        }
      }
    }
  }
  bool grows(const Column& column) const {
    const auto values = spectrum(column.dataset());
    return std::any_of(values.begin(), values.end(), [](auto v) { return v.real() > 1e-4; });
  }
};

TEST_F(Columns, under_a_dead_load_buckle_where_a_frequency_reaches_zero) {
  for (const double P : {0.0, 1.0, 2.4, 2.6, 4.0}) agrees({Load::dead, 8, P}, 4);
  for (const double P : {2.0, 3.0}) agrees({Load::dead, 16, P}, 4);
  std::vector<double> loads;
  for (const int n : {4, 8, 16, 32}) {
    const double P = Column::critical(Load::dead, n, 1, 4);
    EXPECT_FALSE(grows({Load::dead, n, P * (1 - 1e-6)})) << n;
    EXPECT_TRUE(grows({Load::dead, n, P * (1 + 1e-6)})) << n;
    loads.push_back(P);
  }
  // π²/4 EI/L², times 1 + P/EA since the column is as much shorter when it buckles. The element looks from J, which
  // brings in odd powers of its length.
  const double pi = std::numbers::pi, euler = pi * pi / 4 * (1 + pi * pi / 4 / Column{}.EA);
  EXPECT_NEAR((loads[0] - euler) / (loads[1] - euler), 4, 0.3);
  EXPECT_NEAR((loads[1] - euler) / (loads[2] - euler), 4, 0.1);
  EXPECT_NEAR((loads[2] - euler) / (loads[3] - euler), 4, 0.05);
  EXPECT_NEAR(extrapolated(loads, Powers::all), euler, 1e-6 * euler);
}

TEST_F(Columns, under_a_follower_load_flutter_where_two_frequencies_meet) {
  // Below, at 19 and 25 not far from and beyond the meeting of the first two; never a zero frequency.
  for (const double P : {5.0, 15.0, 19.0, 25.0, 40.0}) agrees({Load::follower, 8, P}, 4);
  agrees({Load::follower, 16, 25}, 4);
  // Continuous column: 20.05 EI/L² (Beck 1952), at the frequency 11.02 √(EI/ρAL⁴).
  const double beck = 20.0509536, frequency = 11.0155;
  std::vector<double> loads;
  for (const int n : {8, 16, 32}) {
    const double P = Column::critical(Load::follower, n, 10, 30);
    EXPECT_FALSE(grows({Load::follower, n, P * (1 - 1e-4)})) << n;
    const auto values = spectrum(Column{Load::follower, n, P * (1 + 1e-4)}.dataset());
    const auto growing =
        std::max_element(values.begin(), values.end(), [](auto a, auto b) { return a.real() < b.real(); });
    EXPECT_GT(growing->real(), 1e-2) << n;
    EXPECT_NEAR(std::abs(growing->imag()), frequency, 25.0 / (n * n)) << n;
    loads.push_back(P);
  }
  EXPECT_NEAR((loads[0] - beck) / (loads[1] - beck), 4, 0.3);
  EXPECT_NEAR((loads[1] - beck) / (loads[2] - beck), 4, 0.1);
  EXPECT_NEAR(extrapolated(loads, Powers::all), beck, 1e-4 * beck);
}

}  // namespace
}  // namespace dynalin::cases::column_benchmark_test
