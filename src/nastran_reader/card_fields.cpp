#include "nastran_reader/card_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace dynalin::nastran_reader {

namespace {

constexpr int largest_id = 99'999'999;
// What THRU may open up: no deck has more points.
constexpr int longest_range = 1'000'000;

bool numeric(const Field& f) { return f.form == Field::Form::integer || f.form == Field::Form::real; }

}  // namespace

void CardFields::wrong(std::string_view code, const Span& at, std::string message, std::string hint) {
  good_ = false;
  told_.push_back(at.offset);
  diagnostics_.error(code, at, fmt::format("{}: {}", name(), message), std::move(hint));
}

void CardFields::mistaken(const Field& f, std::string_view what, std::string_view wanted) {
  if (f.form == Field::Form::wrong) {
    std::string hint;
    if (f.text.find(' ') != std::string::npos || f.at.length >= 8)
      hint = "a number that runs over the border of its columns looks like this";
    wrong("field-form", f.at, fmt::format("{} is {}: {}", what, f.text, f.reason), hint);
    return;
  }
  const std::string_view is = f.form == Field::Form::integer ? "an integer"
                              : f.form == Field::Form::real  ? "a real"
                                                             : "a word";
  std::string hint;
  if (f.form == Field::Form::integer && wanted == "a real") hint = fmt::format("write {}.", f.text);
  wrong("field-form", f.at, fmt::format("{} is {}, {}, and should be {}", what, f.text, is, wanted), hint);
}

void CardFields::refuse_beside_blank(std::size_t row, std::size_t number, std::size_t count, std::string_view what) {
  if (!blank(row, number)) return;
  for (std::size_t k = 1; k <= count; ++k) {
    const Field& f = field(row, number + k);
    if (f.blank()) continue;
    wrong("field-missing", f.at, fmt::format("{} stands without {}", f.text, what));
    return;
  }
}

void CardFields::refuse_unread(std::string_view shape) {
  const bool repeats = shape.back() == '+';
  if (repeats) shape.remove_suffix(1);
  const std::size_t rows = (shape.size() + 1) / 9;
  for (std::size_t i = 0; i < count(); ++i) {
    const Field& f = at(i);
    if (f.blank() || std::find(told_.begin(), told_.end(), f.at.offset) != told_.end()) continue;
    if (f.form == Field::Form::wrong) {
      mistaken(f, "a field that is not used", "blank");
      continue;
    }
    const std::size_t row = i / 8, of_shape = repeats ? std::min(row, rows - 1) : row;
    if (of_shape < rows && shape[of_shape * 9 + i % 8] == 'x') continue;
    const std::string place = row == 0 ? std::string() : fmt::format(" of row {}", row + 1);
    wrong("field-form", f.at, fmt::format("field {}{} is {}, and the card has none there", i % 8 + 2, place, f.text));
    i = row * 8 + 7;  // one of a row is enough
  }
}

Reference CardFields::id(std::size_t row, std::size_t number, std::string_view what) {
  const Field& f = field(row, number);
  if (f.blank()) {
    wrong("field-missing", f.at.source ? f.at : card_.at, fmt::format("{} is missing", what));
    return {0, f.at};
  }
  return reference(f, what, 1);
}

Reference CardFields::reference(std::size_t row, std::size_t number, std::string_view what, int least) {
  return reference(field(row, number), what, least);
}

Reference CardFields::reference(const Field& f, std::string_view what, int least) {
  if (f.blank()) return {0, f.at};
  if (f.form != Field::Form::integer) {
    mistaken(f, what, "an integer");
  } else if (f.integer < least || f.integer > largest_id) {
    wrong("field-range", f.at, fmt::format("{} is {} and should be {} to {}", what, f.integer, least, largest_id));
  } else {
    return {f.integer, f.at};
  }
  return {0, f.at};
}

double CardFields::real(const Field& f, std::string_view what, double otherwise) {
  if (f.blank()) return otherwise;
  if (f.form == Field::Form::real) return f.real;
  mistaken(f, what, "a real");
  return otherwise;
}

double CardFields::real(std::size_t row, std::size_t number, std::string_view what, double otherwise) {
  return real(field(row, number), what, otherwise);
}

