// Results as JSON values.
#pragma once

#include <nlohmann/json.hpp>

#include "dynalin/history.h"
#include "dynalin/operating_state.h"
#include "dynalin/remark.h"
#include "dynalin/request_values.h"
#include "dynalin/units.h"

namespace dynalin {

using Json = nlohmann::ordered_json;

Json json_of(const Units&);
Json json_of(const OperatingState&);
Json json_of(const Stability&);
Json json_of(const std::vector<RequestValues>&);
Json json_of(const History&);
// {"code", "message", "hint", "at": {"file", "line", "column"}}; `at` is null where no file states it.
Json json_of(const Remark&);

}  // namespace dynalin
