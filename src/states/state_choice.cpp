#include "states/state_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "states/user_choice.h"

namespace dynalin {

namespace {

class Chooser {
 public:
  Chooser(const System& system, const ConstraintRows& rows, CandidateSet candidates)
      : system_(system),
        layout_(system.layout()),
        rows_(rows),
        candidates_(std::move(candidates)),
        n_(layout_.coordinate_count),
        shape_(static_cast<std::size_t>(n_), false) {
    for (const ExtraBlock& e : layout_.extras) {
      if (e.is_deformation()) std::fill_n(shape_.begin() + e.offset, e.count, true);
    }
  }

  Result<StateChoice> run() {
    choice_.warnings = candidates_.warnings;
    if (candidates_.moves.empty()) {
      choose_coordinates();
    } else {
      choose_among_new();
    }
    auto own = prefer_user_coordinates(system_, rows_, candidates_, choice_);
    if (!own) return tl::unexpected(own.error());
    own_units_ = std::move(*own);
    if (auto failure = choose_rates()) return tl::unexpected(*failure);
    list_states(layout_, choice_);
    return std::move(choice_);
  }

 private:
  // Columns as they are offered as pivots, the least wanted first: shapes of bodies last of all. They are states rather
  // than how a body moves as a whole, whatever their units; stiffnesses of shapes then stand by themselves, where in
  // dependent ones they would have to cancel.
  std::vector<std::int32_t> offered(const std::vector<std::int32_t>& wanted, const auto& coordinate_of) const {
    std::vector<std::int32_t> order(wanted.rbegin(), wanted.rend());
    std::stable_partition(order.begin(), order.end(), [&](std::int32_t c) { return !is_shape(coordinate_of(c)); });
    return order;
  }
  // So much less do their entries count where the pivot of a row has to be one of its larger ones: slopes of a shape
  // may be many times what a body's own turn is.
  static constexpr double weight_of_shapes = 1e-2;
  bool is_shape(std::int32_t coordinate) const {
    return coordinate >= 0 && coordinate < n_ && shape_[static_cast<std::size_t>(coordinate)];
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
      SparseRow& row =
          rows.emplace_back(rows_.level(k) == RowLevel::position ? scaled_row(system_, rows_.row(k)) : SparseRow{});
      for (std::size_t e = 0; e < row.column.size(); ++e) {
        if (is_shape(row.column[e])) row.value[e] *= weight_of_shapes;
      }
    }
    std::vector<const Candidate*> all;
    std::vector<std::int32_t> columns;
    std::int32_t next = n_;
    for (const auto* list : {&candidates_.wanted, &candidates_.fallback}) {
      add_candidate_rows(*list, rows, columns, next);
      for (const Candidate& c : *list) all.push_back(&c);
    }

