// What pairs of markers spread over their bodies, against generalized forces computed along varied paths.
#include "mechanics/pair.h"

#include <gmock/gmock.h>

#include "mechanics/noted_laws.h"
#include "mechanics/pair_blocks.h"
#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::pair_test {
namespace {

constexpr MarkerId I{2}, J{5};  // on PART/2 and PART/3

// A law of all that a pair can show, in the axes of J: f = f₀ + A d + B x + C d′ + D w with d the displacement, x the
// first axis of I and w the relative angular velocity, each as seen from J.
struct Law {
  Vector constant;
  Matrix3 on_d, on_x, on_rate, on_w;

  static Law drawn(Paths& p) { return {p.vector(), p.matrix(), p.matrix(), p.matrix(), p.matrix()}; }
  // In global axes along a path.
  RealVector at(const Moment& m, MarkerId i, MarkerId j) const {
    const auto d = [&](const Moment& n) { return transpose_times(n.axes(j), n.origin(i) - n.origin(j)); };
    const RealVector x = transpose_times(m.axes(j), m.axes(i).x);
    const RealVector w = transpose_times(m.axes(j), m.angular_velocity(i) - m.angular_velocity(j));
    return m.axes(j) *
           (real(constant) + real(on_d) * d(m) + real(on_x) * x + real(on_rate) * m.rate(d) + real(on_w) * w);
  }
  // δx = δφ × x, δw = δφ′ + δφ × w.
  Vector add_to(const PairMotion& p, std::size_t row, RelativeWrench& wrench) const {
    const Vector d = value(p.relative.p), rate_of_d = rate(p.relative.p), x = value(p.relative.x);
    Vector w{};
    for (const Vec3<Taylor>* a : {&p.relative.x, &p.relative.y, &p.relative.z}) w += 0.5 * cross(value(*a), rate(*a));
    const Matrix3 on_phi = -(on_x * skew(x)) - on_w * skew(w);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        wrench.on_pose[row + r][c] = on_d(r, c), wrench.on_pose[row + r][3 + c] = on_phi(r, c);
        wrench.on_rate[row + r][c] = on_rate(r, c), wrench.on_rate[row + r][3 + c] = on_w(r, c);
      }
    }
    wrench.depends_on_rate = true;
    return constant + on_d * d + on_x * x + on_rate * rate_of_d + on_w * w;
  }
};

// A wrench by such laws on a pair.
struct Wrench {
  Law force, torque;
  MarkerId i = I, j = J;

  RelativeWrench in_axes_of_J(const PairMotion& pair) const {
    RelativeWrench w;
    w.force = force.add_to(pair, 0, w);
    w.torque = torque.add_to(pair, 3, w);
    return w;
  }
  PairForce of(const Paths& p, Partials wanted = Partials::yes) const {
    const PairMotion pair = motion(p);
    return spread(pair, in_axes_of_J(pair), wanted);
  }
  PairMotion motion(const Paths& p) const { return pair_motion(p.motion, p.layout.marker(i), p.layout.marker(j)); }
};

// The partials of a vector on the pair by all blocks that it depends on, by `pick` out of those of a block.
template <class Function>
void expect_partials(const Paths& p, const PairForce& force, Matrix3 BlockPartials::*pick, std::size_t level,
                     const char* what, const Function& f) {
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  std::size_t coordinates = 0;
  for_each_block(pair, p.layout, [&](const PairBlock& b) {
    const Matrix3 partials = partials_by(b, force).*pick;
    coordinates += b.count;
    for (std::size_t k = 0; k < b.count; ++k) {
      const std::int32_t column = b.column + static_cast<std::int32_t>(k);
      const RealVector expected = p.now().partial(column, level, f);
      for (std::size_t r = 0; r < 3; ++r) {
        EXPECT_TRUE(agree(partials(r, k), expected[r]))
            << what << " "
            << "xyz"[r] << " by " << coordinate_name(p.layout, column, level);
      }
    }
  });
  EXPECT_EQ(coordinates, 18u);
}

void expect_near(const Vector& value, const RealVector& expected, const char* what) {
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_TRUE(agree(value[k], expected[k])) << what << " "
                                              << "xyz"[k];
}

