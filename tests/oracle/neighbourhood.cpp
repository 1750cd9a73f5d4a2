#include "neighbourhood.h"

#include <algorithm>
#include <stdexcept>

namespace dynalin::oracle {

namespace {

Mat orthonormal(const std::array<Triple, 3>& rows) {
  Mat R = transpose(Mat{{to_vec(rows[0]), to_vec(rows[1]), to_vec(rows[2])}});
  // Newton's iteration for the nearest rotation: the given numbers are orthonormal to double accuracy.
  for (int k = 0; k < 4; ++k) R = 0.5L * (R * (3.0L * Mat{} + -1.0L * (transpose(R) * R)));
  return R;
}

NewtonScales algebra_scales(const Model& model) {
  const std::vector<int> groups = model.algebra_groups();
  return {groups, std::vector<Real>(groups.size(), 1e-3L)};
}

}  // namespace

void place(Model& model, const OraclePoint& point) {
  model.time = point.time;
  std::size_t placed = 0;
  for (const BodyPoint& given : point.bodies) {
    const int b = model.body_index({given.body_kind, given.body_id});
    BodyMotion& m = model.motion[static_cast<std::size_t>(b)];
    m = {to_vec(given.position),
         orthonormal(given.rotation),
         to_vec(given.velocity),
         turns(given.body_kind) ? to_vec(given.angular_velocity) : Vec{},
         Vec{},
         Vec{}};
    ++placed;
  }
  model.place_nodes();
  placed = 0;
  for (const Model::BodyData& body : model.bodies) {
    const bool given = std::any_of(point.bodies.begin(), point.bodies.end(), [&](const BodyPoint& p) {
      return BodyRef{p.body_kind, p.body_id} == body.ref;
    });
    placed += given || body.ref.kind == BodyKind::flexible_node ? 1 : 0;
  }
  if (placed + 1 != model.bodies.size()) throw std::runtime_error("the point lacks a body");
  for (std::size_t k = 0; k < model.slots.size(); ++k) {
    const auto found = std::find_if(point.z.begin(), point.z.end(), [&](const DifferentialPoint& d) {
      const DifferentialSlot& s = model.slots[k];
      return d.element == s.element && d.element_id == s.element_id && d.index == s.index;
    });
    if (found == point.z.end()) throw std::runtime_error("the point lacks a differential state");
    model.z[k] = found->value;
  }
  model.update_positions();
  model.update_velocities();
}

std::vector<Real> solve_algebra(Model& model) {
  std::vector<Real> x(model.algebra_size(), 0);
  Lu factors;
  const auto residual = [&](const std::vector<Real>& at) {
    model.unpack_algebra(at);
    return model.algebra_residual();
  };
  const NewtonScales scales = algebra_scales(model);
  // Away from the solution factors go stale quickly: full Newton steps, until the factors of one serve for the next.
  for (int k = 0; k < 4; ++k) {
    factors = Lu(difference_jacobian(residual, x, group_scales(scales, x)));
    const std::vector<Real> dx = factors.solve(residual(x));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= dx[i];
    const std::vector<Real> next = factors.solve(residual(x)), scale = group_scales(scales, x);
    Real size = 0;
    for (std::size_t i = 0; i < x.size(); ++i) size = std::max(size, std::fabs(next[i]) / scale[i]);
    if (size < 1e-2L) break;
  }
  newton(residual, x, scales, factors, "acceleration");
  model.unpack_algebra(x);
  return x;
}

void Neighbourhood::read_states() {
  using Kind = ChosenState::Kind;
  std::size_t differential = 0;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const ChosenState& s = states_[k];
    Column column;
    if (s.kind == Kind::differential) {
      const auto found = std::find_if(model_.slots.begin(), model_.slots.end(), [&](const DifferentialSlot& slot) {
        return slot.element == s.element && slot.element_id == s.element_id && slot.index == s.index;
      });
      if (found == model_.slots.end()) throw std::runtime_error("no such differential state");
      column.slot = static_cast<std::size_t>(found - model_.slots.begin());
      ++differential;
    } else if (s.variable != 0) {
      const auto v = static_cast<std::size_t>(model_.variable_index(s.variable));
      column.function = model_.mechanism().variables[v].function;
      column.nominal = model_.evaluate_along(column.function);
      (s.kind == Kind::coordinate ? chosen_ : chosen_rates_).push_back(k);
    } else {
      const auto b = static_cast<std::size_t>(model_.body_index({s.body_kind, s.body_id}));
      if (s.coordinate < 0 || s.coordinate >= model_.bodies[b].dof) {
        throw std::runtime_error("no such coordinate");
      }
      column.dof = static_cast<std::size_t>(model_.bodies[b].offset + s.coordinate);
      (s.kind == Kind::coordinate ? chosen_ : chosen_rates_).push_back(k);
    }
    columns_.push_back(column);
  }
  if (differential != model_.slots.size()) {
    throw std::runtime_error("every differential state must be a state");
  }
  for (const int id : model_.mechanism().pinput.variables) {
    inputs_.push_back(static_cast<std::size_t>(model_.variable_index(id)));
  }
}

