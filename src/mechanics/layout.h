// The numbering of unknowns and equations, filled by the elements when a System is made.
//
// Coordinates come in blocks: 6 a part (δr then δθ, global axes), 3 a point mass, then outside of poses the modal
// coordinates of bodies, in the order of these, and any number for an element that brings coordinates of its own.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostics.h"
#include "dynalin/results.h"
#include "expression/measures.h"
#include "mechanics/handles.h"
#include "mechanics/motion.h"

namespace dynalin {

enum class BodyKind : std::uint8_t { ground, part, point_mass };

// What a body of the layout is to the motion of the model.
enum class BodyRole : std::uint8_t {
  rigid,   // its pose is all that moves of it
  shaped,  // the BCS of a body that moves by the amplitudes of shapes as well
  nodal,   // one of the nodes of a body that deforms between them, known by its number in that body
};

// The type codes of a coordinate as a state of linear models: along global axes, seen from a marker (RM), and among
// those of the original implementation.
struct StateTypes {
  StateType global{}, relative{}, principal{};

  constexpr StateTypes() = default;
  constexpr StateTypes(StateType whichever) : global(whichever), relative(whichever), principal(whichever) {}
  constexpr StateTypes(StateType global_, StateType relative_, StateType principal_)
      : global(global_), relative(relative_), principal(principal_) {}
};

// How a pose is listed among the states of its element.
struct PoseStates {
  StateTypes types{StateType::part, StateType::part_relative, StateType::part_euler};
  std::array<std::int32_t, 6> number = {1, 2, 3, 4, 5, 6};  // of δr and δθ
  std::int32_t rates_behind = 6;  // by how much the number of a rate is more than that of its coordinate
};

// What its element says of a body.
struct BodyListing {
  BodyRole role = BodyRole::rigid;
  std::int64_t node = 0;  // of a nodal one: its number as written
  PoseStates states;
};

struct BodyBlock {
  BodyKind kind = BodyKind::ground;
  std::int32_t offset = -1;  // first coordinate, −1 for ground
  std::int32_t count = 0;    // 0, 3 or 6
  ElementLabel label;
  double largest_step = std::numeric_limits<double>::infinity();  // of a search for rest [length]
  BodyListing listed{};

  bool turns() const { return kind == BodyKind::part; }
  bool is_rigid() const { return listed.role == BodyRole::rigid; }
  bool is_node() const { return listed.role == BodyRole::nodal; }
};

// A coordinate outside bodies.
struct ExtraCoordinate {
  std::string name;
  double initial = 0;
  double speed = 0;  // the least length that a unit of it moves anything [length], 0 if it is like an angle
  double largest_step = std::numeric_limits<double>::infinity();  // of an iteration
  std::int32_t number = 0;  // among the states of its element; 0: its place in the block, from 1
};

// What coordinates outside bodies are to the motion of the model.
enum class ExtraRole : std::uint8_t {
  follower,  // no inertia: where something stands on a curve. It goes where bodies take it
  shape,     // amplitudes of the shapes of a body, which moves as a whole before it deforms
  nodal,     // of a node of a body that deforms, beside its pose: with inertia in each, moved as readily as the pose
};

// Arguments by which commands may state anew where something starts, and how fast, while its element goes on as it was;
// empty where there are none.
struct StartArguments {
  std::string_view displacement{}, velocity{};
};

// What an element says of its coordinates outside bodies.
struct ExtraKind {
  StateTypes types;  // of these coordinates and of their rates as states
  ExtraRole role = ExtraRole::follower;
  std::int32_t rates_behind = 0;  // by how much the number of a rate is more than that of its coordinate
  StartArguments starts{};
};

// The coordinates outside bodies of one element.
struct ExtraBlock {
  std::int32_t offset = 0;  // among all coordinates
  std::int32_t count = 0;
  ElementLabel label;
  ExtraKind kind;
  std::vector<ExtraCoordinate> coordinates;

  bool is_shape() const { return kind.role == ExtraRole::shape; }
  // Whether a body deforms by them, with inertia.
  bool is_deformation() const { return kind.role != ExtraRole::follower; }
};

class ParametricCurve;

// A floating marker at a point of contact: on the curve that another marker carries, at a coordinate outside bodies.
struct CurvePoint {
  MarkerId marker, carrier;
  std::shared_ptr<const ParametricCurve> curve;
  std::int32_t coordinate = -1;
};

enum class RowLevel : std::uint8_t { position, velocity };

struct ConstraintRow {
  const ElementLabel* owner = nullptr;
  std::string_view name;  // "Zi.Xj"
  RowLevel level = RowLevel::position;
  // Differential states that the row and its rate have with the factor −1: the courses of a MOTION. They enter rows
  // nowhere else.
  std::int32_t course = -1, course_rate = -1;
  bool prescribed = false;     // moves parts from where they are drawn, as is meant: a MOTION
  bool perpendicular = false;  // asks an axis of I and one of J to be perpendicular
};

// Bodies and coordinates of a flexible body whose deformation is small beside how it turns.
struct TurningWhole {
  std::vector<BodyId> bodies;
  // Vectors along global axes that turn with it: the place of the first of three among coordinates outside bodies.
  std::vector<std::size_t> vectors;
};

// A scalar value with one equation of its own: VARIABLE, FUNCTION-valued force, output of a controller.
struct AlgebraicUnknown {
  const ElementLabel* owner = nullptr;
  std::int32_t component = 0;  // 1-based where the owner has several, else 0
  double guess = 0;
  bool guess_is_start = false;  // stated as an initial value: a start that differs is worth a warning
  std::int32_t rate = -1;       // the unknown that is its time derivative, where something reads it
};

struct DifferentialState {
  const ElementLabel* owner = nullptr;
  StateType type = StateType::diff;
  std::int32_t coordinate = 1;
  double initial = 0;
  bool held_in_statics = false;
  double initial_rate = 0;        // where the search for it starts
  bool held_in_dynamics = false;  // a constant of the linear model, whose rate counts as zero
  bool course_of_motion = false;  // of a MOTION: what it integrates in time; a constant of statics and linear models
  bool goes_on = false;  // of a course: nothing states where it starts, so in a run that has begun it is where it is
  std::string_view start_argument{};  // that states where it starts, by itself; of others their element does as a whole

