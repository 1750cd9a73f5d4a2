// The operating point that a dataset describes, and a set of states for it.
#include <algorithm>
#include <stdexcept>

#include "model.h"
#include "oracle.h"

namespace dynalin::oracle {

namespace {

// Stated velocities onto the bodies, everything else at rest.
Stated place_stated_velocities(Model& model) {
  Stated stated{std::vector<bool>(model.bodies.size(), false), std::vector<bool>(model.bodies.size(), false)};
  for (const Body& body : model.mechanism().bodies) {
    if (body.ref.kind == BodyKind::ground) continue;
    const auto b = static_cast<std::size_t>(model.body_index(body.ref));
    BodyMotion& m = model.motion[b];
    m.v = m.w = Vec{};
    if (is_elastic(body.ref.kind)) {
      m.v = to_vec(body.v.value_or(Triple{})), m.w = to_vec(body.w.value_or(Triple{}));
      stated.v[b] = body.v.has_value(), stated.w[b] = body.w.has_value() || model.bodies[b].dof == 3;
      continue;
    }
    if (body.w) {
      const auto cm = static_cast<std::size_t>(model.marker_index(body.cm));
      m.w = Mat{model.markers()[cm].axis} * to_vec(*body.w);
      stated.w[b] = true;
    }
    if (body.v) {
      m.v = to_vec(*body.v);
      stated.v[b] = true;
    }
    // V is the velocity of the mass centre; an unstated one is at rest there too.
    m.v = m.v - cross(m.w, m.R * model.bodies[b].c);
    if (model.bodies[b].dof == 3) stated.w[b] = true;
  }
  model.update_velocities();
  return stated;
}

double initial_value(const Mechanism& mechanism, const DifferentialSlot& slot) {
  if (slot.element == ElementClass::diff) {
    for (const Diff& diff : mechanism.diffs) {
      if (diff.id == slot.element_id) return diff.ic;
    }
  }
  const auto by_array = [&](const auto& elements) -> double {
    for (const auto& e : elements) {
      if (e.id != slot.element_id || e.ic == 0) continue;
      for (const Array& a : mechanism.arrays) {
        if (a.id == e.ic) return a.numbers.at(static_cast<std::size_t>(slot.index - 1));
      }
    }
    return 0;
  };
  if (slot.element == ElementClass::lse) return by_array(mechanism.lses);
  if (slot.element == ElementClass::gse) return by_array(mechanism.gses);
  return 0;
}

std::array<Triple, 3> rows_of(const Mat& R) {
  const Mat T = transpose(R);
  return {to_triple(T.column[0]), to_triple(T.column[1]), to_triple(T.column[2])};
}

}  // namespace

// The least change lies in the span of the constraint rows, found by orthogonalization.
void complete_velocities(Model& model, const Stated& stated) {
  const Dense G = model.gradient();
  const auto n = static_cast<std::size_t>(model.dofs);
  std::vector<std::vector<Real>> basis;
  std::vector<Real> coefficient;
  for (std::size_t k = 0; k < model.rows.size(); ++k) {
    std::vector<Real> r(n, 0);
    for (std::size_t b = 1; b < model.bodies.size(); ++b) {
      const auto o = static_cast<std::size_t>(model.bodies[b].offset);
      const Vec f{G(k, o), G(k, o + 1), G(k, o + 2)};
      if (!stated.v[b]) r[o] = f.x, r[o + 1] = f.y, r[o + 2] = f.z;
      if (model.bodies[b].dof == 3 || stated.w[b]) continue;
      const Vec about_cm = Vec{G(k, o + 3), G(k, o + 4), G(k, o + 5)} - cross(model.motion[b].R * model.bodies[b].c, f);
      for (int c = 0; c < 3; ++c) {
        r[o + 3 + static_cast<std::size_t>(c)] = component(about_cm, c) / model.length;
      }
    }
    Real b = -model.row_velocity(model.rows[k]);
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t q = 0; q < basis.size(); ++q) {
        Real along = 0;
        for (std::size_t j = 0; j < n; ++j) along += basis[q][j] * r[j];
        for (std::size_t j = 0; j < n; ++j) r[j] -= along * basis[q][j];
        b -= along * coefficient[q];
      }
    }
    Real size = 0;
    for (const Real v : r) size += v * v;
    size = std::sqrt(size);
    if (size < 1e-9L) {
      if (std::fabs(b) > 1e-9L * model.length) {
        throw std::runtime_error("the stated velocities contradict the constraints");
      }
      continue;
    }
    for (Real& v : r) v /= size;
    basis.push_back(std::move(r));
    coefficient.push_back(b / size);
  }
  std::vector<Real> x(n, 0);
  for (std::size_t q = 0; q < basis.size(); ++q) {
    for (std::size_t j = 0; j < n; ++j) x[j] += coefficient[q] * basis[q][j];
  }
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    const auto o = static_cast<std::size_t>(model.bodies[b].offset);
    Vec turn;
    if (model.bodies[b].dof == 6) turn = (1 / model.length) * Vec{x[o + 3], x[o + 4], x[o + 5]};
    BodyMotion& m = model.motion[b];
    m.w += turn;
    m.v += Vec{x[o], x[o + 1], x[o + 2]} - cross(turn, m.R * model.bodies[b].c);
  }
}

