// An antenna on an elastic mast with an elastic boom, its drives and controllers (tests/foreign). Elastic bodies are
// the mass points of their nodes here, which move as their modes say: no invariant of inertia has a part in the answer.
#include <gmock/gmock.h>

#include "cases/foreign.h"
#include "cases/newton_euler.h"

namespace dynalin::cases::newton_euler::foreign_antenna_test {
namespace {

using Frame = NewtonEuler::Point;

struct Node {
  Real mass;
  Vec3 at;
  Eigen::Matrix<Real, 3, Eigen::Dynamic> moves, turns;  // by a unit of each mode
};
// Rows of `shapes`: three of translation, three of rotation, for each mode.
Node node(Real mass, const Vec3& at, const std::vector<Real>& shapes) {
  const auto modes = static_cast<Eigen::Index>(shapes.size() / 6);
  const Eigen::Map<const MatX> all(shapes.data(), 6, modes);
  return {mass, at, all.topRows<3>(), all.bottomRows<3>()};
}
const std::vector<Node>& mast() {
  static const std::vector<Node> nodes = {
      node(30, Vec3(0, 120, 1500),
           std::vector<Real>{0.3L, 0, 0.01L, 0, 3e-4L, 0, 0.02L, 0.28L, -0.04L, -3e-4L, 0, 0, -0.06L, 0, 0, 0, 0,
                             5e-4L}),
      node(25, Vec3(150, -60, 1500),
           std::vector<Real>{0.32L, 0.01L, -0.05L, 0, 3e-4L, 0, 0, 0.3L, 0.02L, -3e-4L, 0, 1e-5L, 0.03L, 0.075L, 0, 0,
                             0, 5e-4L}),
      node(18, Vec3(0, 0, 3000),
           std::vector<Real>{1, 0, 0, 0, 5e-4L, 0, 0, 1, 0, -5e-4L, 0, 0, 0.02L, 0.01L, 0, 0, 0, 1e-3L})};
  return nodes;
}
const std::vector<Node>& boom() {
  static const std::vector<Node> nodes = {
      node(3, Vec3(0, 0, 0), std::vector<Real>(12, 0)),
      node(6, Vec3(800, 0, 60), std::vector<Real>{0.02L, 0.35L, 0, 0, 0, 7e-4L, -0.03L, 0, 0.33L, 0, -7e-4L, 0}),
      node(5, Vec3(1400, 0, 0), std::vector<Real>{0, 1, 0.1L, 1e-4L, 0, 1.1e-3L, 0.01L, -0.05L, 1, 0, -1.1e-3L, 0})};
  return nodes;
}

void couple(MatX& a, int r, int c, Real value) { a(r - 1, c - 1) = a(c - 1, r - 1) = value; }

// Of a Timoshenko beam along x.
MatX beam_stiffness() {
  const Real L = 200, A = 300, E = 7e4L, G = 2.7e4L, Ixx = 2.2e4L, Iyy = 1.1e4L, Izz = 1.4e4L;
  const Real y = 12 * E * Izz * 1.2L / (G * A * L * L), z = 12 * E * Iyy * 1.15L / (G * A * L * L);
  MatX K = MatX::Zero(6, 6);
  K(0, 0) = E * A / L, K(3, 3) = G * Ixx / L;
  K(1, 1) = 12 * E * Izz / (L * L * L * (1 + y)), K(2, 2) = 12 * E * Iyy / (L * L * L * (1 + z));
  K(5, 5) = (4 + y) * E * Izz / (L * (1 + y)), K(4, 4) = (4 + z) * E * Iyy / (L * (1 + z));
  couple(K, 2, 6, -6 * E * Izz / (L * L * (1 + y))), couple(K, 3, 5, 6 * E * Iyy / (L * L * (1 + z)));
  return K;
}
MatX diagonal(const std::vector<Real>& values) {
  return Eigen::Map<const VecX>(values.data(), static_cast<Eigen::Index>(values.size())).asDiagonal();
}
MatX field_stiffness() {
  MatX K = diagonal({900, 700, 800, 4e7L, 5e7L, 6e7L});
  couple(K, 2, 6, -3e4L), couple(K, 3, 5, 2.5e4L);
  return K;
}
MatX strut_stiffness() {
  MatX K = diagonal({400, 260, 310, 2e6L, 3e6L, 2.5e6L, 350, 240, 280, 0, 1e6L, 1.1e6L});
  couple(K, 1, 7, -60), couple(K, 2, 8, -45), couple(K, 3, 9, -50), couple(K, 3, 5, 1.2e4L), couple(K, 2, 6, -9e3L),
      couple(K, 5, 11, -2e5L);
  return K;
}

class Antenna : public Foreign {
 protected:
  enum Coordinate {
    azimuth,
    bent,
    elevation = 4,
    boomed,
    horn_at = 7,
    horn_turned = 10,
    weight_at = 13,
    weight_turned = 16
  };
  enum Bodies { turntable, nodes, yoke = 4, dish, boom_nodes, horn = 9, weight };
  static constexpr Real gravity = 9806.65L, consistency = 1000;
  // What is loose on springs moves from where the point of the program has it.
  struct Loose {
    Vec3 p;
    Mat3 R;
  };
  struct Setting {
    Real horn_mass;
    Loose horn, weight;
  };
  static Loose loose(const nlohmann::json& b) {
    Loose l;
    l.p = vector(b.at("position")).cast<Real>();
    for (Eigen::Index k = 0; k < 3; ++k) l.R.col(k) = vector(b.at("axes").at(static_cast<std::size_t>(k))).cast<Real>();
    return l;
  }
  static NewtonEuler::Pose node_pose(const NewtonEuler::Pose& body, const Node& n, const VecX& q, Eigen::Index first) {
    const VecX values = q.segment(first, n.moves.cols());
    const Vec3 moved = n.at + n.moves * values, turned = n.turns * values;
    return {body.p + body.R * moved, body.R * exponential(turned)};
  }

