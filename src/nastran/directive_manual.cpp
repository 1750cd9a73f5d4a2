#include "nastran/directive_manual.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "nastran/directives.h"

namespace dynalin::nastran {

namespace {

// "real, default 1, required for SOL 108, without effect with CLOSEDBOX"
std::string conditions(const Directive& d) {
  std::string text;
  if (const std::string fallback = fallback_text(d); !fallback.empty()) text += fmt::format("; default {}", fallback);
  if (d.required_in_108) text += "; required by SOL 108";
  if (d.ignored != never) text += fmt::format("; without effect with {}", ignored_text(d.ignored));
  return text;
}

void print(const Directive& d, std::ostream& out) {
  fmt::print(out, "    {} = {}\n        {}{}\n", d.name, values_text(d), d.help, conditions(d));
}

std::string conditions(const Field& f) {
  return fmt::format("{}{}{}", f.help, f.fallback.empty() ? "" : fmt::format("; default {}", f.fallback),
                     f.required ? "; required" : "");
}

void print(const Block& b, std::ostream& out) {
  fmt::print(out, "    {} {{ … }}\n        {}; required by SOL 108; without effect with SOL 107\n", b.name, b.help);
  for (const Field& f : b.fields) fmt::print(out, "        {} = {}\n            {}\n", f.name, f.values, conditions(f));
}

constexpr std::string_view verbatim = "lines that go into case control as they are; as many blocks as wanted";

// A vertical bar would end the cell of a table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

}  // namespace

void print_directives(std::ostream& out) {
  fmt::print(out,
             "LINEAR/EXPORT, TYPE=OPENBOX or CLOSEDBOX, FILE=name, CONFIG=file\n"
             "  directives of the configuration file: NAME = VALUE, one a line; $ begins a comment; case matters\n");
  for (const DirectiveGroup& group : directive_groups()) {
    fmt::print(out, "  {}\n", group.title);
    for (const Block& b : group.blocks) print(b, out);
    for (const Directive& d : group.directives) print(d, out);
  }
  fmt::print(out, "  Case control\n    verbatim {{ … }}\n        {}\n", verbatim);
}

bool print_directive(std::string_view name, std::ostream& out) {
  const Directive* d = find_directive(name);
  const Block* b = find_block(name);
  if (!d && !b && name != "verbatim") return false;
  fmt::print(out, "{} in the configuration file of LINEAR/EXPORT\n", d ? d->name : name);
  if (d) print(*d, out);
  if (b) print(*b, out);
  if (!d && !b) fmt::print(out, "    verbatim {{ … }}\n        {}\n", verbatim);
  return true;
}

std::string directive_pages() {
  std::string text;
  for (const DirectiveGroup& group : directive_groups()) {
    text += fmt::format("### {}\n\n", group.title);
    for (const Block& b : group.blocks) {
      text += fmt::format("`{}` {{ … }}: {}. Required by SOL 108, without effect with SOL 107.\n\n", b.name, b.help);
      text += "| field | takes | |\n|---|---|---|\n";
      for (const Field& f : b.fields)
        text += fmt::format("| `{}` | {} | {} |\n", f.name, cell(f.values), conditions(f));
      text += '\n';
    }
    text += "| directive | takes | default | | without effect with |\n|---|---|---|---|---|\n";
    for (const Directive& d : group.directives)
      text += fmt::format("| `{}` | {} | {} | {}{} | {} |\n", d.name, cell(values_text(d)), cell(fallback_text(d)),
                          d.help, d.required_in_108 ? "; required by SOL 108" : "", ignored_text(d.ignored));
    text += '\n';
  }
  return text + fmt::format("### Case control\n\n`verbatim` {{ … }}: {}.\n", verbatim);
}

}  // namespace dynalin::nastran
