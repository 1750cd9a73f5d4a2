// A plain description of a spatial mechanism: what a dataset says, before anybody has interpreted it. The
// oracle evaluates it, dataset_text writes it for the product to read; both start from the same doubles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expression.h"

namespace dynalin::oracle {

using Triple = std::array<double, 3>;
// 3-1-3 angles that turn the z axis of a marker onto a global axis.
inline constexpr Triple z_along_x{1.5707963267948966, 1.5707963267948966, 0};
inline constexpr Triple z_along_y{3.141592653589793, 1.5707963267948966, 0};

// A node of a beam turns as a part does; its slopes and the rotations of the middles of its elements are triples, moved
// as point masses are. All of them take what inertia and loads they have from their beam (see Beam). So do the frame
// of a flexible body, the triple of its modal coordinates and the nodes that carry markers (see Flexible).
enum class BodyKind {
  ground,
  part,
  point_mass,
  beam_node,
  flexible_frame,
  flexible_node,
  flexible_modes,
  beam_slope,
  beam_middle
};
[[nodiscard]] constexpr bool turns(BodyKind kind) {
  return kind == BodyKind::part || (kind >= BodyKind::beam_node && kind <= BodyKind::flexible_node);
}
[[nodiscard]] constexpr bool of_flexible(BodyKind kind) {
  return kind >= BodyKind::flexible_frame && kind <= BodyKind::flexible_modes;
}
[[nodiscard]] constexpr bool is_elastic(BodyKind kind) { return kind >= BodyKind::beam_node; }
[[nodiscard]] constexpr bool of_beam(BodyKind kind) { return is_elastic(kind) && !of_flexible(kind); }

struct BodyRef {
  BodyKind kind = BodyKind::part;
  int id = 0;
  friend bool operator==(const BodyRef&, const BodyRef&) = default;
};
inline constexpr BodyRef ground{BodyKind::ground, 1};

struct Body {
  BodyRef ref;
  double mass = 0;
  std::array<double, 6> ip{};  // xx yy zz xy xz yz, product integrals positive
  int cm = 0, im = 0;          // marker ids, 0 = not given
  Triple qg{}, reuler{};
  // Of the CM marker, global axes, and in the axes of the CM marker; of what belongs to a beam both global.
  std::optional<Triple> v, w;
};

struct Marker {
  int id = 0;
  BodyRef body;
  Triple qp{}, reuler{};
  bool floating = false;
};

// Joints, then primitives.
enum class JointType {
  revolute,
  translational,
  spherical,
  universal,
  fixed,
  cylindrical,
  planar,
  hooke,
  convel,
  screw,
  rackpin,
  atpoint,
  inline_,
  inplane,
  orientation,
  parallel_axes,
  perpendicular,
  gcon_plane,  // INPLANE and PERPENDICULAR written as GCONs in marker measures
  gcon_right_angle
};
[[nodiscard]] inline bool is_gcon(JointType t) { return t >= JointType::gcon_plane; }
[[nodiscard]] inline bool is_primitive(JointType t) { return t >= JointType::atpoint && !is_gcon(t); }
struct Joint {
  int id = 0;
  JointType type = JointType::revolute;
  int i = 0, j = 0;
  double size = 0;  // PITCH of a screw, PD of a rack and pinion
};
// Equations that a joint of each type states.
[[nodiscard]] int equations_of(JointType type);

// r1 q1 + r2 q2 (+ r3 q3) = 0 for the displacements of joints, R or T each.
struct Coupler {
  int id = 0;
  std::vector<int> joints;
  std::vector<double> scales;
  std::string freedoms;
};
struct Gear {
  int id = 0;
  std::array<int, 2> joints{};
  int cv = 0;
};
// function = 0; of rates: it holds velocities, to which it is affine.
struct Gcon {
  int id = 0;
  bool of_rates = false;
  Expr function;
};

// A spline of order k through points, the rows of a MATRIX, or along them as control points.
struct Curve {
  int id = 0, matrix = 0;
  bool closed = false, controls = false;
  int order = 4;
};
// Of a curve on marker j and the origin of marker i (PTCV; AXCV: and its z axis), the x-y plane of marker i (PLCV), or
// another curve on marker i (CVCV), in their x-y planes.
struct Contact {
  int id = 0;
  bool two_curves = false;
  int i = 0, j = 0;
  int ifloat = 0, jfloat = 0;            // PTCV: the latter alone
  int icurve = 0, jcurve = 0;            // but for CVCV the latter alone
  double u = 0, v = 0;                   // near the parameters of the contact on i and on j; not written
  std::optional<Triple> at_i{}, at_j{};  // IDISP, and JDISP or DISP
  int axes_i = 0, axes_j = 0;            // IICM, and JICM or ICM
  std::optional<double> speed_i{}, speed_j{};
  bool plane = false, axis = false;

