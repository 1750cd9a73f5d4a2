// A tower crane at work (tests/foreign): constraints by functions, one of them on velocities, forces by a compiled
// routine, controllers; on its way, at rest with the brake on, and at work in three directions at once. In motion a
// linear model is one of its coordinates: those of the answer are the PSTATE of the dataset.
#include "cases/foreign_crane.h"

#include <gmock/gmock.h>

#include "cases/extrapolation.h"
#include "cases/foreign.h"

namespace dynalin::cases::newton_euler::foreign_crane_test {
namespace {

using namespace foreign_crane;
using Json = nlohmann::json;

class ForeignCrane : public Foreign {
 protected:
  static Vec3 extended(const Json& v) { return vector(v).cast<Real>(); }
  static Mat3 axes(const Json& body) {
    Mat3 R;
    for (Eigen::Index k = 0; k < 3; ++k) R.col(k) = extended(body.at("axes").at(static_cast<std::size_t>(k)));
    return R;
  }
  // The rate of ATAN2(y, x).
  static Real turning(Real x, Real y, Real dx, Real dy) { return (x * dy - y * dx) / (x * x + y * y); }
  static VecX point(const Json& result, const Crane& crane) {
    const Json& at = result.at("operating_point");
    const auto value = [&](const std::string& variable) -> Real {
      for (const Json& v : at.at("variables")) {
        if (v.at("element") == "VARIABLE/" + variable) return v.at("value").get<double>();
      }
      throw std::runtime_error(variable);
    };
    const auto velocity = [&](const char* body) { return extended(body_of(result, body).at("velocity")); };
    const auto spin = [&](const char* body) { return extended(body_of(result, body).at("angular_velocity")); };
    VecX x = VecX::Zero(2 * coordinates + controllers);
    const std::array order = {"37", "51", "52", "53", "54", "55", "63", "56", "57", "58", "59", "60", "61", "62"};
    for (std::size_t k = 0; k < order.size(); ++k) x(static_cast<Eigen::Index>(k)) = value(order[k]);
    x(hook_at + 2) -= height;
    const Mat3 R = axes(body_of(result, "PART/2")), J = axes(body_of(result, "PART/3")),
               P = axes(body_of(result, "PART/9"));
    const Vec3 whirl = spin("PART/3"), along = spin("PART/2").cross(R.col(0)), over = spin("PART/9").cross(P.col(2)),
               round = spin("PART/9").cross(P.col(0)),
               far = extended(body_of(result, "PART/4").at("position")) -
                     extended(body_of(result, "PART/3").at("position"));
    auto rate = x.segment<coordinates>(coordinates);
    rate.head<2>() = velocity("PART/2").head<2>();
    rate(twist) = turning(R(0, 0), R(1, 0), along.x(), along.y());
    rate(slew) = R.col(2).dot(whirl - spin("PART/2"));
    rate(trolley) = J.col(0).dot(velocity("PART/4") - velocity("PART/3") - whirl.cross(far));
    rate(winch) = J.col(1).dot(spin("PART/5") - whirl), rate(hoist) = J.col(1).dot(spin("PART/7") - whirl);
    rate(motor) = J.col(1).dot(spin("PART/10") - whirl);
    rate.segment<3>(hook_at) = velocity("POINT_MASS/8");
    rate.tail<3>() =
        Vec3(turning(P(2, 2), -P(1, 2), over.z(), -over.y()), turning(P(2, 2), P(0, 2), over.z(), over.x()),
             turning(P(0, 0), P(1, 0), round.x(), round.y()));
    for (const Json& s : at.at("states")) {
      const std::string element = s.at("element");
      const Eigen::Index k = element == "DIFF/1"   ? slewing_error
                             : element == "DIFF/2" ? current
                             : element == "DIFF/3" ? gust
                             : s.at("number") == 1 ? trolley_error
                                                   : filtered;
      x(2 * coordinates + k) = s.at("value").get<double>();
    }
    return crane.reduced(x);
  }
  static void expect_linear(const Json& modes, const Json& matrices, const Crane& crane) {
    const Real t = modes.at("operating_point").at("time").get<double>();
    const VecX x = point(modes, crane);
    const MatX A = crane.by_state(&Crane::rates, x, t);
    expect_spectrum(modes, spectrum(A), 1e-8, 1e-15);
    if (matrices.is_null()) return;
    const MatX B = crane.by_input(&Crane::rates, x, t), C = crane.by_state(&Crane::outputs, x, t),
               D = crane.by_input(&Crane::outputs, x, t);
    expect_answers(matrices, A, B, C, D);
  }
  // Inputs that an output hardly answers to are held against those that it does.
  static void expect_answers(const Json& matrices, const MatX& A, const MatX& B, const MatX& C, const MatX& D) {
    const auto given = [&](const char* name) -> MatX { return matrix(matrices, name).cast<Real>(); };
    for (const Real hz : {0.03L, 0.14L, 0.6L, 1.7L, 4.0L, 15.0L}) {
      const Eigen::MatrixXcd ours = response(given("A"), given("B"), given("C"), given("D"), hz),
                             theirs = response(A, B, C, D, hz);
      ASSERT_EQ(ours.rows(), theirs.rows());
      ASSERT_EQ(ours.cols(), theirs.cols());
      for (Eigen::Index i = 0; i < ours.rows(); ++i) {
        for (Eigen::Index k = 0; k < ours.cols(); ++k) {
          EXPECT_LE(std::abs(ours(i, k) - theirs(i, k)),
                    1e-6 * std::abs(theirs(i, k)) + 1e-9 * theirs.row(i).cwiseAbs().maxCoeff())
              << hz << " cycles, output " << i << ", input " << k << ": " << ours(i, k) << " beside " << theirs(i, k);
        }
      }
    }
  }
  // Of outputs and some coordinates, as a part of what they are like.
  static void expect_way(const Json& result, const VecX& start, const Crane& crane, double relative) {
    const Json& history = result.at("history");
    VecX x = start;
    Real t = history.at("times").front().get<double>();
    const VecX none = VecX::Zero(3);
    for (std::size_t k = 0; k < history.at("times").size(); ++k) {
      const Real end = history.at("times").at(k).get<double>();
      while (t < end) {
        const Real h = std::min(0.05L, end - t);
        x = extrapolated_step([&](const VecX& y, Real s) { return crane.rates(y, none, s); }, x, t, h);
        t += h;
      }
      t = end;
      const NewtonEuler::State s = crane.state(x, t);
      const VecX y = crane.outputs(x, none, t);
      const auto expect = [&](const char* variable, Real value, double scale) {
        EXPECT_NEAR(history.at("variables").at(variable).at(k).get<double>(), static_cast<double>(value),
                    relative * scale)
            << "VARIABLE/" << variable << " at " << static_cast<double>(t);
      };
      expect("31", y(0), 100), expect("32", y(1), 100), expect("33", y(2), 20), expect("34", y(3), 1000);
      expect("35", y(4), 1), expect("37", s.q(lean_x), 10), expect("38", s.bodies[panel].p.z() + height, 100);
      expect("39", s.z(gust), 500);
    }
  }
};

TEST_F(ForeignCrane, crane) {
  SessionOptions options;
  options.user_libraries = {foreign_routines().string()};
  const RunResult r = run_foreign("crane", options);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto ways = all_with(r, "history"), modes = all_with(r, "eigenvalues"), matrices = all_with(r, "A");
  ASSERT_EQ(ways.size(), 2u);
  ASSERT_EQ(modes.size(), 4u);
  ASSERT_EQ(matrices.size(), 3u);
  Crane crane;

  // As stated.
  const VecX start = point(*modes[0], crane);
  VecX stated = VecX::Zero(2 * coordinates + controllers);
  stated(slew) = pi_l / 90, stated(motor) = -0.95L;
  stated.segment<3>(hook_at) = Vec3(1800, 0, 2487.4L - height);
  stated(coordinates + slew) = 0.02L, stated(coordinates + trolley) = 4, stated(coordinates + winch) = 0.5L;
  stated(coordinates + motor) = 3, stated(coordinates + hook_at) = 2, stated(coordinates + hook_at + 1) = 10;
  stated(coordinates + panel_turn + 2) = 0.05L;
  stated(2 * coordinates + gust) = 350, stated(2 * coordinates + trolley_error) = 1.5L,
                           stated(2 * coordinates + filtered) = 4;
  EXPECT_LE((start - crane.reduced(stated)).norm(), 5e-5L);
  expect_linear(*modes[0], *matrices[0], crane);
  expect_way(*ways[0], start, crane, 1e-7);
  expect_linear(*modes[1], nullptr, crane);

  crane.geared = false;
  const VecX hangs = point(*modes[2], crane), found = crane.rest(hangs, 0);
  EXPECT_LE((found - hangs).norm(), 1e-8L * hangs.norm());
  expect_linear(*modes[2], *matrices[1], crane);

  crane.geared = crane.at_work = true;
  expect_way(*ways[1], point(*matrices[1], crane), crane, 1e-7);
  expect_linear(*modes[3], *matrices[2], crane);
  // What holds the panel at the hook.
  const VecX x = point(*modes[3], crane);
  const NewtonEuler::State s = crane.state(x, 3.5L);
  Vec3 held = Vec3::Zero();
  for (const Json& reaction : modes[3]->at("operating_point").at("reactions")) {
    if (reaction.at("element").get<std::string>().starts_with("GCON/")) held += extended(reaction.at("global_force"));
  }
  const Vec3 expected = 2000 / kilonewton * (crane.panel_acceleration(x, 3.5L) + Vec3(0, 0, gravity)) - Crane::wind(s) -
                        Crane::tag_line(s);
  EXPECT_LE((held - expected).norm(), 1e-8L * expected.norm());
}

}  // namespace
}  // namespace dynalin::cases::newton_euler::foreign_crane_test
