// A plain description of a spatial mechanism: what a dataset says, before anybody has interpreted it. The
// oracle evaluates it, dataset_text writes it for the product to read; both start from the same doubles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dynalin::oracle {

using Triple = std::array<double, 3>;

// ---------------------------------------------------------------------------------- expressions
struct Node;

// A function expression as a tree; built with the functions below, printed by expression_text.
struct Expr {
  std::shared_ptr<const Node> node;
};

enum class Op {
  constant,
  time,
  add,
  subtract,
  multiply,
  divide,
  power,
  function,
  measure,
  varval,
  aryval,
  dif,
  joint,  // JOINT and JPRIM
  sforce,
  linear,  // BUSH, FIELD, BEAM
  gforce,
  spline  // AKISPL, CUBSPL of one argument
};
enum class Function { sin, cos, tanh, exp, sqrt, atan, atan2, step };
enum class Measure {
  DX,
  DY,
  DZ,
  DM,
  VX,
  VY,
  VZ,
  VM,
  VR,
  WX,
  WY,
  WZ,
  WM,
  ACCX,
  ACCY,
  ACCZ,
  ACCM,
  WDTX,
  WDTY,
  WDTZ,
  WDTM,
  AX,
  AY,
  AZ
};

enum class LinearKind { bushing, field, beam };

struct Node {
  Op op = Op::constant;
  double value = 0;  // constant
  Function function = Function::sin;
  Measure measure = Measure::DX;
  std::vector<int> ids;  // marker ids of a measure; id, jflag, comp, rm; id, index
  std::vector<Expr> arguments;
};

[[nodiscard]] Expr constant(double value);
[[nodiscard]] Expr time_now();
[[nodiscard]] Expr operator+(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator-(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator*(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator/(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator*(double a, const Expr& b);
[[nodiscard]] Expr square(const Expr& a);
[[nodiscard]] Expr call(Function function, std::vector<Expr> arguments);
[[nodiscard]] Expr measure(Measure measure, std::vector<int> markers);
[[nodiscard]] Expr varval(int id);
[[nodiscard]] Expr aryval(int array, int index);
[[nodiscard]] Expr dif(int id);
[[nodiscard]] Expr joint_reaction(int id, int jflag, int component, int rm);
[[nodiscard]] Expr primitive_reaction(int id, int jflag, int component, int rm);
[[nodiscard]] Expr sforce_load(int id, int jflag, int component, int rm);
[[nodiscard]] Expr linear_load(LinearKind kind, int id, int jflag, int component, int rm);
[[nodiscard]] Expr spline_at(const Expr& x, int id, bool akima);
// `statement`: 0 GFORCE, 1 VFORCE, 2 VTORQUE, as general_statement says.
[[nodiscard]] Expr gforce_load(int statement, int id, int jflag, int component, int rm);
[[nodiscard]] std::string expression_text(const Expr& expression);

// --------------------------------------------------------------------------------- the mechanism
enum class BodyKind { ground, part, point_mass };

struct BodyRef {
  BodyKind kind = BodyKind::part;
  int id = 0;
  friend bool operator==(const BodyRef&, const BodyRef&) = default;
};

struct Body {
  BodyRef ref;
  double mass = 0;
  std::array<double, 6> ip{};  // xx yy zz xy xz yz, product integrals positive
  int cm = 0, im = 0;          // marker ids, 0 = not given
  Triple qg{}, reuler{};
  std::optional<Triple> v;  // of the CM marker, global axes
  std::optional<Triple> w;  // in the axes of the CM marker
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
};

// c0 + c1 t + c2 t^2 + c3 t^3 + amplitude sin(frequency t + phase)
struct TimeFunction {
  std::array<double, 4> c{};
  double amplitude = 0, frequency = 0, phase = 0;
};
// Of a joint: R or T; of its pair of markers: X, Y or Z.
struct Motion {
  int id = 0, joint = 0;
  TimeFunction f;
  char freedom = 'R';
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

// F = force - K (y - length) - C y' in the axes of J.
struct LinearForce {
  int id = 0;
  LinearKind kind = LinearKind::bushing;
  int i = 0, j = 0;
  std::array<std::array<double, 6>, 6> k{}, c{};  // bushing, field: by rows; beam: c by CRATIO
  std::array<double, 6> length{}, force{};
  std::array<double, 9> beam{};  // LENGTH AREA IXX IYY IZZ E G ASY ASZ
  double ratio = 0;              // CRATIO of a beam
};
// Six components on I in the axes of RM; a component without expression is zero.
struct GeneralForce {
  int id = 0, i = 0, jfloat = 0, rm = 0;
  std::array<std::optional<Expr>, 6> component;
};

// Which statement it is written as: 1, without torques, is a VFORCE, 2, without forces, a VTORQUE, 0 a GFORCE.
[[nodiscard]] int general_statement(const GeneralForce& force);

struct Variable {
  int id = 0;
  Expr function;
};
struct Diff {
  int id = 0;
  double ic = 0;
  Expr function;  // explicit: DIF' = function; implicit: coefficient DIF' = function
  std::optional<Expr> coefficient = std::nullopt;
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
struct SplinePoints {
  int id = 0;
  std::vector<double> x, y;
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
  std::vector<Motion> motions;
  std::vector<SpringDamper> springs;
  std::vector<Sforce> sforces;
  std::vector<LinearForce> linears;
  std::vector<GeneralForce> gforces;
  std::vector<SplinePoints> splines;
  std::vector<Variable> variables;
  std::vector<Diff> diffs;
  std::vector<Array> arrays;
  std::vector<NumberMatrix> matrices;
  std::vector<Tfsiso> tfsisos;
  std::vector<Lse> lses;
  VariableList pinput, poutput;  // id 0: none
};

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
};
[[nodiscard]] Features features_of(const Mechanism& mechanism);

}  // namespace dynalin::oracle
