// What may not change an eigenvalue: where the model stands, how it is numbered and ordered, its units, the
// coordinates.
#include <fmt/format.h>

#include <algorithm>

#include "cases/dataset_text.h"
#include "places/source_tree.h"

namespace dynalin::cases::property_test {
namespace {

using Properties = Cases;

struct Variation {
  Vector shift{};
  Matrix3 turn = Matrix3::identity();
  double length = 1;  // one metre in model units
  double mass = 1;    // one kilogram in model units
  std::string units = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND";
  std::array<int, 4> part = {1, 2, 3, 4};
  bool reversed = false;
};

// Three bodies on a ball, a cross and a hinge, held by loaded springs, one of them turning, with a damper and a
// controller: nothing planar, nothing aligned.
std::string mechanism(const Variation& v) {
  const auto at = [&](double x, double y, double z) { return v.shift + v.turn * (Vector{x, y, z} * v.length); };
  const double k = 1 / v.length;                  // N/m in N per length unit
  const double L = v.length, I = v.mass * L * L;  // moments and inertias
  std::vector<std::string> s;
  s.push_back(v.units);
  const Vector g = v.turn * Vector{0.7 * L, -1.1 * L, -9.6 * L};
  s.push_back(fmt::format("ACCGRAV/IGRAV={:.17g}, JGRAV={:.17g}, KGRAV={:.17g}", g.x, g.y, g.z));
  s.push_back(fmt::format("PART/{}, GROUND", v.part[0]));
  const Matrix3 R1 = rotation_313(0.3, 0.5, -0.2), R2 = rotation_313(-0.7, 1.1, 0.4), R3 = rotation_313(1.9, 0.8, -1.2);
  const Vector o1{0.1, 0.2, -0.1}, o2{0.5, 0.3, -0.6}, o3{0.9, -0.1, -0.8};
  const auto part = [&](int n, double m, const Vector& o, const Matrix3& R, const char* ip) {
    s.push_back(fmt::format("PART/{}, MASS={:.17g}, CM={}, IP={}, QG={}, REULER={}",
                            v.part[static_cast<std::size_t>(n)], m * v.mass, 10 * n, ip, xyz(at(o.x, o.y, o.z)),
                            reuler(v.turn * R)));
  };
  const auto ip = [&](std::array<double, 6> x) {
    std::string t;
    for (std::size_t q = 0; q < 6; ++q) t += fmt::format("{}{:.17g}", q ? "," : "", x[q] * I);
    return t;
  };
  part(1, 2.0, o1, R1, ip({0.2, 0.3, 0.25, 0.01, -0.02, 0.015}).c_str());
  part(2, 1.5, o2, R2, ip({0.1, 0.15, 0.12, -0.01, 0.005, 0.01}).c_str());
  part(3, 0.8, o3, R3, ip({0.05, 0.06, 0.04, 0.002, 0.001, -0.003}).c_str());
  // A marker of body n at a global point with global axes, written in the body's frame.
  const auto marker = [&](int id, int n, const Vector& p, const Matrix3& axes) {
    const std::array<Vector, 4> o = {Vector{}, o1, o2, o3};
    const std::array<Matrix3, 4> R = {Matrix3::identity(), R1, R2, R3};
    const auto b = static_cast<std::size_t>(n);
    const Vector local = n == 0 ? at(p.x, p.y, p.z) : transpose_times(R[b], p - o[b]) * L;
    const Matrix3 local_axes = n == 0 ? v.turn * axes : transpose_times(R[b], axes);
    s.push_back(fmt::format("MARKER/{}, PART={}, QP={}, REULER={}", id, v.part[b], xyz(local), reuler(local_axes)));
  };
  const Matrix3 F = rotation_313(0.4, 0.9, 0.3);
  marker(10, 1, {0.25, 0.2, -0.3}, R1), marker(20, 2, {0.6, 0.15, -0.65}, R2), marker(30, 3, {1.0, -0.2, -0.9}, R3);
  marker(1, 0, {0, 0, 0}, F), marker(11, 1, {0, 0, 0}, F);
  // The two z axes of the cross must be perpendicular.
  const Matrix3 crossed{F.x, -F.z, F.y};
  marker(12, 1, {0.4, 0.3, -0.5}, F), marker(21, 2, {0.4, 0.3, -0.5}, crossed);
  marker(22, 2, {0.8, 0, -0.7}, crossed), marker(31, 3, {0.8, 0, -0.7}, crossed);
  marker(2, 0, {1.5, 0.5, 0.8}, F), marker(3, 0, {-0.8, 0.9, 0.4}, F), marker(32, 3, {1.1, -0.2, -0.8}, F);
  s.push_back("JOINT/1, SPHERICAL, I=11, J=1");
  s.push_back("JOINT/2, UNIVERSAL, I=21, J=12");
  s.push_back("JOINT/3, REVOLUTE, I=31, J=22");
  const auto spring = [&](int id, int i, int j, double K, double C, double l) {
    s.push_back(fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}, J={}, K={:.17g}, C={:.17g}, LENGTH={:.17g}", id, i,
                            j, K * k, C * k, l * L));
  };
  spring(1, 10, 3, 180, 3, 0.9), spring(2, 20, 2, 120, 1, 1.0), spring(3, 32, 2, 60, 0.5, 0.8),
      spring(4, 32, 3, 40, 0.7, 1.5);
  s.push_back(fmt::format("SPRINGDAMPER/5, ROTATIONAL, I=31, J=22, KT={:.17g}, CT={:.17g}, ANGLE=0.2", 3 * L, 0.1 * L));
  s.push_back(fmt::format("SPRINGDAMPER/6, ROTATIONAL, I=21, J=12, KT={:.17g}", 1.5 * L));
  s.push_back(fmt::format("VARIABLE/1, FUNCTION=VM(30)/{0:.17g} + 2*DX(30,1,12)/{0:.17g}", L));
  s.push_back("DIFF/1, FUNCTION=-3*DIF(1) + VARVAL(1)");
  s.push_back("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=12, FUNCTION=4*DIF(1)");
  s.push_back("VARIABLE/2, FUNCTION=DX(30,1)");
  s.push_back("VARIABLE/3, FUNCTION=AZ(31,22)");
  s.push_back("PSTATE/1, VARIABLES=2,3");
  if (v.reversed) std::reverse(s.begin(), s.end());
  std::string text = "A mechanism in space\n";
  for (const auto& line : s) text += line + "\n";
  return text + "END\n";
}

