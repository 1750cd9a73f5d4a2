// What the tests of this folder share: an expression from a text, evaluated by naming its atoms.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "dataset/lexer.h"
#include "expression/expression.h"

namespace dynalin::expression_test {

struct ParsedText {
  SourceRef source;
  Diagnostics diagnostics;
  Expression expression;

  const Diagnostic& first() const { return diagnostics.items().at(0); }
  // "code line:column" of each diagnostic.
  std::vector<std::string> problems() const {
    std::vector<std::string> list;
    for (const Diagnostic& d : diagnostics.items()) {
      const auto place = source->place(d.at.offset);
      list.push_back(std::string(d.code) + " " + std::to_string(place.line) + ":" + std::to_string(place.column));
    }
    return list;
  }
};

inline ParsedText parse(std::string text) {
  ParsedText result;
  result.source = std::make_shared<const SourceText>("test.adm", std::move(text));
  Lexer lexer(*result.source, 0);
  std::vector<Token> tokens;
  lexer.next_statement(tokens);
  result.expression = parse_expression(tokens, *result.source, result.diagnostics);
  return result;
}

// Value, or value and partials, at atom values in the order in which the atoms first occur.
template <class T>
struct Result {
  T value{};
  std::vector<T> partial;
};
template <class T>
Result<T> evaluate(const Expression& e, const std::vector<T>& atoms) {
  ExpressionWorkspace<T> workspace;
  Result<T> r;
  r.partial.resize(e.atoms().size());
  r.value = e.evaluate(std::span<const T>(atoms), std::span<T>(r.partial), workspace);
  return r;
}
inline Result<double> evaluate(const std::string& text, const std::vector<double>& atoms = {}) {
  const ParsedText parsed = parse(text);
  if (parsed.diagnostics.has_errors()) throw std::runtime_error(render(parsed.diagnostics));
  return evaluate(parsed.expression, atoms);
}
inline double value(const std::string& text, const std::vector<double>& atoms = {}) {
  return evaluate(text, atoms).value;
}

inline std::optional<UndefinedOperation> fault(const std::string& text, const std::vector<double>& atoms,
                                               UndefinedSearch search = UndefinedSearch::value_and_partials) {
  return parse(text).expression.find_undefined(std::span<const double>(atoms), search);
}

}  // namespace dynalin::expression_test
