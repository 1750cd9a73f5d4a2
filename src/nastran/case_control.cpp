#include "nastran/case_control.h"

#include <fmt/format.h>

#include <algorithm>

namespace dynalin::nastran {

namespace {

constexpr std::size_t columns = 72;

// "SET 1 = A, B", with a comma at the end of each line that goes on.
std::string set_text(std::int64_t number, const std::vector<std::string>& items) {
  std::string text = fmt::format("SET {} = ", number), line = text;
  for (std::size_t k = 0; k < items.size(); ++k) {
    const std::string item = items[k] + (k + 1 < items.size() ? "," : "");
    if (line.size() + 1 + item.size() > columns) {
      text += "\n   ";
      line = "   ";
    }
    if (k > 0) text += ' ', line += ' ';
    text += item, line += item;
  }
  return text + "\n";
}

std::string displacements(const ExportOptions& options, std::string_view of) {
  static constexpr std::array<std::string_view, 3> where = {"PLOT", "PUNCH", "PLOT,PUNCH"};
  return fmt::format("DISP({}) = {}\n", where[static_cast<std::size_t>(options.disp_plot_punch)], of);
}

// A line of text without what would end it.
std::string titled(std::string_view name, std::string_view text) {
  std::string line = fmt::format("{} = {}", name, text);
  std::ranges::replace_if(
      line, [](char c) { return c == '$' || c == '\n' || c == '\r'; }, ' ');
  if (line.size() > columns) line.resize(columns);
  while (line.ends_with(' ')) line.pop_back();
  return line + "\n";
}

}  // namespace

std::string subtitle(const Deck& deck, const ExportOptions& options) {
  if (options.subtitle) return *options.subtitle;
  std::string time = fmt::format("{}", deck.time);
  if (time.find_first_not_of("-0123456789") == std::string::npos) time += ".0";
  return "Simulation time " + time;
}

std::vector<MatrixSet> matrix_sets(const std::vector<WrittenMatrix>& matrices, const ExportOptions& options, Ids& ids) {
  std::vector<MatrixSet> sets;
  for (const MatrixKind kind : {MatrixKind::K, MatrixKind::B, MatrixKind::M}) {
    std::vector<std::string> names;
    for (const WrittenMatrix& m : matrices) {
      if (m.kind == kind) names.push_back(m.name);
    }
    if (!names.empty()) sets.push_back({kind, ids.take(IdSpace::set, options.initial_dmig_set), std::move(names)});
  }
  return sets;
}

std::string control_text(const Deck& deck, const ExportOptions& options, const std::vector<MatrixSet>& matrices,
                         const std::vector<ResponseCase>& cases) {
  const bool response = options.solution_number == 108;
  std::string text = fmt::format("SOL {}\nCEND\n", options.solution_number);
  text += titled("TITLE", options.title) + titled("SUBTITLE", subtitle(deck, options)) + "ECHO = NONE\n";
  // Without these lines Nastran would solve a model without joints, and say nothing.
  if (!deck.fixed_points.empty()) text += fmt::format("SPC = {}\n", options.spc_set);
  if (!deck.relations.empty()) text += fmt::format("MPC = {}\n", options.mpc_set);
  if (options.load) text += fmt::format("LOAD = {}\n", *options.load);
  if (!response) text += fmt::format("CMETHOD = {}\n", options.cmethod_number);
  if (response && options.begin_frequency && options.end_frequency && options.steps_frequency)
    text += fmt::format("FREQUENCY = {}\n", options.frequency_card_number);
  for (const MatrixSet& set : matrices) text += set_text(set.number, set.names);
  for (const ResponseCase& c : cases) {
    std::vector<std::string> grids;
    for (const std::int64_t g : c.grids) grids.push_back(std::to_string(g));
    text += set_text(c.set, grids);
  }
  for (const MatrixSet& set : matrices)
    text += fmt::format("{}2PP = {}\n", "KBM"[static_cast<std::size_t>(set.kind)], set.number);
  if (!response) text += displacements(options, "ALL");
  for (const std::string& line : options.verbatim) text += line + "\n";
  for (const ResponseCase& c : cases) {
    text += fmt::format("SUBCASE {}\n", c.number) + titled("  LABEL", c.label);
    text += fmt::format("  DLOAD = {}\n  ", c.dload) + displacements(options, std::to_string(c.set));
  }
  return text + "BEGIN BULK\n";
}

void write_control_cards(const Deck& deck, const ExportOptions& options, CardFile& file) {
  const auto parameter = [&](std::string_view name, std::string_view value) {
    std::string card = parameter_card(name, value);
    card.pop_back();
    file.line(card);
  };
  parameter("POST", std::to_string(options.param_post));
  if (deck.open) parameter("AUTOMSET", options.automset == Automset::lusol ? "LUSOL" : "YES");
  // Freedoms that matrices alone hold look free to Nastran, which would fix them.
  parameter("AUTOSPC", "NO");
  if (options.solution_number != 107) return;
  const std::int64_t values = options.number_of_eigenvalues.value_or(static_cast<std::int64_t>(deck.states));
  const bool lanczos = options.eigc_method == EigenMethod::clan;
  Card eigc = file.card("EIGC");
  eigc.integer(options.cmethod_number).word(lanczos ? "CLAN" : "HESS").word("MAX");
  if (!lanczos || options.clan_region.empty()) {
    eigc.blank(3).integer(values);
  } else {
    for (const ClanRegion& region : options.clan_region) {  // each has a number of its own
      eigc.row();
      for (const double v : region.values) eigc.real(v);
      eigc.blank().integer(region.count);
    }
  }
  file.heading("eigenvalues");
  file.add(eigc, {});
}

}  // namespace dynalin::nastran
