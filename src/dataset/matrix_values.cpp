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

struct Number {
  double value = 0;
  bool has_exponent = false;
};

std::optional<Number> parse_number(std::string_view text, ShortExponent short_exponent) {
  const bool negative = !text.empty() && text[0] == '-';
  if (negative || (!text.empty() && text[0] == '+')) text.remove_prefix(1);
  const NumberExtent extent = number_extent(text, ExponentLetter::e_or_d);
  if (extent.length == 0) return std::nullopt;
  Number number{0, extent.has_exponent};
  if (extent.length == text.size()) {
    number.value = number_value(text);
  } else {
    const bool sign = text[extent.length] == '+' || text[extent.length] == '-';
    if (short_exponent == ShortExponent::no || !sign || extent.has_exponent) return std::nullopt;
    std::string with_letter(text);
    with_letter.insert(extent.length, 1, 'E');
    if (number_extent(with_letter, ExponentLetter::e).length != with_letter.size()) {
      return std::nullopt;
    }
    number = {number_value(with_letter), true};
  }
  if (negative) number.value = -number.value;
  return number;
}

struct FreeValues {
  std::vector<double> values;
  // The first of each; without source if there is none.
  Span bad, surplus, without_point, without_exponent;
};

Span span_in(const SourceText& file, std::string_view part) {
  return {&file, static_cast<std::uint32_t>(part.data() - file.text().data()), static_cast<std::uint32_t>(part.size())};
}

// Numbers with blanks or commas between them, on any number of lines.
FreeValues read_free(const MatrixBlock& block, ShortExponent short_exponent) {
  FreeValues result;
  for (std::size_t line_number = block.first_line; line_number < block.end_line; ++line_number) {
    const std::string_view line = block.file.line(line_number);
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
      const std::optional<Number> number = parse_number(word, short_exponent);
      if (!number) {
        result.bad = span_in(block.file, word);
        return result;
      }
      const bool point = word.find('.') != std::string_view::npos;
      const bool counts = number->value != 0;
      if (counts && !point && !result.without_point.source) result.without_point = span_in(block.file, word);
      if (counts && !number->has_exponent && !result.without_exponent.source) {
        result.without_exponent = span_in(block.file, word);
      }
      if (result.values.size() == block.value_count && !result.surplus.source) {
        result.surplus = span_in(block.file, word);
      }
      result.values.push_back(number->value);
    }
  }
  return result;
}

struct ColumnValues {
  std::vector<double> values;
  // The first of each; without source if there is none.
  Span implied;   // but 0, whose point the format implies
  Span scaled;    // but 0, that a scale factor counts for
  Span doubted;   // the same where FORTRAN would have written an exponent: E, D and G
  Span short_of;  // one that a scale factor counts for and that ends before its column does
  Span empty;     // column without a number
};

void note_first(Span& first, const MatrixBlock& block, std::string_view text) {
  if (!first.source) first = span_in(block.file, text);
}

// The number of one column, read as FORTRAN does: without a point it has it where the format says, 150 is 1.50 in F4.2;
// without an exponent it is divided by the scale factor, 150. is 1.50 behind 2P; an empty one is 0.
bool read_column(const MatrixBlock& block, const FortranItem& field, int power, std::string_view rest,
                 ColumnValues& result) {
  const std::string_view column = rest.substr(0, field.width);
  // One that ends before its column does was written free of them.
  const bool full = rest.size() >= field.width;
  std::string_view text = column;
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (text.empty()) {
    if (!full) return false;
    note_first(result.empty, block, column);
    result.values.push_back(0);
    return true;
  }
  const std::optional<Number> number = parse_number(text, ShortExponent::yes);
  if (!number) return false;
  double value = number->value;
  if (field.kind == FortranItem::Kind::number && value != 0) {
    if (field.decimals > 0 && full && text.find('.') == std::string_view::npos) {
      value /= std::pow(10.0, static_cast<double>(field.decimals));
      note_first(result.implied, block, text);
    }
    if (power != 0 && !number->has_exponent) {
      value = power > 0 ? value / std::pow(10.0, power) : value * std::pow(10.0, -power);
      note_first(result.scaled, block, text);
      if (!field.fixed) note_first(result.doubted, block, text);
      if (!full) note_first(result.short_of, block, text);
    }
  }
  result.values.push_back(value);
  return true;
}

