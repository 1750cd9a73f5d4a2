// Bodies by name, the first few of many.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mechanics/layout.h"

namespace dynalin {

inline std::string part_names(const Layout& layout, const std::vector<std::size_t>& bodies) {
  constexpr std::size_t named_parts = 6;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(bodies.size(), named_parts); ++k)
    names.push_back(layout.bodies[bodies[k]].label.full_text());
  std::string text = fmt::format("{}", fmt::join(names, ", "));
  if (bodies.size() > named_parts) text += fmt::format(" and {} more", bodies.size() - named_parts);
  return text;
}

}  // namespace dynalin
