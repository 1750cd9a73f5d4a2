// Beams of finite elements at rest: closed forms and published deflections.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/fe_parts.h"
#include "cases/study_of.h"

namespace dynalin::cases::fe_part_static_test {
namespace {

constexpr double pi = std::numbers::pi;

Triple place_of(const library::OperatingPoint& p, std::int64_t marker) { return p.marker(marker).position; }

}  // namespace

TEST(FePartStatics, a_small_force_at_the_tip_bends_one_element_as_timoshenko_says) {
  for (const double h : {0.1, 0.01, 0.001}) {
    StraightBeam beam{.elements = 1, .height = h, .width = h};
    const double G = beam.modulus() / 2.6, P = 1e-6;
    const auto point = study_of(clamped_beam(beam, fmt::format("VFORCE/1, I=22, JFLOAT=2, RM=1, FY={:.17g}\n", P)))
                           .static_equilibrium();
    EXPECT_NEAR(place_of(point, 22)[1], P / 3 + 1.2 * P / (G * beam.area()), 1e-8 * P) << h;
  }
}

TEST(FePartStatics, one_element_is_stretched_and_twisted_as_a_rod) {
  StraightBeam beam{.elements = 1, .height = 0.05, .width = 0.02, .E = 2e6, .further = ", IXX=3E-8"};
  const double G = beam.modulus() / 2.6;
  const auto point =
      study_of(clamped_beam(beam, "GFORCE/1, I=22, JFLOAT=2, RM=1, FX=2\\FY=0\\FZ=0\\TX=0.001\\TY=0\\TZ=0\n"))
          .static_equilibrium();
  EXPECT_NEAR(place_of(point, 22)[0], 1 + 2 / (beam.modulus() * beam.area()), 1e-10);
  EXPECT_NEAR(point.marker(22).axes[1][2], std::sin(0.001 / (G * 3e-8)), 1e-9);
}

// A steel bar that hangs from a ball, let go in any attitude: it turns by up to half a turn, and is so stiff along
// itself that a step of each node by itself would hardly move it.
TEST(FePartStatics, a_stiff_bar_turns_to_where_it_hangs) {
  const double g = std::hypot(0.3, 9.81), length = 1 + 0.78 * g / 2 / 2.1e7;
  for (const char* attitude : {"0.3,0.6,-0.2", "0,0,0", "90D,30D,0", "0,30D,20D", "1,2,3"}) {
    const auto point =
        study_of(
            fmt::format("bar\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=.1,.2,.3\nMATERIAL/1, DENSITY=7800, "
                        "YOUNGS_MODULUS=2.1E11, POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, MATERIAL=1, "
                        "NODE_LABELS=1,2,3, X=0,0.5,1, AREA=1E-4, IYY=8.333E-10, IZZ=9E-10, QG=.1,.2,.3, REULER={}\n"
                        "MARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/23, FE_PART=2, NODE_LABEL=3, QP=1,0,0\n"
                        "ACCGRAV/IGRAV=0.3, KGRAV=-9.81\nJOINT/1, SPHERICAL, I=21, J=1\nEND\n",
                        attitude))
            .static_equilibrium();
    EXPECT_NEAR(place_of(point, 23)[0], 0.1 + length * 0.3 / g, 1e-9) << attitude;
    EXPECT_NEAR(place_of(point, 23)[1], 0.2, 1e-9) << attitude;
    EXPECT_NEAR(place_of(point, 23)[2], 0.3 - length * 9.81 / g, 1e-9) << attitude;
  }
}

// M = 2 π EI/L closes the circle; stretch and shear have no influence.
TEST(FePartStatics, an_end_moment_rolls_it_up_into_an_arc) {
  for (const double part : {0.5, 1.0}) {
    const auto dataset = [&](double load) {
      return clamped_beam({.elements = 4, .height = 0.05, .width = 0.05},
                          fmt::format("VTORQUE/1, I=22, JFLOAT=2, RM=1, TZ={:.17g}\n", 2 * pi * part * load));
    };
    const auto point = loaded(dataset, 8);
    const double k = 2 * pi * part;
    // Three points integrate half a circle of four elements to seven digits; over a whole one their errors cancel.
    EXPECT_NEAR(place_of(point, 22)[0], std::sin(k) / k, part == 1 ? 1e-10 : 2e-7);
    EXPECT_NEAR(place_of(point, 22)[1], (1 - std::cos(k)) / k, part == 1 ? 1e-10 : 2e-7);
    EXPECT_NEAR(point.marker(22).axes[0][0], std::cos(k), 1e-8);
  }
}

// Strips 200 and 500 times as long as thick, in one step of the whole moment: nothing downhill leads there.
TEST(FePartStatics, slender_strips_roll_up_at_once) {
  for (const StraightBeam& strip : {StraightBeam{.elements = 4, .height = 5e-3, .width = 5e-3, .type = "2DBEAMXY"},
                                    StraightBeam{.elements = 8, .height = 2e-3, .width = 2e-3}}) {
    const auto point =
        study_of(clamped_beam(strip, fmt::format("VTORQUE/1, I=22, JFLOAT=2, RM=1, TZ={:.17g}\n", 2 * pi)))
            .static_equilibrium();
    EXPECT_NEAR(place_of(point, 22)[0], 0, 1e-8) << strip.type;
    EXPECT_NEAR(place_of(point, 22)[1], 0, 1e-8) << strip.type;
    EXPECT_NEAR(point.marker(22).axes[0][0], 1, 1e-9) << strip.type;
  }
}

// Inextensible elastica, P L²/EI = a; published tables.
TEST(FePartStatics, a_dead_force_bends_it_into_the_elastica) {
  struct Case {
    double a, x, z;
  };
  for (const Case& c : {Case{2, 0.839358, 0.493457}, {10, 0.445004, 0.810609}}) {
    const auto dataset = [&](double load) {
      return clamped_beam({.elements = 8, .height = 2e-3, .width = 2e-3},
                          fmt::format("VFORCE/1, I=22, JFLOAT=2, RM=1, FZ={:.17g}\n", c.a * load));
    };
    const auto point = loaded(dataset, c.a < 3 ? 1 : 4);
    EXPECT_NEAR(place_of(point, 22)[0], c.x, 1.2e-5) << c.a;
    EXPECT_NEAR(place_of(point, 22)[2], c.z, 1.2e-5) << c.a;
  }
}

// Bathe and Bolourchi's bend of 45 degrees, R = 100, in eight elements. The numbers are those of the continuum, GJ =
// EI; eight straight elements of two nodes have 15.79, 47.23, 53.37 (Simo and Vu-Quoc 1986).
TEST(FePartStatics, the_45_degree_bend_follows_the_continuum) {
  struct Case {
    double P, x, y, z;
  };
  const auto dataset = [](double P) {
    std::vector<std::string> x, y, psi;
    std::vector<int> labels;
    for (int k = 0; k <= 8; ++k) {
      const double a = pi / 4 * k / 8;
      labels.push_back(k + 1);
      x.push_back(fmt::format("{:.17g}", 100 * std::sin(a)));
      y.push_back(fmt::format("{:.17g}", 100 * (1 - std::cos(a))));
      psi.push_back(fmt::format("{:.17g}", a));
    }
    // E = 1e7, G = 5e6: Poisson's ratio 0.
    return beam_model(fmt::format(
        "MATERIAL/2, DENSITY=1, YOUNGS_MODULUS=1E7, POISSONS_RATIO=0\nFE_PART/2, TYPE=3DBEAM, MATERIAL=2, "
        "NODE_LABELS={}\n"
        ", X={}\n, Y={}\n, PSI={}\n, AREA=1, IYY=0.083333333333333, IZZ=0.083333333333333, IXX=0.16666666666667, "
        "ASY=1, "
        "ASZ=1\nMARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/22, FE_PART=2, NODE_LABEL=9, QP={},{},0\n"
        "JOINT/1, FIXED, I=21, J=1\nVFORCE/1, I=22, JFLOAT=2, RM=1, FZ={:.17g}\n",
        fmt::join(labels, ","), fmt::join(x, "\n, "), fmt::join(y, "\n, "), fmt::join(psi, "\n, "), x.back(), y.back(),
        P));
  };
  for (const Case& c : {Case{300, 22.24478, 58.77912, 40.19189}, {600, 15.68480, 47.15044, 53.47486}}) {
    const auto point = loaded([&](double load) { return dataset(c.P * load); }, 4);
    const Triple at = place_of(point, 22);
    // Here the arc begins along x and bends towards y: the reference has x and y the other way round.
    EXPECT_NEAR(at[1], c.x, 5e-4) << c.P;
    EXPECT_NEAR(at[0], c.y, 5e-4) << c.P;
    EXPECT_NEAR(at[2], c.z, 5e-4) << c.P;
  }
}

// The beam of Dowell and Traybar (1975), a force at its tip turned by t from the stiff direction; exact Cosserat rod.
TEST(FePartStatics, the_princeton_beam_couples_bending_and_twist) {
  struct Case {
    double P, t, axial, stiff, soft;
  };
  for (const Case& c : {Case{8.896, 45, -14.3893, -8.8886, -109.0414},
                        {13.345, 30, -17.1632, -16.7775, -117.9016},
                        {13.345, 60, -41.2062, -11.7158, -181.9210},
                        {13.345, 0, -0.3048, -16.0651, 0}}) {
    const auto dataset = [&](double load) {
      const double t = c.t * pi / 180;
      // y is the stiff direction: EI about z is 36.279364, about y 2.428734, G J 3.103796.
      const StraightBeam beam{.elements = 8,
                              .length = 0.508,
                              .height = 0.012377,
                              .width = 0.0032024,
                              .E = 71.7e9,
                              .density = 2700,
                              .poisson = 0.31,
                              .further = fmt::format(", IXX={:.17g}", 3.103796 / (71.7e9 / 2.62))};
      return clamped_beam(beam, fmt::format("VFORCE/1, I=22, JFLOAT=2, RM=1, FY={:.17g}, FZ={:.17g}\n",
                                            -c.P * load * std::cos(t), -c.P * load * std::sin(t)));
    };
    const auto point = loaded(dataset, 3);
    const Triple at = place_of(point, 22);
    EXPECT_NEAR(1000 * (at[0] - 0.508), c.axial, 2e-4) << c.P << ' ' << c.t;
    EXPECT_NEAR(1000 * at[1], c.stiff, 2e-4);
    EXPECT_NEAR(1000 * at[2], c.soft, 2e-4);
  }
}

TEST(FePartStatics, its_weight_is_carried_by_the_clamp) {
  const StraightBeam beam{.elements = 3, .length = 2, .height = 0.1, .width = 0.05, .E = 1e9, .density = 1000};
  const auto point = study_of(clamped_beam(beam, "ACCGRAV/KGRAV=-9.81\n")).static_equilibrium();
  const double q = 1000 * beam.area() * 9.81, EI = 1e9 * beam.yy(), GA = 1e9 / 2.6 * beam.area() / 1.2;
  EXPECT_NEAR(point.load({"JOINT", 1}).force[2], 2 * q, 1e-6);
  EXPECT_NEAR(place_of(point, 22)[2], -(q * 16 / (8 * EI) + q * 4 / (2 * GA)), 2e-3 * q * 16 / (8 * EI));
}

// Loads so small that rounding of the positions might make as large forces of a beam that is all but rigid in shear or
// stretch: they bend it all the same, and the clamp carries all of them.
TEST(FePartStatics, what_rounding_of_stiff_terms_could_explain_is_carried_by_the_clamp) {
  struct Case {
    double E, area, inertia, q;
    std::string further;
  };
  for (const Case& c : {Case{2e9, 1e-3, 1e-6, 0.01, ", ASY=1E-5, ASZ=1E-5"},
                        Case{2e9, 1e-3, 1e-6, 0.1, ", ASY=1E-5, ASZ=1E-5"}, Case{2.1e11, 1, 0.0833, 0.001, ""}}) {
    const auto point = study_of(beam_model(fmt::format(
                                    "MATERIAL/2, DENSITY=1000, YOUNGS_MODULUS={0:.17g}, POISSONS_RATIO=0.3\n"
                                    "FE_PART/2, TYPE=3DBEAM, MATERIAL=2, NODE_LABELS=1,2,3,4,5, X=0,0.5,1,1.5,2\n"
                                    ", AREA={1:.17g}, IYY={2:.17g}, IZZ={2:.17g}{3}\n"
                                    "MARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/22, FE_PART=2, NODE_LABEL=5, QP=2,0,0\n"
                                    "JOINT/1, FIXED, I=21, J=1\nFE_LOAD/1, FE_PART=2, FY={4:.17g}\n",
                                    c.E, c.area, c.inertia, c.further, -c.q)))
                           .static_equilibrium();
    EXPECT_NEAR(point.load({"JOINT", 1}).force[1], 2 * c.q, 2e-8) << c.q;
    EXPECT_NEAR(point.load({"JOINT", 1}).torque[2], 2 * c.q, 2e-8) << c.q;
    const double bending = c.q * 16 / (8 * c.E * c.inertia);
    if (!c.further.empty()) {
      EXPECT_NEAR(place_of(point, 22)[1], -bending, 5e-3 * bending) << c.q;
    }
  }
}

// A beam that has to be pulled to its part first, by forces of 1e8 N, and is straight again in the end: pairs of equal
// frequencies. Its soft bending and its stiff shear have to be found together.
TEST(FePartStatics, a_beam_that_assembly_has_bent_is_straight_at_rest) {
  const std::string dataset = beam_model(
      "MATERIAL/2, DENSITY=2000, YOUNGS_MODULUS=2E9, POISSONS_RATIO=0.3\n"
      "FE_PART/2, TYPE=3DBEAM, MATERIAL=2, NODE_LABELS=1,2,3, X=0,1,2, AREA=0.001, IYY=1E-8, IZZ=1E-8, ASY=0.001, "
      "ASZ=0.001\nMARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/22, FE_PART=2, NODE_LABEL=3, QP=2,0,0\n"
      "JOINT/1, FIXED, I=21, J=1\n"
      "PART/3, MASS=0.2, CM=40, IP=1E-3,1E-3,1E-3, QG=1,1,0\nMARKER/40, PART=3\nJOINT/2, FIXED, I=40, J=22\n");
  const auto point = study_of(dataset).static_equilibrium();
  for (const std::int64_t joint : {1, 2}) {
    for (const double f : point.load({"JOINT", joint}).force) EXPECT_NEAR(f, 0, 1e-6) << joint;
  }
  const Triple tip = place_of(point, 22);
  EXPECT_NEAR(tip[0], 2, 1e-9);
  EXPECT_NEAR(tip[1], 0, 1e-7);
}

}  // namespace dynalin::cases::fe_part_static_test
