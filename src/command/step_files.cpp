#include "command/step_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ctime>

#include "dynalin/version.h"

namespace dynalin {

namespace {

std::string_view title_of(StepKind kind) {
  static constexpr std::array<std::string_view, 5> names = {"Initial conditions", "Static equilibrium",
                                                            "Quasi-static simulation", "Kinematic simulation",
                                                            "Dynamic simulation"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

std::unique_ptr<OutputFile> StepFiles::make(std::string_view extension) {
  const std::string path = job_.prefix + std::string(extension);
  auto made = create_output(path);
  if (made) return std::move(*made);
  if (error_.empty()) error_ = made.error();
  return nullptr;
}

void StepFiles::open_results() {
  if (job_.xrf_digits == 0) return;
  auto output = make(".res");
  if (!output) return;
  std::ostream& out = output->stream();
  ResultsHead head{job_.title_shown(), version, job_.xrf_digits, job_.model().units, results_contents(job_.model())};
  results_.reset(new Open<ResultsFile>{std::move(output), ResultsFile(out, std::move(head))});
}

bool StepFiles::wanted() const {
  return results_ || settings.request_file || settings.graphics_file || settings.writes_tables();
}

void StepFiles::begin(StepKind kind) {
  kind_ = kind;
  if (results_) results_->file.begin(kind);
}

void StepFiles::add(const Model& model, const OperatingState& state, const PointRequests& requests) {
  if (results_) results_->file.add(state, requests);
  if (settings.graphics_file && !graphics_) {
    if (auto output = make(".gra")) {
      std::ostream& out = output->stream();
      graphics_.reset(new Open<GraphicsFile>{std::move(output), GraphicsFile(out, model, std::time(nullptr))});
    }
  }
  if (settings.graphics_file && graphics_) graphics_->file.add(state.time, state.bodies);
  if (settings.request_file) add_requests(state.time, requests);
  if (settings.writes_tables() && !requests.infos.empty()) add_to_tables(state.time, requests);
}

void StepFiles::add_requests(double time, const PointRequests& requests) {
  if (!requests_) {
    auto output = make(".req");
    if (!output) return;
    std::ostream& out = output->stream();
    const Model& model = job_.model();
    requests_.reset(new Open<RequestFile>{
        std::move(output), RequestFile(out, model.title, model.units, requests.infos, std::time(nullptr))});
    if (const auto without = without_place_in_request_file(requests.infos); !without.empty())
      remarks_.say("not-in-request-file", fmt::format("a request file has six values of each request: {} {} not in it",
                                                      fmt::join(without, ", "), without.size() == 1 ? "is" : "are"));
  }
  for (const std::string& element : requests_->file.add(time, requests, settings)) {
    if (said_.insert(element).second)
      remarks_.say("not-in-request-file",
                   fmt::format("{} was not there when the request file began and is not in it", element));
  }
}

void StepFiles::add_to_tables(double time, const PointRequests& requests) {
  if (!tables_) {
    auto output = make(".out");
    if (!output) return;
    std::ostream& out = output->stream();
    RequestTables tables(out, job_.title_shown(), output->destination().folder);
    tables_.reset(new Open<RequestTables>{std::move(output), std::move(tables)});
  }
  if (!in_tables_) tables_->file.begin(std::string(title_of(kind_)));
  in_tables_ = true;
  if (auto added = tables_->file.add(time, requests, settings); !added && error_.empty())
    error_ = fmt::format("cannot write {}.out: {}", job_.prefix, added.error());
}

void StepFiles::end() {
  if (results_) results_->file.end();
  if (!std::exchange(in_tables_, false)) return;
  if (auto ended = tables_->file.end(); !ended && error_.empty())
    error_ = fmt::format("cannot write {}.out: {}", job_.prefix, ended.error());
}

std::string StepFiles::error() const {
  if (!error_.empty()) return error_;
  for (const OutputFile* output :
       {results_ ? results_->output.get() : nullptr, requests_ ? requests_->output.get() : nullptr,
        graphics_ ? graphics_->output.get() : nullptr, tables_ ? tables_->output.get() : nullptr}) {
    if (!output) continue;
    if (auto so_far = output->so_far(); !so_far) return so_far.error();
  }
  return {};
}

std::vector<std::unique_ptr<OutputFile>> StepFiles::finish(ResultsFile::Ending ending) {
  end();
  if (results_) results_->file.finish(ending);
  std::vector<std::unique_ptr<OutputFile>> list;
  if (results_) list.push_back(std::move(results_->output));
  if (requests_) list.push_back(std::move(requests_->output));
  if (graphics_) list.push_back(std::move(graphics_->output));
  if (tables_) list.push_back(std::move(tables_->output));
  results_.reset(), requests_.reset(), graphics_.reset(), tables_.reset();
  return list;
}

}  // namespace dynalin
