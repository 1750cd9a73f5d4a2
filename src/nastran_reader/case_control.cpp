#include "nastran_reader/case_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "nastran_reader/case_command.h"
#include "nastran_reader/field.h"
#include "nastran_reader/matrix_selection.h"

namespace dynalin::nastran_reader {

namespace {

bool begins(std::string_view text, std::string_view word) { return text.starts_with(word); }

class ControlReader {
 public:
  ControlReader(CaseControl& control, Diagnostics& diagnostics)
      : c_(control), diagnostics_(diagnostics), matrices_(diagnostics) {}

  void executive(const Line& line) {
    const std::string text = upper_trimmed(line.text);
    if (!begins(text, "SOL") || (text.size() > 3 && std::isalpha(static_cast<unsigned char>(text[3])))) return;
    const std::size_t skip = line.text.find_first_of("lL") + 1;
    const std::string_view rest = without_equals(line.text.substr(skip));
    const Piece value = piece(line, rest.substr(0, rest.find(',')));
    static const std::map<std::string, int> names = {{"SEDCEIG", 107},  {"SEDFREQ", 108}, {"SEMODES", 103},
                                                     {"SESTATIC", 101}, {"SEDTRAN", 109}, {"SEMCEIG", 110},
                                                     {"SEMFREQ", 111},  {"SEMTRAN", 112}};
    const Field f = read_field(value.text, value.at);
    const auto named = names.find(f.text);
    if (f.form == Field::Form::integer && f.integer > 0) {
      c_.solution = f.integer;
    } else if (named != names.end()) {
      c_.solution = named->second;
    } else {
      diagnostics_.error("case-command", value.at, "SOL is followed by no solution that is known", "SOL 107");
    }
    c_.solution_at = value.at;
  }

  void case_lines(std::span<const Line> lines) {
    CommandReader commands(lines, diagnostics_);
    while (const auto command = commands.next()) run(*command);
    c_.matrices = matrices_.uses(c_.sets);
    if (c_.subcases.empty()) c_.subcases.push_back(c_.above);
  }

 private:
  Subcase& here() { return c_.subcases.empty() ? c_.above : c_.subcases.back(); }

  std::optional<Selected> number(const Command& command) {
    const Piece value = command.values.empty() ? Piece{{}, command.at} : command.values[0];
    const Field f = read_field(value.text, value.at);
    if (command.values.size() == 1 && f.form == Field::Form::integer && f.integer > 0) return Selected{f.integer, f.at};
    diagnostics_.error("case-command", value.at, fmt::format("{} takes one positive whole number", command.name));
    return std::nullopt;
  }

  // Above the subcases or the same in all of them.
  void select(std::optional<Selected>& slot, const Command& command) {
    const auto selected = number(command);
    if (!selected) return;
    if (slot && slot->id != selected->id && !c_.subcases.empty()) {
      diagnostics_
          .error("case-command", selected->at,
                 fmt::format("{} changes from {} to {} between subcases", command.name, slot->id, selected->id),
                 "a direct solution keeps its constraints and matrices: write it above the subcases")
          .notes.push_back({slot->at, "selected here before"});
      return;
    }
    slot = selected;
  }

  void run(const Command& command) {
    const std::string& name = command.name;
    if (name == "SPC") return select(c_.spc, command);
    if (name == "MPC") return select(c_.mpc, command);
    if (begins(name, "CMET")) return select(c_.cmethod, command);
    if (begins(name, "FREQ")) return select(c_.frequency, command);
    if (name == "DLOAD") {
      here().dload = number(command);
    } else if (begins(name, "SUBC")) {
      const auto id = number(command);
      if (!id) return;
      Subcase next = c_.above;
      next.id = id->id, next.at = id->at;
      for (const Subcase& s : c_.subcases) {
        if (s.id == next.id)
          diagnostics_.error("duplicate-card-id", id->at, fmt::format("SUBCASE {} stands twice", id->id))
              .notes.push_back({s.at, "the first one"});
      }
      c_.subcases.push_back(std::move(next));
    } else if (begins(name, "DISP") || name == "VECTOR" || begins(name, "PRES")) {
      request(command);
    } else if (begins(name, "LABE")) {
      if (!command.values.empty()) here().label = std::string(command.values[0].text);
    } else if (begins(name, "TITL") || begins(name, "SUBT")) {
      return;
    } else if (name == "SET") {
      set(command);
    } else if (is_matrix_command(name)) {
      matrices_.take(command, !c_.subcases.empty());
    } else if (begins(name, "AUTOS")) {
      const std::string value = command.values.empty() ? "YES" : upper_trimmed(command.values[0].text);
      c_.autospc = value != "NO";
    } else if (name == "PARAM") {
      if (command.values.size() >= 2)
        c_.parameters[upper_trimmed(command.values[0].text)] = {upper_trimmed(command.values[1].text),
                                                                command.values[1].at};
    } else {
      c_.passed_over.emplace_back(name, command.at);
    }
  }

