#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "model/kind_finder.h"
#include "model/model.h"
#include "model/reader.h"
#include "model/user_routines.h"

namespace dynalin {

namespace {

// One statement of the dataset on its way into the model.
struct Placement {
  const Statement* statement;
  ElementSet* set;                // nullptr: it makes no element, which is reported
  std::int32_t index;             // in the set
  std::int32_t variant_argument;  // the written argument that chose the kind, or no_variant
  BodyId preceding_body;

  std::size_t at() const { return static_cast<std::size_t>(index); }
};
constexpr std::int32_t no_variant = -1;
constexpr std::size_t no_argument = KindFinder::no_argument;

// Statements of which an atom function needs an argument, by name and id.
using ExaminedStatements = std::map<std::pair<std::string_view, std::int64_t>, const Statement*>;
bool is_examined(std::string_view statement) {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const AtomFunction& f : atom_functions()) {
      if (!f.required_argument.empty()) list.push_back(f.statement);
    }
    return list;
  }();
  return std::ranges::find(names, statement) != names.end();
}

class Reader final : public ElementReader {
 public:
  Reader(Model& model, const Placement& placement, const ExaminedStatements& examined,
         const DatasetWithRoutines& routines, const SourceText& source, Diagnostics& diagnostics)
      : ElementReader(*placement.statement, source, diagnostics, placement.set->labels[placement.at()]),
        model_(model),
        placement_(placement),
        examined_(examined),
        routines_(routines) {
    if (placement.variant_argument != no_variant) {
      const auto& w = placement.statement->arguments[static_cast<std::size_t>(placement.variant_argument)];
      assignments.push_back({placement.set->kind().variant, w.name});
    }
  }

  std::optional<MarkerId> marker(const WrittenInteger& id, std::string_view argument) override {
    const auto m = model_.find_marker(id.value);
    if (!m || (id.value == 0)) {
      report_missing("MARKER", "unknown-marker", id, argument);
      return std::nullopt;
    }
    return m;
  }

  std::optional<BodyId> body(std::string_view statement, const WrittenInteger& id) override {
    const auto b = model_.find_body(statement, id.value);
    if (!b) {
      error("unknown-body", id.at,
            fmt::format("{} refers to {}/{}, which does not exist", label().text(), statement, id.value));
    }
    return b;
  }

  std::optional<ElementHandle> element(std::string_view statement, const WrittenInteger& id) override {
    const auto h = model_.find(statement, id.value);
    if (!h) report_missing(statement, "unknown-element", id, "");
    return h;
  }

  std::optional<Expression> expression(const WrittenArgument& written) override {
    if (written.damaged) return std::nullopt;  // reported when the text was read
    const std::size_t before = diagnostics().error_count();
    Expression e = written.name.source == routines_.calls.get()
                       ? routine_at(written)
                       : parse_expression(written.value(), *written.name.source, diagnostics());
    if (diagnostics().error_count() == before) check_references(e);
    if (diagnostics().error_count() > before) return std::nullopt;
    return e;
  }

  std::optional<VectorExpression> vector_expression(const WrittenArgument& written) override {
    if (written.damaged) return std::nullopt;
    const std::size_t before = diagnostics().error_count();
    VectorExpression v = parse_vector_expression(written.value(), *written.name.source, diagnostics());
    for (std::size_t k = 0; k < 3 && diagnostics().error_count() == before; ++k) check_references(v.component[k]);
    if (diagnostics().error_count() > before) return std::nullopt;
    return v;
  }

  std::optional<BodyId> preceding_body() const override {
    if (!placement_.preceding_body.valid()) return std::nullopt;
    return placement_.preceding_body;
  }

  void keep(SourceRef source) override { model_.further_sources.push_back(std::move(source)); }
  void reads(std::string path) override { model_.input_files.push_back(std::move(path)); }
  std::string folder() const override { return std::filesystem::path(source().name()).parent_path().string(); }

 private:
  const Expression& routine_at(const WrittenArgument& written) const {
    Diagnostics ignored;
    return routines_.functions[static_cast<std::size_t>(read_integer(written, *written.name.source, ignored)->value)];
  }

  void report_missing(std::string_view statement, std::string_view code, const WrittenInteger& id, std::string_view) {
    error(code, id.at, fmt::format("{} refers to {}/{}, which does not exist", label().text(), statement, id.value),
          near_ids(statement, id.value));
  }

