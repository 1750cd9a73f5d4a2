// MREQUEST/id, {DISPLACEMENT | VELOCITY | ACCELERATION | FORCE}, {PARTS= | JOINTS= | JPRIMS= | APPFORS=}{ALL | id1, …}
// [, RM=]
//
// A REQUEST for each of these: of the CM of a part, of marker I of a joint, primitive or applied force as seen from its
// marker J, along the axes of RM (global). An id in APPFORS means the first applied force of that id in the order BEAM,
// BUSHING, FIELD, GFORCE, NFORCE, SFORCE, SPRINGDAMPER, VFORCE, VTORQUE; with several I markers it is one for each.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "dataset/characters.h"
#include "elements/bodies/part.h"
#include "elements/requests/lenient.h"
#include "elements/requests/request_kernel.h"
#include "mechanics/wrench_source.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

constexpr std::array<std::string_view, 1> joints = {"JOINT"}, primitives = {"JPRIM"};
constexpr std::array<std::string_view, 9> applied_forces = {"BEAM",   "BUSHING",      "FIELD",  "GFORCE", "NFORCE",
                                                            "SFORCE", "SPRINGDAMPER", "VFORCE", "VTORQUE"};

// Which elements of some statements, or of PART.
struct Group {
  std::span<const std::string_view> statements;  // none: PART
  bool all = false;
  std::vector<std::int64_t> ids;

  bool takes(std::int64_t id) const { return all || std::find(ids.begin(), ids.end(), id) != ids.end(); }
};

struct ManyRequests {
  bool displacement = false, velocity = false, acceleration = false, force = false;
  Obsolete list;  // ALL or ids, read by themselves
  std::optional<std::int64_t> rm;
  // What they come to; nothing where they are left out.
  std::optional<RequestKind> kind;
  std::vector<Group> groups;
  std::string comment;

  using E = ManyRequests;
  static constexpr std::array<Argument<E>, 10> arguments = {{
      {.name = "DISPLACEMENT",
       .slot = &E::displacement,
       .help = "as those of REQUEST",
       .ends = "VELOCITY ACCELERATION FORCE"},
      {.name = "VELOCITY", .slot = &E::velocity, .help = "the same", .ends = "DISPLACEMENT ACCELERATION FORCE"},
      {.name = "ACCELERATION", .slot = &E::acceleration, .help = "the same", .ends = "DISPLACEMENT VELOCITY FORCE"},
      {.name = "FORCE", .slot = &E::force, .help = "not of PARTS", .ends = "DISPLACEMENT VELOCITY ACCELERATION"},
      {.name = "PARTS", .slot = &E::list, .help = "ALL or ids: the CM of each from the global origin"},
      {.name = "JOINTS", .slot = &E::list, .help = "ALL or ids"},
      {.name = "JPRIMS", .slot = &E::list, .help = "ALL or ids"},
      {.name = "APPFORS", .slot = &E::list, .help = "applied forces: ALL or ids"},
      {.name = "RM",
       .slot = &E::rm,
       .help = "marker along whose axes the values are; the global frame",
       .ids_of = MarkerClass::statement},
      {.name = "COMMENT", .slot = &E::list, .help = "one line above each table"},
  }};

  std::vector<RequestKind> kinds() const {
    std::vector<RequestKind> all;
    for (const auto& [wanted, which] :
         {std::pair{displacement, RequestKind::displacement}, std::pair{velocity, RequestKind::velocity},
          std::pair{acceleration, RequestKind::acceleration}, std::pair{force, RequestKind::force}}) {
      if (wanted) all.push_back(which);
    }
    return all;
  }
};

// What each of some MREQUESTs stands for, as soon as it is known who has which markers.
class ManyRequestsKernel final : public RequestKernel {
 public:
  ManyRequestsKernel(const Model& model, const std::vector<ManyRequests>& elements,
                     const std::vector<ElementLabel>& labels, Layout& layout)
      : RequestKernel({}, layout), model_(model), elements_(elements), element_labels_(labels) {}

