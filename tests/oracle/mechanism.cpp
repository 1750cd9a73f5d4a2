#include "mechanism.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace dynalin::oracle {

namespace {

Expr make(Node node) { return {std::make_shared<const Node>(std::move(node))}; }

Expr make(Op op, std::vector<Expr> arguments, std::vector<int> ids = {}) {
  Node node;
  node.op = op;
  node.arguments = std::move(arguments);
  node.ids = std::move(ids);
  return make(std::move(node));
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

template <class List>
std::string numbers(const List& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : ", ") + number(v);
  return text;
}

std::string integers(const std::vector<int>& values) {
  std::string text;
  for (const int v : values) text += (text.empty() ? "" : ",") + std::to_string(v);
  return text;
}

constexpr const char* function_names[] = {"SIN", "COS", "TANH", "EXP", "SQRT", "ATAN", "ATAN2", "STEP"};
constexpr const char* measure_names[] = {"DX",   "DY",   "DZ",   "DM",   "VX",   "VY",   "VZ",   "VM",
                                         "VR",   "WX",   "WY",   "WZ",   "WM",   "ACCX", "ACCY", "ACCZ",
                                         "ACCM", "WDTX", "WDTY", "WDTZ", "WDTM", "AX",   "AY",   "AZ"};
constexpr const char* joint_names[] = {"REVOLUTE",    "TRANSLATIONAL", "SPHERICAL",   "UNIVERSAL",     "FIXED",
                                       "CYLINDRICAL", "PLANAR",        "HOOKE",       "CONVEL",        "ATPOINT",
                                       "INLINE",      "INPLANE",       "ORIENTATION", "PARALLEL_AXES", "PERPENDICULAR"};
constexpr const char* linear_names[] = {"BUSH", "FIELD", "BEAM"};

// One statement: keyword and id on the first line, one argument a line after it.
class Statement {
 public:
  Statement(const std::string& keyword, int id) : text_(keyword + "/" + std::to_string(id) + "\n") {}
  Statement& word(const std::string& w) {
    text_ += ", " + w + "\n";
    return *this;
  }
  Statement& set(const std::string& name, const std::string& value) { return word(name + " = " + value); }
  Statement& set(const std::string& name, int id) { return id == 0 ? *this : set(name, std::to_string(id)); }
  Statement& set(const std::string& name, double value) { return set(name, number(value)); }
  Statement& set(const std::string& name, const Triple& value) { return set(name, numbers(value)); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string owner_keyword(BodyKind kind) { return kind == BodyKind::point_mass ? "POINT_MASS" : "PART"; }

std::string body_text(const Body& body) {
  Statement s(owner_keyword(body.ref.kind), body.ref.id);
  if (body.ref.kind == BodyKind::ground) return s.word("GROUND").text();
  const bool part = body.ref.kind == BodyKind::part;
  if (body.mass != 0) s.set("MASS", body.mass);
  s.set("CM", body.cm).set("IM", body.im);
  const bool has_inertia = std::any_of(body.ip.begin(), body.ip.end(), [](double v) { return v != 0; });
  if (part && has_inertia) s.set("IP", numbers(body.ip));
  s.set("QG", body.qg).set("REULER", body.reuler);
  const char* v_names[] = {"VX", "VY", "VZ"};
  const char* w_names[] = {"WX", "WY", "WZ"};
  for (std::size_t k = 0; k < 3 && body.v; ++k) s.set(v_names[k], (*body.v)[k]);
  for (std::size_t k = 0; k < 3 && body.w; ++k) s.set(w_names[k], (*body.w)[k]);
  return s.text();
}

std::string time_function_text(const TimeFunction& f) {
  const auto n = [](double v) { return expression_text(constant(v)); };
  std::string text = n(f.c[0]) + " + " + n(f.c[1]) + "*TIME + " + n(f.c[2]) + "*TIME**2 + " + n(f.c[3]) + "*TIME**3";
  if (f.amplitude != 0) {
    text += " + " + n(f.amplitude) + "*SIN(" + n(f.frequency) + "*TIME + " + n(f.phase) + ")";
  }
  return text;
}

std::string spring_text(const SpringDamper& s) {
  const bool line = s.direction == Direction::translational;
  Statement t("SPRINGDAMPER", s.id);
  t.word(line ? "TRANSLATIONAL" : "ROTATIONAL").set("I", s.i).set("J", s.j);
  t.set(line ? "K" : "KT", s.k).set(line ? "C" : "CT", s.c);
  t.set(line ? "FORCE" : "TORQUE", s.preload).set(line ? "LENGTH" : "ANGLE", s.free);
  return t.text();
}

std::string sforce_text(const Sforce& s) {
  Statement t("SFORCE", s.id);
  t.word(s.direction == Direction::translational ? "TRANSLATIONAL" : "ROTATIONAL");
  if (s.reaction == Reaction::action_only) t.word("ACTIONONLY");
  return t.set("I", s.i).set("J", s.j).set("FUNCTION", expression_text(s.function)).text();
}

std::string linear_text(const LinearForce& f) {
  constexpr const char* keywords[] = {"BUSHING", "FIELD", "BEAM"};
  Statement t(keywords[static_cast<int>(f.kind)], f.id);
  t.set("I", f.i).set("J", f.j);
  if (f.kind == LinearKind::beam) {
    constexpr const char* names[] = {"LENGTH", "AREA", "IXX", "IYY", "IZZ", "EMODULUS", "GMODULUS", "ASY", "ASZ"};
    for (std::size_t k = 0; k < 9; ++k) t.set(names[k], f.beam[k]);
    return t.set("CRATIO", f.ratio).text();
  }
  if (f.kind == LinearKind::bushing) {
    const auto diagonal = [](const auto& m, std::size_t first) {
      return numbers(std::array<double, 3>{m[first][first], m[first + 1][first + 1], m[first + 2][first + 2]});
    };
    t.set("K", diagonal(f.k, 0)).set("KT", diagonal(f.k, 3)).set("C", diagonal(f.c, 0)).set("CT", diagonal(f.c, 3));
    t.set("FORCE", numbers(std::array<double, 3>{f.force[0], f.force[1], f.force[2]}));
    return t.set("TORQUE", numbers(std::array<double, 3>{f.force[3], f.force[4], f.force[5]})).text();
  }
  const auto by_columns = [](const auto& m) {
    std::vector<double> v;
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = 0; r < 6; ++r) v.push_back(m[r][c]);
    }
    return numbers(v);
  };
  t.set("KMATRIX", by_columns(f.k)).set("CMATRIX", by_columns(f.c));
  return t.set("LENGTH", numbers(f.length)).set("FORCE", numbers(f.force)).text();
}

constexpr const char* general_keywords[] = {"GFORCE", "VFORCE", "VTORQUE"};

std::string gforce_text(const GeneralForce& f) {
  constexpr const char* names[] = {"FX", "FY", "FZ", "TX", "TY", "TZ"};
  std::string text = Statement(general_keywords[general_statement(f)], f.id)
                         .set("I", f.i)
                         .set("JFLOAT", f.jfloat)
                         .set("RM", f.rm)
                         .text();
  std::string components;
  for (std::size_t k = 0; k < 6; ++k) {
    if (!f.component[k]) continue;
    components +=
        (components.empty() ? ", " : "\\\n, ") + std::string(names[k]) + " = " + expression_text(*f.component[k]);
  }
  return text + components + "\n";
}

std::string array_text(const Array& a) {
  Statement t("ARRAY", a.id);
  switch (a.kind) {
    case ArrayKind::u:
      return t.word("U").set("VARIABLES", integers(a.variables)).text();
    case ArrayKind::x:
      return t.word("X").text();
    case ArrayKind::y:
      return t.word("Y").text();
    case ArrayKind::ic:
      return t.word("IC").set("NUMBERS", numbers(a.numbers)).text();
  }
  return {};
}

std::string controls_text(const Mechanism& m) {
  std::string text;
  for (const Variable& v : m.variables) {
    text += Statement("VARIABLE", v.id).set("FUNCTION", expression_text(v.function)).text();
  }
  for (const Diff& d : m.diffs) {
    Statement t("DIFF", d.id);
    t.set("IC", d.ic);
    if (d.coefficient) {
      const std::string rate = "DIF1(" + std::to_string(d.id) + ")";
      t.word("IMPLICIT")
          .set("FUNCTION", expression_text(*d.coefficient) + "*" + rate + " - (" + expression_text(d.function) + ")");
    } else {
      t.set("FUNCTION", expression_text(d.function));
    }
    text += t.text();
  }
  for (const Array& a : m.arrays) text += array_text(a);
  for (const SplinePoints& p : m.splines) {
    text += Statement("SPLINE", p.id).set("X", numbers(p.x)).set("Y", numbers(p.y)).text();
  }
  for (const NumberMatrix& a : m.matrices) {
    text += Statement("MATRIX", a.id)
                .set("FULL", std::string("RORDER"))
                .set("ROWS", a.rows)
                .set("COLUMNS", a.columns)
                .set("VALUES", numbers(a.values))
                .text();
  }
  for (const Tfsiso& t : m.tfsisos) {
    text += Statement("TFSISO", t.id)
                .set("X", t.x)
                .set("U", t.u)
                .set("Y", t.y)
                .set("NUMERATOR", numbers(t.numerator))
                .set("DENOMINATOR", numbers(t.denominator))
                .text();
  }
  for (const Lse& e : m.lses) {
    text += Statement("LSE", e.id)
                .set("X", e.x)
                .set("U", e.u)
                .set("Y", e.y)
                .set("IC", e.ic)
                .set("A", e.a)
                .set("B", e.b)
                .set("C", e.c)
                .set("D", e.d)
                .text();
  }
  if (m.pinput.id != 0) text += Statement("PINPUT", m.pinput.id).set("VARIABLES", integers(m.pinput.variables)).text();
  if (m.poutput.id != 0)
    text += Statement("POUTPUT", m.poutput.id).set("VARIABLES", integers(m.poutput.variables)).text();
  return text;
}

// Calls `visit` on every node below and including the expression's own.
template <class Visit>
void walk(const Expr& e, Visit&& visit) {
  visit(*e.node);
  for (const Expr& argument : e.node->arguments) walk(argument, visit);
}

const Variable* find_variable(const Mechanism& m, int id) {
  const auto found =
      std::find_if(m.variables.begin(), m.variables.end(), [id](const Variable& v) { return v.id == id; });
  return found == m.variables.end() ? nullptr : &*found;
}

// Walks an expression and, through VARVAL, the variables it refers to; every variable once.
template <class Visit>
void walk_through(const Mechanism& m, const Expr& e, std::vector<int>& seen, Visit&& visit) {
  walk(e, [&](const Node& n) {
    visit(n);
    if (n.op != Op::varval || std::find(seen.begin(), seen.end(), n.ids[0]) != seen.end()) return;
    seen.push_back(n.ids[0]);
    if (const Variable* v = find_variable(m, n.ids[0])) walk_through(m, v->function, seen, visit);
  });
}

void note_force_features(const Mechanism& m, Features& f) {
  for (const Sforce& s : m.sforces) {
    std::vector<int> seen;
    walk_through(m, s.function, seen, [&](const Node& n) {
      if (n.op == Op::joint) f.force_reads_reaction = true;
      if (n.op != Op::measure) return;
      const bool acceleration = n.measure >= Measure::ACCX && n.measure <= Measure::WDTM;
      const bool velocity = n.measure >= Measure::VX && n.measure <= Measure::WM;
      f.force_reads_acceleration = f.force_reads_acceleration || acceleration;
      f.force_reads_velocity = f.force_reads_velocity || velocity;
    });
  }
}

}  // namespace

