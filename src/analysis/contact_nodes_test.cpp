// CONTACTs of bodies that deform: which of their shapes stand on one node, and so may be sides together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/initial.h"
#include "system/flexible_test_support.h"
#include "system/model_test_support.h"

namespace dynalin::system_test::contact_nodes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string bell(const std::string& rest) {
  std::string matrices = dumb_bell_matrices;
  const std::string still = "R_MODE, FULL=RORDER, ROWS=6, COLUMNS=1, VALUES=0,0,0,0,0,0";
  matrices.replace(matrices.find(still), still.size(),
                   "R_MODE, FULL=RORDER, ROWS=6, COLUMNS=1, VALUES=0,0.3,0,0.2,0.4,0");
  return matrices +
         "FLEX_BODY/2, MATRICES=1,2,3,4,5,6,7,8,9,10,11,12,13, QG=0,0,0.05, REULER=0.3,0.1,0.2, DMODE=0.2, WX=2\n"
         "MARKER/21, FLEX_BODY=2, NODE_ID=1\nMARKER/22, FLEX_BODY=2, NODE_ID=2\n"
         "MARKER/23, FLEX_BODY=2, NODE_ID=2, QP=.1,.02,-.3, REULER=1,2,3\nMARKER/24, FLEX_BODY=2, RM=22, NODE_ID=2\n"
         "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n" +
         rest;
}
std::string beam(const std::string& rest) {
  return "MATERIAL/1, DENSITY=2000, YOUNGS_MODULUS=2E7, POISSONS_RATIO=.3\n"
         "FE_PART/2, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2,3, X=0,.5,1, AREA=4E-4, IYY=1.3E-8, IZZ=1.3E-8, "
         "QG=0,0,.09, VZ=-.5\n"
         "MARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/22, FE_PART=2, NODE_LABEL=3, QP=1,0,0\n"
         "MARKER/23, FE_PART=2, NODE_LABEL=3, QP=1.01,.02,.03, REULER=1,2,3\n"
         "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n" +
         rest;
}
std::string ball(int id, int marker) {
  return "GRAPHICS/" + std::to_string(id) + ", ELLIPSOID, CM=" + std::to_string(marker) +
         ", XSCALE=.9, YSCALE=.9, ZSCALE=.9\n";
}
std::string contact(int id, const std::string& sides, const std::string& pressure = "") {
  return "CONTACT/" + std::to_string(id) + ", " + sides + ", JGEOM=1, " +
         (pressure.empty() ? "IMPACT, STIFFNESS=500, EXPONENT=1.5, DAMPING=5, DMAX=.01" : pressure) + "\n";
}

std::vector<double> accelerations(const std::string& text) {
  const auto system = system_of(text);
  Findings findings;
  const auto start = initial_conditions(*system, findings);
  if (!start) throw std::runtime_error(start.error().message);
  return start->acceleration;
}
void expect_same(const std::string& a, const std::string& b) {
  const std::vector<double> x = accelerations(a), y = accelerations(b);
  ASSERT_EQ(x.size(), y.size());
  double size = 0;
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-10 * (1 + std::abs(y[k]))) << k;
  for (const double v : y) size = std::max(size, std::abs(v));
  EXPECT_GT(size, 1);
}

TEST(ContactOfNodes, shapes_on_one_node_are_one_side) {
  for (const auto& body : {bell, beam}) {
    for (const int marker : {22, 23}) {
      const std::string balls = ball(2, 22) + ball(3, marker);
      expect_same(body(balls + contact(1, "IGEOM=2,3")), body(balls + contact(1, "IGEOM=2") + contact(2, "IGEOM=3")));
    }
  }
  // Placed in the frame of another, which is on the same node.
  const std::string balls = ball(2, 22) + ball(3, 24);
  expect_same(bell(balls + contact(1, "IGEOM=3,2")), bell(balls + contact(1, "IGEOM=2") + contact(2, "IGEOM=3")));
}

