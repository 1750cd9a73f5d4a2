#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <memory_resource>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/block_memory.h"
#include "expression/program_shapes.h"
#include "model/kind_finder.h"
#include "model/model_reader.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

constexpr std::size_t no_argument = KindFinder::no_argument;
constexpr ElementLabel label_of_global_frame = {MarkerClass::statement, 0, "", {}};

bool is_ground(const Kind& kind, const Statement& s) {
  if (kind.ground_word.empty()) return false;
  return std::any_of(s.arguments.begin(), s.arguments.end(), [&](const WrittenArgument& w) {
    return !w.has_value && find_keyword(w.name.text(), std::span(&kind.ground_word, 1)).has_value();
  });
}

bool is_passed_over(const Statement& s) { return s.name.empty() || s.name == "END"; }

class Builder {
 public:
  Builder(std::shared_ptr<const Dataset> dataset, Catalogue catalogue, const BuildOptions& options,
          const RoutineOptions& routines)
      : catalogue_(catalogue), finder_(catalogue), model_(std::make_unique<Model>()) {
    routines_ = with_user_routines(std::move(dataset), catalogue, options, routines, diagnostics_);
    model_->dataset = routines_.dataset;
    model_->further_sources = routines_.further_texts, model_->input_files = routines_.files;
    model_->routine_data = routines_.data ? routines_.data : routines.data;
    const bool calls_curves = model_->routine_data && !model_->routine_data->called_curves.empty();
    model_->calls_routines = !routines_.functions.empty() || calls_curves;
    if (model_->dataset == options.read_once) read_once_ = options.read_once.get();
    model_->title = model_->dataset->title;
    model_->edited = options.edited;
    model_->markers.emplace_back().label = &label_of_global_frame;
    Body ground;
    ground.kind = BodyKind::ground;
    ground.label = {"PART", 0, "ground", {}};
    model_->bodies.push_back(ground);
  }

  Parsed<std::unique_ptr<Model>> build() {
    register_statements();
    read_statements();
    shapes_ = ProgramShapes();  // what follows does not need it, and memory of its own
    // Later phases use values of other elements; after an error, reported here or when the text was read, these may be
    // half read.
    const auto& statements = model_->dataset->statements;
    const bool damaged =
        std::any_of(statements.begin(), statements.end(), [](const Statement& s) { return s.damaged; });
    if (!diagnostics_.has_errors() && !damaged) {
      for (auto& set : model_->sets) set->finish(*model_, diagnostics_);
      if (model_->routine_data) model_->routine_data->gravity = model_->gravity, model_->routine_data->is_read = true;
    }
    return {std::move(model_), std::move(diagnostics_)};
  }

 private:
  // Where elements of a kind are in the model.
  struct PlacesOfKind {
    std::optional<std::int32_t> active{}, inactive{};  // their set
    IdTable<ElementHandle>* ids = nullptr;             // of its class of statements, but for bodies
    IdTable<BodyId>* body_ids = nullptr;
  };

  std::int32_t set_index(const Kind& kind, bool active) {
    PlacesOfKind& places = places_of_kind_[&kind];
    std::optional<std::int32_t>& index = active ? places.active : places.inactive;
    if (!index) {
      index = static_cast<std::int32_t>(model_->sets.size());
      model_->sets.push_back(kind.make_set(kind));
      model_->sets.back()->active = active;
    }
    return *index;
  }
  IdTable<ElementHandle>& ids_of(const Kind& kind) {
    IdTable<ElementHandle>*& ids = places_of_kind_[&kind].ids;
    if (!ids) ids = &model_->ids[std::string(kind.statement)];
    return *ids;
  }
  IdTable<BodyId>& body_ids_of(const Kind& kind) {
    IdTable<BodyId>*& ids = places_of_kind_[&kind].body_ids;
    if (!ids) ids = &model_->body_ids[std::string(kind.statement)];
    return *ids;
  }
  ElementSet& set_of(const Kind& kind, bool active) {
    return *model_->sets[static_cast<std::size_t>(set_index(kind, active))];
  }

  // What is known of a statement until it is read: 16 bytes, since there are as many as statements. Each goes as soon
  // as its statement is read.
  struct Known {
    std::int32_t set = no_set;
    std::int32_t index = 0;  // in it
    std::int32_t variant_argument = Placement::no_variant;
    BodyId preceding_body{};

    static constexpr std::int32_t no_set = -1;  // it makes no element, which is reported
  };
  ElementSet* set_of(const Known& known) const {
    return known.set == Known::no_set ? nullptr : model_->sets[static_cast<std::size_t>(known.set)].get();
  }

