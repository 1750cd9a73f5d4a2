// How results name an element of the model.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace dynalin {

// Statement and id as in the dataset; nothing without a statement.
struct ElementId {
  std::string statement;  // "PART"
  std::int64_t id = 0;

  bool empty() const { return statement.empty(); }
  std::string text() const { return empty() ? statement : statement + "/" + std::to_string(id); }  // "PART/2"
  friend auto operator<=>(const ElementId&, const ElementId&) = default;
};

}  // namespace dynalin
