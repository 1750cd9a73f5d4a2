#include "nastran/configuration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>

#include "dataset/characters.h"
#include "dataset/dataset.h"
#include "nastran/configuration_text.h"
#include "nastran/directive_values.h"
#include "nastran/named_elements.h"

namespace dynalin::nastran {

namespace {

unsigned ignored_bits(const WrittenItem& item) {
  if (item.directive) return item.directive->ignored;
  return item.block && item.block->ignored_in_107 ? in_sol_107 : never;
}

std::string_view name_of(const WrittenItem& item) {
  return item.directive ? item.directive->name : item.block ? item.block->name : "verbatim";
}

void store(const WrittenItem& item, ExportOptions& to, Diagnostics& diagnostics) {
  if (item.directive)
    store(*item.directive, item.written, to, diagnostics);
  else if (item.block)
    item.block->store(item.written.key, item.fields, to, diagnostics);
  else
    to.verbatim.insert(to.verbatim.end(), item.lines.begin(), item.lines.end());
}

class Reader {
 public:
  Reader(SourceRef source, Box box) : box_(box) { made_.value.source = std::move(source); }

  Parsed<Configuration> read() {
    const SourceText& source = *made_.value.source;
    items_ = parse_configuration(source, made_.diagnostics);
    // What the solution is, and what else decides over directives, may stand behind them.
    ExportOptions all, of_job;
    for (const WrittenItem& item : items_) store(item, all, made_.diagnostics);
    Diagnostics said;
    for (const WrittenItem& item : items_) {
      constexpr unsigned of_jobs = in_closed_box | in_sol_107 | in_sol_108;
      if (!holding(ignored_bits(item) & of_jobs, box_, all)) store(item, of_job, said);
    }
    take(of_job);
    check_distinct_suffixes();
    if (options().solution_number == 108) check_response();
    if (options().debug) echo(of_job);
    if (options().ignore_errors) forgive();
    return std::move(made_);
  }

 private:
  ExportOptions& options() { return made_.value.options; }
  void error(std::string_view code, const Span& at, std::string message, std::string hint = {}) {
    made_.diagnostics.error(code, at, std::move(message), std::move(hint));
  }

  // What acts, with its places.
  void take(const ExportOptions& of_job) {
    Configuration& c = made_.value;
    Diagnostics said;
    std::map<std::string, std::vector<std::string_view>> without_effect;
    std::vector<Note> notes;
    for (const WrittenItem& item : items_) {
      if (const unsigned hold = holding(ignored_bits(item), box_, of_job)) {
        without_effect[ignored_text(hold)].push_back(name_of(item));
        notes.push_back({item.written.key, fmt::format("{} has no effect with {}", name_of(item), ignored_text(hold))});
        continue;
      }
      const std::size_t forces = c.options.force_editable.size(), bodies = c.options.flexbody_editable.size();
      const std::size_t errors = said.error_count();
      store(item, c.options, said);
      if (said.error_count() > errors) continue;
      const Span& value = item.written.value;
      if (c.options.force_editable.size() > forces) c.force_editable.push_back(value);
      if (c.options.flexbody_editable.size() > bodies) c.flexbody_editable.push_back(value);
      if (name_of(item) == "export_markers_by_id") c.export_markers_by_id = split_list(value);
      if (name_of(item) == "export_markers_by_name") c.export_markers_by_name = split_list(value);
      if (item.block) take_place(item);
    }
    if (notes.empty()) return;
    const Span at = notes.front().at;
    if (notes.size() == 1) notes.clear();  // the message says it
    std::vector<std::string> reasons;
    for (const auto& [why, names] : without_effect)
      reasons.push_back(fmt::format("{} ({})", fmt::join(names, ", "), why));
    made_.diagnostics
        .warning("ignored-directive", at, fmt::format("without effect on this export: {}", fmt::join(reasons, "; ")))
        .notes = std::move(notes);
  }
  void take_place(const WrittenItem& item) {
    const std::string name = field(item, "name").value.length ? read_string(field(item, "name").value) : "";
    // With both of them the name says too much, or something else.
    const WrittenValue marker = field(item, "marker_name").value.length      ? field(item, "marker_name")
                                : field(item, "marker_by_name").value.length ? field(item, "marker_by_name")
                                                                             : field(item, "marker_id");
    if (item.block->name == "displacement_output_channel") made_.value.output_channels[name] = marker.value;
    if (item.block->name == "force_input_channel") made_.value.input_channels[name] = marker.value;
  }
  static WrittenValue field(const WrittenItem& item, std::string_view name) {
    for (const WrittenValue& w : item.fields) {
      if (w.key.text() == name) return w;
    }
    return {};
  }

