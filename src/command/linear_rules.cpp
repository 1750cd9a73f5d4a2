#include "command/linear_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <sstream>

namespace dynalin {

Integers modes_of_text(const std::string& text) {
  std::string word(text);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (word == "ALL") return {1, std::numeric_limits<std::int64_t>::max()};
  Integers range;
  std::istringstream in(word);
  for (std::int64_t n = 0; in >> n;) {
    range.push_back(n);
    in >> std::ws;
    if (in.peek() == ',') in.get();
  }
  return in.eof() ? range : Integers{};
}

namespace {

constexpr std::size_t longest_file_name = 76;

class Rules {
 public:
  Rules(const WrittenLinear& w, ElementReader& reader) : w_(w), reader_(reader) {}

  void check() {
    options();
    qualifiers();
    selection();
    tables();
    without_effect();
    files();
  }

 private:
  bool given(std::string_view name) const { return reader_.given(name); }
  void error(std::string_view code, std::string_view at, std::string message, std::string hint = {}) {
    reader_.error(code, reader_.at(at), std::move(message), std::move(hint));
  }
  void excluded(std::string_view a, std::string_view b) {
    if (given(a) && given(b)) error("excluded-arguments", b, fmt::format("{} and {} exclude each other", a, b));
  }
  void only_with(std::string_view argument, bool allowed, std::string_view options) {
    if (given(argument) && !allowed)
      error("wrong-option", argument, fmt::format("{} goes with {} only", argument, options));
  }

  void options() {
    static constexpr std::array<std::string_view, 4> names = {"EIGENSOL", "STATEMAT", "MKB", "EXPORT"};
    const auto count = std::count_if(names.begin(), names.end(), [&](auto n) { return given(n); });
    if (count == 0) error("missing-option", "", "LINEAR needs one of EIGENSOL, STATEMAT, MKB and EXPORT");
    if (count < 2) return;
    const auto second = std::find_if(std::find_if(names.begin(), names.end(), [&](auto n) { return given(n); }) + 1,
                                     names.end(), [&](auto n) { return given(n); });
    error("excluded-arguments", *second, "LINEAR takes exactly one of EIGENSOL, STATEMAT, MKB and EXPORT");
  }

  void qualifiers() {
    const bool matrices = w_.statemat || w_.mkb, modes = w_.eigensol;
    if (!modes && !matrices && !w_.nastran_export) return;
    only_with("NODAMPIN", modes || w_.mkb, "EIGENSOL and MKB");
    for (const auto name : {"NOVECTOR", "NMODES", "NEAR", "BAND"}) only_with(name, modes, "EIGENSOL");
    only_with("DESCRIPTOR", w_.statemat, "STATEMAT");
    for (const auto name : {"PINPUT", "POUTPUT", "FORMAT"}) only_with(name, matrices, "STATEMAT and MKB");
    for (const auto name : {"RM", "PSTATE", "ORIGINAL"})
      only_with(name, modes || matrices, "EIGENSOL, STATEMAT and MKB");
    for (const auto name : {"CONFIG", "TYPE"}) only_with(name, w_.nastran_export, "EXPORT");
    only_with("FILE", !modes, "STATEMAT, MKB and EXPORT");
    for (const ModalTableKind& kind : modal_table_kinds()) {
      only_with(kind.name, modes, "EIGENSOL");
      only_with(by_frequency(kind), modes, "EIGENSOL");
    }
    for (const auto name : {"MLIST", "TABLE_PRECISION", "NAMES"}) only_with(name, modes, "EIGENSOL");
  }

  void selection() {
    excluded("NMODES", "BAND");
    if (given("NEAR") && !given("NMODES")) error("missing-argument", "NEAR", "NEAR needs NMODES");
    if (!w_.band.empty() && w_.band.size() != 2) {
      error("wrong-count", "BAND", "BAND takes two frequencies");
    } else if (!w_.band.empty() && !(w_.band[0] >= 0 && w_.band[1] > w_.band[0])) {
      error("value-out-of-range", "BAND", "BAND takes frequencies 0 ≤ f1 < f2");
    }
    for (const ModalTableKind& kind : modal_table_kinds()) {
      if (!kind.needs_all_modes) continue;
      for (const auto name : {"NMODES", "BAND"}) excluded(name, kind.name);
    }
  }

  void mode_range(std::string_view name, const Integers& range) {
    if (range.empty()) return;
    if (range.size() > 2) {
      error("wrong-count", name, fmt::format("{} has {} values, it takes one or two", name, range.size()));
    } else if (range[0] < 1 || (range.size() == 2 && range[1] < range[0])) {
      error("value-out-of-range", name, fmt::format("{} takes mode numbers i1 ≥ 1 and i2 ≥ i1", name));
    }
  }
  void frequency_range(std::string_view name, const std::vector<double>& range) {
    if (range.empty()) return;
    if (range.size() != 2) {
      error("wrong-count", name, fmt::format("{} takes two frequencies", name));
    } else if (!(range[0] > 0 && range[1] > range[0])) {
      error("value-out-of-range", name, fmt::format("{} takes frequencies 0 < r1 < r2", name));
    }
  }
  void all_or_range(std::string_view name, const std::string& text) {
    const Integers range = modes_of_text(text);
    const bool numbers = range.size() == 1 || range.size() == 2;
    if (!text.empty() && (!numbers || range.front() < 1 || range.back() < range.front())) {
      error("value-out-of-range", name,
            fmt::format("{} takes ALL or mode numbers i1 ≥ 1 and i2 ≥ i1, not {}", name, text));
    }
  }

