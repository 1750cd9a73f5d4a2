// The stated error bounds for defective, clustered and badly scaled eigenvalues: between exact and printed ones there
// is a bijection in which each is within its bound.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>

#include "eigenvalues/eigen.h"
#include "elements/catalogue.h"
#include "precision/precise.h"

namespace dynalin::precision::defective_test {
namespace {

using Long = Finer;
using Exact = FinerValue;
using Integers = Eigen::MatrixXd;  // of entries that are exact
using Random = std::mt19937_64;

int draw(Random& random, int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }

struct Drawn {
  std::string text;
  std::optional<std::vector<std::complex<double>>> spectrum;  // known by construction; else computed
};

std::string controller(std::string_view elements) {
  return fmt::format("controller\nPART/1, GROUND\n{}END\n", elements);
}

Drawn state_equation(const Eigen::MatrixXd& A, std::optional<std::vector<std::complex<double>>> spectrum = {}) {
  std::string s =
      fmt::format("ARRAY/2, X\nLSE/1, X=2, A=1\nMATRIX/1, FULL=RORDER, ROWS={0}, COLUMNS={0}, VALUES=", A.rows());
  for (Eigen::Index r = 0; r < A.rows(); ++r) {
    for (Eigen::Index c = 0; c < A.cols(); ++c) {
      s += fmt::format("{}{:.17g}", r + c ? "," : "", A(r, c));
      if (r + c && (r * A.cols() + c) % 4 == 3 && r * A.cols() + c + 1 < A.size()) s += "\n";
    }
  }
  // A line is continued by a leading comma.
  for (std::size_t at = s.find("\n,"); at != std::string::npos; at = s.find("\n,", at + 1)) s.replace(at, 2, "\n, ");
  return {controller(s + "\n"), std::move(spectrum)};
}

// Coefficients of ascending powers of Π (s − root).
std::vector<double> polynomial(const std::vector<int>& roots) {
  std::vector<double> c{1};
  for (const int root : roots) {
    c.insert(c.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] -= root * c[k + 1];
  }
  return c;
}
std::vector<std::complex<double>> as_complex(const std::vector<int>& roots) { return {roots.begin(), roots.end()}; }

Drawn transfer_function(const std::vector<int>& roots) {
  std::string s =
      "VARIABLE/1, FUNCTION=0\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\nTFSISO/1, U=1, X=2, Y=3, NUM=1, DEN=";
  const std::vector<double> c = polynomial(roots);
  for (std::size_t k = 0; k < c.size(); ++k) s += fmt::format("{}{:.17g}", k ? "," : "", c[k]);
  return {controller(s + "\n"), as_complex(roots)};
}

// Of size at most `most`, roots repeated.
std::vector<int> repeated_roots(Random& random, int most) {
  std::vector<int> roots;
  const int wanted = draw(random, 2, most);
  while (static_cast<int>(roots.size()) < wanted) {
    const int root = draw(random, -4, 2), times = draw(random, 1, wanted);
    for (int k = 0; k < times && static_cast<int>(roots.size()) < wanted; ++k) roots.push_back(root == 0 ? -1 : root);
  }
  return roots;
}

Eigen::MatrixXd companion(const std::vector<int>& roots) {
  const std::vector<double> c = polynomial(roots);
  const auto n = static_cast<Eigen::Index>(roots.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k + 1 < n; ++k) A(k, k + 1) = 1;
  for (Eigen::Index k = 0; k < n; ++k) A(n - 1, k) = -c[static_cast<std::size_t>(k)];
  return A;
}

// P J P⁻¹ with steps of elimination in integers: every entry is exact.
Drawn jordan_blocks(Random& random, int most) {
  std::vector<int> roots;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(most, most);
  Eigen::Index n = 0;
  while (n < most && (n == 0 || draw(random, 0, 2) > 0)) {
    const int k = draw(random, 1, most - static_cast<int>(n)),
              root = draw(random, 0, 1) ? -draw(random, 1, 3) : draw(random, 1, 3);
    for (int a = 0; a < k; ++a, ++n) {
      A(n, n) = root;
      if (a) A(n - 1, n) = 1;
      roots.push_back(root);
    }
  }
  A.conservativeResize(n, n);
  for (int step = 0; step < 3 * n; ++step) {
    const Eigen::Index i = draw(random, 0, static_cast<int>(n) - 1), j = draw(random, 0, static_cast<int>(n) - 1);
    if (i == j) continue;
    const Eigen::MatrixXd before = A;
    const double f = draw(random, 0, 1) ? 1 : -1;
    A.row(i) += f * A.row(j);
    A.col(j) -= f * A.col(i);
    if (A.cwiseAbs().maxCoeff() > 1e6) A = before;
  }
  return {state_equation(A, as_complex(roots))};
}

// Blocks [a b; −b a] with ones above.
Drawn complex_jordan_blocks(Random& random, int pairs) {
  const int n = 2 * pairs, a = -draw(random, 1, 3), b = draw(random, 1, 5);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  std::vector<std::complex<double>> spectrum;
  for (int k = 0; k < pairs; ++k) {
    A.block(2 * k, 2 * k, 2, 2) << a, b, -b, a;
    if (k) A.block(2 * k - 2, 2 * k, 2, 2).setIdentity();
    spectrum.emplace_back(a, b), spectrum.emplace_back(a, -b);
  }
  for (int step = 0; step < 2 * n; ++step) {
    const Eigen::Index i = draw(random, 0, n - 1), j = draw(random, 0, n - 1);
    if (i == j) continue;
    A.row(i) += A.row(j);
    A.col(j) -= A.col(i);
  }
  return {state_equation(A, spectrum)};
}

// P J P⁻¹ with P of real numbers: defective up to the rounding of the entries.
Drawn rounded_jordan_blocks(Random& random, int most) {
  const int n = draw(random, 2, most);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
  double value = normal(random);
  for (int k = 0; k < n; ++k) {
    const bool next = draw(random, 0, 3) == 0;
    if (next) value = normal(random);
    J(k, k) = value;
    if (k && !next) J(k - 1, k) = 1;
  }
  const Eigen::MatrixXd P = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  return {state_equation(P * J * P.inverse())};
}

Eigen::MatrixXd frank(int n) {
  return Eigen::MatrixXd::NullaryExpr(n, n, [n](Eigen::Index i, Eigen::Index j) {
    if (j + 1 < i) return 0.0;
    return static_cast<double>(j + 1 == i ? n - i : n - std::max(i, j));
  });
}
// The same states in another order, which takes other pivots.
Eigen::MatrixXd shuffled(const Eigen::MatrixXd& A, Random& random) {
  std::vector<int> order(static_cast<std::size_t>(A.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  return A(order, order);
}
Eigen::MatrixXd grcar(int n) {
  return Eigen::MatrixXd::NullaryExpr(
      n, n, [](Eigen::Index i, Eigen::Index j) { return i == j + 1 ? -1.0 : (j >= i && j <= i + 3 ? 1.0 : 0.0); });
}
Eigen::MatrixXd wilkinson(int n) {
  return Eigen::MatrixXd::NullaryExpr(n, n, [n](Eigen::Index i, Eigen::Index j) {
    return i == j ? std::abs(static_cast<double>(i) - (n - 1) / 2.0) : (std::abs(i - j) == 1 ? 1.0 : 0.0);
  });
}
Eigen::MatrixXd kahan(int n, double s) {
  const double c = std::sqrt(1 - s * s);
  return Eigen::MatrixXd::NullaryExpr(n, n, [s, c](Eigen::Index i, Eigen::Index j) {
    return std::pow(s, static_cast<double>(i)) * (i == j ? 1.0 : (j > i ? -c : 0.0));
  });
}
// Of functions that are zero at one end: all eigenvalues of order n² and larger, far from normal.
Eigen::MatrixXd chebyshev(int n) {
  Eigen::MatrixXd D(n + 1, n + 1);
  const auto x = [n](Eigen::Index k) { return std::cos(3.14159265358979323846 * static_cast<double>(k) / n); };
  const auto c = [n](Eigen::Index k) { return (k == 0 || k == n ? 2.0 : 1.0) * (k % 2 ? -1 : 1); };
  for (Eigen::Index i = 0; i <= n; ++i) {
    for (Eigen::Index j = 0; j <= n; ++j) {
      if (i != j) D(i, j) = c(i) / c(j) / (x(i) - x(j));
    }
    D(i, i) = 0;
  }
  for (Eigen::Index i = 0; i <= n; ++i) D(i, i) = -D.row(i).sum();
  return D.topLeftCorner(n, n);
}
Eigen::MatrixXd random_matrix(Random& random, int n, double decades) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd d(n);
  for (int k = 0; k < n; ++k)
    d(k) = std::pow(10.0, std::uniform_real_distribution<double>(-decades / 2, decades / 2)(random));
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  return d.asDiagonal() * A * d.cwiseInverse().asDiagonal();
}
// Jordan blocks that miss being so by 10^-k.
Eigen::MatrixXd nearly_defective(Random& random, int n, double off) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    A(k, k) = -2 + off * draw(random, -4, 4);
    if (k) A(k - 1, k) = draw(random, 1, 3);
  }
  A(n - 1, 0) = draw(random, 0, 1) ? off : 0.0;
  return A;
}

Drawn lags(Random& random) {
  std::string s;
  const int n = draw(random, 2, 8), rate = draw(random, 1, 4);
  for (int i = 1; i <= n; ++i) {
    s += fmt::format("VARIABLE/{0}, FUNCTION={1}\nDIFF/{0}, IC=1, FUNCTION=VARVAL({0})-{2}*DIF({0})\n", i,
                     i == 1 ? "0" : fmt::format("{}*DIF({})", draw(random, 1, 9), i - 1), rate);
  }
  return {controller(s), std::vector<std::complex<double>>(static_cast<std::size_t>(n), -rate)};
}

std::vector<Exact> exact_values(const Drawn& drawn, const PerturbationEquations& equations) {
  if (!drawn.spectrum) return finer_eigenvalues(equations);
  std::vector<Exact> out;
  for (const auto& v : *drawn.spectrum) out.push_back({Long(v.real()), Long(v.imag())});
  return out;
}

struct Printed {
  std::complex<double> hz;
  double bound;
};
Long distance_of(const Exact& e, const Printed& p) {
  static const Long cycle = 2 * boost::math::constants::pi<Long>();
  const Long re = e.re / cycle - Long(p.hz.real()), im = e.im / cycle - Long(p.hz.imag());
  return sqrt(re * re + im * im);
}

// A perfect matching of those that are within reach of each other, by augmenting paths.
bool matched(const std::vector<std::vector<bool>>& within) {
  const std::size_t n = within.size();
  std::vector<std::size_t> owner(n, n);
  for (std::size_t start = 0; start < n; ++start) {
    std::vector<bool> seen(n, false);
    const std::function<bool(std::size_t)> place = [&](std::size_t i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (!within[i][j] || seen[j]) continue;
        seen[j] = true;
        if (owner[j] == n || place(owner[j])) {
          owner[j] = i;
          return true;
        }
      }
      return false;
    };
    if (!place(start)) return false;
  }
  return true;
}

