#include "command/session.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <set>
#include <sstream>

#include "analysis/static_settings.h"
#include "command/environment.h"
#include "command/job.h"
#include "command/mode_tables.h"
#include "command/output_plan.h"
#include "command/progress_line.h"
#include "command/remarks.h"
#include "command/run_files.h"
#include "linear/cautions.h"
#include "linear/eigen.h"
#include "linear/mode_shapes.h"
#include "linear/second_order.h"
#include "linear/stability.h"
#include "linear/still_modes.h"
#include "output/json.h"
#include "output/message_file.h"
#include "output/operating_state_text.h"
#include "output/results_file.h"
#include "system/carry_over.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

constexpr std::string_view version = "0.1.0";

// Tables on the terminal would stand between the results that go there.
bool to_standard_output(const std::string& path) {
  const auto destination = path.empty() ? tl::unexpected(std::string()) : find_destination(path);
  return destination && destination->kind == Destination::Kind::standard_output;
}

class Session {
 public:
  Session(const SessionOptions& options, Job job, std::ostream& out, std::ostream& err)
      : options_(options),
        job_(std::move(job)),
        out_(out),
        err_(err),
        quiet_(options.quiet || to_standard_output(options.json)),
        settings_(job_.model().settings) {
    for (const Command& c : job_.commands.commands) {
      const auto* linear = std::get_if<LinearCommand>(&c.what);
      if (linear && !linear->file.empty()) quiet_ = quiet_ || to_standard_output(linear_path(job_, linear->file));
    }
    const SystemOptions delays{options.pade ? DelayReading::pade : DelayReading::first_order};
    for (const Job::Stage& s : job_.stages) {
      auto system = System::make(s.model, delays);
      if (!system) {
        problems_ = std::move(system.error());
        return;
      }
      systems_.push_back(std::move(*system));
    }
    point_ = system().drawn();
    if (job_.xrf_digits > 0)
      results_.emplace(job_.model().title, job_.xrf_digits, job_.model().units, settings_.results);
  }

  // What only showed while the equations were made: wrong input like any other.
  bool sound() const {
    fmt::print(err_, "{}", render(problems_));
    return !problems_.has_errors();
  }

