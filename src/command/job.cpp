#include "command/job.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "elements/catalogue.h"

namespace dynalin {

namespace {

namespace fs = std::filesystem;

SourceRef read_source(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) return nullptr;
  std::ostringstream text;
  text << in.rdbuf();
  return std::make_shared<const SourceText>(path, text.str());
}

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
    const bool is_dataset = has_extension(file, ".adm");
    std::string dataset_path = file;
    job.folder = fs::path(file).parent_path().string();
    if (is_dataset) {
      std::string text;
      for (const std::string& c : options_.commands) text += c + "\n";
      auto parsed = parse_commands(std::make_shared<const SourceText>("command line", text));
      take(std::move(parsed), job);
    } else {
      const SourceRef source = read_source(file);
      if (!source) return missing(file);
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
    const SourceRef source = read_source(dataset_path);
    if (!source) {
      if (is_dataset) return missing(dataset_path);
      diagnostics_.error("missing-model", job.commands.model_at,
                         fmt::format("the dataset {} cannot be read", dataset_path));
      return fail();
    }
    keep_.push_back(source);
    auto parsed = parse_dataset(source);
    const bool read = !parsed.diagnostics.has_errors();
    diagnostics_.append(std::move(parsed.diagnostics));
    job.dataset = std::make_shared<const Dataset>(std::move(parsed.value));
    auto built = build_model(job.dataset, catalogue());
    // Statements that could not be read leave gaps that the model would only complain about again.
    if (read || built.diagnostics.has_errors()) diagnostics_.append(std::move(built.diagnostics));
    job.model = std::move(built.value);
    if (!diagnostics_.has_errors()) check_ids(job);
    read_results_options(job);
    if (diagnostics_.has_errors()) return fail();
    err_ << render(diagnostics_);
    job.prefix = !options_.output_prefix.empty() ? options_.output_prefix : default_prefix(job, dataset_path);
    return job;
  }

 private:
  void take(Parsed<CommandFile> parsed, Job& job) {
    job.commands = std::move(parsed.value);
    diagnostics_.append(std::move(parsed.diagnostics));
  }
  std::string default_prefix(const Job& job, const std::string& dataset_path) const {
    const std::string name =
        job.commands.output_prefix.empty() ? fs::path(dataset_path).stem().string() : job.commands.output_prefix;
    return (fs::path(job.folder) / name).string();
  }
  std::nullopt_t missing(const std::string& path) {
    fmt::print(err_, "error: {} cannot be read\n", path);
    return std::nullopt;
  }
  std::nullopt_t fail() {
    err_ << render(diagnostics_);
    return std::nullopt;
  }
  // RESULTS/XRF asks for the results file in XML; other contents of it are not written here.
  static void read_results_options(Job& job) {
    constexpr std::int64_t digits_unless_stated = 17;
    for (const Statement& s : job.dataset->statements) {
      if (s.name != "RESULTS") continue;
      bool xrf = false;
      std::int64_t digits = digits_unless_stated;
      static constexpr std::array<std::string_view, 2> names = {"XRF", "DECIMALPLACES"};
      for (const WrittenArgument& a : s.arguments) {
        const auto which = find_keyword(a.name.text(), names);
        if (!which) continue;
        if (*which == 0) xrf = true;
        if (*which == 1 && !a.value.empty()) digits = static_cast<std::int64_t>(a.value.front().value);
      }
      if (xrf) job.xrf_digits = static_cast<int>(std::clamp<std::int64_t>(digits, 1, 17));
    }
  }
  // Ids that commands refer to must exist before anything runs.
  void check_ids(const Job& job) {
    for (const Command& c : job.commands.commands) {
      const auto* linear = std::get_if<LinearCommand>(&c.what);
      if (!linear) continue;
      const auto need = [&](const std::optional<std::int64_t>& id, std::string_view statement, bool exists) {
        if (id && !exists)
          diagnostics_.error("unknown-element", c.at,
                             fmt::format("the command refers to {}/{}, which does not exist", statement, *id));
      };
      const auto found = [&](const std::optional<std::int64_t>& id, std::string_view statement) {
        return id && job.model->find(statement, *id).has_value();
      };
      need(linear->pstate, "PSTATE", found(linear->pstate, "PSTATE"));
      need(linear->pinput, "PINPUT", found(linear->pinput, "PINPUT"));
      need(linear->poutput, "POUTPUT", found(linear->poutput, "POUTPUT"));
      need(linear->modal_rm, "MARKER", linear->modal_rm && job.model->find_marker(*linear->modal_rm).has_value());
      for (const std::int64_t id : linear->marker_list) {
        need(id, "MARKER", job.model->find_marker(id).has_value());
      }
      const auto rm = linear->rm ? job.model->find_marker(*linear->rm) : std::nullopt;
      need(linear->rm, "MARKER", rm.has_value());
      if (rm && job.model->marker(*rm).floating)
        diagnostics_.error("floating-marker", c.at, fmt::format("RM=MARKER/{} is floating", *linear->rm));
    }
  }

  const SessionOptions& options_;
  std::ostream& err_;
  Diagnostics diagnostics_;
  std::vector<SourceRef> keep_;
};

}  // namespace

std::optional<Job> load_job(const SessionOptions& options, std::ostream& err) { return Loader(options, err).load(); }

}  // namespace dynalin
