// MATRIX/id, {FULL={RORDER | CORDER} (also FULL RORDER, as two words), ROWS=, COLUMNS=, VALUES= | SPARSE, I=, J=,
// VALUES= | FILE=} [, NAME=]
//
// A table of numbers for LSE and others: by rows or columns, by its entries that are not zero, or out of a file.
#include "elements/controls/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "base/read_file.h"
#include "dataset/characters.h"
#include "dataset/dataset.h"
#include "dataset/matrix_file.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

struct MatrixStatement {
  OptionalWord full;
  bool by_rows = false, by_columns = false, sparse = false;
  std::optional<std::int64_t> rows, columns;
  std::vector<double> values;
  std::vector<std::int64_t> row_of, column_of;
  std::string file, name;

  static constexpr std::array<Argument<MatrixStatement>, 11> arguments = {{
      {.name = "FULL",
       .slot = &MatrixStatement::full,
       .help = "RORDER: by rows; CORDER: by columns",
       .ends = "FILE SPARSE I J RORDER CORDER"},
      {.name = "RORDER", .slot = &MatrixStatement::by_rows, .help = "behind FULL: by rows"},
      {.name = "CORDER", .slot = &MatrixStatement::by_columns, .help = "behind FULL: by columns"},
      {.name = "SPARSE",
       .slot = &MatrixStatement::sparse,
       .help = "only entries that are not zero",
       .ends = "FILE FULL RORDER CORDER ROWS COLUMNS"},
      {.name = "ROWS", .slot = &MatrixStatement::rows, .minimum = 1, .help = "number of rows"},
      {.name = "COLUMNS", .slot = &MatrixStatement::columns, .minimum = 1, .help = "number of columns"},
      {.name = "VALUES", .slot = &MatrixStatement::values, .help = "the numbers"},
      {.name = "I", .slot = &MatrixStatement::row_of, .help = "rows of the VALUES"},
      {.name = "J", .slot = &MatrixStatement::column_of, .help = "columns of the VALUES"},
      {.name = "FILE",
       .slot = &MatrixStatement::file,
       .help = "file that holds the matrix",
       .ends = "FULL RORDER CORDER SPARSE ROWS COLUMNS VALUES I J"},
      {.name = "NAME", .slot = &MatrixStatement::name, .help = "its name in the file, and what FLEX_BODY knows it by"},
  }};
};

constexpr std::int64_t most_values = 100'000'000;  // all entries are kept, zeros too

