// What the library throws.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "dynalin/remark.h"

namespace dynalin {

// Wrong input or an analysis that failed. what() says all of it, with the lines that it is about.
class Error : public std::runtime_error {
 public:
  Error(const std::string& text, std::vector<Remark> found) : std::runtime_error(text), problems(std::move(found)) {}

  std::vector<Remark> problems;      // the single errors and warnings of an input; of an analysis why it failed
  std::string analysis;              // "static analysis"; empty if the input is wrong
  std::vector<std::string> details;  // of an analysis: what was tried and what is to blame, a line each
  std::vector<Remark> remarks;       // of an analysis: what was to be said before it failed
};

}  // namespace dynalin