class Invariance : public Cases {
 protected:
  std::vector<std::complex<double>> solve(const Variation& v, const std::string& linear = "LINEAR/EIGENSOL") {
    const RunResult r = run(mechanism(v), "SIMULATE/STATIC\n" + linear + "\n");
    EXPECT_EQ(r.status, 0) << r.err << r.out;
    return r.status == 0 ? r.eigenvalues(1) : std::vector<std::complex<double>>{};
  }
};

TEST_F(Invariance, reference_model_has_six_freedoms_and_a_controller) { EXPECT_EQ(solve({}).size(), 13u); }

TEST_F(Invariance, moving_the_whole_model_changes_no_eigenvalue) {
  Variation v;
  v.shift = {3, -7, 11};
  v.turn = rotation_313(1.0, 2.0, -0.5);
  expect_same(solve({}), solve(v));
}

TEST_F(Invariance, renumbering_and_reordering_change_no_eigenvalue) {
  Variation v;
  v.part = {7, 40, 3, 12};
  expect_same(solve({}), solve(v));
  v.reversed = true;
  expect_same(solve({}), solve(v));
}

TEST_F(Invariance, consistent_units_change_no_eigenvalue) {
  Variation mm;
  mm.length = 1000;
  mm.units = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND";
  expect_same(solve({}), solve(mm));
  Variation grams = mm;
  grams.mass = 1000;
  grams.units = "UNITS/FORCE=NEWTON, MASS=GRAM, LENGTH=MILLIMETER, TIME=SECOND";
  expect_same(solve({}), solve(grams));
}

TEST_F(Invariance, any_marker_and_any_user_coordinates_give_the_same_eigenvalues) {
  const auto reference = solve({});
  for (const char* option : {"RM=12", "RM=22", "RM=30", "RM=1", "PSTATE=1", "PSTATE=1, RM=22"}) {
    SCOPED_TRACE(option);
    expect_same(reference, solve({}, std::string("LINEAR/EIGENSOL, ") + option));
  }
}

TEST_F(Properties, a_frame_that_turns_with_the_rotor_gives_one_answer_for_all_its_coordinates) {
  // A turning arm with a slider at relative equilibrium: coordinates that move along agree.
  const std::string dataset = read_file(examples_folder() / "rotating_slider/rotating_slider.adm");
  std::string text = dataset.substr(0, dataset.rfind("END"));
  text +=
      "VARIABLE/1, FUNCTION=DX(8,6,5)\nVARIABLE/2, FUNCTION=DZ(9,10,10)\nPSTATE/1, VARIABLES=1\nPSTATE/2, "
      "VARIABLES=2\nEND\n";
  const RunResult r = run(
      text, "LINEAR/EIGENSOL, RM=5\nLINEAR/EIGENSOL, PSTATE=1\nLINEAR/EIGENSOL, PSTATE=2\nLINEAR/EIGENSOL, RM=10\n");
  ASSERT_EQ(r.status, 0) << r.err;
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_NEAR(r.eigenvalues(k)[2].imag(), r.eigenvalues(0)[2].imag(), 1e-12) << k;
  }
}

}  // namespace
}  // namespace dynalin::cases::property_test