class Spectrum {
 public:
  void examine(const Drawn& drawn) {
    auto dataset = parse_dataset(std::make_shared<const SourceText>("drawn.adm", drawn.text));
    ASSERT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics) << drawn.text;
    auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics) << drawn.text;
    const auto made = System::make(std::move(model.value)).value();
    const System& system = *made;
    Findings findings;
    const auto op = initial_conditions(system, findings);
    ASSERT_TRUE(op) << op.error().message << drawn.text;
    const auto linear = linearize(system, *op, {});
    ASSERT_TRUE(linear) << linear.error().message;
    const auto solution = eigensolve(*linear);
    ASSERT_TRUE(solution) << solution.error().message;
    std::vector<Exact> exact = exact_values(drawn, *linear->pencil);
    ASSERT_EQ(exact.size(), linear->model.states.size()) << drawn.text;
    std::vector<Printed> printed;
    std::size_t zeros = 0;
    for (const EigenMode& m : solution->modes) {
      if (m.structural_zero) {
        ++zeros;
        continue;
      }
      printed.push_back({m.eigenvalue_hz, m.error_bound_hz});
      if (!m.is_real) printed.push_back({std::conj(m.eigenvalue_hz), m.error_bound_hz});
      if (m.cluster_size == 1) ++single_;
    }
    EXPECT_EQ(zeros, 0u) << "none of the models has an eigenvalue that is zero by structure\n" << drawn.text;
    ASSERT_EQ(exact.size(), printed.size()) << drawn.text;
    std::vector<std::vector<bool>> within(printed.size(), std::vector<bool>(printed.size()));
    for (std::size_t i = 0; i < printed.size(); ++i) {
      Long least = distance_of(exact[0], printed[i]);
      for (std::size_t j = 0; j < exact.size(); ++j) {
        const Long d = distance_of(exact[j], printed[i]);
        least = std::min(least, d);
        within[i][j] = d <= Long(printed[i].bound) + Long("1e-40") * (1 + Long(std::abs(printed[i].hz)));
      }
      ++examined_;
      if (!std::isfinite(printed[i].bound)) ++unbounded_;
      if (least > 0) ratio_.push_back(static_cast<double>(Long(printed[i].bound) / least));
    }
    EXPECT_TRUE(matched(within)) << listing(exact, printed) << drawn.text;
  }

  // The bound of a value may be that of its cluster.
  void expect_tight(double most_median, double most_unbounded = 0) {
    EXPECT_LE(unbounded_, most_unbounded * examined_);
    ::testing::Test::RecordProperty("eigenvalues", examined_);
    ::testing::Test::RecordProperty("single", single_);
    if (ratio_.empty()) return;  // all exact
    std::nth_element(ratio_.begin(), ratio_.begin() + static_cast<std::ptrdiff_t>(ratio_.size() / 2), ratio_.end());
    const double median = ratio_[ratio_.size() / 2];
    ::testing::Test::RecordProperty("median_of_bound_over_error", fmt::format("{:.3g}", median));
    EXPECT_LE(median, most_median);
  }
  int single() const { return single_; }
  int examined() const { return examined_; }

 private:
  static std::string listing(const std::vector<Exact>& exact, const std::vector<Printed>& printed) {
    const double cycle = 6.283185307179586;
    std::string s = "exact, hz:\n";
    for (const Exact& e : exact)
      s += fmt::format("  {:.17g} {:.17g}\n", e.re.convert_to<double>() / cycle, e.im.convert_to<double>() / cycle);
    s += "printed:\n";
    for (const Printed& p : printed)
      s += fmt::format("  {:.17g} {:.17g} within {:.3g}\n", p.hz.real(), p.hz.imag(), p.bound);
    return s;
  }

  int examined_ = 0, unbounded_ = 0, single_ = 0;
  std::vector<double> ratio_;
};

