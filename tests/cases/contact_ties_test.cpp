// Contacts where two places are as deep as each other, and where a law ends: refused or named, wherever the model
// stands.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "cases/run.h"

namespace dynalin::cases::contact_ties_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string law = ", IMPACT, STIFFNESS=2E4, EXPONENT=1.5, DAMPING=40, DMAX=0.01\n";

class ContactTies : public Cases {
 protected:
  // Shape 1 on ground, shape 2 on a part at a place and attitude seen from it, all turned by an angle about y.
  RunResult turned(const std::string& on_ground, const std::string& on_part, const std::string& at,
                   double angle) const {
    return run(fmt::format("Tie\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=0.3,-0.2,0.7, REULER=0.4,{},0\n"
                           "PART/2, MASS=2, CM=2, IP=0.02,0.03,0.04, QG=0.3,-0.2,0.7, REULER=0.4,{},0\nMARKER/2, {}\n"
                           "MARKER/3, QP=1,0,0, PART=2\nGRAPHICS/1, {}\nGRAPHICS/2, {}\nCONTACT/4, IGEOM=2, JGEOM=1{}"
                           "END\n",
                           angle, angle, at, on_ground, on_part, law),
               "LINEAR/EIGENSOL\n");
  }
};

const std::string box = "BOX, CORNER=1, X=1, Y=1, Z=1", cylinder = "CYLINDER, CM=1, LENGTH=1, RADIUS=0.3",
                  torus = "TORUS, CM=1, MAJOR=0.2, MINOR=0.05",
                  egg = "ELLIPSOID, CM=1, XSCALE=0.2, YSCALE=0.3, ZSCALE=0.4", point = "POINT, RM=2",
                  ball = "ELLIPSOID, CM=2, XSCALE=0.1, YSCALE=0.1, ZSCALE=0.1",
                  bean = "ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.3, ZSCALE=0.25",
                  bar = "CYLINDER, CM=2, LENGTH=1, RADIUS=0.1";

TEST_F(ContactTies, have_no_linear_model_however_the_whole_is_turned) {
  const std::vector<std::array<std::string, 3>> ties = {
      {box, point, "QP=0.01,0.01,0.5"},                    // as deep from two faces
      {box, ball, "QP=0.03,0.5,0.03"},                     // with its centre inside
      {box, ball, "QP=0.5,0.5,0.5"},                       // in the middle
      {box, ball, "QP=1,1,0.5"},                           // its centre on an edge
      {box, bean, "QP=0.5,0.5,0.5"},                       //
      {cylinder, point, "QP=0.2,0,0.1"},                   // mantle and end
      {cylinder, ball, "QP=0,0.2,0.9"},                    //
      {cylinder, ball, "QP=0,0,0.5"},                      // on the axis
      {torus, bar, "QP=-0.5,0,0.1495, REULER=90D,90D,0"},  // across a ring, on both sides
      {egg, bean, "QP=0,0,0"},                             // in each other with one centre
      {"ELLIPSOID, CM=1, XSCALE=0.2, YSCALE=0.3, ZSCALE=0.4", point, "QP=0,0,0"},
  };
  for (const auto& [on_ground, on_part, at] : ties) {
    for (const double angle : {0.0, 0.3, 1.9}) {
      const RunResult r = turned(on_ground, on_part, at, angle);
      EXPECT_NE(r.status, 0) << on_ground << ' ' << on_part << ' ' << angle << '\n' << r.out;
      EXPECT_THAT(r.err, HasSubstr("CONTACT/4 touch")) << on_ground << ' ' << on_part << ' ' << angle;
    }
  }
}

