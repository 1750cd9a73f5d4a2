// A mechanism as a dataset.
#include <algorithm>
#include <array>
#include <cmath>

#include "mechanism.h"
#include "model.h"
#include "text.h"

namespace dynalin::oracle {

namespace {

constexpr const char* joint_names[] = {"REVOLUTE",      "TRANSLATIONAL", "SPHERICAL", "UNIVERSAL", "FIXED",
                                       "CYLINDRICAL",   "PLANAR",        "HOOKE",     "CONVEL",    "SCREW",
                                       "RACKPIN",       "ATPOINT",       "INLINE",    "INPLANE",   "ORIENTATION",
                                       "PARALLEL_AXES", "PERPENDICULAR"};

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
  if (is_elastic(body.ref.kind)) return {};  // of an FE_PART or FLEX_BODY
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

std::string beam_text(const Beam& b) {
  Statement material("MATERIAL", b.id);
  material.set("DENSITY", b.density).set("YOUNGS_MODULUS", b.youngs_modulus).set("POISSONS_RATIO", b.poissons_ratio);
  Statement s("FE_PART", b.id);
  std::string labels;
  for (std::size_t k = 1; k <= b.nodes(); ++k) labels += (k > 1 ? "," : "") + std::to_string(k);
  constexpr const char* types[] = {"3DBEAM", "2DBEAMXY", "2DBEAMYZ", "2DBEAMZX"};
  s.set("TYPE", types[static_cast<int>(b.plane)])
      .set("MATERIAL", b.id)
      .set("NODE_LABELS", labels)
      .set("QG", b.qg)
      .set("REULER", b.reuler);
  const auto by_node = [&](const std::array<const char*, 3>& names, const std::vector<Triple>& list) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Triple& t : list) values.push_back(t[axis]);
      s.set(names[axis], numbers(values));
    }
  };
  by_node({"X", "Y", "Z"}, b.places);
  by_node({"PSI", "THETA", "PHI"}, b.angles);
  s.set("AREA", numbers(b.area)).set("IXX", numbers(b.torsion)).set("IYY", numbers(b.yy)).set("IZZ", numbers(b.zz));
  s.set("IYZ", numbers(b.yz)).set("ASY", numbers(b.shear_y)).set("ASZ", numbers(b.shear_z));
  return material.text() + s.set("CRATIO", b.damping).text();
}

std::string beam_load_text(const BeamLoad& l) {
  Statement s("FE_LOAD", l.id);
  s.set("FE_PART", l.beam).set("RM", l.rm);
  static constexpr std::array<const char*, 6> names = {"FX", "FY", "FZ", "TX", "TY", "TZ"};
  std::string components;
  for (std::size_t c = 0; c < 6; ++c) {
    if (l.component[c])
      components +=
          (components.empty() ? "" : "\\\n, ") + std::string(names[c]) + " = " + expression_text(*l.component[c]);
  }
  return s.word(components).text();
}

// The derivative of order `level`.
std::string time_function_text(const TimeFunction& f, int level) {
  const auto n = [](double v) { return expression_text(constant(v)); };
  std::array<double, 4> c = f.c;
  for (int k = 0; k < level; ++k) c = {c[1], 2 * c[2], 3 * c[3], 0};
  std::string text = n(c[0]) + " + " + n(c[1]) + "*TIME + " + n(c[2]) + "*TIME**2 + " + n(c[3]) + "*TIME**3";
  if (f.amplitude == 0) return text;
  const double amplitude = f.amplitude * (level == 0 ? 1 : level == 1 ? f.frequency : -f.frequency * f.frequency);
  return text + " + " + n(amplitude) + (level == 1 ? "*COS(" : "*SIN(") + n(f.frequency) + "*TIME + " + n(f.phase) +
         ")";
}