TEST(Pair, marker_I_is_seen_from_J_with_two_rates) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const auto expect_course = [&](const Vec3<Taylor>& v, const auto& f, const char* what) {
    expect_near(value(v), f(p.now()), what);
    expect_near(rate(v), p.now().rate(f), what);
    expect_near(acceleration(v), p.now().second_rate(f), what);
  };
  expect_course(
      pair.relative.p, [](const Moment& m) { return transpose_times(m.axes(J), m.origin(I) - m.origin(J)); },
      "displacement seen from J");
  const std::array<const Vec3<Taylor>*, 3> axes = {&pair.relative.x, &pair.relative.y, &pair.relative.z};
  for (std::size_t c = 0; c < 3; ++c) {
    expect_course(
        *axes[c], [c](const Moment& m) { return transpose_times(m.axes(J), m.axes(I)[c]); }, "axis seen from J");
    expect_course(
        pair.axes_J[c], [c](const Moment& m) { return m.axes(J)[c]; }, "axis of J");
  }
  expect_course(
      pair.delta, [](const Moment& m) { return m.origin(I) - m.origin(J); }, "line from J to I");
  expect_course(
      pair.arm_I, [](const Moment& m) { return m.arm(I); }, "arm of I");
  expect_course(
      pair.arm_J, [](const Moment& m) { return m.arm(J); }, "arm of J");
  expect_course(
      pair.arm, [](const Moment& m) { return m.origin(I) - m.origin_of(m.body(J)); }, "arm from the body of J");
  expect_near(pair.w_J, p.now().angular_velocity(J), "angular velocity of J");
  EXPECT_EQ(pair.body_I.index, 1);
  EXPECT_EQ(pair.body_J.index, 2);
}

TEST(Pair, differences_stay_exact_far_from_the_global_origin) {
  Paths p;
  const PairMotion near = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const Vector far{0x1p40, -0x1p41, 0x1p42};  // differences of origins are exact there
  const Vector r = p.motion.bodies[1].r;
  p.motion.bodies[1].r = far, p.motion.bodies[2].r = far;
  const PairMotion away = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  p.motion.bodies[1].r = r, p.motion.bodies[2].r = r;
  const PairMotion same = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(value(away.delta)[k], value(same.delta)[k]);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(rate(away.delta)[k], rate(near.delta)[k]);
}

TEST(Pair, a_wrench_in_the_axes_of_J_spreads_with_its_partials_by_position_and_velocity) {
  Paths p;
  const Wrench w{Law::drawn(p), Law::drawn(p)};
  const PairForce f = w.of(p);
  const auto force = [&](const Moment& m) { return w.force.at(m, I, J); };
  const auto torque = [&](const Moment& m) { return w.torque.at(m, I, J); };
  expect_near(f.force, force(p.now()), "force");
  expect_near(f.torque, torque(p.now()), "torque");
  expect_partials(p, f, &BlockPartials::force, 0, "force", force);
  expect_partials(p, f, &BlockPartials::torque, 0, "torque", torque);
  expect_partials(p, f, &BlockPartials::force_by_rate, 1, "force", force);
  expect_partials(p, f, &BlockPartials::torque_by_rate, 1, "torque", torque);
  EXPECT_TRUE(f.depends_on_velocity);
  EXPECT_EQ(f.reaction, Reaction::at_I);
}

TEST(Pair, a_wrench_without_rates_has_no_partials_by_velocity) {
  Paths p;
  Wrench w{Law::drawn(p), Law::drawn(p)};
  w.force.on_rate = w.force.on_w = w.torque.on_rate = w.torque.on_w = Matrix3{};
  RelativeWrench r = w.in_axes_of_J(w.motion(p));
  r.depends_on_rate = false;
  const PairForce f = spread(w.motion(p), r, Partials::yes);
  EXPECT_FALSE(f.depends_on_velocity);
  expect_partials(p, f, &BlockPartials::force, 0, "force", [&](const Moment& m) { return w.force.at(m, I, J); });
  expect_partials(p, f, &BlockPartials::torque_by_rate, 1, "torque", [](const Moment&) { return RealVector{}; });
}

// F = a + b d + c d² + e d′ d along the line.
struct Line {
  double a = 0.7, b = -1.3, c = 0.4, e = 0.9;

  template <class T>
  T at(const T& d, const T& rate) const {
    return a + b * d + c * (d * d) + e * (rate * d);
  }
  RealVector along(const Moment& m) const {
    const auto distance = [](const Moment& n) { return norm(n.origin(I) - n.origin(J)); };
    return (m.origin(I) - m.origin(J)) / distance(m) * at(distance(m), m.rate(distance));
  }
  PairForce of(const PairMotion& pair, Partials wanted = Partials::yes) const {
    return along_line(pair, magnitude(norm(pair.delta)), wanted);
  }
  LineMagnitude magnitude(const Taylor& d) const {
    return {at(d.value, d.rate), b + 2 * c * d.value + e * d.rate, e * d.value};
  }
};

