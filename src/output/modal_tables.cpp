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

enum class LabelForm : bool { whole, abbreviated };

// "PART/2", "POIN/12345678", "NFOR/3,40"; an id is never cut.
template <class T>
std::vector<std::string> labels_of(const std::vector<ModalRow<T>>& rows, LabelForm form) {
  std::vector<std::string> labels;
  for (const auto& row : rows) {
    const std::string id =
        row.part > 0 ? fmt::format("{},{}", row.element->id, row.part) : std::to_string(row.element->id);
    std::string_view name = row.element->statement;
    if (form == LabelForm::abbreviated || name.size() + 1 + id.size() > label_width) name = name.substr(0, short_name);
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
  std::string heading(std::initializer_list<std::string_view> names, int columns_each = 1) const {
    std::string line;
    for (const std::string_view name : names) line += fmt::format("{:^{}}", name, width() * columns_each);
    return line + " |";
  }
  void head(const std::string& text) { fmt::print(out_, "{}|{}\n", indent(), text); }
  void row(const std::string& label, const ElementLabel& element, const std::string& cells) {
    const bool named = format_.names && format_.precision != 2 && !element.view_name.empty();
    fmt::print(out_, "  {:<{}}|{}|{}\n", label, label_width_, cells, named ? " " + std::string(element.view_name) : "");
  }
  std::ostream& out() { return out_; }

 private:
  std::ostream& out_;
  ModalTableFormat format_;
  std::size_t label_width_ = label_width;
};

template <class Row>
bool all_zero(const std::vector<Row>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) {
    return std::all_of(row.values.begin(), row.values.end(), [](double x) { return x == 0 || std::isnan(x); });
  });
}

// Degrees; the old format knows 0 to 355 and snaps what is nearly in or out of phase.
double phase_of(const std::complex<double>& v, bool snapped) {
  double degrees = std::abs(v) == 0 ? 0.0 : std::arg(v) * 180 / std::numbers::pi;
  if (!snapped) return degrees;
  if (degrees < 0) degrees += 360;
  if (degrees < 5 || degrees >= 355) return 0;
  if (degrees >= 175 && degrees <= 185) return 180;
  return degrees;
}

}  // namespace

void write_modal_title(std::ostream& out, double time) {
  const std::string stars(79, '*');
  fmt::print(out, "\n  {0}\n  Energy/Marker Mode table computation at time {1:f}\n  {0}\n\n", stars, time);
}

void write_mode_header(std::ostream& out, std::size_t number, const ModeHeader& h) {
  const std::string rule(79, '-');
  fmt::print(out, "  {0}\n  Energy table for MODE {1}\n  {0}\n", rule, number);
  const auto line = [&](std::string_view name, double value, std::string_view unit) {
    fmt::print(out, "  {:<22s} ={:15.5E}{}{}\n", name, value + 0.0, unit.empty() ? "" : " ", unit);
  };
  line("Damping ratio", h.damping_ratio, "");
  line("Undamped natural freq.", h.frequency, "Cycles per unit time");
  line("Generalized stiffness", h.stiffness, "User mass/time^2");
  line("Generalized mass", h.mass, "User mass");
  line("Kinetic energy", h.kinetic_energy, "User mass/time^2");
  out << '\n';
}

void write_shape(std::ostream& out, const ModalTableFormat& format, ShapeTable kind,
                 const std::vector<ModalRow<std::complex<double>>>& rows) {
  const std::vector<std::string> labels = labels_of(rows, LabelForm::whole);
  Table t(out, format, labels);
  const bool old = format.precision == 2;
  t.title(kind == ShapeTable::coordinates ? "Normalized coordinates in this mode" : "Marker mode table", 12);
  t.rule({12});
  t.head(t.heading({"X", "Y", "Z", "RX", "RY", "RZ"}, 2));
  const std::string_view magnitude = old ? "mag." : "magnitude";
  std::string second;
  for (int k = 0; k < 6; ++k) second += fmt::format("{:>{}}{:>{}}", magnitude, t.width(), "phase", t.width());
  t.head(second + " |");
  t.rule({12});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto& row = rows[r];
    std::string cells;
    for (std::size_t k = 0; k < 6; ++k) {
      if (k < row.values.size()) {
        cells += t.number(std::abs(row.values[k])) + t.number(phase_of(row.values[k], old));
      } else {
        cells += std::string(static_cast<std::size_t>(2 * t.width()), ' ');
      }
    }
    t.row(labels[r], *row.element, cells + " ");
  }
  t.rule({12});
  out << '\n';
}

void write_kinetic(std::ostream& out, const ModalTableFormat& format, const std::vector<ModalRow<double>>& rows) {
  const std::vector<std::string> labels = labels_of(rows, LabelForm::whole);
  Table t(out, format, labels);
  t.title("Percentage distribution of Kinetic energy", 11);
  t.rule({10, 1});
  t.head(t.heading({"X", "Y", "Z", "RXX", "RYY", "RZZ", "RXY", "RXZ", "RYZ", "Modal"}) + t.heading({"Sum"}));
  t.rule({10, 1});
  double total = 0;
  const std::string blank(static_cast<std::size_t>(t.width()), ' ');
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto& row = rows[r];
    std::string cells;
    for (std::size_t k = 0; k < 9; ++k) cells += t.number(row.values[k]);
    t.row(labels[r], *row.element, cells + blank + " |" + t.number(row.values[9]) + " ");
    total += row.values[9];
  }
  t.rule({10, 1});
  const std::string indent = t.indent() + std::string(static_cast<std::size_t>(10 * t.width() + 2), ' ');
  fmt::print(out, "{}|{} |\n{}+{}+\n\n", indent, t.number(total), indent,
             std::string(static_cast<std::size_t>(t.width() + 1), '-'));
  if (all_zero(rows)) fmt::print(out, "  Nothing that has mass moves in this mode.\n\n");
}

void write_forces(std::ostream& out, const ModalTableFormat& format, ForceTable kind,
                  const std::vector<ModalRow<double>>& rows) {
  const std::vector<std::string> labels = labels_of(rows, LabelForm::abbreviated);
  Table t(out, format, labels);
  t.title(kind == ForceTable::strain ? "Percentage distribution of strain energy"
                                     : "Percentage distribution of dissipative energy",
          7);
  t.rule({7});
  t.head(t.heading({"Total", "X", "Y", "Z", "RXX", "RYY", "RZZ"}));
  t.rule({7});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string cells;
    for (const double x : rows[r].values) cells += t.number(x);
    t.row(labels[r], *rows[r].element, cells + " ");
  }
  t.rule({7});
  out << '\n';
  if (rows.empty() || !all_zero(rows)) return;
  fmt::print(out, "  No force element {} in this mode.\n\n",
             kind == ForceTable::strain ? "stores energy" : "dissipates power");
}

}  // namespace dynalin
