#pragma once

#include "command/commands.h"
#include "output/saved_file.h"

namespace dynalin::commands {

class Reload final : public CommandAction {
 public:
  StudyResult<void> run(RunState&) const override;

  bool system = false;  // and not the states alone
  std::string file, prefix, title;
  std::shared_ptr<const SavedFile> saved;  // nothing as long as the run itself has yet to write it
  std::vector<Command> settings;           // of a system, as they were made in its run
};

}  // namespace dynalin::commands
