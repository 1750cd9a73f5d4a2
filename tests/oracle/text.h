// Numbers as the dataset language reads them back: 17 digits, lists with commas.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace dynalin::oracle {

[[nodiscard]] inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
template <class List>
[[nodiscard]] std::string numbers(const List& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : ", ") + number(v);
  return text;
}
[[nodiscard]] inline std::string integers(const std::vector<int>& values) {
  std::string text;
  for (const int v : values) text += (text.empty() ? "" : ",") + std::to_string(v);
  return text;
}

}  // namespace dynalin::oracle
