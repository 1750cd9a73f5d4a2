// One run of a Krylov iteration by all processes of a team: what selected_modes/krylov_schur.h does alone, with the
// vectors of the space spread over their memories. Without DYNALIN_DISTRIBUTED there is none: alone.cpp.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace dynalin {

struct KrylovTask {
  const Eigen::MatrixXcd& locked;  // orthonormal columns that are invariant; what is searched is their complement
  Eigen::VectorXcd start;
  Eigen::Index wanted, space;  // values, and vectors of the space
  double least;                // it ends at values below
  int restarts;
};

struct KrylovRun {
  Eigen::MatrixXcd basis;   // Q of what was found: orthonormal, and to `locked`
  Eigen::MatrixXcd images;  // Op Q
  std::vector<std::complex<double>> in_sight;
  bool converged = false;
};

// Nothing if there is one process alone, or what the iteration has found is not invariant.
std::optional<KrylovRun> krylov_run_of_team(const std::function<void(Eigen::VectorXcd&)>& op, const KrylovTask&);

}  // namespace dynalin
