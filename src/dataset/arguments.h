// Splits the tokens of one statement into its arguments, without knowing which arguments the
// statement has.
//
// A new argument begins after a comma, a backslash or a blank with a word that `=` follows or that
// stands alone; everything else goes on with the value before it. So lists (`QP=1,0,0`) and
// expressions that run over several lines stay whole.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "dataset/dataset.h"

namespace dynalin {

struct SplitArguments {
  std::vector<WrittenArgument> arguments;  // with values among the tokens that were given
  bool damaged = false;                    // an error was reported

  // Memory that is used again. The partner of each parenthesis and bracket, empty if there is none; those that are
  // open.
  std::vector<std::size_t> match, open;
};

// `tokens` are those behind keyword, slash and id; `statement` is the full keyword, "" if unknown. What `result` held
// before is gone, its memory is used again.
void split_arguments(std::span<const Token> tokens, std::string_view statement, const SourceText& source,
                     Diagnostics& diagnostics, SplitArguments& result);

}  // namespace dynalin
