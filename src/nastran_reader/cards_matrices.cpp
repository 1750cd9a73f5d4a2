// DMIG: headers and columns, and PARAM.
#include <fmt/format.h>

#include <algorithm>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

// A deck has few matrices and many columns, which mostly follow each other.
DirectMatrix& matrix_named(Deck& deck, const std::string& name, const Span& at) {
  auto& all = deck.matrices;
  if (!all.empty() && all.back().name == name) return all.back();
  const auto found = std::find_if(all.begin(), all.end(), [&](const DirectMatrix& m) { return m.name == name; });
  if (found != all.end()) return *found;
  all.push_back({name, at, false, 0, 0, {}, {}});
  return all.back();
}

void header(CardFields& c, DirectMatrix& m) {
  if (m.has_header) {
    c.wrong("dmig-header", c.card().at, fmt::format("the header of {} stands twice", m.name));
    return;
  }
  m.has_header = true;
  m.at = c.field(0, 2).at;
  m.form = c.integer(c.field(0, 4), "IFO");
  m.type = c.integer(c.field(0, 5), "TIN");
  if (!c.good()) return;
  if (m.form != 1 && m.form != 2 && m.form != 6 && m.form != 9)
    c.wrong("dmig-header", c.field(0, 4).at, fmt::format("IFO is {} and should be 1, 2, 6 or 9", m.form));
  if (m.type < 1 || m.type > 4)
    c.wrong("dmig-header", c.field(0, 5).at, fmt::format("TIN is {} and should be 1 to 4", m.type));
  const int out = c.integer(c.field(0, 6), "TOUT");
  if (out < 0 || out > 4) c.wrong("dmig-header", c.field(0, 6).at, fmt::format("TOUT is {} and should be 0 to 4", out));
  if (c.integer(c.field(0, 7), "POLAR") > 0 && m.type <= 2 && m.type > 0)
    c.wrong("dmig-header", c.field(0, 7).at, "POLAR is for complex matrices");
  if (!c.blank(0, 8)) c.wrong("field-form", c.field(0, 8).at, "field 8 of a header is blank");
  if (c.card().rows() > 1) c.wrong("field-form", c.card().end, "a header has no continuation");
  if (m.form == 9 && c.blank(0, 9)) c.wrong("dmig-header", c.card().end, "NCOL is missing, which IFO 9 needs");
}

void column(CardFields& c, DirectMatrix& m) {
  if (m.terms.empty() && !m.has_header) m.at = c.field(0, 2).at;
  const Freedom at = c.freedom(c.field(0, 3), c.field(0, 4));
  if (c.blank(0, 3)) c.wrong("field-missing", c.card().at, "the point of the column is missing");
  const auto term = [&](std::size_t row, std::size_t first) {
    if (c.blank(row, first)) {
      for (std::size_t k = 1; k <= 3; ++k) {
        if (!c.blank(row, first + k)) {
          c.wrong("field-missing", c.field(row, first + k).at, "a term has no point");
          return;
        }
      }
      return;
    }
    DirectMatrix::Term t;
    t.column = at;
    t.row = c.freedom(c.field(row, first), c.field(row, first + 1));
    t.value = c.real(row, first + 2, "the term");
    t.at = c.field(row, first + 2).at;
    if (c.blank(row, first + 2)) t.at = c.field(row, first).at;
    const Field& written = c.field(row, first + 2);
    if (written.form == Field::Form::real && !written.double_precision && !m.without_d) m.without_d = written.at;
    const Field& imaginary = c.field(row, first + 3);
    if (!imaginary.blank()) {
      // Whether it may be there, TIN decides, which may come later: kept by a term of its own kind.
      if (m.has_header && m.type <= 2) {
        c.wrong("dmig-term", imaginary.at, fmt::format("{} is real, and this term has an imaginary part", m.name));
      } else if (c.real(imaginary, "the imaginary part") != 0) {
        c.diagnostics().error("unassembled-card", imaginary.at, "DMIG: complex matrices are not solved here");
      }
    }
    m.terms.push_back(std::move(t));
  };
  for (std::size_t row = 0; row < c.card().rows(); ++row) {
    if (row > 0) term(row, 2);
    term(row, 6);
    if (row == 0 && !c.blank(0, 5)) c.wrong("field-form", c.field(0, 5).at, "field 5 of a column is blank");
  }
}

void dmig(CardFields& c, Deck& deck) {
  const std::string name = c.word(0, 2, "the name of the matrix");
  if (name.empty()) return;
  DirectMatrix& m = matrix_named(deck, name, c.field(0, 2).at);
  const Field& third = c.field(0, 3);
  if (third.form == Field::Form::integer && third.integer == 0) {
    header(c, m);
  } else {
    column(c, m);
  }
}

void param(CardFields& c, Deck& deck) {
  const std::string name = c.word(0, 2, "the name of the parameter");
  if (name.empty()) return;
  const Field& value = c.field(0, 3);
  if (value.form == Field::Form::wrong)
    c.diagnostics().warning("field-form", value.at,
                            fmt::format("PARAM: {} of {} is {}", value.text, name, value.reason));
  deck.parameters[name] = {value.text, value.at};
}

constexpr CardKind matrix_card_kinds[] = {{"DMIG", dmig, list_in_rows}, {"PARAM", param, "xxx-----"}};

}  // namespace

std::span<const CardKind> matrix_cards() { return matrix_card_kinds; }

}  // namespace dynalin::nastran_reader