TEST(Pair, a_force_along_the_line_has_the_stiffness_of_its_direction) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  for (const Line& line : {Line{}, Line{.e = 0}}) {
    const PairForce f = line.of(pair);
    const auto force = [&](const Moment& m) { return line.along(m); };
    expect_near(f.force, force(p.now()), "force");
    expect_near(f.torque, {}, "torque");
    expect_partials(p, f, &BlockPartials::force, 0, "force", force);
    expect_partials(p, f, &BlockPartials::force_by_rate, 1, "force", force);
    EXPECT_EQ(f.depends_on_velocity, line.e != 0);
    EXPECT_EQ(f.reaction, Reaction::at_J);
    EXPECT_EQ(f.components, Components::force);
  }
}

TEST(Pair, partials_are_left_out_where_nobody_asks) {
  Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const Wrench w{Law::drawn(p), Law::drawn(p)};
  for (const PairForce& f : {w.of(p, Partials::no), Line{}.of(pair, Partials::no)}) {
    for (const MarkerPartials* by :
         {&f.force_on_position, &f.torque_on_position, &f.force_on_velocity, &f.torque_on_velocity}) {
      for (const Matrix3& m : {by->origin_I, by->axes_I, by->origin_J, by->axes_J})
        EXPECT_EQ(trace(transpose(m) * m), 0);
    }
  }
}

// Rows of the balance that a force on the pair is in: of both poses, then of the modal coordinates.
constexpr std::size_t balance_rows = 18;
std::int32_t row_of_balance(const Paths& p, std::size_t k) {
  return k < 12 ? static_cast<std::int32_t>(k) : p.layout.body_coordinate_count + static_cast<std::int32_t>(k) - 12;
}
bool is_of_J(std::size_t k) { return k < 12 ? k >= 6 : k >= 14; }

// Generalized forces of what acts at I, and of the opposite at the same point of J's body.
struct Balance {
  std::array<Real, balance_rows> work{};

  friend Balance operator-(Balance a, const Balance& b) { return a + b * -1; }
  friend Balance operator+(Balance a, const Balance& b) {
    for (std::size_t k = 0; k < balance_rows; ++k) a.work[k] += b.work[k];
    return a;
  }
  friend Balance operator*(Balance a, Real s) {
    for (Real& w : a.work) w *= s;
    return a;
  }
  friend Balance operator/(const Balance& a, Real s) { return a * (1 / s); }
};
Balance balance(const Moment& m, const RealVector& f, const RealVector& t) {
  Balance all;
  for (std::size_t k = 0; k < balance_rows; ++k) {
    const bool of_J = is_of_J(k);
    const MarkerId marker = of_J ? J : I;
    const RealMatrix now = m.axes(marker);
    const RealMatrix back = transpose(now);
    const RealVector reach = back * (m.origin(I) - m.origin(marker));  // to the point at which the force acts
    const std::int32_t column = row_of_balance(*m.paths, k);
    const RealVector moved =
        m.partial(column, 0, [&](const Moment& n) { return n.origin(marker) + n.axes(marker) * reach; });
    RealVector turned{};
    for (std::size_t c = 0; c < 3; ++c)
      turned += cross(now[c], m.partial(column, 0, [&](const Moment& n) { return n.axes(marker)[c]; })) * 0.5L;
    all.work[k] = (dot(f, moved) + dot(t, turned)) * (of_J ? -1 : 1);
  }
  return all;
}

// Forces that are wanted in the balances of both bodies, where they stand with a minus.
template <class Found>
void expect_balance(const Paths& p, const Found& found, const Balance& expected, bool on_J, const std::string& by) {
  for (std::size_t k = 0; k < balance_rows; ++k) {
    const std::int32_t row = row_of_balance(p, k);
    EXPECT_TRUE(agree(found(row), on_J || !is_of_J(k) ? -expected.work[k] : 0))
        << "balance of " << coordinate_name(p.layout, row) << (by.empty() ? "" : " by ") << by;
  }
}

