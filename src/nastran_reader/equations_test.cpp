// Each card against matrices computed by hand.
#include "nastran_reader/equations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "nastran_reader/solve.h"

namespace dynalin::nastran_reader::equations_test {
namespace {

using Eigen::MatrixXd;

Prepared prepared(const std::string& bulk, const std::string& control = "") {
  Diagnostics reading;
  Deck deck = deck_of_text("test.bdf", "SOL 107\nCEND\n" + control + "BEGIN BULK\n" + bulk + "ENDDATA\n", reading);
  Prepared p = prepare(std::move(deck), std::move(reading), Purpose::check);
  EXPECT_FALSE(p.diagnostics.has_errors()) << render(p.diagnostics);
  return p;
}

void expect_near(const MatrixXd& is, const MatrixXd& should) {
  ASSERT_EQ(is.rows(), should.rows());
  ASSERT_EQ(is.cols(), should.cols());
  EXPECT_LT((is - should).cwiseAbs().maxCoeff(), 1e-12 * std::max(1.0, should.cwiseAbs().maxCoeff())) << is;
}

TEST(Card, conm2_offset_and_products_of_inertia) {
  const Prepared p = prepared("GRID,1,,10.,20.,30.\nCONM2,1,1,,2.,1.,0.,3.\n,4.,.1,5.,.2,.3,6.\n");
  MatrixXd M = MatrixXd::Zero(6, 6);
  M.topLeftCorner(3, 3) = 2 * MatrixXd::Identity(3, 3);
  // The velocity of the mass centre d = (1, 0, 3) is v + ω × d.
  MatrixXd d(3, 3);
  d << 0, -3, 0, 3, 0, -1, 0, 1, 0;
  M.topRightCorner(3, 3) = -2 * d, M.bottomLeftCorner(3, 3) = 2 * d;
  MatrixXd J(3, 3);
  J << 4 + 2 * 9, -.1, -.2 - 2 * 3, -.1, 5 + 2 * 10, -.3, -.2 - 2 * 3, -.3, 6 + 2 * 1;
  M.bottomRightCorner(3, 3) = J;
  expect_near(MatrixXd(p.equations.M), M);
}

TEST(Card, conm2_with_a_mass_centre_in_the_basic_system) {
  const std::string inertia = "\n,4.,.1,5.,.2,.3,6.\n";
  const Prepared a =
      prepared("CORD2R,3,,0.,0.,0.,1.,2.,2.\n,2.,1.,-2.\nGRID,1,,10.,20.,30.,3\nCONM2,1,1,,2.,1.,0.,3." + inertia);
  const Prepared b =
      prepared("CORD2R,3,,0.,0.,0.,1.,2.,2.\n,2.,1.,-2.\nGRID,1,,10.,20.,30.,3\nCONM2,1,1,-1,2.,11.,20.,33." + inertia);
  expect_near(MatrixXd(a.equations.M), MatrixXd(b.equations.M));
}

TEST(Card, conm2_in_a_system_and_a_grid_in_another) {
  // CID 4 has its axes permuted: x along basic y, y along z, z along x.
  const std::string systems = "CORD2R,4,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n";
  const Prepared p = prepared(systems + "GRID,1,,0.,0.,0.,4\nCONM2,1,1,0,2.,1.,2.,3.\n,4.,.1,5.,.2,.3,6.\n");
  // The same in the axes of the grid: offset (2, 3, 1), tensor permuted.
  const Prepared q = prepared("GRID,1\nCONM2,1,1,,2.,2.,3.,1.\n,5.,.3,6.,.1,.2,4.\n");
  expect_near(MatrixXd(p.equations.M), MatrixXd(q.equations.M));
  const Prepared r = prepared(systems + "GRID,1\nCONM2,1,1,4,2.,2.,3.,1.\n,5.,.3,6.,.1,.2,4.\n");
  const Prepared s = prepared("GRID,1\nCONM2,1,1,,2.,1.,2.,3.\n,4.,.1,5.,.2,.3,6.\n");
  expect_near(MatrixXd(r.equations.M), MatrixXd(s.equations.M));
}

TEST(Card, conm1_scalar_masses_and_wtmass) {
  const Prepared p =
      prepared("PARAM,WTMASS,.5\nGRID,1\nSPOINT,2\nCONM1,1,1,,2.,.1,3.\n,4.,,,,5.,,,,\n,,6.,,,,,,7.\nCMASS2,2,8.,2\n");
  MatrixXd M = MatrixXd::Zero(7, 7);
  M.diagonal() << 2, 3, 4, 5, 6, 7, 8;
  M(0, 1) = M(1, 0) = .1;
  // Behind M22 follow M31 M32 | M33 M41 M42 M43 M44 M51 M52 M53 | M54 M55 M61 … M66.
  MatrixXd is(p.equations.M);
  EXPECT_EQ(is(0, 0), 1);
  EXPECT_EQ(is(1, 0), .05);
  EXPECT_EQ(is(1, 1), 1.5);
  EXPECT_EQ(is(2, 2), 2);
  EXPECT_EQ(is(3, 3), 2.5);
  EXPECT_EQ(is(4, 4), 3);
  EXPECT_EQ(is(5, 5), 3.5);
  EXPECT_EQ(is(6, 6), 4);
}

TEST(Card, springs_and_dampers_between_components) {
  const Prepared p = prepared(
      "GRID,1\nSPOINT,2\nCELAS2,1,10.,1,3,2\nCELAS1,2,9,1,3\nPELAS,9,5.\nCDAMP2,3,2.,2,,1,3\nCDAMP1,4,9,2\nPDAMP,9,."
      "5\n");
  MatrixXd K = MatrixXd::Zero(7, 7), B = K;
  K(2, 2) = 15, K(2, 6) = K(6, 2) = -10, K(6, 6) = 10;
  B(2, 2) = 2, B(2, 6) = B(6, 2) = -2, B(6, 6) = 2.5;
  expect_near(MatrixXd(p.equations.K), K);
  expect_near(MatrixXd(p.equations.B), B);
}

const std::string values = "PBUSH,9,K,1.,2.,3.,4.,5.,6.\n,,B,.1,.2,.3,.4,.5,.6\n";

TEST(Card, cbush_of_coincident_grids_is_diagonal) {
  const Prepared p = prepared("GRID,1\nGRID,2\nCBUSH,1,9,1,2,,,,0\n" + values);
  Eigen::VectorXd d(6);
  d << 1, 2, 3, 4, 5, 6;
  MatrixXd K(12, 12);
  K.topLeftCorner(6, 6) = K.bottomRightCorner(6, 6) = d.asDiagonal();
  K.topRightCorner(6, 6) = K.bottomLeftCorner(6, 6) = -MatrixXd(d.asDiagonal());
  expect_near(MatrixXd(p.equations.K), K);
  expect_near(MatrixXd(p.equations.B), 0.1 * K);
}

// The spring stands at S of the way: forces there have levers to both ends.
TEST(Card, cbush_of_finite_length_has_levers) {
  const Prepared p = prepared("GRID,1\nGRID,2,,4.,0.,0.\nCBUSH,1,9,1,2,,,,0\n,.25\n" + values);
  const MatrixXd K(p.equations.K);
  // Ends move down y and turn about z: relative motion along y at x = 1 is (vB − 3 ωB) − (vA + 1 ωA).
  EXPECT_NEAR(K(7, 7), 2, 1e-13);
  EXPECT_NEAR(K(7, 11), -6, 1e-13);
  EXPECT_NEAR(K(11, 11), 6 + 2 * 9, 1e-13);
  EXPECT_NEAR(K(5, 5), 6 + 2 * 1, 1e-13);
  EXPECT_NEAR(K(5, 11), -6 + 2 * 3, 1e-13);
  EXPECT_NEAR(K(1, 5), 2, 1e-13);
  // By default it stands in the middle, or where OCID says.
  EXPECT_NEAR(MatrixXd(prepared("GRID,1\nGRID,2,,4.,0.,0.\nCBUSH,1,9,1,2,,,,0\n" + values).equations.K)(5, 5),
              6 + 2 * 4, 1e-13);
  EXPECT_NEAR(
      MatrixXd(prepared("GRID,1\nGRID,2,,4.,0.,0.\nCBUSH,1,9,1,2,,,,0\n,,0,3.,0.,0.\n" + values).equations.K)(5, 5),
      6 + 2 * 9, 1e-13);
}

// A rigid motion of both ends is no motion of the bush, whatever the axes.
TEST(Card, cbush_does_not_feel_rigid_motions) {
  const Prepared p = prepared(
      "CORD2R,3,,0.,0.,0.,1.,2.,2.\n,2.,1.,-2.\nCORD2R,4,3,1.,0.,2.,1.,1.,2.\n,1.,0.,5.\n"
      "GRID,1,,1.,2.,3.,3\nGRID,2,4,4.,-1.,.5\nCBUSH,1,9,1,2,,,,4\n,.3\n" +
      values);
  Eigen::Matrix<double, 12, 6> rigid;
  rigid.topRows<6>().setIdentity();
  rigid.bottomRows<6>() = rigid_map(*p.points->find(1), *p.points->find(2));
  EXPECT_LT((p.equations.K * rigid).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(MatrixXd(p.equations.K).cwiseAbs().maxCoeff(), 1);
}

TEST(Card, cbush_axes_from_its_ends_and_an_orientation) {
  // x of the element along basic y, its y toward basic z, so z along basic x.
  for (const auto card : {"CBUSH,1,9,1,2,0.,0.,1.\n", "GRID,3,,0.,0.,7.\nCBUSH,1,9,1,2,3\n"}) {
    const Prepared p = prepared(std::string("GRID,1\nGRID,2,,0.,2.,0.\n") + card + values);
    const MatrixXd K(p.equations.K);
    EXPECT_NEAR(K(1, 1), 1, 1e-14);
    EXPECT_NEAR(K(2, 2), 2, 1e-14);
    EXPECT_NEAR(K(0, 0), 3, 1e-14);
    EXPECT_NEAR(K(4, 4), 4, 1e-14);
  }
  const Prepared grounded = prepared("GRID,1\nCBUSH,1,9,1,,,,,0\n" + values);
  EXPECT_EQ(MatrixXd(grounded.equations.K)(1, 1), 2);
}

TEST(Card, coordinate_systems_in_each_other) {
  const Prepared p = prepared(
      "CORD2R,2,,1.,0.,0.,1.,0.,1.\n,1.,1.,0.\n"   // turned by 90 degrees about z, at (1, 0, 0)
      "CORD2R,5,2,0.,2.,0.,0.,2.,1.\n,0.,3.,0.\n"  // in it again: 180 degrees, at (-1, 0, 0)
      "CORD2C,6,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD1R,7,10,11,12\n"
      "GRID,1,5,1.,2.,3.,2\nGRID,2,6,2.,90.,4.,6\nGRID,10\nGRID,11,,1.,0.,0.\nGRID,12,,0.,0.,1.\nGRID,3,7,1.,2.,3.\n");
  EXPECT_LT((p.points->find(1)->position - Vector3d(-2, -2, 3)).norm(), 1e-14);
  EXPECT_LT((p.points->find(1)->axes.col(0) - Vector3d(0, 1, 0)).norm(), 1e-14);
  EXPECT_LT((p.points->find(2)->position - Vector3d(0, 2, 4)).norm(), 1e-14);
  EXPECT_LT((p.points->find(2)->axes.col(0) - Vector3d(0, 1, 0)).norm(), 1e-14);
  EXPECT_LT((p.points->find(2)->axes.col(1) - Vector3d(-1, 0, 0)).norm(), 1e-14);
  // z of 7 along x, x along z, so y = z × x = −y.
  EXPECT_LT((p.points->find(3)->position - Vector3d(3, -2, 1)).norm(), 1e-14);
}

// Every rigid motion of the independent grid, in whatever axes, meets the constraints.
TEST(Card, rbe2_and_rbar_move_rigidly) {
  for (const auto card : {"RBE2,1,1,123456,2\n", "RBAR,1,1,2,123456\n", "RBAR,1,1,2,1235,34\n"}) {
    const Prepared p = prepared(
        std::string("CORD2R,3,,0.,0.,0.,1.,2.,2.\n,2.,1.,-2.\nGRID,1,,1.,2.,3.,3\nGRID,2,3,4.,-1.,.5\n") + card);
    ASSERT_EQ(p.elimination.independent.size(), 6u);
    const MatrixXd T(p.elimination.T);
    const Point &a = *p.points->find(1), &b = *p.points->find(2);
    // Velocities of a rigid motion computed at a third place.
    const Vector3d v(1, -2, .5), w(.3, .7, -1.1);
    Eigen::VectorXd u(12);
    for (const Point* q : {&a, &b}) {
      u.segment<3>(q->first) = q->axes.transpose() * (v + w.cross(q->position));
      u.segment<3>(q->first + 3) = q->axes.transpose() * w;
    }
    EXPECT_LT((T * T.colPivHouseholderQr().solve(u) - u).norm(), 1e-12) << card;
  }
}

TEST(Card, rjoint_makes_directions_of_its_grid_equal) {
  // CD of both differs: the hinge turns about z of system 3, and lets go of nothing else.
  const Prepared p =
      prepared("CORD2R,3,,0.,0.,0.,1.,2.,2.\n,2.,1.,-2.\nGRID,1,,1.,2.,3.\nGRID,2,,1.,2.,3.,3\nRJOINT,1,1,2,12345\n");
  EXPECT_EQ(p.elimination.independent.size(), 7u);
  const MatrixXd T(p.elimination.T);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(12);
  u.segment<3>(3) = Vector3d(1, 2, 2) / 3;  // the first turns about the hinge, the second rests
  EXPECT_LT((T * T.colPivHouseholderQr().solve(u) - u).norm(), 1e-12);
  u[4] += .1;
  EXPECT_GT((T * T.colPivHouseholderQr().solve(u) - u).norm(), 1e-2);
}

TEST(Card, dmig_columns_are_motions_and_rows_are_forces) {
  const std::string bulk =
      "SPOINT,1,2\nGRID,3\nDMIG,A,0,1,1,0\nDMIG,A,1,0,,3,2,.1\nDMIG,S,0,6,2,0\nDMIG,S,3,1,,2,0,2.D0\n";
  const Prepared p = prepared(bulk, "K2PP = 2.0*A, 1.0*S\nM2GG = S\n");
  const MatrixXd K(p.equations.K), M(p.equations.M);
  EXPECT_EQ(p.points->find(1)->first, 6);
  EXPECT_EQ(K(1, 6), 2 * static_cast<double>(0.1f));  // single precision
  EXPECT_EQ(K(6, 1), 0);
  EXPECT_EQ(K(0, 7), 2);
  EXPECT_EQ(K(7, 0), 2);
  EXPECT_EQ(M(7, 0), 2);
}

TEST(Card, sets_of_constraints_count_where_they_are_selected) {
  const std::string bulk =
      "GRID,1,,,,,,456\nSPOINT,2,THRU,4\nMPC,1,2,0,1.,3,0,-1.\nMPC,2,3,0,1.,4,,-1.\nMPCADD,7,1,2\n"
      "SPC,5,1,12\nSPC1,6,3,1\nSPCADD,8,5,6\n";
  EXPECT_EQ(prepared(bulk).elimination.independent.size(), 6u);
  EXPECT_EQ(prepared(bulk, "MPC = 1\nSPC = 5\n").elimination.independent.size(), 3u);
  EXPECT_EQ(prepared(bulk, "MPC = 7\nSPC = 8\n").elimination.independent.size(), 1u);
}

}  // namespace
}  // namespace dynalin::nastran_reader::equations_test
