// Finds which kind of a statement is meant; the variants of a statement are told by a bare word.
#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/kind.h"

namespace dynalin {

class KindFinder {
 public:
  static constexpr std::size_t no_argument = static_cast<std::size_t>(-1);
  explicit KindFinder(Catalogue);

  // The kind, and which of the arguments chose it; nothing after a report.
  const Kind* find(const Statement&, std::size_t& variant_argument, Diagnostics&) const;
  // All kinds of a statement, empty if there is none.
  const std::vector<const Kind*>& kinds_of(std::string_view statement) const;
  // Whether the keyword alone says which is meant: a setting, or what a dataset has once. An id names nothing there.
  bool needs_no_id(std::string_view statement) const;
  // The id that tells it from others of its keyword, 0 where it needs none.
  std::int64_t identity_of(const Statement&) const;

 private:
  struct Variants {
    std::vector<const Kind*> kinds;
    std::vector<std::string_view> names;
  };
  std::unordered_map<std::string_view, Variants> kinds_;  // by the keyword out of the catalogue
};

}  // namespace dynalin
