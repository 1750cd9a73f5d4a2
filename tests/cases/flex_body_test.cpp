// Flexible bodies against mechanisms of rigid parts that are the same, and against closed forms.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <numbers>

#include "flexible.h"
#include "run.h"

namespace dynalin::cases {
namespace {

using ::testing::HasSubstr;

class FlexBody : public Cases {};

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
  Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()),
                    rows.empty() ? 0 : static_cast<Eigen::Index>(rows.front().size()));
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    for (Eigen::Index c = 0; c < m.cols(); ++c)
      m(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  }
  return m;
}

std::string text(const Vector& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); }
// 3-1-3 angles.
std::string angles(const Matrix3& R) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", std::atan2(R.z.x, -R.z.y), std::acos(R.z.z), std::atan2(R.x.z, R.y.z));
}

// --- two lumps on a body ----------------------------------------------------------------------------
// Three modes let lump A slide in a plane and lump B along two lines, the second mode both of them. Twin: the lumps are
// parts that keep their axes, held to the same displacements, with the same springs.
constexpr double speed = 9;  // about the global z axis
const Vector origin{0.4, -0.3, 0.2};
const Matrix3 axes = rotation_exponential({0.4, -0.7, 0.5});
struct Point {
  double mass;
  Vector at;
};
const std::vector<Point> core{
    {1.1, {0.1, 0.2, -0.3}}, {0.7, {-0.3, 0.1, 0.4}}, {0.9, {0.2, -0.5, 0.1}}, {0.6, {-0.1, -0.2, -0.4}}};
const std::vector<Point> lump_A{
    {0.7, {0.6, 0.2, -0.1}}, {0.4, {0.2, 0.5, -0.3}}, {0.9, {0.4, -0.1, 0.3}}, {0.3, {0.1, 0.3, 0.2}}};
const std::vector<Point> lump_B{
    {0.5, {-0.6, 0.3, 0.2}}, {0.8, {-0.2, 0.5, 0.6}}, {0.2, {-0.4, 0.7, -0.3}}, {0.4, {-0.5, 0.1, 0.5}}};
const Vector a1{0.5, -0.6, 0.9}, a2{-0.3, 0.8, 0.2}, b2{0.7, 0.4, -0.5}, b3{0.1, -0.9, 0.6};
const Eigen::Matrix3d stiffness{{900, 120, -80}, {120, 700, 60}, {-80, 60, 1100}};

Vector centre_of(const std::vector<Point>& points) {
  Vector c{};
  double m = 0;
  for (const Point& p : points) c += p.mass * p.at, m += p.mass;
  return c / m;
}
std::string part(int id, const std::vector<Point>& points) {
  const Vector c = centre_of(points);
  double m = 0;
  std::array<double, 6> J{};
  for (const Point& p : points) {
    const Vector r = p.at - c;
    m += p.mass;
    J[0] += p.mass * (r.y * r.y + r.z * r.z), J[1] += p.mass * (r.x * r.x + r.z * r.z);
    J[2] += p.mass * (r.x * r.x + r.y * r.y);
    J[3] += p.mass * r.x * r.y, J[4] += p.mass * r.x * r.z, J[5] += p.mass * r.y * r.z;
  }
  const Vector at = origin + axes * c;
  return fmt::format(
      "PART/{0}, MASS={1:.17g}, CM={0}0, IP={2:.17g},{3:.17g},{4:.17g},{5:.17g},{6:.17g},{7:.17g}, QG={8}, REULER={9}"
      ", VX={10:.17g}, VY={11:.17g}, VZ=0, WX=0, WY=0, WZ={12:.17g}, VM=1, WM=1\nMARKER/{0}0, QP={13}\n",
      id, m, J[0], J[1], J[2], J[3], J[4], J[5], text(origin), angles(axes), -speed * at.y, speed * at.x, speed,
      text(c));
}

