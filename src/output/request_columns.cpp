#include "output/request_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/yaw_pitch_roll.h"

namespace dynalin {

namespace {

bool fits(const std::string& text, std::size_t width) { return text.size() < width; }

}  // namespace

RequestColumns columns_of(const RequestInfo& info, const std::vector<double>& values, const OutputSettings& settings,
                          AngleUnit angles) {
  RequestColumns columns;
  for (std::size_t k = 0; k < info.components().size(); ++k) {
    if (const int place = info.components()[k].place; place > 0)
      columns[static_cast<std::size_t>(place - 1)] = values[k];
  }
  if (info.kind == RequestKind::functions) return columns;
  if (info.kind == RequestKind::displacement) {
    if (settings.yaw_pitch_roll) {
      const auto turned = yaw_pitch_roll(rotation_313(*columns[5], *columns[6], *columns[7]));
      std::copy(turned.begin(), turned.end(), columns.begin() + 5);
    }
    for (std::size_t k = 5; k < 8 && angles == AngleUnit::degrees; ++k) *columns[k] *= 180 / std::numbers::pi;
  }
  const auto kind = static_cast<std::size_t>(info.kind) - 1;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!columns[k]) continue;
    double& v = *columns[k];
    v *= settings.scale[kind][k < 4 ? 0 : 1];
    if (std::fabs(v) < settings.zero[kind]) v = 0;
    v += 0.0;
  }
  return columns;
}

std::array<std::string, 8> column_heads(const RequestInfo& info, const OutputSettings& settings) {
  std::array<std::string, 8> heads;
  std::copy(info.heads.begin(), info.heads.end(), heads.begin());
  for (const RequestComponent& c : info.components()) {
    if (c.place == 0 || !heads[static_cast<std::size_t>(c.place - 1)].empty()) continue;
    static constexpr std::array<std::string_view, 3> turned = {"YAW", "PITCH", "ROLL"};
    const bool yaw =
        info.kind == RequestKind::displacement && c.place > 5 && settings.yaw_pitch_roll && c.given.empty();
    heads[static_cast<std::size_t>(c.place - 1)] =
        yaw ? std::string(turned[static_cast<std::size_t>(c.place - 6)]) : c.called();
  }
  return heads;
}

std::string number_field(double x, std::size_t width) {
  if (std::isnan(x)) return fmt::format("{:>{}}", "NAN", width);  // whatever its sign
  std::string text;
  for (int digits = 5; digits >= 0; --digits) {
    text = fmt::format("{:.{}E}", x, digits);
    if (fits(text, width)) break;
  }
  return fmt::format("{:>{}}", text, width);
}

std::string fixed_field(double x, std::size_t width) {
  const std::string text = fmt::format("{:.4f}", x);
  const bool says_something = x == 0 || std::fabs(x) >= 1e-4;
  return std::isfinite(x) && says_something && fits(text, width) ? fmt::format("{:>{}}", text, width)
                                                                 : number_field(x, width);
}

// Inch, pound and pound force, kilogram, newton and millimetre are seen in files of others; the rest is formed like
// them.
std::string unit_code(const Units& units) {
  using Codes = std::initializer_list<std::pair<std::string_view, std::string_view>>;
  const auto code = [](const std::string& keyword, Codes codes, std::size_t width) {
    for (const auto& [name, text] : codes) {
      if (name == keyword) return std::string(text);
    }
    std::string text = keyword.empty() ? "_" : keyword;
    text.resize(width, '_');
    return text;
  };
  return code(units.length,
              {{"INCH", "IN"},
               {"METER", "M_"},
               {"MILLIMETER", "MM"},
               {"CENTIMETER", "CM"},
               {"KILOMETER", "KM"},
               {"FOOT", "FT"},
               {"MILE", "MI"}},
              2) +
         code(units.mass,
              {{"POUND_MASS", "LBS"}, {"KILOGRAM", "KGS"}, {"GRAM", "GRM"}, {"SLUG", "SLG"}, {"TONNE", "TON"}}, 3) +
         code(units.force,
              {{"POUND_FORCE", "_PF"},
               {"NEWTON", "_N_"},
               {"KNEWTON", "_KN"},
               {"DYNE", "_DY"},
               {"KILOGRAM_FORCE", "_KF"}},
              3) +
         "RACA";
}

double units_per_metre(const Units& units) { return 1 / units.length_in_metres; }

std::string date_and_time(std::time_t when) {
  std::tm local{};
  ::localtime_r(&when, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local);
  return text.data();
}

std::string title_field(const std::string& title) { return fmt::format("{:80.80}", title); }

}  // namespace dynalin
