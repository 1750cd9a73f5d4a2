// Rest of models in which nothing is loaded: every force there is, is rounding, of places that are known to their last
// digits alone, and what reactions and functions pass on of it.
#include <gmock/gmock.h>

#include <random>

#include "cases/dataset_text.h"

namespace dynalin::cases::unloaded_statics_test {
namespace {

class UnloadedStatics : public Cases {
 protected:
  // A second search begins where the first one ended.
  void expect_rest_twice(const std::string& elements) const {
    const std::string text = "Unloaded\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n" + elements + "END\n";
    const RunResult r = run(text, "SIMULATE/STATICS\nSIMULATE/STATICS\n");
    ASSERT_EQ(r.status, 0) << r.err << text;
    const auto& first = r.result(0).at("operating_point").at("bodies");
    const auto& second = r.result(1).at("operating_point").at("bodies");
    for (std::size_t b = 0; b < first.size(); ++b) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(first.at(b).at("position").at(c).get<double>(), second.at(b).at("position").at(c).get<double>(),
                    1e-13)
            << text;
      }
    }
  }
};

TEST_F(UnloadedStatics, a_part_in_an_inclined_place_rests_a_second_time) {
  const std::vector<std::string> holds = {
      "JOINT/1, REVOLUTE, I=2, J=1\nSFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=-100*AZ(2,1)\n",
      "JOINT/1, TRANSLATIONAL, I=2, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-100*DZ(2,1,1)\n",
      "JOINT/1, CYLINDRICAL, I=2, J=1\nSFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=-100*AZ(2,1)\n"
      "VARIABLE/1, FUNCTION=-50*DZ(2,1,1)\nSFORCE/2, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=2*VARVAL(1)\n",
      "JOINT/1, PLANAR, I=2, J=1\nBUSHING/1, I=2, J=1, K=100,100,0, KT=0,0,2\n",
      "JOINT/1, SPHERICAL, I=2, J=1\nVTORQUE/1, I=2, JFLOAT=9, RM=1, TX=-2*AX(2,1)\\TY=-2*AY(2,1)\\TZ=-2*AZ(2,1)\n",
      "GFORCE/1, I=2, JFLOAT=9, RM=1, FX=-100*DX(2,1,1)\\FY=-100*DY(2,1,1)\\FZ=-100*DZ(2,1,1)"
      "\\TX=-2*AX(2,1)\\TY=-2*AY(2,1)\\TZ=-2*AZ(2,1)\n"};
  std::mt19937_64 bits(2);
  const auto draw = [&] { return std::round(std::uniform_real_distribution<double>(-3000, 3000)(bits)) / 1000; };
  for (const std::string& hold : holds) {
    for (int k = 0; k < 6; ++k) {
      const Vector place{draw(), draw(), draw()}, angles{draw(), draw(), draw()};
      const std::string at = fmt::format("QG={}, REULER={}", xyz(place), xyz(angles));
      expect_rest_twice(
          fmt::format(
              "MARKER/1, QP={}, REULER={}\nMARKER/9, FLOATING\nPART/2, MASS=1, CM=2, IP=1,1,0.5, {}\nMARKER/2\n",
              xyz(place), xyz(angles), at) +
          hold);
    }
  }
}

// Each spring's rounding goes through reactions to the rod, which has none of its own.
TEST_F(UnloadedStatics, a_slider_crank_between_springs_rests_where_it_is_drawn) {
  const double crank = 0.1, rod = 0.3, angle = 1;
  const double lift = std::asin(crank * std::sin(angle) / rod);
  const double slide = crank * std::cos(angle) + rod * std::cos(lift);
  expect_rest_twice(fmt::format(
      "MARKER/1\nMARKER/2, QP=0.6,0,0\nMARKER/3, REULER=90D,90D,0\n"
      "PART/2, MASS=10, CM=20, IP=.02,.02,.02, REULER={0:.17g},0,0\nMARKER/20, QP={1}\nMARKER/21\nMARKER/22, QP={2}\n"
      "PART/3, MASS=20, CM=30, IP=.1,.1,.1, QG={3:.17g},{4:.17g},0, REULER={5:.17g},0,0\nMARKER/30, QP=0.15,0,0\n"
      "MARKER/31\nMARKER/32, QP=0.3,0,0\n"
      "PART/4, MASS=30, CM=41, IP=.1,.1,.1, QG={6:.17g},0,0\nMARKER/41\nMARKER/42, REULER=90D,90D,0\n"
      "MARKER/44, REULER=0,90D,0\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, SPHERICAL, I=31, J=22\nJOINT/3, HOOKE, I=32, J=44\n"
      "JOINT/4, TRANSLATIONAL, I=42, J=3\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=41, J=2, K=5, C=1, LENGTH={7:.17g}\n"
      "SPRINGDAMPER/2, ROTATIONAL, I=21, J=1, KT=0.03, CT=0.005, ANGLE={0:.17g}\n",
      angle, xyz(Vector{crank / 2, 0, 0}), xyz(Vector{crank, 0, 0}), crank * std::cos(angle), crank * std::sin(angle),
      -lift, slide, 0.6 - slide));
}

}  // namespace
}  // namespace dynalin::cases::unloaded_statics_test
