// Directives and data blocks of frequency response.
#include <fmt/format.h>

#include <algorithm>

#include "nastran/directive_values.h"
#include "nastran/directives.h"

namespace dynalin::nastran {

namespace {

constexpr std::array<Field, 3> actuator_fields = {{
    {.name = "name", .values = "string", .help = "by which channels refer to it", .required = true},
    {.name = "magnitude", .values = "real", .fallback = "1", .help = "of the force or torque"},
    {.name = "phase_angle", .values = "angle", .fallback = "0", .help = "lead in radians, or in degrees with a D"},
}};
constexpr std::array<Field, 4> output_fields = {{
    {.name = "name", .values = "string", .help = "by which subcases refer to it", .required = true},
    {.name = "marker_id", .values = "integer", .help = "the marker; this or marker_name is required"},
    {.name = "marker_name", .values = "string", .help = "the marker", .also = "marker_by_name"},
    {.name = "mode",
     .values = "local | global",
     .fallback = "local",
     .help = "axes of the displacements: of the marker, or global"},
}};
constexpr std::array<Field, 6> input_fields = {{
    {.name = "name", .values = "string", .help = "by which subcases refer to it", .required = true},
    {.name = "marker_id", .values = "integer", .help = "the marker; this or marker_name is required"},
    {.name = "marker_name", .values = "string", .help = "the marker", .also = "marker_by_name"},
    {.name = "dof",
     .values = "x | y | z | rx | ry | rz",
     .fallback = "x",
     .help = "along or about which axis; upper case as well"},
    {.name = "actuator_name", .values = "string", .help = "an actuator_swept_sine", .required = true},
    {.name = "mode",
     .values = "local | global",
     .fallback = "local",
     .help = "axes of the force: of the marker, or global"},
}};
constexpr std::array<Field, 3> subcase_fields = {{
    {.name = "number", .values = "integer", .help = "of the SUBCASE", .required = true},
    {.name = "input_channel_names", .values = "names", .help = "channels that act at once", .required = true},
    {.name = "output_channel_names", .values = "names", .help = "channels that are printed", .required = true},
}};

constexpr std::array<std::string_view, 2> axes_words = {"local", "global"};
constexpr std::array<std::string_view, 6> dof_words = {"x", "y", "z", "rx", "ry", "rz"};
constexpr std::array<std::string_view, 6> upper_dof_words = {"X", "Y", "Z", "RX", "RY", "RZ"};

// Reads the fields of one block one after the other.
class Fields {
 public:
  Fields(const Span& block, const std::vector<WrittenValue>& written, Diagnostics& diagnostics)
      : block_(block), written_(written), diagnostics_(diagnostics), before_(diagnostics.error_count()) {}

  bool sound() const { return diagnostics_.error_count() == before_; }
  ValuePlace place(std::string_view name) const { return {name, diagnostics_}; }
  // Where the field is, or nothing.
  const Span* find(std::string_view name, std::string_view also = {}) const {
    for (const WrittenValue& w : written_) {
      if (w.key.text() == name || (!also.empty() && w.key.text() == also)) return &w.value;
    }
    return nullptr;
  }
  void text(std::string_view name, std::string& to, std::string_view also = {}) const {
    const Span* at = find(name, also);
    if (!at) return;
    to = read_string(*at);
    if (to.empty()) place(name).error(block_, fmt::format("{} of {} is empty", name, block_.text()));
  }
  template <class T, class Read>
  void value(std::string_view name, T& to, const Read& read) const {
    if (const Span* at = find(name)) {
      if (auto v = read(*at, place(name))) to = std::move(*v);
    }
  }
  void positive(std::string_view name, const std::optional<std::int64_t>& v) const {
    if (v && *v < 1) place(name).error(*find(name), fmt::format("{} is at least 1, not {}", name, *v));
  }
  void marker(ChannelMarker& to) const {
    value("marker_id", to.marker_id, read_integer);
    positive("marker_id", to.marker_id);
    text("marker_name", to.marker_name, "marker_by_name");
    if (!find("marker_id") && !find("marker_name", "marker_by_name"))
      diagnostics_.error("missing-directive", block_, fmt::format("{} needs marker_id or marker_name", block_.text()));
    if (const Span* at = find("mode")) {
      if (const auto k = read_choice(*at, axes_words, place("mode"))) to.mode = *k == 0 ? Axes::local : Axes::global;
    }
  }

