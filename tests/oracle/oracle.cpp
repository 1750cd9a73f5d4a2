#include "oracle.h"

#include <algorithm>
#include <stdexcept>

#include "model.h"
#include "newton.h"
#include "small_algebra.h"

namespace dynalin::oracle {

namespace {

Mat orthonormal(const std::array<Triple, 3>& rows) {
  Mat R = transpose(Mat{{to_vec(rows[0]), to_vec(rows[1]), to_vec(rows[2])}});
  // Newton's iteration for the nearest rotation: the given numbers are orthonormal to double accuracy.
  for (int k = 0; k < 4; ++k) R = 0.5L * (R * (3.0L * Mat{} + -1.0L * (transpose(R) * R)));
  return R;
}

BodyRef ref_of(int id, bool is_point_mass) { return {is_point_mass ? BodyKind::point_mass : BodyKind::part, id}; }

NewtonScales algebra_scales(const Model& model) {
  const std::vector<int> groups = model.algebra_groups();
  return {groups, std::vector<Real>(groups.size(), 1e-3L)};
}

}  // namespace

void place(Model& model, const OraclePoint& point) {
  model.time = point.time;
  std::size_t placed = 0;
  for (const BodyPoint& given : point.bodies) {
    const int b = model.body_index(ref_of(given.body_id, given.is_point_mass));
    BodyMotion& m = model.motion[static_cast<std::size_t>(b)];
    m = {to_vec(given.position),
         orthonormal(given.rotation),
         to_vec(given.velocity),
         given.is_point_mass ? Vec{} : to_vec(given.angular_velocity),
         Vec{},
         Vec{}};
    ++placed;
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
  // Away from the solution factors go stale quickly: a few full Newton steps first.
  for (int k = 0; k < 4; ++k) {
    const Lu lu(difference_jacobian(residual, x, group_scales(scales, x)));
    const std::vector<Real> dx = lu.solve(residual(x));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= dx[i];
  }
  newton(residual, x, scales, factors, "acceleration");
  model.unpack_algebra(x);
  return x;
}

namespace {

// The model around one operating point: maps values of states and inputs to rates and outputs.
class Neighbourhood {
 public:
  Neighbourhood(const Mechanism& mechanism, const OraclePoint& point, const std::vector<ChosenState>& states)
      : model_(mechanism), states_(states) {
    place(model_, point);
    read_states();
    model_.active = independent_rows(model_.gradient(), 1e-9L);
    scales_.group.resize(unknowns());
    scales_.floor.assign(unknowns(), 1);
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
      const Model::BodyData& body = model_.bodies[b];
      for (int c = 0; c < body.dof; ++c) {
        const auto k = static_cast<std::size_t>(body.offset + c);
        scales_.group[k] = c < 3 ? 0 : 1;
        scales_.floor[k] = c < 3 ? model_.length : 1;
      }
    }
    polish();
    settle_algebra();
  }

  [[nodiscard]] std::vector<Real> evaluate(const std::vector<Real>& x, const std::vector<Real>& u);
  [[nodiscard]] std::size_t input_count() const { return inputs_.size(); }
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const std::vector<BodyMotion>& nominal() const { return nominal_; }
  [[nodiscard]] const std::vector<Real>& nominal_inputs() const { return nominal_inputs_; }
  [[nodiscard]] Real moved() const { return moved_; }
  [[nodiscard]] Real step(std::size_t state) const {
    const ChosenState& s = states_[state];
    if (s.kind == ChosenState::Kind::differential || s.coordinate >= 3) return 1;
    return model_.length / 4;
  }

 private:
  struct Column {
    std::size_t dof = 0;      // of a coordinate or rate
    std::size_t slot = 0;     // of a differential state
    std::size_t partner = 0;  // rate of a coordinate, coordinate of a rate
  };

  [[nodiscard]] std::size_t unknowns() const { return static_cast<std::size_t>(model_.dofs); }
  void read_states();
  void polish();
  void settle_algebra();
  void pose(const std::vector<Real>& y);
  void move(const std::vector<Real>& y, const std::vector<Real>& ydot);
  [[nodiscard]] std::vector<Real> solve_positions(const std::vector<Real>& x);
  [[nodiscard]] std::vector<Real> solve_velocities(const std::vector<Real>& x, const std::vector<Real>& y);
  [[nodiscard]] std::vector<Real> second_rates(const std::vector<Real>& y, const std::vector<Real>& ydot) const;
  void check_dropped_rows() const;

  Model model_;
  std::vector<ChosenState> states_;
  std::vector<Column> columns_;
  std::vector<std::size_t> chosen_;  // states that are coordinates
  std::vector<std::size_t> inputs_;  // variable indices
  std::vector<Real> nominal_inputs_, nominal_algebra_;
  std::vector<BodyMotion> nominal_;
  std::vector<Real> nominal_z_;
  NewtonScales scales_;
  Lu kinematic_factors_, algebra_factors_;
  Real moved_ = 0;
};

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
    } else {
      const auto b = static_cast<std::size_t>(model_.body_index(ref_of(s.body_id, s.is_point_mass)));
      if (s.coordinate < 0 || s.coordinate >= model_.bodies[b].dof) {
        throw std::runtime_error("no such coordinate");
      }
      column.dof = static_cast<std::size_t>(model_.bodies[b].offset + s.coordinate);
      const Kind other = s.kind == Kind::rate ? Kind::coordinate : Kind::rate;
      const auto partner = std::find_if(states_.begin(), states_.end(), [&](const ChosenState& t) {
        return t.kind == other && t.body_id == s.body_id && t.is_point_mass == s.is_point_mass &&
               t.coordinate == s.coordinate;
      });
      if (partner == states_.end()) throw std::runtime_error("a coordinate lacks its rate");
      column.partner = static_cast<std::size_t>(partner - states_.begin());
      if (s.kind == Kind::coordinate) chosen_.push_back(k);
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
    for (const int k : model_.active) {
      r.push_back(model_.row_position(model_.rows[static_cast<std::size_t>(k)]));
    }
    for (const std::size_t k : chosen_) r.push_back(at[columns_[k].dof] - x[k]);
    return r;
  };
  newton(residual, y, scales_, kinematic_factors_, "position");
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
    for (const std::size_t k : chosen_) r.push_back(at[columns_[k].dof] - x[columns_[k].partner]);
    return r;
  };
  newton(residual, ydot, scales_, kinematic_factors_, "velocity");
  move(y, ydot);
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
  if (model_.active.size() + chosen_.size() != unknowns()) {
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
    if (states_[k].kind == Kind::coordinate) result.push_back(ydot[columns_[k].dof]);
    if (states_[k].kind == Kind::rate) result.push_back(second[columns_[k].dof]);
    if (states_[k].kind == Kind::differential) result.push_back(zdot[columns_[k].slot]);
  }
  for (const int id : model_.mechanism().poutput.variables) {
    result.push_back(model_.variable_values[static_cast<std::size_t>(model_.variable_index(id))]);
  }
  return result;
}

