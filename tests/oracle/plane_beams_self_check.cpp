// Plane beams of the oracle: their loads against slopes of the energies, which are written anew here with complex
// numbers for places in the plane, and against closed forms; their rows against differences along a motion.
#include <complex>

#include "self_check.h"

namespace dynalin::oracle::plane_beams_self_check {
namespace {

using Complex = std::complex<Real>;
using Pose = std::array<Complex, 4>;  // r1, s1, r2, s2

constexpr std::array planes{BeamPlane::xy, BeamPlane::yz, BeamPlane::zx};

// Columns along a, b and the normal.
Mat columns(BeamPlane plane) {
  const PlaneAxes axes = axes_of(plane);
  Mat m = zero_matrix();
  set_component(m.column[0], axes.a, 1), set_component(m.column[1], axes.b, 1);
  set_component(m.column[2], axes.normal, 1);
  return m;
}

// Nodes at `at`, their x axes leading along `heading`, sections turned about them.
Beam beam_in(BeamPlane plane, const std::vector<Complex>& at, const std::vector<double>& heading, double roll) {
  Beam b;
  b.id = 1, b.plane = plane;
  b.qg = {0.4, -0.2, 0.9}, b.reuler = {0.7, 1.1, -0.4};
  const Mat axes = columns(plane), back = transpose(rotation_313(b.reuler));
  for (std::size_t k = 0; k < at.size(); ++k) {
    b.places.push_back(to_triple(back * (axes * Vec{at[k].real(), at[k].imag(), 0.6L} - to_vec(b.qg))));
    b.angles.push_back(angles_313(back * (axes * rotation_z(heading[k]) * rotation_x(roll))));
    const double n = static_cast<double>(k);
    b.area.push_back(0.05 + 0.02 * n), b.torsion.push_back(0.004);
    b.yy.push_back(0.003 - 0.0005 * n), b.zz.push_back(0.001 + 0.0004 * n), b.yz.push_back(0.0006 + 0.0002 * n);
    b.shear_y.push_back(1.2), b.shear_z.push_back(1.2);
  }
  b.youngs_modulus = 900, b.density = 30;
  return b;
}

const std::vector<Complex> bow{{0.3L, -0.1L}, {1.0L, 0.25L}};
const std::vector<double> bow_heading{0.2, 0.75};
const Pose bent{Complex{0.35L, -0.2L}, Complex{1.05L, 0.1L}, Complex{0.9L, 0.4L}, Complex{0.6L, 1.0L}};
const Pose speed{Complex{0.3L, -1.2L}, Complex{0.5L, -0.8L}, Complex{-0.9L, 0.4L}, Complex{1.1L, 0.7L}};
constexpr double roll = 0.6;

// All of an element as its definition says it, from the dataset's numbers.
struct ByHand {
  Real length = 0;
  std::array<Real, 2> moment{};
  Beam beam;
  explicit ByHand(const Beam& b, const std::vector<Complex>& at, const std::vector<double>& heading) : beam(b) {
    const Complex chord = at[1] - at[0],
                  mean = 0.25L * (std::polar<Real>(1, heading[0]) + std::polar<Real>(1, heading[1]));
    // Bisection for |1.5/l chord - mean| = 1 between lengths around it.
    Real low = 0.5L * std::abs(chord), high = 2 * std::abs(chord);
    for (int k = 0; k < 200; ++k) {
      length = (low + high) / 2;
      (std::abs((1.5L / length) * chord - mean) > 1 ? low : high) = length;
    }
    // The normal stands at `roll` from z towards y: distances in the plane are cos y - sin z.
    const Real c = std::cos(roll), s = std::sin(roll);
    for (std::size_t k = 0; k < 2; ++k) moment[k] = c * c * b.zz[k] + s * s * b.yy[k] - 2 * s * c * b.yz[k];
  }
  struct Line {
    Complex middle;
    std::array<Real, 3> stretch{};
    std::array<Real, 2> turn{};
  };
  [[nodiscard]] Line line(const Pose& q) const {
    const Complex vm = (1.5L / length) * (q[2] - q[0]) - 0.25L * (q[1] + q[3]);
    return {vm, {std::abs(q[1]) - 1, std::abs(vm) - 1, std::abs(q[3]) - 1}, {std::arg(q[1] / vm), std::arg(q[3] / vm)}};
  }
  [[nodiscard]] Real stretch(const Pose& q, Real xi) const {
    const auto e = line(q).stretch;
    return e[1] + xi * (e[2] - e[0]) / 2 + xi * xi * ((e[0] + e[2]) / 2 - e[1]);
  }
  [[nodiscard]] Real angle(const Pose& q, Real xi) const {
    const Line l = line(q);
    return std::arg(l.middle) + xi * (l.turn[1] - l.turn[0]) / 2 + xi * xi * (l.turn[0] + l.turn[1]) / 2;
  }
  [[nodiscard]] Real curvature(const Pose& q, Real xi) const {
    const Line l = line(q);
    return (2 / length) * ((l.turn[1] - l.turn[0]) / 2 + xi * (l.turn[0] + l.turn[1]));
  }
  [[nodiscard]] Complex place(const Pose& q, Real xi) const {
    const Complex a = q[0] + q[2], d = q[2] - q[0];
    return a / 2.0L + (xi * (3 - xi * xi) / 4) * d + (length / 8) * (1 - xi * xi) * (q[1] - q[3]) -
           (length / 8) * xi * (1 - xi * xi) * (q[1] + q[3]);
  }
  template <class Values>
  [[nodiscard]] Real mean(const Values& list, Real xi) const {
    return ((1 - xi) * list[0] + (1 + xi) * list[1]) / 2;
  }
  // Of f over the line, by Legendre's points.
  template <class F>
  [[nodiscard]] Real three(F&& f) const {
    const Real a = std::sqrt(0.6L);
    return length / 18 * (5 * f(-a) + 8 * f(Real{0}) + 5 * f(a));
  }
  template <class F>
  [[nodiscard]] Real four(F&& f) const {
    const Real a = 0.339981043584856264802665759103244687L, b = 0.861136311594052575223946488892809505L;
    const Real wa = 0.652145154862546142626936050778000593L, wb = 0.347854845137453857373063949221999407L;
    return length / 2 * (wa * (f(-a) + f(a)) + wb * (f(-b) + f(b)));
  }
  [[nodiscard]] Real energy(const Pose& q, const Pose& drawn) const {
    return three([&](Real xi) {
      const Real eps = stretch(q, xi), kappa = curvature(q, xi) - curvature(drawn, xi);
      return 0.5L * beam.youngs_modulus * (mean(beam.area, xi) * eps * eps + mean(moment, xi) * kappa * kappa);
    });
  }
};

Pose drawn_pose(const std::vector<Complex>& at, const std::vector<double>& heading) {
  return {at[0], std::polar<Real>(1, heading[0]), at[1], std::polar<Real>(1, heading[1])};
}

// Along a motion with these rates and accelerations.
PlanePose<Jet> jets(const Pose& q, const Pose& v = {}, const Pose& a = {}) {
  const auto one = [&](std::size_t k) {
    return Vector3<Jet>{{q[k].real(), v[k].real(), a[k].real()}, {q[k].imag(), v[k].imag(), a[k].imag()}, 0};
  };
  return {{one(0), one(2)}, {one(1), one(3)}};
}
PlanePose<Real> still(const Pose& q) {
  const auto one = [&](std::size_t k) { return Vec{q[k].real(), q[k].imag(), 0}; };
  return {{one(0), one(2)}, {one(1), one(3)}};
}

// The slope of f by coordinate k, extrapolated.
template <class F>
Real slope(F&& f, Pose q, std::size_t k) {
  const auto difference = [&](Real h) {
    const Complex step = k % 2 == 0 ? Complex{h, 0} : Complex{0, h};
    Pose up = q, down = q;
    up[k / 2] += step, down[k / 2] -= step;
    return (f(up) - f(down)) / (2 * h);
  };
  return (4 * difference(5e-5L) - difference(1e-4L)) / 3;
}

void expect_loads(const PlaneLoads& actual, const PlaneLoads& expected, double tolerance) {
  for (std::size_t k = 0; k < plane_freedoms; ++k)
    EXPECT_NEAR(static_cast<double>(actual[k]), static_cast<double>(expected[k]), tolerance) << k;
}

TEST(PlaneBeams, elastic_loads_are_slopes_of_the_energy) {
  for (const BeamPlane plane : planes) {
    const Beam b = beam_in(plane, bow, bow_heading, roll);
    const PlaneElement element(b, 0, 1);
    const ByHand hand(b, bow, bow_heading);
    EXPECT_NEAR(static_cast<double>(element.length() - hand.length), 0, 1e-14);
    const Pose drawn = drawn_pose(bow, bow_heading);
    PlaneLoads expected{};
    for (std::size_t k = 0; k < plane_freedoms; ++k)
      expected[k] = -slope([&](const Pose& q) { return hand.energy(q, drawn); }, bent, k);
    expect_loads(element.loads(jets(bent), {}), expected, 1e-10);
    for (const std::size_t k : {0u, 3u, 5u, 6u}) EXPECT_GT(static_cast<double>(std::fabs(expected[k])), 0.5) << k;
  }
}

TEST(PlaneBeams, rigid_motion_in_the_plane_gives_no_load) {
  Beam b = beam_in(BeamPlane::yz, bow, bow_heading, roll);
  b.damping = 0.1;
  const PlaneElement element(b, 0, 1);
  const Pose drawn = drawn_pose(bow, bow_heading);
  for (const Real angle : {0.0L, 1.3L, 2.9L, -2.2L}) {
    const Complex turn = std::polar<Real>(1, angle), i{0, 1};
    const Pose q{Complex{3, -2} + turn * drawn[0], turn * drawn[1], Complex{3, -2} + turn * drawn[2], turn * drawn[3]};
    const Pose v{Complex{1, 2} + 1.7L * i * q[0], 1.7L * i * q[1], Complex{1, 2} + 1.7L * i * q[2], 1.7L * i * q[3]};
    expect_loads(element.loads(jets(q, v), {}), {}, 1e-12);
  }
}

// Neither a shift nor a turn of the whole takes work.
TEST(PlaneBeams, elastic_loads_of_an_element_balance) {
  const PlaneElement element(beam_in(BeamPlane::zx, bow, bow_heading, roll), 0, 1);
  const PlaneLoads f = element.loads(jets(bent), {});
  EXPECT_NEAR(static_cast<double>(f[0] + f[4]), 0, 1e-14);
  EXPECT_NEAR(static_cast<double>(f[1] + f[5]), 0, 1e-14);
  Real moment = 0;
  for (std::size_t k = 0; k < 4; ++k) moment += bent[k].real() * f[2 * k + 1] - bent[k].imag() * f[2 * k];
  EXPECT_NEAR(static_cast<double>(moment), 0, 1e-14);
}

TEST(PlaneBeams, damping_takes_the_power_of_the_rates_of_strains) {
  Beam b = beam_in(BeamPlane::zx, bow, bow_heading, roll);
  const ByHand hand(b, bow, bow_heading);
  const PlaneLoads elastic = PlaneElement(b, 0, 1).loads(jets(bent, speed), {});
  b.damping = 0.03;
  const PlaneLoads damped = PlaneElement(b, 0, 1).loads(jets(bent, speed), {});
  const auto rate = [&](auto&& of) {
    const auto at = [&](Real t) {
      Pose q = bent;
      for (std::size_t k = 0; k < 4; ++k) q[k] += t * speed[k];
      return of(q);
    };
    const auto difference = [&](Real h) { return (at(h) - at(-h)) / (2 * h); };
    return (4 * difference(5e-5L) - difference(1e-4L)) / 3;
  };
  const auto stretch = [&](Real xi) { return rate([&](const Pose& q) { return hand.stretch(q, xi); }); };
  const auto curvature = [&](Real xi) { return rate([&](const Pose& q) { return hand.curvature(q, xi); }); };
  for (std::size_t k = 0; k < plane_freedoms; ++k) {
    const auto by = [&](auto&& of, Real xi) {
      return slope([&](const Pose& q) { return (hand.*of)(q, xi); }, bent, k);
    };
    const Real expected = -0.03L * hand.three([&](Real xi) {
      return b.youngs_modulus * (hand.mean(b.area, xi) * stretch(xi) * by(&ByHand::stretch, xi) +
                                 hand.mean(hand.moment, xi) * curvature(xi) * by(&ByHand::curvature, xi));
    });
    EXPECT_NEAR(static_cast<double>(damped[k] - elastic[k]), static_cast<double>(expected), 1e-10) << k;
  }
}

TEST(PlaneBeams, inertia_and_weight_are_those_of_the_cubic) {
  const Beam b = beam_in(BeamPlane::yz, bow, bow_heading, roll);
  const Real ucf = 7;
  const PlaneElement element(b, 0, ucf);
  const ByHand hand(b, bow, bow_heading);
  const Vec gravity{5, -3, -8};  // along y and z in the plane
  const PlaneLoads with = element.loads(jets(bent, {}, speed), gravity), without = element.loads(jets(bent), {});
  for (std::size_t k = 0; k < plane_freedoms; ++k) {
    Pose e{};
    e[k / 2] = k % 2 == 0 ? Complex{1, 0} : Complex{0, 1};
    const auto work = [&](const Pose& a, const Complex& g) {
      return hand.four([&](Real xi) {
        const Complex f = g - hand.place(a, xi);
        return b.density / ucf * hand.mean(b.area, xi) * (std::conj(f) * hand.place(e, xi)).real();
      });
    };
    EXPECT_NEAR(static_cast<double>(with[k] - without[k]), static_cast<double>(work(speed, {-3, -8})), 1e-14) << k;
    for (std::size_t j = 0; j < plane_freedoms; ++j) {
      Pose a{};
      a[j / 2] = j % 2 == 0 ? Complex{1, 0} : Complex{0, 1};
      EXPECT_NEAR(static_cast<double>(element.mass(k, j)), static_cast<double>(-work(a, 0)), 1e-15) << k << j;
    }
  }
}

TEST(PlaneBeams, line_loads_do_the_work_on_places_and_angles) {
  const Beam b = beam_in(BeamPlane::zx, bow, bow_heading, roll);
  const PlaneElement element(b, 0, 1);
  const ByHand hand(b, bow, bow_heading);
  const auto force = [](Real xi) { return Complex{1 + xi, 2 - xi * xi}; };
  const auto moment = [](Real xi) { return 0.7L + std::sin(2 * xi); };
  LineLoads on;
  for (std::size_t g = 0; g < line_points; ++g) {
    const Real xi = 2 * four_points()[g].at - 1;
    on.force[g] = {force(xi).imag(), 17, force(xi).real()};  // a along z, b along x
    on.moment[g] = {-4, moment(xi), 9};
  }
  PlaneLoads expected{};
  for (std::size_t k = 0; k < plane_freedoms; ++k) {
    expected[k] = slope(
        [&](const Pose& q) {
          return hand.four([&](Real xi) {
            return (std::conj(force(xi)) * hand.place(q, xi)).real() + moment(xi) * hand.angle(q, xi);
          });
        },
        bent, k);
  }
  expect_loads(element.loads(still(bent), on), expected, 1e-12);
}

void add_bodies(Mechanism& m, const Beam& b) {
  const Mat bcs = rotation_313(b.reuler);
  for (std::size_t k = 0; k < b.nodes(); ++k) {
    Body node, along;
    const Mat R = bcs * rotation_313(b.angles[k]);
    node.ref = b.node(k), node.qg = to_triple(to_vec(b.qg) + bcs * to_vec(b.places[k])), node.reuler = angles_313(R);
    along.ref = b.slope(k), along.qg = to_triple(R.column[0]);
    m.bodies.insert(m.bodies.end(), {node, along});
  }
}

// One element, clamped: across its line small motion is that of one Hermite element, whose stiffness and mass for the
// deflection and l times the slope at the free end are EI/l^3 [12 -6; -6 4] and m/420 [156 -22; -22 4].
TEST(PlaneBeams, a_clamped_element_is_that_of_bernoulli_for_small_bending) {
  for (const BeamPlane plane : planes) {
    const double l = 0.8, heading = 0.4;
    const Complex root{0.3L, -0.1L};
    Beam b = beam_in(plane, {root, root + std::polar<Real>(static_cast<Real>(l), heading)}, {heading, heading}, roll);
    for (auto* list : {&b.area, &b.yy, &b.zz, &b.yz}) (*list)[1] = (*list)[0];
    Mechanism m = with_ground();
    m.beams = {b};
    add_bodies(m, b);
    const Vec at = to_vec(m.bodies[1].qg);
    const Mat R = rotation_313(m.bodies[1].reuler);
    m.markers = {{1, ground, to_triple(at), angles_313(R)}, {2, b.node(0), {0, 0, 0}, {0, 0, 0}}};
    m.joints = {{1, JointType::fixed, 2, 1}};
    const PlaneAxes axes = axes_of(plane);
    std::vector<ChosenState> states;
    const auto add = [&](const BodyRef& ref, int c) {
      for (const Kind kind : {Kind::rate, Kind::coordinate}) states.push_back({kind, ref.id, ref.kind, c, {}, 0, 1});
    };
    for (const int c : {axes.a, axes.b}) add(b.node(1), c), add(b.slope(1), c);
    for (const int c : {axes.a, axes.b}) add(b.slope(0), c);
    // A FIXED joint leaves the length of the slope alone: of its two components one is a state.
    states.resize(10);
    const OracleLinearModel r = linearize_drawn(m, states);
    const Real c = std::cos(roll), s = std::sin(roll), I = c * c * b.zz[0] + s * s * b.yy[0] - 2 * s * c * b.yz[0];
    const double frequency = static_cast<double>(b.youngs_modulus * I / (b.density * b.area[0] * std::pow(l, 4)));
    // Across the line: w and l w' obey M^-1 K.
    const double det = (156 * 4 - 22 * 22) / 420.0;
    const std::array<std::array<double, 2>, 2> inverse{{{4 / det, 22 / det}, {22 / det, 156 / det}}},
        K{{{12, -6}, {-6, 4}}};
    // What a displacement across adds to the acceleration across, of the place (0) or the slope (1).
    const double ca = -std::sin(heading), cb = std::cos(heading);
    const auto across = [&](std::size_t row, std::size_t column) {
      const std::size_t ra = 2 * row, rb = 2 * (row + 2), xa = 2 * column + 1, xb = 2 * (column + 2) + 1;
      return ca * (r.A[ra][xa] * ca + r.A[ra][xb] * cb) + cb * (r.A[rb][xa] * ca + r.A[rb][xb] * cb);
    };
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const double entry =
            -(inverse[i][0] * K[0][j] + inverse[i][1] * K[1][j]) * frequency * (i == 1 ? 1 / l : 1) * (j == 1 ? l : 1);
        EXPECT_NEAR(across(i, j), entry, 1e-9 * std::fabs(entry)) << i << j;
      }
    }
  }
}

