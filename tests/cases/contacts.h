// Cases of CONTACT that compare eigenvalues of one mechanism drawn in different ways.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "cases/run.h"

namespace dynalin::cases::contacts {

inline const std::string head = "Contact\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n";
inline const std::string law = "IMPACT, STIFFNESS=1E4, EXPONENT=1, DAMPING=30, DMAX=1E-5\n";
inline const std::string rubs =
    "COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.1, STICTION_TRANSITION_VELOCITY=0.1, "
    "FRICTION_TRANSITION_VELOCITY=1, ";

// A closed outline in the plane of x and y, drawn along z of its marker.
inline std::string extrusion(int id, int marker, const std::string& points, int count, double length) {
  return fmt::format(
      "MATRIX/{0}, FULL=RORDER, ROWS={1}, COLUMNS=3, VALUES={2}\nCURVE/{0}, CLOSED, MATRIX={0}, CURVE_POINTS, ORDER=2\n"
      "GRAPHICS/{0}, EXTRUSION, CID={0}, CRM={3}, LENGTH={4}\n",
      id, count, points, marker, length);
}

class ContactCases : public Cases {
 protected:
  static std::vector<std::complex<double>> sorted(std::vector<std::complex<double>> v) {
    std::ranges::sort(
        v, [](auto a, auto b) { return std::pair(std::abs(a), a.imag()) < std::pair(std::abs(b), b.imag()); });
    return v;
  }
  std::vector<std::complex<double>> values(const std::string& model, const std::string& before = "",
                                           const std::string& start = head) const {
    const RunResult r = run(start + model + "END\n", before + "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return {};
    return sorted(r.eigenvalues(r.json.at("results").size() - 1));
  }
  static void expect_same(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b,
                          double tolerance = 1e-9) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_FALSE(a.empty());
    EXPECT_GT(std::abs(a.back()), 1);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LE(std::abs(a[k] - b[k]), tolerance * std::abs(a.back())) << k;
  }
};

}  // namespace dynalin::cases::contacts
