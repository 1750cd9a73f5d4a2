// What simulations over time cost: processor time, memory, steps and evaluations, for models of any size.
//
//     simulation chain 1000        links on hinges, drawn askew, swing under gravity
//     simulation fall 100          the same drawn level: they fall
//     simulation spatial 1000      the same askew, every second hinge about another axis: nothing stays in a plane
//     simulation vehicle 100       parts in a row, two bushings between neighbours, every fifth on a rough road
//     simulation fourbars 10       windows of the IFToMM benchmark, side by side: redundant hinges
//     simulation contact 1         balls that bounce, an IMPACT of stiffness 1e8 each
//     simulation bowl 100          a ball that rolls in a bowl of 2 n² facets
//     simulation eggs 50           a ball of 2 n² facets that falls on another one and rolls off it
//     simulation wheels 20         a toothed wheel of 56 n facets that drives another one against a brake
//
// A third argument is the time to simulate, a fourth the intervals of output, a fifth ERROR.
#include "study/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <random>
#include <string>

#include "elements/catalogue.h"
#include "peak_memory.h"

namespace {

using namespace dynalin;

const std::string head = "bench\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, REULER=0,90D,0\n";

// Links of length 0.1 on hinges, each turned by the angle about the y axis, which is that of the hinges; every second
// one is turned from it by `askew` degrees.
std::string chain(int n, double angle, double askew = 0) {
  std::string text = head;
  const double length = 0.1, s = std::sin(angle), c = std::cos(angle);
  for (int k = 1; k <= n; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=0.1, CM={0}0, IP=1E-4,1E-4,1E-5, QG={1:.17g},0,{2:.17g}, REULER=90D,{3:.17g},-90D\n"
        "MARKER/{0}0, QP=0,0,{4:.17g}\nMARKER/{0}1, REULER={7}D,90D,0\nMARKER/{0}2, QP=0,0,{5:.17g}, "
        "REULER={8}D,90D,0\n"
        "JOINT/{0}, REVOLUTE, I={0}1, J={6}\n",
        k + 1, (k - 1) * length * s, -(k - 1) * length * c, -angle, -length / 2, -length,
        k == 1 ? std::string("1") : fmt::format("{}2", k), k % 2 == 0 ? askew : 0.0, k % 2 == 1 ? askew : 0.0);
  }
  return text + "END\n";
}

std::string vehicle(int n) {
  std::string text = head;
  std::mt19937 random(1);
  std::string x, y;
  for (int k = 0; k < 400; ++k) {
    x += fmt::format("{}{}", k == 0 ? "" : k % 20 == 0 ? "\n, " : ", ", 0.05 * k);
    y += fmt::format("{}{:.4f}",
                     k == 0        ? ""
                     : k % 20 == 0 ? "\n, "
                                   : ", ",
                     0.01 * static_cast<double>(random() % 1000) / 1000);
  }
  text += "SPLINE/1, X=" + x + "\n, Y=" + y + "\nMARKER/9, PART=1\n";
  for (int k = 1; k <= n; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=0.2,0.3,0.4, QG={1:.17g},0,0\nMARKER/{0}0\nMARKER/{0}1, QP=-0.1,-0.25,0\n"
        "MARKER/{0}2, QP=-0.1,0.25,0\nMARKER/{0}3, QP=0.1,-0.25,0\nMARKER/{0}4, QP=0.1,0.25,0\n",
        k + 1, 0.2 * k);
    for (int side = 0; side < 2 && k > 1; ++side)
      text += fmt::format("BUSHING/{0}{1}, I={0}{1}, J={2}{3}, K=1E5,2E5,3E5, KT=1E3,2E3,3E3, C=10,20,30, CT=1,2,3\n",
                          k + 1, side + 1, k, side + 3);
    if (k % 5 != 1 && k != n) continue;
    for (int side = 0; side < 2; ++side) {  // a wheel: stiff upwards, dragged along and aside a little
      text += fmt::format(
          "MARKER/9000{0}{1}, PART=1, QP={2:.17g},{3},-0.3\nVFORCE/{0}{1}, I={0}{1}, JFLOAT=8000{0}{1}, RM=9\n"
          ", FX=-50*VX({0}{1},1)\\\n, FY=-50*VY({0}{1},1)-1000*DY({0}{1},9000{0}{1})\\\n"
          ", FZ=2E4*(AKISPL(2*TIME+{4},0,1,0)-DZ({0}{1},9000{0}{1})+0.305)-100*VZ({0}{1},1)\nMARKER/8000{0}{1}, "
          "PART=1, "
          "FLOATING\n",
          k + 1, side + 1, 0.2 * k - 0.1, side == 0 ? -0.25 : 0.25, std::fmod(0.2 * k + 0.37 * side, 4.0));
    }
  }
  return text + "END\n";
}

