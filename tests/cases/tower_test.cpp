// Towers of solids that stand on each other beside their middles: at rest each level bears what is above it. Nothing
// keeps such a tower from sliding apart, and so it is a saddle, from which every way down leads off.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/run.h"

namespace dynalin::cases::tower_test {
namespace {

using ::testing::HasSubstr;

constexpr double weight = 10;

struct Tower {
  int count = 3;
  double length = 1;  // of a meter
  bool rubs = false;
  std::string shape = "BOX, CORNER={0}1, X={1}, Y={1}, Z={2}";
};

std::string dataset(const Tower& t) {
  const double L = t.length, a = 0.3 * L, h = 0.1 * L;
  std::string text = fmt::format(
      "Tower\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={0}, TIME=SECOND\nACCGRAV/KGRAV={1}\nPART/1, GROUND\nMARKER/1\n"
      "GRAPHICS/1, PLANE, RM=1, XMIN={2}, XMAX={3}, YMIN={2}, YMAX={3}\n",
      L > 1 ? "MILLIMETER" : "METER", -10 * L, -50 * L, 50 * L);
  for (int k = 0; k < t.count; ++k) {
    const int id = k + 2;
    const double across = (a * a + h * h) / 12, along = a * a / 6;
    text += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP={1},{1},{2}, QG={3},{4},{5}, REULER={6},0,0\nMARKER/{0}0, PART={0}\n"
        "MARKER/{0}1, PART={0}, QP={7},{7},{8}\nMARKER/{0}2, PART={0}, QP=0,0,{8}\n",
        id, across, along, (k % 2 ? -0.004 : 0.004) * k * L, 0.003 * k * L, (k + 0.5) * h, 0.2 * k, -a / 2, -h / 2);
    text += fmt::format("GRAPHICS/{}, {}\n", id, fmt::format(fmt::runtime(t.shape), id, a, h, a / 2));
    text += fmt::format(
        "CONTACT/{}, IGEOM={}, JGEOM={}, IMPACT, STIFFNESS={}, EXPONENT=1.5, DAMPING={}, DMAX={}{}\n", k + 1, id,
        id - 1, 2e5 / std::pow(L, 1.5), 200 / L, 0.001 * L,
        t.rubs ? fmt::format(", COULOMB_FRICTION=ON, MU_STATIC=0.4, MU_DYNAMIC=0.3, STICTION_TRANSITION_VELOCITY={}, "
                             "FRICTION_TRANSITION_VELOCITY={}",
                             0.01 * L, 0.1 * L)
               : "");
  }
  return text + "END\n";
}

class Towers : public Cases {
 protected:
  // What each level bears, from below; empty where it was refused.
  std::vector<double> borne(const Tower& t) const {
    const RunResult r = run(dataset(t), "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return {};
    EXPECT_THAT(r.out, HasSubstr("unstable"));
    std::vector<double> forces;
    for (const auto& f : r.result(0).at("operating_point").at("forces")) {
      const auto F = f.at("force").get<std::vector<double>>();
      forces.push_back(std::hypot(F[0], F[1], F[2]));
    }
    return forces;
  }
  void expect_to_stand(const Tower& t) const {
    const auto forces = borne(t);
    ASSERT_EQ(forces.size(), static_cast<std::size_t>(t.count));
    for (int k = 0; k < t.count; ++k)
      EXPECT_NEAR(forces[static_cast<std::size_t>(k)], (t.count - k) * weight, 1e-8) << t.count << " level " << k;
  }
};

TEST_F(Towers, of_boxes_are_at_rest_in_all_units) {
  for (const int count : {2, 3}) {
    for (const double length : {1.0, 1000.0}) expect_to_stand({count, length, count == 3});
  }
  expect_to_stand({5, 1000});
}

TEST_F(Towers, of_cylinders_and_frusta_are_at_rest) {
  for (const int count : {2, 3}) {
    expect_to_stand({count, 1, false, "CYLINDER, CM={0}2, LENGTH={2}, RADIUS={3}"});
    expect_to_stand({count, 1, true, "FRUSTUM, CM={0}2, LENGTH={2}, BOTTOM={3}, TOP={2}"});
  }
}

TEST_F(Towers, of_balls_are_at_rest) {
  for (const int count : {2, 3})
    expect_to_stand({count, 1, false, "ELLIPSOID, CM={0}0, XSCALE={2}, YSCALE={2}, ZSCALE={2}"});
}

}  // namespace
}  // namespace dynalin::cases::tower_test
