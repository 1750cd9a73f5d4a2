// What flexible bodies cost: processor time and memory, by their modes.
//
//     flexible vehicle 200 50      a body of 200 modes on 50 bushings: read, at rest, linear model, modes
//     flexible measured 200 50     the same on 50 forces that are expressions of displacements and velocities
//     flexible rod 20 2            a slider-crank at 100 rad/s whose rod has 20 modes, for two turns of the crank
#include <dynalin/study.h>
#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "peak_memory.h"

namespace {

using namespace dynalin;
using std::numbers::pi;

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Mass points of a box, a displacement of every mode at each of them, and the frequencies [Hz].
struct Body {
  Eigen::MatrixXd places;               // 3 × points
  std::vector<Eigen::MatrixXd> shapes;  // each 3 × points
  Eigen::VectorXd frequencies;
  double mass;
};

// Products of cosines along the axes, the longest waves first; none of them moves the body as a whole.
Body box(const Eigen::Vector3d& size, const Eigen::Vector3i& points, int modes, double mass, double first) {
  Body b{Eigen::MatrixXd(3, points.prod()), {}, Eigen::VectorXd(modes), mass};
  const auto part = [&](Eigen::Index p, int axis) {
    const int below = axis == 0 ? 1 : axis == 1 ? points(0) : points(0) * points(1);
    return points(axis) > 1 ? static_cast<double>(p / below % points(axis)) / (points(axis) - 1) : 0.0;
  };
  for (Eigen::Index p = 0; p < b.places.cols(); ++p) {
    for (int k = 0; k < 3; ++k) b.places(k, p) = size(k) * part(p, k);
  }
  for (int waves = 2; static_cast<int>(b.shapes.size()) < modes; ++waves) {
    if (waves > points.sum()) throw std::invalid_argument("the points of this body have no more modes");
    for (int i = 0; i <= waves && i < points(0); ++i) {
      for (int j = 0; i + j <= waves && j < points(1); ++j) {
        const int k = waves - i - j;
        if (k >= points(2)) continue;
        for (int axis = 0; axis < 3 && static_cast<int>(b.shapes.size()) < modes; ++axis) {
          Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(3, b.places.cols());
          for (Eigen::Index p = 0; p < shape.cols(); ++p)
            shape(axis, p) =
                std::cos(i * pi * part(p, 0)) * std::cos(j * pi * part(p, 1)) * std::cos(k * pi * part(p, 2));
          b.frequencies(static_cast<Eigen::Index>(b.shapes.size())) =
              first * (1 + 0.2 * static_cast<double>(b.shapes.size()));
          b.shapes.push_back(std::move(shape));
        }
      }
    }
  }
  return b;
}

void write(const Body& b, const std::filesystem::path& file) {
  const auto points = b.places.cols(), modes = static_cast<Eigen::Index>(b.shapes.size());
  std::ofstream out(file);
  out << fmt::format("** RECORD GROUP 1,HEADER\n** comment\n REV0 {} {} 0 0 0\n** RECORD GROUP 2\n", points, modes);
  for (Eigen::Index p = 0; p < points; ++p) out << p + 1 << '\n';
  for (int k = 0; k < 3; ++k) {
    out << fmt::format("** RECORD GROUP {}\n", 5 + k);
    for (Eigen::Index p = 0; p < points; ++p) out << fmt::format("{:.17g}\n", b.places(k, p));
  }
  out << "** RECORD GROUP 8\n";
  const double mass = b.mass / static_cast<double>(points);
  Eigen::MatrixXd all(3 * points, modes);
  for (Eigen::Index m = 0; m < modes; ++m) {
    const Eigen::MatrixXd& shape = b.shapes[static_cast<std::size_t>(m)];
    all.col(m) = shape.reshaped();
    out << "** mode\n";
    for (Eigen::Index p = 0; p < points; ++p)
      out << fmt::format("{:.17g} {:.17g} {:.17g} 0 0 0\n", shape(0, p), shape(1, p), shape(2, p));
  }
  const Eigen::MatrixXd M = mass * all.transpose() * all;
  const Eigen::VectorXd rate = 2 * pi * b.frequencies;
  const Eigen::MatrixXd K = rate.asDiagonal() * M * rate.asDiagonal();
  const auto record = [&](int number, const Eigen::MatrixXd& matrix) {
    out << fmt::format("** RECORD GROUP {}\n", number);
    for (Eigen::Index r = 0; r < modes; ++r) {
      for (Eigen::Index c = 0; c < modes; ++c) out << fmt::format("{:.17g} ", matrix(r, c));
      out << '\n';
    }
  };
  record(9, M), record(10, K);
  out << "** RECORD GROUP 11\n";
  for (Eigen::Index p = 0; p < points; ++p) out << fmt::format("{0:.17g} {0:.17g} {0:.17g} 0 0 0\n", mass);
  out << "** END OF FILE\n";
}

class Laps {
 public:
  void lap(const char* what) {
    const double t = now();
    fmt::print("{}{} {:.2f} s", begun_ == first_ ? "" : ", ", what, t - begun_);
    begun_ = t;
  }
  ~Laps() { fmt::print("; {:.0f} MB\n", peak_megabytes()); }

