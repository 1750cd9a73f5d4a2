#include "command/linear_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <limits>
#include <sstream>

#include "model/schema.h"
#include "study/modal_tables.h"

namespace dynalin {

namespace {

using Integers = std::vector<std::int64_t>;
using Id = std::optional<std::int64_t>;

// What asks for one table.
struct WrittenTable {
  Integers numbers;
  std::vector<double> frequencies;
  std::string all_or_numbers;
};

struct WrittenLinear {
  bool eigensol = false, statemat = false, mkb = false, nastran_export = false;
  bool no_damping = false, no_vector = false, original = false, names = false;
  Id rm, pstate, pinput, poutput, modal_rm, table_precision;
  Integers mlist;
  std::string file, config;
  std::vector<std::string> format, type;
  std::vector<WrittenTable> tables = std::vector<WrittenTable>(modal_table_kinds().size());

  static constexpr std::array<Argument<WrittenLinear>, 19> arguments = {{
      {.name = "EIGENSOL", .slot = &WrittenLinear::eigensol, .help = "eigenvalues and mode shapes"},
      {.name = "STATEMAT", .slot = &WrittenLinear::statemat, .help = "state matrices A, B, C, D"},
      {.name = "MKB", .slot = &WrittenLinear::mkb, .help = "mass, stiffness and damping matrices of second order"},
      {.name = "EXPORT", .slot = &WrittenLinear::nastran_export, .help = "a Nastran deck (`dynalin help export`)"},
      {.name = "NODAMPIN", .slot = &WrittenLinear::no_damping, .help = "damping of forces counts as zero"},
      {.name = "NOVECTOR", .slot = &WrittenLinear::no_vector, .help = "eigenvalues alone, no mode shapes and tables"},
      {.name = "ORIGINAL",
       .slot = &WrittenLinear::original,
       .help = "coordinates and rules of the original implementation (docs/linear.md)"},
      {.name = "NAMES", .slot = &WrittenLinear::names, .help = "names of elements in the tables instead of ids"},
      {.name = "RM",
       .slot = &WrittenLinear::rm,
       .minimum = 1,
       .help = "marker in whose axes, turning with it, parts are described"},
      {.name = "PSTATE",
       .slot = &WrittenLinear::pstate,
       .minimum = 1,
       .help = "the PSTATE whose VARIABLEs are the coordinates"},
      {.name = "PINPUT",
       .slot = &WrittenLinear::pinput,
       .minimum = 1,
       .help = "the PINPUT whose VARIABLEs are the inputs of B and D"},
      {.name = "POUTPUT",
       .slot = &WrittenLinear::poutput,
       .minimum = 1,
       .help = "the POUTPUT whose VARIABLEs are the outputs of C and D"},
      {.name = "FILE",
       .slot = &WrittenLinear::file,
       .help = "where the matrices or the deck go, relative to the command file"},
      {.name = "FORMAT",
       .slot = &WrittenLinear::format,
       .help = "of that file: MATRIXX, one for all, or MATLAB, one a matrix"},
      {.name = "TYPE",
       .slot = &WrittenLinear::type,
       .help = "of EXPORT: OPENBOX, element by element, or CLOSEDBOX, matrices of the whole"},
      {.name = "CONFIG",
       .slot = &WrittenLinear::config,
       .help = "of EXPORT: a file of directives, relative to the command file"},
      {.name = "MLIST", .slot = &WrittenLinear::mlist, .help = "markers whose motion in the modes MRANGE is shown"},
      {.name = "MODAL_RM",
       .slot = &WrittenLinear::modal_rm,
       .minimum = 1,
       .help = "marker about which MASS_PER_MODE counts moments"},
      {.name = "TABLE_PRECISION",
       .slot = &WrittenLinear::table_precision,
       .minimum = 2,
       .help = "decimals in these tables, 2 unless stated",
       .maximum = 100},
  }};
};

// One argument, and where its value goes.
struct Row {
  ArgumentInfo info;
  std::function<bool(WrittenLinear&, const WrittenArgument&, ElementReader&)> read;
};

template <class V>
Row table_row(std::string_view name, std::string_view help, std::size_t table, V WrittenTable::*slot) {
  return {ArgumentInfo{name, false, false, detail::value_text<V>(), {}, help},
          [=](WrittenLinear& w, const WrittenArgument& written, ElementReader& reader) {
            constexpr double any = std::numeric_limits<double>::infinity();
            return read_value(w.tables[table].*slot, written, ValueLimits{name, -any, any}, reader);
          }};
}

// The arguments in the order of the manual: tables of modes stand between those of LINEAR itself.
class Rows {
 public:
  Rows() {
    own_up_to("CONFIG");
    tables(TableAsked::by_numbers_or_frequency);
    own_up_to("MLIST");
    tables(TableAsked::by_numbers);
    frequencies();
    tables(TableAsked::all_or_by_numbers);
    own_up_to("TABLE_PRECISION");
    for (const Row& row : list_) infos.push_back(row.info), names.push_back(row.info.name);
  }
  bool read(std::size_t k, WrittenLinear& w, const WrittenArgument& written, ElementReader& reader) const {
    return list_[k].read(w, written, reader);
  }

  std::vector<ArgumentInfo> infos;
  std::vector<std::string_view> names;