    const std::vector<std::int32_t> order = offered(columns, [](std::int32_t c) { return c; });
    const Elimination e = eliminate(std::move(rows), next, order);
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      choice_.active.push_back(e.pivot_column[static_cast<std::size_t>(k)] >= 0);
    }
    if (next == n_) note_redundant(e.largest_dropped);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const bool dependent = e.dependent[static_cast<std::size_t>(columns[k])];
      const bool unused = all[k]->row >= 0 && is_constant(*all[k]);
      if (!dependent && !unused) take(*all[k]);
    }
  }

  // As `near_dependence` wants to know it, which would find the same.
  void note_redundant(double left) {
    choice_.redundant.emplace().left = left;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.level(k) == RowLevel::position && !choice_.active[static_cast<std::size_t>(k)])
        choice_.redundant->rows.push_back(k);
    }
  }

  void take(const Candidate& c) {
    choice_.coordinates.push_back(c.state);
    choice_.gradient.push_back(gradient_of(candidates_, c));
    choice_.along_motion.emplace_back();
  }

  // The candidates are a change of coordinates: constraint rows are written in them, so that nothing else can be chosen
  // however large their gradients are.
  void choose_among_new() {
    const auto count = static_cast<std::int32_t>(candidates_.wanted.size());
    std::vector<CandidateSet::Moves> moved_by(static_cast<std::size_t>(n_));  // of each old coordinate
    for (std::int32_t k = 0; k < count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const double unit = unit_of(system_, gradient_of(candidates_, candidates_.wanted[at]));
      for (const auto& [column, v] : candidates_.moves[at])
        moved_by[static_cast<std::size_t>(column)].emplace_back(k,
                                                                v * unit * (is_shape(column) ? weight_of_shapes : 1));
    }
    std::vector<SparseRow> rows(static_cast<std::size_t>(rows_.size()));
    std::vector<double> sum(static_cast<std::size_t>(count), 0.0);
    for (std::int32_t r = 0; r < rows_.size(); ++r) {
      if (rows_.level(r) != RowLevel::position) continue;
      SparseRow& row = rows[static_cast<std::size_t>(r)];
      for (const auto& e : rows_.row(r)) {
        for (const auto& [k, v] : moved_by[static_cast<std::size_t>(e.column)]) {
          if (std::find(row.column.begin(), row.column.end(), k) == row.column.end()) row.column.push_back(k);
          sum[static_cast<std::size_t>(k)] += e.c.g * v;
        }
      }
      for (const std::int32_t k : row.column) row.value.push_back(std::exchange(sum[static_cast<std::size_t>(k)], 0.0));
    }
    std::vector<std::int32_t> wanted(static_cast<std::size_t>(count));
    std::iota(wanted.begin(), wanted.end(), 0);
    const auto order =
        offered(wanted, [&](std::int32_t k) { return candidates_.wanted[static_cast<std::size_t>(k)].coordinate; });
    const Elimination e = eliminate(std::move(rows), count, order);
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      choice_.active.push_back(e.pivot_column[static_cast<std::size_t>(k)] >= 0);
    }
    for (std::size_t k = 0; k < candidates_.wanted.size(); ++k) {
      if (!e.dependent[k]) take(candidates_.wanted[k]);
    }
  }

  // Velocity rows take some of the rates away; a position whose rate is dependent stands alone. The rows are written in
  // the chosen rates alone, δq′ = L⁻¹ (0; δx′), so that every other rate is dependent whatever the sizes of its
  // entries.
  std::optional<Failure> choose_rates() {
    const std::size_t count = choice_.gradient.size();
    choice_.has_position.assign(count, true);
    choice_.has_rate.assign(count, true);
    choice_.velocity_active = choice_.active;
    std::vector<std::int32_t> on_velocity;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.level(k) == RowLevel::velocity) on_velocity.push_back(k);
    }
    if (on_velocity.empty() || count == 0) return std::nullopt;
    bool square = false;
    SparseLu lu;
    const ColumnMatrix level = level_matrix(rows_, choice_, choice_.active, choice_.has_rate, square);
    if (!square || !lu.factor(level)) return undetermined_positions();
    const auto held = static_cast<Eigen::Index>(n_) - static_cast<Eigen::Index>(count);
    // A unit of a coordinate is what a unit of the scaled coordinates of the layout makes of it.
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    std::vector<std::int32_t> order;
    for (std::size_t k = 0; k < count; ++k) {
      double& u = unit(static_cast<Eigen::Index>(k));
      u = k < own_units_.size() ? own_units_[k] : unit_of(system_, choice_.gradient[k]);
      order.insert(order.begin(), static_cast<std::int32_t>(k));
    }
    std::vector<SparseRow> rows(static_cast<std::size_t>(rows_.size()));
    for (const std::int32_t k : on_velocity) {
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(n_, 1);
      double size = 0;
      for (const auto& e : rows_.row(k)) {
        row(e.column, 0) += e.c.g;
        size = std::max(size, std::abs(e.c.g * system_.coordinate_scale(e.column)));
      }
      lu.solve_transposed(row);
      const Eigen::VectorXd reduced = row.col(0).tail(n_ - held).cwiseProduct(unit);
      // What is left of a row that follows from the position rows is rounding.
      if (reduced.cwiseAbs().maxCoeff() <= EliminationOptions{}.rank_tolerance * size) continue;
      for (Eigen::Index c = 0; c < reduced.size(); ++c) {
        if (reduced(c) == 0.0) continue;
        rows[static_cast<std::size_t>(k)].column.push_back(static_cast<std::int32_t>(c));
        rows[static_cast<std::size_t>(k)].value.push_back(reduced(c));
      }
    }
    const Elimination e = eliminate(std::move(rows), static_cast<std::int32_t>(count), order);
    for (const std::int32_t k : on_velocity) {
      choice_.velocity_active[static_cast<std::size_t>(k)] = e.pivot_column[static_cast<std::size_t>(k)] >= 0;
    }
    for (std::size_t k = 0; k < count; ++k) choice_.has_rate[k] = !e.dependent[k];
    return std::nullopt;
  }

  const System& system_;
  const Layout& layout_;
  const ConstraintRows& rows_;
  CandidateSet candidates_;
  std::int32_t n_;
  std::vector<bool> shape_;  // coordinates of shapes of bodies
  StateChoice choice_;
  std::vector<double> own_units_;  // of the user's coordinates, which come first
};

}  // namespace

