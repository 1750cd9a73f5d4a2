// Rows of constraints whose gradient is a small difference of large terms, and joints in series that are each near
// their singular bend: frequencies are within their bounds, or the model is refused with a reason.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "cases/dataset_text.h"

namespace dynalin::cases::cancelling_rows_test {
namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

class CancellingRows : public Cases {
 protected:
  // One freedom, x″ = −w² x. Says whether it was linearized.
  bool examine(const std::string& dataset, const Real& w, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const RunResult r = run(dataset, commands);
    if (r.status == 2) {
      EXPECT_NE(r.err.find("singular"), std::string::npos) << r.err;
      return false;
    }
    EXPECT_EQ(r.status, 0) << r.err << dataset;
    if (r.status != 0) return false;
    const auto values = r.eigenvalues(0);
    EXPECT_EQ(values.size(), 2u) << dataset;
    if (values.size() != 2) return true;
    const Real expected = w / (2 * boost::math::constants::pi<Real>());
    const double bound = r.result(0).at("modes").at(0).at("error_bound_hz").get<double>();
    EXPECT_LE(abs(abs(Real(values[0].imag())) - expected), bound) << dataset;
    EXPECT_LE(std::abs(values[0].real()), bound) << dataset;
    return true;
  }
};

// Two discs on an oblique axis, inertias 2 and 3, a spring of 7 on the second; the first turns by x, the second by
// −(1 + d) x + x = −d x.
std::string discs(const std::string& relation, const std::string& axis = "0.7,1.1,0.3") {
  return fmt::format(
      "Discs\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=3,-2,5, REULER={0}\n"
      "PART/2, MASS=1, CM=20, IP=5,6,2, QG=3,-2,5, REULER={0}\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=5,6,3, QG=3,-2,5, REULER={0}\nMARKER/30\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=20\n"
      "SPRINGDAMPER/1, ROTATIONAL, I=30, J=1, KT=7\n{1}\nEND\n",
      axis, relation);
}

TEST_F(CancellingRows, of_couplers_and_conditions_have_bounds_that_hold) {
  for (int k = 2; k <= 14; ++k) {
    const double factor = 1 + std::pow(10.0, -k);
    const Real d = Real(factor) - 1, w = d * sqrt(7 / (2 + 3 * d * d));
    for (const std::string& relation : {fmt::format("COUPLER/1, JOINTS=1,2, TYPE=R:R, SCALES={:.17g},1", factor),
                                        fmt::format("GCON/1, FUNCTION={:.17g}*AZ(20,1)+AZ(30,20)", factor)}) {
      for (const char* axis : {"0.7,1.1,0.3", "0,0,0"}) {
        EXPECT_TRUE(examine(discs(relation, axis), w)) << k;
      }
    }
  }
}

// Three shafts with their axes in one plane, the middle one along z and the outer ones off a right angle to it by e and
// f. With the pins across the plane on the outer shafts tan φ₂ = sin e tan φ₁ and tan φ₂ = sin f tan φ₃: the middle one
// all but stands still, and the outer ones turn in the ratio r = sin e/sin f.
std::string shafts(double e, double f, double speed) {
  const double right = std::numbers::pi / 2;
  return fmt::format(
      "Shafts\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n"
      "PART/2, MASS=1, CM=20, IP=9,8,2, REULER=90D,{0:.17g},0\nMARKER/20\nMARKER/21, PART=1, REULER=90D,{0:.17g},0\n"
      "PART/3, MASS=1, CM=30, IP=9,8,3, QG=0,0,1\nMARKER/30\n"
      "PART/4, MASS=1, CM=40, IP=9,8,5, QG=0,0,2, REULER=90D,{1:.17g},0\nMARKER/40\n"
      "MARKER/41, PART=1, QP=0,0,2, REULER=90D,{1:.17g},0\n"
      "MARKER/22, PART=2, REULER=90D,90D,0\nMARKER/31, PART=3, QP=0,0,-1, REULER=90D,90D,0\n"
      "MARKER/32, PART=3, QP=0,0,1, REULER=90D,90D,0\nMARKER/42, PART=4, REULER=90D,90D,0\n"
      "JOINT/1, REVOLUTE, I=20, J=21, IC=0,{2:.17g}\nJOINT/2, UNIVERSAL, I=31, J=22\n"
      "JOINT/3, UNIVERSAL, I=32, J=42\nJOINT/4, CYLINDRICAL, I=40, J=41\n"
      "SPRINGDAMPER/1, ROTATIONAL, I=20, J=21, KT=7\n"
      "VARIABLE/1, FUNCTION=AZ(20,21)\nPSTATE/1, VARIABLES=1\nEND\n",
      right - e, right - f, speed);
}

// J = 2 + 3 (dφ₂/dφ₁)² + 5 (dφ₃/dφ₁)²;  J δ″ = −(7 + ½ J″ w²) δ at φ = 0, where J′ = 0 and (dφ/dφ₁)² = s² + 2 s² (1 −
// s²) φ₁².
TEST_F(CancellingRows, of_two_universal_joints_in_series_near_their_square_bends) {
  int linearized = 0;
  for (const double speed : {0.0, 30.0}) {
    for (int k = 1; k <= 12; ++k) {
      for (const double more : {1.0, 2.0, 0.37}) {
        const double e = std::pow(10.0, -k), f = more * e, right = std::numbers::pi / 2;
        const Real s = cos(Real(right - e)), r = s / cos(Real(right - f));
        const Real inertia = 2 + 3 * s * s + 5 * r * r;
        const Real growth = 4 * (3 * s * s * (1 - s * s) + 5 * r * r * (1 - r * r));
        const Real square = (7 + growth * speed * speed / 2) / inertia;
        if (square < 0) continue;
        const bool done = examine(shafts(e, f, speed), sqrt(square), "LINEAR/EIGENSOL, PSTATE=1\n");
        EXPECT_TRUE(done || k > 7) << e << " " << more << " " << speed;
        linearized += done;
      }
    }
  }
  EXPECT_GT(linearized, 40);
}

}  // namespace
}  // namespace dynalin::cases::cancelling_rows_test
