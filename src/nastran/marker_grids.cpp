#include "nastran/marker_grids.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "nastran/named_elements.h"
#include "nastran/names.h"

namespace dynalin::nastran {

MarkerGrids::MarkerGrids(const System& system, const Motion& motion, const ExportOptions& options, Ids& ids, Deck& deck,
                         Tie tie)
    : system_(system), motion_(motion), options_(options), ids_(ids), deck_(deck), tie_(std::move(tie)) {}

bool MarkerGrids::on_ground(MarkerId m) const { return system_.layout().marker(m).body == ground_body; }

StudyResult<void> MarkerGrids::refuse(std::string message, Diagnostics& remarks) const {
  if (!options_.ignore_errors) return tl::unexpected(StudyFailure({"export", std::move(message), {}}));
  remarks.warning("export-left-out", {}, message + "; the export goes on without it");
  return {};
}

StudyResult<void> MarkerGrids::add_asked(Diagnostics& remarks) {
  const Model& model = system_.model();
  const auto count = static_cast<std::int32_t>(model.markers.size());
  const auto in_a_range = [&](std::int64_t id) {
    return std::ranges::any_of(options_.export_markers_by_id,
                               [&](const IdRange& r) { return id >= r.first && id <= r.last; });
  };
  for (const IdRange& range : options_.export_markers_by_id) {
    // One that is named alone has to be there; of a range those that are.
    if (range.first == range.last && !model.find_marker(range.first)) {
      if (auto done = refuse(fmt::format("MARKER/{} does not exist", range.first), remarks); !done) return done;
    }
  }
  for (std::int32_t k = 1; k < count; ++k) {
    const Marker& marker = model.marker({k});
    const bool named = in_a_range(marker.label->id);
    if (marker.floating) {
      if (!named) continue;
      auto done = refuse(fmt::format("{} is floating and cannot be exported", marker.label->full_text()), remarks);
      if (!done) return done;
      continue;
    }
    const bool all = on_ground({k}) ? options_.export_ground_markers : deck_.open || options_.export_all_markers;
    if (all || named) grid_of({k}, Axes::local);
  }
  for (const std::string& name : options_.export_markers_by_name) {
    if (auto done = add_by_name(name, remarks); !done) return done;
  }
  return {};
}

StudyResult<void> MarkerGrids::add_by_name(std::string_view name, Diagnostics& remarks) {
  const Model& model = system_.model();
  const auto found = marker_of_name(model, name);
  if (!found) return refuse(found.error().message, remarks);
  const Marker& marker = model.marker(*found);
  if (marker.floating)
    return refuse(fmt::format("{} is floating and cannot be exported", marker.label->full_text()), remarks);
  grid_of(*found, Axes::local);
  return {};
}

StudyResult<MarkerId> MarkerGrids::marker_of(const ChannelMarker& at, const std::string& channel) const {
  const Model& model = system_.model();
  const auto fail = [&](const std::string& why) {
    return tl::unexpected(StudyFailure({"export", fmt::format("channel {}: {}", channel, why), {}}));
  };
  const auto marker = marker_of_channel(model, at);
  if (!marker) return fail(marker.error().message);
  if (model.marker(*marker).floating) return fail(model.marker(*marker).label->full_text() + " is floating");
  return *marker;
}

// Why a force along a component of the grid at a marker does nothing, if so.
std::string MarkerGrids::why_idle(MarkerId m, std::int64_t grid, int dof) const {
  const std::string marker = system_.layout().marker_label(m).full_text();
  if (on_ground(m)) return fmt::format("{} is on the ground", marker);
  const BodyBlock& body = system_.layout().body(system_.layout().marker(m).body);
  if (dof > 3 && !body.turns()) return fmt::format("{} is on {}, which does not turn", marker, body.label.full_text());
  const auto at = std::ranges::find(deck_.grids, grid, &Grid::id);
  const bool held = at != deck_.grids.end() && at->fixed.find(std::to_string(dof)) != std::string::npos;
  return held ? fmt::format("constraints hold {} there", marker) : std::string{};
}

StudyResult<void> MarkerGrids::add_channels(Diagnostics& remarks) {
  if (options_.solution_number != 108) return {};
  for (std::size_t k = 0; k < options_.force_input_channel.size(); ++k) {
    const InputChannel& channel = options_.force_input_channel[k];
    const auto marker = marker_of(channel, channel.name);
    if (!marker) {
      if (auto done = refuse(marker.error().message, remarks); !done) return done;
      continue;
    }
    const std::int64_t grid = grid_of(*marker, channel.mode);
    if (const std::string why = why_idle(*marker, grid, channel.dof); !why.empty())
      remarks.warning("idle-channel", {}, fmt::format("input channel {} excites nothing: {}", channel.name, why));
    deck_.inputs.push_back({k, grid, channel.mode == Axes::local ? system_of(*marker) : 0});
  }
  for (std::size_t k = 0; k < options_.displacement_output_channel.size(); ++k) {
    const OutputChannel& channel = options_.displacement_output_channel[k];
    const auto marker = marker_of(channel, channel.name);
    if (!marker) {
      if (auto done = refuse(marker.error().message, remarks); !done) return done;
      continue;
    }
    deck_.outputs.push_back({k, grid_of(*marker, channel.mode)});
  }
  return {};
}

std::int64_t MarkerGrids::system_of(MarkerId m) {
  std::int64_t& id = systems_[m.index];
  if (id != 0) return id;
  const MarkerPlace& place = system_.layout().marker(m);
  CoordinateSystem s;
  s.body = deck_.open && !on_ground(m) ? place.body.index - 1 : -1;
  s.name = name_of("axes", system_.layout().marker_label(m), options_);
  s.id = id = ids_.take(IdSpace::coordinate_system, options_.cord2r_offset);
  s.origin = motion_.point(place);
  s.axes = motion_.axes(place);
  deck_.systems.push_back(std::move(s));
  return id;
}

std::int64_t MarkerGrids::grid_of(MarkerId m, Axes axes) {
  std::int64_t& id = grids_[{m.index, axes}];
  if (id != 0) return id;
  const MarkerPlace& place = system_.layout().marker(m);
  const ElementLabel& label = system_.layout().marker_label(m);
  const bool numbered = deck_.open && options_.use_adams_ids;
  Grid g;
  g.body = deck_.open && !on_ground(m) ? place.body.index - 1 : -1;
  g.name = name_of(label, options_);
  const std::int64_t wanted = numbered ? options_.marker_offset + label.id : options_.grid_offset;
  g.id = id = ids_.take(IdSpace::point, wanted);
  // A second grid at one marker cannot have its number as well.
  const auto count = grids_.count({m.index, Axes::local}) + grids_.count({m.index, Axes::global});
  if (numbered && id != wanted && count == 1) renumbered_.push_back(fmt::format("{}: GRID {}", label.full_text(), id));
  g.position = motion_.point(place);
  g.displacement_system = axes == Axes::local ? system_of(m) : 0;
  tie_(g, m, axes == Axes::local ? motion_.axes(place) : Matrix3::identity());
  deck_.grids.push_back(std::move(g));
  return id;
}

void MarkerGrids::warn_of_numbers(Diagnostics& remarks) const {
  if (renumbered_.empty()) return;
  constexpr std::size_t most = 6;
  std::vector<std::string> first(renumbered_.begin(),
                                 renumbered_.begin() + static_cast<std::ptrdiff_t>(std::min(most, renumbered_.size())));
  if (renumbered_.size() > most) first.push_back(fmt::format("{} more", renumbered_.size() - most));
  remarks.warning("taken-number", {},
                  fmt::format("marker_offset {} and the ids of markers make numbers that other grids have: those after "
                              "them are taken ({})",
                              options_.marker_offset, fmt::join(first, ", ")),
                  "a marker_offset above all other numbers of points");
}

}  // namespace dynalin::nastran
