#pragma once

#include "command/command_kind.h"
#include "command/linear_command.h"
#include "nastran/configuration.h"

namespace dynalin::commands {

class Linear final : public CommandAction {
 public:
  explicit Linear(LinearCommand c) : command(std::move(c)) {}
  StudyResult<void> run(RunState&) const override;
  std::shared_ptr<const CommandAction> with_inputs(const InputReader&, Diagnostics&) const override;
  void check(const Model&, const CommandPlace&, Diagnostics&) const override;
  CommandFiles files() const override;

  LinearCommand command;
  nastran::Configuration configuration;  // of an export
};

}  // namespace dynalin::commands
