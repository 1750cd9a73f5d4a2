// What bodies of all kinds say of their mass is what their equations have: the masses of the user, at a point where
// nothing stands along the axes.
#include "modal/mass_root.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "system/flexible_test_support.h"
#include "system/model_test_support.h"

namespace dynalin::mass_root_test {
namespace {

using ::testing::ElementsAre;

// Units in which masses are not those of the equations.
constexpr auto units = "FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND";

const std::string dumb_bell =
    "MARKER/21, FLEX_BODY=2, NODE_ID=1\n" + system_test::dumb_bell_matrices +
    "FLEX_BODY/2, MATRICES=1,2,3,4,5,6,7,8,9,10,11,12,13, CRATIO=0.1, QG=10,0,0, REULER=0.3,0.4,0.5, VMODE=0.6\n";
const std::string part =
    "PART/3, MASS=1.5, CM=30, IP=2,3,4,0.1,0.2,0.3, QG=4,0,1, REULER=1,2,3\nMARKER/30, QP=0.5,-1,2\n";
const std::string point_mass =
    "POINT_MASS/4, MASS=2, CM=40, QG=0,3,0, REULER=1,0,0\nMARKER/40, POINT_MASS=4, QP=1,0,0\n";
const std::string steel = "MATERIAL/1, DENSITY=7E-3, YOUNGS_MODULUS=2E3, POISSONS_RATIO=0.3\n";
const std::string section = "MATERIAL=1, NODE_LABELS=3,5,9, X=0,1,2.5, AREA=0.2, IYY=0.01, IZZ=0.02, CRATIO=0.01\n";
const std::string beam = "FE_PART/5, TYPE=3DBEAM, QG=0,0,7, REULER=0.5,0.3,0, VX=2, WM=1, WZ=3, " + section;
const std::string plane_beam = "FE_PART/6, TYPE=2DBEAMXY, QG=0,-7,0, REULER=0.4,0,0, " + section;
const std::string all = dumb_bell + part + point_mass + steel + beam + plane_beam;

struct Weighed {
  explicit Weighed(const std::string& text)
      : system(System::make(system_test::model_of(text, units)).value()), point(system->drawn()) {
    const Layout& layout = system->layout();
    for (std::size_t k = 0; k < point.extra.size(); ++k) point.extra[k] += 0.01 * static_cast<double>(k % 3);
    ConstraintRows rows;
    rows.resize(layout);
    Equations eq;
    eq.resize(layout);
    const Motion motion = at();
    system->constraints(motion, rows);
    system->equations(motion, rows, eq, {PartialBy::acceleration, PartialBy::position, PartialBy::damping});
    const double ucf = system->model().units.ucf;
    M = ucf * dense(eq.matrix(PartialBy::acceleration));
    K = dense(eq.matrix(PartialBy::position));
    C = dense(eq.matrix(PartialBy::damping));
  }
  Motion at() const { return system->motion(point); }
  Eigen::MatrixXd dense(const ColumnMatrix& m) const {
    const auto n = static_cast<Eigen::Index>(system->coordinates());
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
    for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) {
      if (r < n) out(r, c) += v;
    });
    return out;
  }
  Eigen::VectorXcd any_motion() const {
    const auto n = static_cast<Eigen::Index>(system->coordinates());
    Eigen::VectorXcd v(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto x = static_cast<double>(k);
      v(k) = {std::sin(1 + x * x), std::cos(2 + 3 * x)};
    }
    return v;
  }

  std::shared_ptr<const System> system;
  OperatingPoint point;
  Eigen::MatrixXd M, K, C;  // of the equations
};

double quadratic(const Eigen::MatrixXd& m, const Eigen::VectorXcd& v) { return v.dot(m * v).real(); }

void expect_near(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-12 * (1 + expected.cwiseAbs().maxCoeff()));
}

