// Functions where they have no derivative: refused by the name of the element and the function wherever the linear
// model needs it, and nowhere else; and angles that together are smooth where each of them is not.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cases/dataset_text.h"
#include "cases/study_of.h"

namespace dynalin::cases::undefined_derivative_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A free body at the global origin, its marker 20 on marker 1 of ground, and one beside it.
std::string free_body(const std::string& more, const std::string& of_part = "") {
  return "Free body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/91, FLOATING\nPART/2, MASS=1, CM=20, IP=1,2,3" +
         of_part + "\nMARKER/20\nMARKER/21, QP=0.5,0,0\n" + more + "END\n";
}
std::string output(const std::string& function) {
  return "VARIABLE/7, FUNCTION=" + function + "\nPOUTPUT/1, VARIABLES=7\n";
}
const std::string state_matrices = "LINEAR/STATEMAT, POUTPUT=1, FILE=model.mat\n";

class UndefinedDerivatives : public Cases {
 protected:
  void expect_refused(const std::string& dataset, const std::string& commands, const std::string& reason) const {
    const RunResult r = run(dataset, commands);
    EXPECT_EQ(r.status, 2) << dataset;
    EXPECT_THAT(r.err, HasSubstr(reason)) << dataset;
    EXPECT_FALSE(r.wrote("model.mat"));
  }
  // The row of C of VARIABLE/7 by turns (and displacements) of the body, without rates.
  std::map<std::string, double> gradient(const std::string& dataset) const {
    const RunResult r = run(dataset, state_matrices);
    EXPECT_EQ(r.status, 0) << r.err << dataset;
    if (r.status != 0) return {};
    std::map<std::string, double> g;
    const auto labels = r.labels(0);
    const auto C = r.matrix(0, "C");
    for (std::size_t k = 0; k < labels.size(); ++k) {
      if (C[0][k] != 0.0) g[labels[k]] = C[0][k];
    }
    return g;
  }
};

TEST_F(UndefinedDerivatives, of_outputs_name_the_variable_and_the_function) {
  const std::pair<const char*, const char*> rows[] = {
      {"SQRT(DX(20,1))", "VARIABLE/7: the derivative of SQRT is infinite at 0"},
      {"DX(20,1)**0.5", "VARIABLE/7: the derivative of ** is infinite at (0, 0.5)"},
      {"ASIN(1+DX(20,1))", "VARIABLE/7: the derivative of ASIN is infinite at 1"},
      {"ACOS(1-DX(20,1)**2)", "VARIABLE/7: the derivative of ACOS is infinite at 1"},
      {"ATAN2(DX(20,1),DY(20,1))", "VARIABLE/7: the derivative of ATAN2 is not defined at (0, 0)"},
      {"LOG(DX(20,1))", "VARIABLE/7: LOG of 0"},
      {"LOG10(DX(20,1))", "VARIABLE/7: LOG10 of 0"},
      {"MOD(1,DX(20,1))", "VARIABLE/7: MOD with the divisor 0"},
      {"1/DX(20,1)", "VARIABLE/7: division by 0"},
      {"VR(20,1)", "VARIABLE/7: VR(20,1) has no derivative where the markers coincide"},
      {"PSI(20,1)", "VARIABLE/7: PSI(20,1) has no derivative where THETA is 0 or π"},
      {"PHI(20,1)", "VARIABLE/7: PHI(20,1) has no derivative where THETA is 0 or π"},
      {"PSI(20,1)-PHI(20,1)", "VARIABLE/7: PSI(20,1)-PHI(20,1) has no derivative where THETA is 0"},
      {"THETA(20,1)", "VARIABLE/7: THETA(20,1) has no derivative where it is 0 or π"},
      {"SIN(THETA(20,1))", "VARIABLE/7: THETA(20,1) has no derivative where it is 0 or π"},
      {"DX(20,1)+VX(20,1)*DY(20,1)+THETA(20,1)", "VARIABLE/7: THETA(20,1) has no derivative where it is 0 or π"},
      {"INCANG(21,1,22)", "VARIABLE/7: INCANG(21,1,22) has no derivative where it is 0 or π"},
      {"UV(DXYZ(20,1))*[1,2,3]", "VARIABLE/7: UV(DXYZ(20,1)) has no value where its vector is zero"},
      {"2+[1,2,3]*UV(2*DXYZ(20,1))", "VARIABLE/7: UV(2*DXYZ(20,1)) has no value where its vector is zero"},
  };
  for (const auto& [function, reason] : rows) {
    expect_refused(free_body("MARKER/22, QP=0.7,0,0\n" + output(function)), state_matrices, reason);
  }
  // A turn of a right angle about y: PITCH is −π/2.
  for (const auto& [function, reason] :
       {std::pair("PITCH(20,1)", "VARIABLE/7: PITCH(20,1) has no derivative where it is π/2 or −π/2"),
        std::pair("YAW(20,1)", "VARIABLE/7: YAW(20,1) has no derivative where PITCH is π/2 or −π/2"),
        std::pair("AZ(20,1)", "VARIABLE/7: AZ(20,1) has no finite value")}) {
    expect_refused(free_body(output(function), ", REULER=90D,90D,-90D"), state_matrices, reason);
  }
}