  static NewtonEuler model(const Setting& setting) {
    NewtonEuler n;
    n.consistency = consistency, n.states = 4;
    n.scale = VecX(19);
    n.scale << 0.5L, 20, 20, 20, 0.5L, 20, 20, 20, 20, 20, 0.1L, 0.1L, 0.1L, 20, 20, 20, 0.1L, 0.1L, 0.1L;
    n.bodies.push_back({120, products(6e6L, 7e6L, 9e6L)});
    for (const Node& p : mast()) n.bodies.push_back({p.mass, Mat3(Mat3::Zero())});
    n.bodies.push_back({60, products(9e5L, 7e5L, 8e5L)});
    n.bodies.push_back({85, products(1.8e7L, 1.1e7L, 1.2e7L, 2e5L, -3e5L, 1e5L)});
    for (const Node& p : boom()) n.bodies.push_back({p.mass, Mat3(Mat3::Zero())});
    n.bodies.push_back({setting.horn_mass, products(9e4L, 8e4L, 7e4L)});
    n.bodies.push_back({140, products(2.2e6L, 2.4e6L, 2.1e6L)});
    n.poses = [setting](const VecX& q, Real) {
      std::vector<NewtonEuler::Pose> at;
      const NewtonEuler::Pose table{Vec3(0, 0, 500), about(Vec3::UnitZ(), q(azimuth))};
      at.push_back(table);
      for (const Node& p : mast()) at.push_back(node_pose(table, p, q, bent));
      const NewtonEuler::Pose top = at.back();
      at.push_back({top.p + top.R * (Vec3(0, 0, 100) + Vec3(20, 0, 80)), top.R});
      const Mat3 R = top.R * about(Vec3::UnitY(), -q(elevation));
      const Vec3 origin = top.p + top.R * Vec3(0, 0, 300);
      at.push_back({origin + R * Vec3(260, 10, -40), R});
      for (const Node& p : boom()) at.push_back(node_pose({origin + R * Vec3(400, 0, 0), R}, p, q, boomed));
      const auto on_springs = [&](const Loose& l, const Vec3& centre, Eigen::Index moved, Eigen::Index turned) {
        const Mat3 axes = exponential(q.segment<3>(turned)) * l.R;
        at.push_back({l.p + q.segment<3>(moved) + axes * centre, axes});
      };
      on_springs(setting.horn, Vec3(30, 0, 5), horn_at, horn_turned);
      on_springs(setting.weight, Vec3::Zero(), weight_at, weight_turned);
      return at;
    };
    MatX mast_stiffness = diagonal({60, 55, 9}), mast_damping = diagonal({0.04L, 0.05L, 0.01L}),
         boom_stiffness = diagonal({40, 36});
    couple(mast_stiffness, 1, 2, 2), couple(mast_stiffness, 2, 3, 1), couple(mast_damping, 1, 2, 0.001L),
        couple(boom_stiffness, 1, 2, 1.5L);
    n.loads = [=, bodies = n.bodies, beam = beam_stiffness(), field = field_stiffness(), struts = strut_stiffness(),
               boom_damping = damping_of_boom(boom_stiffness)](const NewtonEuler::State& s, NewtonEuler::Loads& l) {
      for (std::size_t b = 0; b < bodies.size(); ++b)
        l.add(s, b, s.bodies[b].p, Vec3(0, 0, -bodies[b].mass * gravity / consistency));
      const auto on_dish = [&](Real x, const Mat3& axes = Mat3::Identity()) {
        return marker(s.bodies[dish], Vec3(x - 260, -10, 40), axes);
      };
      const Frame of_horn = marker(s.bodies[horn], Vec3(-30, 0, -5));
      const Frame end = marker(s.bodies[boom_nodes + 2], Vec3(50, 0, 0));
      const auto way = [&](const Frame& I, const Frame& J, const Vec3& unloaded, Real damped) -> VecX {
        const Relative r = relative(I, J);
        VecX d = r.at + damped * r.rate;
        d.head<3>() -= unloaded;
        return d;
      };
      l.press(s, horn, of_horn, boom_nodes + 2, end, -beam * way(of_horn, end, Vec3(200, 0, 0), 0.0015L));
      const Mat3 upright = euler(0, 90, 0);
      const Frame I = marker(s.bodies[weight], Vec3::Zero(), upright), J = on_dish(-350, upright);
      VecX held = -field * way(I, J, Vec3(-100, 0, 0), 0.004L);
      held(1) -= 700, held(5) += 1.2e5L;
      l.press(s, weight, I, dish, J, held);
      const Frame base = on_dish(500), middle = marker(s.bodies[boom_nodes + 1], Vec3::Zero());
      VecX both(12);
      both << way(of_horn, base, Vec3(1550, 0, 0), 0.003L), way(middle, base, Vec3(700, 0, 60), 0.003L);
      const VecX strut = -struts * both;
      l.press(s, horn, of_horn, dish, base, strut.head(6)),
          l.press(s, boom_nodes + 1, middle, dish, base, strut.tail(6));
      // Modes.
      l.along.segment(bent, 3) -= mast_stiffness * s.q.segment(bent, 3) + mast_damping * s.rate.segment(bent, 3);
      l.along.segment(boomed, 2) -= boom_stiffness * s.q.segment(boomed, 2) + boom_damping * s.rate.segment(boomed, 2);
      // Drives: torques about the axes of the coordinates.
      l.along(azimuth) -= 6e7L * (s.q(azimuth) - s.u(1)) + 3e6L * s.rate(azimuth);
      const Real error = s.u(0) - s.q(elevation), falling = -s.rate(elevation);
      l.rates(0) = error, l.rates(1) = -40 * s.z(1) + 30 * error + 2 * falling;
      const Real asked = 2e7L * s.z(0) + 4e6L * s.z(1) + 4e7L * error + 5e6L * falling;
      l.rates(2) = -150 * s.z(2) + s.z(3) + 100 * asked, l.rates(3) = -5000 * s.z(2) + 5000 * asked;
      l.along(elevation) += s.z(2) - 2e4L * s.rate(elevation);
    };
    return n;
  }
  // Each mode of the held boom has ζ = 1.2 % of its critical damping: 2 ζ M √(M⁻¹K), with the root of two by two.
  static MatX damping_of_boom(const MatX& K) {
    MatX M = MatX::Zero(2, 2);
    for (const Node& p : boom()) M += p.mass / consistency * p.moves.transpose() * p.moves;
    const MatX square = solution(M, K);
    const Real product = std::sqrt(square(0, 0) * square(1, 1) - square(0, 1) * square(1, 0));
    const MatX root = (square + product * MatX::Identity(2, 2)) / std::sqrt(square.trace() + 2 * product);
    return 2 * 0.012L * M * root;
  }

