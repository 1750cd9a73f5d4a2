#include "command/planner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/read_file.h"
#include "command/commands/file.h"
#include "command/commands/reload.h"
#include "command/output_plan.h"
#include "dataset/characters.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

// One name for one file, however it is written, and whether it is there or not.
std::string canonical(const std::string& path) {
  std::error_code unknown;
  const fs::path p = fs::weakly_canonical(fs::absolute(path, unknown), unknown);
  return unknown ? path : p.string();
}

std::string in_folder(const std::string& folder, const std::string& name, const char* extension = nullptr) {
  const std::string path = (fs::path(folder) / name).string();
  return extension ? with_extension(path, extension) : path;
}

}  // namespace

std::string with_extension(const std::string& path, std::string_view extension) {
  if (fs::path(path).extension() == extension) return path;
  std::error_code none;
  const std::string extended = path + std::string(extension);
  const bool is_meant = fs::path(path).extension().empty() || (!fs::exists(path, none) && fs::exists(extended, none));
  return is_meant ? extended : path;
}

SourceRef Planner::read(const std::string& path, std::string& why) {
  auto text = read_file(path);
  if (!text) {
    why = text.error();
    return nullptr;
  }
  inputs.add(path);
  return texts.emplace_back(std::make_shared<const SourceText>(path, std::move(*text)));
}

// --- command files within command files -----------------------------------------------------------

std::vector<Command> Planner::expanded(CommandFile file, const std::string& folder) {
  std::vector<Command> all;
  std::vector<std::string> chain;
  if (file.source) chain.push_back(file.source->name());
  expand(std::move(file), folder, chain, all);
  return all;
}

void Planner::expand(CommandFile&& file, const std::string& folder, std::vector<std::string>& chain,
                     std::vector<Command>& into) {
  texts.push_back(file.source);
  for (Command& c : file.commands) {
    c.folder = folder;
    const auto* names = action_of<commands::File>(c);
    const Span at = names ? names->command_at : Span{};
    const std::string nested = names ? names->command : std::string();
    const bool stops = c.action && c.action->stops();
    into.push_back(std::move(c));
    if (stops) return;
    if (nested.empty()) continue;

    const std::string path = in_folder(folder, nested, ".acf");
    const auto same = [&](const std::string& other) { return canonical(other) == canonical(path); };
    if (std::ranges::any_of(chain, same)) {
      diagnostics.error("command-file-cycle", at,
                        fmt::format("the command file {} is called by itself: {} calls {}", nested,
                                    fmt::join(chain, " calls "), path));
      continue;
    }
    std::string why;
    const SourceRef source = read(path, why);
    if (!source) {
      diagnostics.error("unreadable-file", at, fmt::format("the command file {} cannot be read: {}", path, why));
      continue;
    }
    auto parsed = parse_command_file(source);
    diagnostics.append(std::move(parsed.diagnostics));
    if (!parsed.value.model.empty()) {
      auto model = std::make_shared<commands::File>();
      model->model = parsed.value.model, model->prefix = parsed.value.output_prefix;
      model->model_at = parsed.value.model_at;
      Command opening;
      opening.text = parsed.value.model, opening.at = parsed.value.model_at;
      opening.action = std::move(model), opening.written = parsed.value.written;
      parsed.value.commands.insert(parsed.value.commands.begin(), std::move(opening));
    }
    chain.push_back(path);
    expand(std::move(parsed.value), fs::path(path).parent_path().string(), chain, into);
    chain.pop_back();
    if (!into.empty() && into.back().action && into.back().action->stops()) return;
  }
}

// --- models ----------------------------------------------------------------------------------------

void Planner::begin_job(std::string prefix, std::string folder) {
  Job& begun = jobs.emplace_back();
  // --output names the files of the first model; further ones have names of their own.
  // One that ends in a slash is a folder for files that are called as they would be.
  const std::string& wanted = options_.output_prefix;
  begun.prefix = jobs.size() > 1 || wanted.empty() ? in_folder(folder, prefix)
                 : wanted.ends_with('/')           ? wanted + fs::path(prefix).filename().string()
                                                   : wanted;
  begun.opening = std::exchange(opening_, {});
  sound_ = true;
}

bool Planner::finish_stage(Job& of, std::optional<Job::Stage> stage) {
  if (!stage) return sound_ = false;
  for (const std::string& file : stage->model->input_files) inputs.add(file);
  of.stages.push_back(std::move(*stage));
  if (of.stages.size() == 1) {
    // RESULTS/XRF asks for the results file in XML; more digits say nothing more of a number.
    constexpr std::int64_t digits_that_count = 17;
    const ResultsSettings& results = of.model().settings.results;
    if (results.xrf)
      of.xrf_digits = static_cast<int>(
          std::clamp<std::int64_t>(results.decimal_places.value_or(digits_that_count), 1, digits_that_count));
  }
  return true;
}