// 0 · ∞ may be anything: √x √x is x.
TEST_F(UndefinedDerivatives, behind_a_factor_that_vanishes_count_unless_it_vanishes_fast_enough) {
  for (const char* f : {"SQRT(DX(20,1))**2", "SQRT(DX(20,1))*SQRT(DX(20,1))", "COS(SQRT(DX(20,1)))",
                        "ABS(DX(20,1)**0.75)", "ASIN(1-DX(20,1))-SQRT(2*DX(20,1))*SQRT(DY(20,1))"}) {
    expect_refused(free_body(output(f)), state_matrices, "VARIABLE/7: the derivative of ");
  }
  for (const char* f : {"DX(20,1)*PSI(20,1)", "PSI(20,1)**2", "SIN(PSI(20,1))*DM(20,1)"}) {
    expect_refused(free_body(output(f)), state_matrices, "VARIABLE/7: PSI(20,1) has no derivative");
  }
  for (const char* f :
       {"DY(20,1)*SQRT(DX(20,1))", "SQRT(DX(20,1))**3", "SQRT(DX(20,1))*DM(20,1)", "DM(20,1)**2", "VM(20,1)*VX(20,1)",
        "MAG(2*DXYZ(20,1))**2", "SQRT(DX(20,1))*MAG(2*DXYZ(20,1))", "0*PSI(20,1)", "0*SQRT(DX(20,1))",
        "COS(2*THETA(20,1))", "DX(20,1)*ABS(DX(20,1))**0.5", "IF(DX(20,1): SQRT(DX(20,1)), 0, SQRT(DX(20,1)))"}) {
    EXPECT_TRUE(gradient(free_body(output(f))).empty()) << f;
  }
}

// They grow whichever way things move: the mean of all directions is none.
TEST_F(UndefinedDerivatives, of_sizes_that_are_zero_count_as_none) {
  for (const char* f : {"DM(20,1)", "VM(20,1)", "WM(20,1)", "3*DM(20,1)+VM(20,1)", "-4*SIN(WM(20,1))",
                        "MAG(DXYZ(20,1))", "MAG(VXYZ(20,1,20,21))", "3*MAG(2*DXYZ(20,1))+MAG(DXYZ(20,1)-VXYZ(20,1))",
                        "SIN(MAG([DX(20,1),2*DY(20,1),0]))"}) {
    EXPECT_TRUE(gradient(free_body(output(f))).empty()) << f;
  }
}