Real Neighbourhood::change(std::size_t state, const std::vector<Real>& y, int level) const {
  const Column& column = columns_[state];
  if (!column.function.node) return y[column.dof];
  const Jet there = model_.evaluate_along(column.function);
  return level == 0   ? there.v - column.nominal.v
         : level == 1 ? there.d - column.nominal.d
                      : there.dd - column.nominal.dd;
}

void Neighbourhood::pose(const std::vector<Real>& y) {
  for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
    const Model::BodyData& body = model_.bodies[b];
    const Real* at = y.data() + body.offset;
    model_.motion[b].p = nominal_[b].p + Vec{at[0], at[1], at[2]};
    if (body.dof == 3) continue;
    model_.motion[b].R = rotation_exponential({at[3], at[4], at[5]}) * nominal_[b].R;
  }
  model_.update_positions();
}

void Neighbourhood::move(const std::vector<Real>& y, const std::vector<Real>& ydot) {
  for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
    const Model::BodyData& body = model_.bodies[b];
    const Real* at = y.data() + body.offset;
    const Real* rate = ydot.data() + body.offset;
    model_.motion[b].v = nominal_[b].v + Vec{rate[0], rate[1], rate[2]};
    if (body.dof == 3) continue;
    const Vec turn{at[3], at[4], at[5]};
    model_.motion[b].w =
        left_jacobian(turn) * Vec{rate[3], rate[4], rate[5]} + rotation_exponential(turn) * nominal_[b].w;
  }
  model_.update_velocities();
}

std::vector<Real> Neighbourhood::solve_positions(const std::vector<Real>& x) {
  std::vector<Real> y(unknowns(), 0);
  const auto residual = [&](const std::vector<Real>& at) {
    pose(at);
    std::vector<Real> r;
    for (const int k : position_rows_) {
      r.push_back(model_.row_position(model_.rows[static_cast<std::size_t>(k)]));
    }
    for (const std::size_t k : chosen_) r.push_back(change(k, at, 0) - x[k]);
    return r;
  };
  newton(residual, y, scales_, position_factors_, "position");
  pose(y);
  check_dropped_rows();
  return y;
}

std::vector<Real> Neighbourhood::solve_velocities(const std::vector<Real>& x, const std::vector<Real>& y) {
  std::vector<Real> ydot(unknowns(), 0);
  const auto residual = [&](const std::vector<Real>& at) {
    move(y, at);
    std::vector<Real> r;
    for (const int k : model_.active) {
      r.push_back(model_.row_velocity(model_.rows[static_cast<std::size_t>(k)]));
    }
    for (const std::size_t k : chosen_rates_) r.push_back(change(k, at, 1) - x[k]);
    return r;
  };
  newton(residual, ydot, scales_, velocity_factors_, "velocity");
  move(y, ydot);
  for (const Row& row : model_.rows) {
    if (std::fabs(model_.row_velocity(row)) > 1e-9L * model_.length) {
      throw std::runtime_error("a constraint that looked redundant is violated nearby");
    }
  }
  return ydot;
}

// A row that adds no rank at the operating point must stay satisfied nearby, or it is not redundant.
void Neighbourhood::check_dropped_rows() const {
  for (const Row& row : model_.rows) {
    if (std::fabs(model_.row_position(row)) > 1e-10L * model_.length) {
      throw std::runtime_error("a constraint that looked redundant is violated nearby");
    }
  }
}

