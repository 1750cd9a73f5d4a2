// Beams of finite elements between places that are nearer than they are long: they sag, however few nodes or many.
#include <dynalin/study.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/study_of.h"

namespace dynalin::cases::slack_beam_test {
namespace {

struct SlackBeam {
  std::string type = "3DBEAM";
  int elements = 2;
  double span = 0.9;
  double gravity = -9.81;

  std::string text() const {
    std::string labels, places;
    for (int k = 0; k <= elements; ++k) {
      labels += fmt::format("{}{}", k > 0 ? "," : "", k + 1);
      places += fmt::format("{}{:.17g}", k > 0 ? "\n, " : "", static_cast<double>(k) / elements);
    }
    return fmt::format(
        "Slack strip between two pins\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={}\nPART/1, GROUND\nMARKER/1\n"
        "MARKER/3, QP={:.17g},0,0\nMATERIAL/1, DENSITY=1000, YOUNGS_MODULUS=1E9, POISSONS_RATIO=0.3\n"
        "FE_PART/2, TYPE={}, MATERIAL=1, NODE_LABELS={}\n, X={}, AREA=1E-4, IYY=2E-10, IZZ=2E-10\n"
        "MARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/22, FE_PART=2, NODE_LABEL={}, QP=1,0,0\n"
        "JOINT/1, SPHERICAL, I=21, J=1\nJOINT/2, SPHERICAL, I=22, J=3\nEND\n",
        gravity, span, type, labels, places, elements + 1);
  }
  StaticResult rest() const { return study_of(text()).static_equilibrium().static_result(); }
  double sag() const { return rest().at_rest.bodies.at(static_cast<std::size_t>(elements) / 2).position[1]; }
};

}  // namespace

// Pressed straight it would be at rest as well, with several motions that gravity pushes it to.
TEST(SlackBeam, sags_between_its_pins_with_few_nodes_and_with_many) {
  for (const int elements : {2, 4, 8}) {
    EXPECT_NEAR((SlackBeam{.elements = elements}.sag()), -0.195, 0.002) << elements;
  }
  const double deep = SlackBeam{.elements = 4, .span = 0.75}.sag();
  EXPECT_NEAR((SlackBeam{.elements = 8, .span = 0.75}.sag()), deep, 0.01);
  EXPECT_LT(deep, -0.25);
}

// Nothing pushes it to either side: what is drawn straight stays so.
TEST(SlackBeam, without_gravity_is_pressed_straight) {
  const StaticResult r = SlackBeam{.gravity = 0}.rest();
  EXPECT_EQ(r.at_rest.bodies.at(1).position[1], 0);
  EXPECT_EQ(r.stability.verdict, Stability::Verdict::unstable);
}

// The end has to move by most of an element: alone it would fold that over.
TEST(SlackBeam, is_assembled_by_moving_all_of_its_nodes) {
  for (const int elements : {4, 8, 16})
    EXPECT_NEAR((SlackBeam{.type = "2DBEAMXY", .elements = elements}.sag()), -0.195, 0.001) << elements;
}

}  // namespace dynalin::cases::slack_beam_test
