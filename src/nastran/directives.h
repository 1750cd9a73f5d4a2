// The directives and data blocks of a configuration file (LINEAR command, 5.3.4): one table, by which files are read
// and checked, their meaning is echoed, and the manual is printed.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "nastran/export_options.h"

namespace dynalin::nastran {

enum class Box : std::uint8_t { open, closed };

// When a directive has no effect, as bits.
enum Ignored : unsigned {
  never = 0,
  in_closed_box = 1,
  in_sol_107 = 2,
  in_sol_108 = 4,
  without_cbush = 8,
  with_wireframe = 16,
  outside_style_A = 32,
  in_style_B = 64,
  outside_style_C = 128,
  with_adams_ids = 256,
  with_hess = 512,
  without_adams_ids = 1024,
};
// "SOL 107, CLOSEDBOX"
std::string ignored_text(unsigned ignored);
// Of these reasons those that hold.
unsigned holding(unsigned ignored, Box, const ExportOptions&);

// Elements that one directive names, one after the other.
struct Editables {
  std::vector<Editable> ExportOptions::*list;
  bool with_type, by_name;
};

// Where the value goes, and with it what it looks like.
using Slot =
    std::variant<bool ExportOptions::*, std::int64_t ExportOptions::*, std::optional<std::int64_t> ExportOptions::*,
                 double ExportOptions::*, std::optional<double> ExportOptions::*, std::string ExportOptions::*,
                 std::optional<std::string> ExportOptions::*, std::vector<std::string> ExportOptions::*,
                 std::vector<IdRange> ExportOptions::*, std::vector<ClanRegion> ExportOptions::*, Editables,
                 Automset ExportOptions::*, EigenMethod ExportOptions::*, Output ExportOptions::*,
                 Spacing ExportOptions::*, FileStyle ExportOptions::*>;

// What a text may be.
enum class TextRule : std::uint8_t { any, case_control_line, matrix_suffix, file_extension, unused_items };

struct Directive {
  std::string_view name;
  Slot slot;
  std::string_view help;
  unsigned ignored = never;
  bool required_in_108 = false;
  double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
  TextRule rule = TextRule::any;
  std::string_view fallback = {};  // what holds without it, where that is no value
  std::string_view also = {};      // a spelling that the documentation uses as well
};

// A value within a data block.
struct Field {
  std::string_view name, values, fallback = {};
  std::string_view help;
  bool required = false;
  std::string_view also = {};
};

// One value as it is written: without comment and blanks around it.
struct WrittenValue {
  Span key, value;
};

struct Block {
  std::string_view name;
  std::string_view help;
  bool ignored_in_107 = true, required_in_108 = true;
  std::span<const Field> fields;
  // Takes one block; the fields are known and stand once. Nothing is stored after a report.
  void (*store)(const Span& block, const std::vector<WrittenValue>&, ExportOptions&, Diagnostics&);
};

struct DirectiveGroup {
  std::string_view title;
  std::span<const Directive> directives;
  std::span<const Block> blocks;
};
std::span<const DirectiveGroup> directive_groups();
const Directive* find_directive(std::string_view name);  // by its name or other spelling
const Block* find_block(std::string_view name);          // verbatim is none of them
// All names, verbatim included.
std::vector<std::string_view> directive_names();

// "yes | no", "integer", "list of strings"
std::string values_text(const Directive&);
// What holds without it, empty for nothing.
std::string fallback_text(const Directive&);
// Takes a value; reports what is wrong with it and stores nothing then.
void store(const Directive&, const WrittenValue&, ExportOptions&, Diagnostics&);

// For the groups' own tables.
std::span<const Directive> solution_directives();
std::span<const Directive> item_directives();
std::span<const Directive> response_directives();
std::span<const Directive> number_directives();
std::span<const Directive> file_directives();
std::span<const Block> response_blocks();

}  // namespace dynalin::nastran
