// Any bytes as a command file, and as commands given one by one.
#include "command/commands.h"

#include <memory>

#include "command/command_kind.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const auto source = std::make_shared<const SourceText>("fuzz.acf", fuzz::text_of(bytes, count));
  for (const auto read : {&parse_command_file, &parse_commands}) {
    const auto parsed = read(source);
    fuzz::demand_sound(parsed.diagnostics);
    for (const Command& c : parsed.value.commands) {
      fuzz::demand(std::size_t{c.at.offset} + c.at.length <= source->text().size(), "a command outside its source");
      fuzz::demand(c.action || parsed.diagnostics.has_errors(), "a command without an action");
    }
  }
  return 0;
}
