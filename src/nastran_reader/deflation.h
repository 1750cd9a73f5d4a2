// Pencils λE − A with a singular E: what is algebraic is condensed, so that finite eigenvalues alone are left.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynalin::nastran_reader {

struct Pencil {
  Eigen::MatrixXd E, A;
};

// Powers of two by which the largest entries of rows and columns come near one.
struct Scales {
  Eigen::VectorXd rows, columns;
  Eigen::MatrixXd of(const Eigen::MatrixXd& m) const { return rows.asDiagonal() * m * columns.asDiagonal(); }
};
Scales equilibrating(Eigen::MatrixXd m);

// Rows of `m` that depend on others: m(dependent) = factors · m(independent), up to rounding of the entries of m after
// rows and columns have been scaled to like sizes, so that units do not matter.
struct DependentRows {
  std::vector<Eigen::Index> independent, dependent;
  Eigen::MatrixXd factors;
};
DependentRows dependent_rows(const Eigen::MatrixXd& m);

// Takes infinite eigenvalues out, those behind each other included, by exact elimination: a row of E that depends on
// others gives an equation without rate, by which one unknown follows from the rest. How many unknowns went, or −1 if
// the pencil is singular: its determinant vanishes for every λ.
Eigen::Index deflate_infinite(Pencil&);
// The same for eigenvalues of zero.
Eigen::Index deflate_zero(Pencil&);

}  // namespace dynalin::nastran_reader
