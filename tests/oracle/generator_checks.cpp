// What makes a draw unacceptable: constraints near redundancy, coordinates near no mass, measures near a place where
// they have no derivative, motion too violent for the differences of the oracle.
#include <algorithm>
#include <stdexcept>

#include "generator.h"

namespace dynalin::oracle {

namespace {

void require(bool good) {
  if (!good) throw std::runtime_error("a measure is near a singularity");
}

// Angles away from the ends of their range and from the attitudes where they have no meaning.
void check_angle(const Model& model, const Node& n, Real value) {
  const auto& markers = model.markers();
  const auto marker = [&](std::size_t k) { return static_cast<std::size_t>(model.marker_index(n.ids[k])); };
  const MarkerMotion& i = markers[marker(0)];
  const MarkerMotion& j = markers[marker(1)];
  if (n.measure <= Measure::AZ) {
    const Vec& of_i = n.measure == Measure::AZ ? i.axis[0] : i.axis[2];
    const Real off = dot(of_i, j.axis[static_cast<std::size_t>(n.measure) - static_cast<std::size_t>(Measure::AX)]);
    require(1 - off * off > 0.1L && std::fabs(value) < 2.9L);
  } else if (n.measure <= Measure::PHI) {
    require(std::fabs(dot(i.axis[2], j.axis[2])) < 0.93L && std::fabs(value) < 2.9L);
  } else if (n.measure <= Measure::ROLL) {
    require(std::fabs(dot(i.axis[0], j.axis[2])) < 0.93L && std::fabs(value) < 2.9L);
  } else if (n.measure == Measure::INCANG) {
    require(value > 0.3L && value < 2.8L);
  }
}

}  // namespace

// Rejects the draw when a measure or a reaction stands near the place where it has no derivative.
void Draw::check_nodes(const Model& model, const Expr& e) const {
  const Node& n = *e.node;
  if (n.op != Op::sforce && n.ids.size() >= 4 && n.op != Op::measure && (n.ids[2] == 1 || n.ids[2] == 5)) {
    require(model.evaluate(e) > 0.2 * F_ * (n.ids[2] == 5 ? 0.5 * L_ : 1));
  }
  if (n.op == Op::spline) {
    // Between the points, away from the places where a derivative jumps.
    const Real x = model.evaluate(n.arguments[0]);
    require(std::fabs(x) < 3.4L && std::fabs(x - std::round(x)) < 0.4L);
  }
  if (n.op == Op::curve) {
    const auto curve =
        std::find_if(m_.curves.begin(), m_.curves.end(), [&](const Curve& c) { return c.id == n.ids[0]; });
    const auto points = std::find_if(m_.matrices.begin(), m_.matrices.end(),
                                     [&](const NumberMatrix& a) { return a.id == curve->matrix; });
    require(CurveShape(*curve, *points).clearance(model.evaluate(n.arguments[0])) > 0.04L);
  }
  if (n.op == Op::measure && n.measure >= Measure::AX) check_angle(model, n, model.evaluate(e));
  if (n.op == Op::function && n.function == Function::atan2) {
    const Real y = model.evaluate(n.arguments[0]), x = model.evaluate(n.arguments[1]);
    require(std::hypot(x, y) > 0.3L && std::fabs(std::atan2(y, x)) < 2.9L);
  }
  if (n.op == Op::function && n.function == Function::asin) {
    require(std::fabs(model.evaluate(n.arguments[0])) < 0.95L);
  }
  if (n.op == Op::measure && (n.measure == Measure::VM)) require(model.evaluate(e) > 0.5 * L_);
  if (n.op == Op::measure && (n.measure == Measure::WM)) require(model.evaluate(e) > 0.5L);
  if (n.op == Op::measure && (n.measure == Measure::ACCM)) require(model.evaluate(e) > 3 * L_);
  if (n.op == Op::measure && (n.measure == Measure::WDTM)) require(model.evaluate(e) > 3);
  for (const Expr& argument : n.arguments) check_nodes(model, argument);
}

namespace {

// How the dependent coordinates, or rates, follow the chosen ones: the admissible motions, one a chosen one.
std::vector<std::vector<Real>> admissible(const Model& model, const std::vector<ChosenState>& states,
                                          const std::vector<Real>& scale, ChosenState::Kind kind) {
  const Dense G = model.gradient();
  const auto n = static_cast<std::size_t>(model.dofs);
  std::size_t row = 0;
  Dense P(n, n);
  for (std::size_t k = 0; k < G.rows(); ++k) {
    if (kind == ChosenState::Kind::coordinate && model.rows[k].of_rates) continue;
    for (std::size_t j = 0; j < n; ++j) P(row, j) = G(k, j) * scale[j];
    ++row;
  }
  const std::size_t dependent = row;
  for (const ChosenState& s : states) {
    if (s.kind != kind) continue;
    const BodyRef ref{s.body_kind, s.body_id};
    const auto b = static_cast<std::size_t>(model.body_index(ref));
    P(row++, static_cast<std::size_t>(model.bodies[b].offset + s.coordinate)) = 1;
  }
  const Lu lu(P);
  std::vector<std::vector<Real>> N;
  for (std::size_t k = dependent; k < n; ++k) {
    std::vector<Real> unit(n, 0);
    unit[k] = 1;
    N.push_back(lu.solve(unit));
    for (const Real v : N.back()) {
      if (std::fabs(v) > 8) throw std::runtime_error("the constraints are badly conditioned");
    }
  }
  return N;
}

// And how massive the chosen ones are.
void check_conditioning(Model& model, const std::vector<ChosenState>& states) {
  const auto n = static_cast<std::size_t>(model.dofs);
  std::vector<Real> scale(n, 1);
  for (const Model::BodyData& b : model.bodies) {
    if (b.ref.kind >= BodyKind::beam_slope) continue;
    for (int c = 0; c < std::min(3, b.dof); ++c) scale[static_cast<std::size_t>(b.offset + c)] = model.length;
  }
  (void)admissible(model, states, scale, ChosenState::Kind::coordinate);
  const auto N = admissible(model, states, scale, ChosenState::Kind::rate);
  const Dense M = model.mass_matrix();
  const std::size_t f = N.size();
  Dense R(f, f);
  for (std::size_t a = 0; a < f; ++a) {
    for (std::size_t i = 0; i < n; ++i) {
      Real sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += M(i, j) * scale[j] * N[a][j];
      for (std::size_t b = 0; b < f; ++b) R(b, a) += N[b][i] * scale[i] * sum;
    }
  }
  // Pivots of the reduced mass matrix: a small one is an admissible motion that carries hardly any mass. Slopes and
  // middles of beams, of no length, carry little of it.
  const Real least = model.mechanism().beams.empty() ? 3e-3L : 1e-7L;
  Real largest = 0;
  for (std::size_t k = 0; k < f; ++k) largest = std::max(largest, R(k, k));
  for (std::size_t k = 0; k < f; ++k) {
    if (R(k, k) < least * largest) throw std::runtime_error("an admissible motion carries no mass");
    for (std::size_t i = k + 1; i < f; ++i) {
      const Real factor = R(i, k) / R(k, k);
      for (std::size_t j = k; j < f; ++j) R(i, j) -= factor * R(k, j);
    }
  }
}

}  // namespace

namespace {

// By turns that move what is far as far as a shift does.
Dense gradient_by_lengths(const Model& model) {
  Dense G = model.gradient();
  for (const Model::BodyData& b : model.bodies) {
    for (int c = 3; c < b.dof; ++c) {
      for (std::size_t k = 0; k < G.rows(); ++k) G(k, static_cast<std::size_t>(b.offset + c)) /= model.length;
    }
  }
  return G;
}

}  // namespace

void Draw::check_structure() const {
  if (mobility() < 1 || mobility() > 9) throw std::runtime_error("the mobility is out of range");
  const Features f = features_of(m_);
  if (f.loops < wanted_loops_) throw std::runtime_error("the seed wants more loops");
  if (f.motions < wanted_motions_) throw std::runtime_error("the seed wants a motion");
}

void Draw::check() const {
  Model model(m_);
  const OraclePoint point = drawn_point(m_);
  place(model, point);
  const Dense G = plane_ == BeamPlane::none ? model.gradient() : gradient_by_lengths(model);
  if (independent_rows(G, 0.02L).size() != G.rows()) throw std::runtime_error("constraints are nearly redundant");
  check_conditioning(model, choose_states(m_, point));
  for (const Row& row : model.rows) {
    const bool angle = row.type == Row::Type::angle || (row.type == Row::Type::expression && row.motion >= 0);
    if (angle && std::fabs(model.row_position(row)) > 1e-12L) {
      throw std::runtime_error("a motion does not start where the joint is");
    }
  }
  for (const BodyMotion& b : model.motion) {
    if (norm(b.w) > 8 || norm(b.v) > 6 * L_) throw std::runtime_error("a body moves too fast");
  }
  solve_algebra(model);
  for (std::size_t k = 0; k < model.motion.size(); ++k) {
    const BodyMotion& b = model.motion[k];
    // The ends of a beam weigh little; slopes and rotations of middles have no length.
    const BodyKind kind = model.bodies[k].ref.kind;
    const double limit = is_elastic(kind) ? 3000 : 150;
    if (norm(b.al) > limit || norm(b.a) > limit * (kind < BodyKind::beam_slope ? L_ : 1))
      throw std::runtime_error("a body accelerates too fast");
  }
  check_frictions(model);
  for (const Row& row : model.rows) {
    if (row.type == Row::Type::expression) check_nodes(model, row.function);
  }
  for (const Variable& v : m_.variables) check_nodes(model, v.function);
  for (const Sforce& s : m_.sforces) check_nodes(model, s.function);
  for (const Diff& d : m_.diffs) check_nodes(model, d.function);
  for (const GeneralForce& f : m_.gforces) {
    for (const auto& e : f.component) {
      if (e) check_nodes(model, *e);
    }
  }
  for (const BeamLoad& l : m_.beam_loads) {
    for (const auto& e : l.component) {
      if (e) check_nodes(model, *e);
    }
  }
  for (const ModalForce& f : m_.mforces) check_nodes(model, f.scale);
  for (const LinearForce& f : m_.linears) {
    for (const Measure a : {Measure::AX, Measure::AY, Measure::AZ}) check_nodes(model, measure(a, {f.i, f.j}));
  }
  for (const Cable& f : m_.cables) {
    if (model.cable_tension(f) < 0.05L * F_) throw std::runtime_error("a cable is slack or nearly so");
  }
  for (const Nforce& f : m_.nforces) {
    for (const int i : f.i) {
      for (const Measure a : {Measure::AX, Measure::AY, Measure::AZ}) check_nodes(model, measure(a, {i, f.j}));
    }
  }
}

}  // namespace dynalin::oracle