 private:
  const Span& block_;
  const std::vector<WrittenValue>& written_;
  Diagnostics& diagnostics_;
  std::size_t before_;
};

// One of the same name takes the place of an earlier one.
template <class T, class Key>
void put(std::vector<T>& list, T item, Key T::*key) {
  const auto same = std::ranges::find_if(list, [&](const T& other) { return other.*key == item.*key; });
  if (same == list.end())
    list.push_back(std::move(item));
  else
    *same = std::move(item);
}

void store_actuator(const Span& block, const std::vector<WrittenValue>& written, ExportOptions& to, Diagnostics& d) {
  const Fields fields(block, written, d);
  Actuator a;
  fields.text("name", a.name);
  fields.value("magnitude", a.magnitude, read_real);
  fields.value("phase_angle", a.phase_angle, read_angle);
  if (fields.sound()) put(to.actuator_swept_sine, std::move(a), &Actuator::name);
}

void store_output(const Span& block, const std::vector<WrittenValue>& written, ExportOptions& to, Diagnostics& d) {
  const Fields fields(block, written, d);
  OutputChannel c;
  fields.text("name", c.name);
  fields.marker(c);
  if (fields.sound()) put(to.displacement_output_channel, std::move(c), &OutputChannel::name);
}

void store_input(const Span& block, const std::vector<WrittenValue>& written, ExportOptions& to, Diagnostics& d) {
  const Fields fields(block, written, d);
  InputChannel c;
  fields.text("name", c.name);
  fields.marker(c);
  if (const Span* at = fields.find("dof")) {
    const auto upper = std::ranges::find(upper_dof_words, at->text());
    const auto k = upper != upper_dof_words.end() ? static_cast<std::size_t>(upper - upper_dof_words.begin())
                                                  : read_choice(*at, dof_words, fields.place("dof"));
    if (k) c.dof = static_cast<int>(*k) + 1;
  }
  fields.text("actuator_name", c.actuator_name);
  if (fields.sound()) put(to.force_input_channel, std::move(c), &InputChannel::name);
}

void store_subcase(const Span& block, const std::vector<WrittenValue>& written, ExportOptions& to, Diagnostics& d) {
  const Fields fields(block, written, d);
  Subcase s;
  fields.value("number", s.number, read_integer);
  if (fields.sound()) fields.positive("number", s.number);
  fields.value("input_channel_names", s.input_channel_names, read_names);
  fields.value("output_channel_names", s.output_channel_names, read_names);
  if (fields.sound()) put(to.frequency_response_subcase, std::move(s), &Subcase::number);
}

constexpr Directive number(std::string_view name, std::int64_t ExportOptions::*slot, std::string_view help) {
  return {.name = name, .slot = slot, .help = help, .ignored = in_sol_107, .minimum = 1};
}

}  // namespace

std::span<const Directive> response_directives() {
  using O = ExportOptions;
  constexpr std::string_view step = "from one of them to the next";
  static constexpr std::array<Directive, 17> list = {{
      {.name = "begin_frequency",
       .slot = &O::begin_frequency,
       .help = "the first frequency [cycles per unit time]",
       .ignored = in_sol_107,
       .required_in_108 = true,
       .minimum = 0},
      {.name = "end_frequency",
       .slot = &O::end_frequency,
       .help = "the last one",
       .ignored = in_sol_107,
       .required_in_108 = true,
       .minimum = 0},
      {.name = "steps_frequency",
       .slot = &O::steps_frequency,
       .help = "steps between them",
       .ignored = in_sol_107,
       .required_in_108 = true,
       .minimum = 1},
      {.name = "spacing_frequency",
       .slot = &O::spacing_frequency,
       .help = "equal steps (FREQ1) or equal ratios (FREQ2)",
       .ignored = in_sol_107},
      number("dload_card_number", &O::dload_card_number, "the first DLOAD"),
      number("dload_card_number_increment", &O::dload_card_number_increment, step),
      number("rload1_card_number", &O::rload1_card_number, "the first RLOAD1"),
      number("rload1_card_number_increment", &O::rload1_card_number_increment, step),
      number("force_card_number", &O::force_card_number, "the first FORCE or MOMENT"),
      number("force_card_number_increment", &O::force_card_number_increment, step),
      number("dphase_card_number", &O::dphase_card_number, "the first DPHASE"),
      number("dphase_card_number_increment", &O::dphase_card_number_increment, step),
      number("tabled1_card_number", &O::tabled1_card_number, "the first TABLED1"),
      number("tabled1_card_number_increment", &O::tabled1_card_number_increment, step),
      number("frequency_card_number", &O::frequency_card_number, "the FREQ1 or FREQ2"),
      number("set_card_number", &O::set_card_number, "the first SET of grids that are printed"),
      number("set_card_number_increment", &O::set_card_number_increment, step),
  }};
  return list;
}

std::span<const Block> response_blocks() {
  static constexpr std::array<Block, 4> list = {{
      {.name = "actuator_swept_sine",
       .help = "a force of this magnitude and phase at every frequency",
       .fields = actuator_fields,
       .store = store_actuator},
      {.name = "force_input_channel", .help = "where an actuator acts", .fields = input_fields, .store = store_input},
      {.name = "displacement_output_channel",
       .help = "where displacements are read",
       .fields = output_fields,
       .store = store_output},
      {.name = "frequency_response_subcase",
       .help = "inputs that act together, and outputs that are read",
       .fields = subcase_fields,
       .store = store_subcase},
  }};
  return list;
}

}  // namespace dynalin::nastran
