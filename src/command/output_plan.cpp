#include "command/output_plan.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>

#include "elements/settings/output_settings.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

struct PlannedFile {
  std::string path, what;
  Span at;               // of its name in the command, nothing for those of the command line
  bool at_once = false;  // there when the command has run: a later one of the same kind may write it anew
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
        list.push_back({base + std::string(suffix), "FILE of " + c.text, c.place().value("FILE"), files.at_once});
      for (const std::string& name : files.more)
        list.push_back({command_path(c.folder, name), "FILE of " + c.text, c.place().value("FILE"), files.at_once});
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
  std::optional<std::uint32_t> warned_of;  // the place of a command
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
    if (fresh) continue;
    const PlannedFile& earlier = *other->second;
    const bool same = file.what == earlier.what;
    const std::string path = to_output ? "standard output" : file.path;
    const std::string text = same ? fmt::format("{} would be written twice, to {}", file.what, path)
                                  : fmt::format("{} and {} are one file, {}", earlier.what, file.what, path);
    // Commands one after the other: standard output has both; a file has the later point, or the later result.
    const bool of_commands = earlier.at.source && file.at.source;
    if (of_commands && (to_output || earlier.at_once == file.at_once)) {
      const bool lost = !to_output && !file.at_once && file.at.offset != warned_of;
      if (lost) diagnostics.warning("replaced-result", file.at, text, "it will hold the last result alone");
      if (lost) warned_of = file.at.offset;
      continue;
    }
    diagnostics.error("file-in-use", earlier.at.source ? earlier.at : file.at, text,
                      same ? "OUTPUT_PREFIX gives the files of a further model names of their own" : "");
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
