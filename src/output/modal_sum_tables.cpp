#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <string>

#include "output/modal_tables.h"

namespace dynalin {

namespace {

// Numbers always carry their exponent: what is small here is not nothing.
class SumTable {
 public:
  SumTable(std::ostream& out, const ModalTableFormat& format) : out_(out), digits_(std::max(format.precision, 5)) {}

  void title(const std::string& text) {
    const std::string rule(79, '-');
    fmt::print(out_, "  {0}\n  {1}\n  {0}\n", rule, text);
  }
  void head(std::initializer_list<std::string_view> names) {
    fmt::print(out_, "  {:<8}", "Mode");
    for (const std::string_view name : names) fmt::print(out_, "{:>{}}", name, width());
    fmt::print(out_, "\n");
  }
  template <class Values>
  void row(const std::string& label, const Values& values) {
    fmt::print(out_, "  {:<8}", label);
    for (const double v : values) fmt::print(out_, "{:{}.{}E}", v + 0.0, width(), digits_);
    fmt::print(out_, "\n");
  }
  void end() { fmt::print(out_, "\n"); }

 private:
  int width() const { return digits_ + 10; }
  std::ostream& out_;
  int digits_;
};

double percent(double part, double whole) { return whole != 0 ? 100 * part / whole : 0; }

}  // namespace

void write_energies(std::ostream& out, const ModalTableFormat& format, const ModalEnergies& energies,
                    const WantedMode& wanted) {
  ModalEnergies::Share sum;
  for (std::size_t k = 0; k < energies.modes.size(); ++k) {
    if (!wanted(k)) continue;
    const auto& s = energies.modes[k];
    sum.kinetic += s.kinetic, sum.potential += s.potential, sum.power += s.power;
  }
  SumTable t(out, format);
  t.title("Energies per mode");
  t.head({"Kinetic", "percent", "Potential", "percent", "Diss. power", "percent"});
  const auto row = [&](const std::string& label, const ModalEnergies::Share& s) {
    t.row(label, std::array{s.kinetic, percent(s.kinetic, sum.kinetic), s.potential,
                            percent(s.potential, sum.potential), s.power, percent(s.power, sum.power)});
  };
  for (std::size_t k = 0; k < energies.modes.size(); ++k) {
    if (wanted(k)) row(std::to_string(k + 1), energies.modes[k]);
  }
  row("Sum", sum);
  row("Model", energies.total);
  t.end();
}

void write_masses(std::ostream& out, const ModalTableFormat& format, const ModalMasses& masses, std::int64_t rm,
                  const WantedMode& wanted) {
  const std::string frame = rm > 0 ? fmt::format("in MARKER/{}", rm) : std::string("in global axes");
  SumTable t(out, format);
  t.title("Modal participation factors " + frame);
  t.head({"Gen. mass", "X", "Y", "Z", "RX", "RY", "RZ"});
  std::array<double, 6> sum{};
  for (std::size_t k = 0; k < masses.modes.size(); ++k) {
    if (!wanted(k)) continue;
    const auto& m = masses.modes[k];
    std::array<double, 7> real{m.generalized}, imaginary{};
    for (std::size_t d = 0; d < 6; ++d) {
      real[d + 1] = m.participation[d].real(), imaginary[d + 1] = m.participation[d].imag();
      sum[d] += m.effective[d];
    }
    t.row(std::to_string(k + 1), real);
    // Shapes of real modes are real but for rounding.
    double largest = 0;
    for (const auto& factor : m.participation) largest = std::max(largest, std::abs(factor));
    if (std::any_of(imaginary.begin(), imaginary.end(), [&](double x) { return std::abs(x) > 1e-10 * largest; }))
      t.row("  imag.", imaginary);
  }
  t.end();

  t.title("Modal effective mass " + frame);
  t.head({"X", "Y", "Z", "RX", "RY", "RZ"});
  const auto share = [&](const std::array<double, 6>& of) {
    std::array<double, 6> p{};
    for (std::size_t d = 0; d < 6; ++d) p[d] = percent(of[d], sum[d]);
    return p;
  };
  for (std::size_t k = 0; k < masses.modes.size(); ++k) {
    if (!wanted(k)) continue;
    t.row(std::to_string(k + 1), masses.modes[k].effective);
    t.row("  perc.", share(masses.modes[k].effective));
  }
  t.row("Sum", sum);
  t.row("Model", masses.total);
  t.end();
}

}  // namespace dynalin
