#pragma once

#include "command/command_kind.h"
#include "command/linear_command.h"

namespace dynalin::commands {

class Linear final : public CommandAction {
 public:
  explicit Linear(LinearCommand c) : command(std::move(c)) {}
  StudyResult<void> run(RunState&) const override;
  void check(const Model&, const Span& at, Diagnostics&) const override;
  CommandFiles files() const override;

  LinearCommand command;
};

}  // namespace dynalin::commands
