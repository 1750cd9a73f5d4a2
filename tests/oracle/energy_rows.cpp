#include "energy_rows.h"

#include <algorithm>

#include "differences.h"
#include "model.h"
#include "newton.h"

namespace dynalin::oracle {

std::vector<ForceLoad> Model::force_loads() const {
  using Taker = ForceLoad::Taker;
  std::vector<ForceLoad> all;
  static constexpr std::array<std::string_view, 3> linear = {"BUSHING", "FIELD", "BEAM"};
  static constexpr std::array<std::string_view, 3> general = {"GFORCE", "VFORCE", "VTORQUE"};
  for (const LinearForce& f : mechanism_.linears) {
    all.push_back({linear.at(static_cast<std::size_t>(f.kind)), f.id, 0, marker_index(f.i), marker_index(f.j),
                   linear_wrench(f), Taker::body_at_i, true, true});
  }
  for (std::size_t k = 0; k < mechanism_.gforces.size(); ++k) {
    const GeneralForce& f = mechanism_.gforces[k];
    const int statement = general_statement(f);
    all.push_back({general.at(static_cast<std::size_t>(statement)), f.id, 0, marker_index(f.i), marker_index(f.jfloat),
                   general_wrench(k), Taker::body_at_i, statement != 2, statement != 1});
  }
  for (const Nforce& f : mechanism_.nforces) {
    const std::vector<Wrench> wrenches = nforce_wrenches(f);
    for (std::size_t m = 0; m < f.i.size(); ++m) {
      all.push_back(
          {"NFORCE", f.id, f.i[m], marker_index(f.i[m]), marker_index(f.j), wrenches[m], Taker::body_at_i, true, true});
    }
  }
  for (const Cable& f : mechanism_.cables) {
    const std::vector<Wrench> wrenches = cable_wrenches(f);
    for (std::size_t m = 1; m < f.markers.size(); ++m) {
      all.push_back({"CABLE", f.id, f.markers[m], marker_index(f.markers[m]), marker_index(f.markers[m - 1]),
                     wrenches[m - 1], Taker::body_at_j, true, false});
    }
  }
  for (const Journal& f : mechanism_.journals) {
    all.push_back(
        {"JOURNAL", f.id, 0, marker_index(f.i), marker_index(f.j), journal_wrench(f), Taker::body_at_i, true, true});
  }
  for (std::size_t k = 0; k < mechanism_.sforces.size(); ++k) {
    const Sforce& s = mechanism_.sforces[k];
    const bool turns = s.direction == Direction::rotational;
    const Taker taker = s.reaction == Reaction::action_only ? Taker::nothing
                        : turns                             ? Taker::body_at_i
                                                            : Taker::body_at_j;
    all.push_back(
        {"SFORCE", s.id, 0, sforce_markers_[k][0], sforce_markers_[k][1], sforce_wrench(k), taker, !turns, turns});
  }
  for (std::size_t k = 0; k < mechanism_.springs.size(); ++k) {
    const bool turns = mechanism_.springs[k].direction == Direction::rotational;
    all.push_back({"SPRINGDAMPER", mechanism_.springs[k].id, 0, spring_markers_[k][0], spring_markers_[k][1],
                   spring_wrench(k), turns ? Taker::body_at_i : Taker::body_at_j, !turns, turns});
  }
  for (std::size_t k = 0; k < mechanism_.frictions.size(); ++k) {
    const auto joint = static_cast<std::size_t>(joint_index_.at(mechanism_.frictions[k].joint));
    const JointType type = mechanism_.joints[joint].type;
    const bool slides = type == JointType::translational, both = type == JointType::cylindrical;
    all.push_back({"FRICTION", mechanism_.frictions[k].id, 0, joint_markers_[joint][0], joint_markers_[joint][1],
                   friction_wrench(k), Taker::body_at_i, slides || both, !slides});
  }
  for (std::size_t k = 0; k < mechanism_.touches.size(); ++k) {
    const Touch& t = mechanism_.touches[k];
    all.push_back(
        {"CONTACT", t.id, 0, marker_index(t.i), marker_index(t.j), touch_wrench(k), Taker::body_at_i, true, true});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const ForceLoad& a, const ForceLoad& b) { return a.statement < b.statement; });
  return all;
}

namespace {

class Works {
 public:
  Works(const Mechanism& mechanism, const OraclePoint& point, Energy energy) : model_(mechanism), energy_(energy) {
    place(model_, point);
    model_.active = independent_rows(model_.gradient(), 1e-9L);
    held_ = solve_algebra(model_);
    model_.expand_delays();
    model_.held_rates = model_.diff_rates();
    nominal_ = model_.motion;
  }

