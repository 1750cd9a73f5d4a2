// MFORCE/id, FLEX_BODY= [, JFLOAT=], {CASE_INDEX=, SCALE= | FUNCTION=USER(…) | FORCE=USER(…)}
//
// A load on the coordinates of a flexible body: a force f and a torque t about the BCS, along its axes A, and Q of the
// modes, times a scale w:
//
//     F = w A f,   L = w A t   on the body at the BCS,   Q w   on its modal coordinates
//
// and −F, −L at the same place on the body of the floating marker JFLOAT, or on its node. What the modes take has no
// reaction.
//
// f, t and Q are column CASE_INDEX of the modal loads of the body, and w = SCALE. A compiled routine of the user gives
// both (FUNCTION), where f, t and Q depend on time alone, or f, t and Q for w = 1 (FORCE). What is not a constant is an
// algebraic unknown.
#include <fmt/format.h>

#include "elements/bodies/flex_body.h"
#include "elements/families/called_values.h"
#include "elements/families/defined_unknown.h"
#include "elements/families/markers.h"
#include "mechanics/binder.h"
#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"
#include "mechanics/pair.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct ModalForce {
  BodyId body;
  MarkerId jfloat;
  std::optional<std::int64_t> index;
  Expression scale;
  Expression function, force;
  bool scaled = false;  // FUNCTION calls a routine
  Span index_at;

  static constexpr std::array<Argument<ModalForce>, 6> arguments = {{
      {.name = "FLEX_BODY", .slot = &ModalForce::body, .required = true, .help = "the flexible body it acts on"},
      {.name = "JFLOAT", .slot = &ModalForce::jfloat, .help = "floating marker whose body takes the reaction"},
      {.name = "CASE_INDEX",
       .slot = &ModalForce::index,
       .minimum = 1,
       .help = "which of the body's modal loads",
       .ends = "FUNCTION FORCE"},
      {.name = "SCALE", .slot = &ModalForce::scale, .help = "factor of that load", .ends = "FUNCTION FORCE"},
      {.name = "FUNCTION",
       .slot = &ModalForce::function,
       .help = "USER(…): a compiled routine gives load and scale",
       .ends = "CASE_INDEX SCALE FORCE"},
      {.name = "FORCE",
       .slot = &ModalForce::force,
       .help = "USER(…): a compiled routine gives the load",
       .ends = "CASE_INDEX SCALE FUNCTION"},
  }};
};

