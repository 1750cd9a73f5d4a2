// A session at a prompt: commands come one by one, each is checked against the present model and run; a faulty one is
// reported and passed by.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "command/session.h"

namespace dynalin {

struct Model;

// Where lines come from.
class LineSource {
 public:
  virtual ~LineSource() = default;
  // Nothing at the end; an empty line where it was interrupted.
  virtual std::optional<std::string> next(const std::string& prompt, const Model*) = 0;
};

// The file of the options is a dataset, a command file whose commands run first, or nothing.
int run_prompt(const SessionOptions&, LineSource&, std::ostream& out, std::ostream& err);

}  // namespace dynalin