TEST_F(UndefinedDerivatives, of_forces_states_and_constraints_are_refused_in_every_analysis) {
  const std::pair<const char*, const char*> rows[] = {
      {"SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=-3*SQRT(DX(20,1))\n",
       "SFORCE/3: the derivative of SQRT is infinite at 0"},
      {"VARIABLE/7, FUNCTION=SQRT(DX(20,1))\nSFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=-3*VARVAL(7)\n",
       "VARIABLE/7: the derivative of SQRT is infinite at 0"},
      {"GFORCE/3, I=20, JFLOAT=91, RM=1, FX=0\\FY=THETA(20,1)\\FZ=0\\TX=0\\TY=0\\TZ=0\n",
       "GFORCE/3: THETA(20,1) has no derivative where it is 0 or π"},
      {"DIFF/3, FUNCTION=-DIF(3)+SQRT(DX(20,1))\n", "DIFF/3: the derivative of SQRT is infinite at 0"},
      {"DIFF/3, FUNCTION=-SQRT(DIF(3))\n", "DIFF/3: the derivative of SQRT is infinite at 0"},
      {"DIFF/3, IMPLICIT, FUNCTION=SQRT(DIF1(3))-DX(20,1)\n", "DIFF/3: the derivative of SQRT is infinite at 0"},
      {"GCON/3, FUNCTION=THETA(20,1)\n", "GCON/3: THETA(20,1) has no derivative where it is 0 or π"},
      {"GCON/3, FUNCTION=DM(20,1)\n", "GCON/3: DM(20,1) has no derivative where it is 0"},
      {"GCON/3, FUNCTION=MAG(DXYZ(20,1))\n", "GCON/3: MAG(DXYZ(20,1)) has no derivative where it is 0"},
      {"GCON/3, FUNCTION=MAG(2*DXYZ(20,1))\n", "GCON/3: MAG(2*DXYZ(20,1)) has no derivative where it is 0"},
      {"SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=[1,0,0]*UV(VXYZ(20))\n",
       "SFORCE/3: UV(VXYZ(20)) has no value where its vector is zero"},
      {"MOTION/3, I=20, J=1, X, FUNCTION=SQRT(TIME)\n", "MOTION/3: the derivative of SQRT is infinite at 0"},
      // Of an unread variable with the same fault the reader's own is named.
      {"VARIABLE/5, FUNCTION=SQRT(DX(20,1))\nSFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=PSI(20,1)\n",
       "SFORCE/3: PSI(20,1) has no derivative where THETA is 0 or π"},
  };
  for (const auto& [statements, reason] : rows) {
    for (const char* command :
         {"LINEAR/EIGENSOL\n", "LINEAR/STATEMAT, FILE=model.mat\n", "LINEAR/MKB, FILE=model.mat\n"})
      expect_refused(free_body(statements), command, reason);
  }
  const std::string drag =
      free_body("SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=-SQRT(VX(20,1))-4*DX(20,21)-2\n");
  expect_refused(drag, "LINEAR/EIGENSOL\n", "SFORCE/3: the derivative of SQRT is infinite at 0");
}

TEST_F(UndefinedDerivatives, that_nothing_reads_are_no_errors) {
  const std::string root = "VARIABLE/7, FUNCTION=SQRT(DX(20,1))\n";
  for (const std::string& statements :
       {root, root + "VARIABLE/8, FUNCTION=VARVAL(7)\n",
        std::string("VARIABLE/8, FUNCTION=DX(20,1)\nVARIABLE/7, FUNCTION=SQRT(VARVAL(8))\n"),
        root + "SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=0*VARVAL(7)\n"}) {
    for (const char* command :
         {"LINEAR/EIGENSOL\n", "LINEAR/STATEMAT, FILE=model.mat\n", "LINEAR/MKB, FILE=model.mat\n"})
      EXPECT_EQ(run(free_body(statements), command).status, 0) << statements << command;
  }
  // Nor are those by what cannot vary: a body that is held, and the tilt of one on a plane.
  EXPECT_TRUE(
      gradient(free_body("JOINT/3, FIXED, I=20, J=1\nDIFF/4, FUNCTION=-DIF(4)\n" + output("SQRT(DX(20,1))"))).empty());
  const std::map<std::string, double> turning = {{"Global rotation AZ(BCS) PART/2", 1.0}};
  EXPECT_EQ(gradient(free_body("JOINT/3, PLANAR, I=20, J=1\n" + output("PSI(20,1)"))), turning);
  EXPECT_TRUE(gradient(free_body("JOINT/3, PLANAR, I=20, J=1\n" + output("PHI(20,1)"))).empty());
  // Markers on one body, and a torque that is always zero.
  for (const char* f : {"WM(21,20)", "DM(23,20)", "PSI(24,20)", "THETA(24,20)", "TM(20,1)"}) {
    EXPECT_TRUE(
        gradient(free_body("MARKER/23, PART=2\nMARKER/24, PART=2, REULER=0.4,0,0\nJOINT/3, SPHERICAL, I=20, J=1\n" +
                               output(f),
                           ", WX=0.3, WY=-0.4, WZ=0.9"))
            .empty())
        << f;
  }
  // An input is cut free of its own function.
  EXPECT_EQ(run(free_body(root + "SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=21, FUNCTION=VARVAL(7)\nPINPUT/1, "
                                 "VARIABLES=7\n"),
                "LINEAR/STATEMAT, PINPUT=1, FILE=model.mat\n")
                .status,
            0);
}

