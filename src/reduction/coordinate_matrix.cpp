#include "reduction/coordinate_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "reduction/text_scanner.h"

namespace dynalin::reduction {

namespace {

// Both triangles of a matrix that is said to be symmetric agree to this much of the geometric mean of the diagonal.
constexpr double mirrored_to = 1e-8;
constexpr std::string_view market_header = "%%MatrixMarket matrix coordinate real symmetric";

struct Entry {
  std::int32_t row, column;  // from 0
  double value;
};

struct Header {
  bool market = false;
  bool whole = false;  // both triangles are in the file
  std::int64_t rows = 0, columns = 0, entries = 0;
};

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// The line %%MatrixMarket, the comments, and the line of sizes.
bool read_market_header(TextScanner& scanner, Header& header, Diagnostics& diagnostics) {
  header.market = true;
  const Span first = scanner.line_span();
  scanner.word();
  constexpr std::array<std::string_view, 4> wanted = {"matrix", "coordinate", "real", "symmetric"};
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const std::string word = lower_case(scanner.word());
    const bool other_number = k == 2 && (word == "double" || word == "integer");
    header.whole = k == 3 && word == "general";
    if (word == wanted[k] || other_number || header.whole) continue;
    diagnostics.error("fe-matrix-header", word.empty() ? first : scanner.word_span(),
                      fmt::format("a matrix of stiffness or mass is not '{}'", word), std::string(market_header));
    return false;
  }
  while (scanner.next_line()) {
    const std::string_view word = scanner.word();
    if (word.empty() || word.starts_with('%')) continue;
    const auto rows = TextScanner::integer<std::int64_t>(word);
    const auto columns = TextScanner::integer<std::int64_t>(scanner.word());
    const auto entries = TextScanner::integer<std::int64_t>(scanner.word());
    if (rows && columns && entries && *entries >= 0 && scanner.word().empty()) {
      header.rows = *rows, header.columns = *columns, header.entries = *entries;
      return true;
    }
    diagnostics.error("fe-matrix-header", scanner.line_span(), "here rows, columns and the number of entries stand");
    return false;
  }
  diagnostics.error("fe-matrix-header", first, "the sizes of the matrix are missing");
  return false;
}

// take(entry, span of its line) for each entry; false after an error.
template <class Take>
bool for_each_line(TextScanner& scanner, Eigen::Index size, bool first_line_is_read, Diagnostics& diagnostics,
                   Take&& take) {
  if (!first_line_is_read && !scanner.next_line()) return true;
  do {
    const std::string_view first = scanner.word();
    if (first.empty() || first.starts_with('%')) continue;
    const Span at = scanner.word_span();
    const auto row = TextScanner::integer<std::int64_t>(first);
    const auto column = TextScanner::integer<std::int64_t>(scanner.word());
    const std::string_view third = scanner.word();
    const auto value = TextScanner::real(third);
    if (!row || !column || !value || !scanner.word().empty()) {
      diagnostics.error("fe-matrix-entry", scanner.line_span(), "an entry is row, column and a finite value");
      return false;
    }
    if (*row < 1 || *column < 1 || *row > size || *column > size) {
      diagnostics.error("fe-matrix-size", at,
                        fmt::format("row {}, column {} is outside the {} freedoms", *row, *column, size),
                        "freedoms and matrices belong to one model");
      return false;
    }
    take(Entry{static_cast<std::int32_t>(*row - 1), static_cast<std::int32_t>(*column - 1), *value}, at);
  } while (scanner.next_line());
  return true;
}

// The scanner stands in front of the first entry.
TextScanner at_entries(const SourceText& file, Header& header, bool& first_line_is_read, Diagnostics& diagnostics,
                       bool& good) {
  TextScanner scanner(file);
  first_line_is_read = scanner.next_line();
  good = true;
  if (!first_line_is_read) return scanner;
  const std::string first = lower_case(scanner.line());
  if (!first.starts_with("%%matrixmarket")) {
    const std::size_t word = first.find_first_not_of("% \t");
    good = word == std::string::npos || !std::string_view(first).substr(word).starts_with("matrixmarket");
    if (!good)
      diagnostics.error("fe-matrix-header", scanner.line_span(), "the header of Matrix Market begins with two %",
                        std::string(market_header));
    return scanner;
  }
  first_line_is_read = false;
  good = read_market_header(scanner, header, diagnostics);
  return scanner;
}

// Where an entry of this place stands for the last time.
Span place_of(const SourceText& file, Eigen::Index size, std::int32_t row, std::int32_t column, bool either_triangle) {
  Diagnostics unused;
  Header header;
  bool first_line_is_read = false, good = false;
  TextScanner scanner = at_entries(file, header, first_line_is_read, unused, good);
  Span found{&file, 0, 0};
  for_each_line(scanner, size, first_line_is_read, unused, [&](const Entry& e, const Span& at) {
    if ((e.row == row && e.column == column) || (either_triangle && e.row == column && e.column == row)) found = at;
  });
  return found;
}

// Sorted by columns with equal places together: the first that stands twice.
bool refuse_twice(std::vector<Entry>& entries, const SourceText& file, const Header& header, Eigen::Index size,
                  Diagnostics& diagnostics) {
  const auto key = [&](const Entry& e) {
    const auto [low, high] = std::minmax(e.row, e.column);
    return header.whole ? std::pair(e.column, e.row) : std::pair(high, low);
  };
  const auto before = [&](const Entry& a, const Entry& b) { return key(a) < key(b); };
  if (!std::is_sorted(entries.begin(), entries.end(), before)) std::sort(entries.begin(), entries.end(), before);
  const auto twice = std::adjacent_find(entries.begin(), entries.end(),
                                        [&](const Entry& a, const Entry& b) { return key(a) == key(b); });
  if (twice == entries.end()) return true;
  diagnostics.error("fe-matrix-entry", place_of(file, size, twice->row, twice->column, !header.whole),
                    fmt::format("row {}, column {} is given twice{}", twice->row + 1, twice->column + 1,
                                header.whole ? "" : ", perhaps once in each triangle"),
                    header.whole ? "" : "of a symmetric matrix one triangle is in the file");
  return false;
}

bool refuse_unsymmetric(const SparseMatrix& matrix, const SourceText& file, Diagnostics& diagnostics) {
  const SparseMatrix transposed = matrix.transpose();
  const SparseMatrix difference = matrix - transposed;
  const Eigen::VectorXd diagonal = matrix.diagonal().cwiseAbs();
  const double least = 1e-12 * (diagonal.size() ? diagonal.maxCoeff() : 0.0);
  for (Eigen::Index c = 0; c < difference.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(difference, c); it; ++it) {
      const double scale = std::sqrt(diagonal[it.row()] * diagonal[c]) + least;
      if (std::abs(it.value()) <= mirrored_to * scale) continue;
      const auto row = static_cast<std::int32_t>(it.row()), column = static_cast<std::int32_t>(c);
      diagnostics.error("fe-matrix-unsymmetric", place_of(file, matrix.rows(), row, column, true),
                        fmt::format("row {}, column {} is {:.6g}, and row {}, column {} is {:.6g}", row + 1, column + 1,
                                    matrix.coeff(row, column), column + 1, row + 1, matrix.coeff(column, row)),
                        "stiffness and mass are symmetric");
      return false;
    }
  }
  return true;
}