// Rods of length 1 and mass 1 upright on hinges a length apart, their tops joined by rods; they start at 1 along x.
std::string fourbars(int n) {
  std::string text = head;
  const auto rod = [&](int id, double x, double z, bool upright) {
    text += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=0.083333333333333333,0.083333333333333333,0, QG={1},0,{2}, "
        "REULER={3}\nMARKER/{0}0, "
        "QP=0,0,0.5\nMARKER/{0}1, REULER=0,90D,0\nMARKER/{0}2, QP=0,0,1, REULER=0,90D,0\n",
        id, x, z, upright ? "0,0,0" : "90D,90D,-90D");
  };
  for (int k = 0; k <= n; ++k) {
    rod(100 + k, k, 0, true);
    text += fmt::format("MARKER/9{0}, PART=1, QP={1},0,0, REULER=0,90D,0\nJOINT/{0}, REVOLUTE, I={0}1, J=9{0}\n",
                        100 + k, k);
  }
  for (int k = 0; k < n; ++k) {
    rod(100000 + k, k, 1, false);
    text += fmt::format("JOINT/{0}, REVOLUTE, I={0}1, J={1}2\nJOINT/5{0}, REVOLUTE, I={0}2, J={2}2\n", 100000 + k,
                        100 + k, 101 + k);
  }
  const auto start = text.find("PART/100,");
  text.insert(start + 9, " VX=0.5,");
  return text + "END\n";
}

std::string contact(int n) {
  std::string text = head;
  for (int k = 1; k <= n; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=0.01,0.01,0.01, QG={1},0,{2:.17g}\nMARKER/{0}0\nSFORCE/{0}, TRANSLATIONAL, "
        "ACTIONONLY, I={0}0, J=5000{0}\n, FUNCTION=IMPACT(DZ({0}0,1),VZ({0}0,1),0.1,1E8,1.5,1E3,1E-4)\nMARKER/5000{0}, "
        "PART=1, QP={1},0,0\n",
        k + 1, k, 0.2 + 0.01 * (k % 7));
  }
  return text + "END\n";
}

std::string bowl(int n) {
  std::string points;
  const auto add = [&](double x, double z) { points += fmt::format("\n, {:.17g},0,{:.17g}", x, z); };
  for (int k = 0; k <= n; ++k) {
    const double x = static_cast<double>(k) / n;
    add(x, 0.3 * x * x);
  }
  add(1, -0.3), add(0, -0.3);
  return head + fmt::format(
                    "MARKER/9, PART=1\nMATRIX/1, FULL=RORDER, ROWS={}, COLUMNS=3, VALUES={}\n"
                    "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS, ORDER=2\nGRAPHICS/1, REVOLUTION, CID=1, CRM=9, SEG={}\n"
                    "PART/2, MASS=2, CM=20, IP=0.008,0.008,0.008, QG=0.5,0.1,0.19, VY=1\nMARKER/20\n"
                    "GRAPHICS/2, ELLIPSOID, CM=20, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
                    "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E6, EXPONENT=1.5, DAMPING=1E3, DMAX=1E-4\n"
                    ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY=0.01\n"
                    ", FRICTION_TRANSITION_VELOCITY=0.1\nEND\n",
                    n + 3, points.substr(2), n);
}

