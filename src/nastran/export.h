// LINEAR/EXPORT: the linear model of a point as the files of a Nastran deck.
#pragma once

#include "nastran/deck_text.h"
#include "nastran/directives.h"
#include "study/linearization.h"

namespace dynalin::nastran {

struct ExportedDeck {
  std::vector<DeckFile> files;  // the main file first
  Diagnostics remarks;
  std::vector<std::string> details;  // for `debug`
};

// `file` as FILE= has it: what the names of the files begin with.
StudyResult<ExportedDeck> export_deck(const Linearization&, Box, const ExportOptions&, const std::string& file);
// The files that are known before anything is computed.
std::vector<std::string> expected_files(Box, const ExportOptions&, const std::string& file);

}  // namespace dynalin::nastran
