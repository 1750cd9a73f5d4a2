#include "reduction/craig_bampton.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <numbers>

#include "reduction/test_models.h"

namespace dynalin::reduction::craig_bampton_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Reduction reduced(const FiniteElementModel& model, const ReductionRequest& request) {
  Diagnostics diagnostics;
  auto reduction = reduce_model(model, request, diagnostics);
  EXPECT_TRUE(reduction.has_value()) << (reduction ? "" : reduction.error()) << render(diagnostics);
  return reduction ? std::move(*reduction) : Reduction{};
}

std::string refused(const FiniteElementModel& model, const ReductionRequest& request) {
  Diagnostics diagnostics;
  const auto reduction = reduce_model(model, request, diagnostics);
  EXPECT_FALSE(reduction.has_value());
  return render(diagnostics);
}

// ω² of the bending of a uniform beam with frequency number β L.
double euler(double beta_l, double length, double EI, double mass) {
  const double b = beta_l / length;
  return b * b * b * b * EI / mass;
}

const test::Section section;

TEST(CraigBampton, fixed_interface_modes_of_a_beam_held_at_one_end_are_those_of_a_cantilever) {
  const FiniteElementModel beam = test::beam(20, 0.8);
  const Reduction r = reduced(beam, {.interface = {1}, .modes = 6});
  ASSERT_EQ(r.fixed_interface.size(), 6);
  const std::array expected = {
      euler(1.87510407, 0.8, section.EIy, section.mass), euler(1.87510407, 0.8, section.EIz, section.mass),
      euler(4.69409113, 0.8, section.EIy, section.mass), euler(4.69409113, 0.8, section.EIz, section.mass),
      euler(7.85475744, 0.8, section.EIy, section.mass), euler(7.85475744, 0.8, section.EIz, section.mass)};
  // Elements of length l miss ω² by (βl)⁴/720.
  for (Index k = 0; k < 6; ++k) EXPECT_NEAR(r.fixed_interface[k] / expected[static_cast<std::size_t>(k)], 1, 5e-5) << k;
}

TEST(CraigBampton, of_a_free_body_six_motions_are_removed_and_the_free_modes_are_left) {
  const FiniteElementModel beam = test::beam(20, 0.8);
  const Reduction r = reduced(beam, {.interface = {1, 21}, .modes = 16});
  EXPECT_EQ(r.rigid_removed, 6);
  EXPECT_EQ(r.constraint_modes, 12);
  EXPECT_EQ(r.squares.size(), 12 + 16 - 6);
  // What elements and truncation add: these are squares.
  EXPECT_NEAR(r.squares[0] / euler(4.73004074, 0.8, section.EIy, section.mass), 1, 2e-4);
  EXPECT_NEAR(r.squares[1] / euler(4.73004074, 0.8, section.EIz, section.mass), 1, 2e-4);
  EXPECT_NEAR(r.squares[2] / euler(7.85320462, 0.8, section.EIy, section.mass), 1, 1e-3);
  const VectorXd all = test::all_squares(beam);
  // A reduction is stiffer than the model, the more so the higher the mode.
  for (Index k = 0; k < 8; ++k) {
    EXPECT_GE(r.squares[k], all[6 + k] * (1 - 1e-9)) << k;
    EXPECT_NEAR(r.squares[k] / all[6 + k], 1, 1e-2) << k;
  }
}

TEST(CraigBampton, with_all_modes_nothing_is_lost) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  const Reduction r = reduced(beam, {.interface = {1, 5}, .modes = 1000});
  const VectorXd all = test::all_squares(beam);
  ASSERT_EQ(r.squares.size(), all.size() - 6);
  for (Index k = 0; k < r.squares.size(); ++k) EXPECT_NEAR(r.squares[k] / all[6 + k], 1, 1e-9) << k;
}