template <class Function>
void expect_applied(const Paths& p, const PairForce& f, bool on_J, PartialBy family, const Function& of) {
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const Equations eq =
      assembled(p.layout, {PartialBy::position, family}, [&](Equations& e) { apply(pair, f, e, family); });
  expect_balance(
      p, [&](std::int32_t row) { return eq.residual()[static_cast<std::size_t>(row)]; }, of(p.now()), on_J, "");
  for (std::int32_t c = 0; c < p.layout.coordinate_count; ++c) {
    for (const std::size_t level : {0u, 1u}) {
      const ColumnMatrix& m = eq.matrix(level == 0 ? PartialBy::position : family);
      expect_balance(
          p, [&](std::int32_t row) { return entry(m, row, c); }, p.now().partial(c, level, of), on_J,
          coordinate_name(p.layout, c, level));
    }
  }
}

TEST(Pair, both_bodies_feel_the_force_with_its_lever_arms_and_their_changes) {
  Paths p;
  Law force = Law::drawn(p), torque = Law::drawn(p);
  force.on_w = torque.on_rate = Matrix3{};  // fewer differences
  const Wrench w{force, torque};
  const auto of = [&](const Moment& m) { return balance(m, w.force.at(m, I, J), w.torque.at(m, I, J)); };
  expect_applied(p, w.of(p), true, PartialBy::damping, of);
}

TEST(Pair, a_force_along_the_line_acts_on_both_bodies_and_goes_to_the_family_that_is_named) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const Line line;
  const auto of = [&](const Moment& m) { return balance(m, line.along(m), {}); };
  expect_applied(p, line.of(pair), true, PartialBy::velocity, of);
}

TEST(Pair, without_reaction_the_body_of_J_feels_nothing_but_moves_the_force) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const Line line;
  PairForce f = line.of(pair);
  f.reaction = Reaction::none;
  const auto of = [&](const Moment& m) { return balance(m, line.along(m), {}); };
  expect_applied(p, f, false, PartialBy::damping, of);
}

TEST(Pair, a_point_mass_takes_forces_and_no_moments_and_ground_nothing) {
  Paths p;
  const MarkerId on_mass{6}, on_ground{1};
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(on_mass), p.layout.marker(on_ground));
  const PairForce f = Line{}.of(pair);
  const Equations eq = assembled(p.layout, {PartialBy::position, PartialBy::damping},
                                 [&](Equations& e) { apply(pair, f, e, PartialBy::damping); });
  for (std::int32_t r = 0; r < p.layout.coordinate_count; ++r) {
    const bool own = r >= 12 && r < 15;
    EXPECT_EQ(eq.residual()[static_cast<std::size_t>(r)], own ? -f.force[static_cast<std::size_t>(r - 12)] : 0);
    for (std::int32_t c = 0; c < p.layout.coordinate_count; ++c) {
      const bool both = own && c >= 12 && c < 15;
      const auto at = [&](const MarkerPartials& by) {
        return both ? -by.origin_I(static_cast<std::size_t>(r - 12), static_cast<std::size_t>(c - 12)) : 0;
      };
      EXPECT_EQ(entry(eq.matrix(PartialBy::position), r, c), at(f.force_on_position));
      EXPECT_EQ(entry(eq.matrix(PartialBy::damping), r, c), at(f.force_on_velocity));
    }
  }
}

TEST(Pair, a_scalar_unknown_scales_what_acts_on_both_bodies) {
  Paths p;
  const ElementLabel owner{"SFORCE", 1, {}, {}};
  p.layout.add_algebraic(owner);
  p.layout.add_algebraic(owner);
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const Vector f = p.vector(), t = p.vector();
  const Balance expected = balance(p.now(), real(f), real(t));
  for (const bool on_J : {true, false}) {
    const Equations eq = assembled(p.layout, {PartialBy::algebraic}, [&](Equations& e) {
      apply_column(pair, f, t, on_J ? Reaction::at_I : Reaction::none, PartialBy::algebraic, 1, e);
    });
    const ColumnMatrix& m = eq.matrix(PartialBy::algebraic);
    expect_balance(
        p, [&](std::int32_t row) { return entry(m, row, 1); }, expected, on_J, "its unknown");
    expect_balance(
        p, [&](std::int32_t row) { return entry(m, row, 0); }, {}, on_J, "another unknown");
  }
}

