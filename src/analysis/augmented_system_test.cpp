// The coupled matrix of an instant against differences of the residuals.
#include "analysis/augmented_system.h"

#include <gmock/gmock.h>

#include "analysis/displace.h"
#include "system/model_test_support.h"

namespace dynalin::analysis_test::augmented_system_test {
namespace {

using system_test::system_of;
using ::testing::Contains;

// A turning part on a hinge that is in the way of nothing in particular, with a torque that reads a VARIABLE, a
// reaction, an acceleration and a state.
const std::string model =
    "ACCGRAV/IGRAV=1, JGRAV=-9, KGRAV=2\nPART/2, MASS=2, CM=20, IP=1,2,3, QG=1,0.5,0, REULER=0.3,0.2,0.5\n"
    "MARKER/20, QP=0.3,0.1,0.2\nMARKER/21, QP=-1,0.2,0.4\nMARKER/2, PART=1, REULER=0.5,1,0\n"
    "JOINT/1, SPHERICAL, I=21, J=2\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=5, C=1, LENGTH=0.3\n"
    "VARIABLE/1, FUNCTION=DX(20,1)*DIF(1)+0.2*FY(21,2,2)\nVARIABLE/2, FUNCTION=SIN(VARVAL(1))+0.1*ACCX(20,1)\n"
    "SFORCE/1, ROTATIONAL, I=20, J=2, ACTIONONLY, FUNCTION=-3*VARVAL(2)*VARVAL(1)\n"
    "DIFF/1, IC=0.7, FUNCTION=-2*DIF(1)**2+VARVAL(2)*DY(20,1)\n";

struct Instant {
  std::shared_ptr<const System> system = system_of(model);
  AugmentedSystem augmented{*system};
  OperatingPoint op = system->drawn();
  ConstraintRows rows;
  Equations eq;
  Partition part;

  Instant() {
    double x = 0.3;
    for (auto* values : {&op.velocity, &op.acceleration, &op.lambda, &op.algebraic, &op.state, &op.state_rate}) {
      for (double& v : *values) v = std::sin(x += 1.7);
    }
    rows.resize(system->layout());
    eq.resize(system->layout());
    evaluate(op);
    part = system->partition(rows, RowLevel::velocity);
  }
  void evaluate(const OperatingPoint& at) {
    const Motion m = system->motion(at);
    system->constraints(m, rows);
    system->equations(m, rows, eq,
                      {PartialBy::position, PartialBy::acceleration, PartialBy::lambda, PartialBy::algebraic,
                       PartialBy::state, PartialBy::state_rate});
  }
  // All residuals; constraints on the level of the coordinates.
  Eigen::VectorXd residual(const OperatingPoint& at, bool accelerations) {
    evaluate(at);
    Eigen::VectorXd r = Eigen::VectorXd::Zero(augmented.size());
    const std::int32_t n = system->layout().coordinate_count, m = rows.size();
    for (std::int32_t k = 0; k < eq.size(); ++k) r(k < n ? k : k + m) = eq.residual()[static_cast<std::size_t>(k)];
    for (std::int32_t k = 0; k < m; ++k)
      r(n + k) = accelerations ? rows.along_motion(k).acceleration : rows.along_motion(k).value;
    return r;
  }
  OperatingPoint moved(std::int32_t column, double by, bool accelerations) const {
    OperatingPoint to = op;
    const auto n = static_cast<std::int32_t>(system->coordinates()), m = rows.size(),
               w = static_cast<std::int32_t>(op.algebraic.size());
    const auto at = [](std::int32_t k) { return static_cast<std::size_t>(k); };
    if (column < n && accelerations) to.acceleration[at(column)] += by;
    if (column < n && !accelerations) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
      step(column) = by;
      displace(*system, to, step, {1.0});
    }
    if (column >= n && column < n + m) to.lambda[at(column - n)] += by;
    if (column >= n + m && column < n + m + w) to.algebraic[at(column - n - m)] += by;
    if (column >= n + m + w) (accelerations ? to.state_rate : to.state)[at(column - n - m - w)] += by;
    return to;
  }
};

Eigen::MatrixXd dense(const ColumnMatrix& m) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(m.rows, m.columns);
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { d(r, c) = v; });
  return d;
}

