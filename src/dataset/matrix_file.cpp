#include "dataset/matrix_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "dataset/characters.h"
#include "dataset/matrix_values.h"

namespace dynalin {

namespace {

enum class FileType { unknown, adamsmat, fsave };
enum class Layout { by_rows, by_columns, sparse };

struct Header {
  Span name;
  std::size_t line = 0;
  Layout layout = Layout::by_columns;
  bool complete = false;  // all numbers and the format are there
  bool complex = false;
  std::int64_t rows = 0, columns = 0;
  std::int64_t entries = 0;  // as written; of a sparse matrix the triples
  std::string_view format;
};

struct Contents {
  std::vector<Header> headers;
  std::vector<Span> directory;  // names that the start of the file promises
};

constexpr std::int64_t most_values = 100'000'000;

// Reads words and whole numbers along one line. Names have at most ten characters and numbers five,
// so that fields of the MATRIXx layout which touch (`6BC`, 10-digit pairs) come apart.
class LineReader {
 public:
  LineReader(const SourceText& file, std::string_view line) : file_(file), line_(line) {}

  char next() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
    return at_ < line_.size() ? line_[at_] : '\0';
  }
  std::optional<Span> name() {
    if (!is_word_start(next())) return std::nullopt;
    constexpr std::size_t longest = 10;
    std::size_t end = at_;
    while (end < line_.size() && is_word_part(line_[end])) ++end;
    // Digits behind ten characters are the number of rows.
    const std::string_view tail = line_.substr(at_, end - at_).substr(std::min(longest, end - at_));
    if (!tail.empty() && std::all_of(tail.begin(), tail.end(), is_digit)) end = at_ + longest;
    return take(end);
  }
  std::optional<std::int64_t> integer(std::size_t longest) {
    if (!is_digit(next())) return std::nullopt;
    std::size_t end = at_;
    while (end < line_.size() && is_digit(line_[end])) ++end;
    if (end - at_ > longest && end - at_ <= 2 * longest) end -= longest;
    const std::string_view digits = take(end).text();
    std::int64_t value = 0;
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (parsed.ec != std::errc{} || value > std::numeric_limits<std::int32_t>::max()) {
      return std::nullopt;
    }
    return value;
  }
  // From a parenthesis to the last one of the line.
  std::string_view format() {
    if (next() != '(') return {};
    const std::size_t last = line_.rfind(')');
    return last == std::string_view::npos ? std::string_view{} : line_.substr(at_, last + 1 - at_);
  }

 private:
  Span take(std::size_t end) {
    const Span result{&file_,
                      static_cast<std::uint32_t>(line_.data() - file_.text().data()) + static_cast<std::uint32_t>(at_),
                      static_cast<std::uint32_t>(end - at_)};
    at_ = end;
    return result;
  }

