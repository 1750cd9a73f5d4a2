// Commands that have no effect on linear models: read and passed over, with a word.
#include <fmt/format.h>

#include "command/run_state.h"

namespace dynalin::commands {

namespace {

class PassOver final : public CommandAction {
 public:
  explicit PassOver(std::string_view name) : name_(name) {}
  StudyResult<void> run(RunState& run) const override {
    run.remarks.say("passed-over",
                    fmt::format("the command {} has no effect on linear models and is passed over", name_));
    run.json.add_plain(run.command, run.time());
    return {};
  }

 private:
  std::string name_;
};

constexpr CommandKind passed(std::string_view name, std::string_view summary, std::string_view example) {
  return {.name = name,
          .use = CommandUse::without_effect,
          .summary = summary,
          .example = example,
          .read = [](CommandReader& reader) -> std::shared_ptr<const CommandAction> {
            return std::make_shared<PassOver>(reader.statement().name);
          }};
}

constexpr std::array kinds = {
    passed("GSTIFF", "an integrator", "GSTIFF"),
    passed("HELP", "for a session at a prompt", "HELP"),
    passed("INFO", "prints measures of markers in other programs", "INFO"),
    passed("MENU", "for a session at a prompt", "MENU"),
    passed("SHOW", "prints statistics in other programs", "SHOW STATISTICS=SIMULATION"),
    passed("STRING", "text for compiled routines", "STRING/1, STRING=text"),
    passed("TIME", "prints the time in other programs", "TIME"),
    passed("WSTIFF", "an integrator", "WSTIFF"),
};

}  // namespace

std::span<const CommandKind> passed_over() { return kinds; }

}  // namespace dynalin::commands