Expr constant(double value) {
  Node node;
  node.value = value;
  return make(std::move(node));
}
Expr time_now() { return make(Op::time, {}); }
Expr operator+(const Expr& a, const Expr& b) { return make(Op::add, {a, b}); }
Expr operator-(const Expr& a, const Expr& b) { return make(Op::subtract, {a, b}); }
Expr operator*(const Expr& a, const Expr& b) { return make(Op::multiply, {a, b}); }
Expr operator/(const Expr& a, const Expr& b) { return make(Op::divide, {a, b}); }
Expr operator*(double a, const Expr& b) { return constant(a) * b; }
Expr square(const Expr& a) { return make(Op::power, {a}); }
Expr varval(int id) { return make(Op::varval, {}, {id}); }
Expr aryval(int array, int index) { return make(Op::aryval, {}, {array, index}); }
Expr dif(int id) { return make(Op::dif, {}, {id}); }
Expr joint_reaction(int id, int jflag, int component, int rm) {
  return make(Op::joint, {}, {id, jflag, component, rm});
}
Expr primitive_reaction(int id, int jflag, int component, int rm) {
  return make(Op::joint, {}, {id, jflag, component, rm, 1});
}
Expr linear_load(LinearKind kind, int id, int jflag, int component, int rm) {
  return make(Op::linear, {}, {id, jflag, component, rm, static_cast<int>(kind)});
}
Expr gforce_load(int statement, int id, int jflag, int component, int rm) {
  return make(Op::gforce, {}, {id, jflag, component, rm, statement});
}
Expr spline_at(const Expr& x, int id, bool akima) { return make(Op::spline, {x}, {id, akima ? 1 : 0}); }
int general_statement(const GeneralForce& force) {
  const auto any = [&](std::size_t first) {
    return force.component[first] || force.component[first + 1] || force.component[first + 2];
  };
  return any(0) && any(3) ? 0 : any(0) ? 1 : 2;
}
Expr sforce_load(int id, int jflag, int component, int rm) { return make(Op::sforce, {}, {id, jflag, component, rm}); }
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