// Of many models only those wait for the run that it comes to first. At a prompt the run has come to all of them.
void Planner::let_go_of_one_before_last(Job& of) const {
  constexpr std::size_t most_waiting = 8;
  if (takes_back_ || of.stages.size() < most_waiting + 2) return;
  Job::Stage& stage = of.stages[of.stages.size() - 2];
  if (!stage.anew) stage.let_go();
}

bool Planner::make_again(Job& of, std::size_t first) {
  const std::size_t stage = of.commands[first].stage;
  std::size_t last = first;
  while (last < of.commands.size() && of.commands[last].action->edits() && of.commands[last].stage == stage) ++last;
  std::vector<SourceRef> read;
  Diagnostics said;  // when it was made first
  auto made =
      edited_stage(of.stages[stage - 1], std::span(of.commands).subspan(first, last - first), options_, read, said);
  if (!made) {
    texts.insert(texts.end(), read.begin(), read.end());
    diagnostics.append(std::move(said));
    return false;
  }
  of.stages[stage] = std::move(*made);
  return true;
}

void Planner::open(const Opening& o) {
  finish_edits();
  std::string why;
  const SourceRef source = read(o.path, why);
  if (!source) {
    const bool on_a_line = o.at.source && o.echo.empty();
    std::string hint = on_a_line ? "the first line of a command file is the name of its dataset" : "";
    const std::string_view word = o.at.text().substr(0, o.at.text().find_first_of(" ,"));
    if (on_a_line && std::ranges::any_of(command_names(), [&](auto name) { return equal_ignoring_case(name, word); }))
      hint += fmt::format("; behind an empty line {} is a command", word);
    diagnostics.error("missing-model", o.at, fmt::format("the dataset {} cannot be read: {}", o.path, why), hint);
    sound_ = false;
    missed_ = true;
    return;
  }
  if (!o.echo.empty()) opening_.push_back(o.echo);
  // Beside the dataset that the command line names, else beside the command file.
  // One that comes through a device has no place of its own.
  fs::path place(o.path);
  if (place.parent_path() == "/dev" || place.parent_path() == "/dev/fd") place = place.filename();
  const std::string beside = place.replace_extension().string();
  const bool on_command_line = o.at.source == nullptr;
  begin_job(on_command_line    ? beside
            : o.prefix.empty() ? fs::path(o.path).stem().string()
                               : o.prefix,
            on_command_line ? std::string() : o.folder);
  known_ = true;
  const bool sound = sound_;
  auto stage = stage_of_dataset(source, options_, statements_, texts, diagnostics);
  sound_ = sound && stage.has_value();
  if (stage) finish_stage(job(), std::move(stage)), sound_ = sound;
  for (Command& c : std::exchange(early_, {})) add(std::move(c));
}

void Planner::finish_edits() {
  if (edits_.empty()) return;
  std::vector<Command> edits = std::exchange(edits_, {});
  std::size_t stage = Command::known_when_run;
  if (known() && sound_) {
    auto made = edited_stage(job().stages.back(), edits, options_, texts, diagnostics);
    if (finish_stage(job(), std::move(made))) {
      stage = job().stages.size() - 1;
      let_go_of_one_before_last(job());
    }
  }
  for (Command& c : edits) {
    c.stage = stage;
    job().commands.push_back(std::move(c));
  }
}

// --- commands --------------------------------------------------------------------------------------

void Planner::add(Command c) {
  if (!c.action) return;
  if (const auto* file = action_of<commands::File>(c)) {
    if (!file->model.empty())
      return open({in_folder(c.folder, file->model, ".adm"), file->prefix, file->model_at, c.folder, c.text});
    if (jobs.empty()) {
      opening_.push_back(c.text);
      return;
    }
  }
  if (jobs.empty() && action_of<commands::Reload>(c) == nullptr) {
    if (!c.action->needs_model()) return early_.push_back(std::move(c));
    if (!std::exchange(missed_, true))
      diagnostics.error("missing-model", c.at, fmt::format("{} needs a model, and none is named before it", c.text),
                        "FILE/MODEL=name, or the name of the dataset on the first line of the command file");
    return;
  }
  if (c.action->edits()) return edits_.push_back(std::move(c));
  finish_edits();
  if (action_of<commands::Reload>(c)) return add_reload(std::move(c));
  read_inputs(c);
  const CommandFiles files = c.action->files();
  if (files.at_once) {
    const std::string file = canonical(command_path(c.folder, files.file));
    saved_files_.insert(file), own_files_.insert(file);
  }
  if (known()) {
    c.stage = job().stages.size() - 1;
    const std::size_t said = diagnostics.items().size();
    if (sound_) c.action->check(*job().stages.back().model, c.place(), diagnostics);
    if (diagnostics.items().size() > said) keep_texts(job().stages.back(), texts);
  }
  job().commands.push_back(std::move(c));
}

void Planner::read_inputs(Command& c) {
  const InputReader read_text = [&](const std::string& name) {
    std::string why;
    const SourceRef source = read(in_folder(c.folder, name), why);
    if (!source)
      diagnostics.error("unreadable-file", c.place().value("CONFIG"), fmt::format("{} cannot be read: {}", name, why));
    return source;
  };
  if (auto ready = c.action->with_inputs(read_text, diagnostics)) c.action = std::move(ready);
}

