#include "selected_modes/selected_modes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "selected_modes/selection_of_modes.h"
#include "system/model_test_support.h"

namespace dynalin::selected_modes_test {
namespace {

struct Selected {
  std::shared_ptr<const System> system;
  Perturbation perturbation;
  EigenSolution solution;
};
Selected selected_of_text(const std::string& text, const ModeSelection& wanted) {
  Selected s;
  s.system = system_test::system_of(text);
  Findings findings;
  const auto op = initial_conditions(*s.system, findings);
  if (!op) throw std::runtime_error(op.error().message);
  auto perturbation = perturb(*s.system, *op, {});
  if (!perturbation) throw std::runtime_error(perturbation.error().message);
  s.perturbation = std::move(*perturbation);
  auto solution = eigensolve_selected(*s.system, s.perturbation, wanted);
  if (!solution) throw std::runtime_error(solution.error().message);
  s.solution = std::move(*solution);
  return s;
}

// Point masses of 1 at the inner points of a grid, each tied to its six neighbours by 1E4 in all directions.
std::string lattice(int nx, int ny, int nz) {
  std::string masses, ties;
  int tie = 0, wall = 1000000;
  const auto at = [&](int i, int j, int k) { return 2 + ((i - 1) * ny + j - 1) * nz + k - 1; };
  const auto inside = [&](int i, int j, int k) { return i >= 1 && j >= 1 && k >= 1 && i <= nx && j <= ny && k <= nz; };
  for (int i = 1; i <= nx; ++i) {
    for (int j = 1; j <= ny; ++j) {
      for (int k = 1; k <= nz; ++k) {
        const int own = at(i, j, k);
        masses += fmt::format("POINT_MASS/{0}, MASS=1, QG={1},{2},{3}\nMARKER/{0}, POINT_MASS={0}\n", own, i, j, k);
        for (int direction = 0; direction < 6; ++direction) {
          const int step = direction < 3 ? 1 : -1;
          const int a = i + (direction % 3 == 0) * step, b = j + (direction % 3 == 1) * step,
                    c = k + (direction % 3 == 2) * step;
          const bool neighbour = inside(a, b, c);
          if (neighbour && step < 0) continue;
          const int other = neighbour ? at(a, b, c) : ++wall;
          if (!neighbour) ties += fmt::format("MARKER/{}, PART=1, QP={},{},{}\n", other, a, b, c);
          ties += fmt::format("BUSHING/{}, I={}, J={}, K=1E4,1E4,1E4\n", ++tie, own, other);
        }
      }
    }
  }
  return masses + ties;
}

// Masses that do not know of each other on a spring each, or free, with these frequencies.
std::string masses_on_springs(const std::vector<double>& frequencies) {
  std::string text;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    text += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=1,1,1, QG={0},0,0\nMARKER/{0}0\nMARKER/{0}1, PART=1, QP={0},0,0\n"
        "JOINT/{0}, TRANSLATIONAL, I={0}0, J={0}1\nBUSHING/{0}, I={0}0, J={0}1, K=0,0,{1:.17g}\n",
        k + 2, std::pow(2 * std::numbers::pi * frequencies[k], 2));
  }
  return text;
}

// From NEAR, or the top of a band, 1/(ω² − σ) has no digits of what is far below.
TEST(SelectedModes, far_below_where_they_are_looked_for_are_as_exact_as_others) {
  const std::vector<double> all = {4e-4, 9e-4, 1.1e-3, 1, 1e6}, two = {1, 1e6};
  for (const bool beside_free_ones : {false, true}) {
    std::vector<double> of_model = all;
    if (beside_free_ones) of_model.insert(of_model.begin(), 3, 0.0);
    // What differs by less than 1e-9 of NEAR is equally near.
    for (const auto& [wanted, expected] :
         {std::pair(ModeSelection(NearestModes{3, 1e6}), all), std::pair(ModeSelection(NearestModes{2, 1e6}), two),
          std::pair(ModeSelection(ModesInBand{2e-4, 2e6}), all), std::pair(ModeSelection(ModesInBand{0, 2e6}), all)}) {
      const Selected s = selected_of_text(masses_on_springs(of_model), wanted);
      std::vector<EigenMode> found = s.solution.modes;
      std::erase_if(found, [](const EigenMode& m) { return m.structural_zero; });
      EXPECT_EQ(s.solution.modes.size() - found.size(), beside_free_ones ? 6u : 0u);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const EigenMode& m = found[k];
        EXPECT_LE(std::abs(m.eigenvalue_hz - std::complex<double>(0, expected[k])),
                  m.error_bound_hz + 1e-15 * expected[k]);
        EXPECT_LE(m.error_bound_hz, 1e-12 * expected[k]);
      }
      EXPECT_TRUE(s.solution.selected->complete);
    }
  }
}

