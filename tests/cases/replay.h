// What the library makes of the commands of a run, to be held against what the program made of them.
#pragma once

#include <dynalin/record.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command/commands/edit.h"
#include "command/commands/environment.h"
#include "command/commands/equilibrium.h"
#include "command/commands/linear.h"
#include "command/commands/simulate.h"
#include "command/planner.h"

namespace dynalin::cases {

// Runs the commands one by one through the library; empty where one of them is nothing that the library has, such as
// commands that are passed over.
class Replay {
 public:
  explicit Replay(const SessionOptions& options) : options_(options) {}

  nlohmann::ordered_json run() {
    std::ostringstream unused;
    const auto plan = planned(options_, unused);
    if (!plan || plan->jobs.size() != 1) return {};
    const Job& job = plan->jobs.front();
    library::Study study(
        library::Model::read(job.stages.front().dataset->source->name(), {options_.pade, options_.user_value}));
    library::Record record(study.model());
    auto point = study.as_drawn();
    for (const Command& c : job.commands) {
      if (c.kind->name == "STOP") break;
      try {
        if (!execute(c, study, record, point)) return {};
      } catch (const Error& e) {
        record.add(c.text, e);
        if (!options_.keep_going) break;
      }
    }
    return nlohmann::ordered_json::parse(record.to_json());
  }

 private:
  bool execute(const Command& c, library::Study& study, library::Record& record, library::OperatingPoint& point) {
    if (action_of<commands::Edit>(c)) {
      study = library::Study(study.model().edited(c.text));
      // A point of the first model goes through all edits at once.
      if (!analysed_) analysed_ = point;
      point = study.continued(*analysed_);
      record.add(c.text, point.time());
      return true;
    }
    analysed_.reset();
    if (const auto* simulate = action_of<commands::Simulate>(c)) {
      if (simulate->kind) return through_time(c.text, *simulate, study, record, point);
      point = simulate->initial_conditions ? study.initial_conditions(point, initial_)
                                           : study.static_equilibrium(point, static_);
      record.add(c.text, point);
      return true;
    }
    if (const auto* linear = action_of<commands::Linear>(c)) {
      linearize(c.text, linear->command, study, record, point);
      return true;
    }
    if (const auto* variable = action_of<commands::SetEnvironment>(c)) {
      const std::string& name = variable->name;
      if (name == "MSC_LINEAR_PBCS_STATES")
        environment_.principal_states = true;
      else if (name == "MSC_ADAMS_SOLVER_NODAMP_DIFF")
        environment_.without_rate_coupling = true;
      else if (name == "MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY")
        environment_.without_reconciliation = true;
      else if (name == "MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES")
        static_.restore_velocities = false;
      else
        return false;
      record.add(c.text, point.time());
      return true;
    }
    if (const auto* setting = action_of<commands::SettingOf<WrittenInitialConditions>>(c)) {
      initial_.error = setting->written.error;
      record.add(c.text, point.time());
      return true;
    }
    const auto* setting = action_of<commands::Equilibrium>(c);
    if (!setting || setting->written.defaults || !setting->passed_over.empty()) return false;
    const EquilibriumSettings stated = setting->written.stated();
    take_over(static_.error, stated.error), take_over(static_.imbalance, stated.imbalance);
    take_over(static_.translation_limit, stated.translation_limit);
    take_over(static_.rotation_limit, stated.rotation_limit);
    take_over(static_.iteration_limit, stated.iteration_limit);
    record.add(c.text, point.time());
    return true;
  }

  bool through_time(const std::string& text, const commands::Simulate& simulate, const library::Study& study,
                    library::Record& record, library::OperatingPoint& point) const {
    if (!simulate.end && !simulate.duration) return false;
    library::SimulationRequest request{.kind = *simulate.kind};
    request.end = simulate.end ? *simulate.end : point.time() + *simulate.duration;
    request.output_step = simulate.output_step, request.steps = simulate.steps;
    library::Simulation found = study.simulate(point, request);
    record.add(text, found);
    point = found.point;
    return true;
  }

  void linearize(const std::string& text, const LinearCommand& c, const library::Study& study, library::Record& record,
                 library::OperatingPoint& point) {
    LinearRequest request = environment_;
    request.pstate = c.pstate, request.pinput = c.pinput, request.poutput = c.poutput, request.rm = c.rm;
    request.without_damping = c.without_damping, request.original = c.original;
    request.dense_up_to = options_.dense_up_to;
    const bool within = initial_.error && !point.is_consistent();
    const library::LinearModel linear =
        study.linearize(within ? study.initial_conditions(point, initial_) : point, request);
    if (!point.is_consistent()) point = linear.operating_point();
    if (c.option == LinearOption::mkb)
      record.add(text, linear, linear.second_order());
    else if (c.descriptor)
      record.add(text, linear, linear.descriptor_form());
    else if (c.option == LinearOption::statemat)
      record.add(text, linear, linear.state_space());
    else
      add_modes(text, c, record, linear);
  }

  static void add_modes(const std::string& text, const LinearCommand& c, library::Record& record,
                        const library::LinearModel& linear) {
    const auto shapes = c.without_vectors ? library::ModeShapes::left_out : library::ModeShapes::wanted;
    const library::Modes modes = c.selection ? linear.modes(*c.selection, shapes) : linear.modes(shapes);
    record.add(text, linear, modes, c.tables.any() ? linear.tables(modes, c.tables) : ModalTables{});
  }

  const SessionOptions& options_;
  std::optional<library::OperatingPoint> analysed_;  // before the edits that come one after the other
  InitialConditionRequest initial_;
  StaticRequest static_;
  LinearRequest environment_;
};

}  // namespace dynalin::cases
