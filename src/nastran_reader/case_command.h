// Case control as commands: each with everything that belongs to it, the lines after one that ends with a comma.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "nastran_reader/deck_lines.h"

namespace dynalin::nastran_reader {

// A stretch of one line, without blanks around.
struct Piece {
  std::string_view text;
  Span at;
};
// `part` is of the text of the line.
Piece piece(const Line&, std::string_view part);

// Between commas outside of parentheses.
std::vector<std::string_view> split(std::string_view);

// What stands between the name of a command and its values.
std::string_view without_equals(std::string_view);

// K2PP, B2PP, ...: a parenthesis behind it begins a factor.
bool is_matrix_command(std::string_view name);

struct Command {
  std::string name;  // SPC, DISP
  Span at;
  // Of a title the whole text; of a SET its number first.
  std::vector<Piece> values;
};

class CommandReader {
 public:
  CommandReader(std::span<const Line> lines, Diagnostics& diagnostics) : lines_(lines), diagnostics_(diagnostics) {}

  // Lines that are no command are passed over with an error. Nothing after the last.
  std::optional<Command> next();

 private:
  std::optional<Command> begun_in(const Line&);
  static void take_values(const Line&, std::string_view text, Command& to);

  std::span<const Line> lines_;  // those to come
  Diagnostics& diagnostics_;
};

}  // namespace dynalin::nastran_reader
