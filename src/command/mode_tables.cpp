#include "command/mode_tables.h"

#include <sstream>

#include "linear/modal_distribution.h"
#include "linear/modal_sums.h"
#include "output/modal_tables.h"

namespace dynalin {

StudyResult<std::string> mode_tables(const LinearCommand& command, const Linearization& of,
                                     const EigenSolution& modes) {
  const System& system = *of.system;
  const OperatingPoint& point = of.point;
  const LinearSystem& linear = of.linear;
  std::ostringstream out;
  const ModalDistribution distribution(system, point, linear, modes);
  const ModalTableFormat format{command.table_precision, command.names};
  std::vector<MarkerId> listed;
  for (const std::int64_t id : command.marker_list) listed.push_back(*system.model().find_marker(id));
  write_modal_title(out, modes.time);
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const auto in = [&](const LinearCommand::Modes& m) { return m.has(k + 1, modes.modes[k]); };
    const bool coordinates = in(command.coordinates), kinetic = in(command.kinetic), strain = in(command.strain),
               dissipation = in(command.dissipation), markers = in(command.markers);
    if (!coordinates && !kinetic && !strain && !dissipation && !markers) continue;
    write_mode_header(out, k + 1, distribution.header(k));
    if (coordinates) write_shape(out, format, ShapeTable::coordinates, distribution.coordinates(k));
    if (markers) write_shape(out, format, ShapeTable::markers, distribution.markers(k, listed));
    if (kinetic) write_kinetic(out, format, distribution.kinetic(k));
    if (strain) write_forces(out, format, ForceTable::strain, distribution.strain(k));
    if (dissipation) write_forces(out, format, ForceTable::dissipation, distribution.dissipation(k));
  }
  if (command.energy_per_mode.wanted()) {
    const auto energies = energy_per_mode(system, point, linear, modes);
    if (!energies) return tl::unexpected(StudyFailure(energies.error()));
    write_energies(out, format, *energies,
                   [&](std::size_t k) { return command.energy_per_mode.has(k + 1, modes.modes[k]); });
  }
  if (command.mass_per_mode.wanted()) {
    const auto frame = command.modal_rm ? *system.model().find_marker(*command.modal_rm) : MarkerId{};
    write_masses(out, format, modal_masses(system, point, linear, modes, frame), command.modal_rm.value_or(0),
                 [&](std::size_t k) { return command.mass_per_mode.has(k + 1, modes.modes[k]); });
  }
  return out.str();
}

}  // namespace dynalin
