#include "nastran/force_types.h"

#include <set>
#include <string>
#include <vector>

#include "dataset/characters.h"
#include "elements/catalogue.h"

namespace dynalin::nastran {

std::span<const std::string_view> force_types() {
  static const auto names = [] {
    std::set<std::string> found;
    for (const Kind* kind : catalogue()) {
      if (kind->energy_rows != Kind::EnergyRows::none) found.insert(lower_case(kind->statement));
    }
    return found;
  }();
  static const std::vector<std::string_view> types(names.begin(), names.end());
  return types;
}

}  // namespace dynalin::nastran
