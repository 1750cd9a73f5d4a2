// Mode shapes as a punch file of complex eigenvectors, as Nastran itself writes it: records of 80 columns with their
// numbers in the last eight.
#pragma once

#include <string>

#include "nastran/deck.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

std::string punch_text(const Deck&, const ExportOptions&);

}  // namespace dynalin::nastran
