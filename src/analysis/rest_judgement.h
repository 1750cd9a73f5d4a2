// Whether a point is an equilibrium, judged equation by equation and unknown by unknown, never by one scale for the
// model: every equation balances within the terms it is made of, and Newton's step there is small in each unknown's own
// size. The second is what a force that fades with distance, or misses zero by little, does not pass.
#pragma once

#include <optional>
#include <vector>

#include "analysis/static_equations.h"

namespace dynalin {

// Of Newton's step at rest, in the size of an unknown; what is left after the step is far less.
inline constexpr double rest_step = 1e-9;

struct RestJudgement {
  bool balanced = false;    // every equation, within its own terms or their rounding
  bool determined = false;  // Newton's step is small, or explained by rounding
  bool excused = false;     // the same with all that rounding does in bodies that deform: theirs is not told apart
  Eigen::VectorXd newton;   // Newton's step
  Eigen::VectorXd step;     // the same, zero where rounding explains all of it
  Eigen::VectorXd size;     // of each unknown: model lengths, radians, what states and values are themselves
  double largest = 0;       // of |step| / size over coordinates, states and algebraic values
  Eigen::Index largest_at = -1;
  double largest_of_all = 0;      // the same of Newton's step
  std::vector<bool> indifferent;  // unknowns that nothing but rounding determines
};

// At the point of the last evaluation, which was with partials. Nothing if no step can be computed.
std::optional<RestJudgement> judge(StaticEquations&, const OperatingPoint&);

// Unknowns that nothing holds at a point that need not be balanced: forces that turn with their parts do not hold them.
std::vector<bool> free_unknowns(StaticEquations&, const OperatingPoint&);

// What the tangent of the last evaluation does not determine of a move of coordinates and states; what an unknown that
// is indifferent moved may be determined all the same, together with others.
Eigen::VectorXd undetermined_part(StaticEquations&, Eigen::VectorXd move);

// Columns with the given sizes and random signs, the same in every run.
Eigen::MatrixXd random_signs(const Eigen::VectorXd& size, Eigen::Index columns);

// Every equation balances but for rounding: nothing can be said against the point.
bool balanced_to_rounding(const StaticEquations&);

}  // namespace dynalin