  const SourceText& file_;
  std::string_view line_;
  std::size_t at_ = 0;
};

constexpr std::size_t fsave_digits = 5;
constexpr std::size_t any_digits = 10;

FileType type_of(const SourceText& file) {
  const std::string_view first = file.line(1);
  if (first.starts_with("ADAMSMAT")) return FileType::adamsmat;
  if (first.starts_with("MATRIXx") || first.starts_with("MATSAVE")) return FileType::fsave;
  return FileType::unknown;
}

// `AC  6  6  0(1P3E25.17)` is a header; `AC  6  6BC  6  3` a line of the directory.
void read_fsave_line(const SourceText& file, std::size_t number, Contents& contents) {
  LineReader reader(file, file.line(number));
  std::vector<Span> names;
  while (const std::optional<Span> name = reader.name()) {
    const auto rows = reader.integer(fsave_digits);
    const auto columns = rows ? reader.integer(fsave_digits) : std::nullopt;
    if (!columns) break;
    names.push_back(*name);
    const auto imaginary = reader.integer(fsave_digits);
    const bool is_header = names.size() == 1 && (imaginary || reader.next() == '(');
    if (!is_header) continue;
    Header header;
    header.name = *name;
    header.line = number;
    header.complex = imaginary.value_or(0) != 0;
    header.rows = *rows;
    header.columns = *columns;
    header.entries = *rows * *columns;
    header.format = reader.format();
    header.complete = imaginary.has_value() && !header.format.empty();
    contents.headers.push_back(header);
    return;
  }
  if (contents.headers.empty()) {
    contents.directory.insert(contents.directory.end(), names.begin(), names.end());
  }
}

// `TRF FULL RORDER 4 2 8 ( 8F8.5 )` is a header; every other line of words lists names.
void read_adamsmat_line(const SourceText& file, std::size_t number, Contents& contents) {
  LineReader reader(file, file.line(number));
  const std::optional<Span> name = reader.name();
  if (!name) return;
  std::optional<Span> word = reader.name();
  const bool full = word && equal_ignoring_case(word->text(), "FULL");
  const bool sparse = word && equal_ignoring_case(word->text(), "SPARSE");
  if (!full && !sparse) {
    if (!contents.headers.empty()) return;
    contents.directory.push_back(*name);
    for (; word; word = reader.name()) contents.directory.push_back(*word);
    return;
  }
  Header header;
  header.name = *name;
  header.line = number;
  const std::optional<Span> order = reader.name();
  const bool rows_first = order && equal_ignoring_case(order->text(), "RORDER");
  const bool columns_first = order && equal_ignoring_case(order->text(), "CORDER");
  header.layout = sparse ? Layout::sparse : rows_first ? Layout::by_rows : Layout::by_columns;
  const auto rows = reader.integer(any_digits);
  const auto columns = rows ? reader.integer(any_digits) : std::nullopt;
  const auto entries = columns ? reader.integer(any_digits) : std::nullopt;
  header.rows = rows.value_or(0);
  header.columns = columns.value_or(0);
  header.entries = entries.value_or(0);
  header.format = reader.format();
  header.complete = entries && (sparse || rows_first || columns_first) && !header.format.empty();
  contents.headers.push_back(header);
}

Contents read_contents(const SourceText& file) {
  Contents contents;
  const FileType type = type_of(file);
  for (std::size_t number = 2; number <= file.line_count(); ++number) {
    // Lines of values are by far the most, and no name stands in them.
    const std::string_view line = file.line(number);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || !is_word_start(line[first])) continue;
    if (type == FileType::adamsmat) read_adamsmat_line(file, number, contents);
    if (type == FileType::fsave) read_fsave_line(file, number, contents);
  }
  return contents;
}

std::string list_of_names(const Contents& contents) {
  constexpr std::size_t most = 20;
  if (contents.headers.empty()) return "the file holds no matrix";
  std::string list = "the file holds ";
  for (std::size_t i = 0; i < contents.headers.size(); ++i) {
    if (i == most) return list + fmt::format(" and {} more", contents.headers.size() - most);
    const bool last = i + 1 == contents.headers.size();
    if (i > 0) list += last ? " and " : ", ";
    list += contents.headers[i].name.text();
  }
  return list;
}

Span first_line(const SourceText& file) { return {&file, 0, static_cast<std::uint32_t>(file.line(1).size())}; }

const Header* find_header(const SourceText& file, const Contents& contents, std::string_view name, const Span& asked_at,
                          Diagnostics& diagnostics) {
  const Span at = asked_at.source ? asked_at : first_line(file);
  if (name.empty()) {
    if (contents.headers.size() == 1) return &contents.headers[0];
    diagnostics.error("matrix-missing", at,
                      fmt::format("{} holds {} matrices, and none is named", file.name(), contents.headers.size()),
                      list_of_names(contents));
    return nullptr;
  }
  const auto named = [&](const Span& span) { return equal_ignoring_case(span.text(), name); };
  for (const Header& header : contents.headers) {
    if (named(header.name)) return &header;
  }
  const auto promised = std::find_if(contents.directory.begin(), contents.directory.end(), named);
  if (promised != contents.directory.end()) {
    diagnostics.error("matrix-truncated", *promised,
                      fmt::format("{} is in the directory of the file, but its values are not there", promised->text()),
                      list_of_names(contents));
    return nullptr;
  }
  diagnostics.error("matrix-missing", at, fmt::format("{} has no matrix {}", file.name(), name),
                    list_of_names(contents));
  return nullptr;
}

