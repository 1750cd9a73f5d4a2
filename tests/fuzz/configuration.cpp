// Any bytes as a configuration file of LINEAR/EXPORT; where it has no errors, decks made by hand are written by it.
#include "nastran/configuration.h"

#include <algorithm>

#include "nastran/deck_text.h"
#include "nastran/sample_deck_test_support.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

void write_deck(nastran::Deck deck, const nastran::ExportOptions& options) {
  std::erase_if(deck.inputs, [&](const auto& p) { return p.channel >= options.force_input_channel.size(); });
  std::erase_if(deck.outputs, [&](const auto& p) { return p.channel >= options.displacement_output_channel.size(); });
  const auto text = nastran::deck_text(std::move(deck), options, "deck");
  demand(text.has_value() || !text.error().empty(), "a deck that is neither written nor refused");
  if (!text) return;
  demand(text->files.front().text.ends_with("ENDDATA\n"), "a deck without an end");
  demand(text->files.front().text.find("\nBEGIN BULK\n") != std::string::npos, "a deck without bulk data");
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const auto source = std::make_shared<const SourceText>("fuzz.cfg", fuzz::text_of(bytes, count));
  for (const nastran::Box box : {nastran::Box::open, nastran::Box::closed}) {
    const auto read = nastran::read_configuration(source, box);
    fuzz::demand_sound(read.diagnostics);
    const nastran::ExportOptions& o = read.value.options;
    fuzz::demand(o.solution_number == 107 || o.solution_number == 108, "a solution that there is not");
    fuzz::demand(!o.ignore_errors || !read.diagnostics.has_errors(), "an error where errors are to be ignored");
    fuzz::demand(o.force_editable.size() == read.value.force_editable.size(), "a force without its place");
    fuzz::demand(o.export_markers_by_name.size() == read.value.export_markers_by_name.size(),
                 "a name without its place");
    for (const auto& c : o.force_input_channel)
      fuzz::demand(read.value.input_channels.contains(c.name), "a channel without its place");
    if (read.diagnostics.has_errors()) continue;
    fuzz::write_deck(box == nastran::Box::open ? nastran::sample_open_deck() : nastran::sample_closed_deck(), o);
  }
  return 0;
}
