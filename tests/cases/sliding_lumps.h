// A flexible body of lumps that slide, by a file or by matrices, and the mechanism of rigid parts that it is.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>

#include "cases/flexible.h"
#include "cases/run.h"

namespace dynalin::cases::sliding_lumps {

inline Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
  Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()),
                    rows.empty() ? 0 : static_cast<Eigen::Index>(rows.front().size()));
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    for (Eigen::Index c = 0; c < m.cols(); ++c)
      m(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  }
  return m;
}

inline std::string text(const Vector& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); }
// 3-1-3 angles.
inline std::string angles(const Matrix3& R) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", std::atan2(R.z.x, -R.z.y), std::acos(R.z.z), std::atan2(R.x.z, R.y.z));
}

// --- two lumps on a body ----------------------------------------------------------------------------
// Three modes let lump A slide in a plane and lump B along two lines, the second mode both of them. Twin: the lumps are
// parts that keep their axes, held to the same displacements, with the same springs.
constexpr double speed = 9;  // about the global z axis
inline const Vector origin{0.4, -0.3, 0.2};
inline const Matrix3 axes = rotation_exponential({0.4, -0.7, 0.5});
struct Point {
  double mass;
  Vector at;
};
inline const std::vector<Point> core{
    {1.1, {0.1, 0.2, -0.3}}, {0.7, {-0.3, 0.1, 0.4}}, {0.9, {0.2, -0.5, 0.1}}, {0.6, {-0.1, -0.2, -0.4}}};
inline const std::vector<Point> lump_A{
    {0.7, {0.6, 0.2, -0.1}}, {0.4, {0.2, 0.5, -0.3}}, {0.9, {0.4, -0.1, 0.3}}, {0.3, {0.1, 0.3, 0.2}}};
inline const std::vector<Point> lump_B{
    {0.5, {-0.6, 0.3, 0.2}}, {0.8, {-0.2, 0.5, 0.6}}, {0.2, {-0.4, 0.7, -0.3}}, {0.4, {-0.5, 0.1, 0.5}}};
inline const Vector a1{0.5, -0.6, 0.9}, a2{-0.3, 0.8, 0.2}, b2{0.7, 0.4, -0.5}, b3{0.1, -0.9, 0.6};
inline const Eigen::Matrix3d stiffness{{900, 120, -80}, {120, 700, 60}, {-80, 60, 1100}};

inline Vector centre_of(const std::vector<Point>& points) {
  Vector c{};
  double m = 0;
  for (const Point& p : points) c += p.mass * p.at, m += p.mass;
  return c / m;
}
inline std::string part(int id, const std::vector<Point>& points) {
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

inline std::string two_lumps(bool twin) {
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

inline std::vector<FlexibleNode> nodes_of_lumps() {
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

inline void expect_equal_models(const RunResult& found_run, const RunResult& expected_run, double tolerance) {
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

// The same body by MATRIX statements, from the formulas of the manual.
inline std::string matrices_of(const std::vector<FlexibleNode>& nodes, const Eigen::MatrixXd& K,
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
inline std::string lumps_with(bool twin, const std::string& more, const Eigen::MatrixXd& loads = {}) {
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

}  // namespace dynalin::cases::sliding_lumps
