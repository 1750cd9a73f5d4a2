// A modal coordinate has the unit that its shape gives it, and so has no size of its own: neither other units of the
// model nor other multiples of its shapes change what a flexible body does.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <numbers>

#include "flexible.h"
#include "run.h"

namespace dynalin::cases::modal_units_test {
namespace {

class ModalUnits : public Cases {
 protected:
  // The body in units of length of which `length` make a metre, its coordinates `scale` times as large.
  void write_body(ReducedBody body, double length, const std::vector<double>& scale) const {
    for (FlexibleNode& p : body.nodes) {
      p.at = length * p.at, p.own = length * length * p.own;
      for (std::size_t k = 0; k < scale.size(); ++k)
        p.moves[k] = (1 / scale[k]) * p.moves[k], p.turns[k] = (1 / (length * scale[k])) * p.turns[k];
    }
    const Eigen::Map<const Eigen::VectorXd> s(scale.data(), static_cast<Eigen::Index>(scale.size()));
    body.stiffness = (s.cwiseInverse().asDiagonal() * body.stiffness * s.cwiseInverse().asDiagonal() / length).eval();
    write("body.fem", modal_text(body.nodes, body.stiffness));
  }
  static double reaction(const RunResult& r, std::size_t k, std::size_t axis) {
    return r.result(k).at("operating_point").at("reactions").at(0).at("global_force").at(axis).get<double>();
  }
};

struct Unit {
  const char* name;
  double to_metre;
};
constexpr std::array lengths = {Unit{"METER", 1.0}, Unit{"MILLIMETER", 1e3}, Unit{"MICROMETER", 1e6}};
const std::vector<std::vector<double>> scales = {{1, 1, 1, 1, 1, 1},
                                                 {1e6, 1e6, 1e6, 1e6, 1e6, 1e6},
                                                 {1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6},
                                                 {1e6, 1, 1e-6, 1e3, 1, 1}};

void expect_same(const RunResult& r, std::size_t k, std::vector<std::complex<double>>& first) {
  const auto found = r.eigenvalues(k);
  if (first.empty()) first = found;
  ASSERT_EQ(found.size(), first.size());
  double fastest = 0;
  for (const auto& e : first) fastest = std::max(fastest, std::abs(e));
  for (std::size_t e = 0; e < found.size(); ++e)
    EXPECT_LE(std::abs(found[e] - first[e]), 1e-9 * std::max(std::abs(first[e]), 1e-3 * fastest)) << e;
}

// Silicon, 100 x 10 x 2 micrometres, bent by its load: modes and reactions at the bent point.
TEST_F(ModalUnits, a_bent_cantilever_of_micrometres) {
  const LumpedBeam silicon{
      6, 1e-4, 1.6e11 * 2e-11, 65e9 * 2.3e-23, 1.6e11 * 1.67e-22, 1.6e11 * 6.7e-24, 2330 * 2e-11, 2330 * 1.7e-22};
  const Vibration free = vibration(silicon, 0);
  const ReducedBody body = reduced(silicon, free.shapes.middleCols(6, 6));
  std::vector<std::complex<double>> first;
  for (const Unit& unit : lengths) {
    for (const auto& scale : scales) {
      SCOPED_TRACE(testing::Message() << unit.name << " " << scale[0] << " " << scale[1]);
      write_body(body, unit.to_metre, scale);
      const RunResult r =
          run(fmt::format("Beam\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={}, TIME=SECOND\nPART/1, GROUND\nMARKER/1\n"
                          "FLEX_BODY/2, MNF_FILE=body.fem, CRATIO=0\nMARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=6\n"
                          "JOINT/1, FIXED, I=21, J=1\nMARKER/5, PART=1, FLOATING\n"
                          "VFORCE/1, I=22, JFLOAT=5, RM=1, FX=0\\FY=1E-6\\FZ=0\nEND\n",
                          unit.name),
              "SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n");
      ASSERT_EQ(r.status, 0) << r.err << r.message;
      expect_same(r, 1, first);
      for (const std::size_t k : {0u, 1u}) EXPECT_NEAR(std::abs(reaction(r, k, 1)), 1e-6, 1e-13) << k;
    }
  }
  EXPECT_GT(first.size(), 10u);
}

// However stiff the mode, what hangs by it weighs and swings.
TEST_F(ModalUnits, a_pendulum_that_hangs_by_a_stiff_mode) {
  std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 1, {0.1, 0.1, 0.1}, {{0, 0, 0}}, {{0, 0, 0}}},
                                     {2, {0, 1, 0}, 1, {0.1, 0.1, 0.1}, {{0, 1, 0}}, {{0, 0, 0}}},
                                     {3, {0.1, 0.2, 0}, 1, {0.1, 0.1, 0.1}, {{0, 0, 0}}, {{0, 0, 0}}}};
  std::vector<double> accelerations;
  for (const double stiffness : {1e6, 1e15, 1e17, 1e20}) {
    for (const double scale : {1.0, 1e6, 1e-6}) {
      SCOPED_TRACE(testing::Message() << stiffness << " " << scale);
      write_body({nodes, Eigen::MatrixXd::Constant(1, 1, stiffness)}, 1, {scale});
      const std::string dataset =
          "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=body.fem, "
          "CRATIO=0, QG=0,-1,0\nMARKER/22, NODE_ID=2\nJOINT/1, REVOLUTE, I=22, J=1\nEND\n";
      const RunResult r = run(dataset, "SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n");
      ASSERT_EQ(r.status, 0) << r.err << r.message;
      EXPECT_NEAR(std::abs(reaction(r, 0, 1)), 30, 1e-9);
      EXPECT_NEAR(std::abs(reaction(r, 1, 1)), 30, 1e-9);
      double slowest = 1e300;
      for (const auto& e : r.eigenvalues(1)) slowest = std::min(slowest, std::abs(e));
      // Mass points about the joint: m g s = 30 · s of the centre.
      const double inertia = 0.3 + 1.0 + 0.01 + 0.64, first = std::hypot(0.1, 1.8);
      EXPECT_NEAR(slowest, std::sqrt(10 * first / inertia) / (2 * std::numbers::pi), 1e-5 * slowest);
      // Thrown with the mode at rest, which has no force yet.
      std::string thrown = dataset;
      thrown.insert(thrown.find(", QG"), ", WZ=3");
      const RunResult start = run(thrown, "SIMULATE/INITIAL\nSTOP\n");
      ASSERT_EQ(start.status, 0) << start.err;
      const auto& moved = start.result(0).at("operating_point").at("bodies").at(0);
      std::vector<double> found = moved.at("acceleration").get<std::vector<double>>();
      found.push_back(moved.at("angular_acceleration").at(2).get<double>());
      if (accelerations.empty()) accelerations = found;
      for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], accelerations[k], 1e-9) << k;
      EXPECT_GT(std::abs(found[0]), 0.1);
    }
  }
}

