#include "command/live_session.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>

#include "base/remark_of.h"
#include "command/interruption.h"
#include "dynalin/version.h"

namespace dynalin {

namespace {

std::string with_place(const Diagnostic& d) {
  if (!d.at.source) return d.message;
  const SourceText::Place place = d.at.source->place(d.at.offset);
  return fmt::format("{}:{}:{}: {}", d.at.source->name(), place.line, place.column, d.message);
}

}  // namespace

LiveSession::LiveSession(const SessionOptions& options, Planner& plan, std::ostream* terminal, std::ostream& out,
                         std::ostream& err)
    : options_(options),
      plan_(plan),
      terminal_(terminal),
      out_(out),
      err_(err),
      json_(options.json.empty() ? JsonResults::Kept::nothing : JsonResults::Kept::results) {
  take_remarks_of_reading();
}

void LiveSession::take_remarks_of_reading() {
  for (const Diagnostic& d : plan_.diagnostics.items()) {
    json_.add_warning("", remark_of(d));
    unwritten_.push_back(d);
  }
}

void LiveSession::write_remarks_of_reading() {
  const auto is_text_of = [](const Job& job, const SourceText* text) {
    return !job.stages.empty() && job.model().dataset->source.get() == text;
  };
  const auto comes_later = [&](const Diagnostic& d) {
    for (std::size_t k = job_ + 1; k < plan_.jobs.size(); ++k) {
      if (is_text_of(plan_.jobs[k], d.at.source)) return true;
    }
    return false;
  };
  std::vector<Diagnostic> later;
  for (Diagnostic& d : unwritten_) {
    if (comes_later(d))
      later.push_back(std::move(d));
    else
      write_block(run_->message, Block::warning, with_place(d));
  }
  unwritten_ = std::move(later);
}

bool LiveSession::begin_job() {
  Job& job = plan_.jobs[job_];
  if (job.stages.empty() && !plan_.resolve(job, 0, std::nullopt)) {
    err_ << render(plan_.diagnostics);
    json_.add_failure(job.commands.front().text, "the file cannot be reloaded", {render(plan_.diagnostics)});
    status_ = analysis_failed;
    return false;
  }
  auto opened = create_output(job.prefix + ".msg");
  if (!opened) {
    fmt::print(err_, "error: {}\n", opened.error());
    written_ = false;
    status_ = analysis_failed;
    return false;
  }
  message_ = std::move(*opened);
  run_.emplace(options_, job, terminal_, err_, json_, files_);
  run_->message.rdbuf(message_->stream().rdbuf());
  run_->preferences = preferences;
  if (!job.goes_on) run_->take_printing();
  if (job.goes_on) run_->settings = settings_, run_->settings_done = settings_done_, run_->steps.settings = output_;
  run_->steps.open_results();
  write_banner(run_->message, version);
  for (const std::string& line : job.opening) write_command(run_->message, line);
  write_title(run_->message, job.title_shown());
  for (const BodySource* body : run_->system().bodies()) {
    if (const auto line = body->summary()) fmt::print(run_->message, " {}\n", *line);
  }
  const std::string& named_by = job.opening.empty() && !job.commands.empty() ? job.commands.front().text : job.prefix;
  if (job_ > 0)
    json_.add_model(job.opening.empty() ? named_by : job.opening.back(), job.title_shown(), job.model().units);
  write_remarks_of_reading();
  Remarks& remarks = run_->remarks;
  remarks.say(remarks_on(run_->system()));
  remarks.passed_over_already(job.model().settings.passed_over);
  for (const std::string_view name : run_->environment.names())
    remarks.say("environment-variable",
                fmt::format("the environment variable {} is set and changes what this run computes", name));
  const bool nothing_runs = std::ranges::all_of(plan_.jobs, [](const Job& j) { return j.commands.empty(); });
  if (nothing_runs && !preferences.at_prompt)
    remarks.say("no-commands", "the command file ends behind the name of the model: there is nothing to run");
  return true;
}

// The model that a command works with; what is known of the one before goes on by class and id.
bool LiveSession::enter_stage_of(std::size_t command) {
  Job& job = plan_.jobs[job_];
  const std::size_t stage = job.commands[command].stage;
  if (stage == run_->stage) return true;
  if (!job.stages[stage].is_there()) {
    plan_.diagnostics = {};
    if (!plan_.make_again(job, command)) return refuse("the model cannot be made again: its files have changed");
  }
  const Job::Stage& next = job.stages[stage];
  const Diagnostics said = run_->system().layout().remarks;
  const std::size_t left = std::exchange(run_->stage, stage);
  run_->point = next.anew ? as_drawn(next.system) : continued(run_->point, next.system, next.restated);
  run_->remarks.say(new_remarks(next.system->layout().remarks, said));
  if (left > 0) job.stages[left].let_go();  // the first is the model of the job
  return true;
}

bool LiveSession::refuse(const char* why) {
  const std::string wrong = render(plan_.diagnostics);
  err_ << wrong;
  write_block(run_->message, Block::error, wrong);
  json_.add_failure(run_->command, why, {wrong});
  return false;
}

// A command whose model was not known when the run was planned.
bool LiveSession::prepare(std::size_t k) {
  plan_.diagnostics = {};
  const bool sound = plan_.resolve(plan_.jobs[job_], k, run_->stage);
  if (sound) {
    run_->remarks.say(plan_.diagnostics);
    return true;
  }
  return refuse("the command does not go with the model that was reloaded");
}

bool LiveSession::execute(std::size_t k) {
  const auto begin = [&](const Command& c) {
    write_command(run_->message, c.text);
    run_->command = c.text, run_->folder = c.folder;
    run_->remarks.begin(c.text);
  };
  begin(plan_.jobs[job_].commands[k]);
  if (plan_.jobs[job_].commands[k].stage == Command::known_when_run && !prepare(k)) return false;
  const Command& c = plan_.jobs[job_].commands[k];
  if (!enter_stage_of(k)) return false;
  if (c.action->sets()) run_->settings_done.push_back(c);
  const auto result = c.action->run(*run_);
  if (result) return true;
  run_->remarks.say(result.error().remarks);
  run_->remarks.report(result.error());
  return false;
}

bool LiveSession::goes_on_after_failure() const { return options_.keep_going && !run_->preferences.ends_after_failure; }

bool LiveSession::advance() {
  for (;;) {
    if (job_ >= plan_.jobs.size()) return true;
    if (!run_ && !begin_job()) return false;
    while (next_ < plan_.jobs[job_].commands.size()) {
      const std::size_t now = next_++;
      const bool sound = execute(now);
      if (interrupted()) {
        fmt::print(err_, "error: {} was interrupted at time {:g}\n", run_->command, run_->time());
        json_.add_failure(run_->command, "the run was interrupted", {});
        ending_ = RunEnding::interrupted;
        status_ = analysis_failed;
        return false;
      }
      if (!sound) {
        status_ = analysis_failed;
        ending_ = RunEnding::failed;
        if (!goes_on_after_failure()) return false;
      }
      if (plan_.jobs[job_].commands[now].action->stops() || (sound && run_->halted)) return false;
    }
    if (job_ + 1 == plan_.jobs.size()) return true;
    close_job();
    ++job_, next_ = 0;
  }
}

bool LiveSession::advance_at_prompt() {
  take_remarks_of_reading();
  if (run_) write_remarks_of_reading();
  const bool goes_on = advance();
  const bool failed = ending_ != RunEnding::finished || status_ != done;
  const bool over = failed && run_ && run_->preferences.ends_after_failure && !interrupted();
  if (failed && !over) {
    ending_ = RunEnding::finished, status_ = done;
    forget_interruption();
    if (run_) plan_.back_to({job_ + 1, run_->stage + 1, next_});
  }
  if (auto committed = files_.commit(out_); !committed) fmt::print(err_, "error: {}\n", committed.error());
  const std::vector<std::string> names = files_.names();
  tell_of_files({names.begin() + static_cast<std::ptrdiff_t>(std::min(told_, names.size())), names.end()});
  told_ = names.size();
  return goes_on || (failed && !over);
}

// What stands under the prefix of a job is made when it ends.
void LiveSession::close_job() {
  if (!run_) return;
  RunState& run = *run_;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const double cpu = static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
  write_footer(run.message, ending_, elapsed.count(), cpu);
  RunFiles::Result added;
  if (!run.tables.view().empty())
    added = files_.add({{run.job.prefix + ".txt", [&](std::ostream& o) { o << run.tables.view(); }}});
  if (added) added = add_growing_files();
  if (!added && std::exchange(written_, false)) fmt::print(err_, "error: {}\n", added.error());
  saved_.insert(saved_.end(), run.saved_files.begin(), run.saved_files.end());
  preferences = run.preferences;
  settings_ = run.settings, settings_done_ = run.settings_done, output_ = run.steps.settings;
  run_.reset();
}

RunFiles::Result LiveSession::add_growing_files() {
  if (std::string error = run_->steps.error(); !error.empty()) return tl::unexpected(std::move(error));
  auto files = run_->steps.finish(ending_ == RunEnding::finished ? ResultsFile::Ending::successful
                                                                 : ResultsFile::Ending::failed);
  run_->message.rdbuf(nullptr);
  files.push_back(std::move(message_));
  for (auto& file : files) {
    if (auto added = files_.add(std::move(file)); !added) return added;
  }
  return {};
}

int LiveSession::finish() {
  close_job();
  if (!written_) return analysis_failed;
  if (!options_.json.empty()) {
    std::vector<std::string> names = saved_;
    std::ranges::move(files_.names(), std::back_inserter(names));
    names.push_back(options_.json);
    const Units units =
        plan_.jobs.empty() || plan_.jobs.front().stages.empty() ? Units{} : plan_.jobs.front().model().units;
    json_.finish(units, status_, names);
    const auto added = files_.add({{options_.json, [&](std::ostream& o) { json_.write(o); }}});
    if (!added) {
      fmt::print(err_, "error: {}\n", added.error());
      return analysis_failed;
    }
  }
  if (auto committed = files_.commit(out_); !committed) {
    fmt::print(err_, "error: {}\n", committed.error());
    return analysis_failed;
  }
  std::vector<std::string> names = files_.names();
  names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(told_, names.size())));
  names.insert(names.begin(), saved_.begin(), saved_.end());
  tell_of_files(names);
  return status_;
}

void LiveSession::tell_of_files(const std::vector<std::string>& names) const {
  if (!terminal_ || names.empty()) return;
  if (status_ != done) {
    fmt::print(err_, "wrote {}\n", fmt::join(names, ", "));
    return;
  }
  for (const std::string& name : names) fmt::print(out_, "wrote {}\n", name);
}

}  // namespace dynalin
