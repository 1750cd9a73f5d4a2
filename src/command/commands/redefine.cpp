// NAME/id, ARG=… for every statement whose Kind allows it: defines arguments of one anew, the others stay.
#include "command/commands/edit.h"
#include "elements/catalogue.h"

namespace dynalin::commands {

namespace {

class Redefine final : public Edit {
 public:
  using Edit::Edit;
  void edit(DatasetEditor& editor) const override { editor.redefine(statement()); }
};

std::string_view example_of(std::string_view statement) {
  for (const Kind* kind : catalogue()) {
    if (kind->statement == statement && !kind->example.empty()) return kind->example;
  }
  return {};
}

}  // namespace

std::span<const CommandKind> redefine() {
  static const auto kinds = [] {
    std::vector<CommandKind> list;
    for (const std::string_view name : redefinable_statements())
      list.push_back(
          {.name = name, .use = CommandUse::model, .example = example_of(name), .read = read_edit<Redefine>});
    return list;
  }();
  return kinds;
}

}  // namespace dynalin::commands
