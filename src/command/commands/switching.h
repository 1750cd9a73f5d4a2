// What ACTIVATE and DEACTIVATE have in common: CLASS, ID=… or RANGE=….
#pragma once

#include <array>

#include "command/commands/edit.h"
#include "elements/catalogue.h"

namespace dynalin::commands {

// The class is a bare word.
inline constexpr std::array<ArgumentInfo, 3> switching_arguments = {{
    {.name = "class",
     .required = true,
     .is_flag = true,
     .help = "JOINT, SFORCE … : constraints, forces, sensors; the bare word"},
    {.name = "ID", .value = ValueKind::ids, .help = "the elements"},
    {.name = "RANGE", .value = ValueKind::ids, .help = "instead of ID: the first and the last id"},
}};

template <bool inactive>
class Switching final : public Edit {
 public:
  using Edit::Edit;
  void edit(DatasetEditor& editor) const override {
    editor.switch_elements(statement(), inactive, deactivatable_statements());
  }
};

template <bool inactive>
CommandKind switching(std::string_view name, std::string_view summary, std::string_view example) {
  return {.name = name,
          .use = CommandUse::model,
          .summary = summary,
          .example = example,
          .arguments = switching_arguments,
          .classes = deactivatable_statements(),
          .read = read_edit<Switching<inactive>>};
}

}  // namespace dynalin::commands
