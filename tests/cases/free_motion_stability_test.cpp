// Stability of what nothing holds: equilibria that lie along a curve are told from a force that begins with a higher
// order, wherever a part has its BCS.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

#include "cases/dataset_text.h"
#include "cases/run.h"

namespace dynalin::cases::free_motion_stability_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FreeMotionStability : public Cases {
 protected:
  std::string verdict(const std::string& elements, const std::string& units = "UNITS/SYSTEM=MKS",
                      const std::string& gravity = "JGRAV=-9.81") const {
    const RunResult r = run("Free\n" + units + "\nACCGRAV/" + gravity + "\nPART/1, GROUND\n" + elements + "END\n",
                            "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 0) << r.err << elements;
    if (r.json.is_null()) return r.err;
    const auto& stability = r.result(0).at("stability");
    return stability.at("reason").is_null() ? stability.at("verdict").get<std::string>()
                                            : stability.at("reason").get<std::string>();
  }
};

// Rods that hang in a row by balls and turn about their lines as they like; the last one hangs on a spring. All have
// their BCS at `place`. In units of length of which `units` are a metre.
std::string row_of_rods(int count, Vector place, double units = 1) {
  const auto at = [&](const Vector& p) { return xyz(units * p); };
  std::string text = "MARKER/1, PART=1\n";
  Vector from{};
  int before = 1;
  for (int k = 0; k < count; ++k) {
    const Vector to = from + Vector{0.5, -0.3, k % 2 == 0 ? 0.2 : -0.2};
    const int id = 10 * (k + 2);
    text += fmt::format(
        "PART/{}, MASS=1, CM={}, IP={}, QG={}\nMARKER/{}, QP={}\nMARKER/{}, QP={}\nMARKER/{}, QP={}\n"
        "JOINT/{}, SPHERICAL, I={}, J={}\n",
        k + 2, id, xyz(units * units * Vector{0.03, 0.03, 0.002}), at(place), id, at(0.5 * (from + to) - place), id + 1,
        at(from - place), id + 2, at(to - place), k + 1, id + 1, before);
    from = to, before = id + 2;
  }
  return text +
         fmt::format("MARKER/2, PART=1, QP={}\nSPRINGDAMPER/1, TRANSLATIONAL, I={}, J=2, K={}, C={}, LENGTH={}\n",
                     at(from + Vector{0.4, 0.5, 0.3}), before, 50 / units, 1 / units, 0.3 * units);
}

// A unit mass that slides in a plane along the curve y = x², from which a spring keeps it; `along` acts along x.
std::string valley(double x, const std::string& along = "") {
  return fmt::format(
      "MARKER/1\nMARKER/2, FLOATING\nPART/2, MASS=1, CM=20, IP=1,1,1, QG={:.17g},{:.17g},0\nMARKER/20\n"
      "JPRIM/1, INPLANE, I=20, J=1\nJPRIM/2, ORIENTATION, I=20, J=1\n"
      "VFORCE/1, I=20, JFLOAT=2, RM=1, "
      "FX=200*DX(20,1)*(DY(20,1)-DX(20,1)**2){}\\FY=-100*(DY(20,1)-DX(20,1)**2)\\FZ=0\n",
      x, x * x, along);
}

}  // namespace

TEST_F(FreeMotionStability, rods_spin_about_their_lines_wherever_their_bcs_are) {
  const std::string mm = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND";
  for (const int count : {1, 2, 5}) {
    for (const Vector& place : {Vector{}, Vector{0.25, -0.15, 0.1}, Vector{5, -3, 2}, Vector{-30, 10, 4}}) {
      EXPECT_EQ(verdict(row_of_rods(count, place)), "stable") << count << ' ' << xyz(place);
      EXPECT_EQ(verdict(row_of_rods(count, place, 1000), mm, "JGRAV=-9810"), "stable") << count << ' ' << xyz(place);
    }
  }
}

// Six free directions, seen from a place far from both.
TEST_F(FreeMotionStability, two_parts_that_only_a_bushing_joins_move_as_a_whole) {
  EXPECT_EQ(verdict("MARKER/1\nPART/2, MASS=1, CM=20, IP=.1,.1,.1\nMARKER/20, QP=1,2,3\nMARKER/21, QP=1.2,2.1,3\n"
                    "PART/3, MASS=1, CM=30, IP=.1,.1,.1\nMARKER/30, QP=2,2,3\nMARKER/31, QP=1.9,2.2,3.1\n"
                    "BUSHING/1, I=21, J=31, K=100,100,100, KT=10,10,10, C=1,1,1, CT=1,1,1\n",
                    "UNITS/SYSTEM=MKS", "JGRAV=0"),
            "stable");
}

TEST_F(FreeMotionStability, equilibria_along_a_curve_are_told_from_a_force_along_it) {
  const auto of = [&](const std::string& elements) { return verdict(elements, "UNITS/SYSTEM=MKS", "JGRAV=0"); };
  for (const double x : {0.0, 0.5, 2.0}) EXPECT_EQ(of(valley(x)), "stable") << x;
  for (const char* along : {"-DX(20,1)**3", "+DX(20,1)**3", "-DX(20,1)**2"})
    EXPECT_THAT(of(valley(0, along)), HasSubstr("to first order nothing holds DX of PART/2 here")) << along;
}

// A rod hangs straight down from a ball; a moment about its line begins with a higher order. Where the BCS is far from
// the line rounding makes other numbers of the two zeros.
TEST_F(FreeMotionStability, a_moment_of_higher_order_is_found_wherever_the_bcs_is) {
  for (const Vector& place : {Vector{}, Vector{3, 1, -2}, Vector{-0.7, 20, 5}}) {
    const auto rod = [&](const char* moment) {
      return verdict(
          fmt::format("MARKER/5, PART=1, QP=0,0.4,0, REULER=0,90D,0\nPART/2, MASS=1, CM=7, IP=.05,.05,.002, QG={}\n"
                      "MARKER/3, QP={}, REULER=0,90D,0\nMARKER/7, QP={}\nJOINT/1, SPHERICAL, I=3, J=5\n"
                      "SFORCE/1, ROTATION, ACTIONONLY, I=3, J=5, FUNCTION={}\n",
                      xyz(place), xyz(Vector{0, 0.4, 0} - place), xyz(Vector{0, -0.2, 0} - place), moment));
    };
    EXPECT_EQ(rod("0"), "stable") << xyz(place);
    for (const char* moment : {"-AZ(3,5)**3", "AZ(3,5)**3", "-AZ(3,5)**2"})
      EXPECT_THAT(rod(moment), Not("stable")) << moment << ' ' << xyz(place);
  }
}

}  // namespace dynalin::cases::free_motion_stability_test