// Beyond the full solution it is said that they are not told apart, and bounds hold all the same: also where vectors
// are mixed with those of others and of a zero.
TEST(SelectedModes, that_are_too_far_below_in_large_models_are_not_complete) {
  constexpr int masses = 502;
  const std::vector<double> shares = {1.8164722e-06, 1.9651045e-06, 4.8211149e-06,
                                      1.6253595e-05, 2.6548406e-05, 3.1828140e-05,
                                      7.6760553e-05, 8.5208462e-05, 0};
  for (const double near : {32.648765951252614, 1e5}) {
    std::string text;
    for (std::size_t k = 0; k < masses; ++k) {
      std::string stiffness;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t place = 3 * k + axis;
        const double f = near * (place < shares.size() ? shares[place] : 10 + 0.005 * static_cast<double>(place));
        stiffness += fmt::format("{}{:.17g}", axis == 0 ? "" : ",", std::pow(2 * std::numbers::pi * f, 2));
      }
      text += fmt::format(
          "POINT_MASS/{0}, MASS=1, QG={0},0,0\nMARKER/{0}0, POINT_MASS={0}\nMARKER/{0}1, PART=1, QP={0},0,0\n"
          "BUSHING/{0}, I={0}0, J={0}1, K={1}\n",
          k + 2, stiffness);
    }
    const Selected s = selected_of_text(text, NearestModes{8, near});
    EXPECT_FALSE(s.solution.selected->complete);
    if (near == 1e5) {
      EXPECT_NE(s.solution.selected->doubt.find("so far below"), std::string::npos) << s.solution.selected->doubt;
    }
    EXPECT_EQ(modes_in(s.solution), shares.size() - 1);
    for (const EigenMode& m : s.solution.modes) {
      if (m.structural_zero) continue;
      const bool held = std::ranges::any_of(shares, [&](double share) {
        const double f = near * share;
        return f > 0 && std::abs(m.eigenvalue_hz - std::complex<double>(0, f)) <= m.error_bound_hz + 1e-15 * f;
      });
      EXPECT_TRUE(held) << m.eigenvalue_hz << " +- " << m.error_bound_hz;
    }
  }
}

// Values that differ by 5e-11 of themselves, with a border between them.
TEST(SelectedModes, beyond_the_border_of_a_band_by_more_than_their_bounds_are_not_in_it) {
  std::vector<double> frequencies;
  for (int k = 0; k < 8; ++k) frequencies.push_back(1.5 * (1 + 5e-11 * k));
  for (const auto& [band, first, count] : {std::tuple(ModesInBand{0, 1.5 * (1 + 2.5e-11)}, 0u, 1u),
                                           std::tuple(ModesInBand{1.5 * (1 + 12.5e-11), 3}, 3u, 5u)}) {
    const Selected s = selected_of_text(masses_on_springs(frequencies), band);
    ASSERT_EQ(s.solution.modes.size(), count);
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_NEAR(s.solution.modes[k].eigenvalue_hz.imag(), frequencies[first + k], 1e-13);
    EXPECT_EQ(s.solution.selected->found, 2 * count);
    EXPECT_EQ(s.solution.selected->counted, 2 * count);
    EXPECT_TRUE(s.solution.selected->complete);
  }
}