  // The argument that asks for this table by frequency, empty where none does.
  static std::string by_frequency(const ModalTableKind& kind) {
    return kind.asked == TableAsked::by_numbers_or_frequency ? fmt::format("F{}", kind.name) : std::string();
  }

  void tables() {
    const auto kinds = modal_table_kinds();
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::string frequency = by_frequency(kinds[k]);
      mode_range(kinds[k].name, w_.tables[k].numbers);
      frequency_range(frequency, w_.tables[k].frequencies);
      all_or_range(kinds[k].name, w_.tables[k].all_or_numbers);
      excluded(kinds[k].name, frequency);
      excluded("NOVECTOR", kinds[k].name);
      excluded("NOVECTOR", frequency);
    }
    excluded("NOVECTOR", "MLIST");
    if (given("MLIST") != given("MRANGE")) {
      const std::string_view there = given("MLIST") ? "MLIST" : "MRANGE";
      error("missing-argument", there, fmt::format("{} needs {}", there, given("MLIST") ? "MRANGE" : "MLIST"));
    }
    for (const ModalTableKind& kind : kinds) {
      if (!kind.only_argument.empty() && given(kind.only_argument) && !given(kind.name))
        error("missing-argument", kind.only_argument, fmt::format("{} needs {}", kind.only_argument, kind.name));
    }
  }

  // What is allowed and changes nothing, as nothing that is asked for reads it.
  void without_effect() {
    if (!w_.eigensol) return;
    const auto asked = [&](const ModalTableKind& kind) { return given(kind.name) || given(by_frequency(kind)); };
    const auto kinds = modal_table_kinds();
    const auto asked_with_elements = [&](const ModalTableKind& kind) {
      return kind.asked != TableAsked::all_or_by_numbers && asked(kind);
    };
    if (given("TABLE_PRECISION") && std::ranges::none_of(kinds, asked))
      pass_over("TABLE_PRECISION", "the command asks for no table of modes");
    if (!given("NAMES")) return;
    if (std::ranges::none_of(kinds, asked_with_elements))
      pass_over("NAMES", "the command asks for no table with elements in it");
    else if (w_.table_precision.value_or(2) == 2)
      pass_over("NAMES", "names are printed with more than two decimals alone", "TABLE_PRECISION=3, NAMES");
  }
  void pass_over(std::string_view argument, std::string_view why, std::string hint = {}) {
    reader_.warning("passed-over", reader_.at(argument), fmt::format("{} is passed over: {}", argument, why),
                    std::move(hint));
  }

  void files() {
    if ((w_.statemat || w_.mkb || w_.nastran_export) && !given("FILE")) {
      error("missing-argument",
            w_.statemat ? "STATEMAT"
            : w_.mkb    ? "MKB"
                        : "EXPORT",
            fmt::format("{} needs FILE", w_.statemat ? "STATEMAT"
                                         : w_.mkb    ? "MKB"
                                                     : "EXPORT"));
    }
    if (w_.file.size() > longest_file_name) {
      error("value-out-of-range", "FILE",
            fmt::format("the name of FILE has {} characters, {} are allowed", w_.file.size(), longest_file_name));
    }
    const auto one_of = [&](std::string_view name, const std::vector<std::string>& word,
                            std::array<std::string_view, 2> words) {
      if (!word.empty() && !find_keyword(word.front(), words)) {
        error("unknown-word", name, fmt::format("{} is {} or {}, not {}", name, words[0], words[1], word.front()));
      }
    };
    static constexpr std::array<std::string_view, 2> formats = {"MATRIXX", "MATLAB"};
    one_of("FORMAT", w_.format, formats);
    excluded("FORMAT", "DESCRIPTOR");
    const bool several = w_.descriptor || (!w_.format.empty() && find_keyword(w_.format.front(), formats) == 1);
    if (several && w_.file == "-")
      error("wrong-option", "FILE",
            fmt::format("FILE of {} is what the names of its files begin with, not standard output",
                        w_.descriptor ? "DESCRIPTOR" : "FORMAT=MATLAB"));
    one_of("TYPE", w_.type, box_types);
    if (w_.nastran_export && !given("TYPE"))
      error("missing-argument", "EXPORT", "EXPORT needs TYPE: OPENBOX or CLOSEDBOX");
    if (w_.nastran_export && w_.file == "-")
      error("wrong-option", "FILE", "FILE of EXPORT is what the names of its files begin with, not standard output");
  }

  const WrittenLinear& w_;
  ElementReader& reader_;
};

}  // namespace

void check_linear(const WrittenLinear& w, ElementReader& reader) { Rules(w, reader).check(); }

}  // namespace dynalin
