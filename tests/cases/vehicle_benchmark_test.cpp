// Ride, handling and lattices: closed forms and published values.
#include <numbers>

#include "cases/both.h"
#include "cases/dataset_text.h"

namespace dynalin::cases::vehicle_benchmark_test {
namespace {

class Benchmark : public ProgramAndLibrary {
 protected:
  // Eigenvalues in rad per unit time.
  std::vector<std::complex<double>> solve(const std::string& elements) const {
    const RunResult r = run("Benchmark\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + elements + "END\n",
                            "LINEAR/EIGENSOL, NOVECTOR\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<std::complex<double>> values;
    if (r.status == 0) values = r.eigenvalues(0);
    for (auto& v : values) v *= 2 * std::numbers::pi;
    return values;
  }
};
using Vehicle = Benchmark;
using Lattice = Benchmark;

std::vector<std::complex<double>> pairs(const std::vector<std::complex<double>>& upper) {
  std::vector<std::complex<double>> all;
  for (const auto& e : upper) all.push_back(e), all.push_back(std::conj(e));
  return all;
}

// A body on a vertical slide at x, z; its marker is 10 times its id.
std::string slider(int id, double mass, double x, double z) {
  return fmt::format(
      "PART/{0}, MASS={1}, CM={0}0, IP=1,1,1, QG={2},0,{3}\nMARKER/{0}0\nMARKER/{0}9, PART=1, QP={2},0,{3}\nJOINT/{0}, "
      "TRANSLATIONAL, I={0}0, J={0}9\n",
      id, mass, x, z);
}
std::string spring(int id, int i, int j, double k, double c, double length, double preload = 0) {
  return fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}, J={}, K={}, C={}, LENGTH={}, FORCE={}\n", id, i, j, k, c,
                     length, preload);
}

TEST_F(Vehicle, quarter_car_whatever_the_preload) {
  for (const double preload : {0.0, 1.0}) {
    const double load = 300 * 9.81 * preload, both = 340 * 9.81 * preload;
    const auto values =
        solve(fmt::format("ACCGRAV/KGRAV={}\n", -9.81 * preload) + slider(2, 300, 0, 1) + slider(3, 40, 0, 0.4) +
              spring(1, 20, 30, 15000, 1000, 0.6, load) + spring(2, 30, 1, 150000, 0, 0.4, both));
    expect_same(values, pairs({{-1.394891250597389, 6.653170142533628}, {-12.77177541606928, 62.40521137729697}}),
                1e-11);
  }
}

const std::string body =
    "PART/2, MASS=1600, CM=20, IP=1,2400,1, QG=0,0,1\nMARKER/20\nMARKER/21, QP=1.2,0,0\nMARKER/22, "
    "QP=-1.6,0,0\nMARKER/23, REULER=0,-90D,0\nMARKER/24, REULER=90D,90D,0\n"
    "MARKER/2, PART=1, QP=0,0,1, REULER=0,-90D,0\nMARKER/3, PART=1, QP=0,0,1, REULER=90D,90D,0\nJOINT/20, PLANAR, "
    "I=23, J=2\nJPRIM/21, INPLANE, I=24, J=3\n";

TEST_F(Vehicle, bounce_and_pitch) {
  const auto values = solve(body + "MARKER/4, PART=1, QP=1.2,0,0\nMARKER/5, PART=1, QP=-1.6,0,0\n" +
                            spring(1, 21, 4, 30000, 2500, 1) + spring(2, 22, 5, 28000, 2300, 1));
  expect_same(values, pairs({{-1.44365748110523, 5.71252868390451}, {-2.033009185561436, 6.728009890351994}}), 1e-11);
}

TEST_F(Vehicle, half_car) {
  const auto values =
      solve(body + slider(3, 90, 1.2, 0.4) + slider(4, 110, -1.6, 0.4) +
            "MARKER/4, PART=1, QP=1.2,0,0\nMARKER/5, PART=1, QP=-1.6,0,0\n" + spring(1, 21, 30, 30000, 2500, 0.6) +
            spring(2, 22, 40, 28000, 2300, 0.6) + spring(3, 30, 4, 350000, 0, 0.4) + spring(4, 40, 5, 330000, 0, 0.4));
  expect_same(values,
              pairs({{-1.241499077946995, 5.563972856201109},
                     {-1.75932773595605, 6.593901161247127},
                     {-10.71813737153179, 55.40953644646158},
                     {-14.10113682466617, 62.85961969809826}}),
              1e-11);
}

TEST_F(Vehicle, single_track_on_tyres) {
  const std::pair<double, std::complex<double>> rows[] = {{10, {-12.02066666666667, 3.327397314552154}},
                                                          {20, {-6.010333333333333, 3.803668390149465}},
                                                          {30, {-4.006888888888889, 3.885465407399578}},
                                                          {40, {-3.005166666666667, 3.913690496903857}}};
  for (const auto& [u, expected] : rows) {
    // Cornering force along y of the body, by the slip angle of the axle.
    const auto values = solve(fmt::format(
        "PART/2, MASS=1500, CM=20, IP=1,1,2500, VX={}, VY=0, WZ=0\nMARKER/20\nMARKER/21, QP=1.2,0,0\nMARKER/22, "
        "QP=-1.5,0,0\n"
        "MARKER/23, QP=1.2,0,0, REULER=0,-90D,0\nMARKER/24, QP=-1.5,0,0, REULER=0,-90D,0\nJOINT/1, PLANAR, I=20, J=1\n"
        "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=21, J=23, FUNCTION=-80000*ATAN2(VY(21,0,20),VX(21,0,20))\n"
        "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=22, J=24, FUNCTION=-90000*ATAN2(VY(22,0,20),VX(22,0,20))\n",
        u));
    ASSERT_EQ(values.size(), 6u);
    std::size_t zeros = 0;
    for (const auto& v : values) {
      if (std::abs(v) < 1e-6)
        ++zeros;
      else
        EXPECT_LE(std::abs(std::complex(v.real(), std::abs(v.imag())) - expected), 1e-11 * std::abs(expected)) << v;
    }
    EXPECT_EQ(zeros, 4u);
  }
}

TEST_F(Lattice, chain_of_masses_between_walls) {
  constexpr int n = 60;
  std::string s;
  for (int k = 1; k <= n; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=1, CM={1}, IP=1,1,1, QG=0,0,{2}\nMARKER/{1}\nJOINT/{2}, TRANSLATIONAL, I={1}, J=1\n", k + 1,
        100 + k, k);
    s += spring(k, 100 + k, k == 1 ? 1 : 99 + k, 1e4, 0, 1);
  }
  s += fmt::format("MARKER/2, PART=1, QP=0,0,{}\n", n + 1) + spring(n + 1, 2, 100 + n, 1e4, 0, 1);
  const auto values = solve(s);
  ASSERT_EQ(values.size(), 2u * n);
  for (std::size_t j = 1; j <= n; ++j) {
    EXPECT_NEAR(values[2 * j - 2].imag(), 200 * std::sin(static_cast<double>(j) * std::numbers::pi / (2 * (n + 1))),
                1e-11 * 200);
  }
}