TEST(SelectedModes, of_a_lattice_have_all_their_multiplicities) {
  constexpr int n = 4;
  const double pi = std::numbers::pi;
  std::vector<double> exact;
  for (int i = 1; i <= n; ++i) {
    for (int j = 1; j <= n; ++j) {
      for (int k = 1; k <= n; ++k) {
        double sum = 0;
        for (const int m : {i, j, k}) sum += std::pow(std::sin(m * pi / 2 / (n + 1)), 2);
        exact.insert(exact.end(), 3, std::sqrt(4e4 * sum) / 2 / pi);
      }
    }
  }
  std::sort(exact.begin(), exact.end());
  // Three in x, y and z, nine more by symmetry, of which the selection takes all.
  const Selected s = selected_of_text(lattice(n, n, n), NearestModes{7, 0});
  ASSERT_EQ(s.solution.modes.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_NEAR(s.solution.modes[k].eigenvalue_hz.imag(), exact[k], 1e-12 * exact[k]) << k;
    EXPECT_EQ(s.solution.modes[k].eigenvalue_hz.real(), 0) << k;
    EXPECT_LE(s.solution.modes[k].error_bound_hz, 1e-10 * exact[k]) << k;
  }
  ASSERT_TRUE(s.solution.selected);
  EXPECT_TRUE(s.solution.selected->complete);
  EXPECT_EQ(s.solution.selected->found, 24u);
  EXPECT_EQ(s.solution.selected->counted, 24u);
  EXPECT_EQ(s.solution.selected->by, CountedBy::inertia);
  const double radius = s.solution.selected->radius_hz;
  EXPECT_TRUE(radius > exact[11] && radius < exact[12]);
  // The vectors of equal values are independent.
  const Eigen::MatrixXcd v = s.solution.vectors;
  EXPECT_GT(Eigen::MatrixXcd(v.adjoint() * v).ldlt().vectorD().cwiseAbs().minCoeff(), 1e-8);
}

// m λ² + c s λ + k s = 0, all of them real and many of them equal: the QR iteration computes some of these as pairs
// next to the axis. Each has a bound, and a vector that is real.
TEST(SelectedModes, of_an_overdamped_lattice_are_real_and_have_bounds) {
  constexpr int n = 4;
  std::vector<double> exact;
  for (int i = 1; i <= n; ++i) {
    for (int j = 1; j <= n; ++j) {
      for (int k = 1; k <= n; ++k) {
        double s = 0;
        for (const int m : {i, j, k}) s += 4 * std::pow(std::sin(m * std::numbers::pi / 2 / (n + 1)), 2);
        const double fast = -20 * s - std::sqrt(400 * s * s - 100 * s);
        for (const double value : {100 * s / fast, fast}) exact.insert(exact.end(), 3, value / 2 / std::numbers::pi);
      }
    }
  }
  std::ranges::sort(exact, std::greater<>());
  const std::string text =
      std::regex_replace(lattice(n, n, n), std::regex("K=1E4,1E4,1E4"), "K=100,100,100, C=40,40,40");
  const Selected s = selected_of_text(text, NearestModes{7, 0});
  const auto linear = reduce(*s.system, s.perturbation);
  ASSERT_TRUE(linear);
  const auto all = eigensolve(*linear);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->modes.size(), exact.size());
  EXPECT_EQ(s.solution.modes.size(), 12u);
  EXPECT_TRUE(s.solution.selected->complete);
  for (const EigenSolution* solution : {&*all, &s.solution}) {
    for (std::size_t k = 0; k < solution->modes.size(); ++k) {
      const EigenMode& m = solution->modes[k];
      EXPECT_NEAR(m.eigenvalue_hz.real(), exact[k], m.error_bound_hz + 1e-15 * std::abs(exact[k])) << k;
      EXPECT_LE(m.error_bound_hz, 1e-9 * std::abs(exact[k])) << k;
      EXPECT_TRUE(m.is_real) << k;
      EXPECT_EQ(solution->vectors.col(static_cast<Eigen::Index>(k)).imag().norm(), 0) << k;
    }
  }
}

// A free row, whose zeros stand in chains: from a shift near these, modes have few digits left.
TEST(SelectedModes, of_a_free_row_are_as_exact_as_those_of_one_that_is_held) {
  constexpr int n = 150;
  constexpr double stiffness = 1e8, damping = 0.01;
  std::string text;
  for (int k = 0; k < n; ++k) {
    text += fmt::format("POINT_MASS/{0}, MASS=1\nMARKER/{0}, POINT_MASS={0}\n", k + 2);
    if (k > 0)
      text += fmt::format("BUSHING/{0}, I={0}, J={1}, K={2:.0f},{2:.0f},{2:.0f}, C={3},{3},{3}\n", k + 2, k + 1,
                          stiffness, damping);
  }
  const Selected s = selected_of_text(text, NearestModes{1, 0});
  EXPECT_EQ(s.solution.selected->by, CountedBy::winding_number);
  const double square = 4 * std::pow(std::sin(std::numbers::pi / (2 * n)), 2), re = -damping * square / 2;
  const std::complex<double> exact =
      std::complex<double>(re, std::sqrt(stiffness * square - re * re)) / (2 * std::numbers::pi);
  ASSERT_EQ(modes_in(s.solution), 3u);
  for (const EigenMode& m : s.solution.modes) {
    if (m.structural_zero) continue;
    EXPECT_NEAR(m.eigenvalue_hz.real(), exact.real(), 1e-10 * std::abs(exact.real()));
    EXPECT_NEAR(m.eigenvalue_hz.imag(), exact.imag(), 1e-13 * exact.imag());
    EXPECT_LE(m.error_bound_hz, 1e-12 * exact.imag());
  }
}

