#include "dataset/matrix_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

namespace dynalin {

namespace {

bool equal_names(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Walks through the text of one file; every read remembers where it began.
class MatrixFile {
 public:
  MatrixFile(const SourceRef& source, Diagnostics& diagnostics) : source_(source), text_(source->text()), diagnostics_(diagnostics) {}

  std::optional<FileMatrix> read(std::string_view wanted) {
    if (text_.starts_with("MATRIXx")) return read_fsave(wanted);
    if (text_.starts_with("ADAMSMAT")) return read_adamsmat(wanted);
    return fail("matrix-file-type", 0, "the first record names none of the known matrix files", "MATRIXx or ADAMSMAT");
  }

 private:
  std::nullopt_t fail(std::string_view code, std::size_t at, std::string message, std::string hint = {}) {
    const auto last = text_.empty() ? 0 : text_.size() - 1;
    diagnostics_.error(code, {source_.get(), static_cast<std::uint32_t>(std::min(at, last)), 1}, std::move(message), std::move(hint));
    return std::nullopt;
  }
  std::nullopt_t missing(std::string_view wanted, const std::vector<std::string>& present) {
    return fail("matrix-missing", 0, fmt::format("there is no matrix {} in this file", wanted), fmt::format("it has {}", fmt::join(present, ", ")));
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  void skip_line() {
    const std::size_t end = text_.find('\n', at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
  }
  std::optional<std::string> read_name() {
    skip_spaces();
    if (at_ >= text_.size() || !is_letter(text_[at_])) return std::nullopt;
    const std::size_t first = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_')) ++at_;
    return std::string(text_.substr(first, at_ - first));
  }
  std::optional<std::size_t> read_count() {
    skip_spaces();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) return std::nullopt;
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  // A number in FORTRAN style: D and E exponents, and neighbours that touch because the next one has a sign.
  std::optional<double> read_number() {
    skip_spaces();
    std::string number;
    std::size_t k = at_;
    for (; k < text_.size(); ++k) {
      const char c = text_[k];
      const bool sign = c == '+' || c == '-';
      if (sign && !number.empty() && number.back() != 'e') break;
      if (c == 'd' || c == 'D' || c == 'E' || c == 'e') {
        number += 'e';
      } else if (is_digit(c) || c == '.' || sign) {
        if (!(c == '+' && number.empty())) number += c;
      } else {
        break;
      }
    }
    // from_chars knows no plus sign in front of the number, but takes the one of the exponent.
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || number.empty() || !std::isfinite(value)) return std::nullopt;
    at_ = k;
    return value;
  }

  std::optional<FileMatrix> read_values(std::string_view name, std::size_t rows, std::size_t columns, bool by_rows) {
    FileMatrix m{rows, columns, {}};
    if (rows == 0 || columns == 0 || rows > 100000 || columns > 100000 || rows * columns > text_.size()) {
      return fail("matrix-header", at_, fmt::format("the matrix {} cannot have {} × {} entries", name, rows, columns));
    }
    m.values.assign(rows * columns, 0.0);
    for (std::size_t k = 0; k < rows * columns; ++k) {
      const auto v = read_number();
      if (!v) {
        skip_spaces();
        const bool ended = at_ >= text_.size();
        return fail(ended ? "matrix-truncated" : "matrix-number", at_,
                    fmt::format("value {} of {} of the matrix {} {}", k + 1, rows * columns, name, ended ? "is missing" : "is no number"));
      }
      const std::size_t place = by_rows ? (k % columns) * rows + k / columns : k;
      m.values[place] = *v;
    }
    return m;
  }

  // Directory of name, rows, columns; then for each matrix the same with an imaginary flag and a format.
  std::optional<FileMatrix> read_fsave(std::string_view wanted) {
    std::vector<std::string> present;
    const std::size_t version = text_.find("VERSION");
    if (version == std::string_view::npos) return fail("matrix-header", 0, "the first record has no VERSION");
    at_ = version + 7;
    if (!read_count()) return fail("matrix-header", at_, "the first record has no version number");
    const auto count = read_count();
    if (!count) return fail("matrix-header", at_, "the first record does not say how many matrices follow");
    skip_line();
    for (std::size_t k = 0; k < *count; ++k) {
      const auto name = read_name();
      if (!name || !read_count() || !read_count()) return fail("matrix-header", at_, "the directory of matrices is incomplete");
      present.push_back(*name);
    }
    if (std::none_of(present.begin(), present.end(), [&](const auto& n) { return equal_names(n, wanted); })) return missing(wanted, present);
    for (std::size_t k = 0; k < *count; ++k) {
      const auto name = read_name();
      const auto rows = name ? read_count() : std::nullopt;
      const auto columns = rows ? read_count() : std::nullopt;
      const auto imaginary = columns ? read_count() : std::nullopt;
      if (!imaginary) return fail("matrix-header", at_, fmt::format("the header of matrix {} is incomplete", k + 1));
      skip_line();  // the rest of the record is the FORTRAN format
      const bool found = equal_names(*name, wanted);
      if (found && *imaginary != 0) return fail("matrix-complex", at_, fmt::format("the matrix {} is complex", *name));
      auto m = read_values(*name, *rows, *columns, false);
      if (!m) return std::nullopt;
      if (found) return m;
      for (std::size_t i = 0; *imaginary != 0 && i < *rows * *columns; ++i) read_number();
    }
    return missing(wanted, present);
  }

  // Number of matrices, their names, then each with FULL, order, rows, columns, number of values and format.
  std::optional<FileMatrix> read_adamsmat(std::string_view wanted) {
    skip_line();
    const auto count = read_count();
    if (!count) return fail("matrix-header", at_, "the second record does not say how many matrices follow");
    std::vector<std::string> present;
    for (std::size_t k = 0; k < *count; ++k) {
      const auto name = read_name();
      if (!name) return fail("matrix-header", at_, "the names of the matrices are incomplete");
      present.push_back(*name);
    }
    if (std::none_of(present.begin(), present.end(), [&](const auto& n) { return equal_names(n, wanted); })) return missing(wanted, present);
    for (std::size_t k = 0; k < *count; ++k) {
      const auto name = read_name();
      const auto storage = name ? read_name() : std::nullopt;
      if (storage && equal_names(*storage, "SPARSE")) return fail("matrix-format", at_, "sparse matrices in files are not available yet");
      const auto order = storage ? read_name() : std::nullopt;
      const auto rows = order ? read_count() : std::nullopt;
      const auto columns = rows ? read_count() : std::nullopt;
      const auto values = columns ? read_count() : std::nullopt;
      if (!values || *values != *rows * *columns) return fail("matrix-header", at_, fmt::format("the header of matrix {} is incomplete or its counts disagree", k + 1));
      skip_line();
      auto m = read_values(*name, *rows, *columns, equal_names(*order, "RORDER"));
      if (!m) return std::nullopt;
      if (equal_names(*name, wanted)) return m;
    }
    return missing(wanted, present);
  }

  const SourceRef& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<FileMatrix> read_matrix_file(const SourceRef& source, std::string_view name, Diagnostics& diagnostics) {
  return MatrixFile(source, diagnostics).read(name);
}

}  // namespace dynalin
