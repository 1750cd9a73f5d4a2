// The values of a REQUEST of markers: the measures of its markers, or the forces between them.
#pragma once

#include <vector>

#include "elements/requests/request_source.h"
#include "mechanics/marker_references.h"

namespace dynalin {

class MarkerRequest {
 public:
  MarkerRequest(RequestKind, const Signals&, MarkerId i, MarkerId j, MarkerId axes);
  // As many as components_of(kind).
  void evaluate(const Motion&, std::vector<double>& values) const;

 private:
  RequestKind kind_;
  MarkerFrame i_, j_, axes_;
  std::vector<MarkerLoad> loads_;
};

}  // namespace dynalin