  int run() {
    const auto start = std::chrono::steady_clock::now();
    write_banner(message_, version);
    write_title(message_, job_.model().title);
    for (const Diagnostic& d : job_.warnings.items()) json_.add_warning("", d);
    if (!units().stated)
      remarks_.say("no-units", "the dataset states no UNITS: the units consistency factor is taken as 1");
    remarks_.say(system().layout().remarks);
    remarks_.say(settings_.remarks);
    remarks_.pass_over(settings_.passed_over);
    for (const std::string_view name : environment_.names())
      remarks_.say("environment-variable",
                   fmt::format("the environment variable {} is set and changes what this run computes", name));
    if (job_.commands.commands.empty())
      remarks_.say("no-commands", "the command file ends behind the name of the model: there is nothing to run");
    int status = done;
    for (const Command& c : job_.commands.commands) {
      write_command(message_, c.text);
      remarks_.begin(c.text);
      if (std::holds_alternative<StopCommand>(c.what)) break;
      const auto result = execute(c);
      if (result) continue;
      remarks_.report(result.error());
      status = analysis_failed;
      if (!options_.keep_going) break;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    write_footer(message_, status == done, elapsed.count());
    return finish(status) ? status : analysis_failed;
  }

 private:
  using Outcome = tl::expected<void, Failure>;

  const System& system() const { return *systems_[stage_]; }
  const Model& model() const { return system().model(); }
  const Units& units() const { return job_.model().units; }

  // The model that a command works with; what is known of the one before goes on by class and id.
  void enter_stage(std::size_t stage) {
    if (stage == stage_) return;
    const std::size_t before = std::exchange(stage_, stage);
    if (started_) {
      point_ = carried_over(*systems_[before], point_, system(), job_.stages[stage].restated);
      restated_velocity_ = job_.stages[stage].restated.velocities;
    } else {
      const double tolerance = point_.redundancy_tolerance;
      point_ = system().drawn();
      point_.redundancy_tolerance = tolerance;
    }
    consistent_ = false;
    at_rest_.reset();
    remarks_.say_what_is_new(system().layout().remarks, systems_[before]->layout().remarks);
  }

  // Elements that are not in the model since the last edit.
  void write_deactivated() {
    const std::set<std::string> before = std::exchange(inactive_, {});
    for (const auto& set : model().sets) {
      if (set->active) continue;
      for (const ElementLabel& label : set->labels) {
        const std::string name = label.full_text();
        inactive_.insert(name);
        if (before.contains(name)) continue;
        fmt::print(message_, "   Deactivated {}, force/torque values will be zero in function-expression references.\n",
                   name);
      }
    }
  }

  void apply(const SettingCommand& setting) {
    if (setting.equilibrium) setting.equilibrium->apply(settings_.equilibrium);
    if (setting.initial_conditions) {
      setting.initial_conditions->apply(settings_.initial_conditions);
      point_.redundancy_tolerance = settings_.initial_conditions.error.value_or(OperatingPoint().redundancy_tolerance);
    }
    remarks_.say(setting.remarks);
    remarks_.pass_over(setting.passed_over);
  }

  Outcome execute(const Command& c) {
    enter_stage(c.stage);
    if (const auto* simulate = std::get_if<SimulateCommand>(&c.what)) {
      if (simulate->kind == SimulateCommand::Kind::statics) return statics(c);
      at_rest_.reset();
      if (auto ready = initial(); !ready) return ready;
      const OperatingState state = operating_state(system(), point_);
      show(StepKind::initial_conditions, state);
      json_.add(c.text, state);
      return {};
    }
    if (const auto* linear = std::get_if<LinearCommand>(&c.what)) return run_linear(c, *linear);
    if (const auto* variable = std::get_if<EnvironmentCommand>(&c.what)) {
      if (!environment_.set(variable->name))
        remarks_.say("environment-variable",
                     fmt::format("the environment variable {} means nothing here and is passed over", variable->name));
      json_.add_plain(c.text, point_.time);
    }
    if (const auto* setting = std::get_if<SettingCommand>(&c.what)) {
      apply(*setting);
      json_.add_plain(c.text, point_.time);
    }
    if (std::holds_alternative<EditCommand>(c.what)) {
      write_deactivated();
      json_.add_plain(c.text, point_.time);
    }
    if (const auto* passive = std::get_if<PassiveCommand>(&c.what)) {
      remarks_.say("passed-over",
                   fmt::format("the command {} has no effect on linear models and is passed over", passive->name));
      json_.add_plain(c.text, point_.time);
    }
    return {};
  }

  Outcome initial() {
    if (consistent_) return {};
    Findings findings;
    write_begin(message_, "Displacement Initial Conditions");
    auto op = assemble_position(system(), point_, findings, started_ ? Starts::ignored : Starts::held);
    if (!op) return tl::unexpected(op.error());
    write_end(message_, "Displacement Initial Conditions");
    write_begin(message_, "Velocity Initial Conditions");
    // An edited model goes on with the velocities it had.
    const bool goes_on = started_ && !restated_velocity_;
    op = goes_on ? reconcile_velocity(system(), std::move(*op), findings)
                 : initial_velocity(system(), std::move(*op), findings);
    if (!op) return tl::unexpected(op.error());
    write_end(message_, "Velocity Initial Conditions");
    write_begin(message_, "Acceleration Initial Conditions");
    op = solve_acceleration(system(), std::move(*op), findings);
    if (!op) return tl::unexpected(op.error());
    write_end(message_, "Acceleration Initial Conditions");
    accept(std::move(*op), findings);
    return {};
  }

  Outcome statics(const Command& c) {
    Findings findings;
    StaticsReport report;
    write_begin(message_, "Static Solution");
    StaticsOptions options = statics_options(settings_.equilibrium);
    options.restore_velocities = !environment_.statics_stay_at_rest;
    ProgressLine line(quiet_ ? nullptr : &out_);
    options.progress = [&](int iteration, double imbalance) {
      line.show(
          [&] { return fmt::format("static equilibrium: iteration {}, imbalance {:.2e}", iteration, imbalance); });
    };
    auto op = static_operating_point(system(), point_, options, report, findings);
    line.clear();
    if (!op) return tl::unexpected(op.error());
    at_rest_ = std::move(report.at_rest);
    write_static_result(message_, report.iterations, report.imbalance);
    write_end(message_, "Static Solution");
    accept(std::move(*op), findings);
    const StaticResult result{report.iterations, report.imbalance, stability_of(system(), *at_rest_),
                              operating_state(system(), *at_rest_)};
    fmt::print(message_, "  Stability: {}\n", result.stability.text());
    if (!quiet_)
      fmt::print(out_, "static equilibrium after {} iterations, imbalance {:.3e}, {}\n", result.iterations,
                 result.imbalance, result.stability.text());
    show(StepKind::statics, result.at_rest);
    // Velocities of the dataset that have come back make another point of it.
    shown_ = std::all_of(point_.velocity.begin(), point_.velocity.end(), [](double v) { return v == 0; });
    json_.add(c.text, result);
    return {};
  }

  // The point in all files that have it, and on the terminal as far as it is wanted there.
  void show(StepKind kind, const OperatingState& state) {
    write_operating_state(message_, state, units());
    if (results_) results_->add(kind, state);
    if (!quiet_ && options_.state) write_operating_state(out_, state, units());
    if (!quiet_ && !options_.state && kind == StepKind::statics)
      write_operating_state(out_, state, units(), short_tables);
    shown_ = true;
  }

  void accept(OperatingPoint op, const Findings& findings) {
    point_ = std::move(op);
    consistent_ = started_ = true;
    shown_ = false;
    restated_velocity_ = false;
    std::vector<std::string> rows;
    for (const std::int32_t r : findings.redundant_rows) rows.push_back(system().row_text(r));
    if (rows != redundant_) write_redundant(message_, point_.time, rows);
    redundant_ = std::move(rows);
    remarks_.say(findings.warnings);
  }

  // Without reconciliation LINEAR takes the static solution as it was found; any other point is consistent anyway.
  const OperatingPoint& point_of(const LinearCommand& command) const {
    return at_rest_ && (command.original || environment_.without_reconciliation) ? *at_rest_ : point_;
  }

  Outcome run_linear(const Command& c, const LinearCommand& command) {
    if (auto ready = initial(); !ready) return ready;
    LinearOptions options;
    const Model& model = this->model();
    if (command.pstate) options.pstate = model.find("PSTATE", *command.pstate);
    if (command.pinput) options.pinput = model.find("PINPUT", *command.pinput);
    if (command.poutput) options.poutput = model.find("POUTPUT", *command.poutput);
    if (command.rm) options.rm = *model.find_marker(*command.rm);
    options.without_damping = command.without_damping;
    options.principal_states = command.original || environment_.principal_states;
    options.without_rate_coupling = command.original || environment_.without_rate_coupling;
    const OperatingPoint& point = point_of(command);
    auto linear = linearize(system(), point, options);
    if (!linear) return tl::unexpected(linear.error());
    remarks_.say(linear->warnings);
    if (linear->model.states.empty())
      return tl::unexpected(Failure{
          "linear analysis", "the model has no states: neither degrees of freedom nor differential states", {}});

    const OperatingState state = operating_state(system(), point);
    if (!shown_ && &point == &point_) show(StepKind::initial_conditions, state);
    if (command.option == LinearOption::mkb) {
      auto form = second_order(linear->model, linear->first_order);
      if (!form) return tl::unexpected(form.error());
      note_options(*form, command);
      if (auto written = write_matrices(command, named_matrices(*form)); !written) return written;
      write_matrix_states(message_, *form);
      if (results_ && !settings_.results.without_linear) results_->add(*form);
      json_.add(c.text, *form);
      json_.add_point(state);
      tell_of_matrices("second-order", form->states.size(), command);
      return {};
    }
    if (command.option == LinearOption::statemat) {
      note_options(linear->model, command);
      if (auto written = write_matrices(command, named_matrices(linear->model)); !written) return written;
      write_matrix_states(message_, linear->model);
      json_.add(c.text, linear->model);
      json_.add_point(state);
      if (results_ && !settings_.results.without_linear) results_->add(linear->model);
      tell_of_matrices("state", linear->model.states.size(), command);
      return {};
    }
    if (linear->model.states.size() > 1000) {
      fmt::print(err_, "computing the eigenvalues of {} states ...\n", linear->model.states.size());
    }
    const std::clock_t begun = std::clock();
    auto modes = eigensolve(*linear, command.without_vectors ? Vectors::none : Vectors::right);
    if (!modes) return tl::unexpected(modes.error());
    const double cpu_seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    if (!command.without_vectors) {
      clear_still_modes(system(), point, *linear, *modes);
      name_movers(system(), point, *linear, *modes);
      map_shapes(system(), *linear, *modes);
    }
    modes->rm = command.rm.value_or(0);
    modes->pstate = command.pstate.value_or(0);
    modes->without_damping = command.without_damping;
    modes->original = command.original;
    remarks_.say(cautions(system(), point, *linear, *modes));
    // All that this command has to say is in the files of the run, or nothing of it.
    if (command.wants_tables()) {
      const auto tables = mode_tables(command, system(), point, *linear, *modes);
      if (!tables) return tl::unexpected(tables.error());
      tables_ << *tables;
    }
    write_eigensolution(message_, *modes, cpu_seconds);
    json_.add(c.text, *modes);
    json_.add_point(state);
    if (results_ && !settings_.results.without_linear) results_->add(*modes);
    warn_of_missing_modes(command, modes->modes.size());
    if (!quiet_) {
      fmt::print(out_, "{} at time {:g}\n", c.text, modes->time);
      write_eigen_table(out_, *modes, units().frequency(), options_.bounds);
      if (command.wants_tables()) fmt::print(out_, "the tables of modes are in {}.txt\n", job_.prefix);
    }
    return {};
  }

  void tell_of_matrices(std::string_view which, std::size_t states, const LinearCommand& command) {
    if (quiet_) return;
    fmt::print(out_, "{} matrices of {} states: {}{}\n", which, states, linear_path(job_, command.file),
               command.format == "MATLAB" ? "*, a file each" : "");
  }

  template <class Matrices>
  static void note_options(Matrices& m, const LinearCommand& command) {
    m.rm = command.rm.value_or(0);
    m.pstate = command.pstate.value_or(0);
    m.without_damping = command.without_damping;
    m.original = command.original;
  }

  // Tables of modes that are not there.
  void warn_of_missing_modes(const LinearCommand& command, std::size_t modes) {
    const auto look = [&](std::string_view name, const LinearCommand::Modes& wanted) {
      if (wanted.numbers.empty()) return;
      const auto all = std::numeric_limits<std::int64_t>::max();
      const std::int64_t last = wanted.numbers.back(), count = static_cast<std::int64_t>(modes);
      if (last <= count || last == all) return;
      remarks_.say("missing-mode", fmt::format("{} asks for {} {}, the eigensolution has {} {}", name,
                                               wanted.numbers.front() == last ? "mode" : "modes up to", last, count,
                                               count == 1 ? "mode" : "modes"));
    };
    look("COORDS", command.coordinates), look("KINETIC", command.kinetic), look("STRAIN", command.strain);
    look("DISSIPAT", command.dissipation), look("MRANGE", command.markers);
    look("ENERGY_PER_MODE", command.energy_per_mode), look("MASS_PER_MODE", command.mass_per_mode);
  }

  Outcome write_matrices(const LinearCommand& command, const std::vector<NamedMatrix>& matrices) {
    const auto result = files_.add(matrix_files(linear_path(job_, command.file), command.format, matrices));
    if (!result) return tl::unexpected(Failure{"linear analysis", result.error(), {}});
    return {};
  }

  // All files appear together at the end of the run.
  bool finish(int status) {
    std::vector<RunFiles::Planned> last;
    if (!tables_.view().empty()) last.push_back({job_.prefix + ".txt", [&](std::ostream& o) { o << tables_.view(); }});
    if (results_) {
      const auto ending = status == done ? ResultsFile::Ending::successful : ResultsFile::Ending::failed;
      last.push_back({job_.prefix + ".res",
                      [this, ending](std::ostream& o) { results_->write(o, std::string(version), ending); }});
    }
    last.push_back({job_.prefix + ".msg", [&](std::ostream& o) { o << message_.view(); }});
    if (!options_.json.empty())
      last.push_back({options_.json, [&, status](std::ostream& o) {
                        json_.finish(units(), status, planned_names(last));
                        json_.write(o);
                      }});
    auto result = files_.add(last);
    if (result) result = files_.commit(out_);
    if (!result) fmt::print(err_, "error: {}\n", result.error());
    if (result) tell_of_files(status);
    return result.has_value();
  }
  void tell_of_files(int status) const {
    const std::vector<std::string> names = files_.names();
    if (quiet_ || names.empty()) return;
    if (status != done) {
      fmt::print(err_, "wrote {}\n", fmt::join(names, ", "));
      return;
    }
    for (const std::string& name : names) fmt::print(out_, "wrote {}\n", name);
  }
  // Of all files of the run.
  std::vector<std::string> planned_names(const std::vector<RunFiles::Planned>& last) const {
    std::vector<std::string> list = files_.names();
    for (const RunFiles::Planned& p : last) list.push_back(p.path);
    return list;
  }

  const SessionOptions& options_;
  Job job_;
  std::ostream& out_;
  std::ostream& err_;
  bool quiet_;
  Settings settings_;
  std::vector<std::shared_ptr<const System>> systems_;  // of the stages
  Diagnostics problems_;                                // why there is none
  std::size_t stage_ = 0;
  std::set<std::string> inactive_;  // what is said already
  OperatingPoint point_;
  bool consistent_ = false;
  bool shown_ = false;              // the point, where points are shown
  bool started_ = false;            // an analysis has been made
  bool restated_velocity_ = false;  // and then a command stated where something starts
  Environment environment_ = read_environment();
  std::optional<OperatingPoint> at_rest_;  // what the last static analysis found, if no other one came after it
  std::vector<std::string> redundant_;
  std::ostringstream message_, tables_;
  JsonResults json_;
  Remarks remarks_{err_, message_, json_, job_.prefix + ".msg"};
  std::optional<ResultsFile> results_;  // where the dataset has RESULTS with XRF
  RunFiles files_;
};

}  // namespace

int run_session(const SessionOptions& options, std::ostream& out, std::ostream& err) {
  auto job = load_job(options, err);
  if (!job) return wrong_input;
  if (job->commands.commands.empty() && job->from_command_line) {
    fmt::print(err, "error: {} states a model, and no command says what to do with it\n", options.file);
    fmt::print(err, "hint: dynalin run {} -c simulate/statics -c linear/eigensol\n", options.file);
    return wrong_usage;
  }
  Diagnostics unwritable;
  check_permissions(*job, options, unwritable);
  err << render(unwritable);
  if (unwritable.has_errors()) return wrong_input;
  Session session(options, std::move(*job), out, err);
  return session.sound() ? session.run() : wrong_input;
}

int check_file(const SessionOptions& options, std::ostream& out, std::ostream& err) {
  auto job = load_job(options, err);
  if (!job || !Session(options, std::move(*job), out, err).sound()) return wrong_input;
  fmt::print(out, "{}: no errors\n", options.file);
  return done;
}

}  // namespace dynalin
