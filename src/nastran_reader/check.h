// What is wrong with a deck beyond its single fields.
#pragma once

#include <string_view>

#include "nastran_reader/points.h"

namespace dynalin::nastran_reader {

// Whether a point and its component exist; otherwise an error that begins with the card.
bool check_freedom(const Freedom&, std::string_view card, const Points&, Diagnostics&);

// Numbers that stand twice, references that lead nowhere, rules of single cards that need others to be seen.
void check_references(const Deck&, const Points&, Diagnostics&);
// Selections of case control, sets that nobody selects, components that are dependent twice.
void check_constraints(const Deck&, const Points&, Diagnostics&);
// DMIG and the commands that select it.
void check_matrices(const Deck&, const Points&, Diagnostics&);
// Solution, methods, frequencies, dynamic loads and their tables.
void check_loads(const Deck&, const Points&, Diagnostics&);

// What a solution of this deck would leave out or get wrong: errors, where `check_…` above warn or are silent.
void check_solvable(const Deck&, bool ignore_unknown, Diagnostics&);
// Cards of which nothing is known, a warning a kind.
void warn_of_unknown(const Deck&, Diagnostics&);

}  // namespace dynalin::nastran_reader