std::string expression_text(const Expr& expression) {
  const Node& n = *expression.node;
  const auto argument = [&](std::size_t k) { return expression_text(n.arguments[k]); };
  const auto infix = [&](const char* op) { return "(" + argument(0) + op + argument(1) + ")"; };
  switch (n.op) {
    case Op::constant:
      return n.value < 0 ? "(" + number(n.value) + ")" : number(n.value);
    case Op::time:
      return "TIME";
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
    case Op::function: {
      std::string text;
      for (const Expr& a : n.arguments) text += (text.empty() ? "" : ", ") + expression_text(a);
      return std::string(function_names[static_cast<int>(n.function)]) + "(" + text + ")";
    }
    case Op::measure: {
      // Some as vectors: the same quantity taken apart by the parser.
      int sum = 0;
      for (const int id : n.ids) sum += id;
      const std::string list = "(" + integers(n.ids) + ")";
      const std::string name = measure_names[static_cast<int>(n.measure)];
      if (sum % 3 == 0 && n.measure == Measure::DM) return "MAG(DXYZ" + list + ")";
      if (sum % 3 == 0 && n.measure <= Measure::DZ) {
        const char* units[] = {"[1,0,0]", "[0,1,0]", "[0,0,1]"};
        return "(DXYZ" + list + "*" + units[static_cast<int>(n.measure)] + ")";
      }
      if (sum % 3 == 0 && n.measure == Measure::WX) return "([1,0,0]*WXYZ" + list + ")";
      if (sum % 5 == 0 && n.measure == Measure::DY && n.ids.size() == 3) {
        return "(TRANS(DXYZ(" + integers({n.ids[0], n.ids[1]}) + ")," + std::to_string(n.ids[2]) + ")*[0,1,0])";
      }
      return name + list;
    }
    case Op::varval:
      return "VARVAL(" + integers(n.ids) + ")";
    case Op::aryval:
      return "ARYVAL(" + integers(n.ids) + ")";
    case Op::dif:
      return "DIF(" + integers(n.ids) + ")";
    case Op::joint:
      return (n.ids.size() > 4 ? "JPRIM(" : "JOINT(") + integers({n.ids.begin(), n.ids.begin() + 4}) + ")";
    case Op::linear:
      return std::string(linear_names[n.ids[4]]) + "(" + integers({n.ids.begin(), n.ids.begin() + 4}) + ")";
    case Op::gforce:
      return std::string(n.ids[4] == 2 ? "VTORQ" : general_keywords[n.ids[4]]) + "(" +
             integers({n.ids.begin(), n.ids.begin() + 4}) + ")";
    case Op::spline:
      return std::string(n.ids[1] ? "AKISPL(" : "CUBSPL(") + argument(0) + ", 0, " + std::to_string(n.ids[0]) + ")";
    case Op::sforce:
      return "SFORCE(" + integers(n.ids) + ")";
  }
  return {};
}