std::string two_lumps(bool twin) {
  std::string t = "Lumps\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1.5,0.3,0.4\n";
  const Vector node_A{0.3, 0.1, -0.2}, node_B{-0.4, 0.3, 0.1}, hold{0, 0, 0};
  const std::string held_axes = angles(transpose(axes));
  const Vector on_axis = -1.0 * transpose_times(axes, origin);
  if (twin) {
    t += part(2, core) + fmt::format("MARKER/21, PART=2, QP={}, REULER={}\n", text(on_axis), held_axes);
    t += fmt::format("MARKER/22, PART=2, QP={}\nMARKER/23, PART=2, QP={}\n", text(node_A), text(node_B));
    t +=
        part(3, lump_A) +
        fmt::format("MARKER/32, PART=3, QP={}\nMARKER/31, PART=3, QP=0.7,0.3,0.1, REULER=0.3,0.8,-0.4\n", text(node_A));
    t += part(4, lump_B) +
         fmt::format("MARKER/43, PART=4, QP={}\nMARKER/41, PART=4, QP=0.2,-0.4,0.3, REULER=1,0.4,0.2\n", text(node_B));
  } else {
    const Vector at = origin;
    t += fmt::format(
        "FLEX_BODY/2, MNF_FILE=lumps.fem, QG={}, REULER={}, CRATIO=0, VX={:.17g}, VY={:.17g}, VZ=0, WX=0, "
        "WY=0, WZ={:.17g}, VM=1, WM=1\n",
        text(origin), angles(axes), -speed * at.y, speed * at.x, speed);
    t += fmt::format("MARKER/21, FLEX_BODY=2, NODE_ID=100, QP={}, REULER={}\n", text(on_axis - hold), held_axes);
    t += fmt::format("MARKER/22, FLEX_BODY=2, NODE_ID=100, QP={}\nMARKER/23, FLEX_BODY=2, NODE_ID=100, QP={}\n",
                     text(node_A), text(node_B));
    t += "MARKER/32, FLEX_BODY=2, NODE_ID=200\nMARKER/43, FLEX_BODY=2, NODE_ID=300\n";
    t += fmt::format("MARKER/31, FLEX_BODY=2, NODE_ID=200, QP={}, REULER=0.3,0.8,-0.4\n",
                     text(Vector{0.7, 0.3, 0.1} - node_A));
    t += fmt::format("MARKER/41, FLEX_BODY=2, NODE_ID=300, QP={}, REULER=1,0.4,0.2\n",
                     text(Vector{0.2, -0.4, 0.3} - node_B));
  }
  // A pendulum on lump A.
  t += part(5, {{0.5, {0.9, 0.4, 0.1}}, {0.4, {0.8, 0.6, 0.3}}, {0.3, {1.1, 0.2, 0.0}}, {0.2, {0.9, 0.1, -0.3}}});
  t += "MARKER/51, PART=5, QP=0.7,0.3,0.1\nMARKER/52, PART=5, QP=1.1,0.6,-0.2, REULER=1,0.4,0.2\n";
  t += "JOINT/1, REVOLUTE, I=21, J=1\nMOTION/1, JOINT=1, ROTATIONAL, FUNCTION=9*TIME\nJOINT/3, SPHERICAL, I=51, J=31\n";
  if (twin) {
    t += "JPRIM/1, ORIENTATION, I=32, J=22\nJPRIM/2, ORIENTATION, I=43, J=23\n";
    // q of both lumps by the dual directions of each.
    const auto dual = [](const Vector& u, const Vector& other) {
      const Vector n = cross(u, other), d = cross(other, n);
      return d / dot(d, u);
    };
    const auto along = [](const Vector& d, int i, int j) {
      return fmt::format("({:.17g}*DX({},{},{})+({:.17g})*DY({},{},{})+({:.17g})*DZ({},{},{}))", d.x, i, j, j, d.y, i,
                         j, j, d.z, i, j, j);
    };
    const Vector nA = cross(a1, a2), nB = cross(b2, b3);
    const Vector dA1 = dual(a1, a2), dA2 = dual(a2, a1), dB2 = dual(b2, b3), dB3 = dual(b3, b2);
    const std::string q1 = along(dA1, 32, 22), q2 = along(dA2, 32, 22), q3 = along(dB3, 43, 23);
    t += "GCON/1, FUNCTION=" + along(nA, 32, 22) + "\nGCON/2, FUNCTION=" + along(nB, 43, 23) +
         "\nGCON/3, FUNCTION=" + q2 + "-" + along(dB2, 43, 23) + "\n";
    t += "VARIABLE/1, FUNCTION=" + q1 + "\nVARIABLE/2, FUNCTION=" + q2 + "\nVARIABLE/3, FUNCTION=" + q3 + "\n";
    t += "MARKER/8, PART=2, FLOATING\nMARKER/9, PART=2, FLOATING\n";
    const auto force = [&](int id, int i, int jfloat, int rm, const std::vector<std::pair<Vector, int>>& parts) {
      std::string s = fmt::format("VFORCE/{}, I={}, JFLOAT={}, RM={}", id, i, jfloat, rm);
      for (std::size_t c = 0; c < 3; ++c) {
        s += fmt::format(", F{}=", "XYZ"[c]);
        for (const auto& [d, row] : parts) {
          for (int k = 0; k < 3; ++k) s += fmt::format("-({:.17g})*VARVAL({})", d[c] * stiffness(row, k), k + 1);
        }
        s += c < 2 ? "\\" : "\n";
      }
      return s;
    };
    t += force(1, 32, 8, 22, {{dA1, 0}, {dA2, 1}}) + force(2, 43, 9, 23, {{dB3, 2}});
  }
  // What acts on the lumps and reads them.
  t += "BUSHING/1, I=31, J=2, K=40,50,60, KT=5,6,7, C=2,1,3, CT=0.4,0.3,0.2, FORCE=3,-4,5\n";
  t += "SPRINGDAMPER/3, TRANSLATION, I=41, J=52, K=300, C=2, LENGTH=0.6\n";
  t += "VARIABLE/9, FUNCTION=0.4\nPINPUT/1, VARIABLES=9\nSFORCE/4, I=52, J=41, TRANSLATIONAL, "
       "FUNCTION=5*VARVAL(9)-0.7*VX(52,41,41,41)\n";
  t += "VARIABLE/22, FUNCTION=DX(31,2,52)\nVARIABLE/23, FUNCTION=VY(41,1,31)\nVARIABLE/24, FUNCTION=ACCX(31,1,41)\n"
       "VARIABLE/25, FUNCTION=TZ(31,2,31)+FM(51,31)\nPOUTPUT/1, VARIABLES=22,23,24,25\n";
  t += "VARIABLE/11, FUNCTION=DX(32,22,22)\nVARIABLE/12, FUNCTION=DY(32,22,22)\nVARIABLE/13, FUNCTION=DX(43,23,23)\n"
       "VARIABLE/14, FUNCTION=AX(52,31)\nVARIABLE/15, FUNCTION=AY(52,1)\nVARIABLE/16, FUNCTION=AZ(52,31)\n"
       "PSTATE/1, VARIABLES=11,12,13,14,15,16\nEND\n";
  return t;
}