// What is drawn open is closed, however little of its coordinate moves the body.
TEST_F(ModalUnits, a_joint_that_is_drawn_open) {
  std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 1, {0.1, 0.1, 0.1}, {{0, 0, 0}}, {{0, 0, 0}}},
                                     {2, {1, 0, 0}, 1, {0.1, 0.1, 0.1}, {{0, 1, 0}}, {{0, 0, 0}}}};
  for (const double scale : {1.0, 1e9, 1e-9}) {
    SCOPED_TRACE(scale);
    write_body({nodes, Eigen::MatrixXd::Constant(1, 1, 1e3)}, 1, {scale});
    const RunResult r =
        run("Open\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=body.fem\nMARKER/21, NODE_ID=1\n"
            "MARKER/22, NODE_ID=2\nJOINT/1, FIXED, I=21, J=1\nMARKER/3, PART=1, QP=1,1E-6,0, REULER=0,90D,0\n"
            "JPRIM/1, INPLANE, I=22, J=3\nVARIABLE/1, FUNCTION=DY(22,3)\nEND\n",
            "SIMULATE/INITIAL\nSTOP\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& values = r.result(0).at("operating_point").at("variables");
    EXPECT_NEAR(values.at(0).at("value").get<double>(), 0, 1e-15);
  }
}

}  // namespace
}  // namespace dynalin::cases::modal_units_test