std::string dataset_text(const Mechanism& m) {
  std::string text = m.title + "\n";
  text += m.ucf == 1      ? "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND\n"
          : m.ucf == 1000 ? "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
                          : "UNITS/UCF=" + number(m.ucf) + "\n";
  text += "ACCGRAV/IGRAV=" + number(m.gravity[0]) + ", JGRAV=" + number(m.gravity[1]) +
          ", KGRAV=" + number(m.gravity[2]) + "\n";
  for (const Body& body : m.bodies) text += body_text(body);
  for (const Marker& k : m.markers) {
    if (k.floating) {
      text +=
          Statement("MARKER", k.id).set(owner_keyword(k.body.kind), std::to_string(k.body.id)).word("FLOATING").text();
      continue;
    }
    text += Statement("MARKER", k.id)
                .set(owner_keyword(k.body.kind), std::to_string(k.body.id))
                .set("QP", k.qp)
                .set("REULER", k.reuler)
                .text();
  }
  for (const Joint& j : m.joints) {
    if (is_gcon(j.type)) {
      // z of I along z of J: by the origin, or by the direction cosine of the axis.
      const std::string pair = std::to_string(j.i) + "," + std::to_string(j.j);
      const bool plane = j.type == JointType::gcon_plane;
      text += Statement("GCON", j.id)
                  .set("FUNCTION", plane ? "DZ(" + pair + "," + std::to_string(j.j) + ")" : "UVZ(" + pair + ")*[0,0,1]")
                  .text();
      continue;
    }
    text += Statement(is_primitive(j.type) ? "JPRIM" : "JOINT", j.id)
                .word(joint_names[static_cast<int>(j.type)])
                .set("I", j.i)
                .set("J", j.j)
                .text();
  }
  for (const Motion& k : m.motions) {
    const auto joint = std::find_if(m.joints.begin(), m.joints.end(), [&](const Joint& j) { return j.id == k.joint; });
    Statement t("MOTION", k.id);
    if (k.freedom == 'R' || k.freedom == 'T') {
      t.word(k.freedom == 'R' ? "ROTATION" : "TRANSLATION").set("JOINT", k.joint);
    } else {
      t.word(std::string(1, k.freedom)).set("I", joint->i).set("J", joint->j);
    }
    text += t.set("FUNCTION", time_function_text(k.f)).text();
  }
  for (const SpringDamper& s : m.springs) text += spring_text(s);
  for (const Sforce& s : m.sforces) text += sforce_text(s);
  for (const LinearForce& f : m.linears) text += linear_text(f);
  for (const GeneralForce& f : m.gforces) text += gforce_text(f);
  return text + controls_text(m) + "END\n";
}