  // The motion of all bodies, displacements or velocities, that the chosen states stand for.
  [[nodiscard]] std::vector<Real> motion(const std::vector<ChosenState>& states, const std::vector<Real>& x) const {
    using Kind = ChosenState::Kind;
    const bool strain = energy_ == Energy::strain;
    const auto n = static_cast<std::size_t>(model_.dofs);
    const Dense G = model_.gradient();
    Dense square(n, n);
    std::vector<Real> right(n, 0);
    std::size_t r = 0;
    for (const int k : model_.active) {
      if (strain && model_.rows[static_cast<std::size_t>(k)].of_rates) continue;
      for (std::size_t c = 0; c < n; ++c) square(r, c) = G(static_cast<std::size_t>(k), c);
      ++r;
    }
    for (std::size_t k = 0; k < states.size(); ++k) {
      const ChosenState& s = states[k];
      if (s.kind != (strain ? Kind::coordinate : Kind::rate)) continue;
      const BodyRef ref{s.body_kind, s.body_id};
      const auto b = static_cast<std::size_t>(model_.body_index(ref));
      square(r, static_cast<std::size_t>(model_.bodies[b].offset + s.coordinate)) = 1;
      right[r++] = x[k];
    }
    return Lu(square).solve(right);
  }

  // Adds −½ δf · u for a real motion u.
  void add(const std::vector<Real>& u, std::vector<EnergyRow>& rows) {
    const auto at = [&](std::size_t b, int first) {
      const auto o = static_cast<std::size_t>(model_.bodies[b].offset + first);
      return first < model_.bodies[b].dof ? Vec{u[o], u[o + 1], u[o + 2]} : Vec{};
    };
    Real size = 0;
    for (std::size_t b = 1; b < model_.bodies.size(); ++b)
      size = std::max({size, norm(at(b, 0)) / model_.length, norm(at(b, 3))});
    if (size == 0) return;
    const auto wrenches = [&](Real h) {
      move(u, h / size);
      std::vector<Real> all;
      for (const ForceLoad& load : model_.force_loads()) {
        for (const Vec& v : {load.on_i.f, load.on_i.t}) all.insert(all.end(), {v.x, v.y, v.z});
      }
      for (std::size_t b = 0; b < model_.mechanism().flexibles.size(); ++b) {
        const Vec v = model_.elastic_force(b);
        all.insert(all.end(), {v.x, v.y, v.z});
      }
      return all;
    };
    const Extrapolated slope = differentiate(wrenches, 0x1p-6L);
    // Points of the bodies move as under velocities u.
    move(u, 0);
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) model_.motion[b].v = at(b, 0), model_.motion[b].w = at(b, 3);
    model_.update_velocities();
    const std::vector<ForceLoad> loads = model_.force_loads();
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const ForceLoad& load = loads[k];
      const MarkerMotion &i = model_.markers()[static_cast<std::size_t>(load.i)],
                         &j = model_.markers()[static_cast<std::size_t>(load.j)];
      Vec moved = i.v, turned = i.w;
      Real moved_size = norm(i.v), turned_size = norm(i.w);
      if (load.taker != ForceLoad::Taker::nothing) {
        // A floating marker is on J's body, and only its body counts.
        const Vec from = load.taker == ForceLoad::Taker::body_at_j ? Vec{} : i.p - j.p;
        const Vec reaction = j.v + cross(j.w, from);
        moved = moved - reaction, turned = turned - j.w;
        moved_size += norm(reaction), turned_size += norm(j.w);
      }
      for (std::size_t c = 0; c < 6; ++c) {
        const Real along = component(c < 3 ? moved : turned, static_cast<int>(c % 3));
        rows[k].along[c] -= static_cast<double>(slope.value[6 * k + c] * size * along / 2);
        rows[k].error[c] += static_cast<double>(slope.error[6 * k + c] * size * std::fabs(along) / 2);
        rows[k].without_cancellation +=
            static_cast<double>(std::fabs(slope.value[6 * k + c]) * size * (c < 3 ? moved_size : turned_size));
      }
    }
    for (std::size_t b = 0; b < model_.mechanism().flexibles.size(); ++b) {
      const Vec moved = at(model_.modes_of(b), 0);
      EnergyRow& row = rows[loads.size() + b];
      for (std::size_t c = 0; c < 3; ++c) {
        const Real work = slope.value[6 * loads.size() + 3 * b + c] * size * component(moved, static_cast<int>(c)) / 2;
        row.along[c] -= static_cast<double>(work);
        row.error[c] += static_cast<double>(slope.error[6 * loads.size() + 3 * b + c] * size * norm(moved) / 2);
        row.without_cancellation += static_cast<double>(std::fabs(work));
      }
    }
  }

  [[nodiscard]] std::vector<EnergyRow> empty_rows() const {
    std::vector<EnergyRow> rows;
    for (const ForceLoad& load : model_.force_loads()) {
      rows.push_back({std::string(load.statement), load.id, load.marker, {}, {}, load.forces, load.torques, 0});
    }
    for (const Flexible& f : model_.mechanism().flexibles)
      rows.push_back({"FLEX_BODY", f.id, 0, {}, {}, false, false, 0});
    return rows;
  }

 private:
  // The model h u away in its poses, or with velocities that differ by so much; then what is algebraic in it.
  void move(const std::vector<Real>& u, Real h) {
    std::vector<Real> x = held_;
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
      const Model::BodyData& body = model_.bodies[b];
      const auto o = static_cast<std::size_t>(body.offset);
      const BodyMotion& n = nominal_[b];
      BodyMotion& m = model_.motion[b];
      m = n;
      const Vec shift = h * Vec{u[o], u[o + 1], u[o + 2]};
      const Vec turn = body.dof == 6 ? h * Vec{u[o + 3], u[o + 4], u[o + 5]} : Vec{};
      Vec alpha = n.al;
      if (energy_ == Energy::strain) {
        // The path turned as a whole: angular velocity and acceleration turn with it.
        const Mat E = rotation_exponential(turn);
        m.p += shift;
        m.R = E * n.R, m.w = E * n.w, alpha = E * n.al;
      } else {
        // Of a path exp(y^) R with y = 0 and rate `turn`.
        m.v += shift, m.w += turn;
        alpha += cross(turn, n.w);
      }
      if (body.dof == 6) x[o + 3] = alpha.x, x[o + 4] = alpha.y, x[o + 5] = alpha.z;
    }
    move_nodes(x);
    model_.update_positions();
    model_.update_velocities();
    const auto first = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(model_.dofs) + model_.active.size());
    std::vector<Real> w(x.begin() + first, x.end());
    const auto residual = [&](const std::vector<Real>& at) {
      std::copy(at.begin(), at.end(), x.begin() + first);
      model_.unpack_algebra(x);
      const std::vector<Real> all = model_.algebra_residual();
      return std::vector<Real>(all.begin() + first, all.end());
    };
    NewtonScales scales{{}, std::vector<Real>(w.size(), 1e-3L)};
    for (std::size_t k = 0; k < w.size(); ++k) scales.group.push_back(static_cast<int>(k));
    newton(residual, w, scales, factors_, "algebraic");
    std::copy(w.begin(), w.end(), x.begin() + first);
    model_.unpack_algebra(x);
  }

  // What is held of a flexible body are rates and accelerations of its frame and modes; its nodes follow.
  void move_nodes(std::vector<Real>& x) {
    if (model_.mechanism().flexibles.empty()) return;
    model_.unpack_algebra(x);
    model_.place_nodes();
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
      if (model_.bodies[b].ref.kind != BodyKind::flexible_node) continue;
      const auto o = static_cast<std::size_t>(model_.bodies[b].offset);
      const BodyMotion& m = model_.motion[b];
      for (int c = 0; c < 3; ++c) {
        x[o + static_cast<std::size_t>(c)] = component(m.a, c);
        x[o + 3 + static_cast<std::size_t>(c)] = component(m.al, c);
      }
    }
  }

  Model model_;
  Energy energy_;
  std::vector<Real> held_;
  std::vector<BodyMotion> nominal_;
  Lu factors_;
};

}  // namespace

std::vector<EnergyRow> energy_rows(const Mechanism& mechanism, const OraclePoint& point,
                                   const std::vector<ChosenState>& states,
                                   const std::vector<std::complex<double>>& mode, Energy energy) {
  Works works(mechanism, point, energy);
  std::vector<EnergyRow> rows = works.empty_rows();
  std::vector<Real> real, imaginary;
  for (const std::complex<double>& v : mode) real.push_back(v.real()), imaginary.push_back(v.imag());
  const std::vector<Real> in_phase = works.motion(states, real), out_of_phase = works.motion(states, imaginary);
  works.add(in_phase, rows);
  works.add(out_of_phase, rows);
  return rows;
}

}  // namespace dynalin::oracle
