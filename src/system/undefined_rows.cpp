#include "system/undefined_rows.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

std::string undefined_value_of(const std::vector<UndefinedValue>& undefined_values, const ElementLabel& label) {
  const auto found = std::find_if(undefined_values.begin(), undefined_values.end(),
                                  [&](const UndefinedValue& f) { return same_element(*f.of, label); });
  return found == undefined_values.end() ? std::string() : found->reason;
}

std::optional<std::string> undefined_row(const System& system, const Motion& motion, const ConstraintRows& rows,
                                         int order) {
  // How the acceleration of a row changes with positions moves nothing: it counts in linear models.
  const bool varied = motion.mode == AnalysisMode::linear;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const auto row = rows.row(k);
    const Taylor& along = rows.along_motion(k);
    const int known = rows.level(k) == RowLevel::position ? order : 0;  // of others not all orders are there
    const bool finite = (known < 1 || std::isfinite(along.rate)) && (known < 2 || std::isfinite(along.acceleration)) &&
                        std::all_of(row.begin(), row.end(), [&](const ConstraintRows::Entry& e) {
                          return std::isfinite(e.c.g) && std::isfinite(e.c.v) && std::isfinite(e.c.a1) &&
                                 (std::isfinite(e.c.a0) || !varied);
                        });
    if (finite) continue;
    const auto at = static_cast<std::size_t>(k);
    std::string reason;
    if (at < system.layout().rows.size())
      reason = undefined_value_of(system.undefined_values(motion), *system.layout().rows[at].owner);
    return reason.empty() ? system.row_text(k) + " has no finite derivative" : reason;
  }
  return std::nullopt;
}

}  // namespace dynalin
