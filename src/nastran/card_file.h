// The text of one file of a deck: cards in their order, with the names of what they belong to as comments.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nastran/cards.h"
#include "nastran/deck.h"

namespace dynalin::nastran {

class CardFile {
 public:
  CardFile(std::string name, FieldWidth width, std::string_view before_names)
      : name_(std::move(name)), width_(width), before_names_(before_names) {}

  const std::string& name() const { return name_; }
  Card card(std::string_view name) const { return Card(name, width_); }
  // What the following cards are, as a comment before the first of them.
  void heading(std::string_view text);
  // With the name of its owner before it, unless the card before it has the same.
  void add(const Card&, const Owner&);
  // The same card as a comment.
  void add_as_comment(const Card&, const Owner&);
  void line(std::string_view text) { (text_ += text) += '\n'; }
  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }
  // What could not be written: "GRID of PART/2: a value is not finite".
  const std::vector<std::string>& problems() const { return problems_; }
  bool has_wide_number() const { return has_wide_number_; }

 private:
  void begin(const Card&, const Owner&);

  std::string name_;
  FieldWidth width_;
  std::string before_names_;
  std::string text_, heading_, last_heading_, last_name_;
  std::vector<std::string> problems_;
  bool has_wide_number_ = false;
};

}  // namespace dynalin::nastran
