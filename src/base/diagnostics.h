// What is wrong with the input: collected, never thrown, each with its place.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"

namespace dynalin {

enum class Severity { note, warning, error };

struct Note {
  Span at;
  std::string message;
};

struct Diagnostic {
  Severity severity = Severity::error;
  std::string_view code;  // "unknown-marker": stable, kebab case, listed once in base/diagnostics.def
  Span at;
  std::string message;  // one sentence, names things as the user wrote them, no full stop
  std::string hint;
  std::vector<Note> notes;
};

class Diagnostics {
 public:
  Diagnostic& error(std::string_view code, const Span& at, std::string message, std::string hint = {});
  Diagnostic& warning(std::string_view code, const Span& at, std::string message, std::string hint = {});
  bool has_errors() const { return error_count_ > 0; }
  std::size_t error_count() const { return error_count_; }
  const std::vector<Diagnostic>& items() const { return items_; }
  void append(Diagnostics other);

 private:
  std::vector<Diagnostic> items_;
  std::size_t error_count_ = 0;
};

// `file:line:col: error: message [code]`, the line, a caret under the span, the hint and the notes. Without a
// source only `error: message [code]` and the hint. Every line, the last included, ends with a line end.
std::string render(const Diagnostic&);
// All of them in the order of their places (source by source, in the order of appearance); after `limit` of one kind
// only a count of the rest of that kind.
std::string render(const Diagnostics&, std::size_t limit = 49);

// What a code means (`dynalin explain CODE`).
struct Explanation {
  std::string_view code;
  std::string_view text;    // one line
  std::string_view advice;  // the cause, what to do about it, an example: lines without the last line end
};
std::span<const Explanation> explanations();
const Explanation* find_explanation(std::string_view code);  // nullptr if there is no such code

// A value together with what was found while making it; value is usable only without errors.
template <class T>
struct Parsed {
  T value;
  Diagnostics diagnostics;
};

}  // namespace dynalin
