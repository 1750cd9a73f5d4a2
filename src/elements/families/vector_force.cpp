#include "elements/families/vector_force.h"

#include <fmt/format.h>

#include <algorithm>

#include "expression/program.h"

namespace dynalin {

VectorForceKernel::VectorForceKernel(std::vector<VectorForce> elements, const std::vector<ElementLabel>& labels,
                                     Components components, Layout& layout)
    : labels_(&labels), components_(components) {
  for (std::size_t k = 0; k < elements.size(); ++k) {
    Force f{elements[k],
            layout.marker(elements[k].i),
            layout.marker(elements[k].jfloat),
            layout.marker(elements[k].rm),
            {}};
    for (std::size_t axis = 0; axis < 6; ++axis) {
      if (!f.element.component[axis]) continue;
      const std::int32_t unknown = layout.add_algebraic(labels[k], static_cast<std::int32_t>(axis) + 1);
      f.components.push_back({axis, {unknown, *f.element.component[axis]}});
    }
    forces_.push_back(std::move(f));
  }
}

void VectorForceKernel::bind(Binder& binder) {
  for (Force& f : forces_) {
    for (Component& c : f.components) c.value.bind(binder);
  }
}

void VectorForceKernel::wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const {
  const Force& f = forces_[k];
  out.pair = pair_motion(motion, f.I, f.J);
  // The floating marker is where I is.
  out.pair.delta = {};
  out.J_follows_I = true;
  out.force = {};
  out.force.components = components_;
  const Matrix3 axes = motion.axes(f.RM);
  for (const Component& c : f.components) {
    const Vector e = axes[c.axis % 3];
    const double w = c.value.at(motion);
    (c.axis < 3 ? out.force.force : out.force.torque) += w * e;
    if (wanted == Partials::yes) {
      out.scalars.push_back(
          {PartialBy::algebraic, c.value.column(), c.axis < 3 ? e : Vector{}, c.axis < 3 ? Vector{} : e});
    }
  }
  if (wanted == Partials::yes) out.turns.push_back({&f.RM, -skew(out.force.force), -skew(out.force.torque)});
}

void VectorForceKernel::equations(const Motion& motion, Equations& eq) const {
  MarkerWrench w;
  for (const std::size_t k : eq.share(forces_.size())) {
    const Force& f = forces_[k];
    eq.begin_element((*labels_)[k]);
    for (const Component& c : f.components) c.value.add_equation(motion, eq);
    w.clear();
    wrench(motion, k, eq.wanted_partials(), w);
    apply(w.pair, w.force, eq);
    if (!eq.wants_partials()) continue;
    for (const MarkerWrench::Scalar& s : w.scalars) {
      apply_column(w.pair, s.force, s.torque, Reaction::at_I, s.family, s.column, eq);
    }
    for (const MarkerWrench::Turn& t : w.turns) apply_turn(w.pair, *t.axes, t.force, t.torque, eq);
  }
}

void VectorForceKernel::undefined_values(const Motion& motion, UndefinedValues& undefined_values) const {
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    for (const Component& c : forces_[k].components) c.value.find_undefined(motion, (*labels_)[k], undefined_values);
  }
}

namespace {

// A component written as 0 is none: whole sets of six are written by programs.
bool is_nothing(const Expression& e) {
  ExpressionWorkspace<double> workspace;
  return e.is_constant() && e.splines().empty() && e.program().routines().empty() &&
         e.evaluate<double>({}, workspace) == 0;
}

}  // namespace

void take_components(const WrittenVectorForce& w, Components components, VectorForce& out, ElementReader& reader) {
  const bool forces = components != Components::torque, torques = components != Components::force;
  out.i = w.i, out.jfloat = w.jfloat, out.rm = w.rm;
  const std::string name = reader.label().text();
  static constexpr std::array<std::string_view, 6> names = {"FX", "FY", "FZ", "TX", "TY", "TZ"};
  const std::array<const Expression*, 6> scalars = {&w.fx, &w.fy, &w.fz, &w.tx, &w.ty, &w.tz};
  bool any = false;
  for (std::size_t k = 0; k < 6; ++k) {
    if (!reader.given(names[k])) continue;
    out.component[k] = *scalars[k];
    any = true;
  }
  const auto take_vector = [&](std::string_view word, const VectorExpression& v, std::size_t first) {
    if (!reader.given(word)) return;
    for (std::size_t k = first; k < first + 3; ++k) {
      if (out.component[k]) {
        reader.error("excluded-arguments", reader.at(word),
                     fmt::format("{} takes {} or {}, not both", name, word, names[k]));
        return;
      }
      out.component[k] = v.component[k - first];
    }
    any = true;
  };
  if (forces) take_vector("FXYZ", w.fxyz, 0);
  if (torques) take_vector("TXYZ", w.txyz, 3);
  if (reader.given("FUNCTION")) {
    reader.error("unknown-word", reader.at("FUNCTION"),
                 fmt::format("FUNCTION of {} is USER(…), the call of a compiled routine, and no expression", name),
                 forces ? "FX, FY … take expressions" : "TX, TY, TZ take expressions");
  } else if (!any && !reader.statement().damaged) {
    reader.error("missing-argument", reader.statement().at, fmt::format("{} has no component", name),
                 forces && torques ? "one or more of FX, FY, FZ, TX, TY, TZ"
                 : forces          ? "one or more of FX, FY, FZ"
                                   : "one or more of TX, TY, TZ");
  }
}

void check_vector_force(Model& model, const ElementLabel& label, const VectorForce& f, Diagnostics& diagnostics) {
  if (!f.i.valid() || !f.jfloat.valid() || !f.rm.valid()) return;
  Marker& floating = model.markers[static_cast<std::size_t>(f.jfloat.index)];
  if (!floating.floating) {
    diagnostics.error("fixed-marker", label.at,
                      fmt::format("JFLOAT of {}, {}, must be a floating marker", label.text(), floating.label->text()),
                      "write FLOATING into the MARKER statement");
    return;
  }
  if (!check_fixed(model, label, f.i, "I", diagnostics) || !check_fixed(model, label, f.rm, "RM", diagnostics)) return;
  const bool turns =
      std::any_of(f.component.begin() + 3, f.component.end(), [](const auto& c) { return c && !is_nothing(*c); });
  if (turns) {
    for (const MarkerId m : {f.i, f.jfloat}) check_rotation(model, label, m, diagnostics);
  }
  const Body& body = model.body(model.marker(f.i).place.body);
  if (floating.place.body == model.marker(f.i).place.body) {
    diagnostics.error("same-body", label.at,
                      fmt::format("I and JFLOAT of {} are both on {}", label.text(), body.label.text()));
  }
  floating.follows = f.i;
}

}  // namespace dynalin