  // What kind each statement is of, and room for all of them.
  void find_kinds() {
    const auto& statements = model_->dataset->statements;
    known_.resize(statements.size());
    std::unordered_map<ElementSet*, std::size_t> count;
    auto known = known_.begin();
    for (const Statement& s : statements) {
      Known& k = *known++;
      if (is_passed_over(s)) continue;
      std::size_t variant_argument = no_argument;
      const Kind* kind = finder_.find(s, variant_argument, diagnostics_);
      if (!kind) continue;
      k.set = set_index(*kind, !s.inactive);
      if (variant_argument != no_argument) k.variant_argument = static_cast<std::int32_t>(variant_argument);
      ++count[set_of(k)];
    }
    std::map<std::string_view, std::size_t> of_statement;
    for (const auto& [set, elements] : count) {
      set->reserve(elements);
      of_statement[set->kind().statement] += elements;
    }
    registered_.resize(model_->sets.size());
    std::size_t bodies = 0;
    for (const auto& [statement, elements] : of_statement) {
      const Kind::Role role = finder_.kinds_of(statement).front()->role;
      if (role == Kind::Role::marker)
        model_->marker_ids.reserve(elements);
      else if (role == Kind::Role::body)
        model_->body_ids[std::string(statement)].reserve(elements), bodies += elements;
      else if (role == Kind::Role::element || role == Kind::Role::inert)
        model_->ids[std::string(statement)].reserve(elements);
    }
    bodies_at_.reserve(bodies + 1);  // the ground may be none of them
  }

  // First pass: every id becomes known, so statements may refer to later ones.
  void register_statements() {
    const auto& statements = model_->dataset->statements;
    // Sets in the order of the catalogue, whatever the order of the dataset, so that finishing works.
    for (const Kind* kind : catalogue_) set_of(*kind, true);
    find_kinds();
    BodyId preceding;
    const Statement* ground = nullptr;
    std::size_t number = 0;
    auto known = known_.begin();
    for (const Statement& s : statements) {
      registering_ = number++;
      Known& k = *known++;
      if (is_passed_over(s)) continue;
      const std::int32_t its_set = std::exchange(k.set, Known::no_set);
      ElementSet* set = set_of(Known{its_set});
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
      std::int32_t& registered = registered_[static_cast<std::size_t>(its_set)];
      if (kind->role == Kind::Role::singleton && registered > 0) {
        diagnostics_.error("duplicate-statement", s.at, fmt::format("{} is given twice", s.name))
            .notes.push_back({place_of({its_set, 0}), "the first one is here"});
        continue;
      }
      if (kind->role == Kind::Role::singleton && s.id)
        diagnostics_.warning("stray-id", s.at,
                             fmt::format("{} exists once and takes no id: /{} means nothing", s.name, *s.id));
      // What has no effect of its own may be named all the same: the GRAPHICS of a CONTACT.
      const bool has_id = needs_id || (is_beside_model(*kind) && s.id);
      if (has_id && !register_id({its_set, registered}, s, preceding, ground)) continue;
      if (kind->role == Kind::Role::element && s.id && is_examined(s.name))
        examined_.emplace(std::pair(s.name, *s.id), &s);
      k.set = its_set;
      k.index = registered++;
      k.preceding_body = preceding;
    }
    model_->markers.reserve(marker_count_);
    model_->bodies.reserve(bodies_at_.size());
    // Of a file without any text it has been said already.
    const bool empty = model_->dataset->source->text().find_first_not_of(" \t\f\v\r\n") == std::string_view::npos;
    bodies_at_ = std::vector<Span>(), places_.clear();
    if (ground || empty) return;
    const bool none = std::ranges::all_of(statements, [](const Statement& s) { return s.name == "END"; });
    diagnostics_.error("missing-ground", {},
                       none ? "the dataset has no statements behind its title" : "the dataset has no PART with GROUND",
                       none ? "a model has a PART/1, GROUND at least" : "");
  }

  // Where an element stands that is registered: for the rare second one, so all are looked up when the first is met.
  Span place_of(ElementHandle registered) {
    for (; looked_up_ < registering_; ++looked_up_) {
      const std::int32_t set = known_[looked_up_].set;
      if (set != Known::no_set) places_[set].push_back(model_->dataset->statements[looked_up_].at);
    }
    return places_[registered.set][static_cast<std::size_t>(registered.index)];
  }

  static ElementLabel label_of(const Kind& kind, const Statement& s) {
    return {kind.statement, s.id.value_or(0), s.view_name(), s.at};
  }

