// FE_LOAD/id, FE_PART= [, RM=] {, FX=\FY=\FZ=\TX=\TY=\TZ=}
//
// A force f and a moment m per undeformed length along a beam of finite elements, components in the axes of RM or
// global ones, without a reaction. They work on the motion of the beam's line and on the spin of its sections
// (flexible/beam_load.h). Components may read S, the place along the undeformed beam from 0 to 1, and SD(n), SV(n) and
// SA(n): position, velocity and acceleration of the line there, n = 1 to 3, and 3-1-3 angles, angular velocity and
// angular acceleration of the section, n = 4 to 6.
//
// A component w is an algebraic unknown with w − e = 0; one that varies along the beam is an unknown at each load
// point, and so is what it reads of the beam there, of the line u − Σ h r = 0.
#include <fmt/format.h>

#include "elements/bodies/fe_part.h"
#include "elements/families/defined_unknown.h"
#include "elements/families/markers.h"
#include "elements/families/section_reading.h"
#include "flexible/beam_load.h"
#include "mechanics/binder.h"
#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"
#include "mechanics/pair_blocks.h"
#include "model/schema.h"

namespace dynalin {

namespace {

constexpr std::array<std::string_view, 6> component_names = {"FX", "FY", "FZ", "TX", "TY", "TZ"};

struct BeamLoad {
  BodyId beam;
  MarkerId rm;
  Expression fx, fy, fz, tx, ty, tz, function;
  std::array<std::optional<Expression>, 6> component;

  static constexpr std::array<Argument<BeamLoad>, 9> arguments = {{
      {.name = "FE_PART", .slot = &BeamLoad::beam, .required = true, .help = "the beam it acts on"},
      {.name = "RM", .slot = &BeamLoad::rm, .help = "marker in whose axes the components are given; global by default"},
      {.name = "FX", .slot = &BeamLoad::fx, .unit = "force/length", .help = "along x of RM", .ends = "FUNCTION"},
      {.name = "FY", .slot = &BeamLoad::fy, .unit = "force/length", .help = "along y of RM", .ends = "FUNCTION"},
      {.name = "FZ", .slot = &BeamLoad::fz, .unit = "force/length", .help = "along z of RM", .ends = "FUNCTION"},
      {.name = "TX", .slot = &BeamLoad::tx, .unit = unit::force, .help = "about x of RM", .ends = "FUNCTION"},
      {.name = "TY", .slot = &BeamLoad::ty, .unit = unit::force, .help = "about y of RM", .ends = "FUNCTION"},
      {.name = "TZ", .slot = &BeamLoad::tz, .unit = unit::force, .help = "about z of RM", .ends = "FUNCTION"},
      {.name = "FUNCTION",
       .slot = &BeamLoad::function,
       .help = "user subroutines are not available",
       .ends = "FX FY FZ TX TY TZ"},
  }};
};

bool is_place_along_beam(const Atom& a) { return a.function == find_atom_function("S"); }

// Of SD, SV and SA: how many time derivatives of the motion of the beam they read.
constexpr std::array<std::string_view, 3> motions_of_beam = {"SD", "SV", "SA"};
std::optional<std::size_t> derivative_of_beam(const Atom& a) {
  const auto found = std::ranges::find(motions_of_beam, a.function->name);
  return found == motions_of_beam.end() ? std::nullopt : std::optional(found - motions_of_beam.begin());
}
bool varies_along_beam(const Atom& a) { return is_place_along_beam(a) || derivative_of_beam(a); }

// Of each derivative: three components of the line, three of the turning of its sections.
constexpr std::size_t components_of_motion = 6;

// What takes the place of those in an expression.
constexpr AtomFunction unknown_of_beam = {.name = "motion of the beam",
                                          .family = AtomFamily::data,
                                          .order = -1,
                                          .minimum_arguments = 1,
                                          .maximum_arguments = 1,
                                          .statement = "",
                                          .built = true,
                                          .reads = DataSource::unknown};

class BeamLoadKernel final : public Kernel {
 public:
  BeamLoadKernel(const std::vector<BeamLoad>& loads, const std::vector<ElementLabel>& labels, const Model& model,
                 Layout& layout)
      : labels_(&labels) {
    const std::vector<BeamBody> beams = beam_bodies(model, layout);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const auto is_its = [&](const BeamBody& b) { return b.nodes.front() == loads[k].beam; };
      Load load{*std::ranges::find_if(beams, is_its), std::nullopt, {}, {}, {}, {}};
      if (loads[k].rm.valid()) load.rm = layout.marker(loads[k].rm);
      const std::vector<double> places = places_along(load.beam);
      load.read_at.resize(places.size());
      for (std::size_t axis = 0; axis < component_names.size(); ++axis) {
        const auto& e = loads[k].component[axis];
        if (!e) continue;
        const bool varies = std::ranges::any_of(e->atoms(), varies_along_beam);
        Component c{axis, load.unknowns.size(), varies};
        for (std::size_t p = 0; p < (varies ? places.size() : 1); ++p) {
          const std::int32_t unknown = layout.add_algebraic(labels[k], static_cast<std::int32_t>(axis) + 1);
          load.unknowns.emplace_back(unknown, varies ? at_point(*e, p, places[p], labels[k], layout, load) : *e);
        }
        load.components.push_back(c);
      }
      load.read_at = {};
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
      for (const Read& r : l.read) {
        if (r.is_of_line())
          read_line(l, r, motion, eq);
        else
          read_section(l, r, motion, eq);
      }
      for (std::size_t e = 0; e < l.beam.elements->size(); ++e) load_element(l, e, motion, eq);
    }
  }

