// Cards of bulk data: fields of 8 or 16 columns, rows and their continuation. No mechanics.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dynalin::nastran {

enum class FieldWidth : std::uint8_t { small = 8, large = 16 };
enum class Exponent : std::uint8_t {
  bare,      // 1.5-7, read in single precision where that matters
  letter_D,  // 1.5D-7, double precision
};

// A finite number in at most as many columns, with as many digits as they hold: of all ways to write it the one that is
// nearest, among those the shortest. What single precision has as zero is zero without the D. Empty if there is no
// way: not finite, or beyond single precision.
std::string real_text(double value, FieldWidth, Exponent);

// One card, field by field; from row to row it goes on by itself.
class Card {
 public:
  Card(std::string_view name, FieldWidth width) : name_(name), width_(width) {}

  Card& integer(std::int64_t value);
  Card& reference(std::int64_t id) { return id == 0 ? blank() : integer(id); }  // blank for none
  Card& real(double value, Exponent exponent = Exponent::bare);
  Card& word(std::string_view text);  // at most eight characters
  Card& blank(std::size_t count = 1);
  Card& row() { return blank((8 - fields_.size() % 8) % 8); }  // what follows stands in the next row

  // Its lines, each with its end. In large fields a row is two lines, also where the second is empty.
  void append_to(std::string& text) const;
  // What does not fit into a field, empty if all is well: "a value is not finite".
  const std::string& problem() const { return problem_; }
  bool has_wide_number() const { return has_wide_number_; }
  std::string_view name() const { return name_; }

 private:
  void append_line(std::string& text, std::string_view begin, std::size_t first, std::size_t count) const;

  std::string_view name_;
  FieldWidth width_;
  std::vector<std::string> fields_;
  std::string problem_;
  bool has_wide_number_ = false;
};

// "PARAM,POST,0"
std::string parameter_card(std::string_view name, std::string_view value);

}  // namespace dynalin::nastran
