#include "command/job.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <filesystem>

#include "base/read_file.h"
#include "command/output_plan.h"
#include "elements/catalogue.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

bool has_extension(const std::string& path, std::string_view extension) {
  std::string e = fs::path(path).extension().string();
  for (char& c : e) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return e == extension;
}

class Loader {
 public:
  Loader(const SessionOptions& options, std::ostream& err) : options_(options), err_(err) {}

  std::optional<Job> load() {
    Job job;
    const std::string& file = options_.file;
    const bool has_commands = !options_.commands.empty();
    if (has_commands && has_extension(file, ".acf")) {
      fmt::print(err_,
                 "error: -c gives commands for a dataset, and {} is a command file\nhint: run the dataset that it "
                 "names with -c, or write the commands into it\n",
                 file);
      return std::nullopt;
    }
    // A file that is run with commands of its own is a dataset whatever its name.
    const bool is_dataset = has_commands || has_extension(file, ".adm");
    std::string dataset_path = file;
    job.from_command_line = is_dataset;
    if (!is_dataset) job.folder = fs::path(file).parent_path().string();
    if (is_dataset) {
      std::string text;
      for (const std::string& c : options_.commands) text += c + "\n";
      auto parsed = parse_commands(std::make_shared<const SourceText>("command line", text));
      take(std::move(parsed), job);
    } else {
      const SourceRef source = read_source(file);
      if (!source) return missing(file, why_unread_);
      auto parsed = parse_command_file(source);
      keep_.push_back(source);
      take(std::move(parsed), job);
      if (job.commands.model.empty()) {
        if (!diagnostics_.has_errors())
          diagnostics_.error("missing-model", {source.get(), 0, 0}, "the command file names no model",
                             "its first line is the name of the dataset");
        return fail();
      }
      dataset_path = (fs::path(job.folder) / job.commands.model).string();
      if (fs::path(dataset_path).extension().empty()) dataset_path += ".adm";
    }
    read_inputs(job);
    const SourceRef source = read_source(dataset_path);
    if (!source) {
      if (is_dataset) return missing(dataset_path, why_unread_);
      diagnostics_.error("missing-model", job.commands.model_at,
                         fmt::format("the dataset {} cannot be read: {}", dataset_path, why_unread_));
      return fail();
    }
    keep_.push_back(source);
    auto parsed = parse_dataset(source);
    const bool read = !parsed.diagnostics.has_errors();
    diagnostics_.append(std::move(parsed.diagnostics));
    const auto dataset = std::make_shared<Dataset>(std::move(parsed.value));
    const bool edited = std::ranges::any_of(job.commands.commands, edits);
    auto built =
        build_model(dataset, catalogue(), {.user_value = options_.user_value, .read_once = edited ? nullptr : dataset});
    // Statements that could not be read leave gaps that the model would only complain about again.
    if (read || built.diagnostics.has_errors()) diagnostics_.append(std::move(built.diagnostics));
    job.stages.push_back({dataset, std::move(built.value), {}});
    if (!diagnostics_.has_errors()) make_stages(job);
    if (!diagnostics_.has_errors()) check_ids(job);
    read_results_options(job);
    if (diagnostics_.has_errors()) return fail();
    // Statements that were edited or replaced point into those that they came from.
    if (job.stages.size() == 1 && job.model().dataset == dataset) dataset->release_arguments();
    job.prefix = !options_.output_prefix.empty() ? options_.output_prefix : default_prefix(job, dataset_path);
    for (const Job::Stage& stage : job.stages)
      keep_.insert(keep_.end(), stage.model->further_sources.begin(), stage.model->further_sources.end());
    check_outputs(job, options_, keep_, diagnostics_);
    if (diagnostics_.has_errors()) return fail();
    err_ << render(diagnostics_);
    job.warnings = std::move(diagnostics_);
    job.sources = std::move(keep_);
    return job;
  }