  void undefined_values(const Motion& motion, UndefinedValues& values) const override {
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      const Load& l = loads_[k];
      const ElementLabel& label = (*labels_)[k];
      for (const DefinedUnknown& u : l.unknowns) u.find_undefined(motion, label, values);
      for (const Read& r : l.read) {
        if (!r.is_angle() || reading(l, r, motion).has_gradient()) continue;
        values.add(UndefinedValue{&label,
                                  fmt::format("{}: SD({}) has no derivative {}", label.full_text(), r.component + 1,
                                              place_without_gradient(section_angles[r.component - 3])),
                                  false});
      }
    }
  }

 private:
  struct Component {
    std::size_t axis;           // 0–2 force, 3–5 moment
    std::size_t first_unknown;  // of the load, one for each load point of the beam if it varies along it
    bool varies;
    bool is_force() const { return axis < 3; }
  };
  // What a component of a load reads of the motion of the beam at a load point: a component of one of its derivatives.
  struct Read {
    std::size_t point, derivative, component;
    std::int32_t algebraic;
    bool is_of_line() const { return component < 3; }
    bool is_angle() const { return !is_of_line() && derivative == 0; }
  };
  struct Load {
    BeamBody beam;
    std::optional<MarkerPlace> rm;
    std::vector<Component> components;
    std::vector<DefinedUnknown> unknowns;
    std::vector<Read> read;
    // Their unknowns at each load point, derivative by derivative, while expressions are taken apart.
    std::vector<std::array<std::optional<std::int32_t>, motions_of_beam.size() * components_of_motion>> read_at;
  };

  // The expression at a load point of the whole beam; what it reads of the motion there becomes an unknown, once.
  static Expression at_point(const Expression& e, std::size_t point, double place, const ElementLabel& of,
                             Layout& layout, Load& load) {
    return e.with_definitions([&](const Atom& a) -> std::optional<Expression> {
      if (is_place_along_beam(a)) return Expression::constant(place);
      const auto derivative = derivative_of_beam(a);
      if (!derivative) return std::nullopt;
      const auto component = static_cast<std::size_t>(a.argument[0] - 1);
      // Those of the line first.
      const std::size_t which = 3 * motions_of_beam.size() * (component / 3) + 3 * *derivative + component % 3;
      std::optional<std::int32_t>& known = load.read_at[point][which];
      if (!known) {
        known = layout.add_algebraic(of, static_cast<std::int32_t>(component_names.size() + which) + 1);
        load.read.push_back({point, *derivative, component, *known});
      }
      Atom unknown = a;
      unknown.function = &unknown_of_beam;
      unknown.argument = {*known};
      return Expression::of_atom(unknown);
    });
  }

