// Function names: those with a formula, and those the language knows beyond them.
#include "expression/functions.h"

#include <array>
#include <numbers>

#include "expression/name_index.h"

namespace dynalin {

namespace {

constexpr std::array constants = {
    NamedConstant{"PI", std::numbers::pi, {"", "3.14159…", "", ""}},
    NamedConstant{
        "DTOR", std::numbers::pi / 180.0, {"", "π/180: a number of degrees times DTOR is in radians", "", ""}},
    NamedConstant{"RTOD", 180.0 / std::numbers::pi, {"", "180/π: radians times RTOD are degrees", "", ""}},
    NamedConstant{"FXMODE", 0, {"", "the number of a mode in CRATIO of a FLEX_BODY, 0 anywhere else", "", ""}},
};

constexpr std::array<std::string_view, 1> calls_not_built = {"USER"};
constexpr std::array<std::string_view, 1> names_alone_not_built = {"FXFREQ"};

}  // namespace

const Function* find_function(std::string_view name) {
  static const NameIndex<Function> names = {elementary_functions(), contact_functions(), series_functions()};
  return names.find(name);
}

bool has_kinks(std::string_view name) {
  const Function* f = find_function(name);
  return f ? f->kinked : name == "IF";
}

std::span<const NamedConstant> named_constants() { return constants; }

std::span<const std::string_view> functions_not_built() { return calls_not_built; }
std::span<const std::string_view> names_not_built() { return names_alone_not_built; }

}  // namespace dynalin