// Of a symmetric matrix one triangle stands in the file, whichever it is.
class OneTriangle {
 public:
  // The second of two entries on both sides of the diagonal is out of place.
  void see(const Entry& e, const Span& at) {
    if (e.row == e.column) return;
    const bool above = e.row < e.column;
    if (!above_) above_ = above;
    if (*above_ != above && !wrong_) wrong_ = at;
  }
  const std::optional<Span>& wrong() const { return wrong_; }

 private:
  std::optional<bool> above_;
  std::optional<Span> wrong_;
};

}  // namespace

std::optional<SparseMatrix> read_coordinate_matrix(const SourceText& file, Eigen::Index size,
                                                   Diagnostics& diagnostics) {
  Header header;
  bool first_line_is_read = false, good = false;
  TextScanner scanner = at_entries(file, header, first_line_is_read, diagnostics, good);
  if (!good) return std::nullopt;
  const Span whole_file{&file, 0, 0};
  if (header.market && (header.rows != size || header.columns != size)) {
    diagnostics.error("fe-matrix-size", whole_file,
                      fmt::format("the matrix has {} rows and {} columns, and there are {} freedoms", header.rows,
                                  header.columns, size),
                      "freedoms and matrices belong to one model");
    return std::nullopt;
  }
  std::vector<Entry> entries;
  // Each takes six characters at least: a number of entries out of thin air sets nothing aside.
  entries.reserve(std::min(file.text().size() / 6, static_cast<std::size_t>(header.entries)));
  OneTriangle triangle;
  std::optional<Span> first_beyond;  // what the header promises
  if (!for_each_line(scanner, size, first_line_is_read, diagnostics, [&](const Entry& e, const Span& at) {
        if (header.market && static_cast<std::int64_t>(entries.size()) == header.entries) first_beyond = at;
        entries.push_back(e);
        if (!header.whole) triangle.see(e, at);
      }))
    return std::nullopt;
  const auto count = static_cast<std::int64_t>(entries.size());
  if (header.market && count != header.entries) {
    diagnostics.error("fe-matrix-size", first_beyond.value_or(whole_file),
                      fmt::format("the header promises {} {}, and {} {} there", header.entries,
                                  header.entries == 1 ? "entry" : "entries", count, count == 1 ? "is" : "are"),
                      count < header.entries ? "the file may be cut off"
                                             : "its last number is that of the lines behind it, each one entry");
    return std::nullopt;
  }
  if (entries.empty()) {
    diagnostics.error("fe-matrix-size", whole_file, "the matrix has no entries", "an entry is row, column and value");
    return std::nullopt;
  }
  if (!refuse_twice(entries, file, header, size, diagnostics)) return std::nullopt;
  if (triangle.wrong()) {
    diagnostics.error("fe-matrix-entry", *triangle.wrong(), "the entries before are those of the other triangle",
                      "of a symmetric matrix one triangle is in the file");
    return std::nullopt;
  }
  std::vector<Eigen::Triplet<double, std::int32_t>> triplets;
  triplets.reserve(entries.size() * 2);
  for (const Entry& e : entries) {
    triplets.emplace_back(e.row, e.column, e.value);
    if (!header.whole && e.row != e.column) triplets.emplace_back(e.column, e.row, e.value);
  }
  entries = {};
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  if (header.whole) {
    if (!refuse_unsymmetric(matrix, file, diagnostics)) return std::nullopt;
    const SparseMatrix transposed = matrix.transpose();
    matrix = 0.5 * (matrix + transposed);
  }
  return matrix;
}

Span diagonal_entry(const SourceText& file, Eigen::Index size, Eigen::Index row) {
  const auto at = static_cast<std::int32_t>(row);
  return place_of(file, size, at, at, false);
}

}  // namespace dynalin::reduction
