// CLOSEDBOX: the roots of the matrices are the eigenvalues, whatever the point and the constraints; what a grid does
// under a force is the response of the linear model.
#include "nastran/closed_box.h"

#include "mechanics/pair_blocks.h"
#include "nastran/deck_roots_test_support.h"
#include "perturbation/perturbed_point.h"

namespace dynalin::nastran::closed_box_test {
namespace {

using namespace nastran_test;

Deck box_of(const Linearization& of, const ExportOptions& options = {}) {
  Diagnostics remarks;
  return value_or_throw(closed_box(of, options, remarks));
}

const std::string gravity = "ACCGRAV/KGRAV=-9.81\n";
const std::string pendulum = gravity +
                             "PART/2, MASS=2, CM=20, IP=0.1,0.2,0.3, QG=0.1,0.2,0\n"
                             "MARKER/20, PART=2, QP=0,0,-0.7\nMARKER/21, PART=2, QP=0.1,0,-0.2, REU=0.4,0.8,0\n"
                             "MARKER/22, PART=2, REU=0,90D,0\n"
                             "MARKER/11, PART=1, QP=0.1,0.2,0, REU=0,90D,0\nJOINT/1, REVOLUTE, I=22, J=11\n";
// Two bodies on joints and springs, in motion, with a state.
const std::string moving =
    gravity +
    "PART/2, MASS=2, CM=20, IP=0.1,0.2,0.3, WZ=3, WX=1\nMARKER/20, PART=2, QP=0.1,0,-0.3\nMARKER/21, PART=2\n"
    "PART/3, MASS=1, CM=30, IP=0.02,0.03,0.05, QG=0.2,0.1,-0.8, VX=0.4\nMARKER/30, PART=3\n"
    "MARKER/31, PART=3, QP=0.1,0.2,0.3, REU=0.3,0.7,-0.2\n"
    "MARKER/12, PART=1\nJOINT/1, SPHERICAL, I=21, J=12\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=30, K=200, C=3, LENGTH=0.3\n"
    "BUSHING/1, I=31, J=12, K=100,120,140, KT=3,4,5, C=1,2,1, CT=0.1,0.1,0.2\n"
    "VARIABLE/1, FUNCTION=4*DX(20)+VY(30)\nDIFF/1, FUNCTION=VARVAL(1)-5*DIF(1)\n"
    "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=2*DIF(1)+0.1*DIF1(1)\n";

// A skate: no motion across its blade, whose direction turns with it.
const std::string skate =
    "PART/2, MASS=2, CM=20, IP=0.1,0.2,0.3, REU=30D,0,0, VX=2, WZ=0.5\nMARKER/20, PART=2, QP=0.1,0,0\nMARKER/21, "
    "PART=2\n"
    "JPRIM/1, INPLANE, I=21, J=1\nJPRIM/2, PARALLEL_AXES, I=21, J=1\n"
    "GCON/1, FUNCTION=VY(21,1,21)\n"
    "VFORCE/1, I=20, JFLOAT=10, RM=1, FX=-3*DX(20)-VX(20), FY=-5*DY(20)\\FZ=0\nMARKER/10, PART=1, FLOATING\n";

// A massless slider between a spring and a damper, one between springs, and a mass.
const std::string chain =
    "PART/2, QG=1,0,0\nMARKER/20, PART=2, REU=90D,90D,0\nPART/3, MASS=2, CM=30, IP=1,1,1, QG=2,0,0\n"
    "MARKER/30, PART=3, REU=90D,90D,0\nPART/4, QG=3,0,0\nMARKER/40, PART=4, REU=90D,90D,0\n"
    "MARKER/12, PART=1, REU=90D,90D,0\nMARKER/14, PART=1, QP=5,0,0\n"
    "JOINT/2, TRANSLATIONAL, I=20, J=12\nJOINT/3, TRANSLATIONAL, I=30, J=12\nJOINT/4, TRANSLATIONAL, I=40, J=12\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\n"
    "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, C=7, LENGTH=1\n"
    "SPRINGDAMPER/3, TRANSLATIONAL, I=30, J=1, K=50, LENGTH=2\n"
    "SPRINGDAMPER/4, TRANSLATIONAL, I=40, J=30, K=30, LENGTH=1\n"
    "SPRINGDAMPER/5, TRANSLATIONAL, I=40, J=14, K=20, LENGTH=2\n";

TEST(ClosedBox, of_a_pendulum_has_its_roots_and_one_fixed_grid) {
  const Linearization of = linearization_of(pendulum);
  const Deck deck = box_of(of);
  EXPECT_EQ(deck.scalar_points.size(), 1u);
  ASSERT_EQ(deck.grids.size(), 1u);
  EXPECT_EQ(deck.grids[0].fixed, "123456");
  EXPECT_FALSE(deck.open);
  expect_roots(deck, eigenvalues_of(of), 1e-11);
}

TEST(ClosedBox, of_a_moving_model_with_states_has_its_roots) {
  const Linearization of = linearization_of(moving, Start::as_stated);
  ASSERT_EQ(eigenvalues_of(of).size(), 19u);
  expect_roots(box_of(of), eigenvalues_of(of), 1e-9);
}

TEST(ClosedBox, leaves_damping_out_where_it_is_not_wanted) {
  ExportOptions options;
  options.use_damping = false;
  LinearRequest request;
  request.without_damping = true;
  const Linearization with = linearization_of(moving, Start::as_stated),
                      without = linearization_of(moving, Start::as_stated, request);
  expect_roots(box_of(with, options), eigenvalues_of(without), 1e-9);
  expect_roots(box_of(without), eigenvalues_of(with), 1e-9);
}

TEST(ClosedBox, keeps_velocity_constraints_by_multipliers) {
  const Linearization of = linearization_of(skate, Start::as_stated);
  const Deck deck = box_of(of);
  ASSERT_EQ(eigenvalues_of(of).size(), 5u);
  EXPECT_EQ(deck.scalar_points.size(), 4u);
  expect_roots(deck, eigenvalues_of(of), 1e-8);
}

TEST(ClosedBox, keeps_freedoms_without_mass) {
  const Linearization of = linearization_of(chain);
  ASSERT_EQ(eigenvalues_of(of).size(), 3u);
  const Deck deck = box_of(of);
  EXPECT_EQ(deck.scalar_points.size(), 3u);
  expect_roots(deck, eigenvalues_of(of), 1e-9);
}

TEST(ClosedBox, refuses_a_point_without_degrees_of_freedom) {
  const Linearization of = linearization_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2\nJOINT/1, FIXED, I=20, J=1\nDIFF/1, FUNCTION=-DIF(1)\n",
      Start::as_stated);
  Diagnostics remarks;
  const auto deck = closed_box(of, {}, remarks);
  ASSERT_FALSE(deck);
  EXPECT_NE(deck.error().message.find("OPENBOX"), std::string::npos) << deck.error().message;
}

// --- markers and frequency response ----------------------------------------------------------------------------------

ExportOptions response_of(std::int64_t input, std::int64_t output, Axes axes) {
  ExportOptions options;
  options.solution_number = 108;
  InputChannel in;
  in.name = "in", in.marker_id = input, in.mode = axes;
  OutputChannel out;
  out.name = "out", out.marker_id = output, out.mode = axes;
  options.force_input_channel = {in};
  options.displacement_output_channel = {out};
  return options;
}

// A force along a global axis on one marker and a displacement of another: by the deck and by C (s − A)⁻¹ B + D of the
// linear model, whose input is that force as a VARIABLE.
void expect_response(const std::string& model, int input, int force, int output, int component) {
  const auto text = [](int n) { return std::to_string(n); };
  const std::string measure = std::string(component == 1 ? "DX(" : component == 2 ? "DY(" : "DZ(") + text(output) + ")";
  LinearRequest request;
  request.pinput = 1, request.poutput = 1;
  const Linearization of =
      linearization_of(model + "VARIABLE/50, FUNCTION=0\nPINPUT/1, VARIABLES=50\nVARIABLE/51, FUNCTION=" + measure +
                           "\nPOUTPUT/1, VARIABLES=51\nMARKER/99, PART=1, FLOATING\nVFORCE/99, I=" + text(input) +
                           ", JFLOAT=99, RM=1, FX=" + (force == 1 ? "VARVAL(50)" : "0") +
                           "\\FY=" + (force == 2 ? "VARVAL(50)" : "0") + "\\FZ=0\n",
                       Start::as_stated, request);
  const StateSpace& s = of.linear.model;
  const Deck deck = box_of(linearization_of(model, Start::as_stated), response_of(input, output, Axes::global));
  ASSERT_EQ(deck.inputs.size(), 1u);
  EXPECT_EQ(deck.inputs[0].system, 0);
  for (const double frequency : {1.0, 9.0, 40.0}) {
    const Complex iw(0, frequency);
    Eigen::MatrixXcd resolvent = -s.A.cast<Complex>();
    resolvent.diagonal().array() += iw;
    const Complex expected = (s.C * resolvent.fullPivLu().solve(s.B.cast<Complex>().eval()) + s.D)(0, 0);
    const Complex found = DenseDeck(deck).response({deck.outputs[0].grid, component}, {deck.inputs[0].grid, force}, iw);
    EXPECT_GT(std::abs(expected), 1e-9);
    EXPECT_LT(std::abs(found - expected), 1e-10 * std::abs(expected)) << measure;
  }
}

TEST(ClosedBox, response_at_markers_is_that_of_the_state_space) {
  expect_response(moving, 31, 1, 31, 1);
  expect_response(moving, 31, 2, 20, 3);
  expect_response(skate, 20, 2, 20, 2);
  expect_response(skate, 20, 2, 21, 2);
  expect_response(chain, 30, 1, 30, 1);
  expect_response(chain, 40, 1, 30, 1);
}

TEST(ClosedBox, says_that_forces_which_read_reactions_are_left_out_of_a_response) {
  const std::string force = "SFORCE/7, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=0.1*",
                    values = "VARIABLE/71, FUNCTION=FX(21,12,1)\nVARIABLE/72, FUNCTION=2*VARVAL(71)\n";
  for (const auto& [more, reads] : {std::pair{force + "DX(20)\n", false},
                                    {force + "FX(21,12,1)\n", true},
                                    {values, false},
                                    {values + force + "DX(20)\n", false},
                                    {values + force + "VARVAL(72)\n", true}}) {
    SCOPED_TRACE(more);
    const Linearization of = linearization_of(moving + more, Start::as_stated);
    Diagnostics remarks;
    const Deck deck = value_or_throw(closed_box(of, response_of(31, 31, Axes::global), remarks));
    expect_roots(deck, eigenvalues_of(of), 1e-9);
    ASSERT_EQ(remarks.items().size(), reads ? 1u : 0u);
    if (reads) {
      EXPECT_EQ(remarks.items()[0].code, "export-differs");
    }
  }
}

TEST(ClosedBox, local_components_are_those_along_the_marker) {
  const Linearization of = linearization_of(moving, Start::as_stated);
  const Deck local = box_of(of, response_of(31, 31, Axes::local)),
             global = box_of(of, response_of(31, 31, Axes::global));
  EXPECT_EQ(local.grids.size(), global.grids.size());
  const Matrix3 R = of.linear.at->motion.axes(of.system->layout().marker(*of.system->model().find_marker(31)));
  const auto six = [&](const Deck& deck) {
    const DenseDeck dense(deck);
    Eigen::MatrixXd response(6, 6);
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c)
        response(r, c) = dense.response({deck.outputs[0].grid, r + 1}, {deck.inputs[0].grid, c + 1}, 5.0).real();
    }
    return response;
  };
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(6, 6);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c)
      turn(static_cast<int>(r), static_cast<int>(c)) = turn(static_cast<int>(r + 3), static_cast<int>(c + 3)) = R(r, c);
  }
  const Eigen::MatrixXd a = six(local), b = turn.transpose() * six(global) * turn;
  EXPECT_LT((a - b).norm(), 1e-11 * b.norm());
  EXPECT_GT((six(global) - b).norm(), 1e-2 * b.norm());
}