// At a drawn point, along a motion with any velocities and accelerations.
void expect_rows_as_along_a_motion(const Mechanism& drawn) {
  Model model(drawn);
  place(model, drawn_point(drawn));
  std::vector<BodyMotion> start = model.motion;
  Real x = 0.1L;
  const auto next = [&] { return x = std::fmod(x * 7.31L + 0.37L, 2.0L), x - 1; };
  for (BodyMotion& m : start) m.v = {next(), next(), next()}, m.w = {next(), next(), next()};
  for (BodyMotion& m : start) m.a = {next(), next(), next()}, m.al = {next(), next(), next()};
  start[0] = {};
  const auto go = [&](Real t) {
    for (std::size_t b = 0; b < start.size(); ++b) {
      const BodyMotion& s = start[b];
      const Vec turn = t * s.w + (t * t / 2) * s.al;
      model.motion[b] = {s.p + t * s.v + (t * t / 2) * s.a,
                         rotation_exponential(turn) * s.R,
                         s.v + t * s.a,
                         left_jacobian(turn) * (s.w + t * s.al),
                         s.a,
                         s.al};
    }
    model.update_positions();
    model.update_velocities();
    model.update_accelerations();
  };
  int seen = 0;
  for (std::size_t k = 0; k < model.rows.size(); ++k) {
    const Row& row = model.rows[k];
    if (row.type != Row::Type::plane) continue;
    ++seen;
    const auto difference = [&](auto&& of, Real h) {
      go(h);
      const Real up = of();
      go(-h);
      return (up - of()) / (2 * h);
    };
    const auto rate = [&](auto&& of) { return (4 * difference(of, 5e-4L) - difference(of, 1e-3L)) / 3; };
    const Real position = rate([&] { return model.row_position(row); });
    const Real velocity = rate([&] { return model.row_velocity(row); });
    go(0);
    EXPECT_NEAR(static_cast<double>(model.row_velocity(row)), static_cast<double>(position), 1e-9) << k;
    EXPECT_NEAR(static_cast<double>(model.row_acceleration(row)), static_cast<double>(velocity), 1e-9) << k;
    const Dense G = model.gradient();
    Real by_gradient = 0;
    for (std::size_t b = 1; b < start.size(); ++b) {
      for (int c = 0; c < model.bodies[b].dof; ++c)
        by_gradient += G(k, static_cast<std::size_t>(model.bodies[b].offset + c)) *
                       component(c < 3 ? start[b].v : start[b].w, c % 3);
    }
    EXPECT_NEAR(static_cast<double>(by_gradient), static_cast<double>(position), 1e-9) << k;
  }
  EXPECT_EQ(seen, 5 * static_cast<int>(drawn.beams[0].nodes()));
}

TEST(PlaneBeams, rows_go_as_their_rates_and_gradients_say) {
  for (const std::uint64_t seed : {281u, 282u, 283u}) expect_rows_as_along_a_motion(random_mechanism(seed));
}

TEST(PlaneBeams, drawn_ones_are_accurate_and_varied) {
  std::array<int, 4> of_plane{};
  for (std::uint64_t seed = 281; seed < 287; ++seed) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    ASSERT_EQ(m.beams.size(), 1u);
    ++of_plane[static_cast<std::size_t>(m.beams[0].plane)];
    const OraclePoint point = drawn_point(m);
    const OracleLinearModel r = oracle_linearize(m, point, choose_states(m, point));
    EXPECT_LT(r.error_estimate, 1e-10);
    EXPECT_LT(r.polish, 1e-12);
  }
  EXPECT_EQ(of_plane, (std::array<int, 4>{0, 2, 2, 2}));
}

}  // namespace
}  // namespace dynalin::oracle::plane_beams_self_check