std::string joint_text(const Joint& j) {
  if (is_gcon(j.type)) {
    // z of I along z of J: by the origin, or by the direction cosine of the axis.
    const std::string pair = integers({j.i, j.j});
    const bool plane = j.type == JointType::gcon_plane;
    return Statement("GCON", j.id)
        .set("FUNCTION", plane ? "DZ(" + pair + "," + std::to_string(j.j) + ")" : "UVZ(" + pair + ")*[0,0,1]")
        .text();
  }
  Statement t(is_primitive(j.type) ? "JPRIM" : "JOINT", j.id);
  t.word(joint_names[static_cast<int>(j.type)]).set("I", j.i).set("J", j.j);
  if (j.type == JointType::screw) t.set("PITCH", j.size);
  if (j.type == JointType::rackpin) t.set("PD", j.size);
  return t.text();
}

std::string coupler_text(const Coupler& c) {
  std::string freedoms;
  for (const char f : c.freedoms) freedoms += (freedoms.empty() ? "" : ":") + std::string(1, f);
  // A leading 1 may be left out.
  std::vector<double> scales = c.scales;
  if (scales[0] == 1) scales.erase(scales.begin());
  return Statement("COUPLER", c.id)
      .set("JOINTS", integers(c.joints))
      .set("SCALES", numbers(scales))
      .set("TYPE", freedoms)
      .text();
}

std::string curve_text(const Curve& c) {
  Statement t("CURVE", c.id);
  t.word(c.closed ? "CLOSED" : "OPEN").set("MATRIX", c.matrix);
  if (c.controls) t.word("CONTROL_POINTS");
  if (c.order != 4) t.set("ORDER", c.order);
  return t.text();
}

std::string contact_text(const Contact& c) {
  Statement t(c.two_curves ? "CVCV" : c.plane ? "PLCV" : c.axis ? "AXCV" : "PTCV", c.id);
  const auto start = [&](const std::string& prefix, const auto& at, int axes, const auto& speed) {
    if (at) t.set(prefix + "DISP", *at).set(prefix + "ICM", axes);
    if (speed) t.set(prefix + "VEL", *speed);
  };
  if (!c.two_curves) {
    t.set("I", c.i);
    if (c.plane) t.set("IFLOAT", c.ifloat);
    t.set("JFLOAT", c.jfloat).set("CURVE", c.jcurve).set("RM", c.j);
    start("", c.at_j, c.axes_j, c.speed_j);
    return t.text();
  }
  t.set("IFLOAT", c.ifloat).set("ICURVE", c.icurve).set("IRM", c.i);
  t.set("JFLOAT", c.jfloat).set("JCURVE", c.jcurve).set("JRM", c.j);
  start("I", c.at_i, c.axes_i, c.speed_i);
  start("J", c.at_j, c.axes_j, c.speed_j);
  return t.text();
}

