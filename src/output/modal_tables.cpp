#include "output/modal_tables.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace dynalin {

namespace {

constexpr std::size_t label_width = 13;  // unless an id needs more
constexpr std::size_t short_name = 4;    // of a statement, where its whole name has no room

// "PART/2", "POIN/12345678", "NFOR/3,40"; an id is never cut.
std::vector<std::string> labels_of(const std::vector<ModalTable::Row>& rows, bool short_names) {
  std::vector<std::string> labels;
  for (const ModalTable::Row& row : rows) {
    const std::string id =
        row.part > 0 ? fmt::format("{},{}", row.element.id, row.part) : std::to_string(row.element.id);
    std::string_view name = row.element.statement;
    if (short_names || name.size() + 1 + id.size() > label_width) name = name.substr(0, short_name);
    labels.push_back(fmt::format("{}/{}", name, id));
  }
  return labels;
}

class Table {
 public:
  Table(std::ostream& out, const ModalTableFormat& format, const std::vector<std::string>& labels)
      : out_(out), format_(format) {
    for (const std::string& label : labels) label_width_ = std::max(label_width_, label.size());
  }

  int width() const { return format_.precision == 2 ? 7 : format_.precision + 8; }
  std::string number(double x) const {
    if (std::isnan(x)) return std::string(static_cast<std::size_t>(width()), ' ');
    x += 0.0;  // no negative zero
    return format_.precision == 2 ? fmt::format("{:7.2f}", x) : fmt::format("{:{}.{}e}", x, width(), format_.precision);
  }
  std::string indent() const { return std::string(label_width_ + 2, ' '); }  // before the first box
  // Boxes of so many columns side by side behind the labels.
  void rule(std::initializer_list<int> boxes) {
    std::string line = indent();
    for (const int columns : boxes) {
      line += line.size() == label_width_ + 2 ? "+" : "";
      line += std::string(static_cast<std::size_t>(columns * width() + 1), '-') + "+";
    }
    fmt::print(out_, "{}\n", line);
  }
  void title(std::string_view text, int columns) {
    const auto box = static_cast<std::size_t>(columns * width() + 2);
    const std::size_t margin = text.size() < box ? (box - text.size()) / 2 : 0;
    fmt::print(out_, "{}{}{}\n\n", indent(), std::string(margin, ' '), text);
  }
  std::string heading(std::span<const std::string_view> names, int columns_each = 1) const {
    std::string line;
    for (const std::string_view name : names) line += fmt::format("{:^{}}", name, width() * columns_each);
    return line + " |";
  }
  void head(const std::string& text) { fmt::print(out_, "{}|{}\n", indent(), text); }
  void row(const std::string& label, const std::string& view_name, const std::string& cells) {
    const bool named = format_.names && format_.precision != 2 && !view_name.empty();
    fmt::print(out_, "  {:<{}}|{}|{}\n", label, label_width_, cells, named ? " " + view_name : "");
  }
  std::ostream& out() { return out_; }

 private:
  std::ostream& out_;
  ModalTableFormat format_;
  std::size_t label_width_ = label_width;
};

template <class Predicate>
bool all_values(const std::vector<ModalTable::Row>& rows, const Predicate& is_so) {
  return std::ranges::all_of(rows, [&](const ModalTable::Row& row) { return std::ranges::all_of(row.values, is_so); });
}
// What is said below a table without a share, if anything.
std::string_view remark_on(const ModalTableKind& kind, const std::vector<ModalTable::Row>& rows) {
  if (rows.empty()) return kind.totals ? kind.nothing : std::string_view{};
  if (all_values(rows, [](double x) { return std::isnan(x); })) return kind.no_share;
  return all_values(rows, [](double x) { return x == 0 || std::isnan(x); }) ? kind.nothing : std::string_view{};
}

// Degrees; the old format knows 0 to 355 and snaps what is nearly in or out of phase. What is zero as its magnitude is
// printed has none.
double phase_of(const std::complex<double>& v, std::string_view magnitude, bool snapped) {
  if (magnitude.find_first_of("123456789") == std::string_view::npos) return 0;
  double degrees = std::arg(v) * 180 / std::numbers::pi;
  if (!snapped) return degrees;
  if (degrees < 0) degrees += 360;
  if (degrees < 5 || degrees >= 355) return 0;
  if (degrees >= 175 && degrees <= 185) return 180;
  return degrees;
}

// Magnitudes and phases.
void write_shape(std::ostream& out, const ModalTableFormat& format, const ModalTableKind& kind,
                 const std::vector<ModalTable::Row>& rows) {
  const std::vector<std::string> labels = labels_of(rows, kind.short_names);
  Table t(out, format, labels);
  const bool old = format.precision == 2;
  const auto columns = static_cast<int>(kind.columns.size());
  t.title(kind.title, 2 * columns);
  t.rule({2 * columns});
  t.head(t.heading(kind.columns, 2));
  const std::string_view magnitude = old ? "mag." : "magnitude";
  std::string second;
  for (int k = 0; k < columns; ++k) second += fmt::format("{:>{}}{:>{}}", magnitude, t.width(), "phase", t.width());
  t.head(second + " |");
  t.rule({2 * columns});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ModalTable::Row& row = rows[r];
    std::string cells;
    for (std::size_t k = 0; k < kind.columns.size(); ++k) {
      if (k < row.values.size()) {
        const std::complex<double> v(row.values[k], row.imaginary[k]);
        const std::string size = t.number(std::abs(v));
        cells += size + t.number(phase_of(v, size, old));
      } else {
        cells += std::string(static_cast<std::size_t>(2 * t.width()), ' ');
      }
    }
    t.row(labels[r], row.full_name, cells + " ");
  }
  t.rule({2 * columns});
  out << '\n';
}

