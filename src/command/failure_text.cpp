#include "command/failure_text.h"

#include <fmt/format.h>

namespace dynalin {

namespace {

std::string with_details(const Failure& f, std::size_t first, std::size_t last, const std::string& file) {
  std::string text = fmt::format("{}: {}{}", f.analysis, f.message, f.code.empty() ? "" : fmt::format(" [{}]", f.code));
  const std::size_t count = f.details.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (k == first && count > first + last + 1) {
      text += fmt::format("\n  … {} more lines in {}", count - first - last, file);
      k = count - last;
    }
    text += "\n  " + f.details[k];
  }
  return text;
}

}  // namespace

std::string failure_text(const Failure& f) { return with_details(f, f.details.size(), 0, {}); }

std::string short_failure_text(const Failure& f, const std::string& file) { return with_details(f, 8, 2, file); }

}  // namespace dynalin
