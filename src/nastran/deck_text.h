// A deck as the files of its style.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "base/diagnostics.h"
#include "nastran/deck.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

struct DeckFile {
  std::string name;  // FILE with what the style puts behind it
  std::string text;
};
struct DeckText {
  std::vector<DeckFile> files;  // the main file first
  Diagnostics remarks;
  std::vector<std::string> details;  // for `debug`
};

// `file` as FILE= has it. Fails with every value that has no place on a card, and what it belongs to, and where names
// of files do not fit.
tl::expected<DeckText, std::vector<std::string>> deck_text(Deck, const ExportOptions&, const std::string& file);

}  // namespace dynalin::nastran
