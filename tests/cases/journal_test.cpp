// JOURNAL against the published figures of short bearings: load, attitude, the eight coefficients, and whirl.
#include <Eigen/Eigenvalues>

#include "cases/chain.h"

namespace dynalin::cases::journal_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double mu = 0.02, R = 0.05, L = 0.04, c = 0.0002, omega = 600;

// μ R L³ ω/c² times the number that the eccentricity gives.
double load_at(double e) {
  const double s2 = 1 - e * e;
  return mu * R * L * L * L * omega / (c * c) * e / (4 * s2 * s2) * std::sqrt(16 * e * e + pi * pi * s2);
}
double attitude_at(double e) { return std::atan2(pi * std::sqrt(1 - e * e), 4 * e); }

std::string bearing(const std::string& rest) {
  return fmt::format("JOURNAL/1, I=2, J=1, RADIUS={}, LENGTH={}, CLEARANCE={}, VISCOSITY={}{}\n", R, L, c, mu, rest);
}
// A rotor that only moves in the plane of the bearing, which may be turned about its axis, under a load along −y.
std::string rotor(double mass, double load, const std::string& rest, const std::string& start = "") {
  return fmt::format(
             "Rotor in a bearing\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={}\nPART/1, GROUND\nMARKER/1, REULER=0.7,0,0\n"
             "MARKER/3\nPART/2, MASS={}, CM=2, IP=0.01,0.01,0.02{}\nMARKER/2\nJPRIM/1, INPLANE, I=2, J=3\n",
             -load / mass, mass, start) +
         rest;
}
const std::string held = "JPRIM/2, ORIENTATION, I=2, J=3\n" + bearing(fmt::format(", SPEED={}", omega));

class Journals : public Cases {};