// A thousandth beside the tie there is one place, the same for all attitudes.
TEST_F(ContactTies, are_gone_beside_them) {
  for (const auto& [on_ground, on_part, at] :
       std::vector<std::array<std::string, 3>>{{box, point, "QP=0.01,0.011,0.5"},
                                               {box, ball, "QP=0.03,0.5,0.031"},
                                               {box, bean, "QP=0.52,0.51,0.53"},
                                               {cylinder, point, "QP=0.2,0,0.101"},
                                               {cylinder, ball, "QP=0,0.001,0.5"},
                                               {torus, bar, "QP=-0.5,0,0.145, REULER=90D,89.9D,0"},
                                               {egg, bean, "QP=0.001,0,0"}}) {
    std::vector<std::complex<double>> first;
    for (const double angle : {0.0, 0.3, 1.9}) {
      const RunResult r = turned(on_ground, on_part, at, angle);
      ASSERT_EQ(r.status, 0) << on_ground << ' ' << on_part << ' ' << r.err;
      auto values = r.eigenvalues(0);
      std::ranges::sort(values, {}, [](const std::complex<double>& v) { return std::abs(v); });
      if (first.empty()) first = values;
      ASSERT_EQ(values.size(), first.size());
      EXPECT_GT(std::abs(values.back()), 0.1);
      for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_NEAR(std::abs(values[k]), std::abs(first[k]), 1e-8 * std::abs(first.back()));
    }
  }
}

const std::string on_floor =
    "Brink\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\nMARKER/3, PART=2, QP=1,0,{}\n"
    "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, {}\nMARKER/2\nJOINT/1, TRANSLATIONAL, I=2, J=4\nMARKER/4, PART=1, "
    "QP={},0,0\n"
    "GRAPHICS/1, PLANE, RM=1, XMIN=-3, XMAX=3, YMIN=-3, YMAX=3\n"
    "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
    "GRAPHICS/3, ELLIPSOID, CM=3, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\nCONTACT/1, IGEOM=2,3, JGEOM=1{}END\n";

// One ball presses, and the other one on the same body just touches.
TEST_F(ContactTies, a_place_that_just_touches_is_named_beside_one_that_presses) {
  const auto with = [&](const char* higher) {
    return run(fmt::format(fmt::runtime(on_floor), higher, "QG=0,0,0.099", 0, law), "LINEAR/EIGENSOL\n");
  };
  EXPECT_THAT(with("0.001").err, AllOf(HasSubstr("CONTACT/1 is just touching"), HasSubstr("that where it is open")));
  EXPECT_THAT(with("0.0011").err, Not(HasSubstr("touching-contact")));
  EXPECT_THAT(with("0.0009").err, Not(HasSubstr("touching-contact")));
}

// STIFFNESS 0.01^1.5 = 20 = DAMPING · 0.5, with all of the damper.
TEST_F(ContactTies, one_whose_damper_takes_the_whole_pressure_is_named) {
  const auto parting = [&](const char* speed) {
    return run(fmt::format(fmt::runtime(on_floor), "1", fmt::format("QG=0,0,0.09, VZ={}", speed), 0, law),
               "LINEAR/EIGENSOL\n");
  };
  EXPECT_THAT(parting("0.5").err, HasSubstr("CONTACT/1 is just letting go"));
  EXPECT_THAT(parting("0.501").err, Not(HasSubstr("touching-contact")));
  EXPECT_THAT(parting("0.499").err, Not(HasSubstr("touching-contact")));
}

TEST_F(ContactTies, one_above_the_edge_of_its_plane_is_named) {
  const auto at = [&](double x) {
    return run(fmt::format(fmt::runtime(on_floor), "1", fmt::format("QG={},0,0.099", x), x, law), "LINEAR/EIGENSOL\n");
  };
  EXPECT_THAT(at(3).err, HasSubstr("CONTACT/1 is just at the edge of its plane"));
  EXPECT_THAT(at(2.999).err, Not(HasSubstr("touching-contact")));
  EXPECT_THAT(at(3.001).err, Not(HasSubstr("touching-contact")));
}

}  // namespace
}  // namespace dynalin::cases::contact_ties_test
