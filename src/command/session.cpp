#include "command/session.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "analysis/static_settings.h"
#include "command/environment.h"
#include "command/failure_text.h"
#include "command/job.h"
#include "command/mode_tables.h"
#include "command/output_plan.h"
#include "command/progress_line.h"
#include "linear/cautions.h"
#include "linear/eigen.h"
#include "linear/mode_shapes.h"
#include "linear/second_order.h"
#include "linear/still_modes.h"
#include "output/json.h"
#include "output/matrices.h"
#include "output/message_file.h"
#include "output/output_file.h"
#include "output/results_file.h"
#include "system/carry_over.h"

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
    for (const Job::Stage& s : job_.stages)
      systems_.push_back(std::make_unique<System>(
          s.model, SystemOptions{options.pade ? DelayReading::pade : DelayReading::first_order}));
    point_ = system().drawn();
    if (job_.xrf_digits > 0) results_.emplace(job_.model().title, job_.xrf_digits);
  }

  // What only showed while the equations were made: wrong input like any other.
  bool sound() const {
    for (const auto& s : systems_) {
      if (!s->layout().problems.has_errors()) continue;
      fmt::print(err_, "{}", render(s->layout().problems));
      return false;
    }
    return true;
  }

  int run() {
    const auto start = std::chrono::steady_clock::now();
    write_banner(message_, version);
    write_title(message_, job_.model().title);
    if (!job_.model().units.stated) remark("the dataset states no UNITS: the units consistency factor is taken as 1");
    for (const std::string& text : system().layout().remarks) remark(text);
    for (const std::string& text : settings_.remarks) remark(text);
    pass_over(settings_.passed_over);
    for (const std::string_view name : environment_.names())
      remark(fmt::format("the environment variable {} is set and changes what this run computes", name));
    int status = done;
    for (const Command& c : job_.commands.commands) {
      write_command(message_, c.text);
      if (std::holds_alternative<StopCommand>(c.what)) break;
      const auto result = execute(c);
      if (result) continue;
      report(c, result.error());
      status = analysis_failed;
      if (!options_.keep_going) break;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    write_footer(message_, status == done, elapsed.count());
    if (!finish()) return analysis_failed;
    return status;
  }

 private:
  using Outcome = tl::expected<void, Failure>;

  const System& system() const { return *systems_[stage_]; }
  const Model& model() const { return system().model(); }

  // The model that a command works with; what is known of the one before goes on by class and id.
  void enter_stage(std::size_t stage) {
    if (stage == stage_) return;
    const std::size_t before = std::exchange(stage_, stage);
    if (started_) {
      point_ = carried_over(*systems_[before], point_, system(), job_.stages[stage].restated);
      restated_velocity_ = job_.stages[stage].restated.velocities;
    } else {
      point_ = system().drawn();
    }
    consistent_ = false;
    at_rest_.reset();
    const std::vector<std::string>& said = systems_[before]->layout().remarks;
    for (const std::string& text : system().layout().remarks) {
      if (std::find(said.begin(), said.end(), text) == said.end()) remark(text);
    }
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

  // Settings that nothing acts on are named once a run.
  void pass_over(const std::vector<std::string>& settings) {
    std::vector<std::string> fresh;
    for (const std::string& s : settings) {
      if (passed_over_.insert(s).second) fresh.push_back(s);
    }
    if (!fresh.empty())
      remark(fmt::format("nothing here acts on {}, which {} passed over", fmt::join(fresh, ", "),
                         fresh.size() == 1 ? "is" : "are"));
  }

  void apply(const SettingCommand& setting) {
    if (setting.equilibrium) setting.equilibrium->apply(settings_.equilibrium);
    if (setting.initial_conditions) {
      setting.initial_conditions->apply(settings_.initial_conditions);
      for (const auto& s : systems_) s->state_settings(settings_.initial_conditions);
    }
    for (const std::string& text : setting.remarks) remark(text);
    pass_over(setting.passed_over);
  }

  Outcome execute(const Command& c) {
    enter_stage(c.stage);
    if (const auto* simulate = std::get_if<SimulateCommand>(&c.what)) {
      Outcome outcome = simulate->kind == SimulateCommand::Kind::statics ? statics() : initial();
      if (simulate->kind != SimulateCommand::Kind::statics) at_rest_.reset();
      if (outcome) json_.add_plain(c.text, point_.time);
      return outcome;
    }
    if (const auto* linear = std::get_if<LinearCommand>(&c.what)) return run_linear(c, *linear);
    if (const auto* variable = std::get_if<EnvironmentCommand>(&c.what)) {
      if (!environment_.set(variable->name))
        remark(fmt::format("the environment variable {} means nothing here and is passed over", variable->name));
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
      remark(fmt::format("the command {} has no effect on linear models and is passed over", passive->name));
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

  Outcome statics() {
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
    const std::string stability = stability_text();
    fmt::print(message_, "  Stability: {}\n", stability);
    if (!quiet_)
      fmt::print(out_, "static equilibrium after {} iterations, imbalance {:.3e}, {}\n", report.iterations,
                 report.imbalance, stability);
    return {};
  }

  // Whether a small disturbance of the equilibrium grows, by the eigenvalues of its linear model: that of the solution
  // itself, without the velocities of the dataset that may have come back.
  std::string stability_text() const {
    constexpr std::size_t affordable = 300;
    if (system().coordinates() > affordable) return "stability not examined";
    const auto linear = linearize(system(), *at_rest_, {});
    if (!linear) return "stability not known: " + linear.error().message;
    const auto modes = eigensolve(*linear, Vectors::none);
    if (!modes) return "stability not known: " + modes.error().message;
    double largest = 0;
    for (const EigenMode& m : modes->modes) largest = std::max(largest, std::abs(m.eigenvalue_hz));
    std::size_t growing = 0;
    for (const EigenMode& m : modes->modes) growing += m.eigenvalue_hz.real() > 1e-7 * largest;
    if (growing == 0) return "nothing grows";
    return fmt::format("unstable: {} {}", growing, growing == 1 ? "mode grows" : "modes grow");
  }

  void accept(OperatingPoint op, const Findings& findings) {
    point_ = std::move(op);
    consistent_ = started_ = true;
    restated_velocity_ = false;
    std::vector<std::string> rows;
    for (const std::int32_t r : findings.redundant_rows) rows.push_back(system().row_text(r));
    if (rows != redundant_) write_redundant(message_, point_.time, rows);
    redundant_ = std::move(rows);
    for (const std::string& w : findings.warnings) remark(w);
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
    for (const std::string& w : linear->warnings) remark(w);
    if (linear->model.states.empty())
      return tl::unexpected(Failure{
          "linear analysis", "the model has no states: neither degrees of freedom nor differential states", {}});

    if (command.option == LinearOption::mkb) {
      auto form = second_order(linear->model, linear->first_order);
      if (!form) return tl::unexpected(form.error());
      note_options(*form, command);
      if (auto written = write_matrices(command, named_matrices(*form)); !written) return written;
      write_matrix_states(message_, *form);
      if (results_ && !settings_.results.without_linear) results_->add(*form);
      json_.add(c.text, *form);
      if (!quiet_)
        fmt::print(out_, "second-order matrices of {} states written to {}\n", form->states.size(), command.file);
      return {};
    }
    if (command.option == LinearOption::statemat) {
      note_options(linear->model, command);
      if (auto written = write_matrices(command, named_matrices(linear->model)); !written) return written;
      write_matrix_states(message_, linear->model);
      json_.add(c.text, linear->model);
      if (results_ && !settings_.results.without_linear) results_->add(linear->model);
      if (!quiet_)
        fmt::print(out_, "state matrices of {} states written to {}\n", linear->model.states.size(), command.file);
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
    for (const std::string& text : cautions(system(), point, *linear, *modes)) remark(text);
    // All that this command has to say is in the files of the run, or nothing of it.
    if (command.wants_tables()) {
      const auto tables = mode_tables(command, system(), point, *linear, *modes);
      if (!tables) return tl::unexpected(tables.error());
      tables_ << *tables;
    }
    write_eigensolution(message_, *modes, cpu_seconds);
    json_.add(c.text, *modes);
    if (results_ && !settings_.results.without_linear) results_->add(*modes);
    warn_of_missing_modes(command, modes->modes.size());
    if (!quiet_) {
      fmt::print(out_, "{} at time {:g}\n", c.text, modes->time);
      write_eigen_table(out_, *modes, options_.bounds);
    }
    return {};
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
      remark(fmt::format("{} asks for {} {}, the eigensolution has {} {}", name,
                         wanted.numbers.front() == last ? "mode" : "modes up to", last, count,
                         count == 1 ? "mode" : "modes"));
    };
    look("COORDS", command.coordinates), look("KINETIC", command.kinetic), look("STRAIN", command.strain);
    look("DISSIPAT", command.dissipation), look("MRANGE", command.markers);
    look("ENERGY_PER_MODE", command.energy_per_mode), look("MASS_PER_MODE", command.mass_per_mode);
  }

  using Files = std::vector<std::unique_ptr<OutputFile>>;

  // All files of the command, or none of them.
  Outcome write_matrices(const LinearCommand& command, const std::vector<NamedMatrix>& matrices) {
    const std::string base = linear_path(job_, command.file);
    Files made;
    tl::expected<void, std::string> result;
    if (command.format != "MATLAB") {
      result = write(made, base, [&](std::ostream& o) { write_fsave(o, matrices, std::time(nullptr)); });
    } else {
      for (const NamedMatrix& m : matrices) {
        if (result) result = write(made, base + m.suffix, [&](std::ostream& o) { write_matlab(o, m); });
      }
    }
    if (!result) return tl::unexpected(Failure{"linear analysis", result.error(), {}});
    take(std::move(made));
    return {};
  }

  template <class Content>
  static tl::expected<void, std::string> write(Files& made, const std::string& path, const Content& content) {
    auto destination = find_destination(path);
    if (!destination) return tl::unexpected("cannot write " + path + ": " + destination.error());
    auto file = OutputFile::create(std::move(*destination));
    if (!file) return tl::unexpected(file.error());
    content((*file)->stream());
    made.push_back(std::move(*file));
    return made.back()->complete();
  }

  // A later command that writes the same file replaces what an earlier one wrote.
  void take(Files made) {
    for (auto& file : made) {
      const Destination& d = file->destination();
      const auto [place, fresh] = place_of_file_.emplace(d.place(), files_.size());
      if (d.kind == Destination::Kind::replaced && !fresh) {
        files_[place->second] = std::move(file);
      } else {
        files_.push_back(std::move(file));
      }
    }
  }

  void remark(const std::string& text) {
    write_block(message_, Block::warning, text);
    fmt::print(err_, "warning: {}\n", text);
  }

  void report(const Command& c, const Failure& f) {
    write_block(message_, Block::error, failure_text(f));
    fmt::print(err_, "error: {} failed\n{}\n", c.text, short_failure_text(f, job_.prefix + ".msg"));
  }

  // All files appear together at the end of the run.
  bool finish() {
    Files made;
    tl::expected<void, std::string> result;
    const auto add = [&](const std::string& path, const auto& content) {
      if (result) result = write(made, path, content);
    };
    if (!tables_.view().empty()) add(job_.prefix + ".txt", [&](std::ostream& o) { o << tables_.view(); });
    if (results_) add(job_.prefix + ".res", [&](std::ostream& o) { results_->write(o, std::string(version)); });
    add(job_.prefix + ".msg", [&](std::ostream& o) { o << message_.view(); });
    if (!options_.json.empty()) add(options_.json, [&](std::ostream& o) { json_.write(o); });
    take(std::move(made));
    if (result) result = commit(files_, out_);
    if (!result) fmt::print(err_, "error: {}\n", result.error());
    return result.has_value();
  }

  const SessionOptions& options_;
  Job job_;
  std::ostream& out_;
  std::ostream& err_;
  bool quiet_;
  Settings settings_;
  std::vector<std::unique_ptr<System>> systems_;  // of the stages
  std::size_t stage_ = 0;
  std::set<std::string> passed_over_, inactive_;  // what is said already
  OperatingPoint point_;
  bool consistent_ = false;
  bool started_ = false;            // an analysis has been made
  bool restated_velocity_ = false;  // and then a command stated where something starts
  Environment environment_ = read_environment();
  std::optional<OperatingPoint> at_rest_;  // what the last static analysis found, if no other one came after it
  std::vector<std::string> redundant_;
  std::ostringstream message_, tables_;
  JsonResults json_;
  std::optional<ResultsFile> results_;  // where the dataset has RESULTS with XRF
  Files files_;
  std::map<Destination::Place, std::size_t> place_of_file_;  // among files_
};

}  // namespace

int run_session(const SessionOptions& options, std::ostream& out, std::ostream& err) {
  auto job = load_job(options, err);
  if (!job) return wrong_input;
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
