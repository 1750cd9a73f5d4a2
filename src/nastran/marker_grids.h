// GRIDs at markers, with the systems of their axes: markers that are asked for, and those where channels of frequency
// response act and are read. How a grid follows the model is the box's own: relations to states, or a rigid element.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "nastran/deck.h"
#include "nastran/export_options.h"
#include "nastran/ids.h"
#include "study/study_point.h"

namespace dynalin::nastran {

class MarkerGrids {
 public:
  // Ties a grid, which stands at the marker already, to the model; it may fix components of the grid.
  using Tie = std::function<void(Grid&, MarkerId, const Matrix3& axes)>;

  // All of them must outlive this.
  MarkerGrids(const System&, const Motion&, const ExportOptions&, Ids&, Deck&, Tie);

  // Markers by directives. An OPENBOX has all those on bodies anyway. Fails for a marker that does not exist or floats,
  // or leaves it out with a remark if errors are to be ignored.
  StudyResult<void> add_asked(Diagnostics& remarks);
  // Channels of SOL 108, with a remark on each input that excites nothing.
  StudyResult<void> add_channels(Diagnostics& remarks);
  // Says which grids have other numbers than marker_offset and the id of their marker make; when there are all of them.
  void warn_of_numbers(Diagnostics& remarks) const;

  // CORD2R along the axes of a marker, made when first wanted.
  std::int64_t system_of(MarkerId);
  // The grid at a marker whose components are along its own axes or the global ones.
  std::int64_t grid_of(MarkerId, Axes);

 private:
  StudyResult<void> refuse(std::string message, Diagnostics& remarks) const;
  StudyResult<void> add_by_name(std::string_view name, Diagnostics& remarks);
  StudyResult<MarkerId> marker_of(const ChannelMarker&, const std::string& channel) const;
  bool on_ground(MarkerId) const;
  std::string why_idle(MarkerId, std::int64_t grid, int dof) const;

  const System& system_;
  const Motion& motion_;
  const ExportOptions& options_;
  Ids& ids_;
  Deck& deck_;
  Tie tie_;
  std::map<std::int32_t, std::int64_t> systems_;
  std::map<std::pair<std::int32_t, Axes>, std::int64_t> grids_;
  std::vector<std::string> renumbered_;
};

}  // namespace dynalin::nastran