// The last column in a box of its own, with its sum below.
void write_shares(std::ostream& out, const ModalTableFormat& format, const ModalTableKind& kind,
                  const std::vector<ModalTable::Row>& rows) {
  const std::vector<std::string> labels = labels_of(rows, kind.short_names);
  Table t(out, format, labels);
  const auto columns = static_cast<int>(kind.columns.size());
  std::vector<std::string_view> names(kind.columns.begin(), kind.columns.end());
  names.insert(names.end() - 1, "Modal");
  t.title(kind.title, columns + 1);
  t.rule({columns, 1});
  t.head(t.heading(std::span(names).first(names.size() - 1)) + t.heading(std::span(names).last(1)));
  t.rule({columns, 1});
  double total = 0;
  const std::string blank(static_cast<std::size_t>(t.width()), ' ');
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string cells;
    for (std::size_t k = 0; k + 1 < kind.columns.size(); ++k) cells += t.number(rows[r].values[k]);
    const double sum = rows[r].values.back();
    const bool split = rows[r].values.size() > kind.columns.size();  // of flexible bodies and their models
    const std::string modal = split ? t.number(rows[r].values[kind.columns.size() - 1]) : blank;
    t.row(labels[r], rows[r].full_name, cells + modal + " |" + t.number(sum) + " ");
    total += sum;
  }
  t.rule({columns, 1});
  const std::string indent = t.indent() + std::string(static_cast<std::size_t>(columns * t.width() + 2), ' ');
  fmt::print(out, "{}|{} |\n{}+{}+\n\n", indent, t.number(total), indent,
             std::string(static_cast<std::size_t>(t.width() + 1), '-'));
}

void write_numbers(std::ostream& out, const ModalTableFormat& format, const ModalTableKind& kind,
                   const std::vector<ModalTable::Row>& rows) {
  const std::vector<std::string> labels = labels_of(rows, kind.short_names);
  Table t(out, format, labels);
  const auto columns = static_cast<int>(kind.columns.size());
  t.title(kind.title, columns);
  t.rule({columns});
  t.head(t.heading(kind.columns));
  t.rule({columns});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string cells;
    for (const double x : rows[r].values) cells += t.number(x);
    t.row(labels[r], rows[r].full_name, cells + " ");
  }
  t.rule({columns});
  out << '\n';
}

void write_summary(std::ostream& out, const ModalTable& table) {
  const std::string rule(79, '-');
  fmt::print(out, "  {0}\n  Energy table for MODE {1}\n  {0}\n", rule, table.mode);
  static constexpr std::array<std::string_view, 5> units = {"", " Cycles per unit time", " User mass/time^2",
                                                            " User mass", " User mass/time^2"};
  for (std::size_t k = 0; k < units.size(); ++k)
    fmt::print(out, "  {:<22s} ={:15.5E}{}\n", table.columns[k], table.rows.front().values[k] + 0.0, units[k]);
  out << '\n';
}

}  // namespace

void write_modal_title(std::ostream& out, double time) {
  const std::string stars(79, '*');
  fmt::print(out, "\n  {0}\n  Energy/Marker Mode table computation at time {1:f}\n  {0}\n\n", stars, time);
}

void write_modal_table(std::ostream& out, const ModalTableFormat& format, const ModalTable& table) {
  if (table.name == "MODE") return write_summary(out, table);
  const ModalTableKind* kind = find_modal_table(table.name);
  if (!kind || !kind->rows) return;  // of all modes: write_sums
  const bool complex =
      std::any_of(table.rows.begin(), table.rows.end(), [](const auto& r) { return !r.imaginary.empty(); });
  (complex ? write_shape : kind->totals ? write_shares : write_numbers)(out, format, *kind, table.rows);
  if (const std::string_view remark = remark_on(*kind, table.rows); !remark.empty())
    fmt::print(out, "  {}\n\n", remark);
}

// Numbers always carry their exponent: what is small here is not nothing.
void write_sums(std::ostream& out, const ModalTableFormat& format, const SumsOverModes& sums) {
  const int digits = std::max(format.precision, 5), width = digits + 10;
  const std::string rule(79, '-');
  fmt::print(out, "  {0}\n  {1}\n  {0}\n", rule, sums.title);
  fmt::print(out, "  {:<8}", "Mode");
  for (const std::string& name : sums.columns) fmt::print(out, "{:>{}}", name, width);
  fmt::print(out, "\n");
  for (const SumsOverModes::Line& line : sums.lines) {
    fmt::print(out, "  {:<8}", line.label);
    for (const double v : line.values) fmt::print(out, "{:{}.{}E}", v + 0.0, width, digits);
    fmt::print(out, "\n");
  }
  if (!sums.below.empty()) fmt::print(out, "  {}\n", sums.below);
  fmt::print(out, "\n");
  for (const std::string& note : sums.notes) fmt::print(out, "  {}\n\n", note);
}

}  // namespace dynalin
