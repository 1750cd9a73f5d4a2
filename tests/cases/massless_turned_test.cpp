// Freedoms without mass have the same spectrum however the model stands, and however the axes of their part lie on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "cases/dataset_text.h"

namespace dynalin::cases::massless_turned_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Complex = std::complex<double>;

// The axes of all, and those of the part without mass on itself.
struct Turn {
  Matrix3 all = Matrix3::identity(), part = Matrix3::identity();
};

Matrix3 random_rotation(std::minstd_rand& random) {
  std::uniform_real_distribution<double> draw(-std::numbers::pi, std::numbers::pi);
  const double x = draw(random), y = draw(random), z = draw(random);
  return rotation_exponential(Vector{x, y, z});
}

std::vector<Turn> turns() {
  std::minstd_rand random(7);
  std::vector<Turn> list;
  for (int drawn = 0; drawn < 4; ++drawn) {
    const Matrix3 all = random_rotation(random), part = random_rotation(random);
    list.push_back({all, Matrix3::identity()});
    list.push_back({Matrix3::identity(), part});
    list.push_back({all, part});
  }
  return list;
}

// A marker whose place and axes are those of a part as it is drawn at the origin, upright.
std::string marker(int id, const Matrix3& axes, const Vector& at = {}, const Matrix3& own = Matrix3::identity()) {
  return fmt::format("MARKER/{}, QP={}, REULER={}\n", id, xyz(axes * at), reuler(axes * own));
}

// Ground with the markers 1 and 11–13, PART/2 with mass and the markers 20–23, and PART/6 without, with 60–63. Those
// of the same last digit stand on each other.
std::string parts(const Turn& t, const std::string& more, const Vector& gravity = {}) {
  const Matrix3 back = transpose(t.part);
  const Matrix3 none = Matrix3::identity(), bent = rotation_exponential(Vector{0.3, -0.5, 0.4});
  const Vector a{0.3, 0.1, -0.2}, b{-0.1, 0.2, 0.15};
  const Vector g = t.all * gravity;
  std::string text = fmt::format(
      "Turned\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV={:.17g}, JGRAV={:.17g}, KGRAV={:.17g}\n"
      "PART/1, GROUND\n",
      g.x, g.y, g.z);
  text += marker(1, t.all) + marker(11, t.all, a) + marker(12, t.all, b, bent) + marker(13, t.all, {}, bent);
  text += fmt::format("PART/2, MASS=3, CM=20, IP=0.2,0.3,0.25, REULER={}\n", reuler(t.all));
  text += marker(20, none) + marker(21, none, a) + marker(22, none, b, bent) + marker(23, none, {}, bent);
  text += fmt::format("PART/6, REULER={}\n", reuler(t.all * t.part));
  text += marker(60, back) + marker(61, back, a) + marker(62, back, b, bent) + marker(63, back, {}, bent);
  return text + "BUSHING/9, I=20, J=1, K=100,200,300, KT=10,20,30\n" + more + "END\n";
}

class MasslessTurned : public Cases {
 protected:
  void expect_same_however_turned(const std::string& more, const std::string& before = "", const Vector& gravity = {},
                                  double relative = 1e-12) const {
    const auto solve = [&](const Turn& t) {
      const RunResult r = run(parts(t, more, gravity), before + "LINEAR/EIGENSOL\n");
      EXPECT_EQ(r.status, 0) << r.err;
      EXPECT_THAT(r.err, HasSubstr("PART/6 has no mass"));
      EXPECT_THAT(r.err, Not(HasSubstr("[lost-digits]")));
      EXPECT_THAT(r.err, Not(HasSubstr("[massless-runaway]")));
      return r.status == 0 ? r.eigenvalues(r.json.at("results").size() - 1) : std::vector<Complex>{};
    };
    const auto upright = solve({});
    ASSERT_GT(upright.size(), 6u);
    for (const Turn& t : turns()) expect_same(solve(t), upright, relative);
  }
};

const std::string held = "BUSHING/1, I=62, J=12, K=50,60,70, KT=5,6,7\n";
const std::string damped = "BUSHING/1, I=62, J=12, K=50,60,70, KT=5,6,7, C=1,2,0.5, CT=0.1,0.3,0.2\n";

TEST_F(MasslessTurned, what_joints_leave_open_and_bushings_hold) {
  for (const char* joint : {"REVOLUTE", "CYLINDRICAL", "TRANSLATIONAL", "PLANAR", "SPHERICAL"}) {
    SCOPED_TRACE(joint);
    const std::string text = fmt::format("JOINT/1, {}, I=63, J=23\n", joint);
    expect_same_however_turned(text + held);
    expect_same_however_turned(text + damped);
  }
}

TEST_F(MasslessTurned, what_primitives_leave_open_and_bushings_hold) {
  for (const char* primitive : {"INPLANE, I=61, J=11", "INLINE, I=61, J=21", "ORIENTATION, I=61, J=21",
                                "PARALLEL_AXES, I=60, J=20", "ATPOINT, I=61, J=21"}) {
    SCOPED_TRACE(primitive);
    const std::string text = fmt::format("JPRIM/1, {}\n", primitive);
    expect_same_however_turned(text + held);
    expect_same_however_turned(text + damped);
  }
}

// Loads that leave velocities of rounding and reactions of all sizes.
TEST_F(MasslessTurned, what_is_loaded_and_at_rest) {
  for (const char* joint : {"JOINT/1, REVOLUTE, I=63, J=23\n", "JPRIM/1, INPLANE, I=61, J=11\n",
                            "GCON/1, FUNCTION=DM(61,13)-0.374165738677394139\n"}) {
    SCOPED_TRACE(joint);
    for (const std::string& bushing : {held, damped}) {
      std::string loaded = bushing;
      loaded.insert(loaded.size() - 1, ", FORCE=1,-2,1.5");
      expect_same_however_turned(joint + loaded, "SIMULATE/STATICS\n", {0.4, -1, 0.7}, 1e-9);
    }
  }
}

// J θ″ = −(k₁ + c s)(θ − φ) and (k₁ + c s)(φ − θ) + k₂ φ = 0, with J about the hinge.
TEST_F(MasslessTurned, a_wheel_on_a_hinge_in_closed_form) {
  const double J = 0.25, k1 = 5, k2 = 7, c = 0.3;
  const auto polynomial = [&](Complex s) { return J * s * s * (c * s + k1 + k2) + k2 * (k1 + c * s); };
  for (const Turn& t : turns()) {
    const Matrix3 back = transpose(t.part);
    const RunResult r =
        run(fmt::format("Wheel\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n{}PART/2, MASS=3, CM=20, IP=0.2,0.3,0.25\n{}PART/6, "
                        "REULER={}\n{}JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=60, J=1\n"
                        "SPRINGDAMPER/1, ROTATIONAL, I=60, J=20, KT={}, CT={}\n"
                        "SPRINGDAMPER/2, ROTATIONAL, I=60, J=1, KT={}\nEND\n",
                        marker(1, t.all), marker(20, t.all), reuler(t.part), marker(60, back * t.all), k1, c, k2),
            "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto values = r.eigenvalues(0);
    ASSERT_EQ(values.size(), 3u);
    for (const Complex& v : values) {
      const Complex s = 2 * std::numbers::pi * v;
      EXPECT_LE(std::abs(polynomial(s)), 1e-11 * polynomial(std::abs(s)).real()) << s;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::massless_turned_test
