#include "model/argument_info.h"

#include <algorithm>
#include <cctype>

namespace dynalin {

namespace {

std::string several(std::string_view statement) {
  std::string text(statement);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return text + 's';
}

}  // namespace

std::string ArgumentInfo::value_text() const {
  switch (value) {
    case ValueKind::none:
      return {};
    case ValueKind::number:
      return "real";
    case ValueKind::vector:
      return "x, y, z";
    case ValueKind::numbers:
      return "reals";
    case ValueKind::lists:
      return "reals, repeated";
    case ValueKind::integer:
      return "integer";
    case ValueKind::word:
      return "word";
    case ValueKind::words:
      return "words";
    case ValueKind::text:
      return "text";
    case ValueKind::marker:
      return "marker";
    case ValueKind::body:
      return "body";
    case ValueKind::element:
      return "id";
    case ValueKind::elements:
      return several(ids_of);
    case ValueKind::ids:
      return "ids";
    case ValueKind::expression:
      return "expression";
    case ValueKind::vector_expression:
      return "vector";
    case ValueKind::routine_call:
      return "USER(…)";
  }
  return {};
}

bool takes_numbers(const ArgumentInfo& a) {
  switch (a.value) {
    case ValueKind::number:
    case ValueKind::vector:
    case ValueKind::numbers:
    case ValueKind::lists:
    case ValueKind::integer:
      return true;
    default:
      return false;
  }
}

bool may_be_number(const ArgumentInfo& a) { return a.value == ValueKind::expression || a.value == ValueKind::text; }

}  // namespace dynalin
