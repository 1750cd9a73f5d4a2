// Numbers of a dataset as parameters: which element, which argument, which of its values. They are read and replaced in
// the statement that gives them, whose arguments keep their names and places, so that whatever follows from them
// (checks of ranges, inertia in other axes, curves through points) is made anew by the same readers.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "dynalin/element_id.h"
#include "model/kind.h"

namespace dynalin {

struct ParameterRef {
  ElementId element;      // id 0: a statement without one, ACCGRAV
  std::string argument;   // "K", or an abbreviation of it
  std::size_t index = 1;  // among the numbers of a list, from 1

  // "BUSHING/1 K[2]", "PART/3 MASS", "ACCGRAV KGRAV".
  std::string text() const;
};
// What text() writes; otherwise what is wrong with it.
tl::expected<ParameterRef, std::string> parse_parameter(std::string_view);

// The number that the dataset states, or why there is none. Its statements must have their arguments.
tl::expected<double, std::string> parameter(const Dataset&, const ParameterRef&, Catalogue);

struct ParameterValue {
  ParameterRef parameter;
  double value;
};
// The dataset with other numbers in these places, or what stands in the way: every one that is wrong. A single number
// may be stated this way for the first time. The new dataset shares the text of the old one.
tl::expected<std::shared_ptr<const Dataset>, std::vector<std::string>> with_parameters(std::shared_ptr<const Dataset>,
                                                                                       std::span<const ParameterValue>,
                                                                                       Catalogue);

}  // namespace dynalin
