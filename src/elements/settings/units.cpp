// UNITS/FORCE=, MASS=, LENGTH=, TIME=   or   UNITS/SYSTEM=   or   UNITS/UCF=
//
// A dataset is calculated in its own units; only one number follows from the statement, the units consistency
// factor with
//
//     force · UCF = mass · acceleration
//
// so that mass/UCF and inertia/UCF are the dynamical values. N, kg, mm, s give UCF = 1000.
#include <fmt/format.h>

#include <algorithm>

#include "base/enumeration.h"
#include "elements/settings/time_unit.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"

namespace dynalin {

namespace {

struct UnitName {
  std::string_view name;
  double si;
};

constexpr double inch = 0.0254, foot = 0.3048, pound = 0.45359237, gravity = 9.80665;
constexpr double pound_force = pound * gravity;

// clang-format off
constexpr std::array force_units = {
    UnitName{"NEWTON", 1.0}, UnitName{"KNEWTON", 1e3}, UnitName{"MEGANEWTON", 1e6},
    UnitName{"CENTINEWTON", 1e-2}, UnitName{"MILLINEWTON", 1e-3}, UnitName{"MICRONEWTON", 1e-6},
    UnitName{"NANONEWTON", 1e-9}, UnitName{"DYNE", 1e-5}, UnitName{"KILOGRAM_FORCE", gravity},
    UnitName{"POUND_FORCE", pound_force}, UnitName{"KPOUND_FORCE", 1e3 * pound_force},
    UnitName{"OUNCE_FORCE", pound_force / 16}, UnitName{"POUNDAL", pound * foot},
};
constexpr std::array mass_units = {
    UnitName{"KILOGRAM", 1.0}, UnitName{"GRAM", 1e-3}, UnitName{"MILLIGRAM", 1e-6},
    UnitName{"MICROGRAM", 1e-9}, UnitName{"NANOGRAM", 1e-12}, UnitName{"TONNE", 1e3},
    UnitName{"POUND_MASS", pound}, UnitName{"KPOUND_MASS", 1e3 * pound}, UnitName{"OUNCE_MASS", pound / 16},
    UnitName{"SLUG", pound_force / foot}, UnitName{"SLINCH", pound_force / inch},
    UnitName{"US_TON", 2e3 * pound},
};
constexpr std::array length_units = {
    UnitName{"METER", 1.0}, UnitName{"MILLIMETER", 1e-3}, UnitName{"CENTIMETER", 1e-2},
    UnitName{"KILOMETER", 1e3}, UnitName{"MICROMETER", 1e-6}, UnitName{"NANOMETER", 1e-9},
    UnitName{"ANGSTROM", 1e-10}, UnitName{"INCH", inch}, UnitName{"FOOT", foot}, UnitName{"YARD", 3 * foot},
    UnitName{"MILE", 5280 * foot}, UnitName{"MILS", 1e-3 * inch}, UnitName{"MICROINCH", 1e-6 * inch},
};
constexpr std::array time_units = {
    UnitName{"SECOND", 1.0}, UnitName{"MILLISECONDS", 1e-3}, UnitName{"MICROSECOND", 1e-6},
    UnitName{"NANOSECOND", 1e-9}, UnitName{"MINUTE", 60.0}, UnitName{"HOUR", 3600.0}, UnitName{"DAY", 86400.0},
};
// SYSTEM: length, mass, time and force; NONE is dimensionless.
struct UnitSystem { std::string_view name; UnitName length, mass, time, force; };
constexpr std::array systems = {
    UnitSystem{"MKS", {"METER", 1.0}, {"KILOGRAM", 1.0}, {"SECOND", 1.0}, {"NEWTON", 1.0}},
    UnitSystem{"CGS", {"CENTIMETER", 1e-2}, {"GRAM", 1e-3}, {"SECOND", 1.0}, {"DYNE", 1e-5}},
    UnitSystem{"FPS", {"FOOT", foot}, {"POUND_MASS", pound}, {"SECOND", 1.0}, {"POUND_FORCE", pound_force}},
    UnitSystem{"IPS", {"INCH", inch}, {"POUND_MASS", pound}, {"SECOND", 1.0}, {"POUND_FORCE", pound_force}},
    UnitSystem{"NONE", {"", 1.0}, {"", 1.0}, {"", 1.0}, {"", 1.0}},
};
// clang-format on

struct UnitsStatement {
  std::vector<std::string> force, mass, length, time, system;
  std::optional<double> ucf;
  UnitName force_unit{"", 1}, mass_unit{"", 1}, length_unit{"", 1}, time_unit{"", 1};
  double factor = 1;

