#include "linear/state_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

class Chooser {
 public:
  Chooser(const System& system, const ConstraintRows& rows, CandidateSet candidates)
      : system_(system),
        layout_(system.layout()),
        rows_(rows),
        candidates_(std::move(candidates)),
        n_(layout_.coordinate_count) {}

  StateChoice run() {
    choice_.warnings = candidates_.warnings;
    choose_coordinates();
    choose_rates();
    list_states();
    return std::move(choice_);
  }

 private:
  using Gradient = std::vector<StateChoice::Entry>;

  Gradient gradient(const Candidate& c) const {
    if (c.row < 0) return {{c.coordinate, {1.0, 0.0, 0.0, 0.0}}};
    Gradient g;
    for (const auto& entry : candidates_.gradients.row(c.row)) g.push_back({entry.column, entry.c});
    return g;
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
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      choice_.active.push_back(e.pivot_column[static_cast<std::size_t>(k)] >= 0);
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const bool dependent = e.dependent[static_cast<std::size_t>(columns[k])];
      const bool unused = all[k].row >= 0 && is_constant(all[k]);
      if (!dependent && !unused) {
        choice_.labels.push_back(all[k].label);
        choice_.gradient.push_back(gradient(all[k]));
      }
      if (k < own && all[k].row >= 0 && all[k].label.type == StateType::pstate && dependent) {
        choice_.warnings.push_back(
            fmt::format("{} was not taken: it is constant or depends on coordinates before it", all[k].label.text));
      }
    }
  }

  // Velocity rows take some of the rates away; a position whose rate is dependent stands alone.
  void choose_rates() {
    choice_.has_rate.assign(choice_.labels.size(), true);
    choice_.velocity_active = choice_.active;
    bool any = false;
    for (std::int32_t k = 0; k < rows_.size(); ++k) any = any || rows_.level(k) == RowLevel::velocity;
    if (!any) return;
    std::vector<SparseRow> rows;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      const bool used = rows_.level(k) == RowLevel::velocity || choice_.active[static_cast<std::size_t>(k)];
      rows.push_back(used ? scaled_row(system_, rows_.row(k)) : SparseRow{});
    }
    std::vector<std::int32_t> order;
    for (std::int32_t c = 0; c < n_; ++c) order.push_back(c);
    std::vector<std::int32_t> columns;
    std::int32_t next = n_;
    for (const Gradient& gradient : choice_.gradient) {
      SparseRow row;
      double size = 0;
      for (const auto& [column, g] : gradient) {
        row.column.push_back(column);
        row.value.push_back(g.g * system_.coordinate_scale(column));
        size = std::max(size, std::abs(row.value.back()));
      }
      row.column.push_back(next);
      row.value.push_back(-size);
      rows.push_back(std::move(row));
      columns.push_back(next++);
    }
    order.insert(order.end(), columns.rbegin(), columns.rend());
    const Elimination e = eliminate(std::move(rows), next, order);
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      choice_.velocity_active[static_cast<std::size_t>(k)] = e.pivot_column[static_cast<std::size_t>(k)] >= 0;
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      choice_.has_rate[k] = !e.dependent[static_cast<std::size_t>(columns[k])];
    }
  }

  // States are listed by element; user coordinates keep their order and come first.
  void list_states() {
    const auto next = [&] { return static_cast<std::int32_t>(choice_.states.size()); };
    for (std::size_t k = 0; k < choice_.labels.size(); ++k) {
      const StateLabel& label = choice_.labels[k];
      choice_.rate_state.push_back(choice_.has_rate[k] ? next() : -1);
      if (choice_.has_rate[k]) {
        StateLabel rate = label;
        rate.is_rate = true;
        const bool own = label.type == StateType::pstate;
        const bool point = label.type == StateType::point_mass || label.type == StateType::point_mass_relative ||
                           label.type == StateType::point_mass_original;
        if (own) rate.type = StateType::pstate_rate;
        // Curve parameters have no second code: only 1, or 1 and 2, are permissible (LINEAR command, 5.2.6).
        const bool parameter = label.type == StateType::ptcv || label.type == StateType::cvcv;
        rate.coordinate = own ? 2 : label.coordinate + (parameter ? 0 : point ? 3 : 6);
        choice_.states.push_back(rate);
      }
      choice_.position_state.push_back(next());
      choice_.states.push_back(label);
    }
    choice_.first_differential = next();
    // Differential states by type code, then id.
    for (std::size_t k = 0; k < layout_.states.size(); ++k) {
      choice_.differential.push_back(static_cast<std::int32_t>(k));
    }
    const auto key = [&](std::int32_t k) {
      const DifferentialState& z = layout_.states[static_cast<std::size_t>(k)];
      return std::tuple(static_cast<int>(z.type), z.owner->id, z.coordinate);
    };
    std::stable_sort(choice_.differential.begin(), choice_.differential.end(),
                     [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    for (const std::int32_t k : choice_.differential) {
      const DifferentialState& z = layout_.states[static_cast<std::size_t>(k)];
      choice_.states.push_back(
          {z.type, z.owner->id, z.coordinate, fmt::format("State {}", z.coordinate), z.owner->text(), false});
    }
  }

  const System& system_;
  const Layout& layout_;
  const ConstraintRows& rows_;
  CandidateSet candidates_;
  std::int32_t n_;
  StateChoice choice_;
};

}  // namespace

bool StateChoice::splits_unequally() const {
  return velocity_active != active || std::find(has_rate.begin(), has_rate.end(), false) != has_rate.end();
}

Result<StateChoice> choose_states(const System& system, const Motion& motion, const ConstraintRows& rows,
                                  const LinearOptions& options) {
  auto candidates = state_candidates(system, motion, options);
  if (!candidates) return tl::unexpected(candidates.error());
  return Chooser(system, rows, std::move(*candidates)).run();
}

}  // namespace dynalin