std::string eggs(int n) {
  std::string points;
  for (int k = 0; k <= n; ++k) {
    const double angle = k * 3.14159265358979324 / n;
    points += fmt::format("\n, {:.17g},0,{:.17g}", k % n == 0 ? 0 : 0.1 * std::sin(angle), -0.1 * std::cos(angle));
  }
  return head + fmt::format(
                    "MARKER/9, PART=1\nMATRIX/1, FULL=RORDER, ROWS={}, COLUMNS=3, VALUES={}\n"
                    "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS, ORDER=2\nGRAPHICS/1, REVOLUTION, CID=1, CRM=9, SEG={}\n"
                    "PART/2, MASS=2, CM=20, IP=0.008,0.008,0.008, QG=0.005,0.003,0.21, REULER=0.3,0.5,0.7\n"
                    "MARKER/20\nGRAPHICS/2, REVOLUTION, CID=1, CRM=20, SEG={}\n"
                    "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E6, EXPONENT=1.5, DAMPING=1E3, DMAX=1E-4\n"
                    ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY=0.01\n"
                    ", FRICTION_TRANSITION_VELOCITY=0.1\nEND\n",
                    n + 1, points.substr(2), n, n);
}

// The outline of a wheel of n involute teeth of the module 0.01 and a pressure angle of 20 degrees, the middle of one
// of them at `angle`.
std::string teeth(int n, double angle, int id, int marker) {
  constexpr double module = 0.01, pressure = 0.3490658503988659, pi = 3.14159265358979324;
  constexpr int pieces = 6;
  const double pitch = module * n / 2, base = pitch * std::cos(pressure), inner = pitch - 1.25 * module;
  const auto involute = [](double a) { return std::tan(a) - a; };
  // Of half a tooth, with a clearance.
  const auto half = [&](double r) {
    return pi / 2 / n - 1e-4 / pitch + involute(pressure) - involute(std::acos(std::min(1.0, base / r)));
  };
  std::string points;
  const auto add = [&](double r, double a) {
    points += fmt::format("{:.17g},{:.17g},-0.01\n, ", r * std::cos(a), r * std::sin(a));
  };
  const double low = std::max(base, inner), high = pitch + module;
  for (int k = 0; k < n; ++k) {
    const double middle = angle + 2 * pi * k / n;
    add(inner, middle - half(low));
    for (int i = 0; i <= pieces; ++i) {
      const double r = low + (high - low) * i / pieces;
      add(r, middle - half(r));
    }
    for (int i = pieces; i >= 0; --i) {
      const double r = low + (high - low) * i / pieces;
      add(r, middle + half(r));
    }
    add(inner, middle + half(low));
  }
  const std::string first = points.substr(0, points.find('\n'));
  return fmt::format(
      "MATRIX/{0}, FULL=RORDER, ROWS={1}, COLUMNS=3, VALUES={2}{3}\nCURVE/{0}, CLOSED, MATRIX={0}, CURVE_POINTS, "
      "ORDER=2\nGRAPHICS/{0}, EXTRUSION, CID={0}, CRM={4}, LENGTH=0.02\n",
      id, n * (2 * pieces + 4) + 1, points, first, marker);
}

std::string wheels(int n) {
  return fmt::format(
             "bench\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, PART=1, QP={},0,0\n"
             "PART/2, MASS=2, CM=20, IP=0.01,0.01,0.005\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
             "PART/3, MASS=2, CM=30, IP=0.02,0.02,0.02, QG={},0,0\nMARKER/30\nJOINT/2, REVOLUTE, I=30, J=2\n",
             0.01 * n, 0.01 * n) +
         teeth(n, 0, 2, 20) + teeth(n, 3.14159265358979324 * (1 + 1.0 / n), 3, 30) +
         "CONTACT/1, IGEOM=2, JGEOM=3, IMPACT, STIFFNESS=1E8, EXPONENT=1.5, DAMPING=1E4, DMAX=1E-5\n"
         "SFORCE/1, ROTATION, ACTION, I=20, J=1, FUNCTION=20-WZ(20)\n"
         "SFORCE/2, ROTATION, ACTION, I=30, J=2, FUNCTION=STEP(TIME,0,0,0.01,5)\nEND\n";
}