// Copies of a mechanism that do not know of each other: a Krylov space sees one of each.
TEST(SelectedModes, of_twins_are_found_twice) {
  std::string text;
  for (int twin = 0; twin < 2; ++twin) {
    for (int k = 1; k <= 8; ++k) {
      const int id = 100 * (twin + 1) + k;
      text += fmt::format(
          "PART/{0}, MASS=2, CM={0}0, IP=1,1,1, QG={1},0,0\nMARKER/{0}0\nJOINT/{0}, TRANSLATIONAL, I={0}1, J={0}2\n"
          "MARKER/{0}1, REULER=90D,90D,0\nMARKER/{0}2, PART=1, QP={1},0,0, REULER=90D,90D,0\n"
          "SPRINGDAMPER/{0}, TRANSLATION, I={0}3, J={2}, K=100, C=0.1, LENGTH=1\nMARKER/{0}3\n",
          id, k, k == 1 ? std::string("1") : fmt::format("{}3", id - 1));
    }
  }
  for (const ModeSelection& wanted :
       {ModeSelection(NearestModes{5, 0}), ModeSelection(NearestModes{4, 1.0}), ModeSelection(ModesInBand{0.3, 1.2})}) {
    const Selected s = selected_of_text(text, wanted);
    const auto& modes = s.solution.modes;
    ASSERT_GE(modes.size(), 4u);
    ASSERT_EQ(modes.size() % 2, 0u);
    for (std::size_t k = 0; k < modes.size(); k += 2)
      EXPECT_LE(std::abs(modes[k].eigenvalue_hz - modes[k + 1].eigenvalue_hz),
                modes[k].error_bound_hz + modes[k + 1].error_bound_hz);
    EXPECT_TRUE(s.solution.selected->complete);
  }
}

// Six free motions and their drifts beside a spring between two bodies, with more states than a state matrix is formed
// of for the sake of zeros.
TEST(SelectedModes, come_with_the_structural_zeros_of_a_free_row_of_bodies) {
  std::string text = "PART/2, MASS=2, CM=20, IP=1,2,3\nMARKER/20\n";
  constexpr int n = 30;
  for (int k = 3; k < n + 2; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=1,2,3, QG={1},0,0\nMARKER/{0}0\n"
        "BUSHING/{0}, I={0}0, J={2}0, K=100,200,300, KT=10,20,30, C=.1,.1,.1, CT=.1,.1,.1\n",
        k, 0.01 * (k - 2), k - 1);
  }
  const Selected s = selected_of_text(text, NearestModes{4, 0});
  std::size_t zeros = 0;
  for (const EigenMode& m : s.solution.modes) zeros += m.structural_zero;
  const auto linear = reduce(*s.system, s.perturbation);
  ASSERT_TRUE(linear);
  const auto all = eigensolve(*linear);
  ASSERT_TRUE(all);
  std::size_t of_all = 0;
  for (const EigenMode& m : all->modes) of_all += m.structural_zero;
  EXPECT_GE(of_all, 6u);
  EXPECT_EQ(zeros, of_all);
  EXPECT_EQ(s.solution.modes.size(), zeros + 4);
  EXPECT_TRUE(s.solution.selected->complete);
}