// Lumped masses without rotary inertia: rotations of the interface yield all the same.
TEST(CraigBampton, interface_freedoms_without_mass_keep_their_compliance) {
  for (const bool also_translations : {false, true}) {
    FiniteElementModel beam = test::beam(4, 0.8);
    std::vector<Eigen::Triplet<double, std::int32_t>> lumps;
    std::vector<Index> heavy, light;
    for (std::size_t k = 0; k < beam.freedoms.size(); ++k) {
      const Freedom& f = beam.freedoms[k];
      const auto row = static_cast<Index>(k);
      const bool has_mass = f.direction <= 3 && !(also_translations && f.node == 5);
      (has_mass ? heavy : light).push_back(row);
      if (has_mass) lumps.emplace_back(static_cast<std::int32_t>(row), static_cast<std::int32_t>(row), 0.3);
    }
    beam.mass.setZero();
    beam.mass.setFromTriplets(lumps.begin(), lumps.end());
    Diagnostics diagnostics;
    const auto r = reduce_model(beam, {.interface = {1, 5}, .modes = 1000}, diagnostics);
    ASSERT_TRUE(r) << r.error() << render(diagnostics);
    EXPECT_TRUE(diagnostics.items().empty()) << render(diagnostics);
    // Without what has no mass.
    const MatrixXd K(beam.stiffness);
    const MatrixXd condensed =
        K(heavy, heavy) - K(heavy, light) * K(light, light).fullPivLu().solve(MatrixXd(K(light, heavy)));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> exact(MatrixXd(0.5 * (condensed + condensed.transpose()) / 0.3));
    // To turn about its axis the beam needs no force.
    const Index modes = static_cast<Index>(heavy.size()) - 5;
    ASSERT_EQ(r->squares.size() - r->massless, modes);
    ASSERT_EQ(r->massless, also_translations ? 8 : 5);
    for (Index k = 0; k < modes; ++k) EXPECT_NEAR(r->squares[k] / exact.eigenvalues()[5 + k], 1, 1e-9) << k;
    // Held at one end, the other yields as the stiffness says: what all shapes have there.
    std::vector<Index> free, held;
    for (std::size_t k = 0; k < beam.freedoms.size(); ++k)
      (beam.freedoms[k].node == 1 ? held : free).push_back(static_cast<Index>(k));
    const MatrixXd compliance = MatrixXd(K(free, free)).inverse();
    const MatrixXd S =
        r->shapes(free, Eigen::all) -
        rigid_motions(beam)(free, Eigen::all) *
            MatrixXd(rigid_motions(beam)(held, Eigen::all)).fullPivLu().solve(MatrixXd(r->shapes(held, Eigen::all)));
    const MatrixXd of_shapes = S * r->squares.cwiseInverse().asDiagonal() * S.transpose();
    for (Index k = 0; k < compliance.rows(); ++k) {
      if (beam.freedoms[static_cast<std::size_t>(free[static_cast<std::size_t>(k)])].node != 5) continue;
      EXPECT_NEAR(of_shapes(k, k) / compliance(k, k), 1, 1e-8) << k;
    }
    const MatrixXd m = r->shapes.transpose() * beam.mass * r->shapes;
    MatrixXd expected = MatrixXd::Zero(m.rows(), m.cols());
    expected.diagonal().head(modes).setOnes();
    EXPECT_LT((m - expected).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((rigid_motions(beam).transpose() * beam.mass * r->shapes).cwiseAbs().maxCoeff(), 1e-8);
  }
}

// Rotary inertia that is no more than rounding beside the mass of the body, and a node on soft springs that weighs as
// little: what yields there is no vibration, in any units.
TEST(CraigBampton, hardly_any_mass_counts_as_none) {
  const auto lumped = [](double rotary, bool hangs, double length_unit) {
    FiniteElementModel beam = test::beam(4, 0.8);
    if (hangs) {
      const auto n = static_cast<std::int32_t>(beam.freedoms.size());
      test::Triplets springs;
      for (Index c = 0; c < n; ++c) {
        for (SparseMatrix::InnerIterator it(beam.stiffness, c); it; ++it)
          springs.emplace_back(static_cast<std::int32_t>(it.row()), static_cast<std::int32_t>(c), it.value());
      }
      for (std::int32_t d = 0; d < 6; ++d) {
        const double k = d < 3 ? 300 : 20;
        const std::int32_t own = n + d, other = n - 6 + d;
        springs.emplace_back(own, own, k), springs.emplace_back(other, other, k);
        springs.emplace_back(own, other, -k), springs.emplace_back(other, own, -k);
        beam.freedoms.push_back({6, d + 1});
      }
      beam.nodes[6] = beam.nodes.at(5);
      beam.stiffness = test::matrix_of(n + 6, springs);
    }
    test::Triplets lumps, stiff;
    const auto unit = [&](Index row) {
      return beam.freedoms[static_cast<std::size_t>(row)].direction > 3 ? length_unit : 1.0;
    };
    for (std::size_t k = 0; k < beam.freedoms.size(); ++k) {
      const Freedom& f = beam.freedoms[k];
      const auto row = static_cast<std::int32_t>(k);
      const double m = f.node == 6 ? 0.3 * rotary : f.direction > 3 ? 0.3 * rotary : 0.3;
      if (m > 0) lumps.emplace_back(row, row, m * unit(row) * unit(row));
    }
    beam.mass = test::matrix_of(static_cast<Index>(beam.freedoms.size()), lumps);
    for (Index c = 0; c < beam.stiffness.cols(); ++c) {
      for (SparseMatrix::InnerIterator it(beam.stiffness, c); it; ++it) it.valueRef() *= unit(it.row()) * unit(c);
    }
    for (auto& [label, place] : beam.nodes) place *= length_unit;
    return beam;
  };
  for (const bool hangs : {false, true}) {
    const ReductionRequest request{.interface = {1, hangs ? 6 : 5}, .modes = 1000};
    const Reduction none = reduced(lumped(0, hangs, 1), request);
    for (const double unit : {1.0, 1000.0}) {
      for (const double rotary : {1e-15, 1e-13, 1e-12}) {
        SCOPED_TRACE(rotary);
        const Reduction r = reduced(lumped(rotary, hangs, unit), request);
        ASSERT_EQ(r.massless, none.massless);
        ASSERT_EQ(r.squares.size(), none.squares.size());
        ASSERT_EQ(r.fixed_interface.size(), none.fixed_interface.size());
        for (Index k = 0; k < r.squares.size(); ++k) EXPECT_NEAR(r.squares[k] / none.squares[k], 1, 1e-9) << k;
        EXPECT_LT(r.off_diagonal, 1e-12);
      }
    }
    // One that counts does.
    EXPECT_LT(reduced(lumped(1e-9, hangs, 1), request).massless, none.massless);
  }
}

TEST(CraigBampton, shapes_are_orthogonal_and_contain_no_rigid_motion) {
  const FiniteElementModel block = test::bricks({});
  const Reduction r = reduced(block, {.interface = {1, 9, 27, 81}, .modes = 10, .rotations_required = false});
  const MatrixXd m = r.shapes.transpose() * block.mass * r.shapes,
                 k = r.shapes.transpose() * block.stiffness * r.shapes;
  const VectorXd w = r.squares.cwiseSqrt();
  EXPECT_LT((m - MatrixXd::Identity(m.rows(), m.cols())).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((w.cwiseInverse().asDiagonal() * k * w.cwiseInverse().asDiagonal() - MatrixXd::Identity(m.rows(), m.cols()))
                .cwiseAbs()
                .maxCoeff(),
            1e-8);
  const MatrixXd rigid = rigid_motions(block);
  EXPECT_LT((rigid.transpose() * block.mass * r.shapes).cwiseAbs().maxCoeff(), 1e-10 * r.properties.mass);
}

// Compliance of the interface is that of the model: constraint modes are exact in statics.
TEST(CraigBampton, loads_on_the_interface_deform_it_as_they_deform_the_model) {
  const FiniteElementModel beam = test::beam(10, 0.8);
  const Reduction r = reduced(beam, {.interface = {1, 11}, .modes = 2});
  // A pair of opposite forces and what balances their moment strains the free body only.
  VectorXd load = VectorXd::Zero(66);
  load[1] = 100, load[61] = -100, load[65] = 80;
  const MatrixXd rigid = rigid_motions(beam);
  ASSERT_LT((rigid.transpose() * load).cwiseAbs().maxCoeff(), 1e-10);
  const VectorXd q = (r.shapes.transpose() * load).cwiseQuotient(r.squares);
  const double work = load.dot(r.shapes * q);
  // A cantilever of length L with this force at its end.
  const double expected = 100 * 100 * 0.8 * 0.8 * 0.8 / (3 * section.EIz);
  EXPECT_NEAR(work / expected, 1, 1e-9);
}

TEST(CraigBampton, a_body_turned_and_moved_has_the_same_frequencies) {
  test::Block block;
  const ReductionRequest request{.interface = {1, 9, 27, 81}, .modes = 12, .rotations_required = false};
  const Reduction as_is = reduced(test::bricks(block), request);
  block.axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  block.corner = {12, -5, 3};
  const Reduction moved = reduced(test::bricks(block), request);
  EXPECT_EQ(moved.rigid_removed, 6);
  ASSERT_EQ(moved.squares.size(), as_is.squares.size());
  for (Index k = 0; k < as_is.squares.size(); ++k) EXPECT_NEAR(moved.squares[k] / as_is.squares[k], 1, 1e-8) << k;
  EXPECT_NEAR(moved.properties.mass, 7800 * 0.4 * 0.02 * 0.03, 1e-10);
  EXPECT_TRUE(moved.properties.centre.isApprox(block.corner + block.axes * Eigen::Vector3d(0.2, 0.01, 0.015), 1e-12));
}

TEST(CraigBampton, mass_and_inertia_of_a_block_are_those_of_its_volume) {
  const Reduction r = reduced(test::bricks({}), {.interface = {1, 9, 27}, .modes = 1, .rotations_required = false});
  const double mass = 7800 * 0.4 * 0.02 * 0.03;
  EXPECT_NEAR(r.properties.mass, mass, 1e-12);
  EXPECT_TRUE(r.properties.centre.isApprox(Eigen::Vector3d(0.2, 0.01, 0.015), 1e-12));
  // Linear shape functions carry squares of coordinates exactly in a consistent mass.
  EXPECT_NEAR(r.properties.inertia(0, 0), mass / 12 * (0.02 * 0.02 + 0.03 * 0.03), 1e-12);
  EXPECT_NEAR(r.properties.inertia(2, 2), mass / 12 * (0.4 * 0.4 + 0.02 * 0.02), 1e-12);
  EXPECT_NEAR(r.properties.inertia(0, 1), 0, 1e-14);
}

TEST(CraigBampton, other_units_give_the_same_body) {
  FiniteElementModel metres = test::beam(6, 0.8), millimetres = metres;
  // Millimetres, tonnes and newtons: a length is 1000 times as many, a mass 1/1000.
  for (auto& [label, place] : millimetres.nodes) place *= 1000;
  const auto unit = [&](Index row, double of_length) {
    return metres.freedoms[static_cast<std::size_t>(row)].direction > 3 ? of_length : 1.0;
  };
  for (Index c = 0; c < metres.stiffness.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(millimetres.stiffness, c); it; ++it)
      it.valueRef() *= 1e-3 * unit(it.row(), 1000) * unit(c, 1000);
    for (SparseMatrix::InnerIterator it(millimetres.mass, c); it; ++it)
      it.valueRef() *= 1e-3 * unit(it.row(), 1000) * unit(c, 1000);
  }
  const ReductionRequest request{.interface = {1, 7}, .modes = 8};
  const Reduction a = reduced(metres, request), b = reduced(millimetres, request);
  ASSERT_EQ(a.squares.size(), b.squares.size());
  for (Index k = 0; k < a.squares.size(); ++k) EXPECT_NEAR(b.squares[k] / a.squares[k], 1, 1e-9) << k;
}

TEST(CraigBampton, modes_up_to_a_frequency) {
  const FiniteElementModel beam = test::beam(20, 0.8);
  const double second = std::sqrt(euler(1.87510407, 0.8, section.EIz, section.mass)) / (2 * std::numbers::pi);
  EXPECT_EQ(reduced(beam, {.interface = {1}, .highest_frequency = 1.01 * second}).fixed_interface.size(), 2);
  EXPECT_EQ(reduced(beam, {.interface = {1}, .highest_frequency = 0.99 * second}).fixed_interface.size(), 1);
  EXPECT_EQ(reduced(beam, {.interface = {1}, .modes = 0}).fixed_interface.size(), 0);
}

// A square section bends alike in two directions: either half of the pair alone would prefer a direction.
TEST(CraigBampton, modes_of_one_frequency_come_together) {
  test::Section square;
  square.EIz = square.EIy;
  const Reduction r = reduced(test::beam(20, 0.8, square), {.interface = {1}, .modes = 3});
  EXPECT_EQ(r.fixed_interface.size(), 4);
}

TEST(CraigBampton, a_rigid_face_gives_an_interface_with_rotations) {
  const test::Block block;
  std::vector<NodeLabel> face;
  for (int j = 0; j <= 2; ++j) {
    for (int k = 0; k <= 2; ++k) face.push_back(block.node(0, j, k));
  }
  const FiniteElementModel tied = test::with_rigid_face(test::bricks(block), face, 1000);
  const Reduction r = reduced(tied, {.interface = {1000}, .modes = 8});
  EXPECT_EQ(r.rigid_removed, 6);
  EXPECT_EQ(r.squares.size(), 8);
  EXPECT_NEAR(r.properties.inertia(2, 2), r.properties.mass / 12 * (0.4 * 0.4 + 0.02 * 0.02), 1e-12);
}

TEST(CraigBampton, a_body_held_to_ground_keeps_all_shapes) {
  FiniteElementModel beam = test::beam(6, 0.8);
  for (Index d = 0; d < 6; ++d) beam.stiffness.coeffRef(d, d) *= 1.5;
  const Reduction r = reduced(beam, {.interface = {7}, .modes = 4});
  EXPECT_EQ(r.rigid_removed, 0);
  EXPECT_EQ(r.squares.size(), 10);
}

TEST(CraigBampton, freedoms_without_mass_follow_statically) {
  FiniteElementModel beam = test::beam(6, 0.8);
  for (Index c = 0; c < beam.mass.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(beam.mass, c); it; ++it) {
      if (it.row() % 6 > 2 || c % 6 > 2) it.valueRef() = 0;
    }
  }
  const Reduction r = reduced(beam, {.interface = {1, 7}, .modes = 1000});
  EXPECT_TRUE(r.squares.allFinite());
  EXPECT_LT(r.off_diagonal, 1e-6);
  EXPECT_NEAR(r.squares[0] / euler(4.73004074, 0.8, section.EIy, section.mass), 1, 0.02);
}

