// An operating point as tables to be read: for the terminal and the message file.
#pragma once

#include <iosfwd>
#include <limits>

#include "dynalin/operating_state.h"
#include "dynalin/units.h"

namespace dynalin {

struct StateTables {
  bool short_form = false;  // positions, reactions and forces alone, the first of each
  std::size_t rows = std::numeric_limits<std::size_t>::max();
};
inline constexpr StateTables short_tables{true, 6};

void write_operating_state(std::ostream&, const OperatingState&, const Units&, const StateTables& = {});

}  // namespace dynalin
