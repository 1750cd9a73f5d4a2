// CABLE against closed forms and against springs.
#include <numbers>

#include "cases/chain.h"
#include "cases/study_of.h"

namespace dynalin::cases::cable_test {
namespace {

class Cables : public Cases {
 protected:
  RunResult solve(const std::string& text, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    return run("Cables\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\n" + text + "END\n", commands);
  }
};

// A ring between two hooks, its three frequencies as the page of the statement derives them.
TEST_F(Cables, ring_swings_in_all_directions) {
  const double b = 3, h = 4, l = 5, m = 2, K = 50, C = 0.3, T = m * 9.81 * l / (2 * h);
  const RunResult r = solve(fmt::format(
      "MARKER/1, QP=-3,0,4\nMARKER/2, QP=3,0,4\nPOINT_MASS/2, MASS=2, CM=3\nMARKER/3\nCABLE/1, MARKERS=1,3,2, K={}, "
      "C={}, LENGTH=9, FORCE={:.17g}\n",
      K, C, T - K));
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.eigenvalues(0);
  ASSERT_EQ(values.size(), 6u);
  const double tau = 2 * std::numbers::pi;
  const double along = 2 * T * h * h / (l * l * l), aside = 2 * T / l;
  const double up = 4 * K * h * h / (l * l) + 2 * T * b * b / (l * l * l), damping = C * 4 * h * h / (l * l);
  EXPECT_NEAR(std::abs(values[0].imag()) * tau, std::sqrt(along / m), 1e-11);
  EXPECT_NEAR(std::abs(values[2].imag()) * tau, std::sqrt(aside / m), 1e-11);
  EXPECT_NEAR(std::abs(values[4]) * tau, std::sqrt(up / m), 1e-10);
  EXPECT_NEAR(values[4].real() * tau, -damping / (2 * m), 1e-11);
}

// A body on two markers next to each other, which a third part of the cable passes: 2:1 tackle. The load moves at half
// the speed of the cable's end, so that it feels four times K.
TEST_F(Cables, tackle_multiplies_stiffness) {
  const RunResult r = solve(
      "MARKER/1, QP=-0.1,0,5\nMARKER/2, QP=0.1,0,5\nMARKER/9\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
      "MARKER/21, QP=-0.1,0,0\nMARKER/22, QP=0.1,0,0\nJOINT/1, TRANSLATIONAL, I=20, J=9\n"
      "CABLE/1, MARKERS=1,21,22,2, K=50, LENGTH=10.2, FORCE=9.81\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.eigenvalues(0);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(std::abs(values[0].imag()), std::sqrt(4 * 50 / 2.0) / (2 * std::numbers::pi), 1e-12);
}

TEST_F(Cables, of_two_markers_is_a_spring_that_pulls) {
  const std::string bodies =
      "MARKER/1, QP=0.3,0.2,2\nMARKER/9\nPART/2, MASS=2, CM=20, IP=1,2,3, QG=0.1,0,0.4, REULER=0.3,0.5,0.2\nMARKER/20\n"
      "MARKER/21, QP=0.2,-0.3,0.1\nJOINT/1, SPHERICAL, I=20, J=8\nMARKER/8, PART=1, QP=0.1,0,0.4\n";
  const auto eigenvalues = [&](const std::string& force) {
    const RunResult r = solve(bodies + force, "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(0) : std::vector<std::complex<double>>();
  };
  const auto spring = eigenvalues("SPRINGDAMPER/1, TRANSLATIONAL, I=21, J=1, K=30, C=0.8, LENGTH=1.1, FORCE=-4\n");
  const auto cable = eigenvalues("CABLE/1, MARKERS=1,21, K=30, C=0.8, LENGTH=1.1, FORCE=4\n");
  ASSERT_EQ(spring.size(), 6u);
  ASSERT_EQ(cable.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(std::abs(cable[k] - spring[k]), 0, 1e-12);
}

TEST_F(Cables, slack_ones_exert_nothing) {
  const auto hung = [&](double length) {
    return solve(
        fmt::format("MARKER/1, QP=0,0,2\nMARKER/9\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2\n"
                    "SFORCE/1, TRANSLATIONAL, I=2, J=9, ACTIONONLY, FUNCTION=9.81-3*DZ(2,9)\n"
                    "CABLE/1, MARKERS=1,2, K=100, LENGTH={}\n",
                    length));
  };
  const RunResult slack = hung(2.5);
  ASSERT_EQ(slack.status, 0) << slack.err;
  const auto values = slack.eigenvalues(0);
  EXPECT_NEAR(std::abs(values.back().imag()), std::sqrt(3.0) / (2 * std::numbers::pi), 1e-12);
  // At the edge as slack.
  const RunResult edge = hung(2);
  ASSERT_EQ(edge.status, 0) << edge.err;
  EXPECT_EQ(edge.eigenvalues(0), values);
}

// The pattern of the equations is that of a taut cable, whatever it is at first.
TEST_F(Cables, slack_at_first_carry_in_the_end) {
  const RunResult hung = solve(
      "MARKER/1, QP=0,0,5\nMARKER/9\nPART/2, MASS=2, CM=2, IP=1,1,1\nMARKER/2\nJOINT/1, TRANSLATIONAL, I=2, J=9\n"
      "CABLE/1, MARKERS=1,2, K=100, C=2, LENGTH=5.5\n",
      "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(hung.status, 0) << hung.err;
  const auto place = hung.result(0).at("operating_point").at("bodies").at(0).at("position");
  EXPECT_NEAR(place.at(2).get<double>(), 5 - 5.5 - 2 * 9.81 / 100, 1e-9);
  EXPECT_NEAR(std::abs(hung.eigenvalues(1).at(0)), std::sqrt(100 / 2.0) / (2 * std::numbers::pi), 1e-9);
  // A boom on a ball and a block on a bushing, joined to the ground by one cable: all of it slack as drawn.
  const RunResult boom = solve(
      "MARKER/1\nMARKER/2, QP=0.5,0.2,3\nPART/2, MASS=3, CM=22, IP=0.2,0.2,0.2\nMARKER/22, QP=0.6,0,0\nMARKER/20\n"
      "MARKER/21, QP=1.2,0,0\nJOINT/1, SPHERICAL, I=20, J=1\nPART/3, MASS=2, CM=30, IP=0.3,0.3,0.3, QG=1.6,0.4,0.1\n"
      "MARKER/30\nMARKER/3, PART=1, QP=1.6,0.4,0.1\nBUSHING/1, I=30, J=3, K=60,70,80, KT=9,9,9\n"
      "CABLE/1, MARKERS=2,21,30, K=40, C=1, LENGTH=5\n",
      "SIMULATE/STATICS\n");
  ASSERT_EQ(boom.status, 0) << boom.err;
  double tension = 0;
  for (const auto& load : boom.result(0).at("operating_point").at("forces")) {
    if (load.at("element") != "CABLE/1") continue;
    const auto f = load.at("global_force").get<std::vector<double>>();
    tension = std::hypot(f[0], f[1], f[2]);
  }
  EXPECT_GT(tension, 1);
}

// A mass dropped on a slack cable falls freely for d, then the cable stretches until m g (d + s) = K s²/2.
TEST(CablesInTime, catch_what_falls) {
  const double K = 200, d = 0.5, g = 9.81, rest = g / K, w = std::sqrt(K), speed = std::sqrt(2 * g * d);
  const double stretch = rest + std::hypot(rest, speed / w);
  library::SimulationRequest request;
  request.end = std::sqrt(2 * d / g) + (std::numbers::pi - std::atan2(speed, w * rest)) / w;
  request.error = 1e-9;
  const auto study = study_of(
      "Dropped\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1, "
      "QG=0,0,-0.5\nMARKER/2\nJOINT/1, TRANSLATIONAL, I=2, J=1\nCABLE/1, MARKERS=1,2, K=200, LENGTH=1\nEND\n");
  const auto lowest = study.simulate(request);
  const BodyState body = lowest.point.state().bodies.at(0);
  EXPECT_NEAR(body.position[2], -1 - stretch, 1e-6);
  EXPECT_NEAR(body.velocity[2], 0, 1e-5);
  EXPECT_GE(lowest.statistics.restarts, 1);
}

TEST_F(Cables, wants_markers_on_bodies_that_can_move_apart) {
  const std::string body = "MARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\nMARKER/3\nMARKER/4, FLOATING\n";
  for (const auto& [cable, code] :
       std::initializer_list<std::pair<std::string, std::string>>{{"CABLE/1, MARKERS=2, K=1", "wrong-count"},
                                                                  {"CABLE/1, MARKERS=2,3, K=1", "same-body"},
                                                                  {"CABLE/1, MARKERS=1,4, K=1", "floating-marker"},
                                                                  {"CABLE/1, MARKERS=1,7, K=1", "unknown"},
                                                                  {"CABLE/1, MARKERS=1,2, K=-1", "value-out-of-range"},
                                                                  {"CABLE/1, MARKERS=1,2", "missing-argument"}}) {
    const RunResult r = solve(body + cable + "\n");
    EXPECT_EQ(r.status, 1) << cable;
    EXPECT_NE(r.err.find(code), std::string::npos) << cable << '\n' << r.err;
  }
}

}  // namespace
}  // namespace dynalin::cases::cable_test