void Neighbourhood::polish() {
  if (position_rows_.size() + chosen_.size() != unknowns() ||
      model_.active.size() + chosen_rates_.size() != unknowns()) {
    throw std::runtime_error("the chosen coordinates do not complement the constraints");
  }
  nominal_ = model_.motion;
  const std::vector<Real> still(states_.size(), 0);
  const std::vector<Real> y = solve_positions(still);
  // The velocities of the point, apart from those that the chosen rates hold, move onto the constraints.
  const std::vector<BodyMotion> given = nominal_;
  for (std::size_t b = 1; b < nominal_.size(); ++b) {
    nominal_[b].p = model_.motion[b].p;
    nominal_[b].R = model_.motion[b].R;
  }
  const std::vector<Real> zero(unknowns(), 0);
  const std::vector<Real> ydot = solve_velocities(still, zero);
  nominal_ = model_.motion;
  Real fastest = 1;
  for (const BodyMotion& m : given) {
    fastest = std::max({fastest, norm(m.v) / model_.length, norm(m.w)});
  }
  for (std::size_t k = 0; k < unknowns(); ++k) {
    moved_ = std::max({moved_, std::fabs(y[k]) / scales_.floor[k], std::fabs(ydot[k]) / (scales_.floor[k] * fastest)});
  }
  if (moved_ > 1e-9L) throw std::runtime_error("the point is not on the constraints");
}

void Neighbourhood::settle_algebra() {
  nominal_z_ = model_.z;
  nominal_algebra_ = solve_algebra(model_);
  nominal_ = model_.motion;
  model_.expand_delays();
  for (Column& column : columns_) {
    if (column.function.node) column.nominal = model_.evaluate_along(column.function);
  }
  for (const std::size_t k : inputs_) {
    nominal_inputs_.push_back(model_.variable_values[k]);
    model_.cut[k] = 1;
    model_.cut_values[k] = model_.variable_values[k];
  }
}

std::vector<Real> Neighbourhood::second_rates(const std::vector<Real>& y, const std::vector<Real>& ydot) const {
  std::vector<Real> second(unknowns(), 0);
  for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
    const Model::BodyData& body = model_.bodies[b];
    const auto o = static_cast<std::size_t>(body.offset);
    const BodyMotion& n = nominal_[b];
    const Vec translation = model_.motion[b].a - n.a;
    for (int c = 0; c < 3; ++c) second[o + static_cast<std::size_t>(c)] = component(translation, c);
    if (body.dof == 3) continue;
    // alpha = J y'' + J' y' + E alpha_n + (J y') x (E omega_n), E = exp(y^)
    const Vec turn{y[o + 3], y[o + 4], y[o + 5]};
    const Vec rate{ydot[o + 3], ydot[o + 4], ydot[o + 5]};
    const Mat E = rotation_exponential(turn);
    const Mat J = left_jacobian(turn);
    const Vec rest = left_jacobian_rate(turn, rate) * rate + E * n.al + cross(J * rate, E * n.w);
    const Vec rotation = solve3(J, model_.motion[b].al - rest);
    for (int c = 0; c < 3; ++c) second[o + 3 + static_cast<std::size_t>(c)] = component(rotation, c);
  }
  return second;
}

std::vector<Real> Neighbourhood::evaluate(const std::vector<Real>& x, const std::vector<Real>& u) {
  using Kind = ChosenState::Kind;
  model_.z = nominal_z_;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    if (states_[k].kind == Kind::differential) model_.z[columns_[k].slot] += x[k];
  }
  for (std::size_t k = 0; k < inputs_.size(); ++k) {
    model_.cut_values[inputs_[k]] = nominal_inputs_[k] + u[k];
  }
  const std::vector<Real> y = solve_positions(x);
  const std::vector<Real> ydot = solve_velocities(x, y);
  std::vector<Real> w = nominal_algebra_;
  const auto residual = [&](const std::vector<Real>& at) {
    model_.unpack_algebra(at);
    return model_.algebra_residual();
  };
  newton(residual, w, algebra_scales(model_), algebra_factors_, "acceleration");
  model_.unpack_algebra(w);
  const std::vector<Real> second = second_rates(y, ydot);
  const std::vector<Real> zdot = model_.differential_rates();
  std::vector<Real> result;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    if (states_[k].kind == Kind::coordinate) result.push_back(change(k, ydot, 1));
    if (states_[k].kind == Kind::rate) result.push_back(change(k, second, 2));
    if (states_[k].kind == Kind::differential) result.push_back(zdot[columns_[k].slot]);
  }
  for (const int id : model_.mechanism().poutput.variables) {
    result.push_back(model_.variable_values[static_cast<std::size_t>(model_.variable_index(id))]);
  }
  return result;
}

}  // namespace dynalin::oracle
