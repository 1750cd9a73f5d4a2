// Where a command and the values of its arguments stand, for messages about what they name.
#pragma once

#include <span>
#include <string_view>

#include "dataset/dataset.h"
#include "model/kind.h"

namespace dynalin {

class CommandPlace {
 public:
  // `written` and the names of the arguments may be missing: then there is the command alone.
  CommandPlace(const Span& command, const Statement* written, std::span<const ArgumentInfo> arguments)
      : command_(command), written_(written), arguments_(arguments) {}

  const Span& command() const { return command_; }
  // Of the argument with this full name, or that number of its list; the command where it is not written.
  Span value(std::string_view argument) const;
  Span number(std::string_view argument, std::size_t entry) const;

 private:
  const WrittenArgument* find(std::string_view argument) const;

  Span command_;
  const Statement* written_;
  std::span<const ArgumentInfo> arguments_;
};

}  // namespace dynalin
