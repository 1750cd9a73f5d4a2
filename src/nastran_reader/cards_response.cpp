// EIGC; FREQ, FREQ1, FREQ2; RLOAD1, DLOAD, FORCE, MOMENT, DAREA, DPHASE, DELAY, TABLED1; TIC.
#include <fmt/format.h>

#include <cmath>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

// More than any table of results wants.
constexpr int most_frequencies = 1'000'000;

void eigc(CardFields& c, Deck& deck) {
  ComplexMethod m;
  m.id = c.id(0, 2, "the number of the set");
  m.method = c.word(0, 3, "the method");
  static constexpr std::string_view methods[] = {"HESS", "CLAN", "INV", "IRAM", "DET"};
  bool known = m.method.empty();
  for (const auto name : methods) known = known || m.method == name;
  if (!known) c.wrong("eigc-rules", c.field(0, 3).at, fmt::format("{} is none of HESS, CLAN, INV and IRAM", m.method));
  const std::string norm = c.field(0, 4).text;
  if (!norm.empty() && norm != "MAX" && norm != "POINT")
    c.wrong("eigc-rules", c.field(0, 4).at, fmt::format("{} is neither MAX nor POINT", norm));
  if (norm == "POINT" && c.blank(0, 5)) c.wrong("eigc-rules", c.field(0, 4).at, "POINT needs the grid in field 5");
  if (!c.blank(0, 8)) m.wanted = c.integer(c.field(0, 8), "ND0");
  if (c.card().rows() > 1) {
    if (m.method == "HESS") {
      c.wrong("eigc-rules", c.field(0, 3).at, "HESS has no continuation", "the number of modes stands in field 8");
    } else if (m.wanted && !c.blank(1, 8)) {
      c.wrong("eigc-rules", c.field(0, 8).at, "the number of modes stands in field 8 and again on the continuation",
              "keep the one on the continuation");
    }
  }
  if (c.good()) deck.methods.push_back(std::move(m));
}

void freq(CardFields& c, Deck& deck) {
  Frequencies f;
  f.set = c.id(0, 2, "the number of the set");
  for (std::size_t i = 1; i < c.count(); ++i) {
    if (!c.at(i).blank()) f.values.push_back(c.real(c.at(i), "a frequency"));
  }
  if (f.values.empty() && c.good()) c.wrong("field-missing", c.card().end, "no frequency is given");
  if (c.good()) deck.frequencies.push_back(std::move(f));
}

int steps(CardFields& c, std::string_view what) {
  const int n = c.integer(c.field(0, 5), what, 1);
  if (n >= 1 && n <= most_frequencies) return n;
  c.wrong("load-rules", c.field(0, 5).at, fmt::format("{} is {} and should be 1 to {}", what, n, most_frequencies));
  return 1;
}

void freq1(CardFields& c, Deck& deck) {
  Frequencies f;
  f.set = c.id(0, 2, "the number of the set");
  const double first = c.required_real(0, 3, "F1"), step = c.required_real(0, 4, "DF");
  const int n = steps(c, "NDF");
  if (c.good() && step <= 0) c.wrong("load-rules", c.field(0, 4).at, "DF should be positive");
  for (int k = 0; c.good() && k <= n; ++k) f.values.push_back(first + k * step);
  if (c.good()) deck.frequencies.push_back(std::move(f));
}

void freq2(CardFields& c, Deck& deck) {
  Frequencies f;
  f.set = c.id(0, 2, "the number of the set");
  const double first = c.required_real(0, 3, "F1"), last = c.required_real(0, 4, "F2");
  const int n = steps(c, "NF");
  if (c.good() && first <= 0) c.wrong("load-rules", c.field(0, 3).at, "F1 should be positive, for steps are ratios");
  if (c.good() && last <= first) c.wrong("load-rules", c.field(0, 4).at, "F2 should be larger than F1");
  for (int k = 0; c.good() && k <= n; ++k) f.values.push_back(first * std::pow(last / first, double(k) / n));
  if (c.good()) deck.frequencies.push_back(std::move(f));
}

void rload1(CardFields& c, Deck& deck) {
  DynamicLoad l;
  l.at = c.card().at;
  l.id = c.id(0, 2, "the number of the load");
  l.excitation = c.id(0, 3, "the excitation");
  l.delay = c.number_or_card(0, 4, "the delay");
  l.phase = c.number_or_card(0, 5, "the phase");
  l.real_part = c.number_or_card(0, 6, "TC");
  l.imaginary_part = c.number_or_card(0, 7, "TD");
  if (c.blank(0, 6) && c.blank(0, 7) && c.good()) c.wrong("load-rules", c.card().at, "neither TC nor TD is given");
  const Field& type = c.field(0, 8);
  const bool force = type.blank() || type.is_word("LOAD") || type.is_word("L") || type.is_word("LOA") ||
                     type.is_word("LO") || (type.form == Field::Form::integer && type.integer == 0);
  if (!force) c.diagnostics().error("unassembled-card", type.at, "RLOAD1: only forces are solved here, TYPE 0 or LOAD");
  if (c.good()) deck.dynamic_loads.push_back(std::move(l));
}

void dload(CardFields& c, Deck& deck) {
  LoadSum s;
  s.id = c.id(0, 2, "the number of the load");
  s.factor = c.required_real(0, 3, "S");
  for (std::size_t i = 2; i + 1 < c.count(); i += 2) {
    if (c.at(i).blank() && c.at(i + 1).blank()) continue;
    const double factor = c.real(c.at(i), "a factor", 1);
    s.parts.emplace_back(factor, c.reference(c.at(i + 1), "the number of a load", 1));
    if (c.at(i + 1).blank()) c.wrong("field-missing", c.at(i).at, "no load follows the factor");
  }
  if (s.parts.empty() && c.good()) c.wrong("field-missing", c.card().end, "no load is named");
  if (c.good()) deck.load_sums.push_back(std::move(s));
}

