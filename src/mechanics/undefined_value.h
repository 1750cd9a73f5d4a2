// Where elements and functions have no finite value or no derivative.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/handles.h"

namespace dynalin {

// Why an element has no finite value, or a value without a derivative: a sentence that names it.
struct UndefinedValue {
  const ElementLabel* of = nullptr;
  std::string reason;
  bool in_value = true;
};

// A function that has another value or slope on either side of the point: a sentence that names its element.
struct Kink {
  const ElementLabel* of = nullptr;
  std::string text;
};

// What a search through the elements finds: values that are not defined, or else kinks.
class UndefinedValues {
 public:
  UndefinedValues() = default;
  // Kinks right at the point, as far as rounding of displacements in a model of that length tells.
  static UndefinedValues search_for_kinks(double length) {
    UndefinedValues all;
    all.length_ = length;
    return all;
  }
  const std::optional<double>& length() const { return length_; }  // of a search for kinks

  void add(UndefinedValue v) { values_.push_back(std::move(v)); }
  void add(Kink k) { kinks_.push_back(std::move(k)); }
  const std::vector<UndefinedValue>& values() const { return values_; }
  const std::vector<Kink>& kinks() const { return kinks_; }

 private:
  std::optional<double> length_;
  std::vector<UndefinedValue> values_;
  std::vector<Kink> kinks_;
};

}  // namespace dynalin
