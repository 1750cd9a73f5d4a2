// Commands that change the model: nothing of them is read before the model is there, and when they run it is changed
// already.
#pragma once

#include "command/command_kind.h"

namespace dynalin::commands {

class Edit : public CommandAction {
 public:
  // The statement lives as long as the command file.
  explicit Edit(const Statement& statement) : statement_(&statement) {}
  StudyResult<void> run(RunState&) const final;
  bool edits() const final { return true; }

 protected:
  const Statement& statement() const { return *statement_; }

 private:
  // Whether it has printed something of the model that it made.
  virtual bool tell(RunState&) const { return false; }
  const Statement* statement_;
};

template <class Action>
std::shared_ptr<const CommandAction> read_edit(CommandReader& reader) {
  return std::make_shared<Action>(reader.statement());
}

}  // namespace dynalin::commands