// Numbers in the columns that the format says; nothing if the text does not fit it exactly.
std::optional<ColumnValues> read_columns(const MatrixBlock& block, const FortranFormat& format) {
  ColumnValues result;
  std::size_t line_number = block.first_line;
  std::size_t column = 0, item = 0;
  int power = 0;
  const auto blank = [](std::string_view text) { return std::all_of(text.begin(), text.end(), is_blank); };
  while (result.values.size() < block.value_count) {
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
    if (field.kind == FortranItem::Kind::scale) power = field.power;
    const bool fits =
        field.is_number() ? read_column(block, field, power, rest, result) : blank(rest.substr(0, field.width));
    if (!fits) return std::nullopt;
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

template <class Condition>
bool all_numbers(const FortranFormat& format, const Condition& condition) {
  return std::ranges::all_of(format.items, [&](const FortranItem& i) { return !i.is_number() || condition(i); });
}

// Whether FORTRAN reads numbers without exponents otherwise than they are written.
bool has_scale(const FortranFormat& format) {
  return std::ranges::any_of(format.items, [](const FortranItem& i) { return i.power != 0; });
}

// Numbers that stand free of the columns: as they are written. In a format that mixes kinds of numbers it is not known
// which this one is.
void warn_about_numbers_as_written(const MatrixBlock& block, const FreeValues& found, const FortranFormat& format,
                                   Diagnostics& diagnostics) {
  const auto implies = [](const FortranItem& i) { return i.decimals > 0; };
  const bool implied = found.without_point.source && all_numbers(format, implies) &&
                       found.without_point.text().find_first_of("eEdD") == std::string_view::npos;
  if (implied)
    diagnostics.warning(
        "matrix-implied-point", found.without_point,
        fmt::format("{} is read as it stands, where FORTRAN would imply a decimal point", found.without_point.text()),
        "write the point");
  const auto fixed = [](const FortranItem& i) { return i.fixed; };
  if (found.without_exponent.source && has_scale(format) && all_numbers(format, fixed))
    diagnostics.warning("matrix-scale-factor", found.without_exponent,
                        fmt::format("{} stands free of its column and is read as it is, without the scale factor of {}",
                                    found.without_exponent.text(), block.format),
                        "fill the columns with blanks, or take the scale factor out of the format");
}

std::vector<double> values_in_columns(const MatrixBlock& block, ColumnValues found, Diagnostics& diagnostics) {
  if (found.implied.source)
    diagnostics.warning(
        "matrix-implied-point", found.implied,
        fmt::format("{} is read with the decimal point that {} implies", found.implied.text(), block.format),
        "write the point");
  if (found.doubted.source)
    diagnostics.warning("matrix-scale-factor", found.doubted,
                        fmt::format("{} has no exponent and is divided by the scale factor of {}, as FORTRAN reads it",
                                    found.doubted.text(), block.format),
                        "write the exponent, E+00");
  if (found.empty.source)
    diagnostics.warning("matrix-empty-column", found.empty,
                        fmt::format("a column of {} is empty and read as 0, as FORTRAN reads it", block.name),
                        "write the zero");
  return std::move(found.values);
}

}  // namespace

std::optional<std::vector<double>> read_matrix_values(const MatrixBlock& block, Diagnostics& diagnostics) {
  FreeValues free = read_free(block, ShortExponent::no);
  const std::optional<FortranFormat> format = parse_fortran_format(block.format);
  std::optional<std::vector<double>> values;
  const auto complete = [&] { return !free.bad.source && free.values.size() == block.value_count; };
  const bool reads_free = complete();
  // Numbers with points and exponents are the same either way, those with points alone where nothing is scaled.
  const bool either_way =
      reads_free && !free.without_point.source && !(format && free.without_exponent.source && has_scale(*format));
  if (format && !either_way) {
    auto columns = read_columns(block, *format);
    const bool fills_columns =
        columns && (columns->implied.source || columns->scaled.source) && !columns->short_of.source;
    if (columns && (!reads_free || fills_columns)) values = values_in_columns(block, std::move(*columns), diagnostics);
  }
  // Exponents without a letter only where nothing else fits: 10-20 may be two numbers.
  if (!values && !reads_free && free.bad.source) {
    FreeValues with_short = read_free(block, ShortExponent::yes);
    std::swap(free, with_short);
    if (!complete()) std::swap(free, with_short);
  }
  if (!values && complete()) {
    if (format) warn_about_numbers_as_written(block, free, *format, diagnostics);
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