// Lengths are compared with lengths: the same beam in other units of length has the same frequencies.
TEST(CraigBampton, units_of_length_change_nothing) {
  const ReductionRequest request{.interface = {1, 7}, .modes = 10};
  const Eigen::Matrix3d axes(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  const Reduction r = reduced(test::beam(6, 0.8, section, axes, {0.3, -0.2, 0.5}), request);
  for (const double length : {1e-9, 1e-7, 1e-3, 1e3, 1e9}) {
    FiniteElementModel model = test::beam(6, 0.8, section, axes, {0.3, -0.2, 0.5});
    // Of a force by its freedom: [mass·length/time²], a torque has another length.
    const auto unit = [&](Index row) {
      return model.freedoms[static_cast<std::size_t>(row)].direction > 3 ? length : 1.0;
    };
    for (SparseMatrix* m : {&model.stiffness, &model.mass}) {
      for (Index c = 0; c < m->outerSize(); ++c) {
        for (SparseMatrix::InnerIterator it(*m, c); it; ++it) it.valueRef() *= unit(it.row()) * unit(c);
      }
    }
    for (auto& [label, at] : model.nodes) at *= length;
    const Reduction other = reduced(model, request);
    ASSERT_EQ(other.squares.size(), r.squares.size()) << length;
    for (Index k = 0; k < r.squares.size(); ++k)
      EXPECT_NEAR(other.squares[k], r.squares[k], 1e-8 * r.squares[k] + 1e-10 * r.squares[0]) << length << " " << k;
  }
}

TEST(CraigBampton, refuses_what_does_not_hold_the_body) {
  const FiniteElementModel block = test::bricks({});
  EXPECT_THAT(refused(block, {.interface = {1, 9}, .rotations_required = false}),
              ::testing::HasSubstr("can move as a rigid body"));
  EXPECT_THAT(refused(block, {.interface = {1, 9, 5}, .rotations_required = false}),
              ::testing::HasSubstr("can move as a rigid body"));
  EXPECT_THAT(refused(block, {.interface = {1, 9, 27}}),
              ::testing::HasSubstr("interface node 1 has no rotation 4, 5, 6"));
  EXPECT_THAT(refused(block, {.interface = {82}}), ::testing::HasSubstr("nearest label with freedoms is 81"));
  EXPECT_THAT(refused(block, {.interface = {}}), ::testing::HasSubstr("no interface node"));
}

TEST(CraigBampton, refuses_matrices_that_are_not_positive) {
  const ReductionRequest request{.interface = {1, 7}, .modes = 4};
  FiniteElementModel beam = test::beam(6, 0.8);
  beam.mass.coeffRef(12, 12) = -1;
  EXPECT_THAT(refused(beam, request), ::testing::HasSubstr("the mass of node 3, direction 1 is negative"));
  beam = test::beam(6, 0.8);
  beam.stiffness.coeffRef(12, 13) = beam.stiffness.coeffRef(13, 12) = 1e12;
  EXPECT_THAT(
      refused(beam, request),
      ::testing::HasSubstr("the stiffness inside has 1 negative eigenvalue, most of all where node 3, direction"));
  beam = test::beam(6, 0.8);
  beam.mass.coeffRef(12, 13) = beam.mass.coeffRef(13, 12) = 1e3;
  EXPECT_FALSE(reduce_model(beam, request, *std::make_unique<Diagnostics>()).has_value());
  // A row that nothing strains.
  beam = test::beam(6, 0.8);
  for (Index k = 0; k < 42; ++k) beam.stiffness.coeffRef(15, k) = beam.stiffness.coeffRef(k, 15) = 0;
  EXPECT_THAT(refused(beam, request),
              ::testing::HasSubstr("with the interface held, 1 motion strains nothing: node 3, direction 4 has no "
                                   "stiffness at all"));
}

// Rows and columns of these freedoms without stiffness to any other but these.
void cut(SparseMatrix& k, Index first, Index last) {
  for (Index c = 0; c < k.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(k, c); it; ++it) {
      if ((c >= first && c < last) != (it.row() >= first && it.row() < last)) it.valueRef() = 0;
    }
  }
}

