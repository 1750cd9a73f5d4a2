#include "command/commands/list_statement.h"

#include <fmt/format.h>

#include <algorithm>

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

// What a dataset has once holds whether it is stated or not.
bool needs_no_statement(const Statement& named) { return KindFinder(catalogue()).needs_no_id(named.name); }

const ArgumentInfo* info_of(const WrittenArgument& written, const Kind& kind) {
  std::vector<std::string_view> names;
  for (const ArgumentInfo& a : kind.arguments) names.push_back(a.name);
  const auto k = find_keyword(written.name.text(), names);
  return k ? &kind.arguments[*k] : nullptr;
}

// Of what a dataset has once the numbers that are not stated, of a marker the body before it that it belongs to.
Unstated unstated_in(const Statement& s, const Model& model) {
  Diagnostics unused;
  std::size_t variant = 0;
  const Kind* kind = KindFinder(catalogue()).find(s, variant, unused);
  if (!kind) return {};
  std::vector<const ArgumentInfo*> stated;
  for (const WrittenArgument& w : s.arguments) stated.push_back(info_of(w, *kind));
  Unstated more;
  if (kind->role == Kind::Role::singleton) {
    for (const ArgumentInfo& a : kind->arguments) {
      const auto value = a.unstated();
      if (value && std::ranges::find(stated, &a) == stated.end())
        more.values.emplace_back(a.name, fmt::format("{}", *value));
    }
  }
  const bool names_body =
      std::ranges::any_of(stated, [](const ArgumentInfo* a) { return a && a->value == ValueKind::body; });
  const auto marker = kind->role == Kind::Role::marker && s.id ? model.find_marker(*s.id) : std::nullopt;
  if (marker && !names_body)
    more.sentences.push_back(
        fmt::format("it belongs to {}", model.body(model.marker(*marker).place.body).label.full_text()));
  return more;
}

class ListStatement final : public CommandAction {
 public:
  explicit ListStatement(const Statement& statement) : statement_(&statement) {}
  bool reads_statements() const override { return true; }
  void check(const Model& model, const CommandPlace& place, Diagnostics& diagnostics) const override {
    if (!find(*model.dataset, *statement_) && !needs_no_statement(*statement_))
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
  const Model& model = run.system().model();
  const Statement* s = find(*model.dataset, named);
  if (!s && !needs_no_statement(named)) return;
  const Statement none{.name = named.name, .id = named.id};
  run.print(statement_list(s ? *s : none, unstated_in(s ? *s : none, model)));
}

}  // namespace dynalin::commands
