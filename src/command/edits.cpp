#include "command/edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "model/kind_finder.h"

namespace dynalin {

namespace {

using Names = std::span<const std::string_view>;

// What can be taken out of a model: constraints, forces, sensors.
constexpr std::array<std::string_view, 21> switchable = {
    "BEAM",  "BUSHING", "CONTACT", "COUPLER", "CVCV", "FIELD",  "FRICTION", "GCON",         "GEAR",   "GFORCE", "JOINT",
    "JPRIM", "MFORCE",  "MOTION",  "NFORCE",  "PTCV", "SENSOR", "SFORCE",   "SPRINGDAMPER", "VFORCE", "VTORQUE"};

// Arguments of which one alternative ends what the others stated.
struct Alternatives {
  std::string_view statement;  // "" for every one
  std::vector<std::string_view> stated, ended;
};
const std::vector<Alternatives>& alternatives() {
  static const std::vector<Alternatives> table = {
      {"MARKER", {"REULER"}, {"ZP", "XP", "USEXP"}},
      {"MARKER", {"ZP", "XP", "USEXP"}, {"REULER"}},
      {"MARKER", {"PART"}, {"POINT_MASS"}},
      {"MARKER", {"POINT_MASS"}, {"PART"}},
      {"", {"REULER"}, {"ZG", "XG"}},
      {"", {"ZG", "XG"}, {"REULER"}},
      {"", {"CMATRIX"}, {"CRATIO"}},
      {"", {"CRATIO"}, {"CMATRIX"}},
      {"MOTION", {"DISPLACEMENT"}, {"VELOCITY", "ACCELERATION", "ICDISP", "ICVEL"}},
      {"MOTION", {"VELOCITY"}, {"DISPLACEMENT", "ACCELERATION", "ICVEL"}},
      {"MOTION", {"ACCELERATION"}, {"DISPLACEMENT", "VELOCITY"}},
      {"MOTION", {"ROTATIONAL"}, {"TRANSLATIONAL"}},
      {"MOTION", {"TRANSLATIONAL"}, {"ROTATIONAL"}},
      {"MOTION", {"JOINT"}, {"I", "J", "X", "Y", "Z", "B1", "B2", "B3"}},
      {"MOTION", {"I", "J"}, {"JOINT", "ROTATIONAL", "TRANSLATIONAL"}},
      {"MOTION", {"X", "Y", "Z", "B1", "B2", "B3"}, {"X", "Y", "Z", "B1", "B2", "B3"}},
      {"", {"FUNCTION"}, {"FX", "FY", "FZ", "TX", "TY", "TZ", "FXYZ", "TXYZ"}},
      {"", {"FX", "FY", "FZ"}, {"FXYZ", "FUNCTION"}},
      {"", {"TX", "TY", "TZ"}, {"TXYZ", "FUNCTION"}},
      {"", {"FXYZ"}, {"FX", "FY", "FZ", "FUNCTION"}},
      {"", {"TXYZ"}, {"TX", "TY", "TZ", "FUNCTION"}},
      {"FIELD", {"FUNCTION"}, {"KMATRIX", "CMATRIX", "CRATIO", "FORCE"}},
      {"FIELD", {"KMATRIX"}, {"FUNCTION"}},
      {"SPLINE", {"FILE"}, {"X", "Y"}},
      {"SPLINE", {"X", "Y"}, {"FILE", "BLOCK", "CHANNEL"}},
      {"CURVE", {"OPEN"}, {"CLOSED"}},
      {"CURVE", {"CLOSED"}, {"OPEN"}},
      {"CURVE", {"CURVE_POINTS"}, {"CONTROL_POINTS"}},
      {"CURVE", {"CONTROL_POINTS"}, {"CURVE_POINTS"}},
      {"MATRIX", {"FILE"}, {"FULL", "RORDER", "CORDER", "SPARSE", "ROWS", "COLUMNS", "VALUES", "I", "J"}},
      {"MATRIX", {"FULL"}, {"FILE", "NAME", "SPARSE", "I", "J", "RORDER", "CORDER"}},
      {"MATRIX", {"SPARSE"}, {"FILE", "NAME", "FULL", "RORDER", "CORDER", "ROWS", "COLUMNS"}},
  };
  return table;
}

// Arguments of bodies that state where they start, and how fast.
constexpr std::array<std::string_view, 4> places = {"QG", "REULER", "ZG", "XG"};
constexpr std::array<std::string_view, 8> velocities = {"VX", "VY", "VZ", "WX", "WY", "WZ", "VM", "WM"};

bool contains(Names names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

class Editor {
 public:
  Editor(const Dataset& base, Catalogue catalogue, Dataset& out, Diagnostics& diagnostics)
      : finder_(catalogue), out_(out), diagnostics_(diagnostics) {
    for (std::size_t k = 0; k < base.statements.size(); ++k) {
      const Statement& s = base.statements[k];
      if (!s.name.empty()) place_.try_emplace(key(s.name, s.id.value_or(0)), k);
    }
  }

  void apply(const Statement& command) {
    if (command.name == "ACTIVATE" || command.name == "DEACTIVATE") {
      switch_elements(command, command.name == "DEACTIVATE");
    } else {
      redefine(command);
    }
  }
  Restated restated;

 private:
  static std::string key(std::string_view statement, std::int64_t id) { return fmt::format("{}/{}", statement, id); }

  Statement* find(std::string_view statement, std::int64_t id) {
    const auto it = place_.find(key(statement, id));
    return it == place_.end() ? nullptr : &out_.statements[it->second];
  }

  // The full name of an argument of this statement, or the word as written.
  static std::string_view full_name(const Kind* kind, std::string_view word) {
    if (!kind) return word;
    std::vector<std::string_view> names;
    for (const ArgumentInfo& info : kind->arguments) names.push_back(info.name);
    const auto k = find_keyword(word, names);
    return k ? names[*k] : word;
  }

  const Kind* kind_of(const Statement& s) const {
    Diagnostics unused;
    std::size_t at = 0;
    return finder_.find(s, at, unused);
  }

  void redefine(const Statement& command) {
    const bool singleton = command.name == "ACCGRAV";
    if (!singleton && !command.id) {
      if (!command.damaged)
        diagnostics_.error("missing-id", command.at, fmt::format("{} needs an id: {}/1", command.name, command.name));
      return;
    }
    Statement* target = find(command.name, command.id.value_or(0));
    if (!target && singleton) {
      out_.statements.push_back(command);
      place_.emplace(key(command.name, 0), out_.statements.size() - 1);
      return;
    }
    if (!target) {
      diagnostics_.error("unknown-element", command.at,
                         fmt::format("{} does not exist", key(command.name, *command.id)),
                         "a command changes what the dataset defines");
      return;
    }
    merge(*target, command);
  }

  void merge(Statement& target, const Statement& command) {
    std::vector<std::string_view> variants;
    for (const Kind* kind : finder_.kinds_of(command.name)) {
      if (!kind->variant.empty()) variants.push_back(kind->variant);
    }
    const Kind* kind = kind_of(target);
    // Another type first: it decides what the names of the others mean.
    for (const WrittenArgument& w : command.arguments) {
      if (w.has_value || !is_variant(w, variants, kind)) continue;
      std::erase_if(target.arguments,
                    [&](const WrittenArgument& old) { return !old.has_value && is_variant(old, variants, kind); });
      target.arguments.push_back(w);
      kind = kind_of(target);
    }
    const std::size_t before = target.arguments.size();
    for (const WrittenArgument& w : command.arguments) {
      if (!w.has_value && (is_variant(w, variants, kind) || is_list(w, kind))) continue;
      const std::string_view name = full_name(kind, w.name.text());
      end(target, before, kind, [&](std::string_view old) { return old == name; });
      for (const Alternatives& a : alternatives()) {
        if (!a.statement.empty() && a.statement != command.name) continue;
        if (!contains(a.stated, name)) continue;
        end(target, before, kind, [&](std::string_view old) { return old != name && contains(a.ended, old); });
      }
      target.arguments.push_back(w);
      note_start(command, name);
    }
    std::erase_if(target.arguments, [](const WrittenArgument& w) { return w.name.source == nullptr; });
    target.damaged = target.damaged || command.damaged;
  }

  void note_start(const Statement& command, std::string_view argument) {
    const bool body = command.name == "PART" || command.name == "POINT_MASS";
    const bool value = (command.name == "DIFF" || command.name == "VARIABLE") && argument == "IC";
    if ((body && contains(places, argument)) || value) restated.starts.insert({std::string(command.name), *command.id});
    restated.velocities =
        restated.velocities || (body && (contains(places, argument) || contains(velocities, argument)));
  }

  // Takes arguments that stood there before the command out; their places stay until all are read.
  template <class Wanted>
  static void end(Statement& target, std::size_t before, const Kind* kind, const Wanted& wanted) {
    for (std::size_t k = 0; k < before; ++k) {
      WrittenArgument& old = target.arguments[k];
      if (old.name.source && wanted(full_name(kind, old.name.text()))) old.name.source = nullptr;
    }
  }

  static bool is_variant(const WrittenArgument& w, Names variants, const Kind* kind) {
    if (variants.empty() || !find_keyword(w.name.text(), variants)) return false;
    const std::string_view name = full_name(kind, w.name.text());
    return !kind || std::none_of(kind->arguments.begin(), kind->arguments.end(),
                                 [&](const ArgumentInfo& a) { return a.name == name && a.is_flag; });
  }
  // LIST prints what is defined, and changes nothing.
  static bool is_list(const WrittenArgument& w, const Kind* kind) {
    return full_name(kind, w.name.text()) == w.name.text() && w.name.length == 4 &&
           find_keyword(w.name.text(), std::array<std::string_view, 1>{"LIST"}).has_value();
  }

  void switch_elements(const Statement& command, bool inactive) {
    std::string_view statement;
    const WrittenArgument *ids = nullptr, *range = nullptr;
    static constexpr std::array<std::string_view, 2> lists = {"ID", "RANGE"};
    for (const WrittenArgument& w : command.arguments) {
      if (!w.has_value) {
        if (!read_class(w, command, statement)) return;
        continue;
      }
      const auto which = find_keyword(w.name.text(), lists);
      if (!which) {
        diagnostics_.error("unknown-argument", w.name,
                           fmt::format("{} has no argument {}", command.name, w.name.text()),
                           "its arguments are a class, and ID or RANGE");
        return;
      }
      (*which == 0 ? ids : range) = &w;
    }
    if (statement.empty() || (!ids && !range)) {
      if (!command.damaged)
        diagnostics_.error("missing-argument", command.at,
                           fmt::format("{} needs a class, and ID or RANGE", command.name),
                           fmt::format("{}/JOINT, ID=1", command.name));
      return;
    }
    if (ids && range) {
      diagnostics_.error("excluded-arguments", range->name, "ID and RANGE exclude each other");
      return;
    }
    if (ids) {
      const auto list = read_integers(*ids, *ids->name.source, diagnostics_);
      if (!list) return;
      for (const WrittenInteger& id : *list) {
        if (Statement* s = find(statement, id.value)) {
          switch_one(*s, inactive, id.at);
        } else {
          diagnostics_.error("unknown-element", id.at, fmt::format("{}/{} does not exist", statement, id.value));
        }
      }
      return;
    }
    const auto ends = read_integers(*range, *range->name.source, diagnostics_);
    if (!ends) return;
    if (ends->size() != 2) {
      diagnostics_.error("wrong-count", range->value_span(), fmt::format("RANGE takes 2 ids, found {}", ends->size()));
      return;
    }
    bool any = false;
    for (Statement& s : out_.statements) {
      if (s.name != statement || !s.id || *s.id < ends->front().value || *s.id > ends->back().value) continue;
      s.inactive = inactive;
      any = true;
    }
    if (!any)
      diagnostics_.error(
          "unknown-element", range->value_span(),
          fmt::format("no {} has an id from {} to {}", statement, ends->front().value, ends->back().value));
  }

  bool read_class(const WrittenArgument& w, const Statement& command, std::string_view& statement) {
    const std::string_view name = statement_name(w.name.text());
    const bool can = contains(switchable, name) || name == "REQUEST" || name == "MREQUEST";
    if (!can) {
      diagnostics_.error("unknown-word", w.name,
                         fmt::format("{} is no class that {} takes", w.name.text(), command.name),
                         fmt::format("one of {}", fmt::join(switchable, ", ")));
      return false;
    }
    if (!statement.empty()) {
      diagnostics_.error("excluded-arguments", w.name, fmt::format("{} takes one class", command.name));
      return false;
    }
    statement = name;
    return true;
  }

  void switch_one(Statement& s, bool inactive, const Span& at) {
    if (s.inactive == inactive) {
      diagnostics_.warning("already-so", at,
                           fmt::format("{} is {} already", s.at.text(), inactive ? "inactive" : "active"));
    }
    s.inactive = inactive;
  }

  KindFinder finder_;
  Dataset& out_;
  Diagnostics& diagnostics_;
  std::unordered_map<std::string, std::size_t> place_;
};

}  // namespace

std::span<const std::string_view> switchable_classes() { return switchable; }

EditedDataset edited(std::shared_ptr<const Dataset> base, std::shared_ptr<const Dataset> written,
                     std::span<const Statement* const> commands, Catalogue catalogue, Diagnostics& diagnostics) {
  auto out = std::make_shared<Dataset>();
  out->source = base->source;
  out->title = base->title;
  out->statements = base->statements;
  out->origins = {base, std::move(written)};
  Editor editor(*base, catalogue, *out, diagnostics);
  for (const Statement* command : commands) editor.apply(*command);
  return {std::move(out), std::move(editor.restated)};
}

}  // namespace dynalin