  [[nodiscard]] bool floats_on_i() const { return two_curves || plane; }
  [[nodiscard]] int equations() const { return plane ? 1 : axis ? 4 : 2; }
};

// c0 + c1 t + c2 t^2 + c3 t^3 + amplitude sin(frequency t + phase)
struct TimeFunction {
  std::array<double, 4> c{};
  double amplitude = 0, frequency = 0, phase = 0;
};
// Of a joint: R or T; of its pair of markers: X, Y, Z or the angles 1, 2, 3 of Rx Ry Rz. f is the displacement; what
// is written is its derivative of the order `level`.
struct Motion {
  int id = 0, joint = 0;
  TimeFunction f;
  char freedom = 'R';
  int level = 0;
};

enum class Direction { translational, rotational };
struct SpringDamper {
  int id = 0;
  Direction direction = Direction::translational;
  int i = 0, j = 0;
  double k = 0, c = 0, preload = 0, free = 0;  // free: LENGTH or ANGLE; preload: FORCE or TORQUE
};

enum class Reaction { on_j, action_only };
struct Sforce {
  int id = 0;
  Direction direction = Direction::translational;
  Reaction reaction = Reaction::on_j;
  int i = 0, j = 0;
  Expr function;
};

// F = force - K (y - length) - C y' in the axes of J. C is `ratio` times K, or c where the ratio is 0.
struct LinearForce {
  int id = 0;
  LinearKind kind = LinearKind::bushing;
  int i = 0, j = 0;
  std::array<std::array<double, 6>, 6> k{}, c{};  // by rows; k of a beam follows from its section
  std::array<double, 6> length{}, force{};
  std::array<double, 9> beam{};  // LENGTH AREA IXX IYY IZZ E G ASY ASZ
  double ratio = 0;              // CRATIO of a field or beam
};
// The same for n markers as seen from J, with matrices of 6 n rows: ids of MATRIX statements, 0 = not given.
struct Nforce {
  int id = 0, j = 0;
  std::vector<int> i;
  int k = 0, c = 0, length = 0, force = 0;
  double ratio = 0;  // CRATIO
};
// One tension force + k (L - length) + c L' along markers, L the sum of their distances.
struct Cable {
  int id = 0;
  std::vector<int> markers;
  double k = 0, c = 0, length = 0, force = 0;
};
// The film between a shaft about the origin of i and a bore about z of j.
struct Journal {
  int id = 0, i = 0, j = 0;
  double radius = 0, length = 0, clearance = 0, viscosity = 0, speed = 0;
};
// Six components on I in the axes of RM; a component without expression is zero.
struct GeneralForce {
  int id = 0, i = 0, jfloat = 0, rm = 0;
  std::array<std::optional<Expr>, 6> component;
};

// Which statement it is written as: 1, without torques, is a VFORCE, 2, without forces, a VTORQUE, 0 a GFORCE.
[[nodiscard]] int general_statement(const GeneralForce& force);

// In a joint. effect: 1 stiction, 2 sliding, 0 both; inputs: 1 force, 2 bending, 4 torsion, 8 preload; delta: how the
// overlap goes with displacement.
struct Friction {
  int id = 0, joint = 0;
  double mu_static = 0.3, mu_dynamic = 0.2, velocity = 1, ratio = 1.5, deformation = 1;
  double pin = 1, arm = 1, bending = 1, ball = 1, reaction = 1, overlap = 1000;
  double force_preload = 0, torque_preload = 0;
  int delta = 0, effect = 0, inputs = 15;
  bool on_j = false;  // the bar of the cross
  bool lugre = false;
  double bristles = 1, bristle_damping = 0, viscosity = 0;
};

// A GRAPHICS that bounds a volume, with its numbers as they are written: scales; X, Y, Z; LENGTH, BOTTOM, TOP, a
// CYLINDER where these agree; radii of the centre circle and of the tube; LENGTH, RADIUS and RANGLE of a wedge, a part
// of a CYLINDER that is drawn, and touched, in three pieces.
enum class SolidShape { ellipsoid, box, frustum, torus, wedge };
struct Solid {
  SolidShape shape = SolidShape::ellipsoid;
  Triple size{1, 1, 1};
};

// A CONTACT: a ball on marker i with a plane or a ball on marker j, a disc with a curve in their x-y planes, or solids,
// of which one may be a cavity for the other.
enum class TouchKind { ball_on_plane, balls, disc_on_curve, solids };
enum class Cavity { none, i, j };
struct Touch {
  int id = 0;
  TouchKind kind = TouchKind::ball_on_plane;
  int i = 0, j = 0;
  double radius_i = 1, radius_j = 1;
  int curve = 0;
  double v = 0;  // near the parameter of the place on the curve; not written
  Solid solid_i{}, solid_j{};
  Cavity cavity = Cavity::none;
  double stiffness = 0, exponent = 1, damping = 0, full_damping = 1;  // IMPACT
  std::optional<double> restitution{};                                // or POISSON: the stiffness is its PENALTY
  bool rubs = false;
  double mu_static = 0, mu_dynamic = 0, stiction_speed = 1, sliding_speed = 2;
};

enum class BeamPlane { none, xy, yz, zx };
// FE_PART, and the MATERIAL of the same id that it is made of. Undeformed, in its BCS; numbers by node. One that stays
// in a plane has no middles.
struct Beam {
  int id = 0;
  BeamPlane plane = BeamPlane::none;
  Triple qg{}, reuler{};
  std::vector<Triple> places, angles;
  std::vector<double> area, torsion, yy, zz, yz, shear_y, shear_z;
  double damping = 0, density = 1, youngs_modulus = 1, poissons_ratio = 0;

