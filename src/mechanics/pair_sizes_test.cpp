// What partials are made of is never less than they are, and not less than what cancels in them.
#include "mechanics/pair_sizes.h"

#include <gtest/gtest.h>

#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::pair_sizes_test {
namespace {

constexpr MarkerId I{2}, J{5};

TEST(PairSizes, are_no_less_than_the_partials) {
  Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  RelativeWrench w;
  w.force = p.vector(), w.torque = p.vector(), w.depends_on_rate = true;
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) w.on_pose[r][c] = p.vector().x, w.on_rate[r][c] = p.vector().y;
  }
  // Partials by position have those by rates in them where the model moves.
  const PairForce by_rates = spread(pair, w, Partials::yes);
  w.depends_on_rate = false;
  const PairForce by_positions = spread(pair, w, Partials::yes);
  int blocks = 0;
  for_each_block(pair, p.layout, [&](const PairBlock& b) {
    const BlockPartials rates = partials_by(b, by_rates), positions = partials_by(b, by_positions);
    const BlockPartials of_rates = sizes_by(pair, b, by_rates), of_positions = sizes_by(pair, b, by_positions);
    const auto expect_covered = [&](const Matrix3& partials, const Matrix3& by) {
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < b.count; ++c) EXPECT_GE(by(r, c), std::abs(partials(r, c)) * (1 - 1e-12));
      }
    };
    expect_covered(rates.force_by_rate, of_rates.force_by_rate);
    expect_covered(rates.torque_by_rate, of_rates.torque_by_rate);
    expect_covered(positions.force, of_positions.force);
    expect_covered(positions.torque, of_positions.torque);
    ++blocks;
  });
  EXPECT_EQ(blocks, 4 + 3);  // with modes of the bodies
}

// A product with axes along those of the ground rounds nothing: what is soft along one of them stays exact beside what
// is stiff along another. Aslant each entry has something of the stiffest in it.
TEST(PairSizes, keep_directions_apart_along_the_ground) {
  const Paths p;
  PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  PairForce force;
  force.force_on_position.origin_I = Matrix3::diagonal(1e6) + Matrix3{{0, 0, 0}, {0, 1 - 1e6, 0}, {0, 0, -1e6}};
  PairBlock move;
  move.kind = PairBlock::Kind::translation, move.moves = Matrix3::identity();
  const Matrix3 aslant = sizes_by(pair, move, force).force;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) pair.axes_J(r, c) = Taylor(r == (c + 1) % 3 ? -1.0 : 0.0);
  }
  const Matrix3 along = sizes_by(pair, move, force).force;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(along(r, c), std::abs(force.force_on_position.origin_I(r, c)));
      EXPECT_EQ(aslant(r, c), 1e6);
    }
  }
}

// A spring from J to I written in the axes of J: turning these changes nothing, and all but rounding cancels.
TEST(PairSizes, tell_what_has_cancelled) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  constexpr double stiffness = 1e6;
  RelativeWrench w;
  w.force = -stiffness * value(pair.relative.p);
  for (std::size_t k = 0; k < 3; ++k) w.on_pose[k][k] = -stiffness;
  const PairForce force = spread(pair, w, Partials::yes);
  const double cancelled = stiffness * norm(value(pair.delta));
  ASSERT_LE(largest(force.force_on_position.axes_J), 1e-14 * cancelled);
  // Even without an arm of the marker on its body.
  PairBlock turn;
  turn.kind = PairBlock::Kind::rotation, turn.of_J = true;
  PairForce with_rest = force;
  with_rest.force_on_position.axes_J.x.x = 1e-12;
  EXPECT_GE(largest(sizes_by(pair, turn, with_rest).force), 0.5 * cancelled);
  // Where a law knows nothing of the axes there is nothing to cancel.
  with_rest.force_on_position.axes_J = {};
  EXPECT_EQ(largest(sizes_by(pair, turn, with_rest).force), 0);
}

// A force through the origin of I whose torque there is only rounding of force times arm.
TEST(PairSizes, tell_what_a_law_has_cancelled_in_its_torque) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  RelativeWrench w;
  w.force = {3, 4, 0}, w.torque = {1e-15, 0, 2e-16}, w.levers = {5, 2};
  w.on_pose[0][0] = 1e6, w.on_pose[3][0] = 1e-10;
  const PairForce force = spread(pair, w, Partials::yes);
  PairBlock move;
  move.kind = PairBlock::Kind::translation, move.moves = Matrix3::identity();
  // ρ × δF + δρ × F
  EXPECT_GE(largest(sizes_by(pair, move, force).torque), 2e6 * 0.3 + 5);
  PairForce plain = force;
  plain.levers = {};
  EXPECT_LT(largest(sizes_by(pair, move, plain).torque), 1e-9);
}

}  // namespace
}  // namespace dynalin::mechanics_test::pair_sizes_test
