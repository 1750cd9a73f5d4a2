// Entries of tables by their names: each word of each expression is looked up in several.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <unordered_map>

namespace dynalin {

template <class Entry>
class NameIndex {
 public:
  // Of a name that stands twice the first counts. The tables must outlive this.
  NameIndex(std::initializer_list<std::span<const Entry>> tables) {
    for (const auto& table : tables) {
      for (const Entry& entry : table) entries_.emplace(entry.name, &entry);
    }
  }
  // Null if there is none.
  const Entry* find(std::string_view name) const {
    const auto known = entries_.find(name);
    return known == entries_.end() ? nullptr : known->second;
  }

 private:
  std::unordered_map<std::string_view, const Entry*> entries_;
};

}  // namespace dynalin
