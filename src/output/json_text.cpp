#include "output/json_text.h"

#include <array>
#include <cmath>

namespace dynalin {

void JsonText::open(char bracket) {
  text_ += bracket;
  ++depth_;
  empty_ = true;
}

void JsonText::close(char bracket) {
  --depth_;
  if (!empty_) next_line();
  text_ += bracket;
  empty_ = false;
}

void JsonText::element() {
  if (!empty_) text_ += ',';
  next_line();
  empty_ = false;
}

void JsonText::key(std::string_view name) {
  element();
  text_.append(1, '"').append(name).append("\": ");
}

void JsonText::number(double x) {
  if (!std::isfinite(x)) {
    text_ += "null";
    return;
  }
  // The shortest text that reads as the same number, as numbers among the other values have it.
  std::array<char, 64> digits;
  const char* end = nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), x + 0.0);
  text_.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

void JsonText::complex(std::complex<double> z) {
  open('[');
  element();
  number(z.real());
  element();
  number(z.imag());
  close(']');
}

void JsonText::value(const Json& v) {
  // Commands are kept as written; bytes that are no UTF-8 become replacement characters. Lines end between values only.
  const std::string lines = v.dump(1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', from), lines.size());
    text_.append(lines, from, end - from);
    if (end < lines.size()) next_line();
    from = end + 1;
  }
}

}  // namespace dynalin
