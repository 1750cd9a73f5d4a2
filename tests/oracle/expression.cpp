#include "expression.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "text.h"

namespace dynalin::oracle {

namespace {

constexpr std::array function_names{"SIN",    "COS",    "TAN",  "ASIN",  "ACOS",   "ATAN",   "ATAN2", "SINH",  "COSH",
                                    "TANH",   "EXP",    "LOG",  "LOG10", "SQRT",   "**",     "ABS",   "AINT",  "ANINT",
                                    "DIM",    "MAX",    "MIN",  "MOD",   "SIGN",   "IF",     "STEP",  "STEP5", "HAVSIN",
                                    "IMPACT", "BISTOP", "POLY", "CHEBY", "FORSIN", "FORCOS", "SHF",   "SWEEP"};
constexpr std::array measure_names{"DX",   "DY",    "DZ",   "DM",     "VX",   "VY",   "VZ",   "VM",    "VR",
                                   "WX",   "WY",    "WZ",   "WM",     "ACCX", "ACCY", "ACCZ", "ACCM",  "WDTX",
                                   "WDTY", "WDTZ",  "WDTM", "AX",     "AY",   "AZ",   "PSI",  "THETA", "PHI",
                                   "YAW",  "PITCH", "ROLL", "INCANG", "UVX",  "UVY",  "UVZ"};
constexpr std::array linear_names{"BUSH", "FIELD", "BEAM"};
constexpr std::array line_names{"SD", "SV", "SA"};
constexpr std::array load_names{"FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"};
constexpr std::array unit_vectors{"[1,0,0]", "[0,1,0]", "[0,0,1]"};

Expr make(Node node) { return {std::make_shared<const Node>(std::move(node))}; }

Expr make(Op op, std::vector<Expr> arguments, std::vector<int> ids = {}) {
  Node node;
  node.op = op;
  node.arguments = std::move(arguments);
  node.ids = std::move(ids);
  return make(std::move(node));
}

std::string function_text(const Node& n) {
  const auto argument = [&](std::size_t k) { return expression_text(n.arguments[k]); };
  if (n.function == Function::raise) return "(" + argument(0) + ")**(" + argument(1) + ")";
  std::string text;
  for (std::size_t k = 0; k < n.arguments.size(); ++k) {
    text += (k == 0 ? "" : n.function == Function::choose && k == 1 ? ": " : ", ") + argument(k);
  }
  return std::string(function_names[static_cast<std::size_t>(n.function)]) + "(" + text + ")";
}

// Some as vectors: the same quantity taken apart by the parser.
std::string measure_text(const Node& n) {
  const std::string name = measure_names[static_cast<std::size_t>(n.measure)];
  if (n.measure >= Measure::UVX) {
    return "(" + name + "(" + integers({n.ids[0], n.ids[1]}) + ")*" + unit_vectors[static_cast<std::size_t>(n.ids[2])] +
           ")";
  }
  int sum = 0;
  for (const int id : n.ids) sum += id;
  const std::string list = "(" + integers(n.ids) + ")";
  if (sum % 3 == 0 && n.measure == Measure::DM) return "MAG(DXYZ" + list + ")";
  if (sum % 3 == 1 && n.measure == Measure::DM) return "(UV(DXYZ" + list + ")*DXYZ" + list + ")";
  if (sum % 3 == 0 && n.measure <= Measure::DZ) {
    return "(DXYZ" + list + "*" + unit_vectors[static_cast<std::size_t>(n.measure)] + ")";
  }
  if (sum % 3 == 0 && n.measure == Measure::WX) return "([1,0,0]*WXYZ" + list + ")";
  if (sum % 3 == 0 && n.measure == Measure::VY) return "([0,1,0]*VXYZ" + list + ")";
  if (sum % 3 == 0 && n.measure == Measure::ACCZ) return "(ACCXYZ" + list + "*[0,0,1])";
  if (sum % 3 == 0 && n.measure == Measure::WDTX) return "(WDTXYZ" + list + "*[1,0,0])";
  if (sum % 5 == 0 && n.measure == Measure::DY && n.ids.size() == 3) {
    return "(TRANS(DXYZ(" + integers({n.ids[0], n.ids[1]}) + ")," + std::to_string(n.ids[2]) + ")*[0,1,0])";
  }
  // The same angles among those of all sequences.
  if (sum % 3 == 2) {
    const auto oriented = [&](const std::string& which) { return "ORIENT(" + which + ", " + integers(n.ids) + ")"; };
    if (n.measure == Measure::PSI) return oriented("11, 1");
    if (n.measure == Measure::THETA) return oriented("11, 2");
    if (n.measure == Measure::PHI) return oriented("11, 3");
    if (n.measure == Measure::YAW) return oriented("6, 1");
    if (n.measure == Measure::PITCH) return "(-" + oriented("6, 2") + ")";
    if (n.measure == Measure::ROLL) return oriented("6, 3");
  }
  return name + list;
}

std::string spline_text(const Node& n) {
  const std::string x = expression_text(n.arguments[0]), id = std::to_string(n.ids[0]);
  const std::string order = n.ids[2] != 0 ? ", " + std::to_string(n.ids[2]) : "";
  if (n.ids[1] >= static_cast<int>(Interpolation::by_interp)) {
    const bool linear = n.ids[1] == static_cast<int>(Interpolation::linear);
    return "INTERP(" + x + (linear ? ", 1, " : ", 3, ") + id + order + ")";
  }
  const std::string z = n.arguments.size() > 1 ? expression_text(n.arguments[1]) : "0";
  const bool akima = n.ids[1] == static_cast<int>(Interpolation::akima);
  return (akima ? "AKISPL(" : "CUBSPL(") + x + ", " + z + ", " + id + order + ")";
}

}  // namespace

Expr constant(double value) {
  Node node;
  node.value = value;
  return make(std::move(node));
}
Expr time_now() { return make(Op::time, {}); }
Expr place_along_beam() { return make(Op::place, {}); }
Expr line_motion(int derivative, int component) { return make(Op::line_motion, {}, {derivative, component}); }
Expr operator+(const Expr& a, const Expr& b) { return make(Op::add, {a, b}); }
Expr operator-(const Expr& a, const Expr& b) { return make(Op::subtract, {a, b}); }
Expr operator*(const Expr& a, const Expr& b) { return make(Op::multiply, {a, b}); }
Expr operator/(const Expr& a, const Expr& b) { return make(Op::divide, {a, b}); }
Expr operator*(double a, const Expr& b) { return constant(a) * b; }
Expr square(const Expr& a) { return make(Op::power, {a}); }
Expr varval(int id) { return make(Op::varval, {}, {id}); }
Expr input_value(int index) { return make(Op::input_value, {}, {1, index}); }
Expr output_value(int index) { return make(Op::output_value, {}, {1, index}); }
Expr aryval(int array, int index) { return make(Op::aryval, {}, {array, index}); }
Expr dif(int id) { return make(Op::dif, {}, {id}); }
Expr dif1(int id) { return make(Op::dif1, {}, {id}); }
Expr joint_reaction(int id, int jflag, int component, int rm) {
  return make(Op::joint, {}, {id, jflag, component, rm});
}
Expr primitive_reaction(int id, int jflag, int component, int rm) {
  return make(Op::joint, {}, {id, jflag, component, rm, 1});
}
Expr motion_reaction(int id, int jflag, int component, int rm) {
  return make(Op::motion, {}, {id, jflag, component, rm});
}
Expr sforce_load(int id, int jflag, int component, int rm) { return make(Op::sforce, {}, {id, jflag, component, rm}); }
Expr touch_load(int id, int jflag, int component, int rm) { return make(Op::touch, {}, {id, jflag, component, rm}); }
Expr friction_load(int id, int jflag, int component, int rm) {
  return make(Op::friction, {}, {id, jflag, component, rm});
}
Expr spring_load(int id, int jflag, int component, int rm) { return make(Op::spring, {}, {id, jflag, component, rm}); }
Expr linear_load(LinearKind kind, int id, int jflag, int component, int rm) {
  return make(Op::linear, {}, {id, jflag, component, rm, static_cast<int>(kind)});
}
Expr gforce_load(int statement, int id, int jflag, int component, int rm) {
  return make(Op::gforce, {}, {id, jflag, component, rm, statement});
}
Expr marker_load(int component, int i, int j, int axes) { return make(Op::marker_force, {}, {i, j, component, axes}); }
Expr spline_at(const Expr& x, int id, Interpolation method, int derivative) {
  return make(Op::spline, {x}, {id, static_cast<int>(method), derivative});
}
Expr surface_at(const Expr& x, const Expr& z, int id, Interpolation method) {
  return make(Op::spline, {x, z}, {id, static_cast<int>(method), 0});
}
Expr signal_of(const Expr& x, int id, double low, double high, int count, int seed) {
  return make(Op::spectrum, {x, constant(low), constant(high)}, {id, count, seed});
}
Expr senval(int id) { return make(Op::senval, {}, {id}); }
Expr delayed(const Expr& e, const Expr& lag, double start, double rate) {
  return make(Op::delay, {e, lag, constant(start), constant(rate)});
}
Expr curve_at(const Expr& u, int derivative, int component, int id) {
  return make(Op::curve, {u}, {id, derivative, component});
}
Expr contact_reaction(bool two_curves, int id, int jflag, int component, int rm) {
  return make(Op::contact, {}, {id, jflag, component, rm, two_curves ? 1 : 0});
}
Expr contact_gap(int contact, int row) { return make(Op::gap, {}, {contact, row}); }
Expr call(Function function, std::vector<Expr> arguments) {
  Node node;
  node.op = Op::function;
  node.function = function;
  node.arguments = std::move(arguments);
  return make(std::move(node));
}
Expr measure(Measure kind, std::vector<int> markers) {
  Node node;
  node.op = Op::measure;
  node.measure = kind;
  node.ids = std::move(markers);
  return make(std::move(node));
}
Expr axis_component(Measure axis, int i, int of, int along) { return measure(axis, {i, of, along}); }

std::string expression_text(const Expr& expression) {
  const Node& n = *expression.node;
  const auto argument = [&](std::size_t k) { return expression_text(n.arguments[k]); };
  const auto infix = [&](const char* op) { return "(" + argument(0) + op + argument(1) + ")"; };
  const auto with_ids = [&](const std::string& name, std::size_t count) {
    return name + "(" + integers({n.ids.begin(), n.ids.begin() + static_cast<std::ptrdiff_t>(count)}) + ")";
  };
  switch (n.op) {
    case Op::constant:
      return n.value < 0 ? "(" + number(n.value) + ")" : number(n.value);
    case Op::time:
      return "TIME";
    case Op::place:
      return "S";
    case Op::line_motion:
      return line_names[static_cast<std::size_t>(n.ids[0])] + ("(" + std::to_string(n.ids[1] + 1)) + ")";
    case Op::add:
      return infix(" + ");
    case Op::subtract:
      return infix(" - ");
    case Op::multiply:
      return infix("*");
    case Op::divide:
      return infix("/");
    case Op::power:
      return "(" + argument(0) + ")**2";
    case Op::function:
      return function_text(n);
    case Op::measure:
      return measure_text(n);
    case Op::varval:
      return with_ids("VARVAL", 1);
    case Op::input_value:
      return with_ids("PINVAL", 2);
    case Op::output_value:
      return with_ids("POUVAL", 2);
    case Op::aryval:
      return with_ids("ARYVAL", 2);
    case Op::dif:
      return with_ids("DIF", 1);
    case Op::dif1:
      return with_ids("DIF1", 1);
    case Op::joint:
      return with_ids(n.ids.size() > 4 ? "JPRIM" : "JOINT", 4);
    case Op::motion:
      return with_ids("MOTION", 4);
    case Op::sforce:
      return with_ids("SFORCE", 4);
    case Op::friction:
      return with_ids("FRICTION", 4);
    case Op::touch:
      return with_ids("CONTACT", 4);
    case Op::spring:
      return with_ids("SPDP", 4);
    case Op::linear:
      return with_ids(linear_names[static_cast<std::size_t>(n.ids[4])], 4);
    case Op::gforce:
      return with_ids(n.ids[4] == 2 ? "VTORQ" : n.ids[4] == 1 ? "VFORCE" : "GFORCE", 4);
    case Op::marker_force: {
      const std::string name = load_names[static_cast<std::size_t>(n.ids[2] - 1)];
      if (n.ids[2] == 1 || n.ids[2] == 5) return with_ids(name, 2);
      const std::string list = "(" + integers({n.ids[0], n.ids[1], n.ids[3]}) + ")";
      if (n.ids[3] % 2 == 0) return name + list;
      const int along = (n.ids[2] - 2) % 4;
      return std::string(n.ids[2] < 5 ? "(FXYZ" : "(TXYZ") + list + "*" +
             unit_vectors[static_cast<std::size_t>(along)] + ")";
    }
    case Op::spline:
      return spline_text(n);
    case Op::spectrum:
      return "INVPSD(" + argument(0) + ", " + std::to_string(n.ids[0]) + ", " + argument(1) + ", " + argument(2) +
             ", " + integers({n.ids[1], 0, n.ids[2]}) + ")";
    case Op::delay:
      return "DELAY(" + argument(0) + ", " + argument(1) + ", " + argument(2) + " + " + argument(3) + "*TIME)";
    case Op::senval:
      return with_ids("SENVAL", 1);
    case Op::curve:
      return "CURVE(" + argument(0) + ", " + integers({n.ids[1], n.ids[2], n.ids[0]}) + ")";
    case Op::contact:
      return with_ids(n.ids[4] != 0 ? "CVCV" : "PTCV", 4);
    case Op::gap:
      throw std::logic_error("the language has no gaps of contacts");
  }
  return {};
}

}  // namespace dynalin::oracle