std::vector<FlexibleNode> nodes_of_lumps() {
  std::vector<FlexibleNode> nodes;
  const auto add = [&](const Point& p, const Vector& m1, const Vector& m2, const Vector& m3, std::int64_t label) {
    nodes.push_back({label, p.at, p.mass, {}, {m1, m2, m3}, {Vector{}, Vector{}, Vector{}}});
  };
  std::int64_t label = 1;
  for (const Point& p : core) add(p, {}, {}, {}, label++);
  for (const Point& p : lump_A) add(p, a1, a2, {}, label++);
  for (const Point& p : lump_B) add(p, {}, b2, b3, label++);
  add({0, {0, 0, 0}}, {}, {}, {}, 100);
  add({0, {0.3, 0.1, -0.2}}, a1, a2, {}, 200);
  add({0, {-0.4, 0.3, 0.1}}, {}, b2, b3, 300);
  return nodes;
}

TEST_F(FlexBody, lumps_that_slide_on_a_turning_body_have_the_linear_model_of_parts) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  const std::string linear = "SIM/INITIAL\nLINEAR/STATEMAT, PSTATE=1, PINPUT=1, POUTPUT=1, FILE=x\nSTOP\n";
  const RunResult flexible = run(two_lumps(false), linear), rigid = run(two_lumps(true), linear);
  ASSERT_EQ(flexible.status, 0) << flexible.err << flexible.message;
  ASSERT_EQ(rigid.status, 0) << rigid.err << rigid.message;
  for (const char* name : {"A", "B", "C", "D"}) {
    const Eigen::MatrixXd found = matrix_of(flexible.matrix(1, name)), expected = matrix_of(rigid.matrix(1, name));
    ASSERT_EQ(found.rows(), expected.rows()) << name;
    ASSERT_EQ(found.cols(), expected.cols()) << name;
    const double scale = 1 + expected.cwiseAbs().maxCoeff();
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * scale) << name << "\n" << found << "\n\n" << expected;
  }
}