 private:
  void own_up_to(std::string_view last) {
    for (bool more = true; more; ++own_) {
      const Argument<WrittenLinear>& a = WrittenLinear::arguments[own_];
      list_.push_back({detail::argument_infos<WrittenLinear>[own_],
                       [&a](WrittenLinear& w, const WrittenArgument& written, ElementReader& reader) {
                         return detail::read_argument(w, a, written, reader);
                       }});
      more = a.name != last;
    }
  }
  void tables(TableAsked asked) {
    const auto kinds = modal_table_kinds();
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      if (kinds[k].asked != asked) continue;
      if (asked == TableAsked::all_or_by_numbers)
        list_.push_back(table_row(kinds[k].name, kept(kinds[k].help, " [ALL, or first mode, last mode]"), k,
                                  &WrittenTable::all_or_numbers));
      else
        list_.push_back(
            table_row(kinds[k].name, kept(kinds[k].help, " [first mode, last mode]"), k, &WrittenTable::numbers));
    }
  }
  void frequencies() {
    const auto kinds = modal_table_kinds();
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      if (kinds[k].asked != TableAsked::by_numbers_or_frequency) continue;
      const std::string_view help =
          kept(fmt::format("as {}", kinds[k].name), ", of modes between two frequencies [cycles per unit time]");
      list_.push_back(table_row(kept("F", kinds[k].name), help, k, &WrittenTable::frequencies));
    }
  }
  // Rows only point to their texts.
  std::string_view kept(std::string_view a, std::string_view b) {
    return texts_.emplace_back(std::string(a).append(b));
  }

  std::size_t own_ = 0;
  std::vector<Row> list_;
  std::deque<std::string> texts_;
};

const Rows& rows() {
  static const Rows made;
  return made;
}

constexpr std::size_t longest_file_name = 76;
constexpr std::array<std::string_view, 2> box_types = {"OPENBOX", "CLOSEDBOX"};

// ALL, or one or two mode numbers; empty if it is neither.
Integers all_or_range(const std::string& text) {
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

void ask_for_tables(const WrittenLinear& w, ModalTableRequest& request) {
  const auto kinds = modal_table_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const WrittenTable& t = w.tables[k];
    const std::string name(kinds[k].name);
    const Integers numbers = t.numbers.empty() ? all_or_range(t.all_or_numbers) : t.numbers;
    if (!numbers.empty()) request.modes[name] = {.first = numbers.front(), .last = numbers.back()};
    if (!t.frequencies.empty()) request.modes[name] = {.lowest_hz = t.frequencies[0], .highest_hz = t.frequencies[1]};
  }
  request.markers = w.mlist;
  request.modal_rm = w.modal_rm;
}

class Rules {
 public:
  Rules(const WrittenLinear& w, ElementReader& reader) : w_(w), reader_(reader) {}

  void check() {
    options();
    qualifiers();
    tables();
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
    only_with("NOVECTOR", modes, "EIGENSOL");
    for (const auto name : {"PINPUT", "POUTPUT", "FORMAT"}) only_with(name, matrices, "STATEMAT and MKB");
    for (const auto name : {"RM", "PSTATE", "ORIGINAL"}) only_with(name, modes || matrices, "EIGENSOL, STATEMAT and MKB");
    for (const auto name : {"CONFIG", "TYPE"}) only_with(name, w_.nastran_export, "EXPORT");
    only_with("FILE", !modes, "STATEMAT, MKB and EXPORT");
    for (const ModalTableKind& kind : modal_table_kinds()) {
      only_with(kind.name, modes, "EIGENSOL");
      only_with(by_frequency(kind), modes, "EIGENSOL");
    }
    for (const auto name : {"MLIST", "TABLE_PRECISION", "NAMES"}) only_with(name, modes, "EIGENSOL");
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
    const Integers range = dynalin::all_or_range(text);
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
    if (given("MODAL_RM") && !given("MASS_PER_MODE"))
      error("missing-argument", "MODAL_RM", "MODAL_RM needs MASS_PER_MODE");
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
    one_of("FORMAT", w_.format, {"MATRIXX", "MATLAB"});
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

std::span<const ArgumentInfo> linear_arguments() { return rows().infos; }

std::optional<LinearCommand> read_linear(ElementReader& reader) {
  WrittenLinear w;
  const std::size_t before = reader.diagnostics().error_count();
  const bool read = detail::read_rows(
      rows().infos, rows().names, reader,
      [&](std::size_t k, const WrittenArgument& written) { return rows().read(k, w, written, reader); });
  if (!read) return std::nullopt;  // reported, maybe when the text was read
  Rules(w, reader).check();
  if (reader.diagnostics().error_count() > before) return std::nullopt;

  LinearCommand c;
  c.option = w.eigensol   ? LinearOption::eigensol
             : w.statemat ? LinearOption::statemat
             : w.mkb      ? LinearOption::mkb
                          : LinearOption::nastran_export;
  c.rm = w.rm, c.pstate = w.pstate, c.pinput = w.pinput, c.poutput = w.poutput;
  c.without_damping = w.no_damping, c.without_vectors = w.no_vector, c.original = w.original, c.names = w.names;
  c.file = w.file, c.config = w.config;
  static constexpr std::array<std::string_view, 2> formats = {"MATRIXX", "MATLAB"};
  if (!w.format.empty()) c.format = formats[*find_keyword(w.format.front(), formats)];
  if (!w.type.empty()) c.type = box_types[*find_keyword(w.type.front(), box_types)];
  c.table_precision = static_cast<int>(w.table_precision.value_or(2));
  ask_for_tables(w, c.tables);
  return c;
}

}  // namespace dynalin