bool Planner::load(Command& c) {
  auto action = std::make_shared<commands::Reload>(*action_of<commands::Reload>(c));
  const std::string path = in_folder(c.folder, action->file);
  const auto wrong = [&](const std::string& why) {
    diagnostics.error("unusable-save", c.place().value("FILE"),
                      fmt::format("{} cannot be reloaded: {}", action->file, why));
    return false;
  };
  auto text = read_file(path);
  if (!text) return wrong(text.error());
  auto saved = read_saved(*text);
  if (!saved) return wrong(saved.error());
  // What the run has saved itself it may save again.
  if (!own_files_.contains(canonical(path))) inputs.add(path);
  if (action->system && !saved->system)
    return wrong("it has states and no model: RELOAD/STATES takes it, where a model is");
  if (action->system) {
    std::string lines;
    for (const std::string& setting : saved->system->settings) lines += setting + "\n";
    auto parsed = parse_commands(texts.emplace_back(std::make_shared<const SourceText>(path, lines)));
    if (parsed.diagnostics.has_errors()) {
      diagnostics.append(std::move(parsed.diagnostics));
      return false;
    }
    action->settings = std::move(parsed.value.commands);
  }
  action->saved = std::make_shared<const SavedFile>(std::move(*saved));
  c.action = std::move(action);
  return true;
}

void Planner::add_reload(Command c) {
  const commands::Reload reload = *action_of<commands::Reload>(c);
  if (jobs.empty() && !reload.system) {
    diagnostics.error("missing-model", c.at, fmt::format("{} needs a model, and none is named before it", c.text),
                      "RELOAD/SYSTEM brings its own");
    return;
  }
  // What this run writes itself is there when its turn has come.
  const bool awaited = saved_files_.contains(canonical(in_folder(c.folder, reload.file)));
  const bool loaded = !awaited && !diagnostics.has_errors() && load(c);
  const bool was_known = known() && sound_;
  if (jobs.empty() || !reload.prefix.empty()) {
    std::optional<Job::Stage> now;
    if (was_known && !reload.system) now = job().stages.back();
    begin_job(reload.prefix.empty() ? fs::path(reload.file).stem().string() : reload.prefix, c.folder);
    job().title = reload.title;
    job().goes_on = !reload.system;
    if (now) {
      now->restated = {};
      finish_stage(job(), std::move(now));
    }
  }
  if (reload.system && loaded) {
    const auto& system = *action_of<commands::Reload>(c)->saved->system;
    known_ = finish_stage(job(), saved_stage(system, reload.file, options_, texts, diagnostics));
  } else if (reload.system) {
    known_ = false;
  }
  if (known() && loaded) c.stage = job().stages.size() - 1;
  job().commands.push_back(std::move(c));
  for (Command& early : std::exchange(early_, {})) add(std::move(early));
}

bool Planner::resolve(Job& of, std::size_t first, std::optional<std::size_t> stage) {
  const std::size_t errors = diagnostics.error_count();
  const auto ok = [&] { return diagnostics.error_count() == errors; };
  Command& c = of.commands[first];
  if (const auto* reload = action_of<commands::Reload>(c)) {
    if (!reload->saved && !load(c)) return false;
    reload = action_of<commands::Reload>(c);
    if (reload->system) {
      if (!finish_stage(of, saved_stage(*reload->saved->system, reload->file, options_, texts, diagnostics)))
        return false;
      stage = of.stages.size() - 1;
    } else if (!stage) {  // further files for the model of the job before
      const auto before = std::ranges::find_if(jobs, [&](const Job& j) { return &j == &of; });
      Job::Stage now = std::prev(before)->stages.back();
      now.restated = {};
      finish_stage(of, std::move(now));
      stage = 0;
    }
    c.stage = stage.value();
    return ok();
  }
  if (!c.action->edits()) {
    c.stage = stage.value();
    c.action->check(*of.stages[*stage].model, c.place(), diagnostics);
    return ok();
  }
  std::size_t last = first;
  while (last < of.commands.size() && of.commands[last].action->edits()) ++last;
  const std::span<Command> group(of.commands.data() + first, last - first);
  if (!finish_stage(of, edited_stage(of.stages[*stage], group, options_, texts, diagnostics))) return false;
  for (Command& edit : group) edit.stage = of.stages.size() - 1;
  return ok();
}

Planner::Mark Planner::mark() {
  takes_back_ = true;
  if (jobs.empty()) return {0, 0, 0};
  return {jobs.size(), jobs.back().stages.size(), jobs.back().commands.size()};
}

void Planner::await_nothing() { saved_files_.clear(); }

void Planner::back_to(const Mark& mark) {
  diagnostics = {};
  edits_.clear();
  while (jobs.size() > mark.jobs) jobs.pop_back();
  if (!jobs.empty()) {
    job().stages.resize(mark.stages);
    job().commands.resize(mark.commands);
  }
  sound_ = known_ = true;
  missed_ = false;
}

}  // namespace dynalin
