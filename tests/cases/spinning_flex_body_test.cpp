// Flexible bodies that spin: what the inertia invariants make of Coriolis and centrifugal forces, in closed form, and a
// beam of pieces that take up its tension.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cases/beam_model.h"
#include "cases/beams.h"
#include "cases/flexible.h"

namespace dynalin::cases::spinning_flex_body_test {
namespace {

// --- which invariants make which forces ---------------------------------------------------------
struct Subset {
  const char* stated;
  double coriolis, centrifugal;  // 1 or 0
};
void PrintTo(const Subset& s, std::ostream* out) {
  *out << "coriolis " << s.coriolis << " centrifugal " << s.centrifugal;
}
class SpinningInvariants : public Beams, public ::testing::WithParamInterface<Subset> {};

// A mass on three springs beside the axis. In the turning axes its motion x, y from its mean place is
//
//     x″ − 2 c W y′ + (k_x/m − f W²) x = 0,   y″ + 2 c W x′ + (k_y/m − f W²) y = 0
//
// where INVAR5 makes c = 1 and INVAR9 f = 1. The radius at which it rests is pushed outwards by INVAR8 alone.
TEST_P(SpinningInvariants, make_coriolis_and_centrifugal_forces) {
  const auto& [stated, c, f] = GetParam();
  const double m = 2, r = 0.7, W = 11;
  const Vector k{4000, 900, 2500};
  const std::vector<Vector> none(3), along = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  write("mass.fem",
        modal_text({{1, {}, 1, {1e-3, 1e-3, 1e-3}, none, none}, {2, {r, 0, 0}, m, {1e-3, 1e-3, 1e-3}, along, none}},
                   Eigen::Vector3d(k.x, k.y, k.z).asDiagonal()));
  const double outwards = m * W * W * r / (k.x - f * m * W * W);
  const auto found = frequencies(
      fmt::format("FLEX_BODY/2, MNF_FILE=mass.fem, CRATIO=0, WZ={0}, DMODE={1:.17g},0,0{2}\nMARKER/21, NODE_ID=1\n"
                  "JOINT/1, REVOLUTE, I=21, J=1\nMOTION/1, JOINT=1, ROTATION, FUNCTION={0}*TIME\n",
                  W, outwards, stated));
  // ω⁴ − (a + b + 4 c W²) ω² + a b = 0.
  const double a = k.x / m - f * W * W, b = k.y / m - f * W * W, sum = a + b + 4 * c * W * W;
  const double apart = std::sqrt(sum * sum - 4 * a * b);
  std::vector<double> expected = {std::sqrt((sum - apart) / 2), std::sqrt((sum + apart) / 2), std::sqrt(k.z / m)};
  std::ranges::sort(expected);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(found[n], expected[n], 1e-9 * expected[n]) << n;
}
INSTANTIATE_TEST_SUITE_P(subsets, SpinningInvariants,
                         ::testing::Values(Subset{"", 1, 1}, Subset{", INVARIANTS=T:T:T:T:F:T:T:T:T", 0, 1},
                                           Subset{", INVARIANTS=T:T:T:T:T:T:T:T:F", 1, 0},
                                           Subset{", INVARIANTS=T:T:T:T:F:T:T:T:F", 0, 0}));

// --- a beam of pieces ---------------------------------------------------------------------------
// Cantilevers of unit length, mass and bending stiffness that turn about their root, with the frequencies along the
// turning axes.
class SpinningPieces : public Beams {
 protected:
  static LumpedBeam piece(std::size_t nodes, double length) { return {nodes, length, 1e4, 1e4, 1, 1, 1, 1e-7}; }
  // Of the modes those that bend, without what rounding leaves along and about the beam.
  static ReducedBody bending(const LumpedBeam& beam, const Eigen::MatrixXd& modes) {
    std::vector<Eigen::Index> bends;
    for (Eigen::Index k = 0; k < modes.cols(); ++k) {
      double along = 0;
      for (Eigen::Index row = 0; row < modes.rows(); row += 3) along = std::max(along, std::abs(modes(row, k)));
      if (along < 1e-6 * modes.col(k).cwiseAbs().maxCoeff()) bends.push_back(k);
    }
    Eigen::MatrixXd shapes = modes(Eigen::all, bends);
    for (Eigen::Index row = 0; row < shapes.rows(); row += 3) shapes.row(row).setZero();
    return reduced(beam, shapes);
  }
  static std::string hub(double speed) {
    return fmt::format(
        "PART/99, MASS=1, CM=99, IP=1,1,1, WZ={0}\nMARKER/99\nJOINT/99, REVOLUTE, I=99, J=1\n"
        "MOTION/1, JOINT=99, ROTATION, FUNCTION={0}*TIME\n",
        speed);
  }
  std::vector<double> seen_turning(const std::string& elements) const {
    return frequencies(elements, "LINEAR/EIGENSOL, NOVECTOR, RM=99");
  }
  // Of n bodies with all their free modes of bending, each fixed to the end of the one before.
  std::vector<double> of_pieces(int n, double speed) const {
    constexpr std::size_t nodes = 3;
    const double length = 1.0 / n;
    const Vibration free = vibration(piece(nodes, length), 0);
    const ReducedBody body = bending(piece(nodes, length), free.shapes.rightCols(free.shapes.cols() - 6));
    write("piece.fem", modal_text(body.nodes, body.stiffness));
    std::string s = hub(speed);
    for (int k = 0; k < n; ++k) {
      s += fmt::format(
          "FLEX_BODY/{0}, MNF_FILE=piece.fem, CRATIO=0, QG={1:.17g},0,0, WZ={2}, VY={3:.17g}\n"
          "MARKER/{0}1, NODE_ID=1\nMARKER/{0}2, NODE_ID={4}\nJOINT/{0}, FIXED, I={0}1, J={5}\n",
          k + 1, length * k, speed, speed * length * k, nodes, k == 0 ? 99 : 10 * k + 2);
    }
    return seen_turning(s);
  }
};

// Linear modes know no geometric stiffening: what one body lacks the joints between several take up. The published
// frequencies, by those of the mass and stiffness, are approached by the square of the length of a piece.
TEST_F(SpinningPieces, approach_the_published_frequencies_of_a_rotating_beam) {
  const double speed = 6;
  const std::array lists = {of_pieces(4, speed), of_pieces(8, speed), of_pieces(16, speed)};
  for (const double exact : {7.36037302, 26.80908169}) {
    std::vector<double> series;
    for (const auto& list : lists) {
      series.push_back(nearest(list, exact));
      // In the plane of the spin the centrifugal force turns with what it acts on.
      const double flap = series.back(), lag = std::sqrt(flap * flap - speed * speed);
      EXPECT_TRUE(contains(list, lag, 1e-6)) << lag;
    }
    const double far = series[0] - exact, nearer = series[1] - exact, near = series[2] - exact;
    EXPECT_NEAR(far / nearer, 4, 0.4) << exact;
    EXPECT_NEAR(nearer / near, 4, 0.15) << exact;
    EXPECT_LT(std::abs(near), 4e-3 * exact) << exact;
    EXPECT_NEAR(extrapolated(series), exact, 2e-5 * exact);
  }
}

// One body with the modes of a clamped beam softens in the plane of the spin, and across it knows nothing of it.
TEST_F(SpinningPieces, of_one_clamped_piece_soften) {
  const double speed = 3;
  const LumpedBeam beam = piece(9, 1);
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = bending(beam, held.shapes.leftCols(4));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const auto found =
      seen_turning(hub(speed) + fmt::format("FLEX_BODY/1, MNF_FILE=beam.fem, CRATIO=0, WZ={}\nMARKER/11, NODE_ID=1\n"
                                            "JOINT/1, FIXED, I=11, J=99\n",
                                            speed));
  ASSERT_EQ(found.size(), 4u);
  for (const Eigen::Index k : {0, 2}) {
    const double rest = std::sqrt(held.squares(k));
    EXPECT_TRUE(contains(found, rest, 1e-6)) << rest;
    EXPECT_TRUE(contains(found, std::sqrt(rest * rest - speed * speed), 1e-6)) << rest;
  }
}

}  // namespace
}  // namespace dynalin::cases::spinning_flex_body_test
