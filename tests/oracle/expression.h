// Function expressions as trees: built with the functions below, printed by expression_text for the product to read,
// evaluated by evaluation.h. Formulas: the function expressions of the dataset language.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace dynalin::oracle {

struct Node;

struct Expr {
  std::shared_ptr<const Node> node;
};

enum class Op {
  constant,
  time,
  place,        // S, along a beam
  line_motion,  // SD, SV, SA there: derivative by time, component from 0 to 5
  add,
  subtract,
  multiply,
  divide,
  power,  // the square
  function,
  measure,
  varval,
  input_value,   // PINVAL
  output_value,  // POUVAL
  aryval,
  dif,
  dif1,
  joint,  // JOINT and JPRIM
  motion,
  sforce,
  friction,
  touch,
  spring,  // SPDP
  linear,  // BUSH, FIELD, BEAM
  gforce,
  marker_force,  // FX ... TM
  spline,        // AKISPL, CUBSPL, INTERP
  spectrum,      // INVPSD
  senval,
  delay,
  curve,    // CURVE
  contact,  // PTCV, CVCV
  gap       // of a contact, not of the language: what its rows hold at zero
};

enum class Function {
  // clang-format off
  sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, log10, sqrt, raise,
  abs, aint, anint, dim, maximum, minimum, mod, sign, choose,
  step, step5, havsin, impact, bistop, poly, cheby, forsin, forcos, shf, sweep
  // clang-format on
};
enum class Measure {
  // clang-format off
  DX, DY, DZ, DM,
  VX, VY, VZ, VM, VR,
  WX, WY, WZ, WM,
  ACCX, ACCY, ACCZ, ACCM,
  WDTX, WDTY, WDTZ, WDTM,
  AX, AY, AZ,
  PSI, THETA, PHI, YAW, PITCH, ROLL, INCANG,
  UVX, UVY, UVZ  // ids: marker, axes, component 0..2
  // clang-format on
};

enum class LinearKind { bushing, field, beam };
enum class Interpolation { cubic, akima, by_interp, linear };  // the last two by INTERP

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
[[nodiscard]] Expr place_along_beam();
// Of the beam there: its position or a derivative of it by time, along a global axis 0..2.
[[nodiscard]] Expr line_motion(int derivative, int component);
[[nodiscard]] Expr operator+(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator-(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator*(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator/(const Expr& a, const Expr& b);
[[nodiscard]] Expr operator*(double a, const Expr& b);
[[nodiscard]] Expr square(const Expr& a);
[[nodiscard]] Expr call(Function function, std::vector<Expr> arguments);
[[nodiscard]] Expr measure(Measure measure, std::vector<int> markers);
// Component `along` (0..2) in the axes of `of` of an axis of marker i.
[[nodiscard]] Expr axis_component(Measure axis, int i, int of, int along);
[[nodiscard]] Expr varval(int id);
[[nodiscard]] Expr input_value(int index);   // PINVAL(1, index)
[[nodiscard]] Expr output_value(int index);  // POUVAL(1, index)
[[nodiscard]] Expr aryval(int array, int index);
[[nodiscard]] Expr dif(int id);
[[nodiscard]] Expr dif1(int id);
[[nodiscard]] Expr joint_reaction(int id, int jflag, int component, int rm);
[[nodiscard]] Expr primitive_reaction(int id, int jflag, int component, int rm);
[[nodiscard]] Expr motion_reaction(int id, int jflag, int component, int rm);
[[nodiscard]] Expr sforce_load(int id, int jflag, int component, int rm);
[[nodiscard]] Expr friction_load(int id, int jflag, int component, int rm);
[[nodiscard]] Expr touch_load(int id, int jflag, int component, int rm);
[[nodiscard]] Expr spring_load(int id, int jflag, int component, int rm);
[[nodiscard]] Expr linear_load(LinearKind kind, int id, int jflag, int component, int rm);
// Component 1..8 of the net force or torque on marker i, of what acts between i and j, or of everything with j = 0.
[[nodiscard]] Expr marker_load(int component, int i, int j, int axes);
// Derivative: 0, or 1 for the slope.
[[nodiscard]] Expr spline_at(const Expr& x, int id, Interpolation method, int derivative = 0);
[[nodiscard]] Expr surface_at(const Expr& x, const Expr& z, int id, Interpolation method);
// Of a density between the first and last point of a SPLINE, straight lines between them.
[[nodiscard]] Expr signal_of(const Expr& x, int id, double low, double high, int count, int seed);
[[nodiscard]] Expr senval(int id);
// What e was `lag` ago; at a time before the start that is start + rate time.
[[nodiscard]] Expr delayed(const Expr& e, const Expr& lag, double start, double rate);
// Component 1..3 of a derivative of the curve.
[[nodiscard]] Expr curve_at(const Expr& u, int derivative, int component, int id);
[[nodiscard]] Expr contact_reaction(bool two_curves, int id, int jflag, int component, int rm);
// Row 0 or 1 of a contact, by its place in the mechanism.
[[nodiscard]] Expr contact_gap(int contact, int row);
// `statement`: 0 GFORCE, 1 VFORCE, 2 VTORQUE, as general_statement says.
[[nodiscard]] Expr gforce_load(int statement, int id, int jflag, int component, int rm);

[[nodiscard]] std::string expression_text(const Expr& expression);

// Calls `visit` on every node below and including the expression's own.
template <class Visit>
void walk(const Expr& e, Visit&& visit) {
  visit(*e.node);
  for (const Expr& argument : e.node->arguments) walk(argument, visit);
}

}  // namespace dynalin::oracle
