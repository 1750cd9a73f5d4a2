// Joints whose axes are drawn in a way from which no turn brings them nearer to what the joint asks.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::drawn_axes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DrawnAxes : public Cases {
 protected:
  static std::string drawn(const std::string& joint, const std::string& angles) {
    return "Axes\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/12\n! adams_view_name='shaft'\nPART/2, MASS=1, CM=20, "
           "IP=1,1,1\nMARKER/20\n! adams_view_name='cross'\nMARKER/21, REULER=" +
           angles + "\n! adams_view_name='knuckle'\n" + joint + ", I=21, J=12\nEND\n";
  }
  std::string checked(const std::string& joint, const std::string& angles) const {
    write("model.adm", drawn(joint, angles));
    SessionOptions options;
    options.file = (folder_ / "model.adm").string();
    std::ostringstream out, err;
    const int status = check_file(options, out, err);
    EXPECT_EQ(status, err.str().find("error") == std::string::npos ? 0 : 1) << err.str();
    return err.str();
  }
};

TEST_F(DrawnAxes, of_crosses_must_be_perpendicular) {
  for (const char* parallel : {"0,0,0", "30D,0,0", "0,180D,0", "0,0.0001,0"}) {
    EXPECT_THAT(
        checked("JOINT/3, UNIVERSAL", parallel),
        AllOf(HasSubstr("model.adm:11:1: error: JOINT/3 (knuckle): the z axes of MARKER/21 and MARKER/12 must be "
                        "perpendicular, and are drawn parallel [parallel-axes]"),
              HasSubstr("hint: the z axes lie along the two bars of the cross")))
        << parallel;
    EXPECT_THAT(checked("JPRIM/3, PERPENDICULAR", parallel),
                HasSubstr("must be perpendicular, and are drawn parallel"));
  }
  EXPECT_THAT(checked("JOINT/3, HOOKE", "90D,0,0"),
              AllOf(HasSubstr("model.adm:11:1: error: JOINT/3 (knuckle): the x axis of MARKER/21 and the y axis of "
                              "MARKER/12 must be perpendicular, and are drawn parallel"),
                    HasSubstr("hint: the z axes lie along the shafts")));
  EXPECT_THAT(checked("JOINT/3, CONVEL", "90D,0,0"), HasSubstr("error: JOINT/3 (knuckle): the angle from x of "));
  // Any other drawing can be assembled.
  for (const char* joint : {"JOINT/3, UNIVERSAL", "JPRIM/3, PERPENDICULAR"}) {
    EXPECT_EQ(checked(joint, "0,90D,0"), "");
    EXPECT_EQ(checked(joint, "0,20D,0"), "");
  }
  EXPECT_EQ(checked("JOINT/3, HOOKE", "0,0,0"), "");
  EXPECT_EQ(checked("JOINT/3, CONVEL", "0,0,0"), "");
}

// Axes that are drawn parallel, and were turned until they are not when a command asks for it.
TEST_F(DrawnAxes, of_a_joint_that_a_command_defines_may_have_been_turned_before) {
  const std::string door =
      "Door\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, PART=1, REULER=90D,90D,0\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2, REULER=90D,90D,0\nMARKER/21, PART=2\n"
      "JOINT/1, REVOLUTE, I=20, J=2\nMOTION/1, JOINT=1, FUNCTION=TIME\nJPRIM/1, PARALLEL_AXES, I=20, J=2\nEND\n";
  const std::string defined = "DEACTIVATE/MOTION, ID=1\nJPRIM/1, PERPENDICULAR, I=21, J=1\n";
  const RunResult turned =
      run(door, "SIMULATE/KINEMATICS, END=1.5707963267948966\n" + defined + "SIMULATE/INITIAL_CONDITIONS\n");
  EXPECT_EQ(turned.status, 0) << turned.err;
  EXPECT_THAT(turned.err, HasSubstr("warning: JPRIM/1: the z axes of MARKER/21 and MARKER/1 must be perpendicular, and "
                                    "are drawn parallel"));
  // As it is drawn nothing can be assembled, and the reason stands above.
  const RunResult drawn = run(door, defined + "SIMULATE/INITIAL_CONDITIONS\n");
  EXPECT_NE(drawn.status, 0);
  EXPECT_THAT(drawn.err, HasSubstr("are drawn parallel"));
}

TEST_F(DrawnAxes, of_pinion_and_rack_must_not_be_parallel) {
  for (const char* parallel : {"0,0,0", "30D,0,0", "0,180D,0"}) {
    EXPECT_THAT(checked("JOINT/3, RACKPIN, PD=0.2", parallel),
                HasSubstr("model.adm:11:1: error: JOINT/3 (knuckle): the z axis of MARKER/21, about which the pinion "
                          "turns, and the z axis of MARKER/12, along the rack, are drawn parallel [parallel-axes]"))
        << parallel;
  }
  EXPECT_EQ(checked("JOINT/3, RACKPIN, PD=0.2", "0,90D,0"), "");
  EXPECT_EQ(checked("JOINT/3, RACKPIN, PD=0.2", "0,20D,0"), "");
}

TEST_F(DrawnAxes, of_hinges_must_be_parallel) {
  for (const char* joint : {"JOINT/3, REVOLUTE", "JOINT/3, CYLINDRICAL", "JOINT/3, TRANSLATIONAL", "JOINT/3, FIXED",
                            "JOINT/3, PLANAR", "JPRIM/3, PARALLEL_AXES", "JPRIM/3, ORIENTATION"}) {
    EXPECT_THAT(checked(joint, "0,90D,0"),
                HasSubstr("the z axes of MARKER/21 and MARKER/12 must be parallel, and are drawn perpendicular"))
        << joint;
    EXPECT_THAT(checked(joint, "0,70D,0"), Not(HasSubstr("error"))) << joint;
  }
  for (const char* joint : {"JOINT/3, FIXED", "JOINT/3, TRANSLATIONAL", "JPRIM/3, ORIENTATION"})
    EXPECT_THAT(checked(joint, "90D,0,0"), HasSubstr("the x axes of MARKER/21 and MARKER/12 must be parallel"))
        << joint;
  EXPECT_EQ(checked("JOINT/3, REVOLUTE", "90D,0,0"), "");
}

// A joint that is drawn well may be turned where its axes are stuck: another constraint wants them parallel.
TEST_F(DrawnAxes, that_others_make_parallel_are_named_where_the_assembly_ends) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, REULER=0,20D,0\n"
          "MARKER/20\nJPRIM/1, PARALLEL_AXES, I=20, J=1\nJOINT/2, UNIVERSAL, I=20, J=1\nEND\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("two axes that are parallel and must be perpendicular, cannot hold together"));
}

// An equation that nothing moves is no matter of axes.
TEST_F(DrawnAxes, are_not_blamed_where_there_are_none) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
          "GCON/1, FUNCTION=TIME-1\nEND\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("GCON/1"));
  EXPECT_THAT(r.err, Not(HasSubstr("axes")));
}

TEST_F(DrawnAxes, nothing_runs_where_they_are_impossible) {
  const RunResult r = run(drawn("JOINT/3, UNIVERSAL", "0,0,0"), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_FALSE(r.wrote("model.msg"));
  EXPECT_THAT(r.err, Not(HasSubstr("contradict")));
}

}  // namespace
}  // namespace dynalin::cases::drawn_axes_test
