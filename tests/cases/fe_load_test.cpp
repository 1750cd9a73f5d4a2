// Loads along beams of finite elements against closed forms, against weight, and against the same load in other words.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/fe_parts.h"
#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::fe_load_test {
namespace {

library::OperatingPoint equilibrium(const std::string& dataset) { return study_of(dataset).static_equilibrium(); }

// At an equilibrium, the smallest first.
std::vector<std::complex<double>> spectrum(const std::string& dataset, const LinearRequest& request = {}) {
  const auto study = study_of(dataset);
  std::vector<std::complex<double>> all;
  for (const EigenMode& m :
       study.linearize(study.static_equilibrium(), request).modes(library::ModeShapes::left_out).modes)
    all.push_back(m.eigenvalue_hz);
  std::ranges::sort(all, {}, [](const auto& z) { return std::abs(z); });
  return all;
}
// Each of the first `count` has its like in the other.
void expect_same(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b, double share,
                 std::size_t count = 1000) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t k = 0; k < std::min(count, a.size()); ++k) {
    double nearest = 1e300;
    for (const auto& z : b) nearest = std::min(nearest, std::abs(z - a[k]));
    EXPECT_LT(nearest, share * std::abs(a[k])) << k;
  }
}
void expect_same(const library::OperatingPoint& a, const library::OperatingPoint& b, double error) {
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(a.marker(22).position[k], b.marker(22).position[k], error) << k;
    EXPECT_NEAR(a.marker(22).axes[0][k], b.marker(22).axes[0][k], error) << k;
    EXPECT_NEAR(a.load({"JOINT", 1}).force[k], b.load({"JOINT", 1}).force[k], 10 * error) << k;
    EXPECT_NEAR(a.load({"JOINT", 1}).torque[k], b.load({"JOINT", 1}).torque[k], 10 * error) << k;
  }
}

std::string load(const std::string& components) { return "FE_LOAD/1, FE_PART=2, " + components + "\n"; }

double norm_of_tip(const library::OperatingPoint& p) {
  return std::hypot(p.marker(22).position[1], p.marker(22).position[2]);  // away from where it was drawn
}

// The signed squares of frequencies: the least is negative where the straight beam is unstable.
double least_square(const std::string& dataset) {
  double least = 1e300;
  for (const auto& z : spectrum(dataset)) least = std::min(least, -(z * z).real());
  return least;
}

constexpr double g = 9.81;
const StraightBeam soft{.elements = 3, .height = 0.05, .width = 0.04, .further = ", QG=0.1,0.2,0.3, REULER=30D,20D,0D"};
std::string soft_beam(const std::string& further) {
  return beam_model(soft.text() + "MARKER/3, PART=1, QP=0.1,0.2,0.3, REULER=30D,20D,0D\nJOINT/1, FIXED, I=21, J=3\n" +
                    further);
}

}  // namespace

TEST(FeLoad, of_the_weight_by_length_is_the_weight_however_far_the_beam_bends) {
  const std::string weight = soft_beam(fmt::format("ACCGRAV/KGRAV=-{}\n", g)),
                    along = soft_beam(load(fmt::format("FZ=-{}", g)));
  const auto point = equilibrium(along);
  EXPECT_LT(point.marker(22).position[2], 0.3 - 0.3);
  expect_same(point, equilibrium(weight), 1e-9);
  expect_same(spectrum(along), spectrum(weight), 1e-9);
}

TEST(FeLoad, uniform_bends_a_cantilever_as_timoshenko_says) {
  const double q = 1e-5;
  const StraightBeam beam{.elements = 4, .length = 2, .height = 0.1, .width = 0.1};
  const auto point = equilibrium(clamped_beam(beam, load(fmt::format("FY={:.17g}", q))));
  const double GA = beam.modulus() / 2.6 * beam.area() / 1.2;
  const double bent = q * 16 / 8 + q * 4 / (2 * GA);
  EXPECT_NEAR(point.marker(22).position[1], bent, 1e-8 * bent);
  EXPECT_NEAR(point.load({"JOINT", 1}).force[1], -2 * q, 1e-12);
  EXPECT_NEAR(point.load({"JOINT", 1}).torque[2], -2 * q, 1e-10 * q + q * bent);
}

