// The fields of one card by row and number, each read as what the card needs there; what is wrong is told at the field.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nastran_reader/bulk.h"
#include "nastran_reader/deck.h"

namespace dynalin::nastran_reader {

class CardFields {
 public:
  CardFields(const Card& card, Diagnostics& diagnostics) : card_(card), diagnostics_(diagnostics) {}

  const Card& card() const { return card_; }
  const std::string& name() const { return card_.name; }
  // The fields in one row after the other from here on.
  std::size_t count() const { return card_.fields.size(); }
  const Field& at(std::size_t index) const { return card_.fields[index]; }
  const Field& field(std::size_t row, std::size_t number) const { return card_.field(row, number); }
  bool blank(std::size_t row, std::size_t number) const { return field(row, number).blank(); }
  bool good() const { return good_; }
  Diagnostics& diagnostics() { return diagnostics_; }

  // A positive number that must be there.
  Reference id(std::size_t row, std::size_t number, std::string_view what);
  // A number not below `least`, 0 where the field is blank.
  Reference reference(std::size_t row, std::size_t number, std::string_view what, int least = 0);
  Reference reference(const Field&, std::string_view what, int least = 0);
  double real(std::size_t row, std::size_t number, std::string_view what, double otherwise = 0);
  double real(const Field&, std::string_view what, double otherwise = 0);
  double required_real(std::size_t row, std::size_t number, std::string_view what);
  int integer(const Field&, std::string_view what, int otherwise = 0);
  Eigen::Vector3d vector(std::size_t row, std::size_t number, std::string_view what);
  // Digits 1 to 6, none twice; blank or 0 is no component.
  Components components(const Field&, std::string_view what);
  // One of 0 to 6; blank is 0.
  Freedom freedom(const Field& point, const Field& component);
  std::string word(std::size_t row, std::size_t number, std::string_view what);
  NumberOrCard number_or_card(std::size_t row, std::size_t number, std::string_view what);
  // Numbers one after the other from `index` on, with `1 THRU 9` and `1 THRU 9 BY 2`. `range` tells whether THRU was
  // there.
  std::vector<Reference> list(std::size_t index, std::string_view what);

  void wrong(std::string_view code, const Span& at, std::string message, std::string hint = {});
  // Of a field that is blank the `count` next ones are, too: they say something of it.
  void refuse_beside_blank(std::size_t row, std::size_t number, std::size_t count, std::string_view what);
  // Fields that are nothing at all and that nobody asked for, and those that stand where the card has none.
  void refuse_unread(std::string_view shape);

 private:
  void mistaken(const Field&, std::string_view what, std::string_view wanted);

  const Card& card_;
  Diagnostics& diagnostics_;
  bool good_ = true;
  std::vector<std::uint32_t> told_;  // offsets of fields
};

struct CardKind {
  std::string_view name;
  void (*read)(CardFields&, Deck&);
  // Fields 2 to 9 of each row that mean something, whether or not they are read here: x, or - for one that stays blank.
  // Behind + the last row may come again.
  std::string_view shape;
};
inline constexpr std::string_view list_in_rows = "xxxxxxxx+";
std::span<const CardKind> point_cards();
std::span<const CardKind> element_cards();
std::span<const CardKind> constraint_cards();
std::span<const CardKind> matrix_cards();
std::span<const CardKind> response_cards();
std::span<const CardKind> drawing_cards();

}  // namespace dynalin::nastran_reader