TEST_F(FlexBody, lumps_move_like_parts) {
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

// --- a beam -----------------------------------------------------------------------------------------
const LumpedBeam beam{6, 0.6, 4.2e6, 900, 1300, 2100, 1.9, 2.5e-3};

std::string held_beam(const std::string& more, const std::string& place = "") {
  return "Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1" + place + "\nFLEX_BODY/2, MNF_FILE=beam.fem" +
         (place.empty() ? "" : ", QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1") + more +
         "\nMARKER/21, FLEX_BODY=2, NODE_ID=1\nJOINT/1, FIXED, I=21, J=1\nEND\n";
}

std::vector<double> frequencies(const RunResult& r, std::size_t k = 0) {
  std::vector<double> list;
  for (const auto& e : r.eigenvalues(k)) {
    if (e.imag() > 0) list.push_back(std::abs(e) * 2 * std::numbers::pi);
  }
  std::ranges::sort(list);
  return list;
}

// All free-free modes of the beam span what it can do: clamped it is the clamped beam, whichever way it stands.
TEST_F(FlexBody, all_free_modes_clamped_are_the_clamped_beam) {
  const Vibration free = vibration(beam, 0), held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, free.shapes.rightCols(free.shapes.cols() - 6));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  for (const std::string place : {"", ", QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1"}) {
    const RunResult r = run(held_beam(", CRATIO=0", place), "LINEAR/EIGENSOL\nSTOP\n");
    ASSERT_EQ(r.status, 0) << r.err << r.message;
    const auto found = frequencies(r);
    ASSERT_EQ(found.size(), 30u);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], std::sqrt(held.squares(static_cast<Eigen::Index>(k))), 1e-8 * found.back()) << k;
  }
}