TEST(ClosedBox, markers_are_exported_on_demand) {
  const Linearization of = linearization_of(pendulum);
  ExportOptions options;
  options.export_all_markers = true;
  EXPECT_EQ(box_of(of, options).grids.size(), 1u + 3u);
  options.export_ground_markers = true;
  const Deck all = box_of(of, options);
  EXPECT_EQ(all.grids.size(), 1u + 3u + 2u);
  EXPECT_EQ(all.systems.size(), 5u);
  expect_roots(all, eigenvalues_of(of), 1e-11);
  options = {};
  options.export_markers_by_id = {{20, 21}, {11, 11}};
  EXPECT_EQ(box_of(of, options).grids.size(), 1u + 3u);
  options.export_markers_by_id = {{77, 77}};
  Diagnostics remarks;
  EXPECT_FALSE(closed_box(of, options, remarks));
  options.ignore_errors = true;
  EXPECT_TRUE(closed_box(of, options, remarks));
  EXPECT_EQ(remarks.items().size(), 1u);
}

TEST(ClosedBox, floating_markers_cannot_be_exported) {
  const Linearization of =
      linearization_of(pendulum + "MARKER/13, PART=1, FLOATING\nVFORCE/9, I=20, JFLOAT=13, RM=1, FX=1\\FY=0\\FZ=0\n");
  ExportOptions options;
  options.export_all_markers = options.export_ground_markers = true;
  EXPECT_EQ(box_of(of, options).grids.size(), 1u + 3u + 2u);
  options.export_markers_by_id = {{13, 13}};
  Diagnostics remarks;
  const auto deck = closed_box(of, options, remarks);
  ASSERT_FALSE(deck);
  EXPECT_NE(deck.error().message.find("MARKER/13 is floating"), std::string::npos) << deck.error().message;
}

}  // namespace
}  // namespace dynalin::nastran::closed_box_test
