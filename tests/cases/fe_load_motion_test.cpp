// Loads that read the motion of the beam where they act, SD, SV and SA, against closed forms and against inertia: of
// its line and of its sections.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/fe_parts.h"
#include "cases/study_of.h"

namespace dynalin::cases::fe_load_motion_test {
namespace {

using Values = std::vector<std::complex<double>>;

Values eigenvalues(const library::Study& study, const library::OperatingPoint& at, const LinearRequest& request = {}) {
  Values all;
  for (const EigenMode& m : study.linearize(at, request).modes(library::ModeShapes::left_out).modes)
    all.push_back(m.eigenvalue_hz * 2.0 * M_PI);
  std::ranges::sort(all, {}, [](const auto& z) { return std::abs(z); });
  return all;
}
// As drawn, and at an equilibrium.
Values drawn(const std::string& dataset, const LinearRequest& request = {}) {
  const auto study = study_of(dataset);
  return eigenvalues(study, study.initial_conditions(), request);
}
Values at_rest(const std::string& dataset) {
  const auto study = study_of(dataset);
  return eigenvalues(study, study.static_equilibrium());
}
bool has(const Values& all, std::complex<double> wanted) {
  return std::ranges::any_of(all, [&](const auto& z) { return std::abs(z - wanted) < 1e-8 * (1 + std::abs(wanted)); });
}

std::string load(const std::string& components) { return "FE_LOAD/1, FE_PART=2, " + components + "\n"; }

// EI and the mass by length are 1; a beam that nothing holds moves as a whole.
std::string free_beam(const std::string& components, const std::string& further = "") {
  return beam_model(StraightBeam{.elements = 2, .height = 0.1, .width = 0.1, .further = further}.text() +
                    load(components));
}
std::string plane_beam(double density, const std::string& components) {
  return clamped_beam({.elements = 5, .height = 0.02, .width = 0.03, .E = 1e7, .density = density, .type = "2DBEAMXY"},
                      components.empty() ? "" : load(components));
}

TEST(FeLoadMotion, is_a_bed_a_damper_and_a_mass) {
  EXPECT_TRUE(has(drawn(free_beam("FZ=-9*SD(3)")), {0, 3}));
  EXPECT_TRUE(has(drawn(free_beam("FY=-9*SD(2)-2*SV(2)")), {-1, std::sqrt(8.0)}));
  EXPECT_TRUE(has(drawn(free_beam("FX=-9*SD(1)-1.25*SA(1)")), {0, 2}));
  LinearRequest undamped;
  undamped.without_damping = true;
  EXPECT_TRUE(has(drawn(free_beam("FY=-9*SD(2)-2*SV(2)"), undamped), {0, 3}));
}

// A spring of k by length turns a beam about its middle with k L³/12: beside the place of each point nothing counts.
TEST(FeLoadMotion, is_that_of_each_point) {
  const Values all = drawn(plane_beam(100, "")), bedded = drawn(plane_beam(100, "FX=-700*SD(1), FY=-700*SD(2)")),
               heavy = drawn(plane_beam(250, "")), laden = drawn(plane_beam(100, "FX=-0.09*SA(1), FY=-0.09*SA(2)"));
  ASSERT_EQ(all.size(), bedded.size());
  ASSERT_EQ(all.size(), laden.size());
  EXPECT_GT(all.size(), 8u);
  for (std::size_t k = 0; k < all.size(); ++k) {
    // The mass by length is 100 · 6e-4, and 0.09 more is that of 250; a bed adds k/ρA to all squares.
    EXPECT_NEAR(std::norm(bedded[k]), std::norm(all[k]) + 700 / 0.06, 1e-8 * std::norm(all[k]) + 1e-6) << k;
    EXPECT_NEAR(std::abs(laden[k]), std::abs(heavy[k]), 1e-8 * std::abs(heavy[k])) << k;
  }
}

// z = -1/2 under the load 1 and 8 z³, whose slope there is 6.
TEST(FeLoadMotion, is_followed_where_a_law_is_bent) {
  const std::string slides = "JOINT/1, TRANSLATIONAL, I=21, J=1\n";
  std::string text = free_beam("FZ=-8*SD(3)**3-1");
  text.insert(text.find("FE_LOAD"), slides);
  const auto study = study_of(text);
  const auto point = study.static_equilibrium();
  EXPECT_NEAR(point.marker(21).position[2], -0.5, 1e-9);
  EXPECT_NEAR(point.marker(22).position[2], -0.5, 1e-9);
  EXPECT_TRUE(has(eigenvalues(study, point), {0, std::sqrt(6.0)}));
}

// v' = -v |v|: 4 v at the speed 2, and 1/(1/2 + t) as time goes on.
TEST(FeLoadMotion, drags_what_moves) {
  const auto study = study_of(free_beam("FX=-SV(1)*ABS(SV(1))", ", VX=2"));
  EXPECT_TRUE(has(eigenvalues(study, study.initial_conditions()), {-4, 0}));
  const auto later = study.simulate({.end = 1.5, .error = 1e-8}).point;
  EXPECT_NEAR(later.marker(21).velocity[0], 0.5, 1e-5);
  EXPECT_NEAR(later.marker(22).position[0], 1 + std::log(4.0), 1e-5);
}

// Alike in all directions: the same wherever the beam lies.
TEST(FeLoadMotion, is_measured_along_global_axes) {
  const auto bent = [](const std::string& place, const std::array<double, 3>& from) {
    std::string text, axes = ", QG=" + place;
    for (std::size_t k = 0; k < 3; ++k)
      text += fmt::format("{}F{}=-30*(SD({})-{})*(1+S)-0.3*SA({})", k ? ", " : "", "XYZ"[k], k + 1, from[k], k + 1);
    return beam_model(StraightBeam{.elements = 3, .height = 0.05, .width = 0.04, .further = axes}.text() +
                      "MARKER/3, PART=1, QP=" + place + "\nJOINT/1, FIXED, I=21, J=3\n" + load(text));
  };
  // Of a point beside the beam, two thirds along it.
  const Values straight = at_rest(bent("0,0,0", {0.6, 0.3, 0}));
  const Values turned = at_rest(bent("1,2,3, REULER=90D,90D,0D", {1, 2.6, 3.3}));
  ASSERT_EQ(straight.size(), turned.size());
  for (std::size_t k = 0; k < straight.size(); ++k)
    EXPECT_NEAR(std::abs(straight[k]), std::abs(turned[k]), 1e-8 * std::abs(straight[k])) << k;
}

// Along the global z axis, with z of its sections along x: PSI turns it about itself. Its inertia there by length is
// that of the density 100 and of 0.1^4/6.
TEST(FeLoadMotion, is_a_bed_a_damper_and_an_inertia_of_turning) {
  const auto turning = [](const std::string& components) {
    return drawn(free_beam(components, ", REULER=90D,90D,90D"));
  };
  const double J = 100 * 1e-4 / 6;
  EXPECT_TRUE(has(turning("TZ=-9*(SD(4)-PI/2)"), {0, std::sqrt(9 / J)}));
  EXPECT_TRUE(has(turning(fmt::format("TZ=-9*(SD(4)-PI/2)-{:.17g}*SV(6)", 2 * J)), {-1, std::sqrt(9 / J - 1)}));
  EXPECT_TRUE(has(turning(fmt::format("TZ=-9*(SD(4)-PI/2)-{:.17g}*SA(6)", 3 * J)), {0, std::sqrt(9 / (4 * J))}));
}

// Its sections stand as the global axes do, which leaves the angles no axis to turn about.
TEST(FeLoadMotion, says_where_an_angle_has_no_derivative) {
  const auto study = study_of(free_beam("TX=-9*SD(5)"));
  try {
    study.linearize(study.initial_conditions(), {});
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("FE_LOAD/1: SD(5) has no derivative where it is 0 or π"));
  }
}

// Damping of the turning of sections takes their rates alone: at any place of the beam the same.
TEST(FeLoadMotion, of_sections_is_measured_along_global_axes) {
  const auto damped = [](const std::string& place, const std::string& axes, const std::array<int, 3>& along) {
    std::string text;
    for (std::size_t k = 0; k < 3; ++k)
      text += fmt::format("{}T{}=-{}*(1+S)*SV({})-{}*SA({})", k ? ", " : "", "XYZ"[k], 0.01 * along[k], k + 4,
                          1e-6 * along[k], k + 4);
    return beam_model(
        StraightBeam{.elements = 3, .height = 0.05, .width = 0.04, .further = ", QG=" + place + axes}.text() +
        "MARKER/3, PART=1, QP=" + place + axes + "\nJOINT/1, FIXED, I=21, J=3\n" + load(text));
  };
  // Its axes x, y, z are then the global y, z, x.
  const Values straight = drawn(damped("0,0,0", "", {1, 2, 3})),
               turned = drawn(damped("1,2,3", ", REULER=90D,90D,0D", {3, 1, 2}));
  ASSERT_EQ(straight.size(), turned.size());
  for (std::size_t k = 0; k < straight.size(); ++k)
    EXPECT_NEAR(std::abs(straight[k]), std::abs(turned[k]), 1e-8 * std::abs(straight[k])) << k;
  double most = 0;
  for (const auto& z : straight) most = std::max(most, -z.real() / std::abs(z));
  EXPECT_GT(most, 1e-3);
}

}  // namespace
}  // namespace dynalin::cases::fe_load_motion_test
