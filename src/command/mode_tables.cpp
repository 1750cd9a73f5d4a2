#include "command/mode_tables.h"

#include <sstream>

#include "output/modal_tables.h"

namespace dynalin {

std::string mode_tables_text(const LinearCommand& command, const EigenSolution& modes, const TablesFound& found) {
  std::ostringstream out;
  const ModalTableFormat format{command.table_precision, command.names};
  write_modal_title(out, modes.time);
  for (const ModalTable& table : found.tables) write_modal_table(out, format, table);
  for (const SumsOverModes& sums : found.sums) write_sums(out, format, sums);
  return out.str();
}

}  // namespace dynalin
