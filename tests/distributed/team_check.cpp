// What processes do together, as one program for mpirun: says what is wrong and ends with 1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/arbitrary_vector.h"
#include "distributed/krylov_run.h"
#include "distributed/mumps_call.h"
#include "distributed/team.h"
#include "selected_modes/krylov_schur.h"
#include "system/shifted_lu.h"
#include "system/sparse_lu.h"

namespace {

using namespace dynalin;
using Complex = std::complex<double>;

int wrong = 0;
void expect(bool true_, const std::string& what) {
  if (true_) return;
  fmt::print("wrong: {}\n", what);
  ++wrong;
}

// Differences in space on a cube, not symmetric: factors fill in.
ColumnMatrix cube(int side) {
  std::vector<Triplet> entries;
  const auto at = [&](int x, int y, int z) { return (x * side + y) * side + z; };
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        const int k = at(x, y, z);
        entries.push_back({k, k, 6.0 + 0.01 * k});
        if (x + 1 < side) entries.push_back({k, at(x + 1, y, z), -1.0}), entries.push_back({at(x + 1, y, z), k, -1.5});
        if (y + 1 < side) entries.push_back({k, at(x, y + 1, z), -1.0}), entries.push_back({at(x, y + 1, z), k, -0.5});
        if (z + 1 < side) entries.push_back({k, at(x, y, z + 1), -1.0}), entries.push_back({at(x, y, z + 1), k, -1.0});
      }
    }
  }
  return compressed(side * side * side, side * side * side, entries);
}

double residual(const ColumnMatrix& m, Complex shift, const Eigen::VectorXcd& x, const Eigen::VectorXcd& b,
                bool adjoint) {
  Eigen::VectorXcd r = b;
  for_each_entry(m, [&](std::int32_t row, std::int32_t column, double v) {
    adjoint ? r(column) -= v * x(row) : r(row) -= v * x(column);
  });
  r += (adjoint ? std::conj(shift) : shift) * x;
  return r.norm() / b.norm();
}

void check_factors(bool several) {
  const ColumnMatrix m = cube(14);
  const Complex shift(1.3, 0.4);
  ShiftedLu lu(m, m.columns);
  expect(lu.factor(shift), "the matrix is factored");
  const FactorCost cost = last_mumps_factors();
  fmt::print("{} unknowns, {:.0f} entries, {:.0f} of them here, {:.3g} operations, {:.0f} MB\n", cost.unknowns,
             cost.entries, cost.entries_here, cost.operations, cost.megabytes);
  expect(cost.unknowns == m.columns && cost.entries > 1e5, "MUMPS has factored it");
  expect(several ? cost.entries_here < 0.9 * cost.entries : cost.entries_here == cost.entries,
         "every process has a part of the factors");
  const Eigen::VectorXcd b = arbitrary_vector(m.columns, 1);
  Eigen::VectorXcd x = b, y = b;
  lu.solve(x), lu.solve_adjoint(y);
  expect(residual(m, shift, x, b, false) < 1e-12, "solve");
  expect(residual(m, shift, y, b, true) < 1e-12, "solve_adjoint");
  // Of far shifts the determinant is that of −σ, nearly: log det = n log(−σ) − trace/σ …
  const Complex far(0, 1e9);
  expect(lu.factor(far), "the matrix is factored once more");
  const double n = m.columns;
  const Complex determinant = lu.log_determinant();
  expect(std::abs(determinant.real() - n * std::log(1e9)) < 1e-6 * n, "the modulus of the determinant");
  const double turned = std::remainder(determinant.imag() - n * std::arg(-far), 2 * M_PI);
  expect(std::abs(turned) < 1e-4 || std::abs(std::abs(turned) - M_PI) < 1e-4, "the phase of the determinant");
}

// Upper triangular with known eigenvalues 1/k, two of them twice.
void check_krylov(bool several) {
  constexpr Eigen::Index size = 500;
  const auto value = [](Eigen::Index k) {
    return Complex(k == 3 ? 1.0 / 3 : 1.0 / static_cast<double>(k + 1), k == 5 ? 0.1 : 0.0);
  };
  int applied = 0;
  const auto op = [&](Eigen::VectorXcd& v) {
    ++applied;
    for (Eigen::Index k = 0; k < size; ++k) v(k) = value(k) * v(k) + (k + 1 < size ? 0.01 * v(k + 1) : Complex(0));
  };
  const Eigen::MatrixXcd none(size, 0);
  const auto run = krylov_run_of_team(op, {none, arbitrary_vector(size, 7), 4, 30, 0, 300});
  expect(run.has_value() == several, "the processes iterate together if there are several");
  if (run) {
    expect(run->converged && run->basis.cols() >= 4, "it converges");
    const Eigen::MatrixXcd Q = run->basis, identity = Eigen::MatrixXcd::Identity(Q.cols(), Q.cols());
    expect((Q.adjoint() * Q - identity).norm() < 1e-12, "its basis is orthonormal");
    expect((run->images - Q * (Q.adjoint() * run->images)).norm() < 1e-9, "and invariant");
  }
  // Through the search, which goes on beside what was found.
  KrylovSchur space(size);
  expect(space.run(op, 3, 0) && space.run(op, 3, 0) && space.run(op, 10, 0.14), "further runs converge");
  std::vector<Complex> found;
  for (Eigen::Index k = 0; k < space.found(); ++k) found.push_back(space.triangle()(k, k));
  for (Eigen::Index k = 0; k < 6; ++k) {
    const bool there =
        std::any_of(found.begin(), found.end(), [&](Complex v) { return std::abs(v - value(k)) < 1e-7; });
    expect(there, fmt::format("eigenvalue {} is found", k));
  }
  // An operator that fails is an error here, and the others go on.
  const auto fails = [&](Eigen::VectorXcd&) {
    if (++applied > 0) throw std::runtime_error("on purpose");
  };
  bool thrown = false;
  try {
    KrylovSchur(size).run(fails, 3, 0);
  } catch (const std::runtime_error&) {
    thrown = true;
  }
  expect(thrown, "an error of the operator comes back");
  KrylovSchur after(size);
  expect(after.run(op, 3, 0), "and what follows works");
}

}  // namespace

int main(int argc, char**) {
  Team team;
  if (!team.leads()) return team.serve();
  const bool several = argc > 1;
  check_factors(several);
  check_krylov(several);
  return team.end(wrong > 0 ? 1 : 0);
}