OraclePoint drawn_point(const Mechanism& mechanism) {
  Model model(mechanism);
  const Stated stated = place_stated_velocities(model);
  complete_velocities(model, stated);
  OraclePoint point;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    const BodyRef& ref = model.bodies[b].ref;
    const BodyMotion& m = model.motion[b];
    point.bodies.push_back({ref.id, ref.kind, to_triple(m.p), rows_of(m.R), to_triple(m.v), to_triple(m.w)});
  }
  for (const DifferentialSlot& slot : model.slots) {
    point.z.push_back({slot.element, slot.element_id, slot.index, initial_value(mechanism, slot)});
  }
  return point;
}

namespace {

// The columns that the rows leave free, 1 each, of those offered where that is possible. Full pivoting: each row takes
// the column it determines best, one that was not offered before one that was.
std::vector<int> free_columns(const Model& model, const Dense& all, const std::vector<int>& offered, bool with_rates) {
  std::vector<int> kept;
  for (const int k : independent_rows(all, 1e-9L)) {
    if (with_rates || !model.rows[static_cast<std::size_t>(k)].of_rates) kept.push_back(k);
  }
  const auto n = static_cast<std::size_t>(model.dofs);
  Dense G(kept.size(), n);
  for (const Model::BodyData& body : model.bodies) {
    for (int c = 0; c < body.dof; ++c) {
      const auto j = static_cast<std::size_t>(body.offset + c);
      for (std::size_t k = 0; k < kept.size(); ++k) {
        G(k, j) = all(static_cast<std::size_t>(kept[k]), j) * (c < 3 ? model.length : 1.0L);
      }
    }
  }
  std::vector<int> free(n, 1);
  std::size_t taken = 0;
  for (const int preferred : {0, 1}) {
    while (taken < kept.size()) {
      std::size_t pi = 0, pj = n;
      Real best = preferred == 0 ? 1e-6L : 0;
      for (std::size_t i = taken; i < kept.size(); ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          if (free[j] == 0 || offered[j] != preferred || std::fabs(G(i, j)) <= best) continue;
          best = std::fabs(G(i, j));
          pi = i;
          pj = j;
        }
      }
      if (pj == n) break;
      if (pi != taken) G.swap_rows(pi, taken);
      free[pj] = 0;
      for (std::size_t i = taken + 1; i < kept.size(); ++i) {
        const Real factor = G(i, pj) / G(taken, pj);
        for (std::size_t j = 0; j < n; ++j) G(i, j) -= factor * G(taken, j);
        G(i, pj) = 0;
      }
      ++taken;
    }
  }
  return free;
}

}  // namespace

std::vector<ChosenState> choose_states(const Mechanism& mechanism, const OraclePoint& point) {
  Model model(mechanism);
  place(model, point);
  const Dense all = model.gradient();
  // Coordinates first, by the position rows; of their rates those that all rows leave free.
  const std::vector<int> offered(static_cast<std::size_t>(model.dofs), 1);
  const std::vector<int> coordinates = free_columns(model, all, offered, false);
  const std::vector<int> rates = free_columns(model, all, coordinates, true);
  std::vector<ChosenState> states;
  for (const Model::BodyData& body : model.bodies) {
    for (int c = 0; c < body.dof; ++c) {
      const auto k = static_cast<std::size_t>(body.offset + c);
      if (coordinates[k] == 0) continue;
      ChosenState s;
      s.body_id = body.ref.id;
      s.body_kind = body.ref.kind;
      s.coordinate = c;
      s.kind = ChosenState::Kind::rate;
      if (rates[k] != 0) states.push_back(s);
      s.kind = ChosenState::Kind::coordinate;
      states.push_back(s);
    }
  }
  for (const DifferentialSlot& slot : model.slots) {
    ChosenState s;
    s.kind = ChosenState::Kind::differential;
    s.element = slot.element;
    s.element_id = slot.element_id;
    s.index = slot.index;
    states.push_back(s);
  }
  return states;
}

}  // namespace dynalin::oracle
