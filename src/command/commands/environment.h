#pragma once

#include "command/command_kind.h"

namespace dynalin::commands {

class SetEnvironment final : public CommandAction {
 public:
  explicit SetEnvironment(std::string variable) : name(std::move(variable)) {}
  StudyResult<void> run(RunState&) const override;
  bool needs_model() const override { return false; }

  std::string name;
};

}  // namespace dynalin::commands
