#pragma once

#include "command/command_kind.h"

namespace dynalin::commands {

class Save final : public CommandAction {
 public:
  StudyResult<void> run(RunState&) const override;
  CommandFiles files() const override { return {.file = file, .at_once = true}; }

  bool system = false;  // and not the states alone
  std::string file, title;
};

}  // namespace dynalin::commands