// Markers at 0.3 − 0.2 and 0.1: coincident but for rounding.
TEST_F(UndefinedDerivatives, of_sizes_are_none_where_rounding_hides_that_they_are_zero) {
  const std::string near = "MARKER/22, PART=1, QP=0.1,0,0\nMARKER/23, PART=2, QP=-0.2,0,0\n";
  for (const char* f : {"DM(23,22)", "MAG(DXYZ(23,22))", "MAG(DXYZ(23,22,23))"})
    EXPECT_TRUE(gradient(free_body(near + output(f), ", QG=0.3,0,0")).empty()) << f;
}

class SmoothAngles : public UndefinedDerivatives {};

// At a general point against the same angles where nothing recognises them.
TEST_F(SmoothAngles, are_the_angles_they_are_made_of) {
  const std::string a = "(31,21)";
  const std::pair<std::string, std::string> rows[] = {
      {"COS(THETA@)", "COS(VARVAL(92))"},
      {"SIN(PITCH@)", "SIN(VARVAL(95))"},
      {"COS(INCANG(31,21,3))", "COS(VARVAL(97))"},
      {"2*SIN(THETA@)*SIN(PSI@)+SIN(PSI@)*SIN(THETA@)", "3*SIN(VARVAL(92))*SIN(VARVAL(91))"},
      {"2*SIN(THETA@)*COS(PSI@)+COS(PSI@)*SIN(THETA@)", "3*SIN(VARVAL(92))*COS(VARVAL(91))"},
      {"SIN(THETA@)*SIN(PHI@)+2*SIN(THETA@)*COS(PHI@)", "SIN(VARVAL(92))*(SIN(VARVAL(93))+2*COS(VARVAL(93)))"},
      {"COS(PITCH@)*SIN(YAW@)+2*COS(PITCH@)*COS(YAW@)", "COS(VARVAL(95))*(SIN(VARVAL(94))+2*COS(VARVAL(94)))"},
      {"COS(PITCH@)*SIN(ROLL@)+2*COS(PITCH@)*COS(ROLL@)", "COS(VARVAL(95))*(SIN(VARVAL(96))+2*COS(VARVAL(96)))"},
      {"3*(PSI@+PHI@)-(PHI@+PSI@)", "2*(VARVAL(91)+VARVAL(93))"},
      {"3*(PSI@-PHI@)+(PHI@-PSI@)", "2*(VARVAL(91)-VARVAL(93))"},
      {"DX@+PSI@-PHI@+(DY@-PSI@+PHI@)*2", "DX@+2*DY@-VARVAL(91)+VARVAL(93)"},
      {"DX@-PHI@-PSI@+2*(DY@+PHI@-PSI@)", "DX@+2*DY@+VARVAL(93)-3*VARVAL(91)"},
      {"YAW@+ROLL@+2*(YAW@-ROLL@)", "3*VARVAL(94)-VARVAL(96)"},
      {"DX@-ROLL@+YAW@", "DX@+VARVAL(94)-VARVAL(96)"},
      {"THETA@**2+DX@*THETA@*THETA@+THETA@**4", "VARVAL(92)**2*(1+DX@)+VARVAL(92)**4"},
      {"INCANG(31,21,3)**2", "VARVAL(97)*VARVAL(97)"},
      {"IF(DX@: COS(THETA@), THETA@, PSI@+PHI@)", "IF(DX@: COS(VARVAL(92)), VARVAL(92), VARVAL(91)+VARVAL(93))"},
  };
  const auto filled = [&](std::string text) {
    for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, a);
    return text;
  };
  std::string more, list;
  int k = 0;
  for (const char* angle : {"PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"})
    more += fmt::format("VARIABLE/{}, FUNCTION={}{}\n", 91 + k++, angle, a);
  more += "VARIABLE/97, FUNCTION=INCANG(31,21,3)\n";
  int id = 100;
  for (const auto& [together, apart] : rows) {
    more += fmt::format("VARIABLE/{}, FUNCTION={}\nVARIABLE/{}, FUNCTION={}\n", id, filled(together), id + 1,
                        filled(apart));
    list += fmt::format("{}{},{}", list.empty() ? "" : ",\n,", id, id + 1);
    id += 2;
  }
  for (const char* markers : {"31,21", "21,31", "31,3"}) {
    std::string text = two_bodies(more + "POUTPUT/1, VARIABLES=" + list + "\n");
    for (std::size_t at; (at = text.find(a)) != std::string::npos;)
      text.replace(at, a.size(), fmt::format("( {} )", markers));
    const auto study = study_of(text);
    const auto m = study.initial_conditions();
    LinearRequest request;
    request.poutput = 1;
    const StateSpace s = study.linearize(m, request).state_space();
    for (Eigen::Index r = 0; r < s.C.rows(); r += 2) {
      const double value = m.variable(100 + r), expected = m.variable(101 + r);
      EXPECT_NEAR(value, expected, 1e-13 * std::max(1.0, std::abs(expected))) << rows[r / 2].first << markers;
      const double size = std::max(1.0, s.C.row(r + 1).cwiseAbs().maxCoeff());
      EXPECT_GT(s.C.row(r + 1).cwiseAbs().maxCoeff(), 0) << rows[r / 2].first << markers;
      EXPECT_LT((s.C.row(r) - s.C.row(r + 1)).cwiseAbs().maxCoeff(), 1e-11 * size) << rows[r / 2].first << markers;
    }
  }
}