  // "MARKER/112 and MARKER/1211 exist": ids that differ by one digit more, less or other. These few are looked up, so
  // that the hint costs the same in models of any size.
  std::string near_ids(std::string_view statement, std::int64_t id) const {
    const std::string wanted = std::to_string(id);
    std::vector<std::string> near;
    const auto consider = [&](const std::string& digits) {
      constexpr std::size_t most_digits = 10;
      if (digits.empty() || digits.size() > most_digits || digits.front() == '0' || digits == wanted) return;
      const std::int64_t candidate = std::stoll(digits);
      const bool exists = statement == "MARKER" ? model_.find_marker(candidate).has_value()
                                                : model_.find(statement, candidate).has_value();
      if (exists) near.push_back(fmt::format("{}/{}", statement, candidate));
    };
    if (wanted.front() == '-') return {};
    for (std::size_t k = 0; k <= wanted.size(); ++k) {
      const std::string before = wanted.substr(0, k), here = wanted.substr(k, 1),
                        after = wanted.substr(std::min(k + 1, wanted.size()));
      if (!here.empty()) consider(before + after);
      for (char digit = '0'; digit <= '9'; ++digit) {
        if (!here.empty()) consider(before + digit + after);
        consider(before + digit + here + after);
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    if (near.size() > 3) near.resize(3);
    if (near.empty()) return {};
    return fmt::format("{} {}", fmt::join(near, " and "), near.size() == 1 ? "exists" : "exist");
  }

  void check_id(const Atom& atom, std::size_t k, std::string_view statement) {
    const std::int64_t id = atom.argument[k];
    const bool is_marker = statement == "MARKER";
    if (is_marker && id == 0) return;
    if (is_marker ? model_.find_marker(id).has_value() : model_.find(statement, id).has_value()) return;
    report_missing(statement, is_marker ? "unknown-marker" : "unknown-element", {id, atom.argument_at[k]}, "");
  }

  // SENVAL reads what an argument of its SENSOR yields, so that must be there.
  void check_required_argument(const Atom& atom) {
    const AtomFunction& f = *atom.function;
    if (f.required_argument.empty()) return;
    const auto found = examined_.find({f.statement, atom.argument[0]});
    if (found == examined_.end()) return;
    const auto& arguments = found->second->arguments;
    const bool given = std::any_of(arguments.begin(), arguments.end(), [&](const WrittenArgument& w) {
      return find_keyword(w.name.text(), std::span(&f.required_argument, 1)).has_value();
    });
    if (given) return;
    error("missing-argument", atom.argument_at[0],
          fmt::format("{} reads {} of {}/{}, which has none", f.name, f.required_argument, f.statement,
                      atom.argument[0]));
  }

  void check_references(const Expression& e) {
    for (const Atom& atom : e.atoms()) check_atom(atom);
    for (const SplineUse& use : e.splines()) {
      const std::string_view statement = use.statement();
      if (use.spectrum && (model_.spectra.empty() || model_.spectra.back().id_at.offset != use.id_at.offset)) {
        model_.spectra.push_back(use);  // once, where a vector reads it three times
      }
      if (!model_.find(statement, use.id)) report_missing(statement, "unknown-element", {use.id, use.id_at}, "");
    }
  }

  void check_atom(const Atom& atom) {
    const AtomFunction& f = *atom.function;
    switch (f.family) {
      case AtomFamily::time:
        return;
      case AtomFamily::marker_measure:
      case AtomFamily::marker_force:
        for (std::size_t k = 0; k < atom.argument_count; ++k) check_id(atom, k, "MARKER");
        return;
      case AtomFamily::data:
        if (f.statement.empty()) return;
        check_id(atom, 0, f.statement);
        check_required_argument(atom);
        if (atom.argument_count > 1 && atom.argument[1] < 1) {
          error("value-out-of-range", atom.argument_at[1],
                fmt::format("the second argument of {} counts from 1", f.name));
        }
        return;
      case AtomFamily::delay:
        check_references(atom.delayed->value);
        check_references(atom.delayed->lag);
        check_references(atom.delayed->history);
        if (atom.delayed->array > 0 && !model_.find("ARRAY", atom.delayed->array))
          report_missing("ARRAY", "unknown-element", {atom.delayed->array, atom.delayed->array_at}, "");
        return;
      case AtomFamily::element_force:
        check_id(atom, 0, f.statement);
        if (atom.argument[1] != 0 && atom.argument[1] != 1) {
          error("value-out-of-range", atom.argument_at[1],
                fmt::format("the second argument of {} is 0 (force on I) or 1 (force on J)", f.name));
        }
        if (atom.argument[2] < 1 || atom.argument[2] > 8) {
          error("value-out-of-range", atom.argument_at[2],
                fmt::format("the third argument of {} is a component, 1 to 8: FM FX FY FZ TM TX TY TZ", f.name));
        }
        if (atom.argument_count > 3) check_id(atom, 3, "MARKER");
        return;
    }
  }

  Model& model_;
  const Placement& placement_;
  const ExaminedStatements& examined_;
  const DatasetWithRoutines& routines_;
};

bool is_ground(const Statement& s) {
  static constexpr std::array<std::string_view, 1> ground = {"GROUND"};
  return std::any_of(s.arguments.begin(), s.arguments.end(), [&](const WrittenArgument& w) {
    return !w.has_value && find_keyword(w.name.text(), ground).has_value();
  });
}

class Builder {
 public:
  Builder(std::shared_ptr<const Dataset> dataset, Catalogue catalogue, const BuildOptions& options,
          const RoutineOptions& routines)
      : catalogue_(catalogue), finder_(catalogue), model_(std::make_unique<Model>()) {
    routines_ = with_user_routines(std::move(dataset), catalogue, options, routines, diagnostics_);
    model_->dataset = routines_.dataset;
    model_->further_sources = routines_.further_texts, model_->input_files = routines_.files;
    if (model_->dataset == options.read_once) read_once_ = options.read_once.get();
    model_->title = model_->dataset->title;
    model_->markers.push_back({{"MARKER", 0, "", {}}, {}, false});
    model_->marker_ids.emplace(0, global_frame);
    Body ground;
    ground.kind = BodyKind::ground;
    ground.label = {"PART", 0, "ground", {}};
    model_->bodies.push_back(ground);
  }

  Parsed<std::unique_ptr<Model>> build() {
    register_statements();
    read_statements();
    // Later phases use values of other elements; after an error, reported here or when the text was read, these may be
    // half read.
    const auto& statements = model_->dataset->statements;
    const bool damaged =
        std::any_of(statements.begin(), statements.end(), [](const Statement& s) { return s.damaged; });
    if (!diagnostics_.has_errors() && !damaged) {
      for (auto& set : model_->sets) set->finish(*model_, diagnostics_);
    }
    return {std::move(model_), std::move(diagnostics_)};
  }

 private:
  std::int32_t set_index(const Kind& kind, bool active) {
    const auto [found, fresh] =
        set_of_kind_.emplace(std::pair(&kind, active), static_cast<std::int32_t>(model_->sets.size()));
    if (fresh) {
      model_->sets.push_back(kind.make_set(kind));
      model_->sets.back()->active = active;
    }
    return found->second;
  }
  ElementSet& set_of(const Kind& kind, bool active) {
    return *model_->sets[static_cast<std::size_t>(set_index(kind, active))];
  }

  // What kind each statement is of, and room for all of them.
  void find_kinds() {
    const auto& statements = model_->dataset->statements;
    placements_.reserve(statements.size());
    std::map<ElementSet*, std::size_t> count;
    for (const Statement& s : statements) {
      if (s.name.empty() || s.name == "END") continue;
      std::size_t variant_argument = no_argument;
      const Kind* kind = finder_.find(s, variant_argument, diagnostics_);
      ElementSet* set = kind ? &set_of(*kind, !s.inactive) : nullptr;
      const bool chosen = variant_argument != no_argument;
      placements_.push_back({&s, set, 0, chosen ? static_cast<std::int32_t>(variant_argument) : no_variant, {}});
      if (set) ++count[set];
    }
    for (const auto& [set, elements] : count) set->reserve(elements);
  }

  // First pass: every id becomes known, so statements may refer to later ones.
  void register_statements() {
    const auto& statements = model_->dataset->statements;
    const auto count = [&](std::string_view name) {
      return static_cast<std::size_t>(std::ranges::count(statements, name, &Statement::name));
    };
    model_->markers.reserve(1 + count("MARKER"));
    model_->bodies.reserve(1 + count("PART") + count("POINT_MASS") + count("FLEX_BODY"));
    // Sets in the order of the catalogue, whatever the order of the dataset, so that finishing works.
    for (const Kind* kind : catalogue_) set_of(*kind, true);
    find_kinds();
    BodyId preceding;
    const Statement* ground = nullptr;
    for (Placement& p : placements_) {
      const Statement& s = *p.statement;
      ElementSet* set = std::exchange(p.set, nullptr);
      if (!set) {
        // The id exists all the same: what refers to it must not complain as well.
        if (s.id) model_->ids[std::string(s.name)].emplace(*s.id, ElementHandle{});
        continue;
      }
      const Kind* kind = &set->kind();
      const bool needs_id =
          kind->role == Kind::Role::body || kind->role == Kind::Role::marker || kind->role == Kind::Role::element;
      if (needs_id && !s.id) {
        if (!s.damaged) diagnostics_.error("missing-id", s.at, fmt::format("{} needs an id: {}/1", s.name, s.name));
        continue;
      }
      const ElementLabel label{kind->statement, s.id.value_or(0), s.view_name, s.at};
      if (kind->role == Kind::Role::singleton && set->size() > 0) {
        diagnostics_.error("duplicate-statement", s.at, fmt::format("{} is given twice", s.name))
            .notes.push_back({set->labels.front().at, "the first one is here"});
        continue;
      }
      // What has no effect of its own may be named all the same: the GRAPHICS of a CONTACT.
      const bool has_id = needs_id || (kind->role == Kind::Role::inert && s.id);
      if (has_id && !register_id(*kind, label, *set, s, preceding, ground)) continue;
      if (kind->role == Kind::Role::element && s.id && is_examined(s.name))
        examined_.emplace(std::pair(s.name, *s.id), &s);
      p.set = set;
      p.index = static_cast<std::int32_t>(set->size());
      p.preceding_body = preceding;
      set->append(label);
    }
    if (!ground && !model_->dataset->statements.empty())
      diagnostics_.error("missing-ground", {}, "the dataset has no PART with GROUND");
  }

  bool register_id(const Kind& kind, const ElementLabel& label, const ElementSet& set, const Statement& s,
                   BodyId& preceding, const Statement*& ground) {
    const auto duplicate = [&](const Span& first) {
      diagnostics_.error("duplicate-id", s.at, fmt::format("{} is defined twice", label.text()))
          .notes.push_back({first, "the first definition is here"});
      return false;
    };
    if (kind.role == Kind::Role::marker) {
      const MarkerId m{static_cast<std::int32_t>(model_->markers.size())};
      const auto [it, fresh] = model_->marker_ids.emplace(label.id, m);
      if (!fresh) return duplicate(model_->marker(it->second).label.at);
      model_->markers.push_back({label, {}, false});
      return true;
    }
    if (kind.role == Kind::Role::body) {
      const bool is_ground_part = kind.statement == "PART" && is_ground(s);
      const BodyId b = is_ground_part ? ground_body : BodyId{static_cast<std::int32_t>(model_->bodies.size())};
      auto& table = model_->body_ids[std::string(kind.statement)];
      const auto [it, fresh] = table.emplace(label.id, b);
      if (!fresh) return duplicate(model_->body(it->second).label.at);
      if (is_ground_part) {
        if (ground) {
          diagnostics_.error("duplicate-ground", s.at, fmt::format("{} is a second ground", label.text()))
              .notes.push_back({ground->at, "the first one is here"});
        }
        ground = &s;
        model_->bodies[0].label = label;
      } else {
        Body body;
        body.label = label;
        body.kind = kind.statement == "POINT_MASS" ? BodyKind::point_mass : BodyKind::part;
        model_->bodies.push_back(std::move(body));
      }
      preceding = b;
      return true;
    }
    const std::int32_t index = set_index(kind, set.active);
    auto& table = model_->ids[std::string(kind.statement)];
    const auto [it, fresh] = table.emplace(label.id, ElementHandle{index, static_cast<std::int32_t>(set.size())});
    if (!fresh) return duplicate(it->second.valid() ? model_->label(it->second).at : Span{});
    return true;
  }

  // Second pass: arguments, with all references resolved.
  void read_statements() {
    auto read = read_once_ ? read_once_->statements.begin() : std::deque<Statement>::iterator{};
    for (const Placement& p : placements_) {
      // SENVAL asks for arguments of others, by their names alone.
      for (; read_once_ && &*read != p.statement; ++read) {
        if (!is_examined(read->name)) read_once_->release_arguments(*read);
      }
      if (!p.set) continue;
      Diagnostics own;
      Reader reader(*model_, p, examined_, routines_, *model_->dataset->source, own);
      p.set->make(p.at());
      p.set->read(p.at(), reader);
      if (own.has_errors()) p.set->sound[p.at()] = false;
      diagnostics_.append(std::move(own));
    }
  }

  Catalogue catalogue_;
  KindFinder finder_;
  Dataset* read_once_ = nullptr;
  std::unique_ptr<Model> model_;
  std::map<std::pair<const Kind*, bool>, std::int32_t> set_of_kind_;  // and whether its elements are active
  Diagnostics diagnostics_;
  std::vector<Placement> placements_;
  DatasetWithRoutines routines_;
  ExaminedStatements examined_;
};

}  // namespace

Parsed<std::unique_ptr<Model>> build_model(std::shared_ptr<const Dataset> dataset, Catalogue catalogue,
                                           const BuildOptions& options) {
  return build_model(std::move(dataset), catalogue, options, {});
}

Parsed<std::unique_ptr<Model>> build_model(std::shared_ptr<const Dataset> dataset, Catalogue catalogue,
                                           const BuildOptions& options, const RoutineOptions& routines) {
  return Builder(std::move(dataset), catalogue, options, routines).build();
}

}  // namespace dynalin
