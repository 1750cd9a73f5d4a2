#pragma once

#include "command/command_kind.h"

namespace dynalin::commands {

class Simulate final : public CommandAction {
 public:
  enum class Kind { initial_conditions, statics };
  explicit Simulate(Kind k) : kind(k) {}
  StudyResult<void> run(RunState&) const override;

  Kind kind;
};

}  // namespace dynalin::commands