TEST(CraigBampton, names_what_is_loose) {
  const ReductionRequest request{.interface = {1, 7}, .modes = 4};
  // A motion inside that strains nothing, without a row of zeros: node 4 along y and twice as far node 5.
  FiniteElementModel beam = test::beam(6, 0.8);
  VectorXd motion = VectorXd::Zero(42);
  motion[19] = 1, motion[25] = 2;
  const VectorXd force = beam.stiffness * motion;
  beam.stiffness =
      SparseMatrix((MatrixXd(beam.stiffness) - force * force.transpose() / motion.dot(force)).sparseView(1, 1e-300));
  const std::string said = "with the interface held, 1 motion strains nothing, most of all where node ";
  EXPECT_THAT(refused(beam, request), ::testing::AnyOf(::testing::HasSubstr(said + "4, direction 2 moves"),
                                                       ::testing::HasSubstr(said + "5, direction 2 moves")));
  // An interface node of which a rotation is not tied to anything, and one of which nothing is.
  beam = test::beam(6, 0.8);
  cut(beam.stiffness, 39, 40);
  beam.stiffness.coeffRef(39, 39) = 0;
  EXPECT_THAT(refused(beam, request),
              ::testing::HasSubstr("the stiffness is not positive in the shapes of the reduction: node 7, direction 4 "
                                   "has no stiffness at all"));
  beam = test::beam(6, 0.8);
  Eigen::Matrix<double, 12, 12> of_element, unused;
  test::beam_element(section, 0.8 / 6, of_element, unused);
  for (Index r = 0; r < 12; ++r) {
    for (Index c = 0; c < 12; ++c) beam.stiffness.coeffRef(18 + r, 18 + c) -= of_element(r, c);
  }
  EXPECT_THAT(refused(beam, request),
              ::testing::HasSubstr("the stiffness falls into 2 parts: node 5 is not connected to node 1"));
  // A pendant that is inside.
  beam = test::beam(6, 0.8);
  cut(beam.stiffness, 36, 42);
  for (Index k = 36; k < 42; ++k) {
    for (Index c = 36; c < 42; ++c) beam.stiffness.coeffRef(k, c) = k == c ? 0 : 1e3;
  }
  EXPECT_THAT(refused(beam, {.interface = {1}, .modes = 4}),
              ::testing::HasSubstr("the stiffness falls into 2 parts: node 7 is not connected to node 1"));
  // Mass that is less than none for a motion, though its diagonal is positive.
  beam = test::beam(6, 0.8);
  beam.mass.coeffRef(37, 38) = beam.mass.coeffRef(38, 37) = 1e3;
  EXPECT_THAT(refused(beam, request), ::testing::HasSubstr("the mass is not positive in the shapes of the reduction, "
                                                           "most of all where node"));
}

}  // namespace
}  // namespace dynalin::reduction::craig_bampton_test