 private:
  std::vector<WantedRequest> found(const Signals& signals) override {
    std::vector<WantedRequest> all;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const ManyRequests& m = elements_[k];
      if (!m.kind) continue;
      const std::size_t before = all.size();
      for (const Group& group : m.groups) {
        if (group.statements.empty())
          add_parts(m, group, element_labels_[k], all);
        else
          add_pairs(m, group, element_labels_[k], signals, all);
      }
      if (all.size() == before)
        leave_out(element_labels_[k], element_labels_[k].text(),
                  Diagnostic{Severity::warning, "request-left-out", {}, "nothing that it names has a marker", {}, {}});
    }
    return all;
  }

  void add(const ManyRequests& m, const ElementLabel& label, const ElementLabel& of, MarkerId i, MarkerId j,
           std::vector<WantedRequest>& all) {
    const auto id = [&](MarkerId marker) { return marker.valid() ? model_.marker(marker).label->id : 0; };
    RequestInfo info;
    info.request = {label.element(), of.text()};
    info.view_name = of.view_name, info.comment = m.comment;
    // The view name alone would be that of the element.
    info.results_name = fmt::format("{}_{}_{}_{}", label.statement, label.id, of.statement, of.id);
    info.kind = *m.kind;
    info.marker_I = id(i), info.marker_J = id(j), info.axes = m.rm.value_or(0);
    info.list = components_of(*m.kind);
    all.push_back({keep(std::move(info)), &label, nullptr});
  }

  void add_parts(const ManyRequests& m, const Group& group, const ElementLabel& label,
                 std::vector<WantedRequest>& all) {
    for (const PartCentre& p : part_centres(model_)) {
      if (!group.takes(p.part->id)) continue;
      if (p.cm.valid())
        add(m, label, *p.part, p.cm, global_frame, all);
      else if (!group.all)
        leave_out(label, label.text() + " " + p.part->text(),
                  Diagnostic{Severity::warning, "request-left-out", {}, "the part has no CM", {}, {}});
    }
  }

  void add_pairs(const ManyRequests& m, const Group& group, const ElementLabel& label, const Signals& signals,
                 std::vector<WantedRequest>& all) {
    std::set<std::int64_t> taken;  // ids that an earlier statement has
    for (const std::string_view statement : group.statements) {
      std::set<std::int64_t> here;
      for (std::size_t s = 0; s < model_.sets.size(); ++s) {
        const ElementSet& set = *model_.sets[s];
        if (set.size() == 0 || !set.active || set.kind().statement != statement) continue;
        const Kernel* kernel = signals.element(ElementHandle{static_cast<std::int32_t>(s), 0}).kernel;
        const WrenchSource* source = kernel ? kernel->wrenches() : nullptr;
        for (std::size_t w = 0; source && w < source->wrench_count(set.size()); ++w) {
          const ElementLabel& of = set.labels[source->element_of_wrench(w)];
          if (!group.takes(of.id) || (!group.all && taken.contains(of.id))) continue;
          add(m, label, of, source->marker_I(w), source->marker_J(w), all);
          here.insert(of.id);
        }
      }
      taken.merge(here);
    }
  }

  const Model& model_;
  const std::vector<ManyRequests>& elements_;
  const std::vector<ElementLabel>& element_labels_;
};

class ManyRequestsSet final : public TypedSet<ManyRequests> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (!read_arguments(elements[k], reader)) return;
    leniently(reader, [&] { return read_groups(elements[k], reader); });
  }
  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<ManyRequestsKernel>(model, elements, labels, layout);
  }

 private:
  static bool wrong(ElementReader& reader, const Span& at, std::string text) {
    reader.error("request-left-out", at, std::move(text));
    return false;
  }

  static bool read_groups(ManyRequests& m, ElementReader& reader) {
    const auto kinds = m.kinds();
    if (kinds.size() != 1)
      return wrong(reader, reader.statement().at, "it takes one of DISPLACEMENT, VELOCITY, ACCELERATION and FORCE");
    std::vector<Group> groups;
    const std::array<std::pair<std::string_view, std::span<const std::string_view>>, 4> lists = {
        {{"PARTS", {}}, {"JOINTS", joints}, {"JPRIMS", primitives}, {"APPFORS", applied_forces}}};
    for (const auto& [name, statements] : lists) {
      if (!reader.given(name)) continue;
      auto group = read_group(statements, *written_argument(reader, name), reader);
      if (!group) return false;
      groups.push_back(std::move(*group));
    }
    if (groups.empty())
      return wrong(reader, reader.statement().at, "it names none of PARTS, JOINTS, JPRIMS and APPFORS");
    if (kinds.front() == RequestKind::force && reader.given("PARTS"))
      return wrong(reader, reader.at("PARTS"), "FORCE goes with JOINTS, JPRIMS and APPFORS");
    if (m.rm && *m.rm != 0 && !reader.marker({*m.rm, reader.at("RM")}, "RM")) return false;
    if (const WrittenArgument* c = written_argument(reader, "COMMENT"); c && c->has_value)
      m.comment = split_texts(c->value_span().text(), '\0').front();
    m.kind = kinds.front(), m.groups = std::move(groups);
    return true;
  }

  static std::optional<Group> read_group(std::span<const std::string_view> statements, const WrittenArgument& w,
                                         ElementReader& reader) {
    Group group{statements, false, {}};
    if (w.has_value && equal_ignoring_case(w.value_span().text(), "ALL")) {
      group.all = true;
      return group;
    }
    const auto ids = read_integers(w, *w.name.source, reader.diagnostics());
    if (!ids) return std::nullopt;
    for (const WrittenInteger& id : *ids) {
      if (!exists(statements, id, reader)) return std::nullopt;
      group.ids.push_back(id.value);
    }
    return group;
  }

  static bool exists(std::span<const std::string_view> statements, const WrittenInteger& id, ElementReader& reader) {
    if (statements.empty()) return reader.body("PART", id).has_value();
    if (statements.size() == 1) return reader.element(statements.front(), id).has_value();
    Diagnostics& all = reader.diagnostics();
    const Diagnostics before = all;
    const bool any = std::any_of(statements.begin(), statements.end(),
                                 [&](std::string_view statement) { return reader.element(statement, id).has_value(); });
    all = before;
    return any || wrong(reader, id.at,
                        fmt::format("there is no applied force {}: none of {}", id.value, fmt::join(statements, ", ")));
  }
};

}  // namespace

extern constinit const Kind mrequest =
    Kind{"MREQUEST",
         "",
         "Requests of many parts, joints or forces at once.",
         Kind::Role::element,
         detail::argument_infos<ManyRequests>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<ManyRequestsSet>(kind); }}
        .deactivatable()
        .giving(Kind::Gives::requests)
        .with_example("MREQUEST/1, FORCE, JOINTS=ALL");

}  // namespace dynalin
