// Decks checked and solved: what `dynalin nastran check` and `dynalin nastran solve` do, without terminal and files.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "nastran_reader/deck.h"
#include "nastran_reader/reduction.h"

namespace dynalin::nastran_reader {

// A deck with its equations; these are there if nothing is wrong with it.
struct Prepared {
  Deck deck;
  std::optional<Points> points;
  Equations equations;
  Elimination elimination;
  Diagnostics diagnostics;
  bool assembled() const { return points && elimination.T.rows() == points->freedoms(); }
};

enum class Purpose {
  check,               // everything that Nastran would refuse is an error
  solve,               // what changes no result is a warning, what would be left out an error
  solve_what_is_known  // unknown cards are left out
};
Prepared prepare(Deck deck, Diagnostics reading, Purpose);
Prepared prepare(const std::string& path, Purpose);

// SOL 107: everything that a deck determines about its free vibrations.
struct ModeSolution {
  std::vector<std::complex<double>> eigenvalues;  // finite ones, radians per unit of time, both of each pair, by size
  Eigen::Index zeros = 0;                         // of them those that are zero by the structure of the matrices
  int degrees_of_freedom = 0;                     // of all points
  Eigen::Index independent = 0;                   // that constraints leave and matrices touch
  Reduced reduced;
};
// The error is a reason; a deck that is wrong has none but that. Remarks on freedoms that nothing touches go to the
// diagnostics.
tl::expected<ModeSolution, std::string> solve_modes(const Prepared&, Diagnostics&);
// Of the file, in one go: the error is all that is wrong, as on the terminal.
tl::expected<ModeSolution, std::string> solve_modes(const std::string& path);

// The motion of every freedom in one mode, its largest component 1.
Eigen::VectorXcd mode_shape(const Prepared&, const ModeSolution&, std::complex<double> eigenvalue);

// SOL 108: one subcase.
struct ResponseCase {
  int subcase = 0;  // 0: the deck has none
  std::string label;
  std::vector<double> frequencies;  // cycles per unit of time, increasing
  Eigen::MatrixXcd displacements;   // freedoms × frequencies, in components of CD
  std::vector<int> points;          // whose displacements the case asks for, increasing
};
// Says which dynamic loads do nothing at any frequency, of a deck that is assembled.
void tell_idle_loads(const Prepared&, Diagnostics&);
tl::expected<std::vector<ResponseCase>, std::string> solve_response(const Prepared&, Diagnostics&);

}  // namespace dynalin::nastran_reader
