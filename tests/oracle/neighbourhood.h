// The surroundings of an operating point: from values of states and inputs to rates and outputs.
#pragma once

#include <vector>

#include "model.h"
#include "newton.h"

namespace dynalin::oracle {

// The model around one operating point: maps values of states and inputs to rates and outputs.
class Neighbourhood {
 public:
  Neighbourhood(const Mechanism& mechanism, const OraclePoint& point, const std::vector<ChosenState>& states)
      : model_(mechanism), states_(states) {
    place(model_, point);
    read_states();
    model_.active = independent_rows(model_.gradient(), 1e-9L);
    for (const int k : model_.active) {
      if (!model_.rows[static_cast<std::size_t>(k)].of_rates) position_rows_.push_back(k);
    }
    scales_.group.resize(unknowns());
    scales_.floor.assign(unknowns(), 1);
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
      const Model::BodyData& body = model_.bodies[b];
      for (int c = 0; c < body.dof; ++c) {
        const auto k = static_cast<std::size_t>(body.offset + c);
        const bool is_length = c < 3 && body.ref.kind < BodyKind::beam_slope;
        scales_.group[k] = is_length ? 0 : 1;
        scales_.floor[k] = is_length ? model_.length : 1;
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
    if (s.variable != 0) return columns_[state].function.node->measure <= Measure::DM ? model_.length / 4 : 1;
    if (s.kind == ChosenState::Kind::differential || s.coordinate >= 3) return 1;
    if (s.body_kind >= BodyKind::beam_slope) return 0.5;
    return model_.length / 4;
  }

 private:
  struct Column {
    std::size_t dof = 0;   // of a coordinate or rate
    std::size_t slot = 0;  // of a differential state
    Expr function{};       // of PSTATE
    Jet nominal;           // its value and rates at the operating point
  };

  [[nodiscard]] std::size_t unknowns() const { return static_cast<std::size_t>(model_.dofs); }
  void read_states();
  void polish();
  void settle_algebra();
  // What a state measures, less its nominal value, on the level of positions, velocities or accelerations: of the BCS
  // from y or its derivative, of PSTATE from the placed model.
  [[nodiscard]] Real change(std::size_t state, const std::vector<Real>& y, int level) const;
  void pose(const std::vector<Real>& y);
  void move(const std::vector<Real>& y, const std::vector<Real>& ydot);
  [[nodiscard]] std::vector<Real> solve_positions(const std::vector<Real>& x);
  [[nodiscard]] std::vector<Real> solve_velocities(const std::vector<Real>& x, const std::vector<Real>& y);
  [[nodiscard]] std::vector<Real> second_rates(const std::vector<Real>& y, const std::vector<Real>& ydot) const;
  void check_dropped_rows() const;

  Model model_;
  std::vector<ChosenState> states_;
  std::vector<Column> columns_;
  std::vector<std::size_t> chosen_, chosen_rates_;  // states that are coordinates, or rates
  std::vector<int> position_rows_;                  // the active rows that have a position
  std::vector<std::size_t> inputs_;                 // variable indices
  std::vector<Real> nominal_inputs_, nominal_algebra_;
  std::vector<BodyMotion> nominal_;
  std::vector<Real> nominal_z_;
  NewtonScales scales_;
  Lu position_factors_, velocity_factors_, algebra_factors_;
  Real moved_ = 0;
};

}  // namespace dynalin::oracle
