// An exported model as the things that cards say, with their final numbers, before they are text: the boxes
// (closed_box.h, open_box.h, graphics.h) fill it, deck_text.h writes it. Global (basic) axes, units in which force is
// mass times acceleration: masses are divided by the dataset's unit conversion factor.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace dynalin::nastran {

// A degree of freedom: component 1 … 6 of a GRID in its displacement system, 0 of an SPOINT.
struct Dof {
  std::int64_t point = 0;
  int component = 0;
  auto operator<=>(const Dof&) const = default;
};

// What an item belongs to. `body` counts Deck::bodies; −1 is what several bodies share: joints, forces, the ground.
// `name` is the text of the comment before the card, empty for none.
struct Owner {
  std::int32_t body = -1;
  std::string name;
};

struct Body {        // a PART, POINT_MASS …, each with a file of its own in style C
  std::string name;  // as comments and file names have it
  std::int64_t grid = 0;
};
struct Grid : Owner {
  std::int64_t id = 0;
  Vec3<double> position;
  std::int64_t displacement_system = 0;  // CD
  std::string fixed;                     // PS, "123456" of the ground
};
struct ScalarPoint : Owner {
  std::int64_t id = 0;
};
struct CoordinateSystem : Owner {  // CORD2R
  std::int64_t id = 0;
  Vec3<double> origin;
  Mat3<double> axes;  // columns x, y, z
};
struct ConcentratedMass : Owner {  // CONM2 at its grid, global axes
  std::int64_t id = 0, grid = 0;
  double mass = 0;
  Mat3<double> inertia;  // the tensor, not its negative products
};
struct RigidJoint : Owner {  // RJOINT
  std::int64_t id = 0, grid_A = 0, grid_B = 0;
  std::string components;  // that are equal: "12345"
};
struct RigidElement : Owner {  // RBE2 of all six components
  std::int64_t id = 0, independent = 0;
  std::vector<std::int64_t> dependent;
};
struct Relation : Owner {  // MPC, Σ coefficient · u = 0, the dependent one first
  struct Term {
    Dof dof;
    double coefficient;
  };
  std::vector<Term> terms;
};
struct FixedPoint : Owner {  // SPC
  std::int64_t point = 0;
  std::string components;  // "456"; "0" of an SPOINT
};
struct Bush : Owner {  // CBUSH with its PBUSH
  std::int64_t id = 0, property = 0, grid_A = 0, grid_B = 0, system = 0;
  double location = 0.5;  // S
  std::array<double, 6> stiffness{}, damping{};
};
enum class MatrixKind : std::uint8_t { K, B, M };
// A DMIG, or two where it is split: K u + B u′ + M u″ on the left-hand side. An entry at a place that was named before
// is added to it.
struct Matrix : Owner {
  MatrixKind kind = MatrixKind::K;
  std::string suffix;  // "VVV"
  struct Entry {
    Dof row, column;
    double value;
  };
  std::vector<Entry> entries;
};
struct InitialState : Owner {  // TIC
  Dof dof;
  double displacement = 0, velocity = 0;
};

// Shapes for the eye: without mass and without stiffness of their own.
struct Shell : Owner {  // CQUAD4, or CTRIA3 of three grids
  std::int64_t id = 0, property = 0;
  std::vector<std::int64_t> grids;
};
struct Line : Owner {  // PLOTEL, or CROD where it has a property
  std::int64_t id = 0, property = 0;
  std::int64_t grid_A = 0, grid_B = 0;
};
struct ShapeProperty : Owner {  // PSHELL or PROD, with a MAT1
  std::int64_t id = 0, material = 0;
  bool rod = false;
  double thickness = 0;  // or area of a rod
};

// Where channels of frequency response act and are read.
struct InputPoint {
  std::size_t channel = 0;  // of ExportOptions::force_input_channel
  std::int64_t grid = 0, system = 0;
};
struct OutputPoint {
  std::size_t channel = 0;  // of ExportOptions::displacement_output_channel
  std::int64_t grid = 0;
};

// A mode, on the points that the punch file has: its eigenvalue [rad/time] and for each point six complex components,
// the first alone of scalar points.
struct DeckMode {
  std::array<double, 2> eigenvalue{};
  std::vector<std::array<std::array<double, 2>, 6>> shape;
};

struct Deck {
  bool open = false;  // OPENBOX
  double time = 0;
  std::size_t states = 0;  // size of the state matrix
  std::vector<Body> bodies;
  std::vector<Grid> grids;
  std::vector<ScalarPoint> scalar_points;
  std::vector<CoordinateSystem> systems;
  std::vector<ConcentratedMass> masses;
  std::vector<RigidJoint> rigid_joints;
  std::vector<RigidElement> rigid_elements;
  std::vector<Relation> relations;
  std::vector<FixedPoint> fixed_points;
  std::vector<Bush> bushes;
  std::vector<Matrix> matrices;
  std::vector<InitialState> initial_states;
  std::vector<Grid> shape_grids;
  std::vector<RigidElement> shape_ties;
  std::vector<Shell> shells;
  std::vector<Line> lines;
  std::vector<ShapeProperty> shape_properties;
  std::vector<InputPoint> inputs;
  std::vector<OutputPoint> outputs;
  std::vector<std::int64_t> mode_points;  // grids, then scalar points, ascending
  std::vector<DeckMode> modes;
};

}  // namespace dynalin::nastran
