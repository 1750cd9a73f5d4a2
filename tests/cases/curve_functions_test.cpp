// PTCV and CVCV against the same constraints written as GCONs with explicit polynomials, and a straight curve against a
// primitive.
#include "cases/curves.h"

namespace dynalin::cases::curve_functions_test {
namespace {

// The parameters that the GCONs need: x and y of a particle without mass, times `scale`. A large one makes its motion
// so small that it has no weight in the least change of velocities.
struct Parameters {
  double scale;
  std::string u = fmt::format("({}*DX(901))", scale), v = fmt::format("({}*DY(901))", scale),
              w = fmt::format("{}*DZ(901)", scale);
  std::string at(double u0, double v0) const {
    return fmt::format("POINT_MASS/90, MASS=0, CM=901, QG={:.17g},{:.17g},0\nMARKER/901, POINT_MASS=90\n", u0 / scale,
                       v0 / scale);
  }
};
const std::array<std::string, 3> P = {"DX(31,22,22)", "DY(31,22,22)", "DZ(31,22,22)"};
// Component c of the k-th axis of 31 in those of 22.
std::string axis(int k, std::size_t c) { return fmt::format("D{}({},31,22)", "XYZ"[c], 311 + k); }

const Matrix3 anyhow = rotation_313(0.5, 0.8, -0.3);
const Polynomials line{{{{0.1, 0.5, 0, 0}, {-0.05, 0.25, 0, 0}, {0.2, -0.3, 0, 0}}}};
const Polynomials cam{{{{0.02, 0.3, 0.05, 0}, {0.05, 0.1, -0.35, 0.06}, {0, 0, 0, 0}}}};
const Polynomials track{{{{-0.1, 0.5, 0, 0.04}, {0.1, -0.1, 0.2, -0.05}, {0, 0, 0, 0}}}};

std::string closed_curve(int id, int n, const std::string& more = "") {
  std::string s = fmt::format("MATRIX/{}, FULL=RORDER, ROWS={}, COLUMNS=3, VALUES=", id, n + 1);
  for (int i = 0; i <= n; ++i) {
    const double t = 2 * std::numbers::pi * (i % n) / n;
    s += (i > 0 ? "\n, " : "") + xyz({0.3 * std::cos(t), 0.2 * std::sin(t), 0.1 * std::sin(2 * t)});
  }
  return s + fmt::format("\nCURVE/{}, CLOSED, MATRIX={}{}\n", id, id, more);
}

std::vector<Held> all(double scale) {
  const Parameters particle{scale};
  const std::string &U = particle.u, &V = particle.v, &W = particle.w;
  const std::string point = "MARKER/29, PART=2, FLOATING\nPTCV/1, I=31, JFLOAT=29, CURVE=1, RM=22";
  std::vector<Held> list;
  {
    Held h{"ptcv", bow.curve(1, 7) + point, bow.at(0.3), anyhow, {V, W}, particle.at(0.3, 0)};
    for (std::size_t k = 0; k < 3; ++k) h.functions.push_back(P[k] + "-" + bow.text(k, U));
    list.push_back(h);
    // At a knot, and in the first and last piece.
    for (const auto& [name, u] : {std::pair{"ptcv_at_a_knot", 0.0}, {"ptcv_first", -0.6}, {"ptcv_last", 0.6}}) {
      h.name = name, h.p = bow.at(u), h.helpers = particle.at(u, 0);
      list.push_back(h);
    }
  }
  {
    // Four points are one cubic; a point mass would do as well.
    Held h{"ptcv_four_points", bow.curve(1, 4) + point, bow.at(-0.4), anyhow, {V, W}, particle.at(-0.4, 0)};
    for (std::size_t k = 0; k < 3; ++k) h.functions.push_back(P[k] + "-" + bow.text(k, U));
    list.push_back(h);
  }
  {
    // The contact on ground's side and the curve on the other: I and RM change places.
    Held h{"ptcv_swapped",
           bow.curve(1, 7) + "MARKER/29, PART=3, FLOATING\nPTCV/1, I=22, JFLOAT=29, CURVE=1, RM=31",
           -(anyhow * bow.at(0.3)),
           anyhow,
           {V, W},
           particle.at(0.3, 0)};
    for (std::size_t k = 0; k < 3; ++k) h.functions.push_back(fmt::format("D{}(22,31,31)-", "XYZ"[k]) + bow.text(k, U));
    list.push_back(h);
  }
  {
    // A closed curve read by the function CURVE: exact in both, so what is compared is the constraint.
    Held h{"ptcv_closed", closed_curve(1, 9) + point, {}, anyhow, {V, W}, ""};
    // Its first point, u = −1.
    h.p = {0.3, 0, 0};
    h.helpers = closed_curve(1, 9) + particle.at(-1, 0);
    for (std::size_t k = 0; k < 3; ++k) h.functions.push_back(P[k] + fmt::format("-CURVE({},0,{},1)", U, k + 1));
    list.push_back(h);
  }
  {
    // The straight one has a joint of its own.
    Held h{"ptcv_straight", line.curve(1, 5) + point, line.at(0.2), anyhow, {V, W}, particle.at(0.2, 0)};
    for (std::size_t k = 0; k < 3; ++k) h.functions.push_back(P[k] + "-" + line.text(k, U));
    list.push_back(h);
  }
  for (const bool apart : {false, true}) {
    // Turned about z until the tangents agree, then about the common tangent.
    const double u = 0.25, v = -0.35;
    const Vector s = cam.slope(u), t = track.slope(v);
    const Matrix3 R =
        about(t, 0.5) * about({0, 0, 1}, std::atan2(t.y, t.x) - std::atan2(s.y, s.x) + (apart ? std::numbers::pi : 0));
    Held h{apart ? "cvcv_opposed" : "cvcv",
           cam.curve(1, 7) + track.curve(2, 6) +
               "MARKER/29, PART=2, FLOATING\nMARKER/39, PART=3, FLOATING\n"
               "CVCV/1, IFLOAT=39, ICURVE=1, IRM=31, JFLOAT=29, JCURVE=2, JRM=22",
           track.at(v) - R * cam.at(u),
           R,
           {W},
           particle.at(u, v)};
    std::array<std::string, 2> slope;
    for (std::size_t c = 0; c < 3; ++c) {
      h.functions.push_back(P[c] + "+" + axis(0, c) + "*" + cam.text(0, U) + "+" + axis(1, c) + "*" + cam.text(1, U) +
                            "-" + track.text(c, V));
      if (c < 2)
        slope[c] = "(" + axis(0, c) + "*" + cam.slope_text(0, U) + "+" + axis(1, c) + "*" + cam.slope_text(1, U) + ")";
    }
    h.functions.push_back(slope[0] + "*" + track.slope_text(1, V) + "-" + slope[1] + "*" + track.slope_text(0, V));
    list.push_back(h);
  }
  return list;
}

class CurveAsFunctions : public Cases, public ::testing::WithParamInterface<std::size_t> {
 protected:
  void compare(const Held& h, const char* commands) const {
    const RunResult element = run(mechanism(h, false), commands), functions = run(mechanism(h, true), commands);
    ASSERT_EQ(element.status, 0) << element.err;
    ASSERT_EQ(functions.status, 0) << functions.err;
    EXPECT_EQ(element.labels(1), functions.labels(1));
    expect_same(element.eigenvalues(1), functions.eigenvalues(1));
  }
};

TEST_P(CurveAsFunctions, in_motion) { compare(all(1e6)[GetParam()], "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n"); }

TEST_P(CurveAsFunctions, at_rest_under_load) {
  // The springs would pull the contact off the end: a bushing keeps it, and its force across the curve remains.
  Held h = all(1)[GetParam()];
  const std::string bushing = fmt::format(
      "MARKER/34, PART=2, RM=22, QP={}, REULER={}\nBUSHING/9, I=31, J=34, K=12500,15000,14000, KT=40,50,60, "
      "FORCE=150,-200,250, TORQUE=5,-4,3\n",
      xyz(h.p), reuler(h.axes));
  h.statement = bushing + h.statement;
  h.helpers += bushing;
  h.at_rest = true;
  compare(h, "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
}
INSTANTIATE_TEST_SUITE_P(every, CurveAsFunctions, ::testing::Range<std::size_t>(0, all(1).size()),
                         [](const auto& p) { return all(1)[p.param].name; });

TEST_F(CurveCases, straight_curve_is_an_inline_primitive_with_its_reaction) {
  // Forces that read the reaction, in a mechanism that moves in space.
  const Vector d = line.slope(0);
  const Matrix3 along = about(cross(Vector{0, 0, 1}, d), std::atan2(std::hypot(d.x, d.y), d.z));
  const std::string feedback =
      "\nSFORCE/1, TRANSLATIONAL, I=30, J=2, FUNCTION=0.4*{0}(1,0,2,21)-0.3*{0}(1,0,1,0)+0.2*{0}(1,1,4,31)\nSFORCE/2, "
      "TRANSLATIONAL, I=31, J=4, FUNCTION=0.3*FY(31,{1},20)\n";
  const auto solved = [&](const std::string& statement, const std::string& name, int j) {
    const Held h{"", statement + fmt::format(fmt::runtime(feedback), name, j), line.at(0.2), anyhow, {}};
    return run(mechanism(h, false), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  };
  const RunResult curve =
      solved(line.curve(1, 6) + "MARKER/29, PART=2, FLOATING\nPTCV/1, I=31, JFLOAT=29, CURVE=1, RM=22", "PTCV", 29);
  const RunResult primitive =
      solved(fmt::format("MARKER/23, PART=2, RM=22, QP={}, REULER={}\nJPRIM/1, INLINE, I=31, J=23", xyz(line.at(0)),
                         reuler(along)),
             "JPRIM", 23);
  ASSERT_EQ(curve.status, 0) << curve.err;
  ASSERT_EQ(primitive.status, 0) << primitive.err;
  EXPECT_EQ(curve.labels(1), primitive.labels(1));
  expect_same(curve.eigenvalues(1), primitive.eigenvalues(1));
}

}  // namespace
}  // namespace dynalin::cases::curve_functions_test
