#include "command/output_plan.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "elements/settings/output_settings.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

struct PlannedFile {
  std::string path, what;
  Span at;                  // of the command, nothing for those of the command line
  bool of_command = false;  // a later command may write the same file again
};

std::vector<PlannedFile> planned_files(const std::deque<Job>& jobs, const SessionOptions& options) {
  std::vector<PlannedFile> list;
  for (const Job& job : jobs) {
    const OutputSettings of_dataset = job.stages.empty() ? OutputSettings{} : output_settings(job.model());
    bool tables = false, requests = of_dataset.request_file, graphics = of_dataset.graphics_file,
         request_tables = of_dataset.writes_tables();
    for (const Command& c : job.commands) {
      const CommandFiles files = c.action->files();
      tables = tables || files.tables;
      requests = requests || files.requests, graphics = graphics || files.graphics;
      request_tables = request_tables || files.request_tables;
      if (files.file.empty()) continue;
      const std::string base = command_path(c.folder, files.file);
      for (const std::string_view suffix : files.suffixes)
        list.push_back({base + std::string(suffix), "FILE of " + c.text, c.at, true});
      for (const std::string& name : files.more)
        list.push_back({command_path(c.folder, name), "FILE of " + c.text, c.at, true});
    }
    if (tables) list.push_back({job.prefix + ".txt", "the file of modal tables", {}});
    if (job.xrf_digits > 0) list.push_back({job.prefix + ".res", "the results file", {}});
    if (requests) list.push_back({job.prefix + ".req", "the request file", {}});
    if (graphics) list.push_back({job.prefix + ".gra", "the graphics file", {}});
    const bool has_requests = !job.stages.empty() && job.model().has(Kind::Gives::requests);
    if (request_tables && has_requests) list.push_back({job.prefix + ".out", "the file of request tables", {}});
    list.push_back({job.prefix + ".msg", "the message file", {}});
  }
  if (!options.json.empty()) list.push_back({options.json, "--json", {}});
  return list;
}

}  // namespace

std::string command_path(const std::string& folder, const std::string& file) {
  return file == "-" ? file : (fs::path(folder) / file).string();
}

void check_outputs(const std::deque<Job>& jobs, const SessionOptions& options, const InputFiles& inputs,
                   Diagnostics& diagnostics) {
  std::map<Destination::Place, const PlannedFile*> known;
  const std::vector<PlannedFile> files = planned_files(jobs, options);
  for (const PlannedFile& file : files) {
    const auto d = find_destination(file.path);
    if (!d) {
      diagnostics.error("unwritable-file", file.at,
                        fmt::format("{} cannot write {}: {}", file.what, file.path, d.error()));
      continue;
    }
    if (d->kind == Destination::Kind::written_to) continue;
    if (const std::string* input = inputs.replaced_by(*d)) {
      diagnostics.error("file-in-use", file.at,
                        fmt::format("{} would overwrite {}, which the run reads", file.what, *input),
                        file.path == *input ? "" : fmt::format("{} is the same file", file.path));
    }
    static const Destination::Place standard_output{0, 0, "-"};
    const bool to_output = d->kind == Destination::Kind::standard_output;
    const auto [other, fresh] = known.emplace(to_output ? standard_output : d->place(), &file);
    if (fresh || (file.of_command && other->second->of_command)) continue;
    diagnostics.error(
        "file-in-use", other->second->at,
        fmt::format("{} and {} are one file, {}", other->second->what, file.what,
                    to_output ? "standard output" : file.path),
        file.what == other->second->what ? "OUTPUT_PREFIX gives the files of a further model names of their own" : "");
  }
}

void check_permissions(const std::deque<Job>& jobs, const SessionOptions& options, Diagnostics& diagnostics) {
  for (const PlannedFile& file : planned_files(jobs, options)) {
    const auto d = find_destination(file.path);
    const std::string reason = d ? why_not_writable(*d) : d.error();
    if (!reason.empty())
      diagnostics.error("unwritable-file", file.at,
                        fmt::format("{} cannot write {}: {}", file.what, file.path, reason));
  }
}

}  // namespace dynalin
