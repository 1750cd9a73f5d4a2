#pragma once

#include "command/command_kind.h"

namespace dynalin::commands {

// What it names is read before anything runs: there is nothing left to do then.
class File final : public CommandAction {
 public:
  StudyResult<void> run(RunState&) const override { return {}; }
  bool needs_model() const override { return false; }

  std::string command, model, prefix;  // empty where they are not given
  Span command_at, model_at;
};

}  // namespace dynalin::commands
