#include "linear/linear_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/saddle.h"
#include "elements/controls/variable_list.h"
#include "linear/candidates.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

// Roundings that a sum of the reduction may pick up, in units of the last place of its largest partial sums.
constexpr double rounding_units = 32;

// y += factor · M x for sparse M and dense x.
void multiply_add(const ColumnMatrix& m, const Matrix& x, Matrix& y, double factor) {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    m.multiply_add({x.col(c).data(), static_cast<std::size_t>(x.rows())},
                   {y.col(c).data(), static_cast<std::size_t>(y.rows())}, factor);
  }
}

class Linearizer {
 public:
  Linearizer(const System& system, const OperatingPoint& op, const LinearOptions& options)
      : system_(system),
        layout_(system.layout()),
        options_(options),
        op_(op),
        motion_(system.motion(op)),
        saddle_(system),
        n_(layout_.coordinate_count) {
    rows_.resize(layout_);
    eq_.resize(layout_);
  }

  Result<LinearSystem> run() {
    system_.constraints(motion_, rows_);
    system_.equations(motion_, rows_, eq_,
                      {Column::position, Column::velocity, Column::damping, Column::acceleration, Column::lambda,
                       Column::algebraic, Column::state, Column::state_rate});
    auto candidates = state_candidates(system_, motion_, options_);
    if (!candidates) return tl::unexpected(candidates.error());
    candidates_ = std::move(*candidates);
    choose_coordinates();
    if (auto failure = choose_rates()) return tl::unexpected(*failure);
    label_states();
    read_channels();
    if (auto failure = solve_levels()) return tl::unexpected(*failure);
    assemble();
    return std::move(result_);
  }

 private:
  using Entries = std::vector<std::pair<std::int32_t, RowCoefficients>>;

  Entries gradient(const Candidate& c) const {
    if (c.row < 0) return {{c.coordinate, {1.0, 0.0, 0.0, 0.0}}};
    Entries e;
    for (const auto& entry : candidates_.gradients.row(c.row)) e.emplace_back(entry.column, entry.c);
    return e;
  }

  bool is_constant(const Candidate& c) const {
    const auto row = candidates_.gradients.row(c.row);
    return std::all_of(row.begin(), row.end(), [](const auto& e) { return e.c.g == 0.0; });
  }

  // A candidate with a gradient row becomes a column of its own: row · δq − s = 0, offered as pivot last of all.
  void add_candidate_rows(const std::vector<Candidate>& candidates, std::vector<SparseRow>& rows,
                          std::vector<std::int32_t>& columns, std::int32_t& next) const {
    for (const Candidate& c : candidates) {
      if (c.row < 0) {
        columns.push_back(c.coordinate);
        continue;
      }
      SparseRow row = scaled_row(system_, candidates_.gradients.row(c.row));
      double size = 0;
      for (const double v : row.value) size = std::max(size, std::abs(v));
      if (size > 0) {
        row.column.push_back(next);
        row.value.push_back(-size);
      } else {
        row = {};
      }
      rows.push_back(std::move(row));
      columns.push_back(next++);
    }
  }

  void choose_coordinates() {
    std::vector<SparseRow> rows;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      rows.push_back(rows_.level(k) == RowLevel::position ? scaled_row(system_, rows_.row(k)) : SparseRow{});
    }
    std::vector<Candidate> all = candidates_.wanted;
    std::vector<std::int32_t> columns;
    std::int32_t next = n_;
    add_candidate_rows(all, rows, columns, next);
    const std::size_t own = columns.size();
    add_candidate_rows(candidates_.fallback, rows, columns, next);
    all.insert(all.end(), candidates_.fallback.begin(), candidates_.fallback.end());