class MatrixSet final : public TypedSet<Matrix> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    MatrixStatement m;
    if (!read_arguments(m, reader)) return;
    const std::string owner = reader.label().text();
    const int forms = m.full.given + m.sparse + !m.file.empty();
    if (forms > 1) {
      const std::string_view one = m.full.given ? "FULL" : "SPARSE", other = m.file.empty() ? "SPARSE" : "FILE";
      reader.error("excluded-arguments", reader.at(other),
                   fmt::format("{} and {} of {} exclude each other", one, other, owner));
    } else if (forms == 0) {
      reader.error("missing-argument", reader.statement().at,
                   fmt::format("{} needs one of FULL, SPARSE and FILE", owner));
    } else if (!m.file.empty()) {
      read_from_file(m, elements[k], reader);
    } else if (m.sparse) {
      read_sparse(m, elements[k], reader);
    } else {
      read_full(m, elements[k], reader);
    }
    const Span at = reader.at(m.file.empty() ? "VALUES" : "FILE");
    for (const WrittenArgument& w : reader.statement().arguments) {
      if (w.name.offset == at.offset && w.name.source == at.source) elements[k].values_at = w.value_span();
    }
    elements[k].name = m.name;
    for (char& c : elements[k].name) c = to_upper(c);
  }

  void finish(Model& model, Diagnostics&) override {
    for (std::size_t k = 0; k < elements.size() && model.routine_data; ++k) {
      const Matrix& m = elements[k];
      model.routine_data->matrices[static_cast<int>(labels[k].id)] = {
          m.rows, m.columns, m.written == Matrix::Written::by_entries, m.values};
    }
  }

 private:
  static void read_full(const MatrixStatement& m, Matrix& out, ElementReader& reader) {
    static constexpr std::array<std::string_view, 2> orders = {"RORDER", "CORDER"};
    std::optional<std::size_t> order;
    if (!m.full.word.empty()) order = find_keyword(m.full.word, orders);
    if (m.by_rows != m.by_columns && m.full.word.empty()) order = m.by_columns ? 1 : 0;
    if (!order || (!m.full.word.empty() && (m.by_rows || m.by_columns))) {
      reader.error("unknown-word", reader.at("FULL"),
                   m.full.word.empty() || order ? "FULL is either RORDER or CORDER"
                                                : fmt::format("FULL is RORDER or CORDER, not {}", m.full.word));
    }
    if (!m.rows || !m.columns) {
      reader.error("missing-argument", reader.at("FULL"), "FULL needs ROWS and COLUMNS");
      return;
    }
    const auto rows = static_cast<std::size_t>(*m.rows), columns = static_cast<std::size_t>(*m.columns);
    // Divided, because the product of what is written may be too large for any number.
    if (m.values.size() / rows != columns || m.values.size() % rows != 0) {
      reader.error("wrong-count", reader.at("VALUES"),
                   fmt::format("{} × {} values are needed, {} are given", rows, columns, m.values.size()));
      return;
    }
    out = {rows, columns, m.values, {}, Matrix::Written::by_columns, {}};
    if (order && *order == 1) return;
    out.written = Matrix::Written::by_rows;
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < columns; ++c) out.values[c * rows + r] = m.values[r * columns + c];
    }
  }

  static void read_sparse(const MatrixStatement& m, Matrix& out, ElementReader& reader) {
    if (m.row_of.size() != m.values.size() || m.column_of.size() != m.values.size() || m.values.empty()) {
      reader.error("wrong-count", reader.at("SPARSE"),
                   fmt::format("I, J and VALUES must have the same length, they have {}, {} and {}", m.row_of.size(),
                               m.column_of.size(), m.values.size()));
      return;
    }
    const auto rows = m.rows.value_or(*std::max_element(m.row_of.begin(), m.row_of.end()));
    const auto columns = m.columns.value_or(*std::max_element(m.column_of.begin(), m.column_of.end()));
    for (std::size_t k = 0; k < m.values.size(); ++k) {
      if (m.row_of[k] < 1 || m.row_of[k] > rows || m.column_of[k] < 1 || m.column_of[k] > columns) {
        reader.error("value-out-of-range", reader.at("I"),
                     fmt::format("entry {}, {} lies outside of {} × {}", m.row_of[k], m.column_of[k], rows, columns));
        return;
      }
    }
    if (rows > most_values / columns) {
      reader.error("value-out-of-range", reader.at("SPARSE"),
                   fmt::format("{} has {} × {} entries, at most {} are available", reader.label().text(), rows, columns,
                               most_values));
      return;
    }
    out.rows = static_cast<std::size_t>(rows), out.columns = static_cast<std::size_t>(columns);
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < m.values.size(); ++k) {
      places.push_back(static_cast<std::size_t>(m.column_of[k] - 1) * out.rows +
                       static_cast<std::size_t>(m.row_of[k] - 1));
    }
    if (stated_twice(m, places, reader)) return;
    out.written = Matrix::Written::by_entries;
    out.values.assign(out.rows * out.columns, 0.0);
    for (std::size_t k = 0; k < m.values.size(); ++k) out.values[places[k]] = m.values[k];
  }

  // Where number k of the list I is written.
  static Span row_at(std::size_t k, ElementReader& reader) {
    const Span name = reader.at("I");
    Diagnostics said_already;
    for (const WrittenArgument& w : reader.statement().arguments) {
      if (w.name.offset != name.offset || w.name.source != name.source) continue;
      const auto rows = read_integers(w, *name.source, said_already);
      return rows && k < rows->size() ? (*rows)[k].at : name;
    }
    return name;
  }

  // Whether a place of the matrix has two numbers. None of them is the one that counts, nor is it said that they add
  // up.
  static bool stated_twice(const MatrixStatement& m, const std::vector<std::size_t>& places, ElementReader& reader) {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    const auto first = std::adjacent_find(order.begin(), order.end(),
                                          [&](std::size_t a, std::size_t b) { return places[a] == places[b]; });
    if (first == order.end()) return false;
    const std::size_t k = *first, again = *std::next(first);
    reader.diagnostics()
        .error("matrix-entry", row_at(again, reader),
               fmt::format("entry {}, {} of {} is stated twice, as {} and as {}", m.row_of[k], m.column_of[k],
                           reader.label().text(), m.values[k], m.values[again]),
               "state their sum if both are meant")
        .notes = {
        {row_at(k, reader), fmt::format("here as entry {}, then as entry {} of the lists", k + 1, again + 1)}};
    return true;
  }

  static void read_from_file(const MatrixStatement& m, Matrix& out, ElementReader& reader) {
    if (m.name.empty()) {
      reader.error("missing-argument", reader.at("FILE"), "FILE needs NAME, the name of the matrix in it");
      return;
    }
    const std::filesystem::path path = std::filesystem::path(reader.folder()) / m.file;
    reader.reads(path.string());
    auto text = dynalin::read_file(path.string());
    if (!text) {
      reader.error(
          "unreadable-file", reader.at("FILE"),
          fmt::format("the file {} of {} cannot be read: {}", path.string(), reader.label().text(), text.error()));
      return;
    }
    const auto source = std::make_shared<const SourceText>(path.string(), std::move(*text));
    reader.keep(source);
    auto matrix = read_matrix(*source, m.name, reader.at("NAME"), reader.diagnostics());
    if (matrix)
      out = {static_cast<std::size_t>(matrix->rows),
             static_cast<std::size_t>(matrix->columns),
             std::move(matrix->values),
             {},
             Matrix::Written::in_a_file,
             {}};
  }
};

}  // namespace

