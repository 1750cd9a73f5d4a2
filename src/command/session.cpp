#include "command/session.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <chrono>

#include "base/remark_of.h"
#include "command/output_plan.h"
#include "command/run_state.h"
#include "dynalin/version.h"
#include "output/destination.h"
#include "output/message_file.h"

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
      : options_(options), job_(std::move(job)), out_(out), err_(err) {
    const SystemOptions delays{options.pade ? DelayReading::pade : DelayReading::first_order};
    for (const Job::Stage& s : job_.stages) {
      auto system = System::make(s.model, delays);
      if (!system) {
        problems_ = std::move(system.error());
        return;
      }
      systems_.push_back(std::move(*system));
    }
    bool quiet = options.quiet || to_standard_output(options.json);
    for (const Command& c : job_.commands.commands) {
      const CommandFiles files = c.action->files();
      quiet = quiet || (!files.file.empty() && to_standard_output(command_path(job_, files.file)));
    }
    run_.emplace(options_, job_, systems_.front(), quiet ? nullptr : &out_, err_);
  }

  // What only showed while the equations were made: wrong input like any other.
  bool sound() const {
    fmt::print(err_, "{}", render(problems_));
    return !problems_.has_errors();
  }

  int run() {
    const auto start = std::chrono::steady_clock::now();
    auto opened = create_output(job_.prefix + ".msg");
    if (!opened) {
      fmt::print(err_, "error: {}\n", opened.error());
      return analysis_failed;
    }
    message_ = std::move(*opened);
    run_->message.rdbuf(message_->stream().rdbuf());
    begin();
    int status = done;
    for (const Command& c : job_.commands.commands) {
      write_command(run_->message, c.text);
      run_->command = c.text;
      run_->remarks.begin(c.text);
      enter_stage(c.stage);
      const auto result = c.action->run(*run_);
      if (result && run_->halted) break;
      if (result) continue;
      run_->remarks.say(result.error().remarks);
      run_->remarks.report(result.error());
      status = analysis_failed;
      if (!options_.keep_going) break;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    write_footer(run_->message, status == done, elapsed.count());
    return finish(status) ? status : analysis_failed;
  }

 private:
  void begin() {
    run_->steps.open_results();
    write_banner(run_->message, version);
    write_title(run_->message, job_.model().title);
    for (const Diagnostic& d : job_.warnings.items()) run_->json.add_warning("", remark_of(d));
    Remarks& remarks = run_->remarks;
    remarks.say(remarks_on(*systems_.front()));
    remarks.passed_over_already(job_.model().settings.passed_over);
    for (const std::string_view name : run_->environment.names())
      remarks.say("environment-variable",
                  fmt::format("the environment variable {} is set and changes what this run computes", name));
    if (job_.commands.commands.empty())
      remarks.say("no-commands", "the command file ends behind the name of the model: there is nothing to run");
  }

  // The model that a command works with; what is known of the one before goes on by class and id.
  void enter_stage(std::size_t stage) {
    if (stage == stage_) return;
    const std::size_t before = std::exchange(stage_, stage);
    run_->point = continued(run_->point, systems_[stage], job_.stages[stage].restated);
    run_->remarks.say_what_is_new(systems_[stage]->layout().remarks, systems_[before]->layout().remarks);
  }

  // All files appear together at the end of the run.
  bool finish(int status) {
    std::vector<RunFiles::Planned> last;
    if (!run_->tables.view().empty())
      last.push_back({job_.prefix + ".txt", [&](std::ostream& o) { o << run_->tables.view(); }});
    auto result = run_->files.add(last);
    if (result) result = add_growing_files(status);
    if (result && !options_.json.empty()) {
      std::vector<std::string> names = run_->files.names();
      names.push_back(options_.json);
      run_->json.finish(job_.model().units, status, names);
      result = run_->files.add({{options_.json, [&](std::ostream& o) { run_->json.write(o); }}});
    }
    if (result) result = run_->files.commit(out_);
    if (!result) fmt::print(err_, "error: {}\n", result.error());
    if (result) tell_of_files(status);
    return result.has_value();
  }
  RunFiles::Result add_growing_files(int status) {
    if (std::string error = run_->steps.error(); !error.empty()) return tl::unexpected(std::move(error));
    auto files = run_->steps.finish(status == done ? ResultsFile::Ending::successful : ResultsFile::Ending::failed);
    run_->message.rdbuf(nullptr);
    files.push_back(std::move(message_));
    for (auto& file : files) {
      if (auto added = run_->files.add(std::move(file)); !added) return added;
    }
    return {};
  }
  void tell_of_files(int status) const {
    const std::vector<std::string> names = run_->files.names();
    if (!run_->terminal || names.empty()) return;
    if (status != done) {
      fmt::print(err_, "wrote {}\n", fmt::join(names, ", "));
      return;
    }
    for (const std::string& name : names) fmt::print(out_, "wrote {}\n", name);
  }

  const SessionOptions& options_;
  Job job_;
  std::ostream& out_;
  std::ostream& err_;
  std::vector<std::shared_ptr<const System>> systems_;  // of the stages
  Diagnostics problems_;                                // why there is none
  std::size_t stage_ = 0;
  std::unique_ptr<OutputFile> message_;
  std::optional<RunState> run_;
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
