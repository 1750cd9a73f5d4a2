#include "nastran_reader/case_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "nastran_reader/field.h"

namespace dynalin::nastran_reader {

namespace {

bool begins(std::string_view text, std::string_view word) { return text.starts_with(word); }

// A stretch of one line.
struct Piece {
  std::string_view text;
  Span at;
};

Piece piece(const Line& line, std::string_view part) {
  part = trimmed(part);
  if (part.empty()) return {part, line.span(line.text.size(), 0)};
  return {part, line.span(static_cast<std::size_t>(part.data() - line.text.data()), part.size())};
}

// Between commas outside of parentheses.
std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> out;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '(') ++depth;
    if (i < text.size() && text[i] == ')') --depth;
    if (i == text.size() || (text[i] == ',' && depth <= 0)) {
      out.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  return out;
}

bool is_text_command(std::string_view name) {
  return begins(name, "TITL") || begins(name, "SUBT") || begins(name, "LABE");
}

bool is_matrix_command(std::string_view name) {
  for (const auto word : {"K2PP", "B2PP", "M2PP", "K2GG", "B2GG", "M2GG"}) {
    if (name == word) return true;
  }
  return false;
}

// A command with everything that belongs to it: the lines after one that ends with a comma.
struct Command {
  std::string name;     // SPC, DISP
  std::string options;  // in parentheses behind the name
  Span at;
  std::vector<Piece> values;
};

class ControlReader {
 public:
  ControlReader(CaseControl& control, Diagnostics& diagnostics) : c_(control), diagnostics_(diagnostics) {}

  void executive(const Line& line) {
    const std::string text = upper_trimmed(line.text);
    if (!begins(text, "SOL") || (text.size() > 3 && std::isalpha(static_cast<unsigned char>(text[3])))) return;
    const std::size_t skip = line.text.find_first_of("lL") + 1;
    std::string_view rest = line.text.substr(skip);
    while (!rest.empty() && (rest[0] == ' ' || rest[0] == '=' || rest[0] == '\t')) rest.remove_prefix(1);
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
    for (std::size_t i = 0; i < lines.size(); ++i) {
      Command command;
      if (!head(lines[i], command)) continue;
      if (is_text_command(command.name)) {
        if (begins(command.name, "LABE") && !command.values.empty()) here().label = std::string(command.values[0].text);
        continue;
      }
      bool open = upper_trimmed(lines[i].text).ends_with(',');
      while (open && i + 1 < lines.size()) {
        ++i;
        for (const std::string_view part : split(lines[i].text)) {
          const Piece p = piece(lines[i], part);
          if (!p.text.empty()) command.values.push_back(p);
        }
        open = upper_trimmed(lines[i].text).ends_with(',');
      }
      run(command);
    }
    finish();
  }