// Whether the numbers of the header agree with each other and with the size of the file.
bool check_header(const Header& header, const SourceText& file, Diagnostics& diagnostics) {
  const std::string_view line = file.line(header.line);
  const Span at{&file, static_cast<std::uint32_t>(line.data() - file.text().data()),
                static_cast<std::uint32_t>(line.size())};
  const std::string name(header.name.text());
  if (!header.complete) {
    diagnostics.error("matrix-header", at, fmt::format("the header of {} is incomplete", name),
                      type_of(file) == FileType::fsave
                          ? "it holds name, rows, columns, 0 and a format"
                          : "it holds name, FULL RORDER, FULL CORDER or SPARSE, rows, columns, the "
                            "number of values and a format");
    return false;
  }
  const std::int64_t size = header.rows * header.columns;
  if (header.layout != Layout::sparse && header.entries != size) {
    diagnostics.error(
        "matrix-header", at,
        fmt::format("{} has {} rows and {} columns, but {} values", name, header.rows, header.columns, header.entries));
    return false;
  }
  if (header.complex) {
    diagnostics.error("matrix-complex", at, fmt::format("{} has imaginary parts", name));
    return false;
  }
  // Every number takes one character at least: nothing is set aside for a number of rows out of
  // thin air.
  const auto characters = static_cast<std::int64_t>(file.text().size());
  if (header.entries > characters) {
    diagnostics.error("matrix-truncated", at,
                      fmt::format("{} needs {} values, for which the file is too short", name, header.entries));
    return false;
  }
  if (size > most_values) {
    diagnostics.error("matrix-header", at, fmt::format("{} has more than {} entries", name, most_values));
    return false;
  }
  return true;
}

// Triples of row, column and value.
bool fill_sparse(const Header& header, const std::vector<double>& triples, MatrixData& matrix,
                 Diagnostics& diagnostics) {
  std::vector<bool> given(matrix.values.size());
  for (std::size_t i = 0; i < triples.size(); i += 3) {
    const double row = triples[i], column = triples[i + 1];
    const bool whole = row == std::floor(row) && column == std::floor(column);
    const bool inside = row >= 1 && row <= matrix.rows && column >= 1 && column <= matrix.columns;
    const std::size_t index = whole && inside
                                  ? static_cast<std::size_t>(column - 1) * static_cast<std::size_t>(matrix.rows) +
                                        static_cast<std::size_t>(row - 1)
                                  : 0;
    if (!whole || !inside || given[index]) {
      diagnostics.error("matrix-entry", header.name,
                        fmt::format("entry {} of {} is for row {}, column {}, which {}", i / 3 + 1, matrix.name, row,
                                    column, whole && inside ? "is given twice" : "does not exist"));
      return false;
    }
    given[index] = true;
    matrix.values[index] = triples[i + 2];
  }
  return true;
}

std::vector<double> transposed(const std::vector<double>& by_rows, std::size_t rows, std::size_t columns) {
  std::vector<double> by_columns(by_rows.size());
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) by_columns[j * rows + i] = by_rows[i * columns + j];
  }
  return by_columns;
}

}  // namespace

std::optional<MatrixData> read_matrix(const SourceText& file, std::string_view name, const Span& asked_at,
                                      Diagnostics& diagnostics) {
  if (type_of(file) == FileType::unknown) {
    diagnostics.error("matrix-file-type", first_line(file),
                      fmt::format("{} is not a known file of matrices", file.name()),
                      "its first line begins with ADAMSMAT, MATRIXx or MATSAVE, in this spelling");
    return std::nullopt;
  }
  const Contents contents = read_contents(file);
  const Header* header = find_header(file, contents, name, asked_at, diagnostics);
  if (!header || !check_header(*header, file, diagnostics)) return std::nullopt;

  MatrixData matrix;
  matrix.name = header->name.text();
  matrix.rows = static_cast<std::int32_t>(header->rows);
  matrix.columns = static_cast<std::int32_t>(header->columns);
  const bool last = header == &contents.headers.back();
  const std::size_t end_line = last ? file.line_count() + 1 : (header + 1)->line;
  const bool sparse = header->layout == Layout::sparse;
  const auto count = static_cast<std::size_t>(header->entries) * (sparse ? 3 : 1);
  auto values = read_matrix_values({file, matrix.name, header->name, header->line + 1, end_line, count, header->format},
                                   diagnostics);
  if (!values) return std::nullopt;
  if (sparse) {
    matrix.values.assign(static_cast<std::size_t>(header->rows * header->columns), 0.0);
    if (!fill_sparse(*header, *values, matrix, diagnostics)) return std::nullopt;
  } else if (header->layout == Layout::by_rows) {
    matrix.values =
        transposed(*values, static_cast<std::size_t>(header->rows), static_cast<std::size_t>(header->columns));
  } else {
    matrix.values = std::move(*values);
  }
  return matrix;
}

}  // namespace dynalin