TEST_F(Lattice, cube_of_point_masses_has_triple_values) {
  constexpr int n = 5;
  const auto id = [](int i, int j, int k) { return 1000 + 100 * i + 10 * j + k; };
  const auto inside = [](int i) { return i >= 1 && i <= n; };
  std::string s;
  int bushing = 1, ground = 2;
  for (int i = 1; i <= n; ++i) {
    for (int j = 1; j <= n; ++j) {
      for (int k = 1; k <= n; ++k) {
        s += fmt::format("POINT_MASS/{0}, MASS=1, CM={0}, QG={1},{2},{3}\nMARKER/{0}\n", id(i, j, k), i, j, k);
        for (int d = 0; d < 3; ++d) {
          for (const int step : {-1, 1}) {
            const int a = i + (d == 0 ? step : 0), b = j + (d == 1 ? step : 0), c = k + (d == 2 ? step : 0);
            const bool wall = !inside(a) || !inside(b) || !inside(c);
            if (!wall && step < 0) continue;
            // The marker at the neighbour's place that belongs to this mass.
            const int mine = 10000 + bushing;
            s += fmt::format("MARKER/{}, POINT_MASS={}, QP={},{},{}\n", mine, id(i, j, k), a - i, b - j, c - k);
            int other = id(a, b, c);
            if (wall) s += fmt::format("MARKER/{}, PART=1, QP={},{},{}\n", other = ground++, a, b, c);
            s += fmt::format("BUSHING/{}, I={}, J={}, K=1E4,1E4,1E4\n", bushing++, mine, other);
          }
        }
      }
    }
  }
  auto values = solve(s);
  ASSERT_EQ(values.size(), 2u * 3 * n * n * n);
  std::vector<double> expected, found;
  const auto sine = [](int i) { return std::pow(std::sin(i * std::numbers::pi / (2 * (n + 1))), 2); };
  for (int i = 1; i <= n; ++i) {
    for (int j = 1; j <= n; ++j) {
      for (int k = 1; k <= n; ++k) {
        for (int copies = 0; copies < 3; ++copies) expected.push_back(200 * std::sqrt(sine(i) + sine(j) + sine(k)));
      }
    }
  }
  for (const auto& v : values) {
    if (v.imag() > 0) found.push_back(v.imag());
  }
  std::sort(expected.begin(), expected.end()), std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_NEAR(found[0], 89.6575472168, 1e-9);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-9 * expected[k]);
}

}  // namespace
}  // namespace dynalin::cases::vehicle_benchmark_test
