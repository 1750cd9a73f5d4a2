#include "command/mode_tables.h"

#include <sstream>

#include "linear/modal_energy.h"
#include "output/modal_tables.h"

namespace dynalin {

Result<std::string> mode_tables(const LinearCommand& command, const System& system, const OperatingPoint& point,
                                const LinearSystem& linear, const EigenSolution& modes) {
  std::ostringstream out;
  const ModalEnergy energy(system, point, linear, modes);
  const ModalTableFormat format{command.table_precision, command.names};
  std::vector<MarkerId> listed;
  for (const std::int64_t id : command.marker_list) listed.push_back(*system.model().find_marker(id));
  write_modal_title(out, modes.time);
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const auto in = [&](const LinearCommand::Modes& m) { return m.has(k + 1, modes.modes[k]); };
    const bool coordinates = in(command.coordinates), kinetic = in(command.kinetic), strain = in(command.strain),
               dissipation = in(command.dissipation), markers = in(command.markers);
    if (!coordinates && !kinetic && !strain && !dissipation && !markers) continue;
    write_mode_header(out, k + 1, energy.header(k));
    if (coordinates) write_shape(out, format, ShapeTable::coordinates, energy.coordinates(k));
    if (markers) write_shape(out, format, ShapeTable::markers, energy.markers(k, listed));
    if (kinetic) write_kinetic(out, format, energy.kinetic(k));
    if (strain) write_forces(out, format, ForceTable::strain, energy.strain(k));
    if (dissipation) write_forces(out, format, ForceTable::dissipation, energy.dissipation(k));
  }
  return out.str();
}

}  // namespace dynalin
