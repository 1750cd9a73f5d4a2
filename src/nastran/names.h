// How comments of a deck call the elements of a model.
#pragma once

#include <string>
#include <string_view>

#include "mechanics/handles.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

// The view name where there is one and it is wanted, "PART/3" otherwise.
inline std::string name_of(const ElementLabel& label, const ExportOptions& options) {
  return options.use_view_names && !label.view_name.empty() ? std::string(label.view_name) : label.text();
}
// The same with what the card is of it: "centre of mass of PART/3".
inline std::string name_of(std::string_view role, const ElementLabel& label, const ExportOptions& options) {
  const std::string name = name_of(label, options);
  return options.verbose_names ? std::string(role) + " of " + name : name;
}

}  // namespace dynalin::nastran
