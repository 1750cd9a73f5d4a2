#include "nastran/card_file.h"

#include <fmt/format.h>

namespace dynalin::nastran {

void CardFile::heading(std::string_view text) {
  if (text != last_heading_) heading_ = text;
}

void CardFile::begin(const Card& card, const Owner& owner) {
  if (!card.problem().empty())
    problems_.push_back(owner.name.empty() ? fmt::format("{}: {}", card.name(), card.problem())
                                           : fmt::format("{} of {}: {}", card.name(), owner.name, card.problem()));
  has_wide_number_ |= card.has_wide_number();
  if (!heading_.empty()) {
    line("$ --- " + heading_ + " ---");
    last_heading_ = std::move(heading_);
    heading_.clear();
    last_name_.clear();
  }
  if (owner.name == last_name_) return;
  last_name_ = owner.name;
  if (owner.name.empty()) return;
  (text_ += '$') += before_names_;
  for (const char c : owner.name) text_ += c == '\n' || c == '\r' ? ' ' : c;
  text_ += '\n';
}

void CardFile::add(const Card& card, const Owner& owner) {
  begin(card, owner);
  card.append_to(text_);
}

void CardFile::add_as_comment(const Card& card, const Owner& owner) {
  begin(card, owner);
  std::string lines;
  card.append_to(lines);
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    line("$ " + lines.substr(at, end - at));
    at = end + 1;
  }
}

}  // namespace dynalin::nastran
