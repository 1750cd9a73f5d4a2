// What all parts of an OPENBOX add to.
#pragma once

#include "nastran/marker_grids.h"
#include "nastran/open_points.h"
#include "nastran/wrenches.h"

namespace dynalin::nastran {

struct OpenDeck {
  const ExportOptions& options;
  Ids& ids;
  Deck& deck;
  OpenPoints& points;
  MarkerGrids& markers;
  const SingleWrenches& wrenches;
};

}  // namespace dynalin::nastran