struct Extrapolated {
  std::vector<Real> value, error;
  Real relative = 0;
};

// Central differences at h, h/2, h/4, h/8, extrapolated in h^2. The error is the last change of the
// diagonal of the tableau, which belongs to the less accurate of the two entries.
template <class F>
Extrapolated extrapolate(F&& f, Real h) {
  constexpr int levels = 4;
  std::vector<std::vector<std::vector<Real>>> T(levels);
  for (int k = 0; k < levels; ++k) {
    const auto level = static_cast<std::size_t>(k);
    const Real step = std::ldexp(h, -k);
    std::vector<Real> d = f(step);
    const std::vector<Real> back = f(-step);
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = (d[i] - back[i]) / (2 * step);
    T[level].push_back(d);
    for (std::size_t m = 1; m <= level; ++m) {
      std::vector<Real> better = T[level][m - 1];
      const Real weight = std::ldexp(1.0L, static_cast<int>(2 * m)) - 1;
      for (std::size_t i = 0; i < better.size(); ++i) {
        better[i] += (T[level][m - 1][i] - T[level - 1][m - 1][i]) / weight;
      }
      T[level].push_back(better);
    }
  }
  Extrapolated result{T[3][3], T[3][3], 0};
  Real largest = 1, worst = 0;
  for (std::size_t i = 0; i < result.value.size(); ++i) {
    result.error[i] = std::fabs(T[3][3][i] - T[2][2][i]);
    largest = std::max(largest, std::fabs(result.value[i]));
    worst = std::max(worst, result.error[i]);
  }
  result.relative = worst / largest;
  return result;
}

