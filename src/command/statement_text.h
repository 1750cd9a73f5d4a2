// Statements as they hold now, written on lines of their own.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset.h"

namespace dynalin {

// The value of an argument on one line, without comments and marks of continuation.
std::string argument_text(const WrittenArgument&);
// What holds without being stated: arguments with their values, and sentences.
struct Unstated {
  std::vector<std::pair<std::string, std::string>> values;
  std::vector<std::string> sentences;
};
// What LIST of a definition command prints: "Current MARKER/12 data are:" and a row for each argument.
std::string statement_list(const Statement&, const Unstated& = {});

}  // namespace dynalin
