#include <fmt/ostream.h>

#include "command/session.h"
#include "elements/catalogue.h"

namespace dynalin {

int print_help(const std::string& statement, std::ostream& out, std::ostream& err) {
  if (statement.empty()) {
    for (const Kind* kind : catalogue())
      fmt::print(out, "{:<14} {:<14} {}\n", kind->statement, kind->variant, kind->summary);
    return done;
  }
  const std::string_view name = statement_name(statement);
  bool found = false;
  for (const Kind* kind : catalogue()) {
    if (kind->statement != name) continue;
    found = true;
    fmt::print(out, "{}{}{}\n  {}\n", kind->statement, kind->variant.empty() ? "" : ", ", kind->variant, kind->summary);
    for (const ArgumentInfo& a : kind->arguments) {
      fmt::print(out, "    {:<16} {:<12} {:<20} {}{}\n", a.name, a.value, a.unit, a.help,
                 a.required ? " (required)" : "");
    }
  }
  if (!found) fmt::print(err, "error: no statement {} is available\n", statement);
  return found ? done : wrong_usage;
}

}  // namespace dynalin
