// The tables of modes: one list of what there is.
#pragma once

#include <span>

#include "dynalin/modal_table.h"
#include "linear/modal_distribution.h"
#include "linear/modal_sums.h"
#include "study/linearization.h"

namespace dynalin {

// A table of one mode: what it is made of, and how it is to look.
struct ModalTableKind {
  std::string_view name;                      // the argument of LINEAR that asks for it
  std::span<const std::string_view> columns;  // for complex values a magnitude and a phase each
  std::string_view title;
  std::string_view nothing{};  // said where all values are zero
  bool totals = false;         // the last column sums up the others, and is summed up itself
  bool short_names = false;    // of statements, four letters
  std::vector<ModalTable::Row> (*rows)(const ModalDistribution&, std::size_t mode, std::span<const MarkerId>);
};
// In the order in which they stand below a mode.
std::span<const ModalTableKind> modal_table_kinds();
const ModalTableKind* find_modal_table(std::string_view name);

struct TablesFound {
  std::vector<ModalTable> tables;
  std::optional<EnergyPerMode> energies;  // whole, if it was asked for
  std::optional<ModalMasses> masses;
  Diagnostics remarks;
};
StudyResult<TablesFound> modal_tables(const Linearization&, const EigenSolution&, const ModalTableRequest&);

}  // namespace dynalin