  static constexpr std::array<Argument<UnitsStatement>, 6> arguments = {{
      {.name = "FORCE", .slot = &UnitsStatement::force, .help = "unit of force, such as NEWTON"},
      {.name = "MASS", .slot = &UnitsStatement::mass, .help = "unit of mass, such as KILOGRAM"},
      {.name = "LENGTH", .slot = &UnitsStatement::length, .help = "unit of length, such as MILLIMETER"},
      {.name = "TIME", .slot = &UnitsStatement::time, .help = "unit of time, such as SECOND"},
      {.name = "SYSTEM", .slot = &UnitsStatement::system, .help = "MKS, CGS, FPS, IPS or NONE"},
      {.name = "UCF", .slot = &UnitsStatement::ucf, .help = "the consistency factor itself"},
  }};
};

// Symbols of the SI and others, which the language does not know, and what they are called there.
constexpr auto symbols = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"KG", "KILOGRAM"},
    {"LB", "POUND_MASS"},
    {"LBM", "POUND_MASS"},
    {"LBF", "POUND_FORCE"},
    {"MM", "MILLIMETER"},
    {"CM", "CENTIMETER"},
    {"KM", "KILOMETER"},
    {"UM", "MICROMETER"},
    {"FT", "FOOT"},
    {"YD", "YARD"},
    {"MS", "MILLISECONDS"},
    {"HR", "HOUR"},
});

std::string_view name_of_symbol(std::string_view symbol, std::span<const std::string_view> names) {
  for (const auto& [written, name] : symbols) {
    if (written == symbol && std::ranges::find(names, name) != names.end()) return name;
  }
  return {};
}

template <std::size_t n, class Entry>
const Entry* look_up(const std::array<Entry, n>& table, const std::vector<std::string>& word, std::string_view argument,
                     ElementReader& reader) {
  std::array<std::string_view, n> names;
  std::transform(table.begin(), table.end(), names.begin(), [](const Entry& e) { return e.name; });
  std::vector<std::string_view> tied;
  if (const auto k = find_keyword(word.front(), names, &tied)) return &table[*k];
  if (!tied.empty()) {
    reader.error("unknown-unit", reader.at(argument),
                 fmt::format("{} may mean several units of {}", word.front(), argument),
                 fmt::format("it could be {}", enumeration(tied, "or")));
    return nullptr;
  }
  const auto meant = name_of_symbol(word.front(), names);
  const auto near = meant.empty() ? nearest_word(word.front(), names) : meant;
  reader.error(
      "unknown-unit", reader.at(argument), fmt::format("{} is no unit of {}", word.front(), argument),
      near.empty() ? fmt::format("known are {}", fmt::join(names, ", ")) : fmt::format("did you mean {}?", near));
  return nullptr;
}

class UnitsSet final : public TypedSet<UnitsStatement> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    UnitsStatement& u = elements[k];
    if (!read_arguments(u, reader)) return;
    const int four = !u.force.empty() + !u.mass.empty() + !u.length.empty() + !u.time.empty();
    const int forms = (four > 0) + !u.system.empty() + u.ucf.has_value();
    if (forms != 1 || (four > 0 && four < 4)) {
      if (reader.statement().damaged) return;
      reader.error("mixed-units", reader.statement().at,
                   "UNITS needs all of FORCE, MASS, LENGTH and TIME, or SYSTEM alone, or UCF alone");
      return;
    }
    if (u.ucf) {
      u.factor = *u.ucf;
      if (u.factor <= 0) reader.error("value-out-of-range", reader.at("UCF"), "UCF must be positive");
      return;
    }
    if (!u.system.empty()) {
      const UnitSystem* s = look_up(systems, u.system, "SYSTEM", reader);
      if (!s) return;
      u.force_unit = s->force, u.mass_unit = s->mass, u.length_unit = s->length, u.time_unit = s->time;
    } else {
      const UnitName* force = look_up(force_units, u.force, "FORCE", reader);
      const UnitName* mass = look_up(mass_units, u.mass, "MASS", reader);
      const UnitName* length = look_up(length_units, u.length, "LENGTH", reader);
      const UnitName* time = look_up(time_units, u.time, "TIME", reader);
      if (!force || !mass || !length || !time) return;
      u.force_unit = *force, u.mass_unit = *mass, u.length_unit = *length, u.time_unit = *time;
    }
    u.factor = u.force_unit.si * u.time_unit.si * u.time_unit.si / (u.mass_unit.si * u.length_unit.si);
    // Products of decimal prefixes pick up rounding; a power of ten is meant exactly.
    const double decade = std::pow(10.0, std::round(std::log10(u.factor)));
    if (std::abs(u.factor / decade - 1) < 1e-13) u.factor = decade;
  }
  void finish(Model& model, Diagnostics&) override {
    if (elements.empty()) return;
    const UnitsStatement& u = elements[0];
    model.units = {true,
                   u.factor,
                   u.length_unit.si,
                   std::string(u.force_unit.name),
                   std::string(u.mass_unit.name),
                   std::string(u.length_unit.name),
                   std::string(u.time_unit.name)};
  }
};

}  // namespace

double seconds_in(std::string_view unit_of_time) {
  const auto found = std::ranges::find(time_units, unit_of_time, &UnitName::name);
  return found == time_units.end() ? 1.0 : found->si;
}

namespace {

constexpr ToldBeforehand told_of_units = {.makes_modes = true};

}  // namespace

extern constinit const Kind units =
    Kind{"UNITS",
         "",
         "Units of the dataset; they enter by the consistency factor alone.",
         Kind::Role::singleton,
         detail::argument_infos<UnitsStatement>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<UnitsSet>(kind); }}
        .for_good()
        .telling(told_of_units);

}  // namespace dynalin