  void request(const Command& command) {
    OutputRequest r;
    const std::string value = command.values.empty() ? "" : upper_trimmed(command.values[0].text);
    if (value == "ALL") {
      r.kind = OutputRequest::Kind::all;
    } else if (value == "NONE") {
      r.kind = OutputRequest::Kind::none;
    } else if (const auto id = number(command)) {
      r.kind = OutputRequest::Kind::set;
      r.set = *id;
    } else {
      return;
    }
    here().displacement = r;
  }

  void set(const Command& command) {
    const Piece& first = command.values[0];
    const Field id = read_field(first.text, first.at);
    if (id.form != Field::Form::integer || id.integer <= 0 || command.values.size() < 2) {
      diagnostics_.error("case-command", first.at, "SET has a number, = and members", "SET 1 = KVVV, KZZZ");
      return;
    }
    NamedSet members;
    for (std::size_t k = 1; k < command.values.size(); ++k) member(command.values[k], members);
    c_.sets[id.integer] = std::move(members);
  }

  // A number, a range or a name.
  void member(const Piece& value, NamedSet& members) {
    const std::string text = upper_trimmed(value.text);
    if (text == "ALL") {
      members.all = true;
      return;
    }
    const std::size_t thru = text.find(" THRU ");
    if (thru != std::string::npos) {
      const std::string_view v = value.text;
      const Field a = read_field(v.substr(0, thru), value.at), b = read_field(v.substr(thru + 6), value.at);
      if (a.form == Field::Form::integer && b.form == Field::Form::integer && a.integer <= b.integer) {
        members.ranges.emplace_back(a.integer, b.integer);
      } else {
        diagnostics_.error("case-command", value.at, fmt::format("{} is no range", value.text), "1 THRU 9");
      }
      return;
    }
    const Field f = read_field(text, value.at);
    if (f.form == Field::Form::integer) {
      members.ranges.emplace_back(f.integer, f.integer);
    } else {
      members.names.emplace_back(text, value.at);
    }
  }

  CaseControl& c_;
  Diagnostics& diagnostics_;
  MatrixSelection matrices_;
};

bool is_begin(const Line& line) {
  const std::string text = upper_trimmed(line.text);
  if (!begins(text, "BEGIN")) return false;
  return text.size() == 5 || text.find("BULK") != std::string::npos;
}

}  // namespace

bool NamedSet::contains(int id) const {
  if (all) return true;
  return std::any_of(ranges.begin(), ranges.end(), [&](const auto& r) { return r.first <= id && id <= r.second; });
}

Sections read_control(std::span<const Line> lines, Diagnostics& diagnostics) {
  Sections out;
  const auto begin = std::find_if(lines.begin(), lines.end(), is_begin);
  const auto cend =
      std::find_if(lines.begin(), begin, [](const Line& l) { return begins(upper_trimmed(l.text), "CEND"); });
  ControlReader reader(out.control, diagnostics);
  if (begin == lines.end() && cend == lines.end()) {
    // Bulk data alone, as in a file that others include.
    if (!lines.empty())
      diagnostics.warning("deck-section", lines[0].span(),
                          "the file has no CEND and no BEGIN BULK: all of it is taken for bulk data");
    reader.case_lines({});
    return out;
  }
  if (begin == lines.end()) {
    diagnostics.error("deck-section", cend->span(), "no BEGIN BULK follows this CEND");
    out.first_bulk = lines.size();
    return out;
  }
  auto first_case = lines.begin();
  if (cend != begin) {
    for (auto it = lines.begin(); it != cend; ++it) reader.executive(*it);
    first_case = cend + 1;
  } else {
    diagnostics.warning("deck-section", begin->span(), "no CEND ends the executive control above this line");
    while (first_case != begin && begins(upper_trimmed(first_case->text), "SOL")) reader.executive(*first_case++);
  }
  reader.case_lines(lines.subspan(static_cast<std::size_t>(first_case - lines.begin()),
                                  static_cast<std::size_t>(begin - first_case)));
  out.first_bulk = static_cast<std::size_t>(begin - lines.begin()) + 1;
  return out;
}

}  // namespace dynalin::nastran_reader
