// The validated mechanism: typed elements with every id resolved to a handle. Knows mechanics as data; it
// knows no numerics and no solver.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "dynalin/units.h"
#include "expression/spline.h"
#include "mechanics/layout.h"
#include "model/id_table.h"
#include "model/kind.h"
#include "model/settings.h"

namespace dynalin {

struct RoutineData;

// Initial velocity as stated: only the components that are given. Everything else may change freely.
struct StatedVelocity {
  std::array<std::optional<double>, 3> of_cm;    // along the axes of `cm_axes`, the CM's velocity
  std::array<std::optional<double>, 3> angular;  // along the axes of `angular_axes`
  MarkerId cm_axes = global_frame;
  MarkerId angular_axes = global_frame;

  // The arguments of every body that state them.
  static constexpr std::array<std::string_view, 3> cm_names = {"VX", "VY", "VZ"}, angular_names = {"WX", "WY", "WZ"};
  // Of all bodies that state no component.
  static const std::shared_ptr<const StatedVelocity>& none();
};

// What a body is and how its coordinates are listed.
struct BodyNature {
  BodyListing listed;
  std::vector<ExtraCoordinate> modal;  // coordinates of its own, where it changes its shape
  ExtraKind modal_kind;                // what they are

  // Of all rigid bodies that are PARTs.
  static const std::shared_ptr<const BodyNature>& part();
};

// Large models have a great many: what few bodies have stands outside.
struct Body {
  BodyKind kind = BodyKind::part;
  std::array<bool, 6> exact{};  // X Y Z PSI THETA PHI held in the assembly
  MarkerId origin_at{};         // the marker that is taken as its origin where the one written stands too far away
  ElementLabel label;
  Pose pose;             // BCS as drawn
  Vector origin_offset;  // of that marker from the origin written, along the axes of the BCS
  double mass = 0;       // dynamical: user mass / ucf [force·time²/length]
  double user_mass = 0;
  Vector p_BC;                         // CM in the BCS
  Matrix3 J_BC;                        // dynamical inertia tensor about the CM, BCS axes
  Matrix3 R_BI = Matrix3::identity();  // axes along which the dataset gives the inertia (IM, or CM), in the BCS
  std::shared_ptr<const StatedVelocity> velocity = StatedVelocity::none();
  std::shared_ptr<const BodyNature> nature = BodyNature::part();
};

struct Marker {
  const ElementLabel* label = nullptr;  // of its set
  MarkerPlace place;
  bool floating = false;
  MarkerId follows{};  // of a floating marker: the marker at whose origin an element holds it
};

struct Model {
  std::string title;
  Units units;
  Settings settings;
  Vector gravity;                                        // [length/time²], global axes
  std::vector<Body> bodies;                              // by BodyId, ground first
  std::vector<std::unique_ptr<NodeShapes>> node_shapes;  // that places of markers point to
  std::vector<Marker> markers;                           // by MarkerId, the global frame first
  std::vector<std::unique_ptr<ElementSet>> sets;         // in the order of the catalogue, only kinds that occur

  std::optional<ElementHandle> find(std::string_view statement, std::int64_t id) const;
  // The element of a label, nothing if it is of another class of statements.
  template <class Class>
  std::optional<ElementRef<Class>> find_as(const ElementLabel& of) const {
    if (of.statement != Class::statement) return std::nullopt;
    const auto handle = find(of.statement, of.id);
    return handle ? std::optional(ElementRef<Class>{*handle}) : std::nullopt;
  }
  std::optional<MarkerId> find_marker(std::int64_t id) const;  // 0 is the global frame
  std::optional<BodyId> find_body(std::string_view statement, std::int64_t id) const;

  bool has(Kind::Gives what) const;  // whether any element gives that
  const ElementSet& set(ElementHandle h) const { return *sets[static_cast<std::size_t>(h.set)]; }
  const ElementLabel& label(ElementHandle h) const { return set(h).labels[static_cast<std::size_t>(h.index)]; }
  // The element of a handle, nothing if it is of another type.
  template <class E>
  const E* get(ElementHandle h) const {
    if (!h.valid()) return nullptr;
    const auto* typed = dynamic_cast<const TypedSet<E>*>(&set(h));
    return typed ? &typed->elements[static_cast<std::size_t>(h.index)] : nullptr;
  }
  const Marker& marker(MarkerId m) const { return markers[static_cast<std::size_t>(m.index)]; }
  const Body& body(BodyId b) const { return bodies[static_cast<std::size_t>(b.index)]; }

  // The largest distance between two of the given markers and the mass centres as drawn: the length by which
  // displacements and rotations are compared. At most 10 000 times the radius that holds three quarters of them
  // or, if that is more, the size of a body; that size where all are nearly at one place; 1 where there is nothing.
  // [length]
  double characteristic_length(std::span<const MarkerId> markers) const;
  double characteristic_length() const;  // of all markers

  // VARIABLEs whose course in time a MOTION follows: they cannot be inputs of a linear model.
  struct FollowedVariable {
    const ElementLabel* follower;
    VariableRef variable;
  };
  std::vector<FollowedVariable> followed_in_time;
  // Calls of INVPSD, whose data are looked at when all SPLINEs are read.
  std::vector<SplineUse> spectra;

  // Id tables and the text that labels and spans point into.
  std::map<std::string, IdTable<ElementHandle>, std::less<>> ids;
  IdTable<MarkerId> marker_ids;
  std::map<std::string, IdTable<BodyId>, std::less<>> body_ids;
  std::shared_ptr<const Dataset> dataset;
  std::vector<SourceRef> further_sources;     // further texts that messages point into
  std::vector<std::string> input_files;       // that statements name and the model is made of
  bool calls_routines = false;                // compiled ones of the user: by one thread at a time
  bool edited = false;                        // bodies may stand elsewhere than they are drawn when it counts
  std::shared_ptr<RoutineData> routine_data;  // what they read beside measures; null where there are none
};

// Reads every statement of the dataset by the catalogue. All problems are reported in one go; the model is
// usable only without errors.
struct BuildOptions {
  std::optional<double> user_value{};  // what takes the place of compiled routines; nothing: they are errors
  // The dataset itself, if nobody needs the arguments of its statements but the model: they go as they are read.
  std::shared_ptr<Dataset> read_once{};
  bool edited = false;  // by commands, perhaps in the middle of a run
};
Parsed<std::unique_ptr<Model>> build_model(std::shared_ptr<const Dataset>, Catalogue, const BuildOptions& = {});

}  // namespace dynalin