// A force on the pair I, J that another pair decides: its own lever arms do not move.
TEST(Pair, a_force_decided_by_another_pair_has_partials_by_the_bodies_of_that_one) {
  Paths p;
  const MarkerId other_I{8}, other_J{6};  // PART/5 and POINT_MASS/4
  Wrench w{Law::drawn(p), Law::drawn(p), other_I, other_J};
  w.force.on_w = w.torque.on_rate = Matrix3{};
  const PairMotion acting = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const PairForce f = w.of(p);
  const Equations eq = assembled(p.layout, {PartialBy::position, PartialBy::damping}, [&](Equations& e) {
    apply_cross_partials(acting, w.motion(p), f, e, PartialBy::damping);
  });
  const auto of = [&](const Moment& m) {
    return balance(m, w.force.at(m, other_I, other_J), w.torque.at(m, other_I, other_J));
  };
  EXPECT_THAT(eq.residual(), ::testing::Each(0.0));
  for (std::int32_t c = 0; c < p.layout.coordinate_count; ++c) {
    for (const std::size_t level : {0u, 1u}) {
      const ColumnMatrix& m = eq.matrix(level == 0 ? PartialBy::position : PartialBy::damping);
      const bool counts = c >= 12 && c < 21;
      expect_balance(
          p, [&](std::int32_t row) { return entry(m, row, c); }, counts ? p.now().partial(c, level, of) : Balance{},
          true, coordinate_name(p.layout, c, level));
    }
  }
}

TEST(Pair, a_wrench_that_turns_with_the_axes_of_a_marker_has_partials_by_all_that_turns_them) {
  Paths p;
  const Vector f = p.vector(), t = p.vector();
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  // On a rigid body, on one that changes its shape, and on a point mass, which has no rotation.
  for (const MarkerId third : {MarkerId{8}, MarkerId{4}, MarkerId{6}}) {
    // f and t are fixed in these axes, so δf = δφ × f; the pair itself stays as it is.
    const Equations eq = assembled(p.layout, {PartialBy::position}, [&](Equations& e) {
      apply_turn(pair, p.layout.marker(third), -skew(f), -skew(t), e);
    });
    const RealMatrix back = transpose(p.now().axes(third));
    const auto of = [&](const Moment& m) {
      const RealMatrix moved = m.axes(third) * back;
      return balance(p.now(), moved * real(f), moved * real(t));
    };
    const ColumnMatrix& m = eq.matrix(PartialBy::position);
    for (std::int32_t c = 0; c < p.layout.coordinate_count; ++c) {
      expect_balance(
          p, [&](std::int32_t row) { return entry(m, row, c); }, p.now().partial(c, 0, of), true,
          coordinate_name(p.layout, c));
    }
  }
}

// c·d + e·x as seen from J: δx = δφ × x.
struct Row {
  Vector c, e;
  Real at(const Moment& m) const {
    return dot(real(c), transpose_times(m.axes(J), m.origin(I) - m.origin(J))) +
           dot(real(e), transpose_times(m.axes(J), m.axes(I).x));
  }
};

TEST(Pair, the_gradient_of_a_row_reaches_both_bodies_at_all_levels) {
  Paths p;
  const ElementLabel owner{"JOINT", 1, {}, {}};
  p.layout.add_row(owner, "other");
  p.layout.add_row(owner, "row");
  const Row row{p.vector(), p.vector()};
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  ConstraintRows rows;
  rows.resize(p.layout);
  rows.begin();
  const auto fixed = [](const Vector& v) { return along_motion(v, {}, {}); };
  add_gradient(1, pair, fixed(row.c), cross(pair.relative.x, fixed(row.e)), rows);
  EXPECT_TRUE(rows.row(0).empty());
  for (std::int32_t c = 0; c < p.layout.coordinate_count; ++c) {
    const RowCoefficients k = coefficients(rows, 1, c);
    const auto gradient = [&](const Moment& m) { return m.partial(c, 0, [&](const Moment& n) { return row.at(n); }); };
    const std::string by = coordinate_name(p.layout, c);
    EXPECT_TRUE(agree(k.g, gradient(p.now()))) << by;
    EXPECT_TRUE(agree(k.v, p.now().rate(gradient))) << by;
    EXPECT_TRUE(agree(k.a1, 2 * p.now().rate(gradient))) << by;
    EXPECT_TRUE(agree(k.a0, p.now().second_rate(gradient))) << by;
  }
}