 private:
  double first_ = now(), begun_ = first_;
};

void vehicle(int modes, int mounts, bool measured, const std::filesystem::path& file) {
  write(box({4, 1.6, 1.2}, {10, 8, 5}, modes, 1200, 20), file);
  std::string text =
      "bench\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=" + file.string() +
      ", CRATIO=0.01\n";
  for (int k = 0; k < mounts; ++k) {
    const int node = 1 + k * 399 / std::max(mounts - 1, 1);
    text += fmt::format("MARKER/{0}1, FLEX_BODY=2, NODE_ID={1}\nMARKER/{0}2, PART=1, QP={2:.17g},{3:.17g},{4:.17g}\n",
                        k + 1, node, 4.0 * ((node - 1) % 10) / 9, 1.6 * ((node - 1) / 10 % 8) / 7,
                        1.2 * ((node - 1) / 80) / 4);
    text += fmt::format(
        fmt::runtime(measured ? "MARKER/{0}3, PART=1, FLOATING\nVFORCE/{0}, I={0}1, JFLOAT={0}3, RM={0}2\n"
                                ", FX=-2E5*DX({0}1,{0}2)-50*VX({0}1,{0}2)\\FY=-3E5*DY({0}1,{0}2)-60*VY({0}1,{0}2)\\\n"
                                ", FZ=-4E5*DZ({0}1,{0}2)-70*VZ({0}1,{0}2)\n"
                              : "BUSHING/{0}, I={0}1, J={0}2, K=2E5,3E5,4E5, KT=0,0,0, C=50,60,70, CT=0,0,0\n"),
        k + 1);
  }
  Laps laps;
  const library::Study study(library::Model::from_text(text + "END\n"));
  laps.lap("read");
  const auto point = study.static_equilibrium();
  laps.lap("at rest");
  const auto linear = study.linearize(point);
  laps.lap("linear model");
  const auto all = linear.modes();
  laps.lap("modes");
  fmt::print(", {} of them", all.modes.size());
}

void rod(int modes, double turns, const std::filesystem::path& file) {
  write(box({0.4, 0.012, 0.012}, {21, 2, 2}, modes, 0.45, 200), file);
  const std::string text = fmt::format(
      "bench\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/3, REULER=90D,90D,0\n"
      "PART/2, MASS=0.8, CM=20, IP=1E-3,1E-3,1E-4, WZ=100\nMARKER/20\nMARKER/21\nMARKER/22, QP=0.1,0,0\n"
      "FLEX_BODY/3, MNF_FILE={}, QG=0.1,0,0, CRATIO=0.01\nMARKER/31, FLEX_BODY=3, NODE_ID=1\n"
      "MARKER/32, FLEX_BODY=3, NODE_ID=21\nPART/4, MASS=0.5, CM=40, IP=2E-4,2E-4,2E-4, QG=0.5,0,0\nMARKER/40\n"
      "MARKER/42, REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
      "JOINT/3, CYLINDRICAL, I=42, J=3\nJOINT/4, SPHERICAL, I=32, J=40\n"
      "MOTION/1, ROTATIONAL, JOINT=1, FUNCTION=100*TIME\nEND\n",
      file.string());
  Laps laps;
  const library::Study study(library::Model::from_text(text));
  laps.lap("read");
  const auto start = study.initial_conditions();
  laps.lap("initial conditions");
  library::SimulationRequest request;
  request.end = turns * 2 * pi / 100, request.steps = static_cast<std::int64_t>(100 * turns);
  const library::Simulation run = study.simulate(start, request);
  laps.lap("simulated");
  fmt::print(", {} steps", run.statistics.steps);
  const auto linear = study.linearize(start);
  linear.modes();
  laps.lap("linear model and modes");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string which = argc > 1 ? argv[1] : "";
  if (argc < 4 || (which != "vehicle" && which != "measured" && which != "rod"))
    return fmt::print(stderr, "usage: flexible vehicle|measured MODES MOUNTS | flexible rod MODES TURNS\n"), 3;
  const auto file = std::filesystem::temp_directory_path() / fmt::format("dynalin_bench_{}.fem", ::getpid());
  try {
    which == "rod" ? rod(std::atoi(argv[2]), std::atof(argv[3]), file)
                   : vehicle(std::atoi(argv[2]), std::atoi(argv[3]), which == "measured", file);
  } catch (const std::exception& e) {
    std::filesystem::remove(file);
    return fmt::print(stderr, "{}\n", e.what()), 1;
  }
  std::filesystem::remove(file);
  return 0;
}
