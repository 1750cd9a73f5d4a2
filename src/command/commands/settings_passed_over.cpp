// Settings of simulations over time, of solvers and of their files: checked, and nothing acts on them.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"
#include "elements/settings/output_settings.h"

namespace dynalin::commands {

namespace {

// One that is passed over as a whole.
class Request final : public SettingOf<WrittenRequest> {};

std::shared_ptr<const CommandAction> read_request(CommandReader& reader) {
  auto action = std::make_shared<Request>();
  if (!read_arguments(action->written, reader)) return nullptr;
  action->passed_over = {"REQUEST"};
  return action;
}

constexpr std::array kinds = {
    setting<SettingOf<WrittenLinearSolver>>("LSOLVER", "of the solver of equations: checked, nothing acts on it",
                                            "LSOLVER/UMF"),
    setting<SettingOf<WrittenOutput>>("OUTPUT", "of the files of simulations: checked, nothing acts on it",
                                      "OUTPUT/NOPRINT"),
    CommandKind{.name = "REQUEST",
                .use = CommandUse::setting,
                .summary = "of time histories: checked, nothing acts on it",
                .example = "REQUEST/1, DISPLACEMENT, I=20, J=1",
                .arguments = detail::argument_infos<WrittenRequest>,
                .read = read_request},
    setting<SettingOf<WrittenDebug>>("DEBUG", "of what a solver prints of its work: checked, nothing acts on it",
                                     "DEBUG/EPRINT"),
};

}  // namespace

std::span<const CommandKind> settings_passed_over() { return kinds; }

}  // namespace dynalin::commands