  static void read_line(const Load& l, const Read& r, const Motion& motion, Equations& eq) {
    const std::size_t element = r.point / beam_load_points;
    const BeamLinePoint line = beam_line_at(r.point % beam_load_points, *(*l.beam.elements)[element]);
    const BeamMotion m = l.beam.motion(motion, element);
    const auto of_node = [&](std::size_t end) {
      const BodyMotion& node = motion.body(l.beam.nodes[element + end]);
      return r.derivative == 0 ? node.r : r.derivative == 1 ? node.rdot : node.rddot;
    };
    const auto of_slope = [&](std::size_t end) {
      const auto& s = m.slope[end];
      return r.derivative == 0 ? value(s) : r.derivative == 1 ? rate(s) : acceleration(s);
    };
    const std::array<Vector, 4> parts = {of_node(0), of_slope(0), of_node(1), of_slope(1)};
    constexpr std::array family = {PartialBy::position, PartialBy::damping, PartialBy::acceleration};
    const BeamColumns at = l.beam.columns(eq.layout(), element);
    const std::int32_t row = begin_definition(motion, eq, r.algebraic);
    for (std::size_t a = 0; a < parts.size(); ++a) {
      eq.add_residual(row, -line.factor[a] * parts[a][r.component]);
      eq.add(family[r.derivative], row, at[line.at[a] + r.component], -line.factor[a]);
    }
  }

  static SectionReading reading(const Load& l, const Read& r, const Motion& motion) {
    const std::size_t element = r.point / beam_load_points;
    return section_reading(*(*l.beam.elements)[element], l.beam.motion(motion, element), r.point % beam_load_points,
                           r.derivative, r.component - 3);
  }

  static void read_section(const Load& l, const Read& r, const Motion& motion, Equations& eq) {
    const SectionReading read = reading(l, r, motion);
    const std::size_t element = r.point / beam_load_points;
    const BeamElement& e = *(*l.beam.elements)[element];
    const BeamColumns at = l.beam.columns(eq.layout(), element);
    const std::int32_t row = begin_definition(motion, eq, r.algebraic);
    eq.add_residual(row, -read.value);
    for (std::size_t k = 0; k < e.coordinates(); ++k) {
      if (!e.turns_sections(k)) continue;
      eq.add(PartialBy::position, row, at[k], -read.by_position[k]);
      if (r.derivative > 0) eq.add(PartialBy::damping, row, at[k], -read.by_rate[k]);
      if (r.derivative > 1) eq.add(PartialBy::acceleration, row, at[k], -read.by_acceleration[k]);
    }
  }

  // Of all load points of the beam, by its undeformed length.
  static std::vector<double> places_along(const BeamBody& beam) {
    std::vector<double> places;
    double whole = 0, before = 0;
    for (const auto& e : *beam.elements) whole += e->length();
    for (const auto& e : *beam.elements) {
      for (std::size_t g = 0; g < beam_load_points; ++g)
        places.push_back((before + beam_load_place(g) * e->length()) / whole);
      before += e->length();
    }
    return places;
  }

  static const DefinedUnknown& value_at(const Load& l, const Component& c, std::size_t point) {
    return l.unknowns[c.first_unknown + (c.varies ? point : 0)];
  }

