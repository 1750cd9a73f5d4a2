// A flexible body of lumps that slide, against the mechanism of rigid parts that it is: by a file, by matrices, with
// modal loads.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <map>
#include <numbers>

#include "flexible.h"
#include "run.h"

namespace dynalin::cases::sliding_lumps_test {
namespace {

using ::testing::HasSubstr;

class SlidingLumps : public Cases {};

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

void expect_equal_models(const RunResult& found_run, const RunResult& expected_run, double tolerance) {
  ASSERT_EQ(found_run.status, 0) << found_run.err << found_run.message;
  ASSERT_EQ(expected_run.status, 0) << expected_run.err << expected_run.message;
  for (const char* name : {"A", "B", "C", "D"}) {
    const Eigen::MatrixXd found = matrix_of(found_run.matrix(1, name)),
                          expected = matrix_of(expected_run.matrix(1, name));
    ASSERT_EQ(found.rows(), expected.rows()) << name;
    ASSERT_EQ(found.cols(), expected.cols()) << name;
    const double scale = 1 + expected.cwiseAbs().maxCoeff();
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), tolerance * scale) << name << "\n"
                                                                           << found << "\n\n"
                                                                           << expected;
  }
}

constexpr const char* linear_of_lumps = "SIM/INITIAL\nLINEAR/STATEMAT, PSTATE=1, PINPUT=1, POUTPUT=1, FILE=x\nSTOP\n";

TEST_F(SlidingLumps, lumps_that_slide_on_a_turning_body_have_the_linear_model_of_parts) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  expect_equal_models(run(two_lumps(false), linear_of_lumps), run(two_lumps(true), linear_of_lumps), 1e-9);
}

TEST_F(SlidingLumps, lumps_move_like_parts) {
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

// The same body by MATRIX statements, from the formulas of the manual.
std::string matrices_of(const std::vector<FlexibleNode>& nodes, const Eigen::MatrixXd& K,
                        const Eigen::MatrixXd& loads) {
  using Eigen::MatrixXd;
  const Eigen::Index n = K.rows(), count = static_cast<Eigen::Index>(nodes.size());
  const auto vector = [](const Vector& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  const auto hat = [](const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
  };
  std::map<std::string, MatrixXd> all;
  const auto sum = [&](const std::string& name, Eigen::Index rows, Eigen::Index columns) -> MatrixXd& {
    return all[name] = MatrixXd::Zero(rows, columns);
  };
  MatrixXd &I1 = sum("INVAR1", 1, 1), &I2 = sum("INVAR2", 3, 1), &I3 = sum("INVAR3", 3, n), &I4 = sum("INVAR4", 3, n),
           &I5 = sum("INVAR5", 3, n * n), &I6 = sum("INVAR6", n, n), &I7 = sum("INVAR7", 3, 3),
           &I8 = sum("INVAR8", 3, 3 * n), &I9 = sum("INVAR9", 3, 3 * n * n);
  MatrixXd &moves = sum("T_MODE", 3 * count, n), &turns = sum("R_MODE", 3 * count, n), &ids = sum("SELNOD", count, 4);
  for (Eigen::Index p = 0; p < count; ++p) {
    const FlexibleNode& node = nodes[static_cast<std::size_t>(p)];
    const double m = node.mass;
    const Eigen::Vector3d s = vector(node.at);
    const Eigen::Matrix3d J = vector(node.own).asDiagonal();
    ids.row(p) << static_cast<double>(node.label), s.x(), s.y(), s.z();
    I1(0, 0) += m, I2 += m * s, I7 += m * hat(s).transpose() * hat(s) + J;
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto a = static_cast<std::size_t>(j);
      const Eigen::Vector3d phi = vector(node.moves[a]), psi = vector(node.turns[a]);
      moves.block(3 * p, j, 3, 1) = phi, turns.block(3 * p, j, 3, 1) = psi;
      I3.col(j) += m * phi, I4.col(j) += m * s.cross(phi) + J * psi;
      I8.middleCols(3 * j, 3) += m * hat(s) * hat(phi);
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto b = static_cast<std::size_t>(k);
        const Eigen::Vector3d other = vector(node.moves[b]);
        I5.col(j * n + k) += m * phi.cross(other);
        I6(j, k) += m * phi.dot(other) + psi.dot(J * vector(node.turns[b]));
        I9.middleCols(3 * (j * n + k), 3) += m * hat(phi) * hat(other);
      }
    }
  }
  all["GENSTIFF"] = K;
  if (loads.size() > 0) all["MODLOAD"] = loads;
  std::string text;
  int id = 100;
  for (const auto& [name, m] : all) {
    text +=
        fmt::format("MATRIX/{}, NAME={}, FULL=CORDER, ROWS={}, COLUMNS={}, VALUES=", id++, name, m.rows(), m.cols());
    for (Eigen::Index k = 0; k < m.size(); ++k) text += fmt::format("{}{:.17g}", k > 0 ? "\n," : "", m.data()[k]);
    text += "\n";
  }
  return text;
}

