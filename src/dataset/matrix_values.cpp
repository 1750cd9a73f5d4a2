#include "dataset/matrix_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dataset/characters.h"
#include "dataset/fortran_format.h"
#include "dataset/number.h"
#include "dataset/tokens.h"

namespace dynalin {

namespace {

enum class ShortExponent { no, yes };  // 1.5-005, where FORTRAN dropped the letter

std::optional<double> parse_number(std::string_view text, ShortExponent short_exponent) {
  const bool negative = !text.empty() && text[0] == '-';
  if (negative || (!text.empty() && text[0] == '+')) text.remove_prefix(1);
  const NumberExtent extent = number_extent(text, ExponentLetter::e_or_d);
  if (extent.length == 0) return std::nullopt;
  double value = 0;
  if (extent.length == text.size()) {
    value = number_value(text);
  } else {
    const bool sign = text[extent.length] == '+' || text[extent.length] == '-';
    if (short_exponent == ShortExponent::no || !sign || extent.has_exponent) return std::nullopt;
    std::string with_letter(text);
    with_letter.insert(extent.length, 1, 'E');
    if (number_extent(with_letter, ExponentLetter::e).length != with_letter.size()) {
      return std::nullopt;
    }
    value = number_value(with_letter);
  }
  return negative ? -value : value;
}

struct FreeValues {
  std::vector<double> values;
  Span bad, surplus, without_point;  // the first of each; without source if there is none
};

Span span_in(const SourceText& file, std::string_view part) {
  return {&file, static_cast<std::uint32_t>(part.data() - file.text().data()), static_cast<std::uint32_t>(part.size())};
}

// Numbers with blanks or commas between them, on any number of lines.
FreeValues read_free(const MatrixBlock& block) {
  FreeValues result;
  for (std::size_t number = block.first_line; number < block.end_line; ++number) {
    const std::string_view line = block.file.line(number);
    const auto separates = [](char c) { return is_blank(c) || c == ','; };
    for (std::size_t i = 0; i < line.size();) {
      if (separates(line[i])) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < line.size() && !separates(line[end])) ++end;
      const std::string_view word = line.substr(i, end - i);
      i = end;
      const std::optional<double> value = parse_number(word, ShortExponent::no);
      if (!value) {
        result.bad = span_in(block.file, word);
        return result;
      }
      const bool point = word.find('.') != std::string_view::npos;
      if (!point && *value != 0 && !result.without_point.source) {
        result.without_point = span_in(block.file, word);
      }
      if (result.values.size() == block.value_count && !result.surplus.source) {
        result.surplus = span_in(block.file, word);
      }
      result.values.push_back(*value);
    }
  }
  return result;
}

struct ColumnValues {
  std::vector<double> values;
  Span implied;  // the first number but 0 whose point the format implies; without source if there is none
};

// Numbers in the columns that the format says; nothing if the text does not fit it exactly. A number without a point
// has it where the format says: 150 is 1.50 in F4.2.
std::optional<ColumnValues> read_columns(const MatrixBlock& block, const FortranFormat& format) {
  ColumnValues result;
  std::vector<double>& values = result.values;
  std::size_t line_number = block.first_line;
  std::size_t column = 0, item = 0;
  const auto blank = [](std::string_view text) { return std::all_of(text.begin(), text.end(), is_blank); };
  while (values.size() < block.value_count) {
    if (line_number >= block.end_line) return std::nullopt;
    const std::string_view line = block.file.line(line_number);
    const std::string_view rest = line.substr(std::min(column, line.size()));
    const bool at_end = item == format.items.size();
    if (at_end || format.items[item].kind == FortranItem::Kind::next_record) {
      if (!blank(rest)) return std::nullopt;
      item = at_end ? format.again : item + 1;
      ++line_number;
      column = 0;
      continue;
    }
    const FortranItem& field = format.items[item++];
    if (field.kind == FortranItem::Kind::number) {
      std::string_view text = rest.substr(0, field.width);
      while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
      while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
      const std::optional<double> value = parse_number(text, ShortExponent::yes);
      if (!value) return std::nullopt;
      // One that ends before its column does was written free of them.
      const bool implied = field.decimals > 0 && rest.size() >= field.width && text.find('.') == std::string_view::npos;
      values.push_back(implied ? *value / std::pow(10.0, static_cast<double>(field.decimals)) : *value);
      if (implied && *value != 0 && !result.implied.source) result.implied = span_in(block.file, text);
    } else if (!blank(rest.substr(0, field.width))) {
      return std::nullopt;
    }
    column += field.width;
  }
  const std::string_view last = block.file.line(line_number);
  if (!blank(last.substr(std::min(column, last.size())))) return std::nullopt;
  for (++line_number; line_number < block.end_line; ++line_number) {
    if (!blank(block.file.line(line_number))) return std::nullopt;
  }
  return result;
}

// Behind the last character of the values that are there.
Span end_of_values(const MatrixBlock& block) {
  for (std::size_t number = block.end_line; number-- > block.first_line;) {
    const std::string_view line = block.file.line(number);
    const std::size_t last = line.find_last_not_of(" \t");
    if (last != std::string_view::npos) return span_in(block.file, line.substr(last + 1, 0));
  }
  return block.header;
}

void report(const MatrixBlock& block, const FreeValues& found, bool format_known, Diagnostics& diagnostics) {
  if (found.bad.source) {
    diagnostics.error(
        "matrix-number", found.bad,
        fmt::format("the values of {} end in {}, which is not a number", block.name, quoted(found.bad.text())),
        format_known ? fmt::format("nor do the values fit the columns of {}", block.format)
                     : fmt::format("the format {} is not understood", block.format));
    return;
  }
  const std::string message =
      fmt::format("{} needs {} values, {} found", block.name, block.value_count, found.values.size());
  if (found.surplus.source) {
    diagnostics.error("matrix-count", found.surplus, message);
    return;
  }
  const bool file_ends = block.end_line > block.file.line_count();
  diagnostics.error(file_ends ? "matrix-truncated" : "matrix-count", end_of_values(block),
                    file_ends ? message + " before the file ends" : message);
}

// Numbers that stand free of the columns: as they are written.
void warn_about_numbers_as_written(const FreeValues& found, const FortranFormat& format, Diagnostics& diagnostics) {
  // In a format that mixes whole numbers and others it is not known which this one is.
  const bool implied = std::all_of(format.items.begin(), format.items.end(), [](const auto& item) {
    return item.kind != FortranItem::Kind::number || item.decimals > 0;
  });
  if (!implied || found.without_point.text().find_first_of("eEdD") != std::string_view::npos) return;
  diagnostics.warning(
      "matrix-implied-point", found.without_point,
      fmt::format("{} is read as it stands, where FORTRAN would imply a decimal point", found.without_point.text()),
      "write the point");
}

std::vector<double> values_in_columns(const MatrixBlock& block, ColumnValues found, Diagnostics& diagnostics) {
  if (found.implied.source)
    diagnostics.warning(
        "matrix-implied-point", found.implied,
        fmt::format("{} is read with the decimal point that {} implies", found.implied.text(), block.format),
        "write the point");
  return std::move(found.values);
}

}  // namespace

std::optional<std::vector<double>> read_matrix_values(const MatrixBlock& block, Diagnostics& diagnostics) {
  FreeValues free = read_free(block);
  const std::optional<FortranFormat> format = parse_fortran_format(block.format);
  std::optional<std::vector<double>> values;
  const bool reads_free = !free.bad.source && free.values.size() == block.value_count;
  // Numbers with points are the same either way.
  if (format && (!reads_free || free.without_point.source)) {
    auto columns = read_columns(block, *format);
    if (columns && (!reads_free || columns->implied.source))
      values = values_in_columns(block, std::move(*columns), diagnostics);
  }
  if (!values && reads_free) {
    if (format && free.without_point.source) warn_about_numbers_as_written(free, *format, diagnostics);
    values = std::move(free.values);
  }
  if (!values) {
    report(block, free, format.has_value(), diagnostics);
    return std::nullopt;
  }
  const bool finite = std::all_of(values->begin(), values->end(), [](double value) { return std::isfinite(value); });
  if (finite) return values;
  diagnostics.error("number-overflow", block.header, fmt::format("{} holds a number that is too large", block.name));
  return std::nullopt;
}

}  // namespace dynalin