 private:
  // Name, options and the values of the first line.
  bool head(const Line& line, Command& out) {
    const std::string_view text = trimmed(line.text);
    std::size_t i = 0;
    while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_')) ++i;
    if (i == 0) {
      diagnostics_.error("case-command", line.span(), "this line of case control begins with no command");
      return false;
    }
    out.name = upper_trimmed(text.substr(0, i));
    out.at = piece(line, text.substr(0, i)).at;
    while (i < text.size() && text[i] == ' ') ++i;
    if (i < text.size() && text[i] == '(' && !is_matrix_command(out.name)) {
      const std::size_t close = text.find(')', i);
      if (close == std::string_view::npos) {
        diagnostics_.error("case-command", piece(line, text.substr(i)).at, "the parenthesis is not closed");
        return false;
      }
      out.options = upper_trimmed(text.substr(i + 1, close - i - 1));
      i = close + 1;
    }
    std::string_view rest = text.substr(i);
    while (!rest.empty() && (rest[0] == ' ' || rest[0] == '=' || rest[0] == '\t')) rest.remove_prefix(1);
    if (out.name == "PARAM" || out.name == "SET") {
      while (!rest.empty() && (rest[0] == ',' || rest[0] == ' ')) rest.remove_prefix(1);
    }
    if (out.name == "SET") {
      // SET n = …: the number is the first value.
      const std::size_t equals = rest.find('=');
      const std::string_view number = rest.substr(0, equals);
      out.values.push_back(piece(line, number));
      rest = equals == std::string_view::npos ? std::string_view() : rest.substr(equals + 1);
    }
    if (is_text_command(out.name)) {
      out.values.push_back(piece(line, rest));
      return true;
    }
    for (const std::string_view part : split(rest)) {
      const Piece p = piece(line, part);
      if (!p.text.empty()) out.values.push_back(p);
    }
    return true;
  }

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
    if (begins(name, "LOADS")) return select(c_.loadset, command);
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
    } else if (name == "SET") {
      set(command);
    } else if (is_matrix_command(name)) {
      matrices(command);
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

  // NAME, 2.0*NAME, (1.0,0.0)*NAME
  std::optional<MatrixUse> use(std::string_view text, const Span& at, bool& with_factor) {
    MatrixUse u;
    u.at = at;
    const std::size_t star = text.find('*');
    std::string_view name = text;
    with_factor = star != std::string_view::npos;
    if (with_factor) {
      std::string_view factor = trimmed(text.substr(0, star));
      name = text.substr(star + 1);
      if (factor.starts_with('(') && factor.ends_with(')')) {
        const auto parts = split(factor.substr(1, factor.size() - 2));
        const Field re = read_field(parts[0], at), im = read_field(parts.size() > 1 ? parts[1] : "", at);
        if (parts.size() != 2 || re.form != Field::Form::real || im.form != Field::Form::real) {
          diagnostics_.error("case-command", at, fmt::format("{} is no complex factor", factor), "(1.0,0.0)*NAME");
          return std::nullopt;
        }
        if (im.real != 0) {
          diagnostics_.error("unassembled-card", at, "complex matrices are not solved here");
          return std::nullopt;
        }
        u.factor = re.real;
      } else {
        const Field f = read_field(factor, at);
        if (f.form != Field::Form::real && f.form != Field::Form::integer) {
          diagnostics_.error("case-command", at, fmt::format("{} is no factor of a matrix", factor), "2.0*NAME");
          return std::nullopt;
        }
        u.factor = f.real;
      }
    }
    const Field f = read_field(name, at);
    if (f.form != Field::Form::word) {
      diagnostics_.error("case-command", at, fmt::format("{} is no name of a matrix", name));
      return std::nullopt;
    }
    u.name = f.text;
    return u;
  }

  void matrices(const Command& command) {
    if (command.values.empty()) {
      diagnostics_.error("case-command", command.at, fmt::format("{} names no matrix", command.name));
      return;
    }
    if (const auto before = raw_.find(command.name); before != raw_.end() && !c_.subcases.empty()) {
      const auto same = [&] {
        if (before->second.size() != command.values.size()) return false;
        for (std::size_t k = 0; k < command.values.size(); ++k) {
          if (upper_trimmed(before->second[k].text) != upper_trimmed(command.values[k].text)) return false;
        }
        return true;
      };
      if (!same())
        diagnostics_.error("case-command", command.at, fmt::format("{} changes between subcases", command.name),
                           "a direct solution keeps its constraints and matrices: write it above the subcases");
      return;
    }
    raw_[command.name] = command.values;
  }

  // Sets may stand behind the commands that name them.
  void finish() {
    for (const auto& [name, values] : raw_) {
      std::vector<MatrixUse>& uses = c_.matrices[name];
      std::size_t factors = 0;
      for (const Piece& value : values) {
        const Field f = read_field(value.text, value.at);
        if (f.form == Field::Form::integer) {
          const auto found = c_.sets.find(f.integer);
          if (found == c_.sets.end() || found->second.names.empty()) {
            diagnostics_.error("undefined-card-id", value.at,
                               fmt::format("{} names SET {}, which is no list of matrices", name, f.integer));
            continue;
          }
          for (const auto& [text, at] : found->second.names) {
            bool with_factor = false;
            if (auto u = use(text, at, with_factor)) uses.push_back(std::move(*u));
          }
          continue;
        }
        bool with_factor = false;
        if (auto u = use(value.text, value.at, with_factor)) uses.push_back(std::move(*u));
        factors += with_factor;
      }
      if (factors > 0 && factors < values.size())
        diagnostics_.error("case-command", values[0].at,
                           fmt::format("some matrices of {} have a factor and some have none", name),
                           "write 1.0* before those that have none");
    }
    if (c_.subcases.empty()) c_.subcases.push_back(c_.above);
  }

  CaseControl& c_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::vector<Piece>> raw_;
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
