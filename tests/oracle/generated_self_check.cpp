// The oracle against itself on generated mechanisms, and what they contain.
#include <cstdio>
#include <string>

#include "places/draws.h"
#include "self_check.h"

namespace dynalin::oracle::generated_self_check {
namespace {

// The point a short time along its own motion. Terms even in h are wrong from h^2 on and cancel in a
// central difference.
OraclePoint advanced(const OraclePoint& point, const OracleLinearModel& at, double h) {
  OraclePoint next = point;
  for (std::size_t b = 0; b < next.bodies.size(); ++b) {
    BodyPoint& body_point = next.bodies[b];
    const Vec v = to_vec(body_point.velocity), w = to_vec(body_point.angular_velocity);
    const Vec a = to_vec(at.accelerations[b].acceleration);
    const Vec al = to_vec(at.accelerations[b].angular_acceleration);
    const Real step = h;
    body_point.position = to_triple(to_vec(body_point.position) + step * v + (step * step / 2) * a);
    const Mat turn = rotation_exponential(step * w + (step * step / 2) * al);
    const auto& R = body_point.rotation;
    const Mat rotated = transpose(turn * transpose(Mat{{to_vec(R[0]), to_vec(R[1]), to_vec(R[2])}}));
    for (std::size_t k = 0; k < 3; ++k) body_point.rotation[k] = to_triple(rotated.column[k]);
    body_point.velocity = to_triple(v + step * a);
    body_point.angular_velocity = to_triple(w + step * al);
  }
  for (std::size_t k = 0; k < next.z.size(); ++k) next.z[k].value += h * at.differential_rates[k];
  return next;
}

// Rates of the states, in the sense of the motion itself: velocities and accelerations of the chosen
// components, rates of the differential states.
std::vector<double> rates_along(const OraclePoint& point, const OracleLinearModel& at,
                                const std::vector<ChosenState>& states) {
  std::vector<double> result;
  for (const ChosenState& s : states) {
    if (s.kind == Kind::differential) {
      for (std::size_t k = 0; k < point.z.size(); ++k) {
        const DifferentialPoint& d = point.z[k];
        if (d.element == s.element && d.element_id == s.element_id && d.index == s.index) {
          result.push_back(at.differential_rates[k]);
        }
      }
      continue;
    }
    for (std::size_t b = 0; b < point.bodies.size(); ++b) {
      const BodyPoint& p = point.bodies[b];
      if (p.body_id != s.body_id || p.body_kind != s.body_kind) continue;
      const auto c = static_cast<std::size_t>(s.coordinate % 3);
      const BodyAcceleration& acceleration = at.accelerations[b];
      const Triple& velocity = s.coordinate < 3 ? p.velocity : p.angular_velocity;
      const Triple& second = s.coordinate < 3 ? acceleration.acceleration : acceleration.angular_acceleration;
      result.push_back(s.kind == Kind::coordinate ? velocity[c] : second[c]);
    }
  }
  return result;
}

// Shifting the motion in time is a variation: it has y = (v, w) dt exactly to first order, so A times the
// rates of the states is the rate of those rates, jerk included. This sees every term of the spatial
// kinematics and needs no closed form. TIME and motions would add a partial derivative of their own.
TEST(Oracle, state_matrix_times_the_motion_is_the_jerk) {
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 200 && checked < draws(25, 12); ++seed) {
    Mechanism m = random_mechanism(seed);
    const std::string text = dataset_text(m);
    if (!m.motions.empty() || text.find("TIME", text.find("ACCGRAV")) != std::string::npos) continue;
    if (text.find("PINVAL") != std::string::npos) continue;  // it names the PINPUT that is taken away here
    m.pinput = {};                                           // inputs keep their own expressions, as along the motion
    SCOPED_TRACE(seed);
    ++checked;
    const OraclePoint point = drawn_point(m);
    const std::vector<ChosenState> states = choose_states(m, point);
    const OracleLinearModel here = oracle_linearize(m, point, states);
    const std::vector<double> rates = rates_along(point, here, states);
    const double h = 2e-7;
    const OraclePoint after = advanced(point, here, h), before = advanced(point, here, -h);
    const std::vector<double> up = rates_along(after, oracle_linearize(m, after, states), states);
    const std::vector<double> down = rates_along(before, oracle_linearize(m, before, states), states);
    double scale = 1;
    std::vector<double> predicted(states.size(), 0), seen(states.size(), 0);
    for (std::size_t i = 0; i < states.size(); ++i) {
      seen[i] = (up[i] - down[i]) / (2 * h);
      scale = std::max(scale, std::fabs(seen[i]));
      for (std::size_t j = 0; j < states.size(); ++j) predicted[i] += here.A[i][j] * rates[j];
    }
    for (std::size_t i = 0; i < states.size(); ++i) EXPECT_NEAR(predicted[i], seen[i], 1e-6 * scale) << i;
  }
  EXPECT_GE(checked, 10);
}

TEST(Oracle, dataset_repeats_for_a_seed_and_is_complete) {
  const std::string text = dataset_text(random_mechanism(7));
  EXPECT_EQ(text, dataset_text(random_mechanism(7)));
  EXPECT_NE(text, dataset_text(random_mechanism(8)));
  EXPECT_EQ(text.substr(0, 24), "Random mechanism, seed 7");
  EXPECT_EQ(text.substr(text.size() - 4), "END\n");
}

// Agreement linearizes all of them and asks for 1e-9: here a sample of what the oracle is capable of.
TEST(Oracle, seeds_are_varied_and_every_fourth_is_accurate) {
  int loops = 0, two_loops = 0, massless = 0, points = 0, motions = 0, states = 0, accelerations = 0;
  int reactions = 0, deep = 0, algebraic = 0, units = 0, rolling = 0, unknowns = 0, relations = 0, wanted = 0;
  int points_on = 0, curves_on = 0;
  double worst = 0;
  const auto seeds = drawn_seeds(1, 200);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    if (seed % 4 == 1) {
      const OraclePoint point = drawn_point(m);
      const OracleLinearModel r = oracle_linearize(m, point, choose_states(m, point));
      EXPECT_LT(r.error_estimate, 1e-11);
      EXPECT_LT(r.polish, 1e-12);
      worst = std::max(worst, r.error_estimate);
    }
    const Features f = features_of(m);
    loops += f.loops > 0 ? 1 : 0;
    two_loops += f.loops > 1 ? 1 : 0;
    massless += f.massless > 0 ? 1 : 0;
    points += f.point_masses > 0 ? 1 : 0;
    motions += f.motions > 0 ? 1 : 0;
    states += f.differential_states > 0 ? 1 : 0;
    accelerations += f.force_reads_acceleration ? 1 : 0;
    reactions += f.force_reads_reaction ? 1 : 0;
    algebraic += f.algebraic_loop ? 1 : 0;
    units += f.units_factor ? 1 : 0;
    deep += f.deep_reaction ? 1 : 0;
    rolling += f.velocity_constraints > 0 ? 1 : 0;
    unknowns += f.algebraic_diffs > 0 ? 1 : 0;
    relations += m.couplers.empty() && m.gears.empty() ? 0 : 1;
    wanted += m.pstate.id != 0 ? 1 : 0;
    points_on += f.points_on_curves > 0 ? 1 : 0;
    curves_on += f.curves_on_curves > 0 ? 1 : 0;
  }
  std::printf("of %zu: %d loops (%d two), %d massless, %d point masses, %d motions, %d control states\n", seeds.size(),
              loops, two_loops, massless, points, motions, states);
  std::printf("        %d forces on accelerations, %d on reactions, %d algebraic loops, %d UCF other than 1\n",
              accelerations, reactions, algebraic, units);
  std::printf(
      "        %d velocity constraints, %d couplers or gears, %d algebraic DIFFs, %d deep reactions, %d PSTATE\n",
      rolling, relations, unknowns, deep, wanted);
  std::printf("        %d points on curves, %d curves on curves\n", points_on, curves_on);
  std::printf("        worst error estimate %.1e\n", worst);
  const double part = static_cast<double>(seeds.size()) / 200;
  EXPECT_GE(loops, 60 * part);
  EXPECT_GE(two_loops, 10 * part);
  EXPECT_GE(massless, 60 * part);
  EXPECT_GE(points, 30 * part);
  EXPECT_GE(motions, 60 * part);
  EXPECT_GE(states, 100 * part);
  EXPECT_GE(accelerations, 100 * part);
  EXPECT_GE(reactions, 100 * part);
  EXPECT_GE(algebraic, 60 * part);
  EXPECT_GE(units, 30 * part);
  EXPECT_GE(rolling, 40 * part);
  EXPECT_GE(relations, 30 * part);
  EXPECT_GE(unknowns, 60 * part);
  EXPECT_GE(deep, 20 * part);
  EXPECT_GE(wanted, 40 * part);
  EXPECT_GE(points_on, 25 * part);
  EXPECT_GE(curves_on, 12 * part);
}

}  // namespace
}  // namespace dynalin::oracle::generated_self_check