// Load, attitude and the eight coefficients, as published for short bearings with a π-film: a and b with v along the
// load and u across it.
TEST_F(Journals, have_the_published_coefficients_at_the_published_place) {
  for (const double e : {0.05, 0.3, 0.6, 0.9}) {
    const double W = load_at(e), mass = 3, s = std::sqrt(1 - e * e), e2 = e * e, pi2 = pi * pi;
    const RunResult r = run(rotor(mass, W, held, fmt::format(", QG={},{},0", 0.1 * c, -0.2 * c)) + "END\n",
                            "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const double h = 1 / std::pow(pi2 * (1 - e2) + 16 * e2, 1.5);
    const double a_uu = h * 4 * (pi2 * (2 - e2) + 16 * e2),
                 a_uv = h * pi * (pi2 * (1 - e2) * (1 - e2) - 16 * e2 * e2) / (e * s),
                 a_vu = -h * pi * (pi2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (e * s),
                 a_vv = h * 4 * (pi2 * (1 + 2 * e2) + 32 * e2 * (1 + e2) / (1 - e2));
    const double b_uu = h * 2 * pi * s * (pi2 * (1 + 2 * e2) - 16 * e2) / e,
                 b_uv = -h * 8 * (pi2 * (1 + 2 * e2) - 16 * e2),
                 b_vv = h * 2 * pi * (pi2 * (1 - e2) * (1 - e2) + 48 * e2) / (e * s);
    const double k = W / c / mass, d = W / (c * omega) / mass, w = std::sqrt(k);
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 2) = A(1, 3) = w;  // balanced: velocities by w
    A(2, 0) = -w * a_uu, A(2, 1) = -w * a_uv, A(3, 0) = -w * a_vu, A(3, 1) = -w * a_vv;
    A(2, 2) = -d * b_uu, A(2, 3) = A(3, 2) = -d * b_uv, A(3, 3) = -d * b_vv;
    const Eigen::Vector4cd published = A.eigenvalues() / (2 * pi);
    const auto found = r.eigenvalues(1);
    ASSERT_EQ(found.size(), 4u);
    for (const std::complex<double>& value : found) {
      double nearest = 1e300;
      for (int n = 0; n < 4; ++n) nearest = std::min(nearest, std::abs(value - published(n)));
      EXPECT_LT(nearest, 1e-9 * std::abs(value)) << e << ' ' << value;
    }
  }
}

// The torque is the drag of the film, 2π μ ω R³ L/(c s), and half of what the load does about the middle.
TEST_F(Journals, stand_where_the_load_is_carried) {
  for (const double e : {0.2, 0.7}) {
    const double W = load_at(e), at = attitude_at(e);
    const RunResult r =
        run(rotor(3, W, held) + "REQUEST/1, F2=DX(2,3)\\F3=DY(2,3)\\F4=FX(2,1)\\F6=FY(2,1)\\F7=TZ(2,1)\nEND\n",
            "SIMULATE/STATIC\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& request = r.result(0).at("operating_point").at("requests").at(0);
    ASSERT_EQ(request.at("components"), nlohmann::json::parse(R"(["F2", "F3", "F4", "F6", "F7"])"));
    const std::vector<double> values = request.at("values");
    EXPECT_NEAR(values[0], e * c * std::sin(at), 1e-9 * c);
    EXPECT_NEAR(values[1], -e * c * std::cos(at), 1e-9 * c);
    EXPECT_NEAR(values[2], 0, 1e-9 * W);
    EXPECT_NEAR(values[3], W, 1e-9 * W);
    const double drag = 2 * pi * mu * omega * R * R * R * L / (c * std::sqrt(1 - e * e));
    EXPECT_NEAR(values[4], -drag - 0.5 * e * c * std::sin(at) * W, 1e-9 * drag);
  }
}

// The shaft turns itself; the film is sheared by 2π μ ω R³ L/(c s) and half of what the load does about the middle.
TEST_F(Journals, of_a_shaft_that_turns_equal_those_with_the_speed_stated) {
  const double e = 0.5, W = load_at(e), mass = 3, at = attitude_at(e);
  const std::string start = fmt::format(", QG={:.17g},{:.17g},0", e * c * std::sin(at), -e * c * std::cos(at));
  const auto stated = run(rotor(mass, W, held, start) + "END\n", "LINEAR/EIGENSOL\n");
  ASSERT_EQ(stated.status, 0) << stated.err;
  const auto turning = run(rotor(mass, W,
                                 "JPRIM/2, PARALLEL_AXES, I=2, J=3\n" + bearing("") +
                                     fmt::format("MOTION/1, I=2, J=3, B3, VELOCITY, FUNCTION={}\n", omega),
                                 start + fmt::format(", WZ={}", omega)) +
                               "END\n",
                           "LINEAR/EIGENSOL\n");
  ASSERT_EQ(turning.status, 0) << turning.err;
  const auto expected = stated.eigenvalues(0), found = turning.eigenvalues(0);
  ASSERT_EQ(expected.size(), 4u);
  for (const std::complex<double>& value : expected) {
    double nearest = 1e300;
    for (const std::complex<double>& other : found) nearest = std::min(nearest, std::abs(value - other));
    EXPECT_LT(nearest, 1e-9 * std::abs(value)) << value;
  }
}

TEST_F(Journals, name_what_is_wrong) {
  const auto of = [&](const std::string& text) { return run(text + "END\n", "LINEAR/EIGENSOL\n"); };
  const RunResult wall = of(rotor(1, 0, held, fmt::format(", QG={},0,0", 1.5 * c)));
  EXPECT_NE(wall.status, 0);
  EXPECT_NE(wall.err.find("JOURNAL/1"), std::string::npos) << wall.err;
  EXPECT_NE(wall.err.find("no film left"), std::string::npos) << wall.err;
  const RunResult still =
      of(rotor(1, 0, "JPRIM/2, ORIENTATION, I=2, J=3\n" + bearing(""), fmt::format(", QG={},0,0", 0.5 * c)));
  EXPECT_NE(still.status, 0);
  EXPECT_NE(still.err.find("nothing moves in the film of JOURNAL/1"), std::string::npos) << still.err;
  for (const char* name : {"RADIUS", "LENGTH", "CLEARANCE", "VISCOSITY"}) {
    std::string text = rotor(1, 0, held);
    const std::size_t at = text.find(std::string(name) + "=");
    text.replace(at, text.find(',', at) - at, std::string(name) + "=0");
    const RunResult r = of(text);
    EXPECT_NE(r.status, 0) << name;
    EXPECT_NE(r.err.find(std::string(name) + " of JOURNAL/1 must be positive"), std::string::npos) << r.err;
  }
}

// In the middle of a film at rest any motion is resisted alike.
TEST_F(Journals, damp_a_shaft_at_rest_in_the_middle) {
  const RunResult r = run(rotor(3, 0, "JPRIM/2, ORIENTATION, I=2, J=3\n" + bearing("")) + "END\n", "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.eigenvalues(0);
  ASSERT_EQ(values.size(), 4u);
  const double rate = pi * mu * R * L * L * L / (2 * c * c * c) / 3 / (2 * pi);
  int at_rest = 0;
  for (const auto& value : values) {
    if (std::abs(value) < 1e-6 * rate)
      ++at_rest;
    else
      EXPECT_NEAR(std::abs(value + rate), 0, 1e-10 * rate);
  }
  EXPECT_EQ(at_rest, 2);
}

}  // namespace
}  // namespace dynalin::cases::journal_test