void force(CardFields& c, Deck& deck) {
  PointLoad l;
  l.moment = c.name() == "MOMENT";
  l.set = c.id(0, 2, "the number of the set");
  l.grid = c.id(0, 3, "the grid");
  l.system = c.reference(0, 4, "CID");
  const double size = c.required_real(0, 5, "the size");
  l.vector = size * c.vector(0, 6, "N");
  if (c.good()) deck.point_loads.push_back(std::move(l));
}

// One or two freedoms with a value each.
void values(CardFields& c, std::vector<FreedomValue>& into, std::string_view what) {
  const Reference set = c.id(0, 2, "the number of the set");
  for (const std::size_t first : {std::size_t{3}, std::size_t{6}}) {
    if (first == 6 && c.blank(0, 6)) {
      c.refuse_beside_blank(0, 6, 2, "a point");
      break;
    }
    FreedomValue v;
    v.set = set;
    v.freedom = c.freedom(c.field(0, first), c.field(0, first + 1));
    if (c.blank(0, first)) c.wrong("field-missing", c.card().at, "the point is missing");
    v.value = c.required_real(0, first + 2, what);
    if (c.good()) into.push_back(std::move(v));
  }
}

void darea(CardFields& c, Deck& deck) { values(c, deck.areas, "the size"); }
void dphase(CardFields& c, Deck& deck) { values(c, deck.phases, "the phase"); }
void delay(CardFields& c, Deck& deck) { values(c, deck.delays, "the delay"); }

void tic(CardFields& c, Deck& deck) {
  FreedomValue v;
  v.set = c.id(0, 2, "the number of the set");
  v.freedom = c.freedom(c.field(0, 3), c.field(0, 4));
  if (c.blank(0, 3)) c.wrong("field-missing", c.card().at, "the point is missing");
  v.value = c.real(0, 5, "U0");
  c.real(0, 6, "V0");
  if (c.good()) deck.initial.push_back(std::move(v));
}

bool axis(CardFields& c, std::size_t number) {
  const Field& f = c.field(0, number);
  if (f.blank() || f.is_word("LINEAR")) return false;
  if (!f.is_word("LOG")) c.wrong("load-rules", f.at, fmt::format("{} is neither LINEAR nor LOG", f.text));
  return true;
}

void tabled1(CardFields& c, Deck& deck) {
  Table t;
  t.id = c.id(0, 2, "the number of the table");
  t.x_log = axis(c, 3), t.y_log = axis(c, 4);
  bool ended = false;
  for (std::size_t i = 8; i + 1 < c.count() && c.good(); i += 2) {
    const Field &x = c.at(i), &y = c.at(i + 1);
    if (x.is_word("ENDT") || y.is_word("ENDT")) {
      ended = true;
      for (std::size_t k = x.is_word("ENDT") ? i + 1 : i + 2; k < c.count(); ++k) {
        if (c.at(k).blank()) continue;
        c.wrong("load-rules", c.at(k).at, fmt::format("{} stands behind ENDT", c.at(k).text));
        break;
      }
      break;
    }
    if (x.is_word("SKIP") || y.is_word("SKIP") || (x.blank() && y.blank())) continue;
    if (x.blank() || y.blank()) {
      c.wrong("field-missing", (x.blank() ? y : x).at, "x and y stand in pairs");
      break;
    }
    const double vx = c.real(x, "x"), vy = c.real(y, "y");
    if (c.good() && !t.points.empty() && vx < t.points.back().first) c.wrong("load-rules", x.at, "x decreases");
    if (c.good() && ((t.x_log && vx <= 0) || (t.y_log && vy <= 0)))
      c.wrong("load-rules", x.at, "a value on a LOG axis is not positive");
    t.points.emplace_back(vx, vy);
  }
  if (!c.good()) return;
  if (!ended) {
    c.wrong("load-rules", c.card().end, "no ENDT ends the table");
  } else if (t.points.size() < 2) {
    c.wrong("load-rules", c.card().at, fmt::format("the table has {} points and needs two", t.points.size()));
  }
  if (c.good()) deck.tables.push_back(std::move(t));
}

constexpr CardKind response_card_kinds[] = {
    {"EIGC", eigc, "xxxxxxx-|xxxxxxx-+"},
    {"FREQ", freq, list_in_rows},
    {"FREQ1", freq1, "xxxx----"},
    {"FREQ2", freq2, "xxxx----"},
    {"RLOAD1", rload1, "xxxxxxx-"},
    {"DLOAD", dload, list_in_rows},
    {"FORCE", force, "xxxxxxx-"},
    {"MOMENT", force, "xxxxxxx-"},
    {"DAREA", darea, "xxxxxxx-"},
    {"DPHASE", dphase, "xxxxxxx-"},
    {"DELAY", delay, "xxxxxxx-"},
    {"TABLED1", tabled1, "xxxx----|xxxxxxxx+"},
    {"TIC", tic, "xxxxx---"},
};

}  // namespace

std::span<const CardKind> response_cards() { return response_card_kinds; }

double Table::at(double x) const {
  std::size_t k = 1;
  while (k + 1 < points.size() && x > points[k].first) ++k;
  // A jump: two points at one x. The mean holds on it.
  auto [x0, y0] = points[k - 1];
  auto [x1, y1] = points[k];
  if (x0 == x1) return (y0 + y1) / 2;
  if (x_log) x0 = std::log(x0), x1 = std::log(x1), x = std::log(x);
  if (y_log) y0 = std::log(y0), y1 = std::log(y1);
  const double y = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
  return y_log ? std::exp(y) : y;
}

}  // namespace dynalin::nastran_reader