// Starts with a step that suits gentle nonlinearities and shrinks it while that pays.
template <class F>
Extrapolated differentiate(F&& f, Real h) {
  Extrapolated best;
  best.relative = -1;
  for (int attempt = 0; attempt < 4; ++attempt) {
    try {
      Extrapolated next = extrapolate(f, h);
      if (best.relative < 0 || next.relative < best.relative) best = std::move(next);
    } catch (const std::runtime_error&) {
      // Too far away for Newton: the next, smaller step decides.
      if (attempt == 3 && best.relative < 0) throw;
    }
    if (best.relative >= 0 && best.relative < 1e-14L) break;
    h /= 4;
  }
  return best;
}

Matrix matrix(std::size_t rows, std::size_t columns) { return Matrix(rows, std::vector<double>(columns, 0.0)); }

double relative_error(const Matrix& value, const Matrix& error) {
  double largest = 1, worst = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    for (std::size_t j = 0; j < value[i].size(); ++j) {
      largest = std::max(largest, std::fabs(value[i][j]));
      worst = std::max(worst, error[i][j]);
    }
  }
  return worst / largest;
}

}  // namespace

OracleLinearModel oracle_linearize(const Mechanism& mechanism, const OraclePoint& point,
                                   const std::vector<ChosenState>& states) {
  Neighbourhood near(mechanism, point, states);
  const std::size_t n = states.size(), inputs = near.input_count();
  const std::size_t outputs = mechanism.poutput.variables.size();
  OracleLinearModel result;
  result.A = result.A_error = matrix(n, n);
  result.B = result.B_error = matrix(n, inputs);
  result.C = result.C_error = matrix(outputs, n);
  result.D = result.D_error = matrix(outputs, inputs);
  std::vector<Real> x(n, 0), u(inputs, 0);
  const auto store = [&](const Extrapolated& column, Matrix& top, Matrix& top_error, Matrix& low, Matrix& low_error,
                         std::size_t j) {
    for (std::size_t i = 0; i < n; ++i) {
      top[i][j] = static_cast<double>(column.value[i]);
      top_error[i][j] = static_cast<double>(column.error[i]);
    }
    for (std::size_t i = 0; i < outputs; ++i) {
      low[i][j] = static_cast<double>(column.value[n + i]);
      low_error[i][j] = static_cast<double>(column.error[n + i]);
    }
  };
  constexpr Real first_step = 0x1p-6L;
  for (std::size_t j = 0; j < n; ++j) {
    const auto along = [&](Real h) {
      x[j] = h;
      std::vector<Real> value = near.evaluate(x, u);
      x[j] = 0;
      return value;
    };
    store(differentiate(along, first_step * near.step(j)), result.A, result.A_error, result.C, result.C_error, j);
  }
  for (std::size_t j = 0; j < inputs; ++j) {
    const auto along = [&](Real h) {
      u[j] = h;
      std::vector<Real> value = near.evaluate(x, u);
      u[j] = 0;
      return value;
    };
    store(differentiate(along, first_step), result.B, result.B_error, result.D, result.D_error, j);
  }
  const std::vector<Real> at_point = near.evaluate(x, u);
  for (std::size_t i = 0; i < outputs; ++i) {
    result.outputs.push_back(static_cast<double>(at_point[n + i]));
  }
  for (const Real v : near.nominal_inputs()) result.inputs.push_back(static_cast<double>(v));
  for (std::size_t b = 1; b < near.model().bodies.size(); ++b) {
    const BodyRef& ref = near.model().bodies[b].ref;
    const BodyMotion& m = near.nominal()[b];
    result.accelerations.push_back({ref.id, ref.kind == BodyKind::point_mass, to_triple(m.a), to_triple(m.al)});
  }
  for (const Real v : near.model().differential_rates()) {
    result.differential_rates.push_back(static_cast<double>(v));
  }
  result.polish = static_cast<double>(near.moved());
  result.error_estimate =
      std::max({relative_error(result.A, result.A_error), relative_error(result.B, result.B_error),
                relative_error(result.C, result.C_error), relative_error(result.D, result.D_error)});
  return result;
}

}  // namespace dynalin::oracle