TEST(MassRoot, is_that_of_the_mass_in_the_equations) {
  for (const std::string& text : {part, point_mass, dumb_bell, steel + beam, steel + plane_beam, all}) {
    SCOPED_TRACE(text);
    const Weighed w(text);
    const MassRoot root(*w.system, w.point);
    const Eigen::MatrixXd columns = root.of(Eigen::MatrixXd::Identity(w.M.rows(), w.M.rows()));
    expect_near(columns.transpose() * columns, w.M);
    EXPECT_GT(w.M.cwiseAbs().maxCoeff(), 0);
  }
}

TEST(MassRoot, has_the_rows_of_each_body_in_the_order_of_the_layout) {
  const Weighed w(all + "PART/9\nMARKER/90, PART=9\n");  // no row of what has no mass
  const MassRoot root(*w.system, w.point);
  std::vector<std::string> bodies;
  Eigen::Index next = 0;
  const Eigen::MatrixXd columns = root.of(Eigen::MatrixXd::Identity(w.M.rows(), w.M.rows()));
  for (std::size_t k = 0; k < root.bodies(); ++k) {
    bodies.push_back(w.system->layout().bodies[root.body(k)].label.text());
    EXPECT_EQ(root.first_row(k), next);
    next += root.rows(k);
  }
  EXPECT_EQ(next, columns.rows());
  EXPECT_THAT(bodies, ElementsAre("FLEX_BODY/2", "PART/3", "POINT_MASS/4", "FE_PART/5", "FE_PART/6"));
}

TEST(MassRoot, weighs_a_model_that_moves_as_a_whole) {
  const Weighed w(all);
  const MassRoot root(*w.system, w.point);
  const Matrix3 axes = rotation_313(0.3, 0.7, -1.1);
  const Vector origin{1, 2, -3}, away{4, -1, 2};
  const Eigen::MatrixXd here = root.of_rigid_motion(origin, axes), there = root.of_rigid_motion(origin + away, axes);
  double mass = 0;
  for (const BodySource* body : w.system->bodies()) mass += body->mass();
  EXPECT_GT(mass, 6.5);
  for (Eigen::Index d = 0; d < 3; ++d) EXPECT_NEAR(here.col(d).squaredNorm(), mass, 1e-12 * mass);
  // A turn about another point moves all of it by the same besides.
  for (std::size_t d = 0; d < 3; ++d) {
    const auto turned = static_cast<Eigen::Index>(3 + d);
    const Vector shift = transpose(axes) * cross(away, axes[d]);
    expect_near(there.col(turned), here.col(turned) + here.leftCols(3) * Eigen::Vector3d(shift.x, shift.y, shift.z));
  }
}

TEST(BodySource, has_the_energy_and_the_work_of_its_equations) {
  for (const std::string& text : {part, point_mass, dumb_bell, steel + beam, steel + plane_beam, all}) {
    SCOPED_TRACE(text);
    const Weighed w(text);
    const Eigen::VectorXcd v = w.any_motion();
    double energy = 0, stiff = 0, damped = 0;
    for (const BodySource* body : w.system->bodies()) {
      energy += body->kinetic_energy(w.at(), v).total();
      stiff += body->own_work(w.at(), PartialBy::position, v).value_or(0);
      damped += body->own_work(w.at(), PartialBy::damping, v).value_or(0);
    }
    EXPECT_NEAR(energy, 0.5 * quadratic(w.M, v), 1e-12 * energy);
    EXPECT_NEAR(stiff, quadratic(w.K, v), 1e-11 * (1 + std::abs(stiff)));
    EXPECT_NEAR(damped, quadratic(w.C, v), 1e-11 * (1 + std::abs(damped)));
    EXPECT_EQ(stiff == 0, text == part || text == point_mass);
  }
}

