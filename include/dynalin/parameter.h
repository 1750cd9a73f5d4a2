// Numbers of a dataset as parameters of its model: which element, which argument, which of its values.
#pragma once

#include <cstddef>
#include <string>

#include "dynalin/element_id.h"

namespace dynalin {

struct ParameterRef {
  ElementId element;      // id 0: a statement without one, ACCGRAV
  std::string argument;   // "K", or an abbreviation of it
  std::size_t index = 1;  // among its numbers, from 1
  std::size_t list = 1;   // of an argument that may be written several times: which of them, from 1

  ParameterRef() = default;
  ParameterRef(ElementId of, std::string name, std::size_t number = 1)
      : element(std::move(of)), argument(std::move(name)), index(number) {}
  // By its name: "BUSHING/1 K[2]", "PART/3 MASS", "ACCGRAV KGRAV"; "SPLINE/1 Y[2][5]" is number 5 of the second Y.
  // Throws Error if the text names no parameter.
  ParameterRef(const char* name);
  ParameterRef(const std::string& name);

  std::string text() const;
};

struct ParameterChange {
  ParameterRef parameter;
  double value;  // units of the dataset
};

}  // namespace dynalin