  [[nodiscard]] std::size_t nodes() const { return places.size(); }
  [[nodiscard]] bool is_plane() const { return plane != BeamPlane::none; }
  // Its bodies: of node k, its slope, and the middle between it and the next; nodes are labelled from 1.
  [[nodiscard]] BodyRef node(std::size_t k) const { return {BodyKind::beam_node, 100 * id + static_cast<int>(k)}; }
  [[nodiscard]] BodyRef slope(std::size_t k) const { return {BodyKind::beam_slope, 100 * id + static_cast<int>(k)}; }
  [[nodiscard]] BodyRef middle(std::size_t k) const { return {BodyKind::beam_middle, 100 * id + static_cast<int>(k)}; }
};
// FE_LOAD: forces and moments by length along the axes of rm (0: global); components may read the place.
struct BeamLoad {
  int id = 0, beam = 0, rm = 0;
  std::array<std::optional<Expr>, 6> component;
};

// FLEX_BODY of three modes, whose coordinates are lengths: nodes with masses and inertias, in its frame, and how a unit
// of each coordinate shifts and turns them.
struct Flexible {
  struct Node {
    Triple place{};
    double mass = 0;
    std::array<double, 6> inertia{};  // xx yy zz xy xz yz about itself, product integrals positive
    std::array<Triple, 3> shift{}, turn{};
  };
  int id = 0;
  std::vector<Node> nodes;
  std::array<std::array<double, 3>, 3> stiffness{}, damping{};
  double ratio = 0;                            // CRATIO
  std::vector<std::array<double, 9>> loads{};  // each a column of MODLOAD

