#include "nastran/punch_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "nastran/case_control.h"

namespace dynalin::nastran {

namespace {

// FORTRAN's E18.6 with a digit before the point, and E15.7 with zero there; three digits of an exponent have no E.
std::string scientific(double value, int decimals) {
  std::string text = fmt::format("{:.{}E}", value == 0 ? 0.0 : value, decimals);
  const std::size_t e = text.find('E');
  if (e != std::string::npos && text.size() - e > 4) text.erase(e, 1);
  return text;
}
std::string E18_6(double value) { return fmt::format("{:>18}", scientific(value, 6)); }
std::string E15_7(double value) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{:>15}", scientific(value, 7));
  const std::string digits = fmt::format("{:.6E}", std::abs(value));  // d.dddddd becomes 0.ddddddd
  const std::size_t e = digits.find('E');
  const int power = std::atoi(digits.c_str() + e + 1) + 1;
  const std::string mantissa = "0." + digits.substr(0, 1) + digits.substr(2, e - 2);
  const std::string exponent = std::abs(power) < 100 ? fmt::format("E{:+03}", power) : fmt::format("{:+04}", power);
  return fmt::format("{:>15}", (value < 0 ? "-" : "") + mantissa + exponent);
}

class Records {
 public:
  void add(std::string_view content) {
    fmt::format_to(std::back_inserter(text), "{:<72.72}{:>8}\n", content, ++number_);
  }
  std::string text;

 private:
  long number_ = 0;
};

}  // namespace

std::string punch_text(const Deck& deck, const ExportOptions& options) {
  std::set<std::int64_t> scalar;
  for (const ScalarPoint& p : deck.scalar_points) scalar.insert(p.id);
  Records records;
  for (std::size_t m = 0; m < deck.modes.size(); ++m) {
    const DeckMode& mode = deck.modes[m];
    records.add(fmt::format("$TITLE   ={:<60.60}", options.title));
    records.add(fmt::format("$SUBTITLE={:<60.60}", subtitle(deck, options)));
    records.add("$LABEL   =");
    records.add("$EIGENVECTOR");
    records.add("$REAL-IMAGINARY OUTPUT");
    records.add(fmt::format("$SUBCASE ID ={:>12}", 1));
    records.add(
        fmt::format("$EIGENVALUE = ({},{}) MODE = {:>5}", E15_7(mode.eigenvalue[0]), E15_7(mode.eigenvalue[1]), m + 1));
    for (std::size_t k = 0; k < deck.mode_points.size(); ++k) {
      const std::int64_t point = deck.mode_points[k];
      const auto& shape = mode.shape[k];
      std::string begin = fmt::format("{:>10}       {}", point, scalar.contains(point) ? 'S' : 'G');
      for (const std::size_t part : {0u, 1u}) {  // real, imaginary
        for (const std::size_t first : {0u, 3u}) {
          records.add(begin + E18_6(shape[first][part]) + E18_6(shape[first + 1][part]) +
                      E18_6(shape[first + 2][part]));
          begin = "-CONT-            ";
        }
      }
    }
  }
  return std::move(records.text);
}

}  // namespace dynalin::nastran