 private:
  SourceRef read_source(const std::string& path) {
    auto text = read_file(path);
    if (text) return std::make_shared<const SourceText>(path, std::move(*text));
    why_unread_ = text.error();
    return nullptr;
  }
  void take(Parsed<CommandFile> parsed, Job& job) {
    job.commands = std::move(parsed.value);
    diagnostics_.append(std::move(parsed.diagnostics));
  }
  std::string default_prefix(const Job& job, const std::string& dataset_path) const {
    // Beside the dataset that the command line names, else beside the command file.
    if (job.from_command_line) return fs::path(dataset_path).replace_extension().string();
    const std::string name =
        job.commands.output_prefix.empty() ? fs::path(dataset_path).stem().string() : job.commands.output_prefix;
    return (fs::path(job.folder) / name).string();
  }
  std::nullopt_t missing(const std::string& path, const std::string& reason) {
    fmt::print(err_, "error: {} cannot be read: {}\n", path, reason);
    for (const char* extension : {".acf", ".adm"}) {
      if (std::error_code ec; fs::path(path).extension().empty() && fs::is_regular_file(path + extension, ec))
        fmt::print(err_, "hint: {}{} exists\n", path, extension);
    }
    return std::nullopt;
  }
  std::nullopt_t fail() {
    err_ << render(diagnostics_);
    return std::nullopt;
  }
  static bool edits(const Command& c) { return c.action && c.action->edits(); }
  // Commands that edit the model end a stage of the run; neighbours share the next one. What is wrong with the dataset
  // itself is reported already.
  void make_stages(Job& job) {
    std::vector<Command>& commands = job.commands.commands;
    for (std::size_t k = 0; k < commands.size(); ++k) {
      if (!edits(commands[k])) {
        commands[k].stage = job.stages.size() - 1;
        continue;
      }
      DatasetEditor editor(job.stages.back().dataset, job.commands.written, catalogue(), diagnostics_);
      for (; k < commands.size() && edits(commands[k]); ++k) {
        commands[k].action->edit(editor);
        commands[k].stage = job.stages.size();
      }
      --k;
      EditedDataset now = std::move(editor).finish();
      auto built = build_model(now.dataset, catalogue(), {options_.user_value});
      const SourceText* read_before = job.stages.front().dataset->source.get();
      for (const Diagnostic& d : built.diagnostics.items()) {
        if (d.severity == Severity::error) {
          diagnostics_.error(d.code, d.at, d.message, d.hint).notes = d.notes;
        } else if (d.at.source != read_before) {
          diagnostics_.warning(d.code, d.at, d.message, d.hint).notes = d.notes;
        }
      }
      job.stages.push_back({std::move(now.dataset), std::move(built.value), std::move(now.restated)});
      if (diagnostics_.has_errors()) return;
    }
  }
  // RESULTS/XRF asks for the results file in XML; other contents of it are not written here.
  static void read_results_options(Job& job) {
    constexpr std::int64_t digits_that_count = 17;  // more say nothing more of a number
    const ResultsSettings& results = job.model().settings.results;
    if (results.xrf)
      job.xrf_digits = static_cast<int>(
          std::clamp<std::int64_t>(results.decimal_places.value_or(digits_that_count), 1, digits_that_count));
  }
  // Files that commands name, relative to where the commands are written.
  void read_inputs(Job& job) {
    for (Command& c : job.commands.commands) {
      if (!c.action) continue;
      const InputReader read = [&](const std::string& name) {
        const SourceRef source = read_source((fs::path(job.folder) / name).string());
        if (source)
          keep_.push_back(source);
        else
          diagnostics_.error("unreadable-file", c.at, fmt::format("{} cannot be read: {}", name, why_unread_));
        return source;
      };
      if (auto ready = c.action->with_inputs(read, diagnostics_)) c.action = std::move(ready);
    }
  }
  // Ids that commands refer to must exist before anything runs.
  void check_ids(const Job& job) {
    for (const Command& c : job.commands.commands) c.action->check(*job.stages[c.stage].model, c.at, diagnostics_);
  }

  const SessionOptions& options_;
  std::ostream& err_;
  Diagnostics diagnostics_;
  std::vector<SourceRef> keep_;  // the files that were read
  std::string why_unread_;
};

}  // namespace

std::optional<Job> load_job(const SessionOptions& options, std::ostream& err) { return Loader(options, err).load(); }

}  // namespace dynalin