  [[nodiscard]] BodyRef frame() const { return {BodyKind::flexible_frame, id}; }
  [[nodiscard]] BodyRef modes() const { return {BodyKind::flexible_modes, id}; }
  [[nodiscard]] BodyRef node(std::size_t k) const { return {BodyKind::flexible_node, 100 * id + static_cast<int>(k)}; }
};
// MFORCE: `scale` times a load of its body; jfloat 0: without reaction.
struct ModalForce {
  int id = 0, flexible = 0, load = 0, jfloat = 0;
  Expr scale;
};

struct Variable {
  int id = 0;
  Expr function;
};
enum class DiffKind { explicit_rate, implicit_rate, algebraic };
// explicit: DIF' = function; implicit: coefficient DIF' = function; algebraic: 0 = function.
struct Diff {
  int id = 0;
  double ic = 0;
  Expr function;
  DiffKind kind = DiffKind::explicit_rate;
  Expr coefficient{};      // implicit
  bool rate_read = false;  // algebraic: somewhere DIF1 is asked for
};

enum class ArrayKind { u, x, y, ic };
struct Array {
  int id = 0;
  ArrayKind kind = ArrayKind::u;
  std::vector<int> variables;   // u
  std::vector<double> numbers;  // ic
};
struct Tfsiso {
  int id = 0, x = 0, u = 0, y = 0;
  std::vector<double> numerator, denominator;  // ascending powers
};
struct NumberMatrix {
  int id = 0, rows = 0, columns = 0;
  std::vector<double> values;  // row by row
};
struct Lse {
  int id = 0, x = 0, u = 0, y = 0, ic = 0;  // 0 = not given
  int a = 0, b = 0, c = 0, d = 0;           // MATRIX ids, 0 = not given
};
// GSE with the routines of tests/routines/generated_states.cpp, which say what the constants are.
struct Gse {
  int id = 0, x = 0, u = 0, y = 0, ic = 0;  // 0 = not given
  int states = 1, inputs = 1, outputs = 1;
  bool implicit = false;
  std::vector<double> a, b, c, d, e, g;  // matrices row by row
};
struct SplinePoints {
  int id = 0;
  std::vector<double> x, y;
  std::vector<double> z, beyond;  // a family of two curves y and `beyond` at two z, or one curve
};
struct VariableList {
  int id = 0;
  std::vector<int> variables;
};

struct Mechanism {
  std::string title = "mechanism";
  double ucf = 1;
  Triple gravity{};
  std::vector<Body> bodies;  // exactly one of them ground
  std::vector<Marker> markers;
  std::vector<Joint> joints;
  std::vector<Coupler> couplers;
  std::vector<Gear> gears;
  std::vector<Gcon> gcons;
  std::vector<Curve> curves;
  std::vector<Contact> contacts;
  std::vector<Motion> motions;
  std::vector<SpringDamper> springs;
  std::vector<Sforce> sforces;
  std::vector<LinearForce> linears;
  std::vector<Nforce> nforces;
  std::vector<Cable> cables;
  std::vector<Journal> journals;
  std::vector<GeneralForce> gforces;
  std::vector<Friction> frictions;
  std::vector<Touch> touches;
  std::vector<Beam> beams;
  std::vector<BeamLoad> beam_loads;
  std::vector<Flexible> flexibles;
  std::vector<ModalForce> mforces;
  std::vector<SplinePoints> splines;
  std::vector<Variable> variables;
  std::vector<Diff> diffs;
  std::vector<Array> arrays;
  std::vector<NumberMatrix> matrices;
  std::vector<Tfsiso> tfsisos;
  std::vector<Lse> lses;
  std::vector<Gse> gses;
  VariableList pinput, poutput, pstate;  // id 0: none
};

// The GRAPHICS of the two sides of a CONTACT.
[[nodiscard]] std::string shapes_text(const Touch& touch);
// The statements of a flexible body and of a load on it.
[[nodiscard]] std::string flexible_text(const Mechanism& mechanism, const Flexible& flexible);
[[nodiscard]] std::string modal_force_text(const ModalForce& force);
// The mechanism as a dataset, numbers with 17 digits, title first and END last.
[[nodiscard]] std::string dataset_text(const Mechanism& mechanism);

// A mechanism that is assembled as drawn and whose stated velocities satisfy its constraints. The same seed gives the
// same mechanism on one compiler; another may evaluate arguments in another order and draw differently. Draws near a
// singularity, of the constraints or of a measure, are rejected.
[[nodiscard]] Mechanism random_mechanism(std::uint64_t seed);

// What a mechanism contains, for statistics over many seeds.
struct Features {
  int moving_bodies = 0, loops = 0, massless = 0, point_masses = 0, motions = 0;
  int differential_states = 0, inputs = 0, outputs = 0;
  bool force_reads_acceleration = false, force_reads_reaction = false, force_reads_velocity = false;
  bool algebraic_loop = false, separate_im = false, units_factor = false;
  bool deep_reaction = false;  // a force reads a reaction through at least three VARVALs in a row
  int velocity_constraints = 0, algebraic_diffs = 0;
  int points_on_curves = 0, curves_on_curves = 0, planes_on_curves = 0, axes_on_curves = 0;
};
[[nodiscard]] Features features_of(const Mechanism& mechanism);

}  // namespace dynalin::oracle