class ModalForceKernel final : public Kernel {
 public:
  ModalForceKernel(const std::vector<ModalForce>& forces, const std::vector<ElementLabel>& labels, const Model& model,
                   Layout& layout)
      : labels_(&labels) {
    const std::vector<FlexibleBody> flexible = flexible_bodies(model);
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const FlexibleBody& f = *std::ranges::find(flexible, forces[k].body, &FlexibleBody::body);
      Load load;
      load.bcs.body = f.body, load.modes = layout.body_coordinate_count + static_cast<std::int32_t>(f.first);
      const auto unknown = [&](const Expression& e) {
        const auto number = static_cast<std::int32_t>(load.unknowns.size()) + 1;
        load.unknowns.emplace_back(
            forces[k].index ? layout.add_algebraic(labels[k]) : layout.add_algebraic(labels[k], number), e);
      };
      const std::size_t count = 6 + static_cast<std::size_t>(f.flexible->modes());
      if (forces[k].index) {
        const Eigen::VectorXd column = f.flexible->loads.col(*forces[k].index - 1);
        load.constant.assign(column.data(), column.data() + column.size());
        load.has_scale = true;
        unknown(forces[k].scale);
      } else {
        load.has_scale = forces[k].scaled;
        for (const Expression& e : values_of_routine(forces[k].scaled ? forces[k].function : forces[k].force,
                                                     count + (forces[k].scaled ? 1 : 0)))
          unknown(e);
      }
      if (forces[k].jfloat.valid()) load.reacts_on = layout.marker(forces[k].jfloat), load.has_reaction = true;
      loads_.push_back(std::move(load));
    }
  }

  void bind(Binder& binder) override {
    for (Load& l : loads_) {
      for (DefinedUnknown& u : l.unknowns) u.bind(binder);
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      const Load& l = loads_[k];
      eq.begin_element((*labels_)[k]);
      for (const DefinedUnknown& u : l.unknowns) u.add_equation(motion, eq);
      const Now now = look(l, motion);
      const PairMotion pair = pair_motion(motion, l.bcs, l.reacts_on);
      PairForce load;
      load.force = now.scale * now.force, load.torque = now.scale * now.torque;
      load.force_on_position.axes_I = -skew(load.force), load.torque_on_position.axes_I = -skew(load.torque);
      load.reaction = l.has_reaction ? Reaction::at_I : Reaction::none;
      apply(pair, load, eq);
      for (std::size_t m = 0; m < now.of_modes.size(); ++m)
        eq.add_residual(l.modes + static_cast<std::int32_t>(m), -now.scale * now.of_modes[m]);
      if (l.has_scale) {
        const std::int32_t scale = l.unknowns.front().column();
        apply_column(pair, now.force, now.torque, load.reaction, PartialBy::algebraic, scale, eq);
        for (std::size_t m = 0; m < now.of_modes.size(); ++m)
          eq.add(PartialBy::algebraic, l.modes + static_cast<std::int32_t>(m), scale, -now.of_modes[m]);
      }
      for_each_component(l, [&](std::size_t c, std::int32_t unknown) {
        if (c >= 6) {
          eq.add(PartialBy::algebraic, l.modes + static_cast<std::int32_t>(c - 6), unknown, -now.scale);
          return;
        }
        const Vector e = now.scale * now.axes[c % 3];
        apply_column(pair, c < 3 ? e : Vector{}, c < 3 ? Vector{} : e, load.reaction, PartialBy::algebraic, unknown,
                     eq);
      });
    }
  }

  void undefined_values(const Motion& motion, UndefinedValues& values) const override {
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      for (const DefinedUnknown& u : loads_[k].unknowns) u.find_undefined(motion, (*labels_)[k], values);
    }
  }

 private:
  struct Load {
    MarkerPlace bcs, reacts_on;  // of ground where nothing takes the reaction
    bool has_reaction = false;
    std::int32_t modes = 0;        // first column of the modal coordinates
    bool has_scale = false;        // the first unknown
    std::vector<double> constant;  // force, torque, of the modes; else all of them are unknowns, behind the scale
    std::vector<DefinedUnknown> unknowns;
  };
  // A load at this moment by a unit of its scale, force and torque along global axes.
  struct Now {
    double scale = 1;
    Matrix3 axes;
    Vector force, torque;
    std::vector<double> of_modes;
  };

  static Now look(const Load& l, const Motion& motion) {
    std::vector<double> all = l.constant;
    for_each_component(
        l, [&](std::size_t c, std::int32_t) { all.push_back(l.unknowns[first_component(l) + c].at(motion)); });
    Now now;
    if (l.has_scale) now.scale = l.unknowns.front().at(motion);
    now.axes = motion.body(l.bcs.body).R;
    now.force = now.axes * Vector{all[0], all[1], all[2]}, now.torque = now.axes * Vector{all[3], all[4], all[5]};
    now.of_modes.assign(all.begin() + 6, all.end());
    return now;
  }
  static std::size_t first_component(const Load& l) { return l.has_scale ? 1 : 0; }
  // Those that are unknowns.
  template <class Visit>
  static void for_each_component(const Load& l, Visit&& visit) {
    for (std::size_t k = first_component(l); k < l.unknowns.size(); ++k)
      visit(k - first_component(l), l.unknowns[k].column());
  }

  const std::vector<ElementLabel>* labels_;
  std::vector<Load> loads_;
};