TEST_F(FlexBody, slender_beams_have_the_frequencies_of_theory) {
  const LumpedBeam fine{41, 1.0, 4e6, 400, 50, 50, 2.0, 1e-9};
  const Vibration free = vibration(fine, 0), held = vibration(fine, 6);
  const double unit = std::sqrt(fine.EIz / fine.mass_per_length);
  // Free-free, with the BCS of a beam that nothing holds.
  const ReducedBody loose = reduced(fine, free.shapes.middleCols(6, 6));
  write("beam.fem", modal_text(loose.nodes, loose.stiffness));
  RunResult r = run("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0\nEND\n",
                    "LINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  auto found = frequencies(r);
  ASSERT_EQ(found.size(), 6u);
  for (const auto& [k, beta] : {std::pair<std::size_t, double>{0, 4.73004074}, {2, 7.85320462}, {4, 10.9956078}})
    EXPECT_NEAR(found[k], beta * beta * unit, 5e-3 * found[k]);
  // Clamped, by the modes of the clamped beam.
  const ReducedBody clamped = reduced(fine, held.shapes.leftCols(6));
  write("beam.fem", modal_text(clamped.nodes, clamped.stiffness));
  r = run(held_beam(", CRATIO=0"), "LINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  found = frequencies(r);
  for (const auto& [k, beta] : {std::pair<std::size_t, double>{0, 1.87510407}, {2, 4.69409113}, {4, 7.85475744}})
    EXPECT_NEAR(found[k], beta * beta * unit, 5e-3 * found[k]);
}

TEST_F(FlexBody, damping_is_that_of_each_mode) {
  const Vibration held = vibration(beam, 6);
  // In a basis that mixes the modes.
  Eigen::MatrixXd mixed = held.shapes.leftCols(8);
  mixed.col(0) += 0.4 * mixed.col(5);
  mixed.col(3) -= 0.7 * mixed.col(1);
  const ReducedBody body = reduced(beam, mixed);
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const auto ratios = [&](const std::string& more) {
    const RunResult r = run(held_beam(more), "LINEAR/EIGENSOL\nSTOP\n");
    EXPECT_EQ(r.status, 0) << r.err << r.message;
    std::vector<std::pair<double, double>> list;
    for (const auto& e : r.eigenvalues(0)) {
      if (e.imag() > 0) list.emplace_back(std::abs(e), -e.real() / std::abs(e));
    }
    std::ranges::sort(list);
    return list;
  };
  for (const auto& [hertz, ratio] : ratios("")) {
    if (hertz >= 1000) continue;
    EXPECT_NEAR(ratio, hertz < 100 ? 0.01 : 0.1, 1e-9) << hertz;
  }
  const auto stepped = ratios(", CRATIO=IF(FXFREQ-150: 0.02, 0.03, 0.05)");
  ASSERT_EQ(stepped.size(), 8u);
  for (const auto& [hertz, ratio] : stepped) EXPECT_NEAR(ratio, hertz < 150 ? 0.02 : 0.05, 1e-9) << hertz;
  for (const auto& [hertz, ratio] : ratios(", CRATIO=1E-4*FXFREQ\\")) EXPECT_NEAR(ratio, 1e-4 * hertz, 1e-9);
  EXPECT_NEAR(ratios(", CRATIO=0").front().second, 0, 1e-12);
  const auto limits = ratios("");
  EXPECT_LT(limits.front().first, 100);
  EXPECT_GT(stepped.back().first, 150);
}

// The same body in metres and in millimetres, with modal coordinates that are lengths.
TEST_F(FlexBody, units_change_nothing) {
  const Vibration held = vibration(beam, 6);
  ReducedBody body = reduced(beam, held.shapes.leftCols(5));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const auto dataset = [](bool millimetres) {
    const double l = millimetres ? 1000 : 1;
    return fmt::format(
        "Beam\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={}, TIME=SECOND\nACCGRAV/JGRAV={:.17g}\nPART/1, GROUND\n"
        "MARKER/1\nMARKER/2, QP={:.17g},{:.17g},0\nFLEX_BODY/2, MNF_FILE=beam.fem, WZ=20\nMARKER/21, "
        "NODE_ID=1\nMARKER/22, NODE_ID=6\n"
        "JOINT/1, REVOLUTE, I=21, J=1\nSPRINGDAMPER/1, TRANS, I=22, J=2, K={:.17g}, C={:.17g}, LENGTH={:.17g}\nEND\n",
        millimetres ? "MILLIMETER" : "METER", -9.81 * l, 0.5 * l, 0.4 * l, 300 / l, 2 / l, 0.2 * l);
  };
  const RunResult metres = run(dataset(false), "SIM/INITIAL\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(metres.status, 0) << metres.err << metres.message;
  for (FlexibleNode& p : body.nodes) {
    p.at = 1000.0 * p.at, p.own = 1e6 * p.own;
    for (Vector& turn : p.turns) turn = 0.001 * turn;
  }
  body.stiffness *= 1e-3;
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const RunResult millimetres = run(dataset(true), "SIM/INITIAL\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(millimetres.status, 0) << millimetres.err << millimetres.message;
  const auto a = metres.eigenvalues(1), b = millimetres.eigenvalues(1);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), 12u);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT(std::abs(a[k] - b[k]), 1e-9 * (1 + std::abs(a[k]))) << k;
}

// A pendulum of a body that hardly bends, and of a part.
TEST_F(FlexBody, stiff_modes_make_a_part) {
  LumpedBeam stiff = beam;
  stiff.EA *= 1e4, stiff.GJ *= 1e4, stiff.EIy *= 1e4, stiff.EIz *= 1e4;
  const Vibration free = vibration(stiff, 0);
  const ReducedBody body = reduced(stiff, free.shapes.middleCols(6, 10));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  double mass = 0, inertia = 0, own = 0;
  for (const FlexibleNode& p : body.nodes) {
    mass += p.mass, inertia += p.mass * (p.at.x - 0.3) * (p.at.x - 0.3), own += p.own.x;
  }
  const std::string rest = "JOINT/1, SPHERICAL, I=21, J=1\nSPRINGDAMPER/1, ROT, I=21, J=1, KT=2, CT=0.1\nEND\n";
  const std::string head = "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=9.81\nPART/1, GROUND\nMARKER/1\n";
  const RunResult flexible = run(head + "FLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0\nMARKER/21, NODE_ID=1\n" + rest,
                                 "SIM/STATIC\nLINEAR/EIGENSOL\nSTOP\n");
  const RunResult rigid = run(head +
                                  fmt::format("PART/2, MASS={:.17g}, CM=20, IP={:.17g},{:.17g},{:.17g}\nMARKER/20, "
                                              "QP=0.3,0,0\nMARKER/21\n",
                                              mass, own, inertia + 0.6 * own, inertia + 0.7 * own) +
                                  rest,
                              "SIM/STATIC\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(flexible.status, 0) << flexible.err << flexible.message;
  ASSERT_EQ(rigid.status, 0) << rigid.err << rigid.message;
  const auto expected = rigid.eigenvalues(rigid.json.at("results").size() - 1);
  const auto found = flexible.eigenvalues(flexible.json.at("results").size() - 1);
  for (const auto& e : expected) {
    double nearest = 1e300;
    for (const auto& f : found) nearest = std::min(nearest, std::abs(e - f));
    EXPECT_LE(nearest, 1e-5 * std::abs(e)) << e;  // an equilibrium of stiff modes is met to the tolerance of statics
  }
}

TEST_F(FlexBody, tables_share_out_its_energy_and_mass) {
  const Vibration free = vibration(beam, 0);
  const ReducedBody body = reduced(beam, free.shapes.middleCols(6, 6));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const RunResult r =
      run("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem\nMARKER/21, NODE_ID=1\n"
          "PART/3, MASS=0.4, CM=30, IP=1E-3,2E-3,3E-3, QG=0.6,0.1,0\nMARKER/30\nMARKER/31, PART=3, QP=0,-0.1,0\n"
          "MARKER/26, FLEX_BODY=2, NODE_ID=6\nJOINT/1, SPHERICAL, I=31, J=26\n"
          "BUSHING/1, I=21, J=1, K=3E3,4E3,5E3, KT=60,70,80, C=2,3,4, CT=0.1,0.1,0.1\nBUSHING/2, I=31, J=26, "
          "KT=5,6,7\nEND\n",
          "LINEAR/EIGENSOL, KINETIC=1,9, STRAIN=1,9, DISSIPAT=1,9, MASS_PER_MODE=1,40\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  bool seen_modal = false;
  for (const auto& table : r.result(0).at("tables")) {
    const std::string kind = table.at("table");
    if (kind == "KINETIC") {
      double sum = 0;
      EXPECT_EQ(table.at("columns").size(), 11u);
      for (const auto& row : table.at("rows")) {
        const auto& values = row.at("values");
        sum += values.back().get<double>();
        if (values[9].is_null()) continue;
        double parts = 0;
        for (std::size_t k = 0; k < 10; ++k) parts += values[k].get<double>();
        EXPECT_NEAR(parts, values[10].get<double>(), 1e-9);
        seen_modal |= std::abs(values[9].get<double>()) > 1;
      }
      EXPECT_NEAR(sum, 100, 1e-9);
    }
  }
  EXPECT_TRUE(seen_modal) << r.json.dump(1).substr(0, 3000);
  EXPECT_THAT(r.text("model.txt"), HasSubstr("FLEX"));
}

// What is drawn apart is brought together by moving it, not by bending it.
TEST_F(FlexBody, drawn_off_its_joint_moves_as_a_whole) {
  const Vibration free = vibration(beam, 0);
  const ReducedBody body = reduced(beam, free.shapes.middleCols(6, 8));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const std::string exact = held_beam(", CRATIO=0", ", QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1"),
                    commands = "LINEAR/EIGENSOL\nSTOP\n";
  std::string apart = exact;
  apart.replace(apart.find("QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1"), 36, "QG=0.33,-0.15,0.65, REULER=0.45,0.85,-1");
  const RunResult good = run(exact, commands), moved = run(apart, commands);
  ASSERT_EQ(good.status, 0) << good.err;
  ASSERT_EQ(moved.status, 0) << moved.err;
  const std::vector<double> expected = frequencies(good), found = frequencies(moved);
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_EQ(expected.size(), 8u);
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-5 * expected[k]);
}

// --- files that are wrong ---------------------------------------------------------------------------
TEST_F(FlexBody, wrong_files_are_errors_at_their_place) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  const std::string good = modal_text(body.nodes, body.stiffness);
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string t = good;
    const auto at = t.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    t.replace(at, old.size(), now);
    return t;
  };
  const auto refused = [&](const std::string& text, const std::string& said) {
    write("beam.fem", text);
    const RunResult r = run(held_beam(""), "LINEAR/EIGENSOL\nSTOP\n");
    EXPECT_NE(r.status, 0);
    EXPECT_THAT(r.err, HasSubstr(said));
  };
  refused(with(" 6\n**\n** RECORD GROUP 5", "**\n** RECORD GROUP 5"),
          "beam.fem:12:1: error: RECORD GROUP 2 ends after 5 of 6 labels");
  refused(with(" 6\n**\n** RECORD GROUP 5", " 6\n7\n**\n** RECORD GROUP 5"),
          "beam.fem:12:1: error: RECORD GROUP 2 holds more numbers than 6 labels");
  refused(with("REV0 6 2", "REV0 6 3"), "RECORD GROUP 8 ends after 0 of 6 × 6 numbers of shape 3");
  refused(with("** RECORD GROUP 9", "** RECORD GROUP 77"), "RECORD GROUP 77 is not known");
  refused(with(" 3\n", " x3y\n 2\n"), "node 2 is given twice");
  refused(with("NORMAL MODE SHAPE #  1\n0", "NORMAL MODE SHAPE #  1\nnought"), "nought is no number");
  refused(std::string("\0\1\2MNF", 6), "is a binary modal neutral file: this format is not public");
  refused("bmod....", "give the .fem text file that it was made from");
  // Modes that the body has already.
  const Vibration free = vibration(beam, 0);
  const ReducedBody rigid = reduced(beam, free.shapes.middleCols(4, 4));
  refused(modal_text(rigid.nodes, rigid.stiffness), "modes 1-2 in ");
  write("beam.fem", good);
  const RunResult r =
      run("Beam\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=TIME\nMARKER/21, NODE_ID=9\n"
          "MARKER/22\nMARKER/23, FLOATING\nEND\n",
          "STOP\n");
  EXPECT_THAT(r.err, HasSubstr("model.adm:5:12: error: FLEX_BODY/2 has no node 9"));
  EXPECT_THAT(r.err, HasSubstr("MARKER/22 on FLEX_BODY/2 needs NODE_ID"));
  EXPECT_THAT(r.err, HasSubstr("MARKER/23 floats on FLEX_BODY/2"));
}

TEST_F(FlexBody, states_have_their_codes) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const RunResult r = run(held_beam(""), "LINEAR/STATEMAT, FILE=x\nLINEAR/STATEMAT, FILE=y, RM=1\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  for (const auto& [k, type] : {std::pair<std::size_t, int>{0, 28}, {1, 38}}) {
    const auto& states = r.result(k).at("states");
    ASSERT_EQ(states.size(), 4u);
    EXPECT_THAT(states.dump(), HasSubstr(fmt::format("{}", type)));
    EXPECT_THAT(states.dump(), HasSubstr("1000002"));
    EXPECT_THAT(states.dump(), HasSubstr("2000001"));
    EXPECT_THAT(states.dump(), HasSubstr("Modal generalized coordinate Q1"));
  }
}

}  // namespace
}  // namespace dynalin::cases
