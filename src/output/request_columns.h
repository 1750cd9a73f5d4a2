// The values of a request as tables and request files have them: in their columns, scaled as OUTPUT says.
#pragma once

#include <array>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "dynalin/units.h"
#include "elements/requests/request_source.h"
#include "elements/settings/output_settings.h"

namespace dynalin {

enum class AngleUnit : bool { radians, degrees };  // of the orientation of DISPLACEMENT

// By place; nothing where the request has no component.
using RequestColumns = std::array<std::optional<double>, 8>;
RequestColumns columns_of(const RequestInfo&, const std::vector<double>& values, const OutputSettings&, AngleUnit);
// What stands above them: TITLE, the given names, or those of the kind of request.
std::array<std::string, 8> column_heads(const RequestInfo&, const OutputSettings&);

// Right-justified in so many places with at least one blank before it, with as many digits as leave room, five at most.
// What is not finite is NAN or INF.
std::string number_field(double, std::size_t width);
// The same without exponent where four digits behind the point say something.
std::string fixed_field(double, std::size_t width);

// Units as request and graphics files name them, "INLBS_PFRACA", and how many units of length are a metre.
std::string unit_code(const Units&);
double units_per_metre(const Units&);
std::string date_and_time(std::time_t);
// A title of 80 places.
std::string title_field(const std::string& title);

}  // namespace dynalin