Span place_of(const Matrix& m, std::size_t row, std::size_t column) {
  const bool by_rows = m.written == Matrix::Written::by_rows;
  if (!m.values_at.source || (!by_rows && m.written != Matrix::Written::by_columns)) return m.values_at;
  // The arguments of a dataset are not kept: the list is read once more.
  const std::string before = "t\nARRAY/1, NUMBERS=";
  const auto source = std::make_shared<const SourceText>("", before + std::string(m.values_at.text()) + "\n");
  const auto again = parse_dataset(source);
  if (again.value.statements.empty() || again.value.statements.front().arguments.empty()) return m.values_at;
  const auto tokens = again.value.statements.front().arguments.front().value();
  std::size_t left = by_rows ? row * m.columns + column : column * m.rows + row;
  for (std::size_t k = 0; k < tokens.size(); ++k) {
    if (tokens[k].kind != TokenKind::number || left-- > 0) continue;
    const bool sign = k > 0 && tokens[k - 1].kind == TokenKind::symbol &&
                      std::string_view("+-").find(source->text()[tokens[k - 1].offset]) != std::string_view::npos;
    const std::uint32_t from = tokens[sign ? k - 1 : k].offset, to = tokens[k].offset + tokens[k].length;
    return {m.values_at.source, m.values_at.offset + from - static_cast<std::uint32_t>(before.size()), to - from};
  }
  return m.values_at;
}

namespace {

constexpr ToldBeforehand told_of_matrix = {
    .data = [](const StatementWords& s, RoutineData& data) { data.matrices[s.id()]; }, .makes_modes = true};

}  // namespace

extern constinit const Kind matrix = Kind{
    "MATRIX",
    "",
    "A table of numbers, written out or from a file.",
    Kind::Role::element,
    detail::argument_infos<MatrixStatement>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<MatrixSet>(kind);
    }}.telling(told_of_matrix);

}  // namespace dynalin
