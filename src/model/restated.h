// What commands have stated anew about the start, and what of it holds at the next analysis.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "mechanics/handles.h"

namespace dynalin {

class Restated {
 public:
  using Element = std::pair<std::string, std::int64_t>;  // "PART", 3

  // Of a model that nothing has begun with yet.
  static Restated all();

  // An element begins with all that its statement says: a body that is placed, a state with another initial value.
  void begin(const Element& element) { anew_.insert(element); }
  // One argument of an element that goes on otherwise: VX, DMODE.
  void state(const Element&, std::string_view argument);
  void append(const Restated&);

  bool begins(const ElementLabel&) const;
  // Whether what the argument states of the element holds.
  bool holds(const ElementLabel&, std::string_view argument) const;

  bool is_all() const { return all_; }
  bool empty() const { return !all_ && anew_.empty() && arguments_.empty(); }
  const std::set<Element>& anew() const { return anew_; }
  const std::map<Element, std::set<std::string>>& arguments() const { return arguments_; }

 private:
  bool all_ = false;
  std::set<Element> anew_;
  std::map<Element, std::set<std::string>> arguments_;
};

}  // namespace dynalin
