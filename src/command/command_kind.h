// What the program knows of a command without knowing what it does: name, arguments, and a way to read it. One
// CommandKind ends each file of `commands`; the catalogue lists them all. The reader of command files and the manual go
// by it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command/command_place.h"
#include "command/command_reader.h"
#include "command/setting_rows.h"
#include "model/dataset_edits.h"
#include "study/study_point.h"

namespace dynalin {

class RunState;

enum class CommandUse : std::uint8_t {
  analysis,
  model,  // changes the model: ACTIVATE, DEACTIVATE, and a class of statements, which defines one of them anew
  setting,
  information,  // prints something of the point or of the run
  run,          // which model, which environment, the end
  refused,
};

// Files that a command writes besides those of every run.
struct CommandFiles {
  std::string file;                               // as written, "-" for standard output, empty for none
  std::vector<std::string_view> suffixes = {""};  // a file for each, with this behind its name
  std::vector<std::string> more = {};             // files with names of their own
  bool tables = false;                            // it writes into the file of modal tables
  // It asks for files that points of the run go to: .req, .out and .gra.
  bool requests = false, request_tables = false, graphics = false;
  bool at_once = false;  // they are there when the command has run, not at the end
};

// The text of a file that a command names; nothing after a report.
using InputReader = std::function<SourceRef(const std::string& name)>;

// What one command of a file is to do: its arguments, read and checked. Constant, and nothing of a run is in it.
class CommandAction {
 public:
  virtual ~CommandAction() = default;

  virtual StudyResult<void> run(RunState&) const = 0;
  // The same with the files that it names read; nothing where it names none, or after a report.
  virtual std::shared_ptr<const CommandAction> with_inputs(const InputReader&, Diagnostics&) const { return nullptr; }
  // Ids it refers to must exist in its model before anything runs; reports those that do not.
  virtual void check(const Model&, const CommandPlace&, Diagnostics&) const {}
  virtual CommandFiles files() const { return {}; }
  // A command that changes the model does so before anything runs.
  virtual bool edits() const { return false; }
  virtual void edit(DatasetEditor&) const {}
  // Whether it looks at the statements of the model as they are written when it runs.
  virtual bool reads_statements() const { return edits(); }
  // What can stand before a model is named waits for one.
  virtual bool needs_model() const { return true; }
  // Whether it sets something for all that follows, and does so again, without a word, where a saved system is loaded.
  virtual bool sets() const { return false; }
  virtual void restore(RunState&) const {}
  // Whether it ends the session.
  virtual bool stops() const { return false; }
};

struct CommandKind {
  std::string_view name;
  CommandUse use;
  std::string_view summary = {};                   // empty where it defines a statement anew
  std::string_view example = {};                   // "SIMULATE/STATICS"
  std::span<const ArgumentInfo> arguments = {};    // where it defines a statement anew those of the statement hold
  std::span<const std::string_view> acting = {};   // of a setting: arguments that something acts on
  SettingList list = {};                           // of a setting: what LIST shows
  std::span<const std::string_view> classes = {};  // of elements that it takes

  // Checks the arguments; nothing after a report. Without it the command is refused, for the reason in `summary`.
  std::shared_ptr<const CommandAction> (*read)(CommandReader&) = nullptr;
};

}  // namespace dynalin
