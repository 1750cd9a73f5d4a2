#include "elements/bodies/modal_ratio.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "dataset/characters.h"
#include "dataset/dataset.h"
#include "expression/expression.h"
#include "routine/damping_routine.h"

namespace dynalin {

namespace {

// The text with each of these names replaced by another word of as many letters, so that places stay.
std::string with_names(std::string text, std::string_view frequency, std::string_view mode) {
  const auto is_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = 0; at + 6 <= text.size(); ++at) {
    if ((at > 0 && is_name(text[at - 1])) || (at + 6 < text.size() && is_name(text[at + 6]))) continue;
    const std::string_view word = std::string_view(text).substr(at, 6);
    if (equal_ignoring_case(word, "FXFREQ")) text.replace(at, 6, frequency);
    if (equal_ignoring_case(word, "FXMODE")) text.replace(at, 6, mode);
  }
  return text;
}

// A text as the expression of a statement; its problems at their places behind `at`.
std::optional<Expression> parsed(const std::string& text, const Span& at, Diagnostics& out) {
  const std::string before = "t\nVARIABLE/1, FUNCTION=";
  const auto source = std::make_shared<const SourceText>("", before + text + "\n");
  const auto dataset = parse_dataset(source);
  Diagnostics problems;
  std::optional<Expression> e;
  if (!dataset.diagnostics.has_errors() && !dataset.value.statements.empty() &&
      !dataset.value.statements.front().arguments.empty())
    e = parse_expression(dataset.value.statements.front().arguments.front().value(), *source, problems);
  if (e && !problems.has_errors()) return e;
  const auto& items = problems.has_errors() ? problems.items() : dataset.diagnostics.items();
  for (const Diagnostic& d : items) {
    if (d.severity != Severity::error) continue;
    const bool inside = d.at.source == source.get() && d.at.offset >= before.size();
    const auto offset = inside ? d.at.offset - static_cast<std::uint32_t>(before.size()) : 0;
    out.error(d.code, {at.source, at.offset + offset, inside ? d.at.length : at.length}, d.message, d.hint);
  }
  return std::nullopt;
}

bool are_ratios(std::span<const double> ratios, const Span& at, const RatioModes& modes, Diagnostics& out) {
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    if (ratios[k] >= 0 && std::isfinite(ratios[k])) continue;
    out.error("value-out-of-range", at,
              fmt::format("CRATIO of {} is {:g} for its mode {} at {:g} cycles/s, it must not be negative", modes.owner,
                          ratios[k], modes.number[k], modes.frequency[k]));
    return false;
  }
  return true;
}

}  // namespace

std::optional<std::vector<double>> written_ratios(const Span& at, const RatioModes& modes, Diagnostics& out) {
  const std::string text(at.text());
  // TIME stands for one of the two, the other is a number: whatever else it reads is one too many.
  const auto plain = parsed(with_names(text, "1.0000", "1.0000"), at, out);
  if (!plain) return std::nullopt;
  if (!plain->is_constant() || !plain->splines().empty()) {
    out.error("function-of-state", at,
              fmt::format("CRATIO of {} is a function of FXFREQ and FXMODE alone", modes.owner));
    return std::nullopt;
  }
  std::vector<double> ratios;
  for (std::size_t k = 0; k < modes.frequency.size(); ++k) {
    const auto of_mode = parsed(with_names(text, "TIME  ", fmt::format("{:<6}", modes.number[k])), at, out);
    if (!of_mode) return std::nullopt;
    ExpressionWorkspace<double> scratch;
    const std::array<double, 1> value{modes.frequency[k]};
    const double ratio = of_mode->evaluate(std::span<const double>(value).first(of_mode->atoms().size()), scratch);
    ratios.push_back(ratio);
  }
  return are_ratios(ratios, at, modes, out) ? std::optional(ratios) : std::nullopt;
}

bool called_ratios(const DampingRoutine& routine, const ElementLabel& label, const RatioModes& modes,
                   std::vector<double>& ratios, Diagnostics& out) {
  if (const std::string problem = routine.ratios(modes.frequency, ratios); !problem.empty()) {
    out.error("routine-failed", label.at, fmt::format("{} gives no ratios: {}", routine.what(), problem));
    return false;
  }
  return are_ratios(ratios, label.at, modes, out);
}

double default_ratio(double frequency) { return frequency < 100 ? 0.01 : frequency < 1000 ? 0.1 : 1.0; }

}  // namespace dynalin
