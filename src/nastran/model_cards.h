// The model of a deck as cards: points, masses, what joins them, and shapes.
#pragma once

#include <functional>
#include <vector>

#include "nastran/card_file.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

// What a card is, as far as the choice of its file goes.
enum class CardGroup : std::uint8_t {
  body,      // grids and masses, and what joins bodies: with their owner
  property,  // PBUSH, PSHELL, PROD, MAT1
  tie,       // RBE2 of markers
  shape,     // grids and elements of graphics
};
using FileOf = std::function<CardFile&(CardGroup, const Owner&)>;

// Relations of one term hold a freedom: they become fixed points. In all others each freedom stands once, and the
// largest coefficient is 1; the first freedom stays the first, unless nothing is left of its coefficient.
void normalize_relations(Deck&);

void write_model(const Deck&, const ExportOptions&, const FileOf&);
void write_shapes(const Deck&, const FileOf&);

}  // namespace dynalin::nastran
