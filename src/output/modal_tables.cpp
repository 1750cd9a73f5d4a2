#include "output/modal_tables.h"

#include <fmt/ostream.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace dynalin {

namespace {

class Table {
 public:
  Table(std::ostream& out, const ModalTableFormat& format) : out_(out), format_(format) {}

  int width() const { return format_.precision == 2 ? 7 : format_.precision + 8; }
  std::string number(double x) const {
    if (std::isnan(x)) return std::string(static_cast<std::size_t>(width()), ' ');
    x += 0.0;  // no negative zero
    return format_.precision == 2 ? fmt::format("{:7.2f}", x) : fmt::format("{:{}.{}e}", x, width(), format_.precision);
  }
  // Boxes of so many columns side by side, from column 16 on.
  void rule(std::initializer_list<int> boxes) {
    std::string line(15, ' ');
    for (const int columns : boxes) {
      line += line.size() == 15 ? "+" : "";
      line += std::string(static_cast<std::size_t>(columns * width() + 1), '-') + "+";
    }
    fmt::print(out_, "{}\n", line);
  }
  void title(std::string_view text, int columns) {
    const auto box = static_cast<std::size_t>(columns * width() + 2);
    const std::size_t margin = text.size() < box ? (box - text.size()) / 2 : 0;
    fmt::print(out_, "{}{}\n\n", std::string(15 + margin, ' '), text);
  }
  std::string heading(std::initializer_list<std::string_view> names, int columns_each = 1) const {
    std::string line;
    for (const std::string_view name : names) line += fmt::format("{:^{}}", name, width() * columns_each);
    return line + " |";
  }
  void head(const std::string& text) { fmt::print(out_, "{}|{}\n", std::string(15, ' '), text); }
  std::string label(std::string text) const {
    if (text.size() > 13) text.resize(13);
    return fmt::format("  {:<13}|", text);
  }
  void row(const std::string& label_text, const ElementLabel& element, const std::string& cells) {
    const bool named = format_.names && format_.precision != 2 && !element.view_name.empty();
    fmt::print(out_, "{}{}{}{}\n", label(label_text), cells, "|", named ? " " + element.view_name : "");
  }
  std::ostream& out() { return out_; }

 private:
  std::ostream& out_;
  ModalTableFormat format_;
};

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
  Table t(out, format);
  const bool old = format.precision == 2;
  t.title(kind == ShapeTable::coordinates ? "Normalized coordinates in this mode" : "Marker mode table", 12);
  t.rule({12});
  t.head(t.heading({"X", "Y", "Z", "RX", "RY", "RZ"}, 2));
  const std::string_view magnitude = old ? "mag." : "magnitude";
  std::string second;
  for (int k = 0; k < 6; ++k) second += fmt::format("{:>{}}{:>{}}", magnitude, t.width(), "phase", t.width());
  t.head(second + " |");
  t.rule({12});
  for (const auto& row : rows) {
    std::string cells;
    for (std::size_t k = 0; k < 6; ++k) {
      if (k < row.values.size()) {
        cells += t.number(std::abs(row.values[k])) + t.number(phase_of(row.values[k], old));
      } else {
        cells += std::string(static_cast<std::size_t>(2 * t.width()), ' ');
      }
    }
    t.row(row.element->text(), *row.element, cells + " ");
  }
  t.rule({12});
  out << '\n';
}

void write_kinetic(std::ostream& out, const ModalTableFormat& format, const std::vector<ModalRow<double>>& rows) {
  Table t(out, format);
  t.title("Percentage distribution of Kinetic energy", 11);
  t.rule({10, 1});
  t.head(t.heading({"X", "Y", "Z", "RXX", "RYY", "RZZ", "RXY", "RXZ", "RYZ", "Modal"}) + t.heading({"Sum"}));
  t.rule({10, 1});
  double total = 0;
  const std::string blank(static_cast<std::size_t>(t.width()), ' ');
  for (const auto& row : rows) {
    std::string cells;
    for (std::size_t k = 0; k < 9; ++k) cells += t.number(row.values[k]);
    t.row(row.element->text(), *row.element, cells + blank + " |" + t.number(row.values[9]) + " ");
    total += row.values[9];
  }
  t.rule({10, 1});
  const std::string indent(static_cast<std::size_t>(15 + 10 * t.width() + 2), ' ');
  fmt::print(out, "{}|{} |\n{}+{}+\n\n", indent, t.number(total), indent,
             std::string(static_cast<std::size_t>(t.width() + 1), '-'));
}

void write_forces(std::ostream& out, const ModalTableFormat& format, ForceTable kind,
                  const std::vector<ModalRow<double>>& rows) {
  Table t(out, format);
  t.title(kind == ForceTable::strain ? "Percentage distribution of strain energy"
                                     : "Percentage distribution of dissipative energy",
          7);
  t.rule({7});
  t.head(t.heading({"Total", "X", "Y", "Z", "RXX", "RYY", "RZZ"}));
  t.rule({7});
  for (const auto& row : rows) {
    std::string cells;
    for (const double x : row.values) cells += t.number(x);
    std::string label = fmt::format("{}/{}", row.element->statement.substr(0, 4), row.element->id);
    if (row.marker > 0) label += fmt::format(",{}", row.marker);
    t.row(label, *row.element, cells + " ");
  }
  t.rule({7});
  out << '\n';
}

}  // namespace dynalin
