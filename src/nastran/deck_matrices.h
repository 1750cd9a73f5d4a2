// The matrices of a deck as DMIG: names, symmetric parts, what is too small, headers and columns.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "nastran/card_file.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

struct WrittenMatrix {
  std::string name;  // at most eight letters and digits, its own in the deck
  MatrixKind kind = MatrixKind::K;
  bool symmetric = false;              // IFO 6, the lower triangle alone
  std::vector<Matrix::Entry> entries;  // by columns, then rows
  Owner owner;
};

// None is empty. `details` has a line for each matrix of the deck: `debug`.
std::vector<WrittenMatrix> written_matrices(const Deck&, const ExportOptions&, Diagnostics& remarks,
                                            std::vector<std::string>& details);
// Header and columns; terms of large fields in double precision, of small ones in single.
void write(const WrittenMatrix&, FieldWidth, CardFile&);

}  // namespace dynalin::nastran
