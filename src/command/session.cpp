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
#include "base/remark_of.h"
#include "command/environment.h"
#include "command/job.h"
#include "command/mode_tables.h"
#include "command/output_plan.h"
#include "command/progress_line.h"
#include "command/remarks.h"
#include "command/run_files.h"
#include "dynalin/version.h"
#include "output/json.h"
#include "output/message_file.h"
#include "output/operating_state_text.h"
#include "output/results_file.h"
#include "study/linearization.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

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
    point_ = as_drawn(systems_.front());
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
    for (const Diagnostic& d : job_.warnings.items()) json_.add_warning("", remark_of(d));
    remarks_.say(remarks_on(system()));
    remarks_.passed_over_already(settings_.passed_over);
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
      remarks_.say(result.error().remarks);
      remarks_.report(result.error());
      status = analysis_failed;
      if (!options_.keep_going) break;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    write_footer(message_, status == done, elapsed.count());
    return finish(status) ? status : analysis_failed;
  }

 private:
  using Outcome = StudyResult<void>;

  const System& system() const { return *systems_[stage_]; }
  const Model& model() const { return system().model(); }
  const Units& units() const { return job_.model().units; }

  // The model that a command works with; what is known of the one before goes on by class and id.
  void enter_stage(std::size_t stage) {
    if (stage == stage_) return;
    const std::size_t before = std::exchange(stage_, stage);
    point_ = continued(point_, systems_[stage], job_.stages[stage].restated);
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
      point_.values.redundancy_tolerance =
          settings_.initial_conditions.error.value_or(OperatingPoint().redundancy_tolerance);
    }
    remarks_.say(setting.remarks);
    remarks_.pass_over(setting.passed_over);
  }

  Outcome execute(const Command& c) {
    enter_stage(c.stage);
    if (const auto* simulate = std::get_if<SimulateCommand>(&c.what)) {
      if (simulate->kind == SimulateCommand::Kind::statics) return statics(c);
      if (auto ready = initial(); !ready) return ready;
      const OperatingState state = operating_state(system(), point_.values);
      show(StepKind::initial_conditions, state);
      json_.add(c.text, state);
      return {};
    }
    if (const auto* linear = std::get_if<LinearCommand>(&c.what)) return run_linear(c, *linear);
    if (const auto* variable = std::get_if<EnvironmentCommand>(&c.what)) {
      if (!environment_.set(variable->name))
        remarks_.say("environment-variable",
                     fmt::format("the environment variable {} means nothing here and is passed over", variable->name));
      json_.add_plain(c.text, point_.values.time);
    }
    if (const auto* setting = std::get_if<SettingCommand>(&c.what)) {
      apply(*setting);
      json_.add_plain(c.text, point_.values.time);
    }
    if (std::holds_alternative<EditCommand>(c.what)) {
      write_deactivated();
      json_.add_plain(c.text, point_.values.time);
    }
    if (const auto* passive = std::get_if<PassiveCommand>(&c.what)) {
      remarks_.say("passed-over",
                   fmt::format("the command {} has no effect on linear models and is passed over", passive->name));
      json_.add_plain(c.text, point_.values.time);
    }
    return {};
  }

  Outcome initial() {
    const auto tell = [this](Level level, bool done) {
      static constexpr std::array<std::string_view, 3> names = {"Displacement", "Velocity", "Acceleration"};
      const std::string title = fmt::format("{} Initial Conditions", names[static_cast<std::size_t>(level)]);
      done ? write_end(message_, title) : write_begin(message_, title);
    };
    const bool there = point_.consistent;
    auto found = initial_conditions(point_, tell);
    if (!found) return tl::unexpected(found.error());
    if (there)
      point_ = std::move(found->point);
    else
      accept(std::move(*found));
    return {};
  }

  Outcome statics(const Command& c) {
    write_begin(message_, "Static Solution");
    StaticsOptions options = statics_options(settings_.equilibrium);
    options.restore_velocities = !environment_.statics_stay_at_rest;
    ProgressLine line(quiet_ ? nullptr : &out_);
    options.progress = [&](int iteration, double imbalance) {
      line.show(
          [&] { return fmt::format("static equilibrium: iteration {}, imbalance {:.2e}", iteration, imbalance); });
    };
    auto found = static_equilibrium(point_, options);
    line.clear();
    if (!found) return tl::unexpected(found.error());
    write_static_result(message_, found->point.statics->iterations, found->point.statics->imbalance);
    write_end(message_, "Static Solution");
    accept(std::move(*found));
    const StaticResult result = static_result(point_);
    fmt::print(message_, "  Stability: {}\n", result.stability.text());
    if (!quiet_)
      fmt::print(out_, "static equilibrium after {} iterations, imbalance {:.3e}, {}\n", result.iterations,
                 result.imbalance, result.stability.text());
    show(StepKind::statics, result.at_rest);
    // Velocities of the dataset that have come back make another point of it.
    const std::vector<double>& velocity = point_.values.velocity;
    shown_ = std::all_of(velocity.begin(), velocity.end(), [](double v) { return v == 0; });
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

  void accept(FoundPoint found) {
    if (found.point.redundant_rows != point_.redundant_rows)
      write_redundant(message_, found.point.values.time, found.point.redundant_rows);
    point_ = std::move(found.point);
    shown_ = false;
    remarks_.say(found.remarks);
  }

  LinearRequest request_of(const LinearCommand& command) const {
    LinearRequest request;
    request.pstate = command.pstate, request.pinput = command.pinput, request.poutput = command.poutput;
    request.rm = command.rm;
    request.without_damping = command.without_damping;
    request.original = command.original;
    request.principal_states = environment_.principal_states;
    request.without_rate_coupling = environment_.without_rate_coupling;
    request.without_reconciliation = environment_.without_reconciliation;
    return request;
  }

  Outcome run_linear(const Command& c, const LinearCommand& command) {
    if (!point_.consistent) {
      if (auto ready = initial(); !ready) return ready;
    }
    const auto linear = linearized(point_, request_of(command));
    if (!linear) return tl::unexpected(linear.error());
    remarks_.say(linear->remarks());
    const StateSpace& state_space = linear->linear.model;

    const OperatingState state = operating_state(system(), linear->point);
    if (!shown_ && !linear->at_rest_as_found) show(StepKind::initial_conditions, state);
    if (command.option == LinearOption::mkb) {
      const auto form = second_order_form(*linear);
      if (!form) return tl::unexpected(form.error());
      if (auto written = write_matrices(command, named_matrices(*form)); !written) return written;
      write_matrix_states(message_, *form);
      if (results_ && !settings_.results.without_linear) results_->add(*form);
      json_.add(c.text, *form);
      json_.add_point(state);
      tell_of_matrices("second-order", form->states.size(), command);
      return {};
    }
    if (command.option == LinearOption::statemat) {
      if (auto written = write_matrices(command, named_matrices(state_space)); !written) return written;
      write_matrix_states(message_, state_space);
      json_.add(c.text, state_space);
      json_.add_point(state);
      if (results_ && !settings_.results.without_linear) results_->add(state_space);
      tell_of_matrices("state", state_space.states.size(), command);
      return {};
    }
    if (state_space.states.size() > 1000) {
      fmt::print(err_, "computing the eigenvalues of {} states ...\n", state_space.states.size());
    }
    const std::clock_t begun = std::clock();
    const auto found = modes_of(*linear, command.without_vectors ? Vectors::none : Vectors::right);
    if (!found) return tl::unexpected(found.error());
    const double cpu_seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    const EigenSolution* const modes = &found->solution;
    remarks_.say(found->remarks);
    // All that this command has to say is in the files of the run, or nothing of it.
    TablesFound tables;
    if (command.tables.any()) {
      auto made = modal_tables(*linear, *modes, command.tables);
      if (!made) return tl::unexpected(made.error());
      tables = std::move(*made);
      tables_ << mode_tables_text(command, *modes, tables);
    }
    write_eigensolution(message_, *modes, cpu_seconds);
    json_.add(c.text, *modes);
    json_.add_point(state);
    json_.add_tables(tables.tables);
    if (results_ && !settings_.results.without_linear) results_->add(*modes, tables.tables);
    remarks_.say(tables.remarks);
    if (!quiet_) {
      fmt::print(out_, "{} at time {:g}\n", c.text, modes->time);
      write_eigen_table(out_, *modes, units().frequency(), options_.bounds);
      if (command.tables.any()) fmt::print(out_, "the tables of modes are in {}.txt\n", job_.prefix);
    }
    return {};
  }

  void tell_of_matrices(std::string_view which, std::size_t states, const LinearCommand& command) {
    if (quiet_) return;
    fmt::print(out_, "{} matrices of {} states: {}{}\n", which, states, linear_path(job_, command.file),
               command.format == "MATLAB" ? "*, a file each" : "");
  }

  Outcome write_matrices(const LinearCommand& command, const std::vector<NamedMatrix>& matrices) {
    const auto result = files_.add(matrix_files(linear_path(job_, command.file), command.format, matrices));
    if (!result) return tl::unexpected(StudyFailure({"linear analysis", result.error(), {}}));
    return {};
  }

  // All files appear together at the end of the run.
  bool finish(int status) {
    std::vector<RunFiles::Planned> last;
    if (!tables_.view().empty()) last.push_back({job_.prefix + ".txt", [&](std::ostream& o) { o << tables_.view(); }});
    if (results_) {
      const auto ending = status == done ? ResultsFile::Ending::successful : ResultsFile::Ending::failed;
      last.push_back({job_.prefix + ".res", [this, ending](std::ostream& o) { results_->write(o, version, ending); }});
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
  StudyPoint point_;
  bool shown_ = false;  // the point, where points are shown
  Environment environment_ = read_environment();
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