  // --- frequency response ---
  const WrittenItem* last(std::string_view name) const {
    const auto found =
        std::find_if(items_.rbegin(), items_.rend(), [&](const WrittenItem& i) { return name_of(i) == name; });
    return found == items_.rend() ? nullptr : &*found;
  }
  void check_response() {
    const Span at = last("solution_number")->written.value;
    for (const DirectiveGroup& group : directive_groups()) {
      for (const Directive& d : group.directives) {
        if (d.required_in_108 && !last(d.name))
          error("missing-directive", at, fmt::format("solution 108 needs {}", d.name),
                fmt::format("{} = {}", d.name, values_text(d)));
      }
      for (const Block& b : group.blocks) {
        if (b.required_in_108 && !last(b.name))
          error("missing-directive", at, fmt::format("solution 108 needs {}", b.name), std::string(b.help));
      }
    }
    const auto &begin = options().begin_frequency, &end = options().end_frequency;
    if (begin && end && *end <= *begin)
      error("directive-value", last("end_frequency")->written.value,
            fmt::format("end_frequency is above begin_frequency, {}", *begin));
    if (begin && *begin == 0 && options().spacing_frequency == Spacing::log)
      error("directive-value", last("begin_frequency")->written.value,
            "begin_frequency is above 0 with spacing_frequency = log");
    for (const WrittenItem& item : items_) check_names(item);
    if (options().split_dmigs) check_suffixes();
  }
  template <class T>
  static std::vector<std::string_view> names_of(const std::vector<T>& list) {
    std::vector<std::string_view> names;
    for (const T& item : list) names.push_back(item.name);
    return names;
  }
  void exists(const Span& at, std::string_view what, const std::vector<std::string_view>& names) {
    const std::string name = read_string(at);
    if (std::ranges::find(names, name) != names.end()) return;
    const std::string_view near = nearest_word(name, names);
    error("unknown-channel", at, fmt::format("there is no {} {}", what, name),
          near.empty() ? "" : fmt::format("{} exists", near));
  }
  void check_names(const WrittenItem& item) {
    if (!item.block) return;
    if (const WrittenValue w = field(item, "actuator_name"); w.value.length)
      exists(w.value, "actuator_swept_sine", names_of(options().actuator_swept_sine));
    if (const WrittenValue w = field(item, "input_channel_names"); w.value.length) {
      for (const Span& name : split_list(w.value))
        exists(name, "force_input_channel", names_of(options().force_input_channel));
    }
    if (const WrittenValue w = field(item, "output_channel_names"); w.value.length) {
      for (const Span& name : split_list(w.value))
        exists(name, "displacement_output_channel", names_of(options().displacement_output_channel));
    }
  }
  // A matrix in two parts has two letters before them.
  void check_suffixes() {
    constexpr std::size_t longest = 6;
    const auto check = [&](const std::string& suffix, const Span& at) {
      if (suffix.size() > longest)
        error("directive-value", at,
              fmt::format("{} is too long for the name of a matrix in two parts: {} characters fit", suffix, longest),
              "split_dmigs = no");
    };
    for (const auto name : {"forces_dmig_name", "differentials_dmig_name"}) {
      if (const WrittenItem* item = last(name)) check(read_string(item->written.value), item->written.value);
    }
    const Configuration& c = made_.value;
    for (std::size_t k = 0; k < c.force_editable.size(); ++k)
      check(c.options.force_editable[k].suffix, c.force_editable[k]);
    for (std::size_t k = 0; k < c.flexbody_editable.size(); ++k)
      check(c.options.flexbody_editable[k].suffix, c.flexbody_editable[k]);
  }

  // Two elements, or one and the matrices of all others, have no name in common.
  void check_distinct_suffixes() {
    const Configuration& c = made_.value;
    std::map<std::string, const Editable*> taken = {{upper_case(options().forces_dmig_name), nullptr},
                                                    {upper_case(options().differentials_dmig_name), nullptr}};
    const auto check = [&](const Editable& e, const Span& at) {
      const auto [found, fresh] = taken.emplace(upper_case(e.suffix), &e);
      const Editable* other = found->second;
      if (fresh) return;
      // One that is named here and numbered there may be the same, and one that is named by less of its path.
      const bool named_alike = !other || other->name.ends_with(e.name) || e.name.ends_with(other->name);
      const bool may_be_one = other && other->type == e.type &&
                              (other->id.has_value() != e.id.has_value() || (other->id == e.id && named_alike));
      if (!may_be_one)
        error("directive-value", at,
              fmt::format("{} ends the names of {} already", e.suffix,
                          other ? "another element's matrices" : "the matrices of all others"));
    };
    for (std::size_t k = 0; k < c.force_editable.size(); ++k) check(c.options.force_editable[k], c.force_editable[k]);
    for (std::size_t k = 0; k < c.flexbody_editable.size(); ++k)
      check(c.options.flexbody_editable[k], c.flexbody_editable[k]);
  }