// Turned about z by 0.3: of the rotation matrix (1,3) is the turn about the y axis, −(2,3) that about the x axis.
TEST_F(SmoothAngles, have_derivatives_where_the_angles_have_none) {
  const std::string x = "Global rotation AX(BCS) PART/2", y = "Global rotation AY(BCS) PART/2",
                    z = "Global rotation AZ(BCS) PART/2";
  const auto expect = [&](const std::string& function, const std::map<std::string, double>& expected,
                          const std::string& turn = "0.3,0,0") {
    const auto g = gradient(free_body("MARKER/22, QP=0.7,0,0\n" + output(function), ", REULER=" + turn));
    for (const std::string& axis : {x, y, z}) {
      const double e = expected.contains(axis) ? expected.at(axis) : 0.0;
      EXPECT_NEAR(g.contains(axis) ? g.at(axis) : 0.0, e, 1e-14) << function << axis;
    }
  };
  expect("PSI(20,1)+PHI(20,1)", {{z, 1}});
  expect("2+PHI(20,1)+PSI(20,1)", {{z, 1}});
  expect("COS(THETA(20,1))", {});
  expect("THETA(20,1)**2", {});
  expect("3*SIN(THETA(20,1))*SIN(PSI(20,1))", {{y, 3}});
  expect("3*SIN(THETA(20,1))*COS(PSI(20,1))", {{x, 3}});
  expect("COS(INCANG(21,1,22))", {});
  // Half a turn about x, and a quarter about y with PITCH = −π/2.
  expect("PSI(20,1)-PHI(20,1)", {{z, 1}}, "0.3,180D,0");
  expect("COS(THETA(20,1))", {}, "0.3,180D,0");
  expect("YAW(20,1)-ROLL(20,1)", {{z, 1}}, "90D,90D,-90D");
  expect("SIN(PITCH(20,1))", {}, "90D,90D,-90D");

  const auto study = study_of(free_body(output("PSI(20,1)+PHI(20,1)"), ", REULER=0.3,0,0"));
  EXPECT_NEAR(study.initial_conditions().variable(7), 0.3, 1e-15);
}