  // Whether it is a state of linear models, and of whatever lists states.
  bool varies() const { return !held_in_dynamics && !course_of_motion; }
};

// What an entry of the memory belongs to, by which it is found again in an edited model.
struct MemoryOwner {
  const ElementLabel* element = nullptr;  // null of an angle
  std::string_view name;                  // of several that an element has; those of one name follow each other
};

// An angle that counts whole turns: AX, AY or AZ of marker i seen from j.
struct CountedAngle {
  Measure measure = Measure::AZ;
  MarkerId i, j;
  std::int32_t memory = -1;  // its entry there: the angle with all its turns
};

// What a call of DELAY delays, and the statement that it stands in.
struct DelayOwner {
  std::string statement;
  std::int64_t id = 0;
  std::string delayed;  // as written, in capitals and without blanks
  std::int32_t state = -1;
};

class Layout {
 public:
  std::vector<BodyBlock> bodies;            // by BodyId
  std::vector<const MarkerPlace*> markers;  // by MarkerId; owned by the model, as their labels are
  std::vector<const ElementLabel*> marker_labels;
  std::vector<ExtraBlock> extras;
  std::set<std::int32_t> followers;  // coordinates that rows of their own element give: the last to become states
  std::vector<CurvePoint> curve_points;
  std::vector<TurningWhole> turning_wholes;
  std::vector<ConstraintRow> rows;
  std::vector<AlgebraicUnknown> algebraic;
  std::vector<DifferentialState> states;
  Memory memory;                           // initial contents
  std::vector<MemoryOwner> memory_owners;  // of each entry
  std::vector<CountedAngle> angles;
  std::vector<DelayOwner> delay_calls;               // in the order of their histories
  std::vector<const ElementLabel*> velocity_driven;  // motions that contradict rest: no static analysis
  bool reads_analysis = false;                       // by MODE: values change with the kind of analysis
  std::int32_t coordinate_count = 0;                 // all blocks
  std::int32_t body_coordinate_count = 0;            // of the bodies alone; extras follow them

  const BodyBlock& body(BodyId b) const { return bodies[static_cast<std::size_t>(b.index)]; }
  const MarkerPlace& marker(MarkerId m) const { return *markers[static_cast<std::size_t>(m.index)]; }
  const ElementLabel& marker_label(MarkerId m) const { return *marker_labels[static_cast<std::size_t>(m.index)]; }

  std::int32_t add_body(BodyKind, ElementLabel, const BodyListing& = {});
  // After all bodies, their modal coordinates first; returns the first coordinate.
  std::int32_t add_extra(ElementLabel, ExtraKind, std::vector<ExtraCoordinate>);
  // Where a coordinate outside bodies stands among those in Motion.
  std::size_t extra_index(std::int32_t coordinate) const {
    return static_cast<std::size_t>(coordinate - body_coordinate_count);
  }
  std::int32_t add_row(const ElementLabel& owner, std::string_view name, RowLevel level = RowLevel::position);
  std::int32_t add_algebraic(const ElementLabel& owner, std::int32_t component = 0, double guess = 0);
  std::int32_t add_state(const DifferentialState&);
  std::int32_t add_memory(const ElementLabel& owner, std::string_view name, double initial = 0);
  // Where the memory has the angle with all its turns: one entry for all that read it, so that they agree.
  std::int32_t count_turns(Measure, MarkerId i, MarkerId j);

  std::size_t row_count() const { return rows.size(); }
  // The contact that holds a floating marker, null if none does.
  const CurvePoint* curve_point(MarkerId) const;
  // Why the model cannot be solved as it stands, found while its equations were made.
  Diagnostics problems;
  Diagnostics remarks;  // worth a warning in every run
  // "DX of PART/3" and the like, for messages.
  std::string coordinate_text(std::int32_t coordinate) const;

 private:
  std::unordered_map<std::uint64_t, std::int32_t> entry_of_angle_;
};

}  // namespace dynalin