TEST(ContactOfNodes, shapes_on_several_nodes_are_refused) {
  const auto refused = [](const std::string& text) { (void)model_of(text); };
  EXPECT_THAT([&] { refused(bell(ball(2, 21) + ball(3, 22) + contact(1, "IGEOM=2,3"))); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("[contact-shape]"),
                        HasSubstr("GRAPHICS/3 is on another node of FLEX_BODY/2 than the first shape of this side of "
                                  "CONTACT/1"),
                        HasSubstr("a CONTACT for each node"))));
  EXPECT_THAT([&] { refused(beam(ball(2, 21) + ball(3, 22) + contact(1, "IGEOM=2,3"))); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("[contact-shape]"), HasSubstr("GRAPHICS/3 is on another node of FE_PART/2"))));
}

TEST(ContactOfNodes, one_shape_is_on_one_node) {
  struct Drawing {
    std::string name, of_two, of_one;
    bool is_curve = false;
  };
  for (const auto& [name, of_two, of_one, is_curve] :
       {Drawing{"LINK", "LINK, I=21, J=22, WIDTH=.1, DEPTH=.05", "LINK, I=23, J=22, WIDTH=.1, DEPTH=.05"},
        Drawing{"PLATE", "PLATE, MARKERS=22,21,25, THICKNESS=.05", "PLATE, MARKERS=22,23,25, THICKNESS=.05"},
        Drawing{"OUTLINE", "OUTLINE=22,21,25,22", "OUTLINE=22,26,25,22", true}}) {
    for (const bool flexible : {true, false}) {
      const auto with = [&, &is_curve = is_curve](const std::string& drawing) {
        const std::string on = flexible ? "FLEX_BODY=2, NODE_ID=2" : "FE_PART=2, NODE_LABEL=3";
        // From the node of the flexible body, of the BCS of the beam.
        const std::string x = flexible ? ".2" : "1.2";
        const std::string rest = "MARKER/25, QP=" + x + ",.3,0, " + on + "\nMARKER/26, QP=" + x + ",0,0, " + on +
                                 "\nGRAPHICS/2, " + drawing + "\nGRAPHICS/4, CIRCLE, CM=1, RADIUS=3\n" +
                                 (is_curve ? "CONTACT/1, IGEOM=2, JGEOM=4, IMPACT, STIFFNESS=500, EXPONENT=1.5, "
                                             "DAMPING=5, DMAX=.01\n"
                                           : contact(1, "IGEOM=2"));
        (void)model_of(flexible ? bell(rest) : beam(rest));
      };
      const auto between_nodes = [&, &of_two = of_two] { with(of_two); };
      EXPECT_THAT(between_nodes,
                  ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("[contact-shape]"), HasSubstr(name + " on several"),
                                                          HasSubstr("on one node where the body deforms"))));
      EXPECT_NO_THROW(with(of_one)) << name;
    }
  }
}

// The mass of a node is that of its body: the damping is that of a rigid body of this mass.
TEST(ContactOfNodes, masses_of_poisson_are_those_of_whole_bodies) {
  const std::string poisson = "POISSON, PENALTY=1E4, RESTITUTION_COEFFICIENT=.5";
  const auto force = [&](const std::string& text) {
    const auto system = system_of(text + contact(1, "IGEOM=2", poisson) + "VARIABLE/1, FUNCTION=CONTACT(1,0,4,1)\n");
    Findings findings;
    const auto start = initial_conditions(*system, findings);
    if (!start) throw std::runtime_error(start.error().message);
    for (std::size_t k = 0; k < system->layout().algebraic.size(); ++k)
      if (system->layout().algebraic[k].owner->statement == "VARIABLE") return start->algebraic[k];
    return 0.0;
  };
  const double rigid = force(
      "PART/2, MASS=.8, CM=22, IP=1,1,1, QG=1,0,.09, VZ=-.5\nMARKER/22\n"
      "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n" +
      ball(2, 22));
  EXPECT_GT(rigid, 1e4 * 0.36);
  EXPECT_NEAR(force(beam(ball(2, 22))), rigid, 1e-9 * rigid);
}

}  // namespace
}  // namespace dynalin::system_test::contact_nodes_test
