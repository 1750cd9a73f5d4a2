// Results one after the other as the program writes them with --json (docs/json.md).
#pragma once

#include <memory>
#include <string>

#include "dynalin/study.h"

namespace dynalin::library {

class Record {
 public:
  explicit Record(const Model&);
  Record(Record&&) noexcept;
  Record& operator=(Record&&) noexcept;
  ~Record();

  // What is added is of this model, or of others in the same units, matrices, modes and tables of the linear model
  // beside them; throws Error where they are not. `command` names the result, "SIMULATE/STATICS" or whatever tells it
  // from others. A point that a static analysis found is recorded with that result, a matrix or modes with the point
  // they belong to; all with their remarks.
  void add(const std::string& command, const OperatingPoint&);
  void add(const std::string& command, const Simulation&);
  void add(const std::string& command, const LinearModel&, const StateSpace&);
  void add(const std::string& command, const LinearModel&, const SecondOrder&);
  void add(const std::string& command, const LinearModel&, const DescriptorForm&);
  void add(const std::string& command, const LinearModel&, const Modes&, const ModalTables& = {});
  // Something that was done at a time and has no result.
  void add(const std::string& command, double time);
  // An analysis that failed.
  void add(const std::string& command, const Error&);

  std::string to_json() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace dynalin::library
