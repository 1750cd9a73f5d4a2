// Commands that have the arguments of a statement of settings, and set the same for the analyses after them.
#pragma once

#include "command/run_state.h"
#include "command/settings_list.h"
#include "elements/settings/setting_set.h"

namespace dynalin::commands {

class Setting : public CommandAction {
 public:
  StudyResult<void> run(RunState& run) const final {
    apply(run);
    run.remarks.pass_over(passed_over);
    list.empty() ? run.json.add_plain(run.command, run.time()) : run.print(settings_list(list, run));
    return {};
  }
  bool reads_statements() const final { return !list.empty(); }
  bool needs_model() const final { return false; }
  bool sets() const final { return true; }
  void restore(RunState& run) const final { apply(run); }

  std::vector<std::string> passed_over;  // "INTEGRATOR/HMAX": arguments that nothing acts on
  std::string_view list;                 // the command whose settings it lists, nothing where it does not

 protected:
  virtual void apply(RunState&) const {}
};

template <class Written>
class SettingOf : public Setting {
 public:
  Written written;
};

template <class Action>
std::shared_ptr<const CommandAction> read_setting(CommandReader& reader) {
  auto action = std::make_shared<Action>();
  if (!read_setting_arguments(action->written, reader)) return nullptr;
  action->passed_over = arguments_passed_over<decltype(action->written)>(reader);
  if (reader.given("LIST")) action->list = reader.statement().name;
  return action;
}

template <class Action>
constexpr CommandKind setting(std::string_view name, std::string_view summary, std::string_view example,
                              const SettingList& list = {}) {
  using Written = decltype(Action::written);
  return {.name = name,
          .use = CommandUse::setting,
          .summary = summary,
          .example = example,
          .arguments = detail::argument_infos<Written>,
          .acting = Written::acting,
          .list = list,
          .read = read_setting<Action>};
}

}  // namespace dynalin::commands