struct Case {
  std::string text;
  double seconds;
  int intervals;
};

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class T>
auto value(T&& result) {
  if (!result) {
    fmt::print("{}\n", result.error().message);
    for (const std::string& d : result.error().details) fmt::print("  {}\n", d);
    std::exit(1);
  }
  return std::move(*result);
}

int measure(const Case& c, double error) {
  double begun = now();
  const auto lap = [&] {
    const double t = now(), taken = t - begun;
    begun = t;
    return taken;
  };
  auto read = parse_dataset(std::make_shared<const SourceText>("bench.adm", c.text));
  auto model = build_model(std::make_shared<const Dataset>(std::move(read.value)), catalogue());
  if (read.diagnostics.has_errors() || model.diagnostics.has_errors()) {
    fmt::print("{}{}", render(read.diagnostics, 3), render(model.diagnostics, 3));
    return 1;
  }
  const auto system = System::make(std::move(model.value)).value();
  const double reading = lap();
  FoundPoint start = value(initial_conditions(as_drawn(system)));
  const double conditions = lap(), before = peak_megabytes();
  SimulationRequest request{SimulationKind::dynamics, OutputTimes::of_count(0, c.seconds, c.intervals)};
  request.integrator.error = error;
  const SimulatedPoint end = value(simulate(std::move(start.point), request));
  const double taken = lap();
  const IntegrationStatistics& s = end.statistics;
  const std::size_t bodies = system->layout().bodies.size() - 1;
  fmt::print(
      "{} bodies: read {:.2f} s, initial conditions {:.2f} s; {} s in {:.3f} s, {:.3f} s per second; {} outputs, {} "
      "steps, "
      "{} evaluations, {} Jacobians, {} restarts; {:.3f} ms a step, {:.2f} us a step and body; {:.0f} MB, {:.0f} "
      "before\n",
      bodies, reading, conditions, c.seconds, taken, taken / c.seconds, c.intervals, s.steps, s.evaluations,
      s.jacobians, s.restarts, 1e3 * taken / static_cast<double>(s.steps),
      1e6 * taken / static_cast<double>(s.steps) / static_cast<double>(bodies), peak_megabytes(), before);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3)
    return fmt::print(
               stderr,
               "usage: simulation chain|fall|spatial|vehicle|fourbars|contact|bowl|eggs|wheels N [TIME [INTERVALS "
               "[ERROR]]]\n"),
           3;
  const int n = std::atoi(argv[2]);
  const std::map<std::string, Case> cases = {{"chain", {chain(n, 0.3), 1, 100}},
                                             {"fall", {chain(n, 1.5707963267948966), 1, 100}},
                                             {"spatial", {chain(n, 0.3, 60), 1, 100}},
                                             {"vehicle", {vehicle(n), 1, 100}},
                                             {"fourbars", {fourbars(n), 1, 100}},
                                             {"contact", {contact(n), 1, 100}},
                                             {"bowl", {bowl(n), 1, 100}},
                                             {"eggs", {eggs(n), 1, 100}},
                                             {"wheels", {wheels(n), 0.1, 100}}};
  const auto found = cases.find(argv[1]);
  if (found == cases.end()) return fmt::print(stderr, "no such model: {}\n", argv[1]), 3;
  Case c = found->second;
  if (argc > 3) c.seconds = std::atof(argv[3]);
  if (argc > 4) c.intervals = std::atoi(argv[4]);
  return measure(c, argc > 5 ? std::atof(argv[5]) : 1e-3);
}
