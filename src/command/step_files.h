// The files that get every point that a run shows: results (.res), requests (.req, .out) and graphics (.gra). They grow
// as the run goes on, under temporary names; all but the results file are made when their first point comes.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "command/job.h"
#include "command/remarks.h"
#include "output/graphics_file.h"
#include "output/output_file.h"
#include "output/request_file.h"
#include "output/request_tables.h"
#include "output/results_file.h"
#include "system/request_values.h"

namespace dynalin {

class StepFiles {
 public:
  StepFiles(const Job& job, Remarks& remarks) : job_(job), remarks_(remarks) {}

  OutputSettings settings;  // of OUTPUT, which commands may change
  // Null where the dataset has no RESULTS with XRF, and before open_results.
  ResultsFile* results() { return results_ ? &results_->file : nullptr; }
  void open_results();

  // Whether a point goes anywhere.
  bool wanted() const;
  void begin(StepKind);
  void add(const Model&, const OperatingState&, const PointRequests&);
  void end();

  // What could not be written, empty as long as all could.
  std::string error() const;
  // The files as far as they are there; nothing more is written to them.
  std::vector<std::unique_ptr<OutputFile>> finish(ResultsFile::Ending);

 private:
  template <class File>
  struct Open {
    std::unique_ptr<OutputFile> output;
    File file;
  };
  std::unique_ptr<OutputFile> make(std::string_view extension);
  void add_requests(double time, const PointRequests&);
  void add_to_tables(double time, const PointRequests&);

  const Job& job_;
  Remarks& remarks_;
  StepKind kind_ = StepKind::initial_conditions;
  std::unique_ptr<Open<ResultsFile>> results_;
  std::unique_ptr<Open<RequestFile>> requests_;
  std::unique_ptr<Open<RequestTables>> tables_;
  std::unique_ptr<Open<GraphicsFile>> graphics_;
  bool in_tables_ = false;
  std::set<std::string> said_;  // requests that the request file does not have
  std::string error_;           // the first one, but for those of the outputs themselves
};

}  // namespace dynalin