TEST(Pair, partials_of_one_equation_reach_both_bodies) {
  Paths p;
  const ElementLabel owner{"VARIABLE", 1, {}, {}};
  p.layout.add_algebraic(owner);
  const Row row{p.vector(), p.vector()};
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const std::int32_t at = p.layout.coordinate_count;
  const Equations eq = assembled(p.layout, {PartialBy::position}, [&](Equations& e) {
    add_partials(at, pair, row.c, cross(value(pair.relative.x), row.e), PartialBy::position, e);
  });
  for (std::int32_t c = 0; c < p.layout.coordinate_count; ++c) {
    EXPECT_TRUE(agree(entry(eq.matrix(PartialBy::position), at, c), p.now().partial(c, 0, [&](const Moment& m) {
      return row.at(m);
    }))) << coordinate_name(p.layout, c);
  }
}

// What is noted of a force and torque on I: along axes that stay, about the point where the origin of I was.
template <class Force, class Torque>
void expect_noted(const Paths& p, const ElementTrace& trace, const Force& force, const Torque& torque) {
  ASSERT_EQ(trace.laws.size(), 1u);
  const ElementTrace::Law& law = trace.laws.front();
  EXPECT_EQ(law.element, 0u);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(agree(dot(law.axes[r], law.axes[c]), r == c ? 1 : 0));
  }
  const RealVector origin = p.now().origin(I);
  expect_near(law.origin, origin, "origin");
  expect_near(law.force, force(p.now()), "force");
  expect_near(law.torque, torque(p.now()), "torque");
  const RealMatrix back = transpose(real(law.axes));
  for (const ElementTrace::Law::Partial& by : law.partials) {
    const std::size_t level = by.family == PartialBy::damping ? 1 : 0;
    const RealVector f = p.now().partial(by.column, level, [&](const Moment& m) { return back * force(m); });
    const RealVector t = p.now().partial(
        by.column, level, [&](const Moment& m) { return back * (torque(m) + cross(m.origin(I) - origin, force(m))); });
    const std::string column = coordinate_name(p.layout, by.column, level);
    for (std::size_t r = 0; r < 3; ++r) {
      EXPECT_TRUE(agree(by.value[r], f[r])) << "force " << r << " by " << column;
      EXPECT_TRUE(agree(by.value[3 + r], t[r])) << "torque " << r << " by " << column;
    }
  }
}

TEST(Pair, a_law_is_noted_in_axes_of_its_own) {
  Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  ElementTrace trace;
  for (const Line& line : {Line{}, Line{.e = 0}}) {
    trace.clear();
    note_line(pair, line.magnitude(norm(pair.delta)), 0, p.layout, trace);
    expect_noted(
        p, trace, [&](const Moment& m) { return line.along(m); }, [](const Moment&) { return RealVector{}; });
    EXPECT_EQ(trace.laws.front().partials.size(), line.e != 0 ? 36u : 18u);
    EXPECT_TRUE(agree(norm(cross(trace.laws.front().axes.x, value(pair.delta))), 0)) << "the first is the line";
  }
  const Wrench w{Law::drawn(p), Law::drawn(p)};
  trace.clear();
  note_law(pair, w.in_axes_of_J(pair), {}, p.layout, trace);
  expect_noted(
      p, trace, [&](const Moment& m) { return w.force.at(m, I, J); },
      [&](const Moment& m) { return w.torque.at(m, I, J); });
  EXPECT_EQ(trace.laws.front().partials.size(), 36u);
}

TEST(Pair, a_force_that_is_rounding_is_noted_as_none) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  ElementTrace trace;
  trace.clear();
  RelativeWrench w;
  w.force = {1e-9, -2e-9, 3e-9}, w.torque = {-1e-9, 2e-9, 3e-9};
  note_law(pair, w, {1e-9, 1e-9, 5e-9, 0, 2e-9, 2e-9}, p.layout, trace);
  const Matrix3 R = value(pair.axes_J);
  expect_near(trace.laws[0].force, real(R * Vector{0, -2e-9, 0}), "force");
  expect_near(trace.laws[0].torque, real(R * Vector{-1e-9, 0, 3e-9}), "torque");
  for (const double magnitude : {1e-9, -1e-9, 1.1e-9}) {
    trace.clear();
    note_line(pair, {magnitude, -5, 0}, 1e-9, p.layout, trace);
    EXPECT_EQ(norm(trace.laws[0].force) == 0, std::abs(magnitude) <= 1e-9) << magnitude;
  }

  const double rounding = rounding_of_force(1e14, 0);
  EXPECT_NEAR(rounding, 0.178, 0.001);
  EXPECT_EQ(rounding_of_force(1e14, 0.2), rounding);
  EXPECT_EQ(rounding_of_force(1e14, -0.1), 0) << "stated, and as small";
}

}  // namespace
}  // namespace dynalin::mechanics_test::pair_test