class ModalForceSet final : public TypedSet<ModalForce> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (!read_arguments(elements[k], reader)) return;
    const std::string name = reader.label().text();
    if (reader.given("FUNCTION") || reader.given("FORCE")) return read_call(elements[k], reader);
    for (const auto& [word, other] : {std::pair{"CASE_INDEX", "SCALE"}, {"SCALE", "CASE_INDEX"}}) {
      if (reader.given(word)) continue;
      reader.error("missing-argument", reader.at(other),
                   reader.given(other) ? fmt::format("{} of {} needs {}", other, name, word)
                                       : fmt::format("{} needs CASE_INDEX and SCALE", name));
      return;
    }
    elements[k].index_at = reader.at("CASE_INDEX");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    const std::vector<const ModalBody*> flexible = flexible_by_body(model);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const ModalForce& f = elements[k];
      const std::string name = labels[k].text(), body = model.body(f.body).label.text();
      if (f.jfloat.valid()) check_reaction(f, labels[k], model, diagnostics);
      const ModalBody* loaded = flexible[static_cast<std::size_t>(f.body.index)];
      if (!loaded || !f.index) continue;  // its own statement has errors, or a routine gives the load
      if (loaded->loads.cols() == 0) {
        diagnostics.error("missing-load", f.index_at, fmt::format("{} takes a modal load, and {} has none", name, body),
                          "a MATRIX named MODLOAD among the MATRICES of the body");
      } else if (*f.index > loaded->loads.cols()) {
        diagnostics.error("missing-load", f.index_at,
                          fmt::format("{} takes modal load {}, {} has {}", name, *f.index, body, loaded->loads.cols()));
      }
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<ModalForceKernel>(elements, labels, model, layout);
  }

 private:
  static void read_call(ModalForce& f, ElementReader& reader) {
    const std::string name = reader.label().text();
    f.scaled = reader.given("FUNCTION");
    const std::string_view word = f.scaled ? "FUNCTION" : "FORCE";
    for (const std::string_view other : {"CASE_INDEX", "SCALE", "FORCE"}) {
      if (other == word || !reader.given(other)) continue;
      reader.error(
          "excluded-arguments", reader.at(other),
          fmt::format("{} takes CASE_INDEX and SCALE, FUNCTION, or FORCE, and not {} with {}", name, word, other));
      return;
    }
    if ((f.scaled ? f.function : f.force).program().routines().empty()) {
      reader.error("unknown-word", reader.at(word),
                   fmt::format("{} of {} is USER(…), the call of a compiled routine, and no expression", word, name));
    }
  }

  static void check_reaction(const ModalForce& f, const ElementLabel& label, const Model& model,
                             Diagnostics& diagnostics) {
    const Marker& floating = model.marker(f.jfloat);
    if (!floating.floating) {
      diagnostics.error(
          "fixed-marker", label.at,
          fmt::format("JFLOAT of {}, {}, must be a floating marker", label.text(), floating.label->text()),
          "write FLOATING into the MARKER statement");
    } else if (floating.place.body == f.body) {
      diagnostics.error(
          "same-body", label.at,
          fmt::format("JFLOAT of {} is on {}, which it acts on", label.text(), model.body(f.body).label.text()));
    } else {
      check_rotation(model, label, f.jfloat, diagnostics);
    }
  }
};

ToldToRoutine told_of_mforce(const StatementWords& s) {
  return {std::make_shared<const sAdamsMforce>(sAdamsMforce{
      {s.integer("FLEX_BODY")}, s.id(), s.constants().count(), s.constants().data(), s.integer("JFLOAT")})};
}
// FUNCTION gives a scale and which load it scales or that load, FORCE the load alone.
constexpr RoutineKind mforce_routine(std::string_view argument) {
  return {.routine = "mfosub",
          .values = 0,
          .arguments = RoutineArguments::modal,
          .told = told_of_mforce,
          .argument = argument};
}
constexpr std::array<RoutineKind, 2> mforce_routines = {mforce_routine("FUNCTION"), mforce_routine("FORCE")};

}  // namespace

extern constinit const Kind mforce =
    Kind{"MFORCE",
         "",
         "Load on the coordinates of a flexible body.",
         Kind::Role::element,
         detail::argument_infos<ModalForce>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<ModalForceSet>(kind); }}
        .deactivatable()
        .calling(mforce_routines);

}  // namespace dynalin
