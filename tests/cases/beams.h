// Datasets of beams made of PARTs and BEAMs, and their spectra.
#pragma once

#include <numbers>

#include "cases/both.h"
#include "cases/dataset_text.h"

namespace dynalin::cases {

class Beams : public ProgramAndLibrary {
 protected:
  // All eigenvalues, radians per unit time.
  std::vector<std::complex<double>> spectrum(const std::string& elements,
                                             const std::string& linear = "LINEAR/EIGENSOL, NOVECTOR") const {
    const RunResult r = run("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + elements + "END\n", linear + "\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<std::complex<double>> values;
    if (r.status == 0) values = r.eigenvalues(0);
    for (auto& v : values) v *= 2 * std::numbers::pi;
    return values;
  }
  // Positive imaginary parts, ascending.
  static std::vector<double> frequencies(const std::vector<std::complex<double>>& values) {
    std::vector<double> list;
    for (const auto& v : values) {
      if (v.imag() > 0) list.push_back(v.imag());
    }
    std::sort(list.begin(), list.end());
    return list;
  }
  std::vector<double> frequencies(const std::string& elements,
                                  const std::string& linear = "LINEAR/EIGENSOL, NOVECTOR") const {
    return frequencies(spectrum(elements, linear));
  }
  static double nearest(const std::vector<double>& list, double value) {
    EXPECT_FALSE(list.empty());
    double best = 1e300;
    for (const double x : list) best = std::abs(x - value) < std::abs(best - value) ? x : best;
    return best;
  }
};

inline std::ptrdiff_t copies(const std::vector<double>& list, double value, double relative) {
  return std::count_if(list.begin(), list.end(), [&](double x) { return std::abs(x - value) <= relative * value; });
}
inline bool contains(const std::vector<double>& list, double value, double relative) {
  return copies(list, value, relative) > 0;
}
inline bool contains(const std::vector<std::complex<double>>& list, std::complex<double> value, double relative) {
  return std::any_of(list.begin(), list.end(),
                     [&](auto x) { return std::abs(x - value) <= relative * std::abs(value); });
}

// Node k of a uniform beam of unit length and mass between `sides` elements: half of each, as a half rod about the
// node, and `gyration` the square of the section's radius of gyration for rotary inertia about a diameter.
struct Node {
  int k, n, sides;
  double x;  // where it is drawn
  double gyration = 0;
  double polar = 1;  // moment of inertia about x as part of that about y and z
  std::string motion = "";
  double half() const { return 0.5 / n; }
  double mass() const { return sides * half(); }
  double inertia() const { return sides * half() * (half() * half() / 3 + gyration); }
  std::string text() const {
    return fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}, IP={2:.17g},{3:.17g},{3:.17g}, QG={4:.17g},0,0{5}\nMARKER/{0}\n", 10 + k,
        mass(), polar * inertia(), inertia(), x, motion);
  }
};
inline Node node(int k, int n) { return {.k = k, .n = n, .sides = k == 0 || k == n ? 1 : 2, .x = 1.0 * k / n}; }

}  // namespace dynalin::cases