struct Family {
  const char* name;
  std::function<std::vector<Drawn>(Random&)> draws;
  double most_median;  // of bound over error, where most values are single
};

template <class Function>
std::vector<Drawn> many(int count, Function&& one) {
  std::vector<Drawn> out;
  for (int k = 0; k < count; ++k) out.push_back(one(k));
  return out;
}

constexpr double any = std::numeric_limits<double>::infinity();

const Family families[] = {
    {"powers",
     [](Random&) {
       return many(22, [](int k) {
         return transfer_function(std::vector<int>(static_cast<std::size_t>(2 + k / 2), k % 2 ? -2 : -1));
       });
     },
     any},
    {"transfer_functions",
     [](Random& r) { return many(150, [&](int) { return transfer_function(repeated_roots(r, 12)); }); }, any},
    {"companions",
     [](Random& r) {
       return many(150, [&](int) {
         const std::vector<int> roots = repeated_roots(r, 12);
         return state_equation(companion(roots), as_complex(roots));
       });
     },
     any},
    {"jordan_blocks", [](Random& r) { return many(250, [&](int k) { return jordan_blocks(r, 2 + k % 11); }); }, any},
    {"complex_jordan_blocks",
     [](Random& r) { return many(100, [&](int k) { return complex_jordan_blocks(r, 1 + k % 5); }); }, any},
    {"rounded_jordan_blocks",
     [](Random& r) { return many(150, [&](int k) { return rounded_jordan_blocks(r, 2 + k % 9); }); }, any},
    {"nearly_defective",
     [](Random& r) {
       return many(150,
                   [&](int k) { return state_equation(nearly_defective(r, 2 + k % 5, std::pow(10.0, -k / 10.0))); });
     },
     any},
    {"lags", [](Random& r) { return many(60, [&](int) { return lags(r); }); }, any},
    {"frank", [](Random&) { return many(14, [](int k) { return state_equation(frank(5 + k)); }); }, 1000},
    {"shuffled_frank",
     [](Random& r) { return many(60, [&](int k) { return state_equation(shuffled(frank(11 + k % 7), r)); }); }, any},
    {"grcar", [](Random&) { return many(16, [](int k) { return state_equation(grcar(5 + k)); }); }, 1000},
    {"wilkinson", [](Random&) { return many(16, [](int k) { return state_equation(wilkinson(5 + k)); }); }, 1000},
    {"kahan",
     [](Random& r) { return many(40, [&](int k) { return state_equation(kahan(3 + k % 12, 0.1 * draw(r, 3, 9))); }); },
     1000},
    {"chebyshev", [](Random&) { return many(12, [](int k) { return state_equation(chebyshev(4 + k)); }); }, 1000},
    {"random",
     [](Random& r) { return many(300, [&](int k) { return state_equation(random_matrix(r, 2 + k % 9, 0)); }); }, 1000},
    {"badly_scaled",
     [](Random& r) { return many(300, [&](int k) { return state_equation(random_matrix(r, 2 + k % 9, k % 25)); }); },
     1000},
    {"nearly_cancelling",
     [](Random&) {
       return many(8, [](int k) {
         const double a = std::pow(10.0, k);
         Eigen::MatrixXd A(2, 2);
         A << a, 1 - a, a + 1, -a;
         return state_equation(A);
       });
     },
     any},
};

void PrintTo(const Family& f, std::ostream* out) { *out << f.name; }

class Defective : public ::testing::TestWithParam<Family> {};

TEST_P(Defective, every_eigenvalue_is_within_its_bound) {
  Random random(7);
  Spectrum spectrum;
  int number = 0;
  for (const Drawn& drawn : GetParam().draws(random)) {
    SCOPED_TRACE(fmt::format("draw {}", number++));
    spectrum.examine(drawn);
    if (HasFatalFailure() || HasFailure()) return;
  }
  spectrum.expect_tight(GetParam().most_median);
}
INSTANTIATE_TEST_SUITE_P(families, Defective, ::testing::ValuesIn(families),
                         [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace dynalin::precision::defective_test