double CardFields::required_real(std::size_t row, std::size_t number, std::string_view what) {
  const Field& f = field(row, number);
  if (f.blank()) wrong("field-missing", f.at.source ? f.at : card_.at, fmt::format("{} is missing", what));
  return real(f, what);
}

int CardFields::integer(const Field& f, std::string_view what, int otherwise) {
  if (f.blank()) return otherwise;
  if (f.form == Field::Form::integer) return f.integer;
  mistaken(f, what, "an integer");
  return otherwise;
}

Eigen::Vector3d CardFields::vector(std::size_t row, std::size_t number, std::string_view what) {
  Eigen::Vector3d v;
  for (std::size_t k = 0; k < 3; ++k) {
    // Three in a row, going on in the next one behind field 9.
    const std::size_t index = row * 8 + number - 2 + k;
    v[static_cast<Eigen::Index>(k)] = real(field(index / 8, index % 8 + 2), fmt::format("{} {}", what, k + 1));
  }
  return v;
}

Components CardFields::components(const Field& f, std::string_view what) {
  if (f.blank()) return 0;
  if (f.form != Field::Form::integer) {
    mistaken(f, what, "digits of components");
    return 0;
  }
  if (f.integer == 0) return 0;
  Components out = 0;
  for (const char c : f.text) {
    const unsigned bit = c >= '1' && c <= '6' ? 1u << (c - '1') : 0;
    if (bit == 0 || (out & bit)) {
      wrong("field-range", f.at, fmt::format("{} is {} and should be different digits from 1 to 6", what, f.text));
      return 0;
    }
    out |= bit;
  }
  return out;
}

Freedom CardFields::freedom(const Field& point, const Field& component) {
  Freedom out;
  out.point = reference(point, "the point", 1);
  out.component_at = component.at;
  if (component.blank()) return out;
  if (component.form != Field::Form::integer) {
    mistaken(component, "the component", "an integer");
  } else if (component.integer < 0 || component.integer > 6) {
    wrong("field-range", component.at, fmt::format("the component is {} and should be 0 to 6", component.integer));
  } else {
    out.component = component.integer;
  }
  return out;
}

std::string CardFields::word(std::size_t row, std::size_t number, std::string_view what) {
  const Field& f = field(row, number);
  if (f.form == Field::Form::word && f.text.size() <= 8) return f.text;
  if (f.blank()) {
    wrong("field-missing", card_.at, fmt::format("{} is missing", what));
  } else if (f.form == Field::Form::word) {
    wrong("field-overflow", f.at, fmt::format("{} has {} characters, and a name up to 8", f.text, f.text.size()));
  } else {
    mistaken(f, what, "a name");
  }
  return {};
}

NumberOrCard CardFields::number_or_card(std::size_t row, std::size_t number, std::string_view what) {
  const Field& f = field(row, number);
  NumberOrCard out;
  out.card.at = f.at;
  if (f.blank()) return out;
  if (f.form == Field::Form::real) {
    out.value = f.real;
  } else if (f.form == Field::Form::integer) {
    out.card = reference(f, what, 0);
  } else {
    mistaken(f, what, "a real or the number of a card");
  }
  return out;
}

std::vector<Reference> CardFields::list(std::size_t index, std::string_view what) {
  std::vector<Reference> out;
  for (std::size_t i = index; i < count(); ++i) {
    const Field& f = at(i);
    if (f.blank()) continue;
    if (f.is_word("THRU")) {
      const Field& last = i + 1 < count() ? at(i + 1) : f;
      const Reference end = reference(last, what, 1);
      int step = 1;
      std::size_t used = 1;
      if (i + 3 < count() && at(i + 2).is_word("BY")) step = integer(at(i + 3), "the step"), used = 3;
      if (out.empty() || end.id <= out.back().id || step < 1 || end.id - out.back().id > longest_range) {
        wrong("field-range", f.at, "THRU stands between a number and a larger one", "1 THRU 9");
        return out;
      }
      for (int k = out.back().id + step; k <= end.id; k += step) out.push_back({k, last.at});
      i += used;
      continue;
    }
    const Reference r = reference(f, what, 1);
    if (r.id > 0) out.push_back(r);
    if (!numeric(f)) return out;  // one mistake is enough of a list
  }
  return out;
}

}  // namespace dynalin::nastran_reader
