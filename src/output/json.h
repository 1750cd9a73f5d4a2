// Everything a run computed, machine-readable: {"results": [an object a command], …}. docs/json.md is its manual.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "dynalin/descriptor_form.h"
#include "dynalin/history.h"
#include "dynalin/modal_table.h"
#include "dynalin/operating_state.h"
#include "dynalin/remark.h"
#include "dynalin/request_values.h"
#include "dynalin/results.h"
#include "dynalin/units.h"

namespace dynalin {

class JsonResults {
 public:
  // Where nobody will write them results are not kept: shapes of large models take more memory than all else.
  enum class Kept : bool { nothing, results };
  explicit JsonResults(Kept = Kept::results);
  ~JsonResults();
  bool keeps_results() const { return document_ != nullptr; }
  // A command without numbers of its own; one that has begun a further model has its result already.
  void add_plain(const std::string& command, double time);
  // One that prints something.
  void add_printed(const std::string& command, double time, const std::string& text);
  // A further model of the run, whose results follow.
  void add_model(const std::string& command, const std::string& title, const Units&);
  void add(const std::string& command, const EigenSolution&);
  void add(const std::string& command, const StateSpace&);
  void add(const std::string& command, const SecondOrder&);
  void add(const std::string& command, const DescriptorForm&);  // but for its matrices
  // A deck of this type, OPENBOX or CLOSEDBOX.
  void add_export(const std::string& command, std::string_view type, double time,
                  const std::vector<std::string>& files);
  // SIMULATE: the point that it found.
  void add(const std::string& command, const OperatingState&);
  void add(const std::string& command, const StaticResult&);
  // SIMULATE over time: where it ended, and what it left behind.
  void add(const std::string& command, double time, const History&);
  // The point at which the last result was linearized.
  void add_point(const OperatingState&);
  // Of the point of the last result.
  void add_requests(const std::vector<RequestValues>&);
  // Of the modes of the last result.
  void add_tables(const std::vector<ModalTable>&);
  // `command` is the one that it came up with, empty for what was found in reading.
  void add_warning(const std::string& command, const Remark&);
  void add_failure(const std::string& command, const std::string& message, const std::vector<std::string>& details,
                   std::string_view code = {});
  // What concerns the run as a whole.
  void finish(const Units&, int status, const std::vector<std::string>& files);
  void write(std::ostream&) const;  // of what was kept

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace dynalin
