// MU_STATIC and MU_DYNAMIC, as FRICTION and CONTACT state them.
#pragma once

#include <fmt/format.h>

#include "model/reader.h"

namespace dynalin {

inline void warn_of_coefficient_order(double mu_static, double mu_dynamic, ElementReader& reader) {
  if (mu_dynamic <= mu_static) return;
  const bool stated = reader.given("MU_DYNAMIC");
  reader.warning("coefficient-order", reader.at(stated ? "MU_DYNAMIC" : "MU_STATIC"),
                 fmt::format("{} slides with more friction, {:g}, than it sticks with, {:g}", reader.label().text(),
                             mu_dynamic, mu_static),
                 stated ? "MU_STATIC and MU_DYNAMIC may have changed places" : "MU_DYNAMIC is not stated");
}

}  // namespace dynalin
