// Executive and case control: what is solved, and which sets and matrices of the deck it takes.
#pragma once

#include <string>
#include <vector>

#include "nastran/deck.h"
#include "nastran/deck_matrices.h"
#include "nastran/export_options.h"
#include "nastran/frequency_response.h"
#include "nastran/ids.h"

namespace dynalin::nastran {

// "Simulation time 0.5"
std::string subtitle(const Deck&, const ExportOptions&);

// The SETs of names of matrices, one for each kind that the deck has.
struct MatrixSet {
  MatrixKind kind;
  std::int64_t number;
  std::vector<std::string> names;
};
std::vector<MatrixSet> matrix_sets(const std::vector<WrittenMatrix>&, const ExportOptions&, Ids&);

// All lines before the bulk data, BEGIN BULK included.
std::string control_text(const Deck&, const ExportOptions&, const std::vector<MatrixSet>&,
                         const std::vector<ResponseCase>&);
// PARAM cards, and EIGC of solution 107.
void write_control_cards(const Deck&, const ExportOptions&, CardFile&);

}  // namespace dynalin::nastran