Features features_of(const Mechanism& m) {
  Features f;
  for (const Body& body : m.bodies) {
    if (body.ref.kind == BodyKind::ground) continue;
    ++f.moving_bodies;
    f.massless += body.mass == 0 ? 1 : 0;
    f.point_masses += body.ref.kind == BodyKind::point_mass ? 1 : 0;
    f.separate_im = f.separate_im || body.im != 0;
  }
  // Independent loops: joints beyond a spanning forest of the bodies they connect.
  std::vector<std::pair<BodyRef, BodyRef>> leader;
  for (const Body& body : m.bodies) leader.push_back({body.ref, body.ref});
  const auto root = [&](int marker) -> BodyRef {
    const auto k = std::find_if(m.markers.begin(), m.markers.end(), [&](const Marker& a) { return a.id == marker; });
    return std::find_if(leader.begin(), leader.end(), [&](const auto& l) { return l.first == k->body; })->second;
  };
  for (const Joint& j : m.joints) {
    const BodyRef a = root(j.i), b = root(j.j);
    f.loops += a == b ? 1 : 0;
    for (auto& l : leader) l.second = l.second == a ? b : l.second;
  }
  f.motions = static_cast<int>(m.motions.size());
  f.differential_states = static_cast<int>(m.diffs.size());
  for (const Tfsiso& t : m.tfsisos) f.differential_states += static_cast<int>(t.denominator.size()) - 1;
  for (const Lse& e : m.lses) {
    for (const NumberMatrix& a : m.matrices) f.differential_states += a.id == e.a ? a.rows : 0;
  }
  f.inputs = static_cast<int>(m.pinput.variables.size());
  f.outputs = static_cast<int>(m.poutput.variables.size());
  f.units_factor = m.ucf != 1;
  note_force_features(m, f);
  for (const Variable& v : m.variables) {
    std::vector<int> seen;
    walk_through(m, v.function, seen, [](const Node&) {});
    f.algebraic_loop = f.algebraic_loop || std::find(seen.begin(), seen.end(), v.id) != seen.end();
  }
  return f;
}

}  // namespace dynalin::oracle
