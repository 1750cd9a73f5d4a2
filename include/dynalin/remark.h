// Something that is said of an input or of a result: a warning beside it, or an error in its place.
#pragma once

#include <cstddef>
#include <string>

namespace dynalin {

struct Remark {
  enum class Severity { note, warning, error } severity = Severity::warning;
  std::string code;     // "unknown-marker": stable, `dynalin explain` says what it means; empty where there is none
  std::string message;  // one sentence
  std::string hint;     // what helps, empty if nothing is known
  // Where it points, counted from 1; no file and zeros where no file states it.
  std::string file;
  std::size_t line = 0, column = 0;
};

}  // namespace dynalin