// The lumps by matrices in the place of a file, or their twin, with statements more.
std::string lumps_with(bool twin, const std::string& more, const Eigen::MatrixXd& loads = {}) {
  std::string t = two_lumps(twin);
  if (!twin) {
    const std::string file = "MNF_FILE=lumps.fem";
    std::string ids = "MATRICES=100";
    for (int k = 101; k < 113 + (loads.size() > 0); ++k) ids += fmt::format(",{}", k);
    t.replace(t.find(file), file.size(), ids);
    t.insert(t.rfind("END"), matrices_of(nodes_of_lumps(), stiffness, loads));
  }
  return t.insert(t.rfind("END"), more);
}

TEST_F(SlidingLumps, is_the_same_by_matrices_as_by_a_file) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  expect_equal_models(run(lumps_with(false, ""), linear_of_lumps), run(two_lumps(false), linear_of_lumps), 1e-10);
}

// What pushes lump A away from the core, and what pushes the core alone against the pendulum.
TEST_F(SlidingLumps, takes_modal_loads_as_parts_take_forces) {
  const Vector push{0.7, -0.4, 1.1}, force{3, -2, 1.5}, torque{0.4, 0.9, -0.6};
  const std::string first = "2+3*VX(52,1,1)+4*DX(51,1)", second = "1.5*VARVAL(9)+0.3*DY(52,2)+SIN(DZ(51,1))";
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(9, 2);
  loads(6, 0) = dot(a1, push), loads(7, 0) = dot(a2, push);
  loads.col(1).head(6) << force.x, force.y, force.z, torque.x, torque.y, torque.z;
  const std::string floating = "MARKER/7, PART=5, FLOATING\n";
  std::string vforce = "VFORCE/8, I=32, JFLOAT=6, RM=22", gforce = "GFORCE/9, I=24, JFLOAT=7, RM=24";
  for (std::size_t c = 0; c < 3; ++c) {
    vforce += fmt::format(", F{}={}*({}){}", "XYZ"[c], push[c], first, c < 2 ? "\\" : "\n");
    gforce += fmt::format(", F{0}={1}*({2})\\ , T{0}={3}*({2}){4}", "XYZ"[c], force[c], second, torque[c],
                          c < 2 ? "\\" : "\n");
  }
  std::string flexible = lumps_with(false,
                                    floating + "MFORCE/1, FLEX_BODY=2, CASE_INDEX=1, SCALE=" + first +
                                        "\nMFORCE/2, FLEX_BODY=2, JFLOAT=7, CASE_INDEX=2, SCALE=" + second + "\n",
                                    loads);
  std::string rigid = lumps_with(true, floating + "MARKER/6, PART=2, FLOATING\nMARKER/24, PART=2\n" + vforce + gforce);
  expect_equal_models(run(flexible, linear_of_lumps), run(rigid, linear_of_lumps), 1e-9);
  // Driven about its hinge, and free to turn there: then loads turn with it.
  const std::string drive = "MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=9*TIME\n";
  for (std::string* t : {&flexible, &rigid}) t->erase(t->find(drive), drive.size());
  expect_equal_models(run(flexible, linear_of_lumps), run(rigid, linear_of_lumps), 1e-9);
}

TEST_F(SlidingLumps, matrices_that_do_not_fit_are_errors) {
  const std::string head = "Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  const std::string body = "FLEX_BODY/2, MATRICES=100,101,102,103,104,105,106,107,108,109,110,111,112\n";
  std::string data = matrices_of(nodes_of_lumps(), stiffness, {});
  const auto said = [&](const std::string& text) { return run(head + text + "END\n", "LINEAR/EIGENSOL\nSTOP\n").err; };
  EXPECT_THAT(said(body + std::string(data).replace(data.find("NAME=INVAR3"), 11, "NAME=GENDAMP")),
              HasSubstr("FLEX_BODY/2 lacks INVAR3 among its MATRICES"));
  EXPECT_THAT(said(body + std::string(data).replace(data.find("NAME=INVAR3"), 11, "NAME=INVAR33")),
              HasSubstr("is named INVAR33, which is none"));
  EXPECT_THAT(said(body + std::string(data).replace(data.find("NAME=INVAR4"), 11, "NAME=INVAR3")),
              HasSubstr("has two matrices INVAR3"));
  const std::string size = "NAME=INVAR3, FULL=CORDER, ROWS=3, COLUMNS=3",
                    turned = "NAME=INVAR3, FULL=CORDER, ROWS=9, COLUMNS=1";
  EXPECT_THAT(said(body + std::string(data).replace(data.find(size), size.size(), turned)),
              HasSubstr("INVAR3 (MATRIX/103) of FLEX_BODY/2 must be 3 × 3, it is 9 × 1"));
  const std::string mass = "NAME=INVAR1, FULL=CORDER, ROWS=1, COLUMNS=1, VALUES=";
  const std::size_t value = data.find(mass) + mass.size();
  EXPECT_THAT(said(body + std::string(data).replace(value, data.find('\n', value) - value, "0")),
              HasSubstr("the mass 0 in FLEX_BODY/2 is not positive"));
  EXPECT_THAT(said("FLEX_BODY/2, MATRICES=100,999\n" + data), HasSubstr("999"));
  EXPECT_THAT(said(body + data + "MFORCE/1, FLEX_BODY=2, CASE_INDEX=1, SCALE=1\n"),
              HasSubstr("MFORCE/1 takes a modal load, and FLEX_BODY/2 has none"));
}

}  // namespace
}  // namespace dynalin::cases::sliding_lumps_test
