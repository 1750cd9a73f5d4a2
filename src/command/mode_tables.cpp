#include "command/mode_tables.h"

#include <sstream>

#include "output/modal_tables.h"

namespace dynalin {

std::string mode_tables_text(const LinearCommand& command, const EigenSolution& modes, const TablesFound& found) {
  std::ostringstream out;
  const ModalTableFormat format{command.table_precision, command.names};
  write_modal_title(out, modes.time);
  for (const ModalTable& table : found.tables) write_modal_table(out, format, table);
  const auto wanted = [&](const char* name) {
    return [&modes, range = command.tables.of(name)](std::size_t k) { return range.has(k + 1, modes.modes[k]); };
  };
  if (found.energies) write_energies(out, format, *found.energies, wanted("ENERGY_PER_MODE"));
  if (found.masses)
    write_masses(out, format, *found.masses, command.tables.modal_rm.value_or(0), wanted("MASS_PER_MODE"));
  if (found.masses && modes.selected) {
    out << "  Sums and percentages are those of selected modes: what Sum lacks of Model is in modes that were not "
           "asked for.\n\n";
  }
  return out.str();
}

}  // namespace dynalin