  bool register_id(ElementHandle handle, const Statement& s, BodyId& preceding, const Statement*& ground) {
    const Kind& kind = model_->set(handle).kind();
    const ElementLabel label = label_of(kind, s);
    const auto duplicate = [&](const Span& first) {
      diagnostics_.error("duplicate-id", s.at, fmt::format("{} is defined twice", label.text()))
          .notes.push_back({first, "the first definition is here"});
      return false;
    };
    if (kind.role == Kind::Role::marker) {
      const MarkerId m{static_cast<std::int32_t>(marker_count_)};
      const auto [known, fresh] = model_->marker_ids.emplace(*s.id, m);
      // Marker k of its set is marker k + 1 of the model.
      if (!fresh) return duplicate(place_of({handle.set, known->index - 1}));
      ++marker_count_;
      return true;
    }
    if (kind.role == Kind::Role::body) {
      const bool is_ground_part = is_ground(kind, s);
      const BodyId b = is_ground_part ? ground_body : BodyId{static_cast<std::int32_t>(bodies_at_.size())};
      const auto [known, fresh] = body_ids_of(kind).emplace(*s.id, b);
      if (!fresh) return duplicate(bodies_at_[static_cast<std::size_t>(known->index)]);
      if (is_ground_part) {
        if (ground) {
          diagnostics_.error("duplicate-ground", s.at, fmt::format("{} is a second ground", label.text()))
              .notes.push_back({ground->at, "the first one is here"});
        }
        ground = &s;
        model_->bodies[0].label = label;
        bodies_at_[0] = label.at;
      } else {
        bodies_at_.push_back(label.at);
      }
      preceding = b;
      return true;
    }
    const auto [known, fresh] = ids_of(kind).emplace(*s.id, handle);
    if (!fresh) return duplicate(known->valid() ? place_of(*known) : Span{});
    return true;
  }

  // The label, and a body or marker of the model, are made when the statement is read and not earlier, as elements are
  // (ElementSet::make).
  void make_in_model(const Placement& p) {
    const Kind& kind = p.set->kind();
    p.set->append(label_of(kind, *p.statement));
    const ElementLabel& label = p.set->labels[p.at()];
    if (kind.role == Kind::Role::marker) model_->markers.emplace_back().label = &label;
    if (kind.role != Kind::Role::body || p.preceding_body == ground_body) return;
    Body& body = model_->bodies.emplace_back();
    body.label = label;
    body.kind = kind.is_point ? BodyKind::point_mass : BodyKind::part;
  }

  // Second pass: arguments, with all references resolved.
  void read_statements() {
    auto read = read_once_ ? read_once_->statements.begin() : std::deque<Statement>::iterator{};
    bool label_is_known = false;
    for (const Statement& s : model_->dataset->statements) {
      const Known k = known_.front();
      known_.pop_front();
      // SENVAL asks for arguments of others, by their names alone.
      for (; read_once_ && &*read != &s; ++read) {
        if (!is_examined(read->name)) read_once_->release_arguments(*read);
      }
      if (k.set == Known::no_set) continue;
      const Placement p{&s, set_of(k), k.index, k.variant_argument, k.preceding_body};
      make_in_model(p);
      Diagnostics own;
      ModelReader reader(*model_, p, examined_, routines_, shapes_, *model_->dataset->source, own);
      reader.label_is_known = label_is_known;
      p.set->make(p.at());
      p.set->read(p.at(), reader);
      label_is_known = reader.label_is_known;
      if (own.has_errors()) p.set->sound[p.at()] = false;
      diagnostics_.append(std::move(own));
    }
  }

  Catalogue catalogue_;
  KindFinder finder_;
  Dataset* read_once_ = nullptr;
  std::unique_ptr<Model> model_;
  std::unordered_map<const Kind*, PlacesOfKind> places_of_kind_;
  Diagnostics diagnostics_;
  BlockMemory memory_of_known_;
  std::pmr::deque<Known> known_{&memory_of_known_};     // of each statement that is not read yet
  std::vector<std::int32_t> registered_;                // so many of each set
  std::size_t registering_ = 0, looked_up_ = 0;         // statements, by their number
  std::map<std::int32_t, std::vector<Span>> places_;    // of the elements of a set, as far as looked up
  std::size_t marker_count_ = 1;                        // the global frame among them
  std::vector<Span> bodies_at_ = std::vector<Span>(1);  // of each body where it is defined, the ground first
  DatasetWithRoutines routines_;
  ExaminedStatements examined_;
  ProgramShapes shapes_;
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
