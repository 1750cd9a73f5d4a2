// Every command of the language: what it does here, and what its arguments are. The reader of command files and the
// manual go by this table.
#pragma once

#include <span>
#include <string_view>

#include "model/kind.h"

namespace dynalin {

enum class CommandUse : std::uint8_t {
  analysis,
  model,  // changes the model: ACTIVATE, DEACTIVATE, and a class of statements, which defines one of them anew
  setting,
  run,             // which model, which environment, the end
  without_effect,  // read and passed over
  not_built,
};

struct CommandRow {
  std::string_view name;
  CommandUse use;
  std::string_view summary;                       // empty where it defines a statement anew
  std::string_view example;                       // "SIMULATE/STATICS"
  std::span<const ArgumentInfo> arguments = {};   // where it defines a statement anew those of the statement hold
  std::span<const std::string_view> acting = {};  // of a setting: arguments that something acts on
};

std::span<const CommandRow> command_table();
std::span<const std::string_view> command_names();
const CommandRow* find_command(std::string_view name);  // by its whole name, nullptr if there is none

}  // namespace dynalin
