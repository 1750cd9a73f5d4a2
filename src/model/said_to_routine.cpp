// What a statement says to the routine that it calls beside constants.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "model/called_routines.h"
#include "routine/given_inputs.h"

namespace dynalin {

namespace {

// Which of these words stands in the statement for itself, nothing if none does.
std::optional<std::size_t> word_of(const Statement& s, std::span<const std::string_view> words) {
  for (const WrittenArgument& w : s.arguments) {
    if (w.has_value) continue;
    if (const auto k = find_keyword(w.name.text(), words)) return k;
  }
  return std::nullopt;
}

constexpr std::array<std::string_view, 2> ways = {"ROTATIONAL", "TRANSLATIONAL"};
bool is_rotational(const Statement& s) { return word_of(s, ways) == std::size_t{0}; }

}  // namespace

bool CalledRoutines::slides(int joint) const {
  const auto found = std::find_if(dataset_.statements.begin(), dataset_.statements.end(),
                                  [&](const Statement& j) { return j.name == "JOINT" && j.id == joint; });
  return found != dataset_.statements.end() && word_of(*found, ways) == std::size_t{1};
}

// Whoever reads the statement says what is wrong with it.
std::vector<RoutineStatement::Coupled> CalledRoutines::coupled_by(const Statement& s) const {
  std::string types;
  if (const WrittenArgument* w = argument(s, "TYPE"); w && w->has_value) {
    for (const char c : w->value_span().text())
      if (c == 'T' || c == 'R') types += c;
  }
  std::vector<RoutineStatement::Coupled> all;
  for (const int joint : integers(s, "JOINTS")) {
    all.push_back({joint, all.size() < types.size() ? types[all.size()] : slides(joint) ? 'T' : 'R'});
  }
  if (all.size() > most_given_to_coupler) all.resize(most_given_to_coupler);
  return all;
}

RoutineStatement::Drive CalledRoutines::drive_of(const Statement& s) const {
  static constexpr std::array<std::string_view, 6> axes = {"X", "Y", "Z", "B1", "B2", "B3"};
  static constexpr std::array<std::string_view, 3> levels = {"DISPLACEMENT", "VELOCITY", "ACCELERATION"};
  RoutineStatement::Drive d;
  d.joint = integer(s, "JOINT");
  d.level = levels[word_of(s, levels).value_or(0)].data();
  const auto axis = word_of(s, axes);
  if (axis) axes[*axis].copy(d.axis.data(), d.axis.size());
  const auto way = word_of(s, ways);
  const bool translates = axis ? *axis < 3 : way ? *way == 1 : slides(d.joint);
  d.type = translates ? "TRANSLATION" : "ROTATION";
  return d;
}

RoutineStatement::Watch CalledRoutines::watch_of(const Statement& s) const {
  static constexpr std::array<std::string_view, 3> conditions = {"EQ", "GE", "LE"};
  RoutineStatement::Watch w;
  w.value = real(s, "VALUE");
  if (argument(s, "ERROR")) w.error = real(s, "ERROR");
  conditions[word_of(s, conditions).value_or(0)].copy(w.condition.data(), w.condition.size());
  return w;
}

// Null where the modes are not known.
std::shared_ptr<const RoutineStatement::ModalLoad> CalledRoutines::modal_load_of(const Statement& s,
                                                                                 bool scaled) const {
  const RoutineData::Modes* modes = modes_of(integer(s, "FLEX_BODY"));
  if (!modes) return nullptr;
  return std::make_shared<const RoutineStatement::ModalLoad>(
      RoutineStatement::ModalLoad{integer(s, "FLEX_BODY"), modes->number.size(), modes->cases, modes->loads, scaled});
}

CurveStatement CalledRoutines::curve_of(const Statement& s, const RoutineStatement& what) const {
  CurveStatement c{what.label, what.id, what.parameters, argument(s, "CLOSED") != nullptr, integer(s, "ORDER")};
  if (argument(s, "MINPAR")) c.first = real(s, "MINPAR");
  if (argument(s, "MAXPAR")) c.last = real(s, "MAXPAR");
  return c;
}

std::shared_ptr<const RoutineStatement::Heading> CalledRoutines::heading_of(const Statement& s) const {
  RoutineStatement::Heading h;
  const auto text = [&](std::string_view name) {
    const WrittenArgument* w = argument(s, name);
    Diagnostics ignored;
    if (!w || !w->has_value || w->damaged || w->value().empty()) return std::string();
    return read_text(*w, *w->name.source, ignored).value_or("");
  };
  h.comment = text("COMMENT");
  std::string titles = text("TITLE");
  for (std::string& title : h.titles) {
    const std::size_t end = std::min(titles.find(':'), titles.size());
    title = titles.substr(0, end);
    titles.erase(0, end + 1);
  }
  return std::make_shared<const RoutineStatement::Heading>(std::move(h));
}

std::optional<RoutineStatement> CalledRoutines::says(const Statement& s, const WrittenArgument* call) {
  RoutineStatement out;
  out.label = fmt::format("{}/{}", s.name, s.id.value_or(0));
  out.id = static_cast<int>(s.id.value_or(0));
  out.constant_arrays = constant_arrays_, out.data = data_;
  if (call) {
    auto constants = constants_of(*call, out.label);
    if (!constants) return std::nullopt;
    out.parameters = RoutineConstants(*constants);
  }
  out.I = integer(s, "I"), out.J = integer(s, "J"), out.RM = integer(s, "RM"), out.JFLOAT = integer(s, "JFLOAT");
  out.action_only = argument(s, "ACTIONONLY") != nullptr;
  out.rotation = s.name == "SFORCE" && is_rotational(s);
  if (s.name == "NFORCE") out.markers = std::make_shared<const std::vector<int>>(integers(s, "IMARKERS"));
  if (s.name == "COUPLER") out.coupled = coupled_by(s);
  if (s.name == "MOTION") out.drive = drive_of(s);
  if (s.name == "SENSOR") out.watch = watch_of(s);
  if (s.name == "REQUEST") out.heading = heading_of(s);
  if (s.name == "CONTACT") {
    auto sides = std::make_shared<RoutineStatement::Sides>();
    const auto take = [&](std::string_view side, std::vector<int>& ids, std::vector<int>& reversed) {
      ids = integers(s, fmt::format("{}GEOM", side));
      std::vector<int> turned = integers(s, fmt::format("{}FLIP_GEOMETRY", side));
      const std::vector<int> more = integers(s, fmt::format("{}FLIP_NORMAL", side));
      turned.insert(turned.end(), more.begin(), more.end());
      for (const int id : ids) reversed.push_back(std::ranges::find(turned, id) != turned.end());
    };
    take("I", sides->I, sides->reversed_I), take("J", sides->J, sides->reversed_J);
    out.sides = std::move(sides);
  }
  out.static_hold = argument(s, "STATIC_HOLD") != nullptr;
  out.implicit = argument(s, "IMPLICIT") != nullptr;
  if (const auto* w = argument(s, "IC"); w && (s.name == "VARIABLE" || s.name == "DIFF") && !w->damaged) {
    Diagnostics ignored;
    if (const auto list = read_reals(*w, *w->name.source, ignored); list && !list->empty()) {
      out.initial = list->front();
      if (list->size() > 1) out.initial_rate = (*list)[1];
    }
  }
  return out;
}

}  // namespace dynalin
