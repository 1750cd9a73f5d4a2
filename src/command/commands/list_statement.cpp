#include "command/commands/list_statement.h"

#include <fmt/format.h>

#include "command/run_state.h"
#include "command/statement_text.h"
#include "elements/catalogue.h"
#include "model/kind_finder.h"

namespace dynalin::commands {

namespace {

const Statement* find(const Dataset& dataset, const Statement& named) {
  const KindFinder kinds(catalogue());
  for (const Statement& s : dataset.statements) {
    if (s.name == named.name && kinds.identity_of(s) == kinds.identity_of(named)) return &s;
  }
  return nullptr;
}

class ListStatement final : public CommandAction {
 public:
  explicit ListStatement(const Statement& statement) : statement_(&statement) {}
  bool reads_statements() const override { return true; }
  void check(const Model& model, const CommandPlace& place, Diagnostics& diagnostics) const override {
    if (!find(*model.dataset, *statement_))
      diagnostics.error("unknown-element", place.command(), fmt::format("{} does not exist", place.command().text()));
  }
  StudyResult<void> run(RunState& run) const override {
    print_statement(*statement_, run);
    return {};
  }

 private:
  const Statement* statement_;
};

}  // namespace

std::shared_ptr<const CommandAction> list_of_statement(const Statement& written) {
  return std::make_shared<ListStatement>(written);
}

void print_statement(const Statement& named, RunState& run) {
  if (const Statement* s = find(*run.system().model().dataset, named)) run.print(statement_list(*s));
}

}  // namespace dynalin::commands
