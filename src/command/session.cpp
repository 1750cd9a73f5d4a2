#include "command/session.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <sstream>

#include "analysis/statics.h"
#include "command/environment.h"
#include "command/job.h"
#include "command/mode_tables.h"
#include "linear/cautions.h"
#include "linear/eigen.h"
#include "linear/mode_shapes.h"
#include "linear/second_order.h"
#include "output/atomic_file.h"
#include "output/json.h"
#include "output/matrices.h"
#include "output/message_file.h"
#include "output/results_file.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view version = "0.1.0";

class Session {
 public:
  Session(const SessionOptions& options, Job job, std::ostream& out, std::ostream& err)
      : options_(options),
        job_(std::move(job)),
        out_(out),
        err_(err),
        system_(job_.model, {options.pade ? DelayReading::pade : DelayReading::first_order}),
        point_(system_.drawn()) {
    if (job_.xrf_digits > 0) results_.emplace(job_.model->title, job_.xrf_digits);
  }

  // What only showed while the equations were made: wrong input like any other.
  bool sound() const {
    fmt::print(err_, "{}", render(system_.layout().problems));
    return !system_.layout().problems.has_errors();
  }

  int run() {
    const auto start = std::chrono::steady_clock::now();
    write_banner(message_, version);
    write_title(message_, job_.model->title);
    if (!job_.model->units.stated) remark("the dataset states no UNITS: the units consistency factor is taken as 1");
    for (const std::string& text : system_.layout().remarks) remark(text);
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

  Outcome execute(const Command& c) {
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
    auto op = assemble_position(system_, point_, findings, Starts::held);
    if (!op) return tl::unexpected(op.error());
    write_end(message_, "Displacement Initial Conditions");
    write_begin(message_, "Velocity Initial Conditions");
    op = initial_velocity(system_, std::move(*op), findings);
    if (!op) return tl::unexpected(op.error());
    write_end(message_, "Velocity Initial Conditions");
    write_begin(message_, "Acceleration Initial Conditions");
    op = solve_acceleration(system_, std::move(*op), findings);
    if (!op) return tl::unexpected(op.error());
    write_end(message_, "Acceleration Initial Conditions");
    accept(std::move(*op), findings);
    return {};
  }

  Outcome statics() {
    Findings findings;
    StaticsReport report;
    write_begin(message_, "Static Solution");
    StaticsOptions options;
    options.restore_velocities = !environment_.statics_stay_at_rest;
    auto op = static_operating_point(system_, point_, options, report, findings);
    if (!op) return tl::unexpected(op.error());
    at_rest_ = std::move(report.at_rest);
    write_static_result(message_, report.iterations, report.imbalance);
    write_end(message_, "Static Solution");
    accept(std::move(*op), findings);
    const std::string stability = stability_text();
    fmt::print(message_, "  Stability: {}\n", stability);
    if (!options_.quiet)
      fmt::print(out_, "static equilibrium after {} iterations, imbalance {:.3e}, {}\n", report.iterations,
                 report.imbalance, stability);
    return {};
  }

  // Whether a small disturbance of the equilibrium grows, by the eigenvalues of its linear model.
  std::string stability_text() const {
    constexpr std::size_t affordable = 300;
    if (system_.coordinates() > affordable) return "stability not examined";
    const auto linear = linearize(system_, point_, {});
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
    consistent_ = true;
    std::vector<std::string> rows;
    for (const std::int32_t r : findings.redundant_rows) rows.push_back(system_.row_text(r));
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
    const Model& model = *job_.model;
    if (command.pstate) options.pstate = model.find("PSTATE", *command.pstate);
    if (command.pinput) options.pinput = model.find("PINPUT", *command.pinput);
    if (command.poutput) options.poutput = model.find("POUTPUT", *command.poutput);
    if (command.rm) options.rm = *model.find_marker(*command.rm);
    options.without_damping = command.without_damping;
    options.principal_states = command.original || environment_.principal_states;
    options.without_rate_coupling = command.original || environment_.without_rate_coupling;
    const OperatingPoint& point = point_of(command);
    auto linear = linearize(system_, point, options);
    if (!linear) return tl::unexpected(linear.error());
    for (const std::string& w : linear->warnings) remark(w);
    if (linear->model.states.empty())
      return tl::unexpected(Failure{
          "linear analysis", "the model has no states: neither degrees of freedom nor differential states", {}});

    if (command.option == LinearOption::mkb) {
      const auto form = second_order(linear->model);
      if (!form) return tl::unexpected(form.error());
      write_matrices(command, named_matrices(*form));
      json_.add(c.text, *form);
      if (!options_.quiet)
        fmt::print(out_, "second-order matrices of {} states written to {}\n", form->states.size(), command.file);
      return {};
    }
    if (command.option == LinearOption::statemat) {
      write_matrices(command, named_matrices(linear->model));
      json_.add(c.text, linear->model);
      if (results_) results_->add(linear->model);
      if (!options_.quiet)
        fmt::print(out_, "state matrices of {} states written to {}\n", linear->model.states.size(), command.file);
      return {};
    }
    if (linear->model.states.size() > 1000) {
      fmt::print(err_, "computing the eigenvalues of {} states ...\n", linear->model.states.size());
    }
    auto modes = eigensolve(*linear, command.without_vectors ? Vectors::none : Vectors::right);
    if (!modes) return tl::unexpected(modes.error());
    if (!command.without_vectors) {
      name_movers(system_, point, *linear, *modes);
      map_shapes(system_, *linear, *modes);
    }
    modes->rm = command.rm.value_or(0);
    modes->pstate = command.pstate.value_or(0);
    modes->without_damping = command.without_damping;
    modes->original = command.original;
    for (const std::string& text : cautions(system_, point, *linear, *modes)) remark(text);
    write_eigensolution(message_, *modes);
    json_.add(c.text, *modes);
    if (results_) results_->add(*modes);
    if (command.wants_tables()) {
      const auto tables = mode_tables(command, system_, point, *linear, *modes);
      if (!tables) return tl::unexpected(tables.error());
      tables_ << *tables;
    }
    if (!options_.quiet) {
      fmt::print(out_, "{} at time {:g}\n", c.text, modes->time);
      write_eigen_table(out_, *modes, options_.bounds);
    }
    return {};
  }

  void write_matrices(const LinearCommand& command, const std::vector<NamedMatrix>& matrices) {
    const std::string base = (fs::path(job_.folder) / command.file).string();
    if (command.format == "MATLAB") {
      for (const NamedMatrix& m : matrices) {
        write_matlab(new_file(base + m.suffix), m);
      }
    } else {
      write_fsave(new_file(base), matrices, std::time(nullptr));
    }
  }

  // A later command that writes the same file replaces what an earlier one wrote.
  std::ostream& new_file(const std::string& path) {
    std::erase_if(files_, [&](const auto& file) { return file->path() == path; });
    return files_.emplace_back(std::make_unique<AtomicFile>(path))->stream();
  }

  void remark(const std::string& text) {
    write_block(message_, Block::warning, text);
    fmt::print(err_, "warning: {}\n", text);
  }

  void report(const Command& c, const Failure& f) {
    std::string text = fmt::format("{}: {}", f.analysis, f.message);
    for (const std::string& d : f.details) text += "\n  " + d;
    write_block(message_, Block::error, text);
    fmt::print(err_, "error: {} failed\n{}\n", c.text, text);
  }

  // All files appear together at the end of the run.
  bool finish() {
    bool ok = true;
    const auto commit = [&](AtomicFile& file) {
      if (const auto result = file.commit(); !result) {
        fmt::print(err_, "error: {}\n", result.error());
        ok = false;
      }
    };
    for (auto& file : files_) commit(*file);
    if (!tables_.view().empty()) {
      AtomicFile text(job_.prefix + ".txt");
      text.stream() << tables_.view();
      commit(text);
    }
    if (results_) {
      AtomicFile results(job_.prefix + ".res");
      results_->write(results.stream(), std::string(version));
      commit(results);
    }
    AtomicFile message(job_.prefix + ".msg");
    message.stream() << message_.str();
    commit(message);
    if (!options_.json.empty()) {
      AtomicFile json(options_.json);
      json_.write(json.stream());
      commit(json);
    }
    return ok;
  }

  const SessionOptions& options_;
  Job job_;
  std::ostream& out_;
  std::ostream& err_;
  System system_;
  OperatingPoint point_;
  bool consistent_ = false;
  Environment environment_ = read_environment();
  std::optional<OperatingPoint> at_rest_;  // what the last static analysis found, if no other one came after it
  std::vector<std::string> redundant_;
  std::ostringstream message_, tables_;
  JsonResults json_;
  std::optional<ResultsFile> results_;  // where the dataset has RESULTS with XRF
  std::vector<std::unique_ptr<AtomicFile>> files_;
};

}  // namespace

int run_session(const SessionOptions& options, std::ostream& out, std::ostream& err) {
  auto job = load_job(options, err);
  if (!job) return wrong_input;
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
