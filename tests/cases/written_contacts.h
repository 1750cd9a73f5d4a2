// The forces of contacts written with other statements: expressions, CURVEs and implicit DIFFs. What CONTACT does with
// the same bodies must be the same, in linear models and over time.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace dynalin::cases::written_contacts {

inline const std::string impact = "IMPACT, STIFFNESS=2E4, EXPONENT=1.5, DAMPING=40, DMAX=0.001";
inline const std::string friction =
    ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.1, STICTION_TRANSITION_VELOCITY=0.1, "
    "FRICTION_TRANSITION_VELOCITY=1\n";

// --- solids in space ----------------------------------------------------------------------------
// MARKER/2 is at the centre of what touches, MARKER/1 that of ground.

// A ball of radius 0.1 on the plane z = 0. It rubs half-way between both surfaces, (z + 0.1)/2 below its centre.
inline std::string ball_on_plane() {
  const std::string N = "IMPACT(DZ(2,1),VZ(2,1),0.1,2E4,1.5,40,0.001)", arm = "((DZ(2,1)+0.1)/2)";
  const std::string sx = "(VX(2,1)-WY(2,1)*" + arm + ")", sy = "(VY(2,1)+WX(2,1)*" + arm + ")";
  // The coefficient by the speed: the slope of the step below 0.1, then the fall to the dynamic one.
  const std::string square = "(" + sx + "**2+" + sy + "**2)", v = "SQRT(" + square + ")";
  const std::string steep = "(0.15*(3-" + square + "/0.01)/0.1)", falls = "STEP(" + v + ",0.1,0.3,1,0.1)/" + v;
  return "VARIABLE/81, FUNCTION=" + N + "\nVARIABLE/82, FUNCTION=-VARVAL(81)*IF(" + square + "-0.01: " + steep + "," +
         steep + "," + falls + ")\nVARIABLE/83, FUNCTION=VARVAL(82)*" + sx + "\nVARIABLE/84, FUNCTION=VARVAL(82)*" +
         sy +
         "\nMARKER/83, PART=1, FLOATING\nGFORCE/81, I=2, JFLOAT=83, RM=1, "
         "FX=VARVAL(83)\\FY=VARVAL(84)\\FZ=VARVAL(81)\\TX=" +
         arm + "*VARVAL(84)\\TY=-" + arm + "*VARVAL(83)\\TZ=0\n";
}

// A ball of radius 0.1 in a cone about z of MARKER/9, in which the radius is bottom + slope z: the distance from the
// mantle is (bottom + slope z - r) times the cosine of its inclination.
inline std::string ball_in_cone(double bottom, double slope) {
  const double cosine = 1 / std::sqrt(1 + slope * slope);
  const std::string radius = "SQRT(DX(2,9,9)**2+DY(2,9,9)**2)";
  const std::string gap = fmt::format("(({}+{:.17g}*DZ(2,9,9)-{})*{:.17g})", bottom, slope, radius, cosine);
  const std::string rate =
      fmt::format("(({:.17g}*VZ(2,9,9)-(DX(2,9,9)*VX(2,9,9)+DY(2,9,9)*VY(2,9,9))/{})*{:.17g})", slope, radius, cosine);
  return fmt::format(
      "VARIABLE/81, FUNCTION=IMPACT({0},{1},0.1,2E4,1.5,40,0.001)\nMARKER/83, PART=1, FLOATING\n"
      "GFORCE/81, I=2, JFLOAT=83, RM=9, FX=-VARVAL(81)*{3:.17g}*DX(2,9,9)/{2}\\\n, "
      "FY=-VARVAL(81)*{3:.17g}*DY(2,9,9)/{2}\\\n, FZ=VARVAL(81)*{4:.17g}\\\n, TX=0\\TY=0\\TZ=0\n",
      gap, rate, radius, cosine, slope * cosine);
}

// A cylinder of radius 0.1 along y that rocks in the plane of y and z on its rims, at the ends MARKER/11 and 12 of its
// axis: tilted by t about x, the lowest point of each is cos t of the radius below the end and sin t beside it.
inline std::string cylinder_on_plane() {
  std::string text;
  for (const int end : {11, 12}) {
    const int force = 70 + end;
    const std::string down = fmt::format("(DZ({},1)-0.1*COS(AX(2,1)))", end),
                      rate = fmt::format("(VZ({},1)+0.1*SIN(AX(2,1))*WX(2,1))", end),
                      beside = fmt::format("(DY({},1)+0.1*SIN(AX(2,1))-DY(2,1))", end);
    text += fmt::format(
        "VARIABLE/{0}, FUNCTION=IMPACT({1},{2},0,2E4,1.5,40,0.001)\nMARKER/{0}, PART=1, FLOATING\n"
        "GFORCE/{0}, I=2, JFLOAT={0}, RM=1, FX=0\\FY=0\\FZ=VARVAL({0})\\TX=VARVAL({0})*{3}\\TY=0\\TZ=0\n",
        force, down, rate, beside);
  }
  return text;
}

