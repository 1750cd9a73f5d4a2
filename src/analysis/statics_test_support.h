// Models in which one search for rest comes to its end and another does not, and the point from which searches begin.
#pragma once

#include "analysis/settled_reactions.h"
#include "analysis/static_descent.h"
#include "analysis/static_equations.h"
#include "analysis/statics.h"
#include "system/model_test_support.h"

namespace dynalin::analysis_test {

using system_test::system_of;

// A search begins at the drawn point, constraints met and reactions settled.
struct Search {
  std::shared_ptr<const System> system;
  StaticEquations equations{*system};
  StaticsOptions options{};
  StaticHistory history{{}};
  OperatingPoint op = system->drawn();

  explicit Search(const std::string& text) : system(system_of(text)) {
    op.mode = AnalysisMode::statics;
    settle(equations, op);
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  // Largest residual at the point, in units of the equations.
  double imbalance() {
    equations.evaluate(op, Partials::yes);
    return equations.residual().cwiseAbs().maxCoeff();
  }
};

inline const std::string gravity = "ACCGRAV/JGRAV=-10\n";

// A mass of 2 at a distance of 1 from a hinge about z, `angle` away from hanging down.
inline std::string pendulum(double angle) {
  const std::string a = std::to_string(angle) + "," + "0,0";
  return gravity + "PART/2, MASS=2, CM=20, IP=1,1,1, REULER=" + a +
         "\nMARKER/20, QP=0,-1,0\nMARKER/21\nJOINT/1, REVOLUTE, I=21, J=1\n";
}
inline double angle_of(const OperatingPoint& op) { return std::atan2(op.poses[1].R(1, 0), op.poses[1].R(0, 0)); }

// A mass of 1 at (0.9, 0.4) that a force without potential drives round a centre at (0.2, −0.1).
inline std::string swirl() {
  const std::string u = "(DX(20,1)-0.2)", v = "(DY(20,1)+0.1)", r = "(1-" + u + "**2-" + v + "**2)";
  return "POINT_MASS/2, MASS=1, CM=20, QG=0.9,0.4,0\nMARKER/20, POINT_MASS=2\nMARKER/9, PART=1, FLOATING\n"
         "VFORCE/1, I=20, JFLOAT=9, RM=1, FX=" +
         u + "*" + r + "-" + v + "\\, FY=" + v + "*" + r + "+" + u + "\\, FZ=-DZ(20,1)\n";
}

// z′ = z³ − 3z + 4 has a least size of 2 at z = 1 on the way from 0.9 to its only zero (Cardano).
inline const std::string fold = "DIFF/7, IC=0.9, FUNCTION=DIF(7)**3-3*DIF(7)+4\n";
inline double root_behind_the_fold() { return -std::cbrt(2 + std::sqrt(3.0)) - std::cbrt(2 - std::sqrt(3.0)); }

}  // namespace dynalin::analysis_test