    const std::vector<std::int32_t> order(columns.rbegin(), columns.rend());
    const Elimination e = eliminate(std::move(rows), next, order);
    for (std::int32_t k = 0; k < rows_.size(); ++k) active_.push_back(e.pivot_column[static_cast<std::size_t>(k)] >= 0);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const bool unused = all[k].row >= 0 && is_constant(all[k]);
      if (!e.dependent[static_cast<std::size_t>(columns[k])] && !unused) chosen_.push_back(all[k]);
      if (k < own && all[k].row >= 0 && all[k].label.type == StateType::pstate &&
          e.dependent[static_cast<std::size_t>(columns[k])]) {
        result_.warnings.push_back(
            fmt::format("{} was not taken: it is constant or depends on coordinates before it", all[k].label.text));
      }
    }
  }

  // Velocity rows take some of the rates away; a position whose rate is dependent stands alone. The rows are written in
  // the chosen rates alone, δq′ = N δx′, so that every other rate is dependent whatever the sizes of its entries.
  std::optional<Failure> choose_rates() {
    has_rate_.assign(chosen_.size(), true);
    velocity_active_ = active_;
    bool any = false;
    for (std::int32_t k = 0; k < rows_.size(); ++k) any = any || rows_.level(k) == RowLevel::velocity;
    if (!any || chosen_.empty()) return std::nullopt;
    SparseLu lu;
    if (!factor_level(active_, has_rate_, lu)) return undetermined_positions();
    const auto count = static_cast<Eigen::Index>(chosen_.size()), held = static_cast<Eigen::Index>(n_) - count;
    Matrix N = Matrix::Zero(n_, count);
    std::vector<std::int32_t> order;
    for (Eigen::Index k = 0; k < count; ++k) {
      // A unit of the coordinate is what a unit of the scaled coordinates of the layout makes of it.
      double unit = 0;
      for (const auto& [column, g] : gradient(chosen_[static_cast<std::size_t>(k)])) {
        unit = std::max(unit, std::abs(g.g * system_.coordinate_scale(column)));
      }
      N(held + k, k) = unit;
      order.insert(order.begin(), static_cast<std::int32_t>(k));
    }
    lu.solve(N);
    std::vector<SparseRow> rows(static_cast<std::size_t>(rows_.size()));
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.level(k) != RowLevel::velocity) continue;
      Eigen::RowVectorXd reduced = Eigen::RowVectorXd::Zero(count);
      double size = 0;
      for (const auto& e : rows_.row(k)) {
        reduced += e.c.g * N.row(e.column);
        size = std::max(size, std::abs(e.c.g * system_.coordinate_scale(e.column)));
      }
      // What is left of a row that follows from the position rows is rounding.
      if (reduced.cwiseAbs().maxCoeff() <= EliminationOptions{}.rank_tolerance * size) continue;
      for (Eigen::Index c = 0; c < count; ++c) {
        rows[static_cast<std::size_t>(k)].column.push_back(static_cast<std::int32_t>(c));
        rows[static_cast<std::size_t>(k)].value.push_back(reduced(c));
      }
    }
    const Elimination e = eliminate(std::move(rows), static_cast<std::int32_t>(count), order);
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.level(k) != RowLevel::velocity) continue;
      velocity_active_[static_cast<std::size_t>(k)] = e.pivot_column[static_cast<std::size_t>(k)] >= 0;
    }
    for (std::size_t k = 0; k < chosen_.size(); ++k) has_rate_[k] = !e.dependent[k];
    return std::nullopt;
  }

  static Failure undetermined_positions() {
    return {"linear analysis", "the chosen coordinates do not determine the position of the model", {}};
  }

  void label_states() {
    // States are listed by element; user coordinates keep their order and come first.
    StateSpace& model = result_.model;
    model.time = op_.time;
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const StateLabel& label = chosen_[k].label;
      result_.coordinates.push_back(label);
      if (has_rate_[k]) {
        StateLabel rate = label;
        rate.is_rate = true;
        const bool own = label.type == StateType::pstate;
        const bool point = label.type == StateType::point_mass || label.type == StateType::point_mass_relative;
        if (own) rate.type = StateType::pstate_rate;
        rate.coordinate = own ? 2 : label.coordinate + (point ? 3 : 6);
        rate_column_.push_back(static_cast<Eigen::Index>(model.states.size()));
        model.states.push_back(rate);
      } else {
        rate_column_.push_back(-1);
      }
      position_column_.push_back(static_cast<Eigen::Index>(model.states.size()));
      model.states.push_back(label);
    }
    result_.kinematic_states = model.states.size();
    // Differential states by type code, then id.
    for (std::size_t k = 0; k < layout_.states.size(); ++k) state_order_.push_back(k);
    std::stable_sort(state_order_.begin(), state_order_.end(), [&](std::size_t a, std::size_t b) {
      const auto key = [&](std::size_t k) {
        const DifferentialState& z = layout_.states[k];
        return std::tuple(static_cast<int>(z.type), z.owner->id, z.coordinate);
      };
      return key(a) < key(b);
    });
    first_state_ = static_cast<Eigen::Index>(model.states.size());
    for (const std::size_t k : state_order_) {
      const DifferentialState& z = layout_.states[k];
      model.states.push_back(
          {z.type, z.owner->id, z.coordinate, fmt::format("State {}", z.coordinate), z.owner->text(), false});
    }
    result_.differential_states = layout_.states.size();
  }

  void read_channels() {
    const Model& model = system_.model();
    const auto read = [&](const std::optional<ElementHandle>& handle, std::vector<ChannelLabel>& labels,
                          std::vector<std::int32_t>& unknowns, std::int64_t& id) {
      if (!handle) return;
      id = model.label(*handle).id;
      for (const VariableRef v : model.get<VariableList>(*handle)->variables) {
        labels.push_back({model.label(v).id, model.label(v).text()});
        unknowns.push_back(system_.signals().variable(v).index);
      }
    };
    read(options_.pinput, result_.model.inputs, inputs_, result_.model.pinput);
    read(options_.poutput, result_.model.outputs, outputs_, result_.model.poutput);
    cut_.assign(layout_.algebraic.size(), false);
    for (const std::int32_t u : inputs_) {
      cut_[static_cast<std::size_t>(u)] = true;
      const bool depends = depends_on_anything(u);
      const double value = op_.algebraic[static_cast<std::size_t>(u)];
      if (depends || value != 0.0) {
        result_.warnings.push_back(
            fmt::format("{} is a plant input but its own expression {}; the linear model takes it as independent. "
                        "Remove it from the "
                        "PINPUT, or put a new VARIABLE with FUNCTION=0 there and add its VARVAL to the expression",
                        layout_.algebraic[static_cast<std::size_t>(u)].owner->full_text(),
                        depends ? "depends on the state of the model" : fmt::format("has the value {:g}", value)));
      }
    }
  }

  bool depends_on_anything(std::int32_t unknown) const {
    const std::int32_t row = eq_.algebraic_row(unknown);
    for (std::size_t f = 0; f < column_families; ++f) {
      const auto family = static_cast<Column>(f);
      const ColumnMatrix& m = eq_.matrix(family);
      for (std::int32_t c = 0; c < m.columns; ++c) {
        if (family == Column::algebraic && c == unknown) continue;
        const auto first = m.row.begin() + m.start[static_cast<std::size_t>(c)],
                   last = m.row.begin() + m.start[static_cast<std::size_t>(c) + 1];
        const auto it = std::lower_bound(first, last, row);
        if (it != last && *it == row && m.value[static_cast<std::size_t>(it - m.row.begin())] != 0.0) return true;
      }
    }
    return false;
  }

  // The square matrix [G; X] of active rows and chosen coordinates at one level.
  bool factor_level(const std::vector<bool>& active, const std::vector<bool>& use, SparseLu& lu) const {
    std::vector<Triplet> entries;
    std::int32_t r = 0;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (!active[static_cast<std::size_t>(k)]) continue;
      for (const auto& e : rows_.row(k)) entries.push_back({r, e.column, e.c.g});
      ++r;
    }
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      if (!use[k]) continue;
      for (const auto& [column, g] : gradient(chosen_[k])) entries.push_back({r, column, g.g});
      ++r;
    }
    return r == n_ && lu.factor(compressed(n_, n_, entries));
  }

  // X δq of chosen coordinate k at a level below: Σ coefficient · x.
  static Eigen::RowVectorXd combine(const Entries& gradient, double RowCoefficients::*which, const Matrix& x) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(x.cols());
    for (const auto& [column, g] : gradient) {
      if (g.*which != 0.0) sum += g.*which * x.row(column);
    }
    return sum;
  }

  std::optional<Failure> solve_levels() {
    const auto states = static_cast<Eigen::Index>(result_.model.states.size());
    columns_ = states + static_cast<Eigen::Index>(inputs_.size());
    Matrix &dq = result_.dq, &dqdot = result_.dqdot;

    SparseLu lu;
    const std::vector<bool> every(chosen_.size(), true);
    if (!factor_level(active_, every, lu)) return undetermined_positions();
    dq = Matrix::Zero(n_, columns_);
    const auto held = static_cast<Eigen::Index>(n_) - static_cast<Eigen::Index>(chosen_.size());
    for (std::size_t k = 0; k < chosen_.size(); ++k) dq(held + static_cast<Eigen::Index>(k), position_column_[k]) = 1.0;
    lu.solve(dq);

    if (velocity_active_ != active_ || std::find(has_rate_.begin(), has_rate_.end(), false) != has_rate_.end()) {
      if (!factor_level(velocity_active_, has_rate_, lu)) {
        return Failure{"linear analysis", "the chosen rates do not determine the velocities of the model", {}};
      }
    }
    dqdot = Matrix::Zero(n_, columns_);
    Eigen::Index r = 0;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (!velocity_active_[static_cast<std::size_t>(k)]) continue;
      for (const auto& e : rows_.row(k)) {
        if (e.c.v != 0.0) dqdot.row(r) -= e.c.v * dq.row(e.column);
      }
      ++r;
    }
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      if (!has_rate_[k]) continue;
      dqdot(r, rate_column_[k]) = 1.0;
      dqdot.row(r++) -= combine(gradient(chosen_[k]), &RowCoefficients::v, dq);
    }
    lu.solve(dqdot);

    const ColumnMatrix matrix = saddle_.matrix(eq_, rows_, velocity_active_, {}, cut_);
    if (!lu.factor(matrix)) {
      return Failure{"linear analysis", "the accelerations are not determined", undetermined(system_, saddle_, matrix)};
    }
    Matrix equations = Matrix::Zero(eq_.size(), columns_);
    multiply_add(eq_.matrix(Column::position), dq, equations, -1.0);
    multiply_add(eq_.matrix(Column::velocity), dqdot, equations, -1.0);
    if (!options_.without_damping) multiply_add(eq_.matrix(Column::damping), dqdot, equations, -1.0);
    dz_ = Matrix::Zero(static_cast<Eigen::Index>(layout_.states.size()), columns_);
    for (std::size_t k = 0; k < state_order_.size(); ++k) {
      dz_(static_cast<Eigen::Index>(state_order_[k]), first_state_ + static_cast<Eigen::Index>(k)) = 1.0;
    }
    multiply_add(eq_.matrix(Column::state), dz_, equations, -1.0);

    Matrix x = Matrix::Zero(saddle_.size(), columns_);
    for (std::int32_t row = 0; row < eq_.size(); ++row) x.row(saddle_.equation(row)) = equations.row(row);
    for (std::size_t u = 0; u < inputs_.size(); ++u) {
      x.row(saddle_.algebraic(inputs_[u])).setZero();
      x(saddle_.algebraic(inputs_[u]), states + static_cast<Eigen::Index>(u)) = 1.0;
    }
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (!velocity_active_[static_cast<std::size_t>(k)]) continue;
      for (const auto& e : rows_.row(k)) {
        if (e.c.a1 != 0.0) x.row(saddle_.lambda(k)) -= e.c.a1 * dqdot.row(e.column);
        if (e.c.a0 != 0.0) x.row(saddle_.lambda(k)) -= e.c.a0 * dq.row(e.column);
      }
    }
    lu.solve(x);
    estimate_rounding(lu);
    result_.dqddot = x.topRows(n_);
    result_.dlambda = x.middleRows(saddle_.lambda(0), rows_.size());
    result_.dw = x.middleRows(saddle_.algebraic(0), static_cast<Eigen::Index>(layout_.algebraic.size()));
    dzdot_ = x.bottomRows(static_cast<Eigen::Index>(layout_.states.size()));
    return std::nullopt;
  }

  // Entries of A that are zero in exact arithmetic come out as rounding, and a double zero eigenvalue turns that into
  // its square root. Every entry is a sum yᵀ r of the solution y of the transposed system and a right-hand side r;
  // what is below the rounding of that very sum, Σ|y||r| with |r| again summed over its parts, is zero.
  void estimate_rounding(const SparseLu& lu) {
    const auto states = static_cast<Eigen::Index>(result_.model.states.size());
    const auto absolute = [](ColumnMatrix m) {
      for (double& v : m.value) v = std::abs(v);
      return m;
    };
    const Matrix dq = result_.dq.leftCols(states).cwiseAbs(), dqdot = result_.dqdot.leftCols(states).cwiseAbs();
    Matrix parts = Matrix::Zero(eq_.size(), states);
    multiply_add(absolute(eq_.matrix(Column::position)), dq, parts, 1.0);
    multiply_add(absolute(eq_.matrix(Column::velocity)), dqdot, parts, 1.0);
    multiply_add(absolute(eq_.matrix(Column::damping)), dqdot, parts, 1.0);
    multiply_add(absolute(eq_.matrix(Column::state)), dz_.leftCols(states), parts, 1.0);
    Matrix size = Matrix::Zero(saddle_.size(), states);
    for (std::int32_t row = 0; row < eq_.size(); ++row) size.row(saddle_.equation(row)) = parts.row(row);
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      for (const auto& e : rows_.row(k)) {
        size.row(saddle_.lambda(k)) += std::abs(e.c.a1) * dqdot.row(e.column) + std::abs(e.c.a0) * dq.row(e.column);
      }
    }
    rounding_ = Matrix::Zero(states, states);
    Matrix adjoint = Matrix::Zero(saddle_.size(), states);
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      if (!has_rate_[k]) continue;
      for (const auto& [column, g] : gradient(chosen_[k])) {
        adjoint(column, rate_column_[k]) += g.g;
        rounding_.row(rate_column_[k]) += std::abs(g.a1) * dqdot.row(column) + std::abs(g.a0) * dq.row(column);
      }
    }
    for (std::size_t k = 0; k < state_order_.size(); ++k) {
      adjoint(saddle_.state(static_cast<std::int32_t>(state_order_[k])), first_state_ + static_cast<Eigen::Index>(k)) =
          1.0;
    }
    lu.solve_transposed(adjoint);
    rounding_ += adjoint.cwiseAbs().transpose() * size;
    rounding_ *= rounding_units * std::numeric_limits<double>::epsilon();
  }

  void assemble() {
    StateSpace& model = result_.model;
    const auto states = static_cast<Eigen::Index>(model.states.size());
    const auto inputs = static_cast<Eigen::Index>(inputs_.size());
    Matrix rates = Matrix::Zero(states, columns_);
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const Entries g = gradient(chosen_[k]);
      if (has_rate_[k]) {
        rates(position_column_[k], rate_column_[k]) = 1.0;
        rates.row(rate_column_[k]) = combine(g, &RowCoefficients::g, result_.dqddot) +
                                     combine(g, &RowCoefficients::a1, result_.dqdot) +
                                     combine(g, &RowCoefficients::a0, result_.dq);
      } else {
        rates.row(position_column_[k]) =
            combine(g, &RowCoefficients::g, result_.dqdot) + combine(g, &RowCoefficients::v, result_.dq);
      }
    }
    for (std::size_t k = 0; k < state_order_.size(); ++k) {
      rates.row(first_state_ + static_cast<Eigen::Index>(k)) = dzdot_.row(static_cast<Eigen::Index>(state_order_[k]));
    }
    Matrix outputs = Matrix::Zero(static_cast<Eigen::Index>(outputs_.size()), columns_);
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      outputs.row(static_cast<Eigen::Index>(k)) = result_.dw.row(outputs_[k]);
    }
    if (options_.without_damping) {
      // Outputs keep what they see of velocities.
      Matrix seen = Matrix::Zero(eq_.size(), columns_);
      multiply_add(eq_.matrix(Column::damping), result_.dqdot, seen, -1.0);
      for (std::size_t k = 0; k < outputs_.size(); ++k)
        outputs.row(static_cast<Eigen::Index>(k)) += seen.row(eq_.algebraic_row(outputs_[k]));
    }
    model.A = rates.leftCols(states);
    model.A = (model.A.array().abs() <= rounding_.array()).select(0.0, model.A);
    model.B = rates.rightCols(inputs);
    model.C = outputs.leftCols(states);
    model.D = outputs.rightCols(inputs);
  }

  const System& system_;
  const Layout& layout_;
  const LinearOptions& options_;
  const OperatingPoint& op_;
  Motion motion_;
  Saddle saddle_;
  std::int32_t n_;
  ConstraintRows rows_;
  Equations eq_;
  CandidateSet candidates_;
  std::vector<Candidate> chosen_;
  std::vector<bool> active_, velocity_active_, has_rate_;
  std::vector<Eigen::Index> rate_column_, position_column_;
  std::vector<std::size_t> state_order_;
  Eigen::Index first_state_ = 0, columns_ = 0;
  std::vector<std::int32_t> inputs_, outputs_;
  std::vector<bool> cut_;
  Matrix dz_, dzdot_, rounding_;
  LinearSystem result_;
};

}  // namespace

Result<LinearSystem> linearize(const System& system, OperatingPoint op, const LinearOptions& options) {
  op.mode = AnalysisMode::linear;
  return Linearizer(system, op, options).run();
}

}  // namespace dynalin