// States are listed by element; user coordinates keep their order and come first.
void list_states(const Layout& layout, StateChoice& choice) {
  choice.rate_state.clear(), choice.position_state.clear(), choice.differential.clear(), choice.states.clear();
  const auto next = [&] { return static_cast<std::int32_t>(choice.states.size()); };
  choice.scales.clear();
  const auto list = [&](const StateLabel& label, double scale) {
    choice.states.push_back(label);
    choice.scales.push_back(scale);
  };
  for (std::size_t k = 0; k < choice.coordinates.size(); ++k) {
    const StateCoordinate& c = choice.coordinates[k];
    choice.rate_state.push_back(choice.has_rate[k] ? next() : -1);
    if (choice.has_rate[k]) list(c.rate, 0);
    choice.position_state.push_back(choice.has_position[k] ? next() : -1);
    if (choice.has_position[k]) list(c.label, c.scale);
  }
  choice.first_differential = next();
  // Differential states by type code, then id.
  for (std::size_t k = 0; k < layout.states.size(); ++k) {
    if (layout.states[k].varies()) choice.differential.push_back(static_cast<std::int32_t>(k));
  }
  const auto key = [&](std::int32_t k) {
    const DifferentialState& z = layout.states[static_cast<std::size_t>(k)];
    return std::tuple(static_cast<int>(z.type), z.owner->id, z.coordinate);
  };
  std::stable_sort(choice.differential.begin(), choice.differential.end(),
                   [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
  for (const std::int32_t k : choice.differential) {
    const DifferentialState& z = layout.states[static_cast<std::size_t>(k)];
    list({z.type, z.owner->id, z.coordinate, fmt::format("State {}", z.coordinate), z.owner->element(), false}, 0);
  }
}

bool StateChoice::splits_unequally() const {
  return velocity_active != active || std::find(has_rate.begin(), has_rate.end(), false) != has_rate.end();
}

ColumnMatrix level_matrix(const ConstraintRows& rows, const StateChoice& choice, const std::vector<bool>& active,
                          const std::vector<bool>& used, bool& square, std::int32_t vacant) {
  std::vector<Triplet> entries;
  std::int32_t r = 0;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (!active[static_cast<std::size_t>(k)]) continue;
    for (const auto& e : rows.row(k)) entries.push_back({r, e.column, e.c.g});
    ++r;
  }
  for (std::size_t k = 0; k < choice.gradient.size(); ++k) {
    if (!used[k]) continue;
    for (const auto& e : choice.gradient[k]) entries.push_back({r, e.column, e.c.g});
    ++r;
  }
  const std::int32_t n = rows.layout().coordinate_count;
  square = r + vacant == n;
  return square ? compressed(n, n, entries) : ColumnMatrix{};
}

Failure undetermined_positions() {
  return {"linear analysis",
          "the chosen coordinates do not determine the position of the model",
          {},
          "undetermined-states"};
}

Result<StateChoice> choose_states(const System& system, const Motion& motion, const ConstraintRows& rows,
                                  const LinearOptions& options) {
  auto candidates = state_candidates(system, motion, options);
  if (!candidates) return tl::unexpected(candidates.error());
  return Chooser(system, rows, std::move(*candidates)).run();
}

}  // namespace dynalin