  // --- debug and ignore_errors ---
  void echo(const ExportOptions& of_job) {
    const SourceText& source = *made_.value.source;
    for (const WrittenItem& item : items_) {
      std::string text(name_of(item));
      if (item.directive) text += fmt::format(" = {}", item.written.value.text());
      for (const WrittenValue& w : item.fields) text += fmt::format(" {} = {}", w.key.text(), w.value.text());
      const unsigned hold = holding(ignored_bits(item), box_, of_job);
      const std::string_view help = item.directive ? item.directive->help
                                    : item.block   ? item.block->help
                                                   : "lines of case control";
      const std::string fallback = item.directive ? fallback_text(*item.directive) : "";
      made_.value.echo.push_back(fmt::format("{}:{}: {}: {}{}{}", source.name(),
                                             source.place(item.written.key.offset).line, text, help,
                                             fallback.empty() ? "" : fmt::format(" (default {})", fallback),
                                             hold ? fmt::format(", without effect with {}", ignored_text(hold)) : ""));
    }
  }
  void forgive() {
    Diagnostics all;
    for (const Diagnostic& d : made_.diagnostics.items())
      all.warning(d.code, d.at, d.severity == Severity::error ? d.message + "; it is left out" : d.message, d.hint)
          .notes = d.notes;
    made_.diagnostics = std::move(all);
  }

  Box box_;
  Parsed<Configuration> made_;
  std::vector<WrittenItem> items_;
};

class References {
 public:
  References(const Configuration& c, const Model& model, Diagnostics& diagnostics)
      : c_(c), model_(model), diagnostics_(diagnostics) {}

  void check() {
    const ExportOptions& o = c_.options;
    for (std::size_t k = 0; k < o.export_markers_by_id.size(); ++k) {
      const IdRange& range = o.export_markers_by_id[k];
      if (range.first == range.last) take(marker_of_id(model_, range.first), c_.export_markers_by_id[k]);
      for (const Marker& m : model_.markers) {
        if (range.first < range.last && m.floating && m.label->id >= range.first && m.label->id <= range.last)
          floating(m, c_.export_markers_by_id[k]);
      }
    }
    for (std::size_t k = 0; k < o.export_markers_by_name.size(); ++k)
      take(marker_of_name(model_, o.export_markers_by_name[k]), c_.export_markers_by_name[k]);
    for (const OutputChannel& channel : o.displacement_output_channel)
      take(marker_of_channel(model_, channel), c_.output_channels.at(channel.name));
    for (const InputChannel& channel : o.force_input_channel)
      take(marker_of_channel(model_, channel), c_.input_channels.at(channel.name));
    for (std::size_t k = 0; k < o.force_editable.size(); ++k) element(o.force_editable[k], c_.force_editable[k]);
    for (std::size_t k = 0; k < o.flexbody_editable.size(); ++k) {
      Editable body = o.flexbody_editable[k];
      body.type = "flex_body";
      element(body, c_.flexbody_editable[k]);
    }
  }

 private:
  void floating(const Marker& m, const Span& at) {
    diagnostics_.error("floating-marker", at,
                       fmt::format("{} is floating and cannot be exported", m.label->full_text()));
  }
  void refuse(const NameProblem& p, const Span& at) { diagnostics_.error(p.code, at, p.message, p.hint); }
  void take(const Named<MarkerId>& found, const Span& at) {
    if (!found)
      refuse(found.error(), at);
    else if (model_.marker(*found).floating)
      floating(model_.marker(*found), at);
  }
  void element(const Editable& e, const Span& at) {
    std::string statement = e.type;
    for (char& c : statement) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    if (!e.id) {
      if (const auto found = element_of_name(model_, statement, e.name); !found) refuse(found.error(), at);
    } else if (!model_.find(statement, *e.id) && !model_.find_body(statement, *e.id)) {
      refuse({"unknown-element", fmt::format("{}/{} does not exist", statement, *e.id), {}}, at);
    }
  }

  const Configuration& c_;
  const Model& model_;
  Diagnostics& diagnostics_;
};

}  // namespace

Parsed<Configuration> read_configuration(SourceRef source, Box box) { return Reader(std::move(source), box).read(); }

void check_references(const Configuration& configuration, const Model& model, Diagnostics& diagnostics) {
  if (!configuration.options.ignore_errors) References(configuration, model, diagnostics).check();
}

}  // namespace dynalin::nastran
