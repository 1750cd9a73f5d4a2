// What the tests of the original implementation share: environment variables for a while, comparisons, a pendulum.
#pragma once

#include <cstdlib>
#include <limits>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases {

inline constexpr double two_pi = 2 * std::numbers::pi;

// Sets an environment variable as long as it lives.
class Variable {
 public:
  explicit Variable(const char* name, const char* value = "1") : name_(name) { ::setenv(name, value, 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};
inline constexpr auto pbcs_states = "MSC_LINEAR_PBCS_STATES";
inline constexpr auto nodamp_diff = "MSC_ADAMS_SOLVER_NODAMP_DIFF";
inline constexpr auto no_checks = "MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY";
inline constexpr auto no_restore = "MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES";

class OriginalCases : public Cases {
 protected:
  static double after(const std::string& text, const std::string& label) {
    const std::size_t at = text.find(label);
    if (at == std::string::npos) return std::numeric_limits<double>::quiet_NaN();
    return std::stod(text.substr(text.find('=', at) + 1));
  }
  static void expect_matrices(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                              double relative) {
    ASSERT_EQ(a.size(), b.size());
    double largest = 0;
    for (const auto& row : b) {
      for (const double v : row) largest = std::max(largest, std::abs(v));
    }
    for (std::size_t r = 0; r < a.size(); ++r) {
      ASSERT_EQ(a[r].size(), b[r].size());
      for (std::size_t c = 0; c < a[r].size(); ++c)
        EXPECT_NEAR(a[r][c], b[r][c], relative * largest) << "row " << r << " column " << c;
    }
  }
  // type, element, coordinate of each state
  static std::vector<std::array<int, 3>> codes(const RunResult& r, std::size_t k) {
    std::vector<std::array<int, 3>> list;
    for (const auto& s : r.result(k).at("states")) list.push_back({s.at("type"), s.at("element"), s.at("coordinate")});
    return list;
  }
};

// A pendulum with inertia J about its hinge at the origin and its mass centre at the distance l, drawn at the angle
// `angle` from the downward vertical and turning at the rate `rate`.
struct Pendulum {
  double mass = 2, l = 0.8, own = 0.3, g = 9.81;
  double J() const { return own + mass * l * l; }
  double kappa() const { return mass * g * l / J(); }
  std::string text(double angle, double rate, const std::string& more = "") const {
    return fmt::format(
        "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={:.17g}\nPART/1, GROUND\nMARKER/1\n"
        "PART/2, MASS={:.17g}, CM=20, IP=0.5,0.2,{:.17g}, QG={}, REULER={:.17g},0,0, WZ={:.17g}\n"
        "MARKER/20, QP=0.1,0,0\nMARKER/21, QP=0.1,{:.17g},0\nJOINT/1, REVOLUTE, I=21, J=1\n{}END\n",
        -g, mass, own, xyz(rotation_313(angle, 0, 0) * Vector{-0.1, -l, 0}), angle, rate, l, more);
  }
};

}  // namespace dynalin::cases
