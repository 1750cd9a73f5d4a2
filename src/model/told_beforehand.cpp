// What routines can be told of a model before it is read: how long its lists are, which of them are constants, and
// which data it has. How many modes flexible bodies have, and their modal loads, takes reading these by themselves,
// once, where a routine needs them.
#include <algorithm>
#include <array>

#include "model/called_routines.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

// What a flexible body is made of, without arguments that refer to anything else. Damping changes no mode, and a
// routine may give it.
struct Needed {
  std::string_view statement;
  std::array<std::string_view, 3> left_out;
};
constexpr std::array<Needed, 3> needed = {{{"UNITS", {}}, {"MATRIX", {}}, {"FLEX_BODY", {"CRATIO", "VM", "WM"}}}};

}  // namespace

const RoutineData::Modes* CalledRoutines::modes_of(std::int64_t flex_body) const {
  if (!bodies_) {
    auto bodies = std::make_shared<Dataset>();
    bodies->source = dataset_.source, bodies->title = dataset_.title;
    for (const Statement& s : dataset_.statements) {
      const auto part = std::ranges::find(needed, s.name, &Needed::statement);
      const bool ground = s.name == "PART" && argument(s, "GROUND") != nullptr;
      if (part == needed.end() && !ground) continue;
      std::erase_if(bodies->statements.emplace_back(s).arguments, [&](const WrittenArgument& w) {
        const std::string_view name = full_name(s, w);
        return ground ? name != "GROUND"
                      : !name.empty() && std::ranges::find(part->left_out, name) != part->left_out.end();
      });
    }
    bodies_ = std::make_shared<RoutineData>();
    RoutineOptions alone;
    alone.data = bodies_;
    // Whoever reads the whole model says what is wrong.
    if (build_model(std::move(bodies), catalogue_, {}, alone).diagnostics.has_errors())
      bodies_->flexible_bodies.clear();
  }
  const auto found = bodies_->flexible_bodies.find(static_cast<int>(flex_body));
  return found == bodies_->flexible_bodies.end() ? nullptr : &found->second;
}

std::optional<std::size_t> CalledRoutines::size_of_list(std::string_view statement, std::int32_t id) const {
  const auto find = [&](std::string_view name, std::int64_t of) -> const Statement* {
    const auto found = std::find_if(dataset_.statements.begin(), dataset_.statements.end(),
                                    [&](const Statement& s) { return s.name == name && s.id == of; });
    return found == dataset_.statements.end() ? nullptr : &*found;
  };
  if (statement == "FLEX_BODY") {
    const RoutineData::Modes* modes = modes_of(id);
    return modes ? std::optional(modes->number.size()) : std::nullopt;
  }
  const Statement* s = find(statement, id);
  if (!s) return std::nullopt;
  Diagnostics ignored;
  if (const auto* w = argument(*s, "VARIABLES"); w && !w->damaged) {
    const auto list = read_integers(*w, *w->name.source, ignored);
    return list ? std::optional(list->size()) : std::nullopt;
  }
  if (const auto* w = argument(*s, "NUMBERS"); w && !w->damaged) {
    const auto list = read_reals(*w, *w->name.source, ignored);
    return list ? std::optional(list->size()) : std::nullopt;
  }
  if (statement == "GSE") return static_cast<std::size_t>(std::max(integer(*s, "NS"), 0));
  // Of states or outputs: the element that has them says how many.
  for (const Statement& e : dataset_.statements) {
    if (e.name != "GSE" && e.name != "LSE" && e.name != "TFSISO") continue;
    if (integer(e, "X") == id) {
      if (e.name == "GSE") return static_cast<std::size_t>(std::max(integer(e, "NS"), 0));
      if (e.name == "TFSISO") {
        const auto* w = argument(e, "DENOMINATOR");
        const auto list = w && !w->damaged ? read_reals(*w, *w->name.source, ignored) : std::nullopt;
        return list && !list->empty() ? std::optional(list->size() - 1) : std::nullopt;
      }
      const Statement* a = find("MATRIX", integer(e, "A"));
      if (a && integer(*a, "ROWS") > 0) return static_cast<std::size_t>(integer(*a, "ROWS"));
    }
    if (e.name == "GSE" && integer(e, "XD") == id) return static_cast<std::size_t>(std::max(integer(e, "ND"), 0));
    if (integer(e, "Y") == id) {
      if (e.name == "GSE") return static_cast<std::size_t>(std::max(integer(e, "NO"), 0));
      if (e.name == "TFSISO") return std::size_t{1};
      const Statement* c = find("MATRIX", integer(e, integer(e, "C") > 0 ? "C" : "D"));
      if (c && integer(*c, "ROWS") > 0) return static_cast<std::size_t>(integer(*c, "ROWS"));
    }
  }
  if (const int size = integer(*s, "SIZE"); size > 0) return static_cast<std::size_t>(size);
  return std::nullopt;
}

std::shared_ptr<const std::vector<int>> CalledRoutines::constant_arrays() const {
  auto ids = std::make_shared<std::vector<int>>();
  for (const Statement& s : dataset_.statements) {
    if (s.name == "GSE") ids->push_back(integer(s, "XD"));
    if (s.name == "ARRAY" && argument(s, "NUMBERS")) ids->push_back(static_cast<int>(s.id.value_or(0)));
  }
  std::ranges::sort(*ids);
  return ids;
}

std::shared_ptr<RoutineData> CalledRoutines::ids_of_data() const {
  auto data = std::make_shared<RoutineData>();
  for (const Statement& s : dataset_.statements) {
    const int id = static_cast<int>(s.id.value_or(0));
    if (s.name == "SPLINE") data->splines[id];
    if (s.name == "CURVE") data->curves[id];
    if (s.name == "MATRIX") data->matrices[id];
    if (s.name == "FLEX_BODY") data->flexible_bodies[id];
    if (s.name != "STRING") continue;
    // Routines look at texts when they are asked what they read.
    std::string& text = data->strings[id];
    const WrittenArgument* w = argument(s, "STRING");
    if (!w || !w->has_value || w->damaged || w->value().empty()) continue;
    Diagnostics ignored;
    text = read_text(*w, *w->name.source, ignored).value_or("").substr(0, RoutineData::longest_text);
  }
  return data;
}

}  // namespace dynalin
