#include "selected_modes/inertia_count.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eigenvalues/eigen.h"
#include "perturbation/perturbation.h"
#include "system/model_test_support.h"
#include "system/shifted_lu.h"

namespace dynalin::inertia_count_test {
namespace {

using Complex = std::complex<double>;

ModeRegion disc(double on_axis, double radius) {
  ModeRegion r;
  r.centre = {0, on_axis}, r.radius = radius;
  return r;
}
ModeRegion band(double low, double high) {
  ModeRegion r;
  r.low = low, r.high = high, r.left = -high, r.right = high, r.is_disc = false;
  return r;
}
LinearOptions without_damping() {
  LinearOptions o;
  o.without_damping = true;
  return o;
}

struct Model {
  explicit Model(const std::string& text, const LinearOptions& options = {}) : system(system_test::system_of(text)) {
    Findings findings;
    const auto op = initial_conditions(*system, findings);
    if (!op) throw std::runtime_error(op.error().message);
    auto made = linearize(*system, *op, options);
    if (!made) throw std::runtime_error(made.error().message);
    linear = std::move(*made);
  }
  // Both ways agree between any two values.
  void expect_right_counts() const {
    const auto model = ConservativeModel::make(linear);
    ASSERT_TRUE(model);
    InertiaCount counter(model);
    const auto all = eigensolve(linear);
    ASSERT_TRUE(all);
    std::vector<Complex> values;
    std::vector<double> borders{0};
    for (const EigenMode& m : all->modes) {
      const Complex v = m.eigenvalue_hz * (2 * std::acos(-1.0));
      values.push_back(v);
      if (!m.is_real) values.push_back(std::conj(v));
      borders.push_back(std::abs(v));
    }
    std::sort(borders.begin(), borders.end());
    borders.push_back(1.5 * borders.back());
    std::vector<ModeRegion> regions;
    for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
      if (borders[k + 1] < borders[k] * 1.001 + 1e-3) continue;
      const double between = 0.5 * (borders[k] + borders[k + 1]);
      regions.push_back(disc(0, between));
      regions.push_back(band(0, between));
      for (std::size_t j = 0; j < k; j += 2) {
        if (borders[j + 1] < borders[j] * 1.001 + 1e-3) continue;
        const double low = 0.5 * (borders[j] + borders[j + 1]);
        regions.push_back(band(low, between));
        regions.push_back(disc(0.5 * (low + between), 0.5 * (between - low)));
        regions.push_back(disc(0.5 * (between - low), 0.5 * (low + between)));
      }
    }
    ASSERT_GT(regions.size(), 4u);
    ShiftedLu lu(linear.equations->products(), linear.equations->states());
    int compared = 0;
    for (const ModeRegion& r : regions) {
      const auto inside = [&](Complex v) { return r.has(v); };
      const auto expected = std::count_if(values.begin(), values.end(), inside);
      if (std::any_of(values.begin(), values.end(), [&](Complex v) { return r.distance_to_border(v) < 1e-3; }))
        continue;
      EXPECT_EQ(counter.eigenvalues_inside(r), expected)
          << r.centre << " " << r.radius << " " << r.low << " " << r.high;
      if (++compared > 12) continue;
      EXPECT_EQ(eigenvalues_inside(lu, r.border(), values, inside), expected);
    }
    EXPECT_GT(compared, 4);
  }
  bool is_counted() const { return ConservativeModel::make(linear) != nullptr; }

  std::shared_ptr<const System> system;
  LinearSystem linear;
};

const std::string gravity = "ACCGRAV/JGRAV=-9.81\n";

// Links on hinges, below each other or, with step 1, on top of each other.
std::string links(int n, double step, double speed = 0) {
  std::string s = gravity;
  for (int k = 1; k <= n; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=1,1,1, QG=0,{1},0\nMARKER/{0}0\nMARKER/{0}1, QP=0,{2},0\nJOINT/{0}, REVOLUTE, "
        "I={0}1, J={3}\n",
        k + 1, step * k, -step, k == 1 ? std::string("1") : fmt::format("{}0", k));
  }
  if (speed != 0) s.replace(s.find("QG="), 3, fmt::format("WZ={}, VX={}, QG=", speed, -step * speed));
  return s;
}

TEST(InertiaCount, is_the_winding_number_of_hanging_links) { Model(links(6, -1)).expect_right_counts(); }