// --- curves in a plane --------------------------------------------------------------------------
// Matter below: from the right to the left. A cubic, 0.2 x² − 0.1 x³.
inline const std::string rail =
    "MATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=1,0.1,0, 0.5,0.0375,0, 0,0,0, -0.5,0.0625,0, -1,0.3,0\n"
    "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\nGRAPHICS/1, CURVE, CID=1, CRM=1\n";
inline std::string body(double x, double y) {
  return fmt::format(
      "PART/2, MASS=2, CM=2, IP=0.1,0.1,0.15, QG={},{},0\nMARKER/2\nMARKER/3, PART=1, FLOATING\n"
      "JOINT/1, PLANAR, I=2, J=1\n",
      x, y);
}

// The forces of one place where a curve a(u) of the body touches CURVE/1, from formulas of the language alone. a, its
// derivative: components in the axes of the body; u and v begin near their values. `n` numbers what it needs.
inline std::string place(int n, const std::array<std::string, 4>& curve, double u, double v, bool rubs,
                         bool point = false) {
  const int at = 10 * n;
  const auto var = [&](int k) { return fmt::format("VARVAL({})", at + k); };
  const std::string U = fmt::format("DIF({})", at + 1), V = fmt::format("DIF({})", at + 2);
  const std::string c = "COS(AZ(2,1))", s = "SIN(AZ(2,1))";
  const auto with_u = [&](const std::string& f) { return fmt::format(fmt::runtime(f), fmt::arg("u", U)); };
  const auto turned = [&](const std::string& x, const std::string& y) {
    return std::array{fmt::format("({})*{}-({})*{}", with_u(x), c, with_u(y), s),
                      fmt::format("({})*{}+({})*{}", with_u(x), s, with_u(y), c)};
  };
  const auto a = turned(curve[0], curve[1]), t = turned(curve[2], curve[3]);
  const auto b = [&](int d, int k) { return fmt::format("CURVE({},{},{},1)", V, d, k); };
  std::string text;
  const auto define = [&](int k, const std::string& e) {
    text += fmt::format("VARIABLE/{}, FUNCTION={}\n", at + k, e);
  };
  define(1, "DX(2,1)+" + a[0]), define(2, "DY(2,1)+" + a[1]);
  // The direction out of the matter below, and the gap along it.
  const std::string size = fmt::format("SQRT({0}**2+{1}**2)", b(1, 1), b(1, 2));
  define(3, fmt::format("{}/{}", b(1, 2), size)), define(4, fmt::format("-{}/{}", b(1, 1), size));
  define(5, fmt::format("({}-{})*{}+({}-{})*{}", var(1), b(0, 1), var(3), var(2), b(0, 2), var(4)));
  // The arm of the point half-way between.
  define(6, fmt::format("({}+{})/2-DX(2,1)", var(1), b(0, 1)));
  define(7, fmt::format("({}+{})/2-DY(2,1)", var(2), b(0, 2)));
  define(8, fmt::format("VX(2,1)-WZ(2,1)*{}", var(7))), define(9, fmt::format("VY(2,1)+WZ(2,1)*{}", var(6)));
  define(100, fmt::format("IMPACT({0},{1}*{2}+{3}*{4},0,2E4,1.5,40,0.001)", var(5), var(8), var(3), var(9), var(4)));
  // Along (n_y, −n_x).
  define(200, fmt::format("{}*{}-{}*{}", var(8), var(4), var(9), var(3)));
  const std::string slope = fmt::format("(0.15*(3-{0}**2/0.01)/0.1)", var(200));
  define(300, rubs ? fmt::format("-{}*{}*{}", slope, var(100), var(200)) : "0");
  if (!point) {
    text +=
        fmt::format("DIFF/{}, IMPLICIT, IC={}, FUNCTION=({})*{}-({})*{}\n", at + 1, u, t[0], b(1, 2), t[1], b(1, 1));
  }
  text += fmt::format("DIFF/{}, IMPLICIT, IC={}, FUNCTION=({}-{})*{}+({}-{})*{}\n", at + 2, v, var(1), b(0, 1), b(1, 1),
                      var(2), b(0, 2), b(1, 2));
  const std::string fx = fmt::format("({0}*{1}+{2}*{3})", var(100), var(3), var(300), var(4));
  const std::string fy = fmt::format("({0}*{1}-{2}*{3})", var(100), var(4), var(300), var(3));
  return text + fmt::format(
                    "MARKER/{0}, PART=1, FLOATING\nGFORCE/{0}, I=2, JFLOAT={0}, RM=1, FX={1}\\\n, FY={2}\\\n, FZ=0\\\n"
                    ", TX=0\\\n, TY=0\\\n, TZ={3}*{2}-{4}*{1}\n",
                    at + 9, fx, fy, var(6), var(7));
}
inline const std::array<std::string, 4> circle = {"0.5*COS({u})", "0.5*SIN({u})", "-0.5*SIN({u})", "0.5*COS({u})"};
inline const std::array<std::string, 4> tread = {"CURVE({u},0,1,2)", "CURVE({u},0,2,2)", "CURVE({u},1,1,2)",
                                                 "CURVE({u},1,2,2)"};

}  // namespace dynalin::cases::written_contacts
