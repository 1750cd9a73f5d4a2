// A flexible body of lumps that slide, against the mechanism of rigid parts that it is: by a file, by matrices, with
// modal loads.
#include "cases/sliding_lumps.h"

#include <gmock/gmock.h>

namespace dynalin::cases::sliding_lumps_test {
namespace {

using namespace sliding_lumps;
using ::testing::HasSubstr;

class SlidingLumps : public Cases {};

constexpr const char* linear_of_lumps = "SIM/INITIAL\nLINEAR/STATEMAT, PSTATE=1, PINPUT=1, POUTPUT=1, FILE=x\nSTOP\n";

TEST_F(SlidingLumps, lumps_that_slide_on_a_turning_body_have_the_linear_model_of_parts) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  expect_equal_models(run(two_lumps(false), linear_of_lumps), run(two_lumps(true), linear_of_lumps), 1e-9);
}

TEST_F(SlidingLumps, lumps_move_like_parts) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  for (const char* way :
       {"SIM/DYN, END=0.2, STEPS=20\nLINEAR/STATEMAT, PSTATE=1, PINPUT=1, POUTPUT=1, FILE=x\nSTOP\n"}) {
    SCOPED_TRACE(way);
    const RunResult flexible = run(two_lumps(false), way), rigid = run(two_lumps(true), way);
    ASSERT_EQ(flexible.status, 0) << flexible.err << flexible.message;
    ASSERT_EQ(rigid.status, 0) << rigid.err << rigid.message;
    const Eigen::MatrixXd found = matrix_of(flexible.matrix(1, "A")), expected = matrix_of(rigid.matrix(1, "A"));
    ASSERT_EQ(found.rows(), expected.rows());
    // To the tolerance of the integrator.
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 2e-3 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_F(SlidingLumps, is_the_same_by_matrices_as_by_a_file) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  expect_equal_models(run(lumps_with(false, ""), linear_of_lumps), run(two_lumps(false), linear_of_lumps), 1e-10);
}

// What pushes lump A away from the core, and what pushes the core alone against the pendulum.
TEST_F(SlidingLumps, takes_modal_loads_as_parts_take_forces) {
  const Vector push{0.7, -0.4, 1.1}, force{3, -2, 1.5}, torque{0.4, 0.9, -0.6};
  const std::string first = "2+3*VX(52,1,1)+4*DX(51,1)", second = "1.5*VARVAL(9)+0.3*DY(52,2)+SIN(DZ(51,1))";
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(9, 2);
  loads(6, 0) = dot(a1, push), loads(7, 0) = dot(a2, push);
  loads.col(1).head(6) << force.x, force.y, force.z, torque.x, torque.y, torque.z;
  const std::string floating = "MARKER/7, PART=5, FLOATING\n";
  std::string vforce = "VFORCE/8, I=32, JFLOAT=6, RM=22", gforce = "GFORCE/9, I=24, JFLOAT=7, RM=24";
  for (std::size_t c = 0; c < 3; ++c) {
    vforce += fmt::format(", F{}={}*({}){}", "XYZ"[c], push[c], first, c < 2 ? "\\" : "\n");
    gforce += fmt::format(", F{0}={1}*({2})\\ , T{0}={3}*({2}){4}", "XYZ"[c], force[c], second, torque[c],
                          c < 2 ? "\\" : "\n");
  }
  std::string flexible = lumps_with(false,
                                    floating + "MFORCE/1, FLEX_BODY=2, CASE_INDEX=1, SCALE=" + first +
                                        "\nMFORCE/2, FLEX_BODY=2, JFLOAT=7, CASE_INDEX=2, SCALE=" + second + "\n",
                                    loads);
  std::string rigid = lumps_with(true, floating + "MARKER/6, PART=2, FLOATING\nMARKER/24, PART=2\n" + vforce + gforce);
  expect_equal_models(run(flexible, linear_of_lumps), run(rigid, linear_of_lumps), 1e-9);
  // Driven about its hinge, and free to turn there: then loads turn with it.
  const std::string drive = "MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=9*TIME\n";
  for (std::string* t : {&flexible, &rigid}) t->erase(t->find(drive), drive.size());
  expect_equal_models(run(flexible, linear_of_lumps), run(rigid, linear_of_lumps), 1e-9);
}

TEST_F(SlidingLumps, matrices_that_do_not_fit_are_errors) {
  const std::string head = "Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  const std::string body = "FLEX_BODY/2, MATRICES=100,101,102,103,104,105,106,107,108,109,110,111,112\n";
  std::string data = matrices_of(nodes_of_lumps(), stiffness, {});
  const auto said = [&](const std::string& text) { return run(head + text + "END\n", "LINEAR/EIGENSOL\nSTOP\n").err; };
  EXPECT_THAT(said(body + std::string(data).replace(data.find("NAME=INVAR3"), 11, "NAME=GENDAMP")),
              HasSubstr("FLEX_BODY/2 lacks INVAR3 among its MATRICES"));
  EXPECT_THAT(said(body + std::string(data).replace(data.find("NAME=INVAR3"), 11, "NAME=INVAR33")),
              HasSubstr("is named INVAR33, which is none"));
  EXPECT_THAT(said(body + std::string(data).replace(data.find("NAME=INVAR4"), 11, "NAME=INVAR3")),
              HasSubstr("has two matrices INVAR3"));
  const std::string size = "NAME=INVAR3, FULL=CORDER, ROWS=3, COLUMNS=3",
                    turned = "NAME=INVAR3, FULL=CORDER, ROWS=9, COLUMNS=1";
  EXPECT_THAT(said(body + std::string(data).replace(data.find(size), size.size(), turned)),
              HasSubstr("INVAR3 (MATRIX/103) of FLEX_BODY/2 must be 3 × 3, it is 9 × 1"));
  const std::string mass = "NAME=INVAR1, FULL=CORDER, ROWS=1, COLUMNS=1, VALUES=";
  const std::size_t value = data.find(mass) + mass.size();
  EXPECT_THAT(said(body + std::string(data).replace(value, data.find('\n', value) - value, "0")),
              HasSubstr("the mass 0 in FLEX_BODY/2 is not positive"));
  EXPECT_THAT(said("FLEX_BODY/2, MATRICES=100,999\n" + data), HasSubstr("999"));
  EXPECT_THAT(said(body + data + "MFORCE/1, FLEX_BODY=2, CASE_INDEX=1, SCALE=1\n"),
              HasSubstr("MFORCE/1 takes a modal load, and FLEX_BODY/2 has none"));
}

}  // namespace
}  // namespace dynalin::cases::sliding_lumps_test
