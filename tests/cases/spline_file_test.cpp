// Files of a SPLINE with several lists of points: one of them is a curve, never all of them together.
#include <gmock/gmock.h>

#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::spline_file_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SplineFile : public Cases {
 protected:
  RunResult read(const std::string& file, const std::string& arguments) const {
    write("points.dat", file);
    return run("a curve out of a file\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nSPLINE/1, FILE=points.dat" +
                   arguments + "\nDIFF/1, IC=1, FUNCTION=AKISPL(3.5,0,1)*DIF(1)\nEND\n",
               "LINEAR/EIGENSOL\n");
  }
  // The curve at 3.5.
  double value(const std::string& file, const std::string& arguments = "") const {
    const RunResult r = read(file, arguments);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(0).at(0).real() * 2 * std::numbers::pi : 0;
  }
  std::string refusal(const std::string& file, const std::string& arguments = "") const {
    const RunResult r = read(file, arguments);
    EXPECT_EQ(r.status, 1) << file;
    EXPECT_THAT(r.err, HasSubstr("[spline-data]"));
    return r.err;
  }
};

// x², and another curve whose x goes on where the first ends.
const std::string front = "0 0\n1 1\n2 4\n3 9\n", rear = "4 2\n5 4\n6 7\n7 9\n";
const std::string header = "[MDI_HEADER]\n FILE_TYPE = 'spl'\n(COMMENTS)\n{comment_string}\n'measured twice'\n";

TEST_F(SplineFile, of_several_blocks_needs_the_one_that_is_meant) {
  const std::string file = "[FRONT]\n" + front + "[REAR]\n" + rear;
  EXPECT_THAT(refusal(file),
              AllOf(HasSubstr("model.adm:5:11: error: "), HasSubstr("points.dat holds points in [FRONT]"),
                    HasSubstr("[FRONT] and [REAR]: BLOCK is needed")));
  EXPECT_NEAR(value(file, ", BLOCK=front"), 12.25, 1e-9);
  EXPECT_THAT(refusal(front + "[REAR]\n" + rear), HasSubstr("the lines before any block and [REAR]: BLOCK is needed"));
  EXPECT_THAT(refusal(file, ", BLOCK=MIDDLE"),
              AllOf(HasSubstr("no points in the block [MIDDLE]"), HasSubstr("it holds points in [FRONT] and [REAR]")));
}

TEST_F(SplineFile, of_one_block_with_points_needs_no_name) {
  EXPECT_NEAR(value(front), 12.25, 1e-9);
  EXPECT_NEAR(value("[FRONT]\n" + front), 12.25, 1e-9);
  EXPECT_NEAR(value(header + "[UNITS]\n LENGTH = m\n[FRONT]\n{ x y }\n" + front), 12.25, 1e-9);
  EXPECT_NEAR(value(header + "[FRONT]\n(XY_DATA)\n{ x y }\n" + front, ", BLOCK=FRONT"), 12.25, 1e-9);
}

TEST_F(SplineFile, has_the_points_of_a_block_in_one_place) {
  for (const char* block : {"", ", BLOCK=FRONT"}) {
    EXPECT_THAT(refusal("[FRONT]\n" + front + "(MORE)\n" + rear, block),
                AllOf(HasSubstr("holds points in [FRONT] and in [FRONT](MORE), which are one block"),
                      HasSubstr("points.dat:7:1: note: points of the second")));
    EXPECT_THAT(refusal("[FRONT]\n" + front + "[FRONT]\n" + rear, block),
                AllOf(HasSubstr("[FRONT] stands twice in "), HasSubstr("points.dat:2:1: note: points of the first")));
  }
  EXPECT_THAT(refusal(front + "(MORE)\n" + rear), HasSubstr("the lines before any block and in (MORE)"));
}

TEST_F(SplineFile, says_which_line_is_none_of_numbers) {
  EXPECT_THAT(refusal("[FRONT]\n" + front + "4 x\n"), HasSubstr("points.dat:6:1: error: a line of numbers"));
  EXPECT_THAT(refusal("[FRONT]\n0 x\n"), HasSubstr("points.dat:2:1: error: a line of numbers"));
  EXPECT_THAT(refusal("[FRONT]\n{ x y }\n"), HasSubstr("points.dat holds no points"));
}

TEST_F(SplineFile, excludes_points_of_the_dataset) {
  const RunResult r = read(front, ", X=0,1,2,3");
  EXPECT_THAT(r.err, HasSubstr("FILE and X of SPLINE/1 exclude each other [excluded-arguments]"));
}

}  // namespace
}  // namespace dynalin::cases::spline_file_test
