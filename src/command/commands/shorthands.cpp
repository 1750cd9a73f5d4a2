// GSTIFF/… and WSTIFF/…: INTEGRATOR/GSTIFF, … in short.
#include "command/command_catalogue.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

std::shared_ptr<const CommandAction> read_shorthand(CommandReader& reader) {
  Statement whole = reader.statement();
  whole.name = "INTEGRATOR";
  WrittenArgument type;
  type.name = whole.keyword();
  whole.arguments.insert(0, {&type, 1});
  const ElementLabel label{whole.name, 0, "", whole.at};
  CommandReader integrator(whole, reader.source(), reader.diagnostics(), label);
  return find_command(whole.name)->read(integrator);
}

constexpr CommandKind shorthand(std::string_view name, std::string_view summary, std::string_view example) {
  return {.name = name,
          .use = CommandUse::setting,
          .summary = summary,
          .example = example,
          .arguments = detail::argument_infos<WrittenIntegrator>,
          .acting = WrittenIntegrator::acting,
          .read = read_shorthand};
}

constexpr std::array shorthand_kinds = {
    shorthand("GSTIFF", "INTEGRATOR/GSTIFF in short", "GSTIFF/ERROR=1E-4"),
    shorthand("WSTIFF", "INTEGRATOR/WSTIFF in short", "WSTIFF/ERROR=1E-4"),
};

}  // namespace

std::span<const CommandKind> shorthands() { return shorthand_kinds; }

}  // namespace dynalin::commands