// Real eigenvalues in pairs ±.
TEST(InertiaCount, is_the_winding_number_of_links_that_fall_over) { Model(links(5, 1)).expect_right_counts(); }

// A closed loop in space with redundant rows, whose joints carry loads, and a spring.
TEST(InertiaCount, leaves_redundant_rows_out) {
  const std::string text = gravity +
                           "PART/2, MASS=2, CM=20, IP=1,2,3, QG=0,-1,0\nMARKER/20\nMARKER/21, QP=0,1,0\nMARKER/22\n"
                           "PART/3, MASS=2, CM=30, IP=1,2,3, QG=2,-1,0\nMARKER/30\nMARKER/31, QP=0,1,0\nMARKER/32\n"
                           "PART/4, MASS=2, CM=40, IP=1,2,3, QG=1,-1,0\nMARKER/40\nMARKER/41, QP=-1,0,0\n"
                           "MARKER/42, QP=1,0,0\nMARKER/2, PART=1, QP=2,0,0\n"
                           "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=2\nJOINT/3, REVOLUTE, I=41, J=22\n"
                           "JOINT/4, REVOLUTE, I=42, J=32\n"
                           "PART/5, MASS=1, CM=50, IP=1,1,1, QG=1,-3,0\nMARKER/50\nMARKER/51, QP=0,2,0\n"
                           "JOINT/5, SPHERICAL, I=51, J=40\nBUSHING/1, I=50, J=40, KT=5,6,7\n";
  Model(text).expect_right_counts();
}

// Six free motions: each a zero twice. And bodies without inertia about the axis that a joint holds.
TEST(InertiaCount, takes_zeros_twice) {
  Model(
      "PART/2, MASS=2, CM=20, IP=1,2,3\nMARKER/20\nPART/3, MASS=3, CM=30, IP=3,2,1, QG=1,0,0\nMARKER/30\n"
      "BUSHING/1, I=30, J=20, K=100,200,300, KT=10,20,30\n")
      .expect_right_counts();
}

TEST(InertiaCount, needs_mass_only_where_constraints_leave_motions) {
  std::string text;
  for (int k = 2; k <= 4; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, QG=0,0,{0}\nMARKER/{0}0\nJOINT/{0}, TRANSLATIONAL, I={0}0, J=1\n"
        "SPRINGDAMPER/{0}, TRANSLATION, I={0}0, J={1}, K=100, LENGTH=1\n",
        k, k == 2 ? std::string("1") : fmt::format("{}0", k - 1));
  }
  Model(text).expect_right_counts();
}

TEST(InertiaCount, is_none_of_models_of_another_kind) {
  EXPECT_TRUE(Model(links(2, -1)).is_counted());
  EXPECT_FALSE(Model(links(2, -1, 3)).is_counted()) << "it turns";
  const std::string damper = "BUSHING/1, I=20, J=1, CT=1,1,1\n";
  EXPECT_FALSE(Model(links(2, -1) + damper).is_counted()) << "it is damped";
  EXPECT_TRUE(Model(links(2, -1) + damper, without_damping()).is_counted()) << "damping is left out";
  const std::string state = "DIFF/1, FUNCTION=-DIF(1)\n";
  EXPECT_FALSE(Model(links(2, -1) + state).is_counted()) << "a state of another kind";
  const std::string follower = "SFORCE/1, TRANSLATION, ACTIONONLY, I=30, J=31, FUNCTION=-4\n";
  EXPECT_FALSE(Model(links(2, -1) + follower).is_counted()) << "the force turns with the link: no potential";
}

// Links about to fall: accelerations are constraints' own partials then, and no symmetric form has them.
TEST(InertiaCount, is_not_trusted_away_from_an_equilibrium) {
  const Model m(gravity +
                "PART/2, MASS=2, CM=20, IP=1,1,1, QG=1,0,0\nMARKER/20\nMARKER/21, QP=-1,0,0\n"
                "JOINT/2, REVOLUTE, I=21, J=1\nPART/3, MASS=2, CM=30, IP=1,1,1, QG=2,0,0\nMARKER/30\n"
                "MARKER/31, QP=-1,0,0\nJOINT/3, REVOLUTE, I=31, J=20\n"
                "BUSHING/1, I=20, J=1, KT=3,3,3\n");
  const auto model = ConservativeModel::make(m.linear);
  EXPECT_FALSE(model && InertiaCount(model).below(1.0));
}

}  // namespace
}  // namespace dynalin::inertia_count_test
