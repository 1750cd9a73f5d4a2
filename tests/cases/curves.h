// Curves for the cases: polynomials as CURVE statements, and models with one freedom.
#pragma once

#include <numbers>

#include "cases/chain.h"

namespace dynalin::cases {

inline std::string number(double x) { return fmt::format("{:.17g}", x); }

// A polynomial in u for each coordinate.
struct Polynomials {
  std::array<std::array<double, 4>, 3> a;

  Vector at(double u) const {
    const auto value = [&](const std::array<double, 4>& c) { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); };
    return {value(a[0]), value(a[1]), value(a[2])};
  }
  Vector slope(double u) const {
    const auto value = [&](const std::array<double, 4>& c) { return c[1] + u * (2 * c[2] + u * 3 * c[3]); };
    return {value(a[0]), value(a[1]), value(a[2])};
  }
  // As expressions of u.
  std::string text(std::size_t k, const std::string& u) const {
    return fmt::format("POLY({},0,{:.17g},{:.17g},{:.17g},{:.17g})", u, a[k][0], a[k][1], a[k][2], a[k][3]);
  }
  std::string slope_text(std::size_t k, const std::string& u) const {
    return fmt::format("POLY({},0,{:.17g},{:.17g},{:.17g})", u, a[k][1], 2 * a[k][2], 3 * a[k][3]);
  }
  // MATRIX and CURVE of that id through n points of it.
  std::string curve(int id, int n) const {
    std::string s = fmt::format("MATRIX/{}, FULL=RORDER, ROWS={}, COLUMNS=3, VALUES=", id, n);
    for (int i = 0; i < n; ++i) s += (i > 0 ? "\n, " : "") + xyz(at(-1 + 2.0 * i / (n - 1)));
    return s + fmt::format("\nCURVE/{}, OPEN, MATRIX={}, CURVE_POINTS\n", id, id);
  }
};

inline const Polynomials bow{{{{0.05, 0.4, 0.1, -0.05}, {0.1, -0.2, 0.3, 0.1}, {-0.1, 0.1, 0.05, 0.2}}}};

class CurveCases : public Cases {
 protected:
  std::vector<std::complex<double>> solve(const std::string& text, const std::string& commands = "") const {
    const RunResult r =
        run("Curves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + text + "END\n", commands + "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(commands.empty() ? 0 : 1) : std::vector<std::complex<double>>();
  }
  // The one frequency of a model with one freedom, rad per unit time.
  double frequency(const std::string& text, const std::string& commands = "") const {
    const auto values = solve(text, commands);
    EXPECT_EQ(values.size(), 2u);
    if (values.size() != 2u) return -1;
    EXPECT_NEAR(values[0].real(), 0, 1e-12);
    return 2 * std::numbers::pi * std::abs(values[0].imag());
  }
};

// y = a x² in the x-y plane of its marker, |x| ≤ 1.
inline std::string parabola(int id, double a, double height = 0) {
  return Polynomials{{{{0, 1, 0, 0}, {height, 0, a, 0}, {0, 0, 0, 0}}}}.curve(id, 5);
}

}  // namespace dynalin::cases