// q S bends the tip by 11/120 q L⁴/EI, q (1 − S) by 1/30; places of nodes are not in proportion to their numbers.
TEST(FeLoad, varies_with_the_place_along_the_beam) {
  const double q = 1e-5;
  const auto tip = [&](const std::string& component) {
    std::string text = clamped_beam({.elements = 4, .height = 1e-3, .width = 1e-3}, load(component));
    const std::string even = "X=0\n, 0.25\n, 0.5\n, 0.75\n, 1";
    text.replace(text.find(even), even.size(), "X=0, 0.1, 0.3, 0.6, 1");
    return equilibrium(text).marker(22).position[1] / q;
  };
  EXPECT_NEAR(tip("FY=1E-5*S"), 11.0 / 120, 1e-6);
  EXPECT_NEAR(tip("FY=1E-5*(1-S)"), 1.0 / 30, 1e-6);
  EXPECT_NEAR(tip("FY=1E-5*(IF(S-2:S,0,0)+STEP(S,-2,0,-1,1)*(1-S))"), 0.125, 1e-6);
}

TEST(FeLoad, of_a_moment_twists_and_bends_as_a_rod) {
  const StraightBeam beam{.elements = 3, .height = 0.05, .width = 0.02, .E = 2e6, .further = ", IXX=3E-8"};
  const double GJ = beam.modulus() / 2.6 * 3e-8, EI = beam.modulus() * beam.zz();
  EXPECT_NEAR(equilibrium(clamped_beam(beam, load("TX=0.001"))).marker(22).axes[1][2], std::sin(0.0005 / GJ), 1e-8);
  // In a plane moments add up along the beam, whatever its shape.
  const auto bent = equilibrium(clamped_beam(beam, load("TZ=0.6")));
  EXPECT_GT(0.3 / EI, 0.7);
  EXPECT_NEAR(bent.marker(22).axes[0][1], std::sin(0.3 / EI), 1e-6);
  EXPECT_NEAR(bent.load({"JOINT", 1}).torque[2], -0.6, 1e-9);
}

TEST(FeLoad, takes_its_axes_from_a_marker) {
  const std::string turned = "MARKER/9, PART=1, REULER=20D,50D,-35D\n";
  const auto there = equilibrium(soft_beam(turned + load("RM=9, FX=0.4, FY=3, FZ=-2, TX=0.1, TY=-0.2, TZ=0.3")));
  std::string in_global;
  for (const char* kind : {"F", "T"}) {
    const std::array<double, 3> c = kind[0] == 'F' ? std::array{0.4, 3.0, -2.0} : std::array{0.1, -0.2, 0.3};
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < 3; ++j) sum += c[j] * there.marker(9).axes[j][k];
      in_global += fmt::format("{}{}{}={:.17g}", in_global.empty() ? "" : ", ", kind, "XYZ"[k], sum);
    }
  }
  expect_same(there, equilibrium(soft_beam(load(in_global))), 1e-9);
}

// The axis of the marker written out as expressions takes another way to the same partials.
TEST(FeLoad, turns_with_a_node_of_the_beam) {
  const auto along = [](char kind) {
    return fmt::format(
        "{0}X=2*UVY(22)*[1,0,0]-0.5*UVX(22)*[1,0,0]\\{0}Y=2*UVY(22)*[0,1,0]-0.5*UVX(22)*[0,1,0]\\{0}Z=2*"
        "UVY(22)*[0,0,1]-0.5*UVX(22)*[0,0,1]",
        kind);
  };
  for (const char kind : {'F', 'T'}) {
    const std::string follower = soft_beam(load(fmt::format("RM=22, {0}Y=2, {0}X=-0.5", kind))),
                      written = soft_beam(load(along(kind)));
    const auto point = equilibrium(follower);
    EXPECT_LT(point.marker(22).axes[1][1], 0.8);
    expect_same(point, equilibrium(written), 1e-9);
    expect_same(spectrum(follower), spectrum(written), 1e-8);
  }
}

