// NAME/id, ARG=… for every statement whose Kind allows it: defines arguments of one anew, the others stay. LIST prints
// it as it is then; alone it changes nothing.
#include <algorithm>

#include "command/commands/edit.h"
#include "command/commands/list_statement.h"
#include "command/run_state.h"
#include "elements/catalogue.h"

namespace dynalin::commands {

namespace {

bool is_list(const WrittenArgument& w) {
  return !w.has_value && w.name.length == 4 &&
         find_keyword(w.name.text(), std::array<std::string_view, 1>{"LIST"}).has_value();
}

class Redefine final : public Edit {
 public:
  using Edit::Edit;
  void edit(DatasetEditor& editor) const override { editor.redefine(statement()); }

 private:
  bool tell(RunState& run) const override {
    if (std::ranges::none_of(statement().arguments, is_list)) return false;
    print_statement(statement(), run);
    return true;
  }
};

std::shared_ptr<const CommandAction> read_redefine(CommandReader& reader) {
  const auto& arguments = reader.statement().arguments;
  if (!arguments.empty() && std::ranges::all_of(arguments, is_list)) return list_of_statement(reader.statement());
  return std::make_shared<Redefine>(reader.statement());
}

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
      list.push_back({.name = name, .use = CommandUse::model, .example = example_of(name), .read = read_redefine});
    return list;
  }();
  return kinds;
}

}  // namespace dynalin::commands