// Forms of no less and no more motions than those that have momentum.
TEST(BodySource, knows_which_of_its_motions_have_momentum) {
  const std::string rod = "PART/3, MASS=2, CM=30, IP=0,3,3, REULER=1,2,3\nMARKER/30, QP=1,0,1\n";
  const std::string point = "PART/3, MASS=2, CM=30\nMARKER/30, QP=1,0,1\n", nothing = "PART/3\nMARKER/30\n";
  struct Case {
    std::string text;
    Eigen::Index rank;
  };
  for (const auto& [text, rank] : {Case{part, 6},
                                   {rod, 5},
                                   {point, 3},
                                   {nothing, 0},
                                   {point_mass, 3},
                                   {dumb_bell, 7},
                                   {steel + beam, 33},
                                   {steel + plane_beam, 27}}) {
    SCOPED_TRACE(text);
    const Weighed w(text);
    const BodySource& body = *w.system->bodies().front();
    std::vector<SparseRow> rows;
    body.add_momentum_rows(w.at(), rows);
    Eigen::MatrixXd forms = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), w.M.cols());
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t e = 0; e < rows[r].column.size(); ++e)
        forms(static_cast<Eigen::Index>(r), rows[r].column[e]) = rows[r].value[e];
    }
    ASSERT_EQ(forms.rows(), rank);
    EXPECT_EQ(body.lacks_inertia(), rank < 6 && text != point_mass);
    if (rank == 0) continue;
    Eigen::FullPivLU<Eigen::MatrixXd> lu(forms);
    EXPECT_EQ(lu.rank(), rank);
    if (rank < w.M.cols()) expect_near(w.M * lu.kernel(), Eigen::MatrixXd::Zero(w.M.rows(), w.M.cols() - rank));
  }
}

TEST(BodySource, starts_with_the_velocities_that_are_stated) {
  const Weighed w(all);
  const Layout& layout = w.system->layout();
  std::vector<double> start(w.system->coordinates(), 0.0);
  for (const BodySource* body : w.system->bodies())
    body->start_velocity(
        w.at(), [](std::string_view) { return true; }, start);
  const auto at = [&](std::int32_t k) {
    const auto i = static_cast<std::size_t>(k);
    return Vector{start[i], start[i + 1], start[i + 2]};
  };
  EXPECT_EQ(start[static_cast<std::size_t>(layout.body_coordinate_count)], 0.6);  // the mode
  for (const BodySource* body : w.system->bodies()) {
    const BodyBlock& first = layout.body(body->bodies().front());
    if (first.label.text() != "FE_PART/5") continue;
    const Vector r = w.point.poses[static_cast<std::size_t>(body->bodies().front().index)].r;
    ASSERT_EQ(body->bodies().size(), 3u);
    for (const BodyId node : body->bodies()) {
      const Vector v = at(layout.body(node).offset), turn = at(layout.body(node).offset + 3);
      const Vector arm = w.point.poses[static_cast<std::size_t>(node.index)].r - r;
      EXPECT_LT(norm(turn - Vector{0, 0, 3}), 1e-15);
      EXPECT_LT(norm(v - Vector{2, 0, 0} - cross(turn, arm)), 1e-14);
    }
  }
}

// Bent, stretched and twisted between all nodes, and moving in some other way before: nothing is strained.
TEST(BodySource, of_a_deformed_beam_starts_as_if_rigid) {
  Weighed w(steel + beam);
  for (std::size_t b = 1; b < w.point.poses.size(); ++b) {
    const auto k = static_cast<double>(b);
    w.point.poses[b].r += Vector{0.1 * k, -0.05 * k * k, 0.2 * k};
    w.point.poses[b].R = rotation_exponential({0.2 * k, 0.3, -0.1 * k * k}) * w.point.poses[b].R;
  }
  const BodySource& body = *w.system->bodies().front();
  const Motion motion = w.at();
  const auto work = [&](const Eigen::VectorXd& v) { return body.own_work(motion, PartialBy::damping, v).value(); };
  const Eigen::VectorXd before = w.any_motion().real();
  Eigen::VectorXd start = before;
  body.start_velocity(motion, [](std::string_view argument) { return argument == "VY"; },
                      {start.data(), static_cast<std::size_t>(start.size())});
  EXPECT_GT(start.norm(), 1);
  EXPECT_GT(work(before), 1);
  EXPECT_LT(work(start), 1e-13 * work(before));
}

}  // namespace
}  // namespace dynalin::mass_root_test
