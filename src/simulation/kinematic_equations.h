// A model without degrees of freedom at one instant: as many constraint rows as coordinates, solved for positions,
// velocities and, with reactions and everything that depends on them, accelerations.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/augmented_system.h"
#include "analysis/displace.h"
#include "system/system.h"

namespace dynalin {

class KinematicEquations {
 public:
  explicit KinematicEquations(const System&);
  KinematicEquations(const KinematicEquations&) = delete;
  KinematicEquations& operator=(const KinematicEquations&) = delete;

  // Takes rows that determine the positions at a point. False if there are fewer than coordinates.
  bool choose_rows(const OperatingPoint&);
  const Partition& partition() const { return partition_; }

  struct Limits {
    StepLimits step;
    int iterations;
    double redundancy_tolerance;  // of the rows that were not taken, in their scales
  };
  // Newton's method from the poses of the point to rounding. A point that comes back has been reached by steps that
  // shrank faster and faster, and meets all rows.
  enum class Missed : std::uint8_t { singular, not_converged, contradicted };
  std::optional<Missed> solve_position(OperatingPoint&, const Limits&);
  // At the point that was solved for last: velocities, and which way the rows are oriented, 1 or −1. It changes where a
  // singular configuration is passed, and between the two ways of joining links.
  void solve_velocity(OperatingPoint&) const;
  int orientation() const { return lu_.determinant_sign(); }
  // How well the rows determine the coordinates at that point: the least that they change by a displacement of length
  // one, in their scales; estimated from one call to the next.
  double hold();
  // What they determine least, by name.
  struct Loosest {
    std::vector<std::string> coordinates, rows;
  };
  Loosest loosest();
  // Accelerations, multipliers, algebraic values and rates, from those of a point nearby. False if they are hard to
  // find; `solve_acceleration` of the initial conditions goes on then.
  bool solve_acceleration(OperatingPoint&);

  std::int64_t evaluations() const { return evaluations_; }
  std::int64_t factorizations() const { return factorizations_; }
  std::int64_t iterations() const { return iterations_; }

 private:
  void evaluate(OperatingPoint& at_rest);
  bool factor();
  bool contradicted(const OperatingPoint&, double tolerance) const;
  double length_of(const Eigen::VectorXd& step) const;

  const System& system_;
  Partition partition_;
  ConstraintRows rows_;
  SparseLu lu_;
  Eigen::VectorXd loose_;  // the combination of rows that `hold` has found last

  AugmentedSystem augmented_;
  Equations equations_;
  SparseLu augmented_lu_;

  std::int64_t evaluations_ = 0, factorizations_ = 0, iterations_ = 0;
};

}  // namespace dynalin
