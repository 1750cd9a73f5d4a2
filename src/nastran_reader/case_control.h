// Executive and case control: which solution, which sets of cards, which direct matrices.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "nastran_reader/deck_lines.h"

namespace dynalin::nastran_reader {

// A number given to a command: SPC = 1.
struct Selected {
  int id = 0;
  Span at;
};

// One matrix of K2PP = 2.0*KVVV.
struct MatrixUse {
  std::string name;
  double factor = 1;
  Span at;
};

// SET n = 1, 2, 5 THRU 9 or names or ALL.
struct NamedSet {
  std::vector<std::pair<int, int>> ranges;
  std::vector<std::pair<std::string, Span>> names;
  bool all = false;
  bool contains(int id) const;
};

// DISP = ALL | n | NONE
struct OutputRequest {
  enum class Kind { none, all, set } kind = Kind::none;
  Selected set;
};

struct Subcase {
  int id = 0;
  Span at;
  std::optional<Selected> dload;
  std::optional<OutputRequest> displacement;
  std::string label;
};

struct CaseControl {
  int solution = 0;  // 0: the deck names none
  Span solution_at;
  std::optional<Selected> spc, mpc, cmethod, frequency;
  std::map<std::string, std::vector<MatrixUse>> matrices;  // K2PP, B2PP, M2PP, K2GG, B2GG, M2GG
  std::map<int, NamedSet> sets;
  Subcase above;                  // what stands above all subcases
  std::vector<Subcase> subcases;  // with what they take from above; one without a number if there are none
  std::optional<bool> autospc;    // AUTOSPC = NO
  std::map<std::string, std::pair<std::string, Span>> parameters;  // PARAM,name,value in case control
  std::vector<std::pair<std::string, Span>> passed_over;           // commands that change no number
};

// What stands above BEGIN BULK, and where the bulk data begin.
struct Sections {
  CaseControl control;
  std::size_t first_bulk = 0;  // among the lines
};
Sections read_control(std::span<const Line>, Diagnostics&);

}  // namespace dynalin::nastran_reader