// All eigenvalues that there are, as many as states, of so many equations that a count would cost something.
TEST(SelectedModes, that_are_everything_are_complete_without_a_count) {
  std::string text =
      "ACCGRAV/KGRAV=-9.81\nMARKER/2, PART=1, REULER=0,90D,0\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,-1\nMARKER/20\n"
      "MARKER/21, PART=2, QP=0,0,1, REULER=0,90D,0\nJOINT/1, REVOLUTE, I=21, J=2\n";
  for (int k = 3; k < 503; ++k) {
    text += fmt::format("PART/{0}, MASS=1, CM={0}0, IP=1,1,1\nMARKER/{0}0\nJOINT/{0}, FIXED, I={0}0, J=1\n", k);
  }
  const Selected s = selected_of_text(text, NearestModes{20, 0});
  ASSERT_EQ(s.solution.modes.size(), 1u);
  EXPECT_NEAR(s.solution.modes[0].eigenvalue_hz.imag(), std::sqrt(2 * 9.81 / 3) / (2 * std::numbers::pi), 1e-12);
  EXPECT_TRUE(s.solution.selected->complete);
  EXPECT_EQ(s.solution.selected->by, CountedBy::full_solution);
  EXPECT_EQ(s.solution.selected->found, 2u);
  EXPECT_EQ(s.solution.selected->counted, 2u);
}

// A turning shaft of BEAMs in damped bearings: nothing is symmetric and everything is damped or turns. Values are those
// of the full solution, in a band and around a frequency, and every one of them.
TEST(SelectedModes, of_a_turning_damped_shaft_are_those_of_the_full_solution) {
  constexpr int n = 30;
  constexpr double spin = 100, d = 0.1, length = 2, h = length / n, pi = std::numbers::pi;
  constexpr double area = pi * d * d / 4, I = area * d * d / 16;
  std::string text;
  for (int k = 0; k <= n; ++k) {
    const double m = 7810 * area * h + (k % 10 == 5 ? 20 : 0);
    text += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}, IP={2:.17g},{3:.17g},{3:.17g}, QG={4:.17g},0,0, WX={5}\n"
        "MARKER/{0}\n",
        k + 2, m, 0.02 * m, 0.01 * m, h * k, spin);
    if (k > 0) {
      text += fmt::format(
          "BEAM/{0}, I={1}, J={2}, LENGTH={3:.17g}, AREA={4:.17g}, IXX={5:.17g}, IYY={6:.17g}, "
          "IZZ={6:.17g}, EMODULUS=211E9, GMODULUS=81.2E9, CRATIO=1E-5\n",
          k, k + 2, k + 1, h, area, 2 * I, I);
    }
  }
  for (const int k : {0, n}) {
    text += fmt::format(
        "MARKER/{0}, PART=1, QP={1:.17g},0,0\nMARKER/{2}, PART={3}\n"
        "BUSHING/{0}, I={2}, J={0}, K=1E6,1E8,2E8, C=0,1E4,2E4, KT=1E6,0,0\n",
        1000 + k, h * k, 2000 + k, k + 2);
  }
  const Selected band = selected_of_text(text, ModesInBand{20, 200}),
                 near = selected_of_text(text, NearestModes{5, 90});
  const auto linear = reduce(*band.system, band.perturbation);
  ASSERT_TRUE(linear);
  ASSERT_EQ(linear->A.rows(), 12 * (n + 1));
  const auto all = eigensolve(*linear);
  ASSERT_TRUE(all);
  std::vector<EigenMode> inside, nearest = all->modes;
  for (const EigenMode& m : all->modes) {
    const double f = m.eigenvalue_hz.imag();
    if (f >= 20 && f <= 200 && std::abs(m.eigenvalue_hz.real()) <= 200) inside.push_back(m);
  }
  const auto distance = [](const EigenMode& m) { return std::abs(m.eigenvalue_hz - std::complex<double>(0, 90)); };
  std::ranges::stable_sort(nearest, {}, distance);
  nearest.resize(5);
  EXPECT_GE(inside.size(), 4u);
  for (const auto& [found, expected] : {std::pair(&band, inside), std::pair(&near, nearest)}) {
    EXPECT_TRUE(found->solution.selected->complete);
    EXPECT_EQ(found->solution.modes.size(), expected.size());
    for (const EigenMode& m : expected) {
      const bool there = std::ranges::any_of(found->solution.modes, [&](const EigenMode& f) {
        return std::abs(f.eigenvalue_hz - m.eigenvalue_hz) <= f.error_bound_hz + m.error_bound_hz;
      });
      EXPECT_TRUE(there) << m.eigenvalue_hz.real() << " " << m.eigenvalue_hz.imag();
    }
    for (const EigenMode& f : found->solution.modes)
      EXPECT_LE(f.error_bound_hz, 1e-8 * std::abs(f.eigenvalue_hz)) << f.eigenvalue_hz.imag();
  }
}

}  // namespace
}  // namespace dynalin::selected_modes_test
