// Accelerations and reactions that are zero at a point, found from ones that were none: nothing is left of them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

#include "cases/run.h"

namespace dynalin::cases::vanishing_accelerations_test {
namespace {

class VanishingAccelerations : public Cases {
 protected:
  void expect_rest(const RunResult& r, const std::string& dataset) const {
    ASSERT_EQ(r.status, 0) << r.err << dataset;
    for (const auto& part : r.result(2).at("operating_point").at("bodies")) {
      for (const char* of : {"acceleration", "angular_acceleration"}) {
        for (const double a : part.at(of)) EXPECT_EQ(a, 0) << of << dataset;
      }
    }
    for (const auto& value : r.eigenvalues(2)) EXPECT_EQ(std::abs(value), 0) << dataset;
  }
};

TEST_F(VanishingAccelerations, are_found_when_gravity_and_forces_go) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto place = [&] { return fmt::format("{:.1f},{:.1f},{:.1f}", any(random), any(random), any(random)); };
  for (int k = 0; k < 12; ++k) {
    const auto part = [&](int id) {
      return fmt::format("PART/{0}, MASS=3, CM={0}3, IP=3,4,5, REULER={1}\nMARKER/{0}3, QP={2}\n", id, place(),
                         place());
    };
    const std::string head = "Free\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
    const std::string falls = head + "ACCGRAV/KGRAV=-1.62\n" + part(2) + "END\n";
    expect_rest(run(falls, "SIMULATE/INITIAL_CONDITIONS\nACCGRAV/KGRAV=0\nLINEAR/EIGENSOL\n"), falls);
    const std::string pushed = head + part(2) + part(3) + "MARKER/39, PART=3, FLOATING\n" +
                               "GFORCE/1, I=23, JFLOAT=39, RM=1, FX=1\\FY=2\\FZ=-3\\TX=0\\TY=1\\TZ=0.5\nEND\n";
    expect_rest(run(pushed, "SIMULATE/INITIAL_CONDITIONS\nDEACTIVATE/GFORCE, ID=1\nLINEAR/EIGENSOL\n"), pushed);
  }
}

}  // namespace
}  // namespace dynalin::cases::vanishing_accelerations_test
