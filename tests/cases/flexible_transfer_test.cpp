// Matrices A, B, C and D of models with flexible bodies: by what a force does to displacements, velocities and
// accelerations, against the same body cut in two, a rigid one, and the statics of beams.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <complex>

#include "fe_parts.h"
#include "flexible.h"
#include "run.h"

namespace dynalin::cases::flexible_transfer_test {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

class FlexibleTransfer : public Cases {
 protected:
  static MatrixXd matrix(const RunResult& r, const std::string& name) {
    const auto rows = r.matrix(r.json.at("results").size() - 1, name);
    MatrixXd m(rows.size(), rows.empty() ? 0 : rows.front().size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      for (std::size_t c = 0; c < rows[k].size(); ++c)
        m(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = rows[k][c];
    }
    return m;
  }
  struct Plant {
    MatrixXd A, B, C, D;
    MatrixXcd at(const Complex& s) const {
      const MatrixXcd resolvent = s * MatrixXcd::Identity(A.rows(), A.cols()) - A;
      return C * resolvent.partialPivLu().solve(MatrixXcd(B.cast<Complex>())) + D.cast<Complex>();
    }
  };
  Plant plant(const std::string& dataset, const std::string& commands = "") {
    const RunResult r = run(dataset, commands + "LINEAR/STATEMAT, FILE=x, PINPUT=1, POUTPUT=1\nSTOP\n");
    EXPECT_EQ(r.status, 0) << r.err << r.message;
    return {matrix(r, "A"), matrix(r, "B"), matrix(r, "C"), matrix(r, "D")};
  }
};

// A force along each axis and a torque on a marker, and what another one does: places, rates and accelerations.
std::string inputs_and_outputs(int loaded, int seen) {
  std::string t = fmt::format("MARKER/3, PART=1, FLOATING\nGFORCE/1, I={}, JFLOAT=3, RM=1", loaded);
  std::string inputs, outputs, variables;
  int id = 0;
  for (const std::string of : {"FX", "FY", "FZ", "TX", "TY", "TZ"}) {
    t += fmt::format("\n, {}=VARVAL({}){}", of, ++id, of == "TZ" ? "" : "\\");
    variables += fmt::format("VARIABLE/{}, FUNCTION=0\n", id);
    inputs += fmt::format("{}{}", id > 1 ? "," : "", id);
  }
  for (const std::string of : {"DX", "DY", "DZ", "VX", "VY", "VZ", "WX", "WY", "WZ", "ACCX", "ACCY", "ACCZ"}) {
    variables += fmt::format("VARIABLE/{}, FUNCTION={}({},1)\n", ++id, of, seen);
    outputs += fmt::format("{}{}", id > 7 ? "," : "", id);
  }
  return t + "\n" + variables + "PINPUT/1, VARIABLES=" + inputs + "\nPOUTPUT/1, VARIABLES=" + outputs + "\n";
}

void expect_same_plants(const auto& one, const auto& other, double to, std::initializer_list<double> frequencies) {
  for (const double w : frequencies) {
    const Complex s(0.3, w);
    const MatrixXcd a = one.at(s), b = other.at(s);
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    for (Eigen::Index row = 0; row < a.rows(); ++row)
      EXPECT_LE((a.row(row) - b.row(row)).norm(), to * b.row(row).norm() + 1e-13 * b.norm()) << w << " row " << row;
  }
}

// What accelerates is the second derivative of what moves where the model rests.
void expect_rates(const auto& plant, double to, std::initializer_list<double> frequencies) {
  for (const double w : frequencies) {
    const Complex s(0.2, w);
    const MatrixXcd h = plant.at(s);
    const MatrixXcd move = h.middleRows(0, 3), rate = h.middleRows(3, 3), acceleration = h.middleRows(9, 3);
    EXPECT_LE((s * move - rate).norm(), to * rate.norm()) << w;
    EXPECT_LE((s * rate - acceleration).norm(), to * acceleration.norm()) << w;
  }
}

const LumpedBeam whole{7, 0.6, 4.2e6, 900, 1300, 2100, 1.9, 2.5e-3};
const LumpedBeam half{4, 0.3, 4.2e6, 900, 1300, 2100, 1.9, 2.5e-3};

// Every motion of the lumps of either half is in its modes, so that the joined halves have all of the whole's.
TEST_F(FlexibleTransfer, two_halves_that_are_joined_are_the_whole) {
  for (const auto& [beam, name] : {std::pair{&whole, "whole.fem"}, {&half, "half.fem"}}) {
    const Vibration free = vibration(*beam, 0);
    const ReducedBody body = reduced(*beam, free.shapes.rightCols(free.shapes.cols() - 6));
    write(name, modal_text(body.nodes, body.stiffness));
  }
  const std::string head =
                        "Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/5, "
                        "QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1\n",
                    pose = ", REULER=0.4,0.9,-1.1, CRATIO=0, QG=", held = "JOINT/1, FIXED, I=21, J=5\n";
  // The x axis of the BCS along the global axes, for the place of the second half.
  const double c1 = std::cos(0.4), s1 = std::sin(0.4), c3 = std::cos(-1.1), s3 = std::sin(-1.1), c2 = std::cos(0.9),
               s2 = std::sin(0.9);
  const Vector x{c1 * c3 - s1 * c2 * s3, s1 * c3 + c1 * c2 * s3, s2 * s3};
  for (const std::string commands : {"", "SIMULATE/STATIC\n"}) {
    const std::string weight = commands.empty() ? "" : "ACCGRAV/KGRAV=-9.81\n";
    const std::string one = head + "FLEX_BODY/2, MNF_FILE=whole.fem" + pose +
                            "0.3,-0.2,0.7\nMARKER/21, NODE_ID=1\nMARKER/32, NODE_ID=7\nMARKER/33, NODE_ID=6\n" + held +
                            inputs_and_outputs(32, 33) + weight + "END\n";
    const std::string two = head + "FLEX_BODY/2, MNF_FILE=half.fem" + pose +
                            "0.3,-0.2,0.7\nMARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=4\n" +
                            "FLEX_BODY/3, MNF_FILE=half.fem" + pose +
                            fmt::format("{:.17g},{:.17g},{:.17g}", 0.3 + 0.3 * x.x, -0.2 + 0.3 * x.y, 0.7 + 0.3 * x.z) +
                            "\nMARKER/31, NODE_ID=1\nMARKER/32, NODE_ID=4\nMARKER/33, NODE_ID=3\n" + held +
                            "JOINT/2, FIXED, I=31, J=22\n" + inputs_and_outputs(32, 33) + weight + "END\n";
    // Bent by its weight the whole is not that of halves, which turn with their ends: by the square of the angles.
    const Plant of_one = plant(one, commands), of_two = plant(two, commands);
    expect_same_plants(of_one, of_two, commands.empty() ? 1e-6 : 1e-3, {3.0, 700.0, 9000.0});
    expect_rates(of_one, 1e-7, {3.0, 700.0, 9000.0});
  }
}

// Stiff modes change what is slow by the square of the ratio of frequencies.
TEST_F(FlexibleTransfer, stiff_modes_have_the_plant_of_a_part) {
  LumpedBeam stiff = whole;
  for (double* k : {&stiff.EA, &stiff.GJ, &stiff.EIy, &stiff.EIz}) *k *= 1e6;
  const Vibration free = vibration(stiff, 0);
  const ReducedBody body = reduced(stiff, free.shapes.middleCols(6, 5));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  double mass = 0, first = 0, xx = 0, yy = 0, zz = 0;
  for (const FlexibleNode& n : body.nodes) {
    mass += n.mass, first += n.mass * n.at.x;
    xx += n.own.x, yy += n.own.y + n.mass * n.at.x * n.at.x, zz += n.own.z + n.mass * n.at.x * n.at.x;
  }
  const double cm = first / mass;
  const std::string head = "Beam\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n",
                    pose = ", QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1",
                    springs =
                        "MARKER/6, PART=1, QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1\nBUSHING/1, I=21, J=6, "
                        "K=2E3,3E3,4E3, KT=200,300,150, C=3,4,5, CT=0.4,0.3,0.2\n";
  const Plant flexible = plant(head + "FLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0" + pose +
                                   "\nMARKER/21, NODE_ID=1\nMARKER/32, NODE_ID=7\nMARKER/33, NODE_ID=6\n" + springs +
                                   inputs_and_outputs(32, 33) + "END\n",
                               "SIMULATE/STATIC\n");
  const Plant rigid = plant(
      head +
          fmt::format("PART/2, MASS={:.17g}, CM=20, IP={:.17g},{:.17g},{:.17g}", mass, xx, yy - mass * cm * cm,
                      zz - mass * cm * cm) +
          pose +
          fmt::format("\nMARKER/20, QP={:.17g},0,0\nMARKER/21\nMARKER/32, QP=0.6,0,0\nMARKER/33, QP=0.5,0,0\n", cm) +
          springs + inputs_and_outputs(32, 33) + "END\n",
      "SIMULATE/STATIC\n");
  ASSERT_EQ(flexible.A.rows(), rigid.A.rows() + 10);
  expect_same_plants(flexible, rigid, 1e-5, {2.0, 40.0, 300.0});
}

// A force at the tip of a cantilever, and one about its axes: slow and fast.
TEST_F(FlexibleTransfer, a_beam_of_finite_elements_yields_as_timoshenko_says) {
  const StraightBeam beam{.elements = 3, .length = 0.8, .height = 0.05, .width = 0.03, .E = 2.1e11, .density = 7800};
  const Plant p = plant(clamped_beam(beam, inputs_and_outputs(22, 22)));
  const double L = beam.length, E = beam.E, G = E / 2.6, A = beam.area();
  const MatrixXd slow = p.at(0.0).real();
  EXPECT_NEAR(slow(0, 0), L / (E * A), 1e-9 * L / (E * A));
  const double along_y = L * L * L / (3 * E * beam.zz()) + 1.2 * L / (G * A),
               along_z = L * L * L / (3 * E * beam.yy()) + 1.2 * L / (G * A);
  EXPECT_NEAR(slow(1, 1), along_y, 1e-8 * along_y);
  EXPECT_NEAR(slow(2, 2), along_z, 1e-8 * along_z);
  EXPECT_NEAR(slow(1, 5), L * L / (2 * E * beam.zz()), 1e-8 * L * L / (2 * E * beam.zz()));
  EXPECT_NEAR(slow(2, 4), -L * L / (2 * E * beam.yy()), 1e-8 * L * L / (2 * E * beam.yy()));
  expect_rates(p, 1e-8, {10.0, 3000.0, 50000.0});
  // A unit of torque turns the tip at the rate s L/(G J).
  const Complex s(1e-3, 0);
  const double torsion = L / (G * (beam.yy() + beam.zz()));
  EXPECT_NEAR((p.at(s)(6, 3) / s).real(), torsion, 1e-8 * torsion);
}

}  // namespace
}  // namespace dynalin::cases::flexible_transfer_test
