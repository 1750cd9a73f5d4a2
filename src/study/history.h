// Histories of simulations over time, step by step.
#pragma once

#include "dynalin/history.h"
#include "system/request_values.h"

namespace dynalin {

// Adds what VARIABLEs and REQUESTs are at a point. All steps of a history are of one system.
void append(History&, const System&, const OperatingPoint&, const std::vector<RequestValues>&);
inline void append(History& history, const System& system, const OperatingPoint& point) {
  append(history, system, point, requests_at(system, point).values);
}

}  // namespace dynalin
