// The requests of a system, and their values at a point.
#pragma once

#include "dynalin/request_values.h"
#include "elements/requests/request_source.h"
#include "system/system.h"

namespace dynalin {

// Those that can be evaluated: REQUESTs in the order of the dataset, then those of MREQUESTs.
struct PointRequests {
  std::vector<const RequestInfo*> infos;  // they live as long as the system
  std::vector<RequestValues> values;      // in the same order
};
PointRequests requests_at(const System&, const OperatingPoint&);

// Of each that has a component without a finite value, why: "F2 of REQUEST/3 has no finite value at time 1: SQRT of
// -3".
struct UndefinedRequest {
  RequestName request;
  std::string reason;
};
std::vector<UndefinedRequest> undefined_requests(const System&, const OperatingPoint&);

}  // namespace dynalin
