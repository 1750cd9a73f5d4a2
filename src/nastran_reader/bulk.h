// Bulk data: lines in small, large or free field put together to cards.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "nastran_reader/deck_lines.h"
#include "nastran_reader/field.h"

namespace dynalin::nastran_reader {

struct Card {
  std::string name;           // without the * of large field
  Span at;                    // of the name
  Span end;                   // behind the last field written
  std::vector<Field> fields;  // eight for every row of the small field form: those that manuals number 2 to 9
  std::size_t rows() const { return (fields.size() + 7) / 8; }
  // Field `number` (2 to 9) of row 0, 1, …; blank beyond the end.
  const Field& field(std::size_t row, std::size_t number) const;
};

std::vector<Card> read_bulk(std::span<const Line>, Diagnostics&);

}  // namespace dynalin::nastran_reader
