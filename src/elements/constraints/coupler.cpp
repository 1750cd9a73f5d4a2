// COUPLER/id, JOINTS=id1, id2 [, id3], {SCALES= | FUNCTION=USER(…) [, ROUTINE=]} [, TYPE=T:R]
//
// Couples the displacements q of two or three joints, rotations in radians, measured from the zero of each joint:
//
//     r1 q1 + r2 q2 + r3 q3 = 0
//
// One scale fewer than joints means r1 = 1. TYPE says for each joint whether its translation or its rotation is meant,
// which only a CYLINDRICAL joint needs. FUNCTION calls a compiled routine of the user, which says what of the
// displacements is held at zero.
#include <fmt/format.h>

#include "elements/families/joint_relation.h"
#include "expression/program.h"
#include "routine/given_inputs.h"
#include "routine/measures.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Coupler {
  std::vector<JointRef> joints;
  std::vector<double> scales;
  std::vector<std::string> types;
  Expression function;
  std::vector<DrivenFreedom> freedoms;  // of each joint

  static constexpr std::array<Argument<Coupler>, 4> arguments = {{
      {.name = "JOINTS", .slot = &Coupler::joints, .required = true, .help = "two or three joints"},
      {.name = "SCALES", .slot = &Coupler::scales, .help = "r1, r2, r3; r1 may be left out", .ends = "FUNCTION"},
      {.name = "TYPE", .slot = &Coupler::types, .help = "T or R for each joint"},
      {.name = "FUNCTION",
       .slot = &Coupler::function,
       .help = "USER(…): a compiled routine says what is held at zero",
       .ends = "SCALES"},
  }};
};

std::optional<DrivenFreedom> freedom_of(std::string_view type) {
  if (type == "T") return DrivenFreedom::translation;
  if (type == "R") return DrivenFreedom::rotation;
  return std::nullopt;
}

class CouplerSet final : public TypedSet<Coupler> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Coupler& c = elements[k];
    const bool ok = read_arguments(c, reader);
    if (!ok) return;
    const bool calls = reader.given("FUNCTION");
    if (calls == reader.given("SCALES")) {
      if (calls) {
        reader.error("excluded-arguments", reader.at("FUNCTION"),
                     fmt::format("{} takes SCALES or FUNCTION, not both", reader.label().text()));
      } else if (!reader.statement().damaged) {
        reader.error("missing-argument", reader.statement().at, fmt::format("{} needs SCALES", reader.label().text()),
                     "or FUNCTION=USER(…), which calls a compiled routine");
      }
      return;
    }
    if (calls && c.function.program().routines().empty()) {
      reader.error("unknown-word", reader.at("FUNCTION"),
                   fmt::format("FUNCTION of {} is USER(…), the call of a compiled routine, and no expression",
                               reader.label().text()));
      return;
    }
    const std::size_t n = c.joints.size();
    const std::string name = reader.label().text();
    if (n != 2 && n != 3) {
      reader.error("wrong-count", reader.at("JOINTS"), fmt::format("{} couples two or three joints, not {}", name, n));
      return;
    }
    if (calls) c.scales.assign(n, 0.0);  // nobody reads them
    if (c.scales.size() + 1 == n) c.scales.insert(c.scales.begin(), 1.0);
    if (c.scales.size() != n) {
      reader.error("wrong-count", reader.at("SCALES"),
                   fmt::format("{} needs {} or {} scales, here are {}", name, n - 1, n, c.scales.size()));
    }
    if (!c.types.empty() && c.types.size() != n) {
      reader.error("wrong-count", reader.at("TYPE"), fmt::format("TYPE of {} needs {} words", name, n));
    }
    c.freedoms.assign(n, DrivenFreedom::only);
    for (std::size_t j = 0; j < c.types.size(); ++j) {
      const auto freedom = freedom_of(c.types[j]);
      if (!freedom)
        reader.error("unknown-word", reader.at("TYPE"), fmt::format("TYPE takes T and R, not {}", c.types[j]));
      if (freedom && c.types.size() == n) c.freedoms[j] = *freedom;
    }
    const auto is_same = [&](std::size_t a, std::size_t b) {
      return c.joints[a] == c.joints[b] && c.freedoms[a] == c.freedoms[b];
    };
    if (is_same(0, 1) || (n == 3 && (is_same(0, 2) || is_same(1, 2)))) {
      reader.error("same-joint-twice", reader.at("JOINTS"),
                   fmt::format("{} couples the displacement of a joint with itself", name),
                   "JOINTS takes different joints, or TYPE=T:R for both displacements of one");
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Coupler& c = elements[k];
      JointRelation relation;
      for (std::size_t j = 0; j < c.joints.size(); ++j) {
        const DrivenFreedom wanted = c.freedoms.empty() ? DrivenFreedom::only : c.freedoms[j];
        const auto freedom = joint_freedom(model, labels[k], c.joints[j], wanted, diagnostics);
        if (freedom) relation.terms.push_back({*freedom, c.scales[j]});
      }
      const auto routines = c.function.program().routines();
      if (!routines.empty() && relation.terms.size() == c.joints.size()) {
        relation.function = of_displacements(model, relation, routines.front());
        relation.routine = routines.front().routine;
      }
      relations_.push_back(std::move(relation));
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<JointRelationKernel>(relations_, labels, "r.q", layout);
  }

 private:
  // The routine on the measures that the displacements are.
  static Expression of_displacements(const Model& model, const JointRelation& relation, const RoutineUse& called) {
    std::vector<Atom> inputs = {*single_measure("TIME", {}), *single_measure("MODE", {})};
    for (const JointRelation::Term& t : relation.terms) {
      const auto id = [&](MarkerId m) { return static_cast<int>(model.marker(m).label->id); };
      const std::array<int, 3> ids = {id(t.freedom.i), id(t.freedom.j), id(t.freedom.j)};
      const bool turns = is_angle(t.freedom.kind);
      inputs.push_back(*single_measure(turns ? "AZ" : "DZ", std::span(ids).first(turns ? 2 : 3)));
    }
    for (Atom& a : inputs) a.set_place(called.at);
    return routine_expression(std::move(inputs), called.routine, called.which, called.at);
  }

  std::vector<JointRelation> relations_;
};

// TYPE says what is meant of a joint, else its own type does.
ToldToRoutine told_of_coupler(const StatementWords& s) {
  std::string types(s.written("TYPE"));
  std::erase_if(types, [](char c) { return c != 'T' && c != 'R'; });
  const std::vector<int> joints = s.integers("JOINTS");
  const std::size_t count = std::min(joints.size(), most_given_to_coupler);
  sAdamsCoupler said{s.id(), s.constants().count(), s.constants().data(), static_cast<int>(count), {}, {}};
  for (std::size_t k = 0; k < count; ++k) {
    said.JOINTS[k] = joints[k];
    said.TYPE[k] = k < types.size() ? types[k] : s.slides(joints[k]) ? 'T' : 'R';
  }
  return {std::make_shared<const sAdamsCoupler>(said), 1, count};
}
constexpr std::array<RoutineKind, 1> coupler_routines = {
    {{.routine = "cousub", .values = 1, .arguments = RoutineArguments::coupler, .told = told_of_coupler}}};

}  // namespace

extern constinit const Kind coupler =
    Kind{"COUPLER",
         "",
         "Couples the displacements of two or three joints, linearly or by a compiled routine.",
         Kind::Role::element,
         detail::argument_infos<Coupler>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<CouplerSet>(kind); }}
        .deactivatable()
        .calling(coupler_routines);

}  // namespace dynalin
