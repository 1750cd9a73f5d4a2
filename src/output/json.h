// Everything a run computed, machine-readable: {"results": [an object a command]}.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "dynalin/results.h"

namespace dynalin {

class JsonResults {
 public:
  JsonResults();
  ~JsonResults();
  void add_plain(const std::string& command, double time);  // a command without numbers of its own
  void add(const std::string& command, const EigenSolution&);
  void add(const std::string& command, const StateSpace&);
  void add(const std::string& command, const SecondOrder&);
  void write(std::ostream&) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace dynalin