TEST(AugmentedSystem, has_the_partials_of_all_residuals_in_its_order) {
  Instant i;
  for (const bool accelerations : {true, false}) {
    AugmentedColumns columns;
    if (!accelerations) {
      // Velocities turn with the axes where a rotation is varied: here there are none.
      columns = {PartialBy::position, PartialBy::state};
      for (auto* x : {&i.op.velocity, &i.op.acceleration}) std::fill(x->begin(), x->end(), 0.0);
    }
    i.evaluate(i.op);
    const Eigen::MatrixXd m = dense(i.augmented.matrix(i.eq, i.rows, i.part.active, columns));
    for (std::int32_t c = 0; c < i.augmented.size(); ++c) {
      const auto difference = [&](double h) -> Eigen::VectorXd {
        return (i.residual(i.moved(c, h, accelerations), accelerations) -
                i.residual(i.moved(c, -h, accelerations), accelerations)) /
               (2 * h);
      };
      constexpr double h = 2e-3;
      const Eigen::VectorXd expected = (4 * difference(h / 2) - difference(h)) / 3;  // Richardson
      for (std::int32_t r = 0; r < i.augmented.size(); ++r)
        EXPECT_NEAR(m(r, c), expected(r), 1e-8) << "row " << r << " column " << c << (accelerations ? "" : " at rest");
    }
  }
}

TEST(AugmentedSystem, what_is_given_has_an_equation_that_says_so) {
  Instant i;
  const auto matrix = [&](const std::vector<bool>& active, const std::vector<bool>& cut, const std::vector<bool>& held,
                          std::span<const double> diagonal = {}, AugmentedColumns columns = {}) {
    return dense(i.augmented.matrix(i.eq, i.rows, active, columns, cut, held, diagonal));
  };
  const Eigen::MatrixXd plain = matrix(i.part.active, {}, {});
  const std::int32_t n = i.augmented.size();
  const auto unit_row = [&](std::int32_t r) { return Eigen::RowVectorXd::Unit(n, r); };

  Eigen::MatrixXd expected = plain;
  expected.row(i.augmented.algebraic(1)) = unit_row(i.augmented.algebraic(1));
  EXPECT_EQ(matrix(i.part.active, {false, true, false}, {}), expected);

  expected = plain;
  expected.row(i.augmented.state(0)) = unit_row(i.augmented.state(0));
  EXPECT_EQ(matrix(i.part.active, {}, {true}), expected);

  std::vector<bool> active = i.part.active;
  active[2] = false;
  expected = plain;
  expected.row(i.augmented.lambda(2)) = unit_row(i.augmented.lambda(2));
  Eigen::MatrixXd found = matrix(active, {}, {});
  // Its column keeps what forces see of the reaction, and loses the reaction itself.
  for (const auto& e : i.rows.row(2)) expected(e.column, i.augmented.lambda(2)) += e.c.g;
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-14);

  const std::vector<double> diagonal = {4, 0, -1};
  expected = plain;
  expected(0, 0) += 4, expected(2, 2) -= 1;
  EXPECT_EQ(matrix(i.part.active, {}, {}, diagonal), expected);

  // Without coordinates only constraints and the diagonal stand in their columns.
  found = matrix(i.part.active, {}, {}, diagonal, {PartialBy::acceleration, PartialBy::state_rate, false});
  EXPECT_EQ(found.topLeftCorner(6, 6), Eigen::MatrixXd(Eigen::Vector<double, 6>{4, 0, -1, 0, 0, 0}.asDiagonal()));
  EXPECT_EQ(found.middleRows(6, 3).leftCols(6), plain.middleRows(6, 3).leftCols(6));
  EXPECT_EQ(found.bottomRows(4).leftCols(6).cwiseAbs().maxCoeff(), 0);
}

TEST(AugmentedSystem, unknowns_that_nothing_determines_are_named) {
  const auto names = [](const std::string& text) {
    const auto system = system_of(text);
    const AugmentedSystem augmented(*system);
    ConstraintRows rows;
    rows.resize(system->layout());
    Equations eq;
    eq.resize(system->layout());
    const Motion m = system->motion(system->drawn());
    system->constraints(m, rows);
    system->equations(m, rows, eq,
                      {PartialBy::acceleration, PartialBy::lambda, PartialBy::algebraic, PartialBy::state_rate});
    const Partition part = system->partition(rows, RowLevel::velocity);
    return undetermined(*system, augmented, augmented.matrix(eq, rows, part.active, {}));
  };
  const std::string held = "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n";
  EXPECT_EQ(names(held + "VARIABLE/1, FUNCTION=VARVAL(1)\nVARIABLE/2, FUNCTION=5\n"),
            std::vector<std::string>{"the value of VARIABLE/1"});
  EXPECT_EQ(names("VARIABLE/7, FUNCTION=VARVAL(7)+1\n"), std::vector<std::string>{"the value of VARIABLE/7"});
  EXPECT_THAT(names(held + "POINT_MASS/2, MASS=0\nMARKER/20, POINT_MASS=2\n"), Contains("DX of POINT_MASS/2"));
}

}  // namespace
}  // namespace dynalin::analysis_test::augmented_system_test
