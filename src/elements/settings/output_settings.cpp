#include "elements/settings/output_settings.h"

#include <fmt/format.h>

#include "dataset/characters.h"
#include "elements/families/kept_as_text.h"
#include "elements/settings/setting_set.h"

namespace dynalin {

namespace {

// A function of a REQUEST that no one will evaluate: what is wrong in it is worth a warning, and no more.
void check_functions(ElementReader& reader) {
  for (const WrittenArgument& w : reader.statement().arguments) {
    const bool function = w.name.length >= 2 && (w.name.text()[0] == 'F' || w.name.text()[0] == 'f') && w.has_value;
    if (!function || w.damaged || w.value.empty()) continue;
    const SourceText& source = *w.name.source;
    if (equal_ignoring_case(Span{&source, w.value[0].offset, w.value[0].length}.text(), "USER")) continue;
    Diagnostics found;
    parse_expression(w.value, source, found);
    for (const Diagnostic& d : found.items()) {
      if (d.severity != Severity::error || d.code == "function-not-built" || d.code == "vector-mismatch") continue;
      reader.warning(d.code, d.at, d.message + fmt::format("; {} is passed over", reader.label().text()), d.hint);
      break;
    }
  }
}

class RequestSet final : public TextSet {
 public:
  using TextSet::TextSet;
  void read(std::size_t, ElementReader& reader) override {
    WrittenRequest checked;
    if (read_arguments(checked, reader)) check_functions(reader);
  }
};

// STRING/id, STRING=text: for subroutines.
struct WrittenString {
  Obsolete text;
  static constexpr std::array<Argument<WrittenString>, 1> arguments = {{
      {.name = "STRING", .slot = &WrittenString::text, .help = "any text up to the end of the statement"},
  }};
  static constexpr std::array<std::string_view, 1> acting = {"STRING"};
  void apply(Settings&) const {}
};

}  // namespace

extern constinit const Kind output = setting<WrittenOutput>("OUTPUT", "What is written to which file.");
extern constinit const Kind results = setting<WrittenResults>("RESULTS", "Contents of the results file.");
extern constinit const Kind string = setting<WrittenString>("STRING", "Text for subroutines.");
extern constinit const Kind request = Kind{
    "REQUEST",
    "",
    "Output of time histories.",
    Kind::Role::inert,
    detail::argument_infos<WrittenRequest>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<RequestSet>(kind);
    }}.deactivatable();

}  // namespace dynalin