  static void load_element(const Load& l, std::size_t element, const Motion& motion, Equations& eq) {
    const BeamElement& e = *(*l.beam.elements)[element];
    const BeamMotion m = l.beam.motion(motion, element);
    const BeamColumns at = l.beam.columns(eq.layout(), element);
    const bool forces = std::ranges::any_of(l.components, &Component::is_force),
               moments = !std::ranges::all_of(l.components, &Component::is_force);
    const Matrix3 axes = l.rm ? motion.axes(*l.rm) : Matrix3::identity();
    const auto points = beam_load_points_of(e, m, moments);
    std::array<Vector, beam_load_points> force, moment;
    BeamVector load = BeamVector::Zero();
    for (std::size_t g = 0; g < beam_load_points; ++g) {
      for (const Component& c : l.components) {
        const DefinedUnknown& w = value_at(l, c, element * beam_load_points + g);
        const Vector& axis = axes[c.axis % 3];
        (c.is_force() ? force[g] : moment[g]) += w.at(motion) * axis;
        if (!eq.wants(PartialBy::algebraic)) continue;
        BeamVector by = BeamVector::Zero();
        points[g].add(c.is_force() ? axis : Vector{}, c.is_force() ? Vector{} : axis, by);
        add_column(PartialBy::algebraic, w.column(), by, {e, c.is_force(), !c.is_force()}, at, eq);
      }
      points[g].add(force[g], moment[g], load);
    }
    for (std::size_t k = 0; k < e.coordinates(); ++k) eq.add_residual(at[k], -load(static_cast<Eigen::Index>(k)));
    if (!eq.wants(PartialBy::position)) return;
    if (moments) {
      const BeamMatrix by_position = beam_moments_by_position(e, m, moment);
      for (std::size_t k = 0; k < e.coordinates(); ++k) {
        if (e.turns_sections(k))
          add_column(PartialBy::position, at[k], by_position.col(static_cast<Eigen::Index>(k)), {e, false, true}, at,
                     eq);
      }
    }
    if (!l.rm) return;
    for_each_turning_block(
        motion, *l.rm, eq.layout(), [&](std::int32_t column, std::size_t count, const Matrix3& turns) {
          for (std::size_t c = 0; c < count; ++c) {
            BeamVector by = BeamVector::Zero();
            for (std::size_t g = 0; g < beam_load_points; ++g)
              points[g].add(cross(turns[c], force[g]), cross(turns[c], moment[g]), by);
            add_column(PartialBy::position, column + static_cast<std::int32_t>(c), by, {e, forces, moments}, at, eq);
          }
        });
  }

  // Forces work on places and slopes, moments on what turns the sections.
  struct Reach {
    const BeamElement& element;
    bool forces, moments;

    bool contains(std::size_t coordinate) const {
      return (forces && !is_beam_rotation(coordinate)) || (moments && element.turns_sections(coordinate));
    }
  };
  static void add_column(PartialBy family, std::int32_t column, const BeamVector& by, const Reach& reach,
                         const BeamColumns& at, Equations& eq) {
    for (std::size_t k = 0; k < reach.element.coordinates(); ++k) {
      if (reach.contains(k)) eq.add(family, at[k], column, -by(static_cast<Eigen::Index>(k)));
    }
  }

  const std::vector<ElementLabel>* labels_;
  std::vector<Load> loads_;
};

class BeamLoadSet final : public TypedSet<BeamLoad> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    BeamLoad& l = elements[k];
    if (!read_arguments(l, reader)) return;
    const std::string name = reader.label().text();
    if (reader.given("FUNCTION")) {
      reader.error("argument-not-built", reader.at("FUNCTION"), "user subroutines are not available");
      return;
    }
    bool any = false;
    const std::array<const Expression*, 6> written = {&l.fx, &l.fy, &l.fz, &l.tx, &l.ty, &l.tz};
    for (std::size_t c = 0; c < component_names.size(); ++c) {
      if (!reader.given(component_names[c])) continue;
      l.component[c] = *written[c];
      any = true;
    }
    if (!any && !reader.statement().damaged) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} has no component", name),
                   "one or more of FX, FY, FZ, TX, TY, TZ");
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const MarkerId rm = elements[k].rm;
      if (rm.valid()) check_fixed(model, labels[k], rm, "RM", diagnostics);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<BeamLoadKernel>(elements, labels, model, layout);
  }
};

}  // namespace

extern constinit const Kind fe_load = Kind{
    "FE_LOAD",
    "",
    "A force and moment per length along a beam of finite elements.",
    Kind::Role::element,
    detail::argument_infos<BeamLoad>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<BeamLoadSet>(kind);
    }}.deactivatable();

}  // namespace dynalin
