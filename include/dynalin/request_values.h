// What a REQUEST asks for, at one instant. Units of the dataset, angles in radians.
#pragma once

#include <string>
#include <vector>

namespace dynalin {

struct RequestValues {
  std::string element;                  // "REQUEST/3"; of an MREQUEST "MREQUEST/1 PART/2"
  std::string view_name;                // empty if it has none
  std::vector<std::string> components;  // "MAG", "X" …, or as CNAMES names them
  std::vector<double> values;           // not finite where it has none
};

}  // namespace dynalin
