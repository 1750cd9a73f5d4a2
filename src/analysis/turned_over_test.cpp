#include "analysis/turned_over.h"

#include <gtest/gtest.h>

#include "base/vec3.h"
#include "system/model_test_support.h"

namespace dynalin::turned_over_test {
namespace {

// A part on a joint about or along z, drawn in line with ground, and then turned by half a turn about an axis.
struct Turned {
  std::shared_ptr<const System> system;

  explicit Turned(const std::string& joint)
      : system(system_test::system_of("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1\n"
                                      "MARKER/30\nJOINT/9, SPHERICAL, I=30, J=1\n" +
                                      joint + ", I=20, J=1\n")) {}
  std::string about(const Vector& axis) const {
    const OperatingPoint from = system->drawn();
    OperatingPoint to = from;
    to.poses[1].R = rotation_exponential(3.141592653589793 * axis);
    const ElementLabel* joint = turned_over(*system, from, to);
    return joint ? joint->text() : "";
  }
};

TEST(TurnedOver, is_a_joint_whose_axis_points_the_other_way) {
  for (const std::string keyword : {"REVOLUTE", "CYLINDRICAL", "PLANAR", "TRANSLATIONAL", "FIXED"}) {
    const Turned part("JOINT/1, " + keyword);
    EXPECT_EQ(part.about({1, 0, 0}), "JOINT/1") << keyword;
    EXPECT_EQ(part.about({0, 0, 0}), "") << keyword;
  }
  EXPECT_EQ(Turned("JPRIM/1, PARALLEL_AXES").about({1, 0, 0}), "JPRIM/1");
}

TEST(TurnedOver, half_a_turn_about_its_axis_is_a_motion_of_a_hinge_and_none_of_a_guide) {
  for (const std::string keyword : {"REVOLUTE", "CYLINDRICAL", "PLANAR"})
    EXPECT_EQ(Turned("JOINT/1, " + keyword).about({0, 0, 1}), "") << keyword;
  for (const std::string keyword : {"TRANSLATIONAL", "FIXED"})
    EXPECT_EQ(Turned("JOINT/1, " + keyword).about({0, 0, 1}), "JOINT/1") << keyword;
}

TEST(TurnedOver, a_ball_may_be_anywhere) {
  EXPECT_EQ(Turned("JOINT/1, SPHERICAL").about({1, 0, 0}), "");
  EXPECT_EQ(Turned("JPRIM/1, INLINE").about({1, 0, 0}), "");
}

}  // namespace
}  // namespace dynalin::turned_over_test
