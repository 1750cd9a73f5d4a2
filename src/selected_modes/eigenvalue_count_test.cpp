#include "selected_modes/eigenvalue_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "system/sparse_lu.h"

namespace dynalin::eigenvalue_count_test {
namespace {

using Complex = std::complex<double>;

// n oscillators of ω = 1, 2, 3 …, the first `twice` of them twice, damped by `damping`; a double zero as well.
ColumnMatrix oscillators(int n, int twice, double damping) {
  std::vector<Triplet> entries;
  std::int32_t size = 0;
  const auto add = [&](double w) {
    entries.push_back({size, size + 1, 1.0});
    entries.push_back({size + 1, size, -w * w - damping * damping});
    entries.push_back({size + 1, size + 1, -2 * damping});
    size += 2;
  };
  for (int k = 1; k <= n; ++k) {
    add(k);
    if (k <= twice) add(k);
  }
  entries.push_back({size, size + 1, 1.0});
  size += 2;
  return compressed(size, size, entries);
}

struct Counting {
  explicit Counting(const ColumnMatrix& A) : lu(A, A.columns) {}
  std::optional<Eigen::Index> disc(Complex centre, double radius, const std::vector<Complex>& known) {
    return eigenvalues_inside(lu, circle(centre, radius), known,
                              [&](Complex v) { return std::abs(v - centre) <= radius; });
  }
  ShiftedLu lu;
};

TEST(EigenvalueCount, is_that_of_the_disc_whatever_is_known) {
  Counting of(oscillators(60, 5, 0.01));
  // ω to 10, five of them twice, and two zeros.
  EXPECT_EQ(of.disc(0, 10.5, {}), 2 * 15 + 2);
  std::vector<Complex> known{0.0, 0.0};
  for (int k = 1; k <= 14; ++k) known.insert(known.end(), {Complex(-0.01, k), Complex(-0.01, -k)});
  EXPECT_EQ(of.disc(0, 10.5, known), 2 * 15 + 2) << "five pairs are not known";
  EXPECT_EQ(of.disc(0, 0.5, {}), 2);
  EXPECT_EQ(of.disc(Complex(0, 20), 2.5, {}), 5);
  EXPECT_EQ(of.disc(Complex(0, 3), 1.5, {Complex(-0.01, 3)}), 6);
  EXPECT_EQ(of.disc(Complex(5, 20), 2.5, {}), 0);
}

TEST(EigenvalueCount, is_that_of_the_band) {
  const ColumnMatrix A = oscillators(60, 5, 0.01);
  ShiftedLu lu(A, A.columns);
  const auto count = [&](double low, double high) {
    return eigenvalues_inside(lu, rectangle(-high, high, low, high), {}, [](Complex) { return false; });
  };
  EXPECT_EQ(count(4.5, 12.5), 9);
  EXPECT_EQ(count(0, 3.5), 2 * 6 + 2);
}

TEST(EigenvalueCount, is_none_on_an_eigenvalue) {
  Counting of(oscillators(10, 0, 0));
  EXPECT_FALSE(of.disc(0, 3, {}));
}

// A real value and two pairs that Jordan blocks of two make, close to the border.
TEST(EigenvalueCount, follows_defective_ones_next_to_the_border) {
  std::vector<Triplet> entries{{0, 0, -1.0}};
  for (const double at : {0.999, 1.001}) {
    const auto k = static_cast<std::int32_t>(at < 1 ? 1 : 5);
    for (const std::int32_t b : {k, k + 2}) entries.insert(entries.end(), {{b, b + 1, at}, {b + 1, b, -at}});
    entries.insert(entries.end(), {{k, k + 2, 1.0}, {k + 1, k + 3, 1.0}});
  }
  Counting of(compressed(9, 9, entries));
  EXPECT_EQ(of.disc(0, 1.0005, {}), 1 + 4);
  EXPECT_EQ(of.disc(0, 1.002, {}), 1 + 8);
  EXPECT_EQ(of.disc(Complex(0, 1), 0.0005, {}), 0);
}

// Discs anywhere among values anywhere, of which few are known: a count may be refused, and is right where it is given.
TEST(EigenvalueCount, is_right_or_none_whatever_is_missing) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  int counted = 0;
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<Complex> values;
    std::vector<Triplet> entries;
    std::int32_t size = 0;
    const int pairs = 3 + static_cast<int>(40 * part(random));
    const double spread = draw % 2 == 0 ? 0.1 : 10;
    for (int k = 0; k < pairs; ++k, size += 2) {
      const Complex v(spread * (part(random) - 0.5), 10 * part(random));
      entries.insert(entries.end(),
                     {{size, size + 1, 1.0}, {size + 1, size, -std::norm(v)}, {size + 1, size + 1, 2 * v.real()}});
      values.insert(values.end(), {v, std::conj(v)});
    }
    Counting of(compressed(size, size, entries));
    const Complex centre(0, draw % 3 == 0 ? 0 : 10 * part(random));
    const double radius = 0.3 + 4 * part(random), share = part(random);
    std::vector<Complex> known;
    for (std::size_t k = 0; k < values.size(); k += 2) {
      if (part(random) < share) known.insert(known.end(), {values[k], values[k + 1]});
    }
    const auto found = of.disc(centre, radius, known);
    if (!found) continue;
    ++counted;
    EXPECT_EQ(*found, std::count_if(values.begin(), values.end(), [&](Complex v) {
      return std::abs(v - centre) <= radius;
    })) << draw;
  }
  EXPECT_GT(counted, 120);
}

}  // namespace
}  // namespace dynalin::eigenvalue_count_test