// Beside the places where one of the two has no gradient: ω = ψ′ z + θ′ (cos ψ, sin ψ, 0) + φ′ z_i, so that φ responds
// to turns about x and y by (sin ψ, −cos ψ)/sin θ and ψ by −cos θ of that; and ω = ψ′ z + θ′ y′ + φ′ x″ of yaw and
// roll.
TEST_F(SmoothAngles, keep_their_digits_beside_points_without_a_gradient) {
  constexpr double psi = 0.3;
  const auto compare = [&](const std::string& function, const std::string& turn,
                           const std::array<double, 3>& expected) {
    const auto g = gradient(free_body(output(function), ", REULER=" + turn));
    const double size = std::max(1.0, std::abs(expected[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string axis = fmt::format("Global rotation A{}(BCS) PART/2", "XYZ"[k]);
      EXPECT_NEAR(g.contains(axis) ? g.at(axis) : 0.0, expected[k], 1e-14 * size) << function << turn << axis;
    }
  };
  for (const double tilt : {0.1, 1e-2, 1e-4, 1e-6, 2e-7, 1e-9, 1e-12}) {
    for (const bool upside_down : {false, true}) {
      const double theta = upside_down ? std::numbers::pi - tilt : tilt;
      const std::string turn = fmt::format("{:.17g},{:.17g},0.5", psi, theta);
      // (1 − cos θ)/sin θ and (1 + cos θ)/sin θ.
      const double plus = std::tan(theta / 2), minus = 1 / std::tan(theta / 2);
      compare("PSI(20,1)+PHI(20,1)", turn, {plus * std::sin(psi), -plus * std::cos(psi), 1});
      compare("PSI(20,1)-PHI(20,1)", turn, {-minus * std::sin(psi), minus * std::cos(psi), 1});
    }
    for (const double side : {-1.0, 1.0}) {
      const double theta = side * (std::numbers::pi / 2 - tilt), cosine = std::cos(theta);
      const std::string turn = fmt::format("{:.17g},{:.17g},-90D", psi + std::numbers::pi / 2, theta);
      // 1 ± sin θ, whose product is cos² θ.
      const double large = 1 + std::abs(std::sin(theta)), small = cosine * cosine / large;
      const double plus = (side > 0 ? large : small) / cosine, minus = (side > 0 ? -small : -large) / cosine;
      compare("YAW(20,1)+ROLL(20,1)", turn, {plus * std::cos(psi), plus * std::sin(psi), 1});
      compare("YAW(20,1)-ROLL(20,1)", turn, {minus * std::cos(psi), minus * std::sin(psi), 1});
    }
  }
}

// At j, far away along u, between i at the origin and k, beside it along −v: the angle grows by v·δr/L.
TEST_F(SmoothAngles, of_markers_close_to_each_other_and_far_from_the_third_keep_their_digits) {
  constexpr std::array<double, 3> u{0.36, 0.48, 0.8}, v{0.8, -0.6, 0};
  for (const double length : {10.0, 1e3, 1e6}) {
    for (const double apart : {1e-1, 1e-3, 1e-6}) {
      const std::string markers =
          fmt::format("MARKER/22, PART=1, QP={:.17g},{:.17g},0\nMARKER/23, PART=1, QP={:.17g},{:.17g},{:.17g}\n",
                      -apart * v[0], -apart * v[1], length * u[0], length * u[1], length * u[2]);
      const double angle = std::atan(apart / length);
      for (const auto& [function, slope] :
           {std::pair("INCANG(20,23,22)", 1 / length), std::pair("INCANG(20,23,22)**2", 2 * angle / length)}) {
        const auto g = gradient(free_body(markers + output(function)));
        for (std::size_t k = 0; k < 3; ++k) {
          const std::string axis = fmt::format("Global displacement D{}(BCS) PART/2", "XYZ"[k]);
          EXPECT_NEAR(g.contains(axis) ? g.at(axis) : 0.0, slope * v[k], 1e-14 * slope) << function << markers << axis;
        }
      }
    }
  }
}

// cos θ falls as −θ²/2 and θ² grows: rates of both depend on the tilt where the model tilts.
TEST_F(SmoothAngles, have_rates_too) {
  const std::string x = "Global rotation AX(BCS) PART/2";
  for (const auto& [function, expected] :
       {std::pair("COS(THETA(20,1))", -0.7), std::pair("THETA(20,1)**2", 1.4), std::pair("THETA(20,1)**4", 0.0)}) {
    const auto g = gradient(
        free_body(fmt::format("DIFF/3, IMPLICIT, FUNCTION=DIF(3)-{}\n", function) + output("DIF1(3)"), ", WX=0.7"));
    EXPECT_NEAR(g.contains(x) ? g.at(x) : 0.0, expected, 1e-14) << function;
  }
}

}  // namespace
}  // namespace dynalin::cases::undefined_derivative_test
