// STRING/id, STRING=text: text that compiled routines read with GTSTRG (model/called_routines.h hands it to them).
#include <fmt/format.h>

#include "model/schema.h"
#include "model/told_beforehand.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

struct Text {
  std::string text;
  static constexpr std::array<Argument<Text>, 1> arguments = {{
      {.name = "STRING", .slot = &Text::text, .help = "any text up to the end of the statement"},
  }};
};

class StringSet final : public TypedSet<Text> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (!read_arguments(elements[k], reader) || elements[k].text.size() <= RoutineData::longest_text) return;
    reader.error("value-out-of-range", reader.at("STRING"),
                 fmt::format("the text of {} has {} characters, {} at most", reader.label().text(),
                             elements[k].text.size(), RoutineData::longest_text));
  }
};

}  // namespace

namespace {

// Routines look at texts when they are asked what they read.
constexpr ToldBeforehand told_of_string = {.data = [](const StatementWords& s, RoutineData& data) {
  data.strings[s.id()] = s.text("STRING").substr(0, RoutineData::longest_text);
}};

}  // namespace

extern constinit const Kind string =
    Kind{"STRING",
         "",
         "Text for compiled routines.",
         Kind::Role::element,
         detail::argument_infos<Text>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<StringSet>(kind); }}
        .telling(told_of_string)
        .with_example("STRING/1, STRING=text");

}  // namespace dynalin
