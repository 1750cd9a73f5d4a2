// The tables of modes: one list of what there is.
#pragma once

#include <span>

#include "dynalin/modal_table.h"
#include "modal/modal_distribution.h"
#include "study/linearization.h"
#include "study/sums_over_modes.h"

namespace dynalin {

struct TablesFound {
  std::vector<ModalTable> tables;
  std::vector<SumsOverModes> sums;  // of those of all modes
  Diagnostics remarks;
};

// How LINEAR asks for a table.
enum class TableAsked : std::uint8_t {
  by_numbers,               // NAME=i1, i2
  by_numbers_or_frequency,  // and FNAME=r1, r2
  all_or_by_numbers,        // NAME=ALL
};

// A table of each mode, or one of all modes: what it is made of, how LINEAR asks for it, and how it is to look.
struct ModalTableKind {
  std::string_view name;  // the argument of LINEAR that asks for it
  std::string_view help;
  TableAsked asked = TableAsked::by_numbers_or_frequency;
  std::span<const std::string_view> columns{};  // for complex values a magnitude and a phase each
  std::string_view title{};
  std::string_view nothing{};   // said where all values are zero
  std::string_view no_share{};  // said where there is none, as those of all cancel
  bool totals = false;          // the last column sums up the others, and is summed up itself
  bool short_names = false;     // of statements, four letters
  std::vector<ModalTable::Row> (*rows)(const ModalDistribution&, std::size_t mode, std::span<const MarkerId>) = nullptr;
  // Instead of it, of one of all modes.
  StudyResult<TablesOfAllModes> (*of_all)(const Linearization&, const EigenSolution&,
                                          const ModalTableRequest&) = nullptr;
  bool needs_all_modes = false;      // NMODES and BAND exclude it
  std::string_view only_argument{};  // of LINEAR: nothing but this table reads it
};
// In the order in which they stand below a mode, then those of all modes.
std::span<const ModalTableKind> modal_table_kinds();
const ModalTableKind* find_modal_table(std::string_view name);
bool asks_for_all_modes(const ModalTableRequest&);

StudyResult<TablesFound> modal_tables(const Linearization&, const EigenSolution&, const ModalTableRequest&);

}  // namespace dynalin