  struct Linear {
    MatX A, B, C, D;
    Eigen::MatrixXcd at(double hz) const { return response(A, B, C, D, hz); }
  };
  // At the point of a result, which has to be one of rest.
  static Linear linear(const nlohmann::json& result, Real horn_mass, Real up, Real aside) {
    const NewtonEuler n = model({horn_mass, loose(body_of(result, "PART/5")), loose(body_of(result, "PART/6"))});
    const auto& point = result.at("operating_point");
    VecX x = VecX::Zero(42);
    for (Eigen::Index k = 0; k < 5; ++k) {
      x(k < 3 ? bent + k : boomed + k - 3) =
          point.at("curve_parameters").at(static_cast<std::size_t>(k)).at("value").get<double>();
    }
    for (Eigen::Index k = 0; k < 4; ++k)
      x(38 + k) = point.at("states").at(static_cast<std::size_t>(k)).at("value").get<double>();
    x(azimuth) = aside, x(elevation) = up;  // integrators and what no load turns leave no error
    const VecX u{{up, aside}};
    const auto chain = n.poses(x.head(19), 0);
    EXPECT_LE((loose(body_of(result, "PART/4")).p - (chain[dish].p - chain[dish].R * Vec3(260, 10, -40))).norm(),
              1e-7L);
    EXPECT_LE((loose(body_of(result, "FLEX_BODY/11")).p - chain[boom_nodes].p).norm(), 1e-7L);
    EXPECT_LE((loose(body_of(result, "FLEX_BODY/11")).R - chain[dish].R).norm(), 1e-10L);
    const auto rates = n.rates_at(0);
    Linear l{n.by_state(rates, x, u), n.by_input(rates, x, u), {}, {}};
    // As far as a step of Newton's method leads from there: millimetres, radians.
    const VecX step = solution(l.A, rates(x, u));
    EXPECT_LE(step.head(19).norm(), 1e-6L) << step.transpose();
    l.C = MatX::Zero(3, 42), l.D = MatX::Zero(3, 2);
    l.C(0, elevation) = 1, l.C(2, 40) = 1;
    // At rest what accelerates the mass centre are the second rates of where it stands.
    const NewtonEuler::Function height = [&](const VecX& y, const VecX&) -> VecX {
      return n.poses(y.head(19), 0)[horn].p.tail<1>();
    };
    const MatX lift = n.by_state(height, x, u).leftCols(19);
    l.C.row(1) = lift * l.A.middleRows(19, 19), l.D.row(1) = lift * l.B.middleRows(19, 19);
    return l;
  }
};

TEST_F(Antenna, antenna) {
  const RunResult r = run_foreign("antenna");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto modes = all_with(r, "eigenvalues"), matrices = all_with(r, "A"), second = all_with(r, "KB");
  ASSERT_EQ(modes.size(), 3u);
  ASSERT_EQ(matrices.size(), 2u);
  ASSERT_EQ(second.size(), 1u);
  const std::vector<double> hz{0.4, 1.2, 3.0, 14.0, 60.0};
  const Real degree = pi_l / 180;
  const Linear low = linear(*modes[0], 9, 30 * degree, 0), high = linear(*modes[1], 9, 75 * degree, -50 * degree),
               iced = linear(*modes[2], 16, 30 * degree, 0);
  expect_spectrum(*modes[0], spectrum(low.A), 1e-8, 0);
  expect_spectrum(*modes[1], spectrum(high.A), 1e-8, 0);
  expect_spectrum(*modes[2], spectrum(iced.A), 1e-8, 0);
  expect_response(
      *matrices[0], hz, [&](double f) { return low.at(f); }, 1e-7);
  expect_response(
      *matrices[1], hz, [&](double f) { return iced.at(f); }, 1e-7);
  // M s″ + B s′ + K s = P u, y = C (s, s′) + D u.
  for (const double f : hz) {
    const std::complex<double> s(0, 2 * std::numbers::pi * f);
    const Eigen::MatrixXd C = matrix(*second[0], "C"), P = matrix(*second[0], "P");
    const Eigen::MatrixXcd dynamic =
        s * s * matrix(*second[0], "M") + s * matrix(*second[0], "B") + matrix(*second[0], "K");
    const Eigen::MatrixXcd moved = dynamic.partialPivLu().solve(P.cast<std::complex<double>>());
    const Eigen::MatrixXcd ours = C.leftCols(moved.rows()) * moved + s * C.rightCols(moved.rows()) * moved +
                                  matrix(*second[0], "D"),
                           theirs = high.at(f);
    for (Eigen::Index k = 0; k < ours.size(); ++k)
      EXPECT_LE(std::abs(ours(k) - theirs(k)), 1e-6 * std::abs(theirs(k))) << f << " cycles, entry " << k;
  }
  EXPECT_TRUE(r.wrote("antenna.res"));
}

}  // namespace
}  // namespace dynalin::cases::newton_euler::foreign_antenna_test