std::string motion_text(const Mechanism& m, const Motion& k) {
  const auto joint = std::find_if(m.joints.begin(), m.joints.end(), [&](const Joint& j) { return j.id == k.joint; });
  Statement t("MOTION", k.id);
  if (k.freedom == 'R' || k.freedom == 'T') {
    t.word(k.freedom == 'R' ? "ROTATION" : "TRANSLATION").set("JOINT", k.joint);
  } else {
    const std::string name(1, k.freedom);
    t.word(k.freedom <= '3' ? "B" + name : name).set("I", joint->i).set("J", joint->j);
  }
  if (k.level > 0) t.word(k.level == 1 ? "VELOCITY" : "ACCELERATION");
  if (k.level == 2) t.set("ICVEL", k.f.c[1] + k.f.amplitude * k.f.frequency * std::cos(k.f.phase));
  t.set("FUNCTION", time_function_text(k.f, k.level));
  return t.text();
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

std::string friction_text(const Mechanism& m, const Friction& f) {
  const JointType type =
      std::find_if(m.joints.begin(), m.joints.end(), [&](const Joint& j) { return j.id == f.joint; })->type;
  const bool slides = type == JointType::translational, both = type == JointType::cylindrical;
  const bool crosses = type == JointType::hooke || type == JointType::universal, ball = type == JointType::spherical;
  Statement t("FRICTION", f.id);
  t.set("JOINT", f.joint).set("MU_STATIC", f.mu_static).set("MU_DYNAMIC", f.mu_dynamic);
  t.set("STICTION_TRANSITION_VELOCITY", f.velocity).set("TRANSITION_VELOCITY_COEFFICIENT", f.ratio);
  t.set("MAX_STICTION_DEFORMATION", f.deformation);
  if (!slides && !ball) t.set("PIN_RADIUS", f.pin);
  if (!slides && !ball && !both) t.set("FRICTION_ARM", f.arm).set("BENDING_REACTION_ARM", f.bending);
  if (ball) t.set("BALL_RADIUS", f.ball);
  if (slides) t.set("REACTION_ARM", f.reaction);
  if (slides || both) {
    t.set("INITIAL_OVERLAP", f.overlap).set("FRICTION_FORCE_PRELOAD", f.force_preload);
    t.set("OVERLAP_DELTA", std::string(f.delta == 0 ? "CONSTANT" : f.delta > 0 ? "INCREASE" : "DECREASE"));
  }
  if (!slides) t.set("FRICTION_TORQUE_PRELOAD", f.torque_preload);
  if (f.lugre) {
    t.set("FORMULATION", std::string("LUGRE")).set("BRISTLE_STIFFNESS_COEFFICIENT", f.bristles);
    t.set("DAMPING_COEFFICIENT", f.bristle_damping).set("VISCOUS_FRICTION_COEFFICIENT", f.viscosity);
  }
  if (f.effect != 0) t.set("EFFECT", std::string(f.effect == 1 ? "STICTION" : "SLIDING"));
  if (f.inputs != 15) {
    constexpr const char* names[] = {"REACTION_FORCE", "BENDING_MOMENT", "TORSIONAL_MOMENT", "PRELOAD"};
    std::string words;
    for (int k = 0; k < 4; ++k) {
      if ((f.inputs >> k & 1) != 0) words += (words.empty() ? "" : ":") + std::string(names[k]);
    }
    t.set("INPUTS", words.empty() ? "NONE" : words);
  }
  if (crosses && f.on_j) t.word("J_YOKE");
  return t.text();
}

std::string touch_text(const Touch& c) {
  const int on_i = 2 * c.id - 1, on_j = 2 * c.id;
  Statement t("CONTACT", c.id);
  t.set("IGEOM", on_i).set("JGEOM", on_j);
  if (c.cavity == Cavity::i) t.set("IFLIP_GEOMETRY", on_i);
  if (c.cavity == Cavity::j) t.set("JFLIP_GEOMETRY", on_j);
  if (c.restitution) {
    t.word("POISSON").set("PENALTY", c.stiffness).set("RESTITUTION_COEFFICIENT", *c.restitution);
  } else {
    t.word("IMPACT").set("STIFFNESS", c.stiffness).set("EXPONENT", c.exponent);
    t.set("DAMPING", c.damping).set("DMAX", c.full_damping);
  }
  if (c.rubs) {
    t.set("COULOMB_FRICTION", std::string("ON")).set("MU_STATIC", c.mu_static).set("MU_DYNAMIC", c.mu_dynamic);
    t.set("STICTION_TRANSITION_VELOCITY", c.stiction_speed).set("FRICTION_TRANSITION_VELOCITY", c.sliding_speed);
  }
  return shapes_text(c) + t.text();
}

std::string linear_text(const LinearForce& f) {
  constexpr const char* keywords[] = {"BUSHING", "FIELD", "BEAM"};
  Statement t(keywords[static_cast<int>(f.kind)], f.id);
  t.set("I", f.i).set("J", f.j);
  if (f.kind == LinearKind::beam) {
    constexpr const char* names[] = {"LENGTH", "AREA", "IXX", "IYY", "IZZ", "EMODULUS", "GMODULUS", "ASY", "ASZ"};
    for (std::size_t k = 0; k < 9; ++k) t.set(names[k], f.beam[k]);
    if (f.ratio != 0) return t.set("CRATIO", f.ratio).text();
    std::vector<double> lower;
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = c; r < 6; ++r) lower.push_back(f.c[r][c]);
    }
    return t.set("CMATRIX", numbers(lower)).text();
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
  t.set("KMATRIX", by_columns(f.k));
  f.ratio != 0 ? t.set("CRATIO", f.ratio) : t.set("CMATRIX", by_columns(f.c));
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

std::string nforce_text(const Nforce& f) {
  Statement t("NFORCE", f.id);
  t.set("IMARKERS", integers(f.i)).set("J", f.j).set("KMATRIX", f.k).set("CMATRIX", f.c);
  if (f.ratio != 0) t.set("CRATIO", f.ratio);
  return t.set("LENGTH", f.length).set("FORCE", f.force).text();
}

std::string journal_text(const Journal& f) {
  return Statement("JOURNAL", f.id)
      .set("I", f.i)
      .set("J", f.j)
      .set("RADIUS", f.radius)
      .set("LENGTH", f.length)
      .set("CLEARANCE", f.clearance)
      .set("VISCOSITY", f.viscosity)
      .set("SPEED", f.speed)
      .text();
}

std::string cable_text(const Cable& f) {
  Statement t("CABLE", f.id);
  return t.set("MARKERS", integers(f.markers))
      .set("K", f.k)
      .set("C", f.c)
      .set("LENGTH", f.length)
      .set("FORCE", f.force)
      .text();
}

std::string diff_text(const Diff& d) {
  Statement t("DIFF", d.id);
  t.set("IC", d.ic);
  const std::string function = expression_text(d.function);
  switch (d.kind) {
    case DiffKind::explicit_rate:
      t.set("FUNCTION", function);
      break;
    case DiffKind::implicit_rate:
      t.word("IMPLICIT").set("FUNCTION", expression_text(d.coefficient * dif1(d.id)) + " - (" + function + ")");
      break;
    case DiffKind::algebraic:
      t.word("IMPLICIT").set("FUNCTION", function);
      break;
  }
  return t.text();
}

std::string spline_text(const SplinePoints& p) {
  Statement t("SPLINE", p.id);
  t.set("X", numbers(p.x));
  if (p.beyond.empty()) return t.set("Y", numbers(p.y)).text();
  return t.set("Y", number(p.z[0]) + ", " + numbers(p.y)).set("Y", number(p.z[1]) + ", " + numbers(p.beyond)).text();
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

std::string gse_text(const Gse& e) {
  Statement t("GSE", e.id);
  t.set("NS", e.states).set("X", e.x).set("U", e.u).set("NO", e.outputs).set("Y", e.y).set("IC", e.ic);
  std::vector<double> constants = {static_cast<double>(e.states), static_cast<double>(e.inputs),
                                   static_cast<double>(e.outputs)};
  for (const auto* part : {&e.a, &e.b, &e.c, &e.d, &e.e, &e.g})
    constants.insert(constants.end(), part->begin(), part->end());
  if (e.implicit) t.word("IMPLICIT").set("INTERFACE", std::string("::balance_deriv"));
  return t.set("FUNCTION", "USER(" + numbers(constants) + ")").text();
}

std::string controls_text(const Mechanism& m) {
  std::string text;
  for (const Variable& v : m.variables) {
    text += Statement("VARIABLE", v.id).set("FUNCTION", expression_text(v.function)).text();
  }
  for (const Diff& d : m.diffs) text += diff_text(d);
  for (const Array& a : m.arrays) text += array_text(a);
  for (const SplinePoints& p : m.splines) text += spline_text(p);
  text += Statement("STRING", 1).set("STRING", std::string("of compiled routines")).text();
  text += Statement("REQUEST", 1).set("F2", std::string("1")).text();
  text += Statement("MREQUEST", 1).set("PARTS", std::string("ALL")).text();
  text += Statement("SENSOR", 1).set("FUNCTION", std::string("1")).set("EVALUATE", std::string("2")).text();
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
  for (const Gse& e : m.gses) text += gse_text(e);
  if (m.pinput.id != 0) text += Statement("PINPUT", m.pinput.id).set("VARIABLES", integers(m.pinput.variables)).text();
  if (m.pstate.id != 0) text += Statement("PSTATE", m.pstate.id).set("VARIABLES", integers(m.pstate.variables)).text();
  if (m.poutput.id != 0)
    text += Statement("POUTPUT", m.poutput.id).set("VARIABLES", integers(m.poutput.variables)).text();
  return text;
}

}  // namespace

int general_statement(const GeneralForce& force) {
  const auto any = [&](std::size_t first) {
    return force.component[first] || force.component[first + 1] || force.component[first + 2];
  };
  return any(0) && any(3) ? 0 : any(0) ? 1 : 2;
}

int equations_of(JointType type) {
  constexpr std::array equations{5, 5, 3, 4, 6, 4, 3, 4, 4, 1, 1, 3, 2, 1, 3, 2, 1, 1, 1};
  return equations[static_cast<std::size_t>(type)];
}

std::string dataset_text(const Mechanism& m) {
  std::string text = m.title + "\n";
  text += m.ucf == 1      ? "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND\n"
          : m.ucf == 1000 ? "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
                          : "UNITS/UCF=" + number(m.ucf) + "\n";
  text += "ACCGRAV/IGRAV=" + number(m.gravity[0]) + ", JGRAV=" + number(m.gravity[1]) +
          ", KGRAV=" + number(m.gravity[2]) + "\n";
  for (const Body& body : m.bodies) text += body_text(body);
  for (const Beam& b : m.beams) text += beam_text(b);
  for (const Flexible& f : m.flexibles) text += flexible_text(m, f);
  for (const Marker& k : m.markers) {
    Statement s("MARKER", k.id);
    if (k.body.kind == BodyKind::beam_node) {
      s.set("FE_PART", k.body.id / 100).set("NODE_LABEL", k.body.id % 100 + 1);
    } else if (k.body.kind == BodyKind::flexible_frame) {
      s.set("FLEX_BODY", k.body.id);
    } else if (of_flexible(k.body.kind)) {
      s.set("FLEX_BODY", k.body.id / 100).set("NODE_ID", k.body.id % 100 + 1);
    } else {
      s.set(owner_keyword(k.body.kind), std::to_string(k.body.id));
    }
    if (!k.floating && k.body.kind == BodyKind::beam_node) {
      // In the BCS, undeformed.
      const Beam& b =
          *std::find_if(m.beams.begin(), m.beams.end(), [&](const Beam& x) { return x.id == k.body.id / 100; });
      const auto number = static_cast<std::size_t>(k.body.id % 100);
      const Mat node = rotation_313(b.angles[number]);
      s.set("QP", to_triple(to_vec(b.places[number]) + node * to_vec(k.qp)))
          .set("REULER", angles_313(node * rotation_313(k.reuler)));
    } else if (!k.floating) {
      s.set("QP", k.qp).set("REULER", k.reuler);
    }
    text += (k.floating ? s.word("FLOATING") : s).text();
  }
  for (const Joint& j : m.joints) text += joint_text(j);
  for (const Coupler& c : m.couplers) text += coupler_text(c);
  for (const Gear& g : m.gears) {
    text += Statement("GEAR", g.id).set("JOINTS", integers({g.joints[0], g.joints[1]})).set("CV", g.cv).text();
  }
  for (const Gcon& g : m.gcons) text += Statement("GCON", g.id).set("FUNCTION", expression_text(g.function)).text();
  for (const Curve& c : m.curves) text += curve_text(c);
  for (const Contact& c : m.contacts) text += contact_text(c);
  for (const Motion& k : m.motions) text += motion_text(m, k);
  for (const SpringDamper& s : m.springs) text += spring_text(s);
  for (const Sforce& s : m.sforces) text += sforce_text(s);
  for (const Friction& f : m.frictions) text += friction_text(m, f);
  for (const Touch& t : m.touches) text += touch_text(t);
  for (const LinearForce& f : m.linears) text += linear_text(f);
  for (const Nforce& f : m.nforces) text += nforce_text(f);
  for (const Cable& f : m.cables) text += cable_text(f);
  for (const Journal& f : m.journals) text += journal_text(f);
  for (const GeneralForce& f : m.gforces) text += gforce_text(f);
  for (const BeamLoad& l : m.beam_loads) text += beam_load_text(l);
  for (const ModalForce& f : m.mforces) text += modal_force_text(f);
  return text + controls_text(m) + "END\n";
}

}  // namespace dynalin::oracle
