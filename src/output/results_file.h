// The results file (.res) in XRF: operating points as the steps that readers of time histories expect, and behind them,
// in a namespace of its own that they pass over, what linear analyses found. No public sample shows the element set
// that Adams itself writes for modes.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "dynalin/modal_table.h"
#include "dynalin/results.h"
#include "output/results_steps.h"

namespace dynalin {

struct ResultsHead {
  std::string title, version;
  int digits = 17;  // significant decimals of every number (DECIMALPLACES)
  Units units;
  ResultsContents contents;
};

// Written as the run goes on. Steps follow each other in blocks; steps of a model with other entities stand in an
// <Analysis> of their own. What linear analyses found is kept until the end of the analysis that it belongs to.
class ResultsFile {
 public:
  ResultsFile(std::ostream&, ResultsHead);
  // A block of steps of one kind, and its end.
  void begin(StepKind);
  void add(const OperatingState&, const PointRequests&);
  void end();
  void add(const EigenSolution&, const std::vector<ModalTable>& tables = {});
  void add(const StateSpace&);
  void add(const SecondOrder&);
  enum class Ending : bool { successful, failed };
  void finish(Ending);

 private:
  std::string number(double) const;
  std::string table(const ModalTable&) const;
  std::string selection(const SelectedModes&) const;
  std::string matrix(std::string_view name, const DenseMatrix&) const;
  // The head of what belongs to matrices: options and channels.
  template <class Matrices>
  std::string head(const Matrices&, std::string_view option) const;
  void begin_analysis();
  void end_analysis(Ending);

  std::ostream& out_;
  ResultsHead head_;
  ResultsSteps steps_;
  std::string map_;  // of the analysis, empty before its first step
  int analyses_ = 0, data_ = 0;
  bool in_analysis_ = false, in_data_ = false;
  StepKind kind_ = StepKind::initial_conditions;
  std::map<std::string_view, int> count_;  // of blocks by kind
  std::vector<std::string> blocks_;
};

}  // namespace dynalin
