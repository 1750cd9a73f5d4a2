// The results file (.res) in XRF: operating points as the steps that readers of time histories expect, and behind them,
// in a namespace of its own that they pass over, what linear analyses found. No public sample shows the element set
// that Adams itself writes for modes.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dynalin/modal_table.h"
#include "dynalin/results.h"
#include "output/results_steps.h"

namespace dynalin {

class ResultsFile {
 public:
  // `digits` significant decimals of every number (DECIMALPLACES).
  ResultsFile(std::string title, int digits, Units units, ResultsSettings settings)
      : title_(std::move(title)), digits_(digits), steps_(std::move(units), std::move(settings)) {}
  void add(StepKind kind, const OperatingState& state) { steps_.add(kind, state); }
  void add(const EigenSolution&, const std::vector<ModalTable>& tables = {});
  void add(const StateSpace&);
  void add(const SecondOrder&);
  enum class Ending : bool { successful, failed };
  void write(std::ostream&, const std::string& version, Ending) const;

 private:
  std::string number(double) const;
  std::string table(const ModalTable&) const;
  std::string matrix(std::string_view name, const Eigen::MatrixXd&) const;
  // The head of what belongs to matrices: options and channels.
  template <class Matrices>
  std::string head(const Matrices&, std::string_view option) const;
  std::string title_;
  int digits_;
  ResultsSteps steps_;
  std::vector<std::string> blocks_;
};

}  // namespace dynalin
