// What a REQUEST asks for, at one instant. Units of the dataset, angles in radians.
#pragma once

#include <string>
#include <vector>

#include "dynalin/element_id.h"

namespace dynalin {

// Which request: an MREQUEST stands for one of each element that it watches.
struct RequestName {
  ElementId element;  // REQUEST/3
  std::string of;     // "PART/2", what an MREQUEST watches

  std::string text() const { return of.empty() ? element.text() : element.text() + " " + of; }
  friend auto operator<=>(const RequestName&, const RequestName&) = default;
};

struct RequestValues {
  RequestName request;
  std::string view_name;                // empty if it has none
  std::vector<std::string> components;  // "MAG", "X" …, or as CNAMES names them
  std::vector<double> values;           // not finite where it has none
};

}  // namespace dynalin
