#include "nastran_reader/deck.h"

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

// Known cards that change neither matrices nor loads of a direct solution.
constexpr std::string_view idle_cards[] = {"EIGRL",   "EIGR",    "EIGB",    "SET1",   "SET3",  "TSTEP",  "TSTEPNL",
                                           "TABDMP1", "ECHOON",  "ECHOOFF", "GRAV",   "LOAD",  "PLOAD4", "SUPORT1",
                                           "PARAML",  "PLOTEL3", "PLOTEL4", "NSMADD", "MDLPRM"};

using Readers = std::unordered_map<std::string_view, const CardKind*>;

const Readers& readers() {
  static const Readers all = [] {
    Readers out;
    for (const auto family :
         {point_cards(), element_cards(), constraint_cards(), matrix_cards(), response_cards(), drawing_cards()}) {
      for (const CardKind& kind : family) out.emplace(kind.name, &kind);
    }
    return out;
  }();
  return all;
}

bool is_matrix_header(const Card& card) {
  const Field& third = card.field(0, 3);
  return card.name == "DMIG" && third.form == Field::Form::integer && third.integer == 0;
}

void keep(std::map<std::string, Kept>& among, const Card& card) {
  Kept& k = among.try_emplace(card.name, Kept{0, card.at}).first->second;
  ++k.count;
}

void read_card(const Card& card, Deck& deck, Diagnostics& diagnostics) {
  const auto found = readers().find(card.name);
  if (found != readers().end()) {
    CardFields fields(card, diagnostics);
    found->second->read(fields, deck);
    fields.refuse_unread(found->second->shape);
  } else if (std::find(std::begin(idle_cards), std::end(idle_cards), card.name) != std::end(idle_cards)) {
    keep(deck.idle, card);
  } else {
    keep(deck.unknown, card);
  }
}

Deck typed(DeckLines lines, Diagnostics& diagnostics) {
  Deck deck;
  deck.text = std::move(lines);
  const std::span<const Line> all(deck.text.lines);
  if (all.empty()) {
    if (!diagnostics.has_errors())
      diagnostics.error("deck-section", {deck.text.sources.empty() ? nullptr : deck.text.sources[0].get(), 0, 0},
                        "the deck is empty");
    return deck;
  }
  Sections sections = read_control(all, diagnostics);
  deck.control = std::move(sections.control);
  deck.parameters = deck.control.parameters;
  const std::vector<Card> cards = read_bulk(all.subspan(sections.first_bulk), diagnostics);
  if (!deck.text.ended)
    diagnostics.warning("deck-section", all.back().span(), "no ENDDATA ends the bulk data behind this line");
  // Headers first: they say how terms are read, and may stand anywhere.
  for (const Card& card : cards) {
    if (is_matrix_header(card)) read_card(card, deck, diagnostics);
  }
  for (const Card& card : cards) {
    if (!is_matrix_header(card)) read_card(card, deck, diagnostics);
  }
  for (DirectMatrix& m : deck.matrices) {
    if (m.type != 1 && m.type != 3) continue;
    // Terms of single precision are rounded to it in reading, whatever the width of the field.
    for (DirectMatrix::Term& t : m.terms) t.value = static_cast<double>(static_cast<float>(t.value));
  }
  return deck;
}

}  // namespace

double Deck::parameter(const std::string& name, double otherwise) const {
  const auto found = parameters.find(name);
  if (found == parameters.end()) return otherwise;
  const Field f = read_field(found->second.first, found->second.second);
  return f.form == Field::Form::real || f.form == Field::Form::integer ? f.real : otherwise;
}

bool Deck::automatic_dependents() const {
  const auto found = parameters.find("AUTOMSET");
  return found != parameters.end() && (found->second.first == "YES" || found->second.first == "LUSOL");
}

bool Deck::automatic_spc() const {
  if (control.autospc) return *control.autospc;
  const auto found = parameters.find("AUTOSPC");
  return found == parameters.end() || found->second.first != "NO";
}

Deck read_deck(const std::string& path, Diagnostics& diagnostics) {
  return typed(read_deck_lines(path, diagnostics), diagnostics);
}

Deck deck_of_text(std::string name, std::string text, Diagnostics& diagnostics) {
  return typed(deck_lines_of_text(std::move(name), std::move(text), diagnostics), diagnostics);
}

}  // namespace dynalin::nastran_reader
