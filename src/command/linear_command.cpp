#include "command/linear_command.h"

#include <fmt/format.h>

#include <deque>
#include <functional>
#include <limits>

#include "command/linear_rules.h"

namespace dynalin {

namespace {

// One argument, and where its value goes.
struct Row {
  ArgumentInfo info;
  std::function<bool(WrittenLinear&, const WrittenArgument&, ElementReader&)> read;
};

template <class V>
Row table_row(std::string_view name, std::string_view help, std::size_t table, V WrittenTable::*slot) {
  return {ArgumentInfo{.name = name, .value = detail::value_kind<V>(), .help = help},
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
    own_up_to("DESCRIPTOR");
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

void ask_for_tables(const WrittenLinear& w, ModalTableRequest& request) {
  const auto kinds = modal_table_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const WrittenTable& t = w.tables[k];
    const std::string name(kinds[k].name);
    const Integers numbers = t.numbers.empty() ? modes_of_text(t.all_or_numbers) : t.numbers;
    if (!numbers.empty()) request.modes[name] = {.first = numbers.front(), .last = numbers.back()};
    if (!t.frequencies.empty()) request.modes[name] = {.lowest_hz = t.frequencies[0], .highest_hz = t.frequencies[1]};
  }
  request.markers = w.mlist;
  request.modal_rm = w.modal_rm;
}

}  // namespace

std::span<const ArgumentInfo> linear_arguments() { return rows().infos; }

std::optional<LinearCommand> read_linear(ElementReader& reader) {
  WrittenLinear w;
  const std::size_t before = reader.diagnostics().error_count();
  const bool read = detail::read_rows(
      rows().infos, rows().names, reader,
      [&](std::size_t k, const WrittenArgument& written) { return rows().read(k, w, written, reader); });
  if (!read) return std::nullopt;  // reported, maybe when the text was read
  check_linear(w, reader);
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
  if (w.mode_count) c.selection = NearestModes{static_cast<std::size_t>(*w.mode_count), w.near.value_or(0)};
  if (!w.band.empty()) c.selection = ModesInBand{w.band[0], w.band[1]};
  c.descriptor = w.descriptor;
  return c;
}

}  // namespace dynalin