// As loads on the nodes, each what is nearest to it: a force that turns with the tip, a moment that does not.
TEST(FeLoad, is_what_many_loads_on_nodes_add_up_to) {
  constexpr int n = 8;
  const StraightBeam beam{.elements = n, .height = 0.05, .width = 0.04};
  struct Case {
    const char* axes;
    std::array<double, 6> load;
  };
  for (const Case& c : {Case{"22", {0, 3, 0, 0, 0, 0}}, Case{"1", {0, 0, 0, 0.8, 0.6, -0.9}}}) {
    const auto components = [&](double factor) {
      return fmt::format("RM={}, FX={:.17g}\\FY={:.17g}\\FZ={:.17g}\\TX={:.17g}\\TY={:.17g}\\TZ={:.17g}", c.axes,
                         factor * c.load[0], factor * c.load[1], factor * c.load[2], factor * c.load[3],
                         factor * c.load[4], factor * c.load[5]);
    };
    std::string loads;
    for (int k = 1; k <= n; ++k) {
      loads += fmt::format(
          "MARKER/{0}, FE_PART=2, NODE_LABEL={1}, QP={4:.17g},0,0\nMARKER/{2}, FLOATING, PART=1\nGFORCE/{1}, I={0}, "
          "JFLOAT={2}, {3}\n",
          100 + k, k + 1, 200 + k, components((k == n ? 0.5 : 1.0) / n), static_cast<double>(k) / n);
    }
    const std::string along = clamped_beam(beam, load(components(1))), lumped = clamped_beam(beam, loads);
    const auto a = equilibrium(along), b = equilibrium(lumped);
    EXPECT_GT(norm_of_tip(a), 0.25);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a.marker(22).position[k], b.marker(22).position[k], 3e-3);
    expect_same(spectrum(along), spectrum(lumped), 3e-3, 8);
  }
}

// A column of EI = L = 1 buckles under 7.83734744 by length (Greenhill 1881).
TEST(FeLoad, buckles_a_column_as_heavy_as_greenhill_found) {
  const auto column = [](double q) {
    return clamped_beam({.elements = 4, .height = 1e-3, .width = 2e-3}, load(fmt::format("FX=-{:.17g}", q)));
  };
  EXPECT_GT(least_square(column(0.999 * 7.83734744)), 0);
  EXPECT_LT(least_square(column(1.001 * 7.83734744)), 0);
}

// EI and the mass by length are 1; a free beam moves as a whole.
TEST(FeLoad, that_depends_on_places_and_rates_moves_eigenvalues) {
  const auto free_beam = [](const std::string& component) {
    return beam_model(StraightBeam{.elements = 2, .height = 0.1, .width = 0.1}.text() + load(component));
  };
  const auto has = [](const std::vector<std::complex<double>>& all, std::complex<double> wanted) {
    return std::ranges::any_of(all, [&](const auto& z) { return std::abs(z * 2.0 * M_PI - wanted) < 1e-8; });
  };
  const auto values = [](const std::string& dataset, const LinearRequest& request) {
    std::vector<std::complex<double>> all;
    for (const EigenMode& m : study_of(dataset).linearize(request).modes(library::ModeShapes::left_out).modes)
      all.push_back(m.eigenvalue_hz);
    return all;
  };
  EXPECT_TRUE(has(values(free_beam("FX=-9*DX(21)"), {}), {0, 3}));
  EXPECT_TRUE(has(values(free_beam("FX=-0.25*VX(21)"), {}), {-0.25, 0}));
  LinearRequest undamped;
  undamped.without_damping = true;
  EXPECT_FALSE(has(values(free_beam("FX=-0.25*VX(21)"), undamped), {-0.25, 0}));
  EXPECT_TRUE(has(values(free_beam("FX=-9*VARVAL(1)\nVARIABLE/1, FUNCTION=DX(21)"), {}), {0, 3}));
}

TEST(FeLoad, that_depends_on_time_moves_a_free_beam) {
  const auto point =
      study_of(beam_model(StraightBeam{.elements = 1, .height = 0.1, .width = 0.1}.text() + load("FY=6*TIME, FZ=2")))
          .simulate({.end = 0.5, .error = 1e-7})
          .point;
  EXPECT_NEAR(point.marker(22).position[1], 0.125, 1e-5);
  EXPECT_NEAR(point.marker(22).position[2], 0.25, 1e-5);
  EXPECT_NEAR(point.marker(21).position[1], 0.125, 1e-5);
}

class FeLoadCommands : public Cases {};

TEST_F(FeLoadCommands, is_taken_out_and_a_delay_along_the_beam_is_refused) {
  const StraightBeam beam{.elements = 1, .height = 0.1, .width = 0.1};
  const RunResult r = run(clamped_beam(beam, load("FY=-9*DY(22), FZ=-9*DZ(22)")),
                          "LINEAR/EIGENSOL\nDEACTIVATE/FE_LOAD, ID=1\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.eigenvalues(0)[0], r.eigenvalues(2)[0]);
  const RunResult delayed = run(clamped_beam(beam, load("FX=DELAY(S*TIME,0.1,0)")), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(delayed.status, 1);
  EXPECT_NE(delayed.err.find("[misplaced-function]"), std::string::npos) << delayed.err;
}

}  // namespace dynalin::cases::fe_load_test
