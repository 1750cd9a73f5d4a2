// `dynalin nastran check` and `dynalin nastran solve`.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace dynalin::nastran_reader {

struct SolveOptions {
  std::string deck;
  std::string json;        // empty for none
  std::vector<int> modes;  // whose shapes are wanted, counted from 1
  bool ignore_unknown = false;
};

// Exit statuses are those of the program: 0 done, 1 the deck is wrong, 2 the solution failed, 3 usage.
int check_deck(const std::string& path, std::ostream& out, std::ostream& err);
int solve_deck(const SolveOptions&, std::ostream& out, std::ostream& err);

}  // namespace dynalin::nastran_reader
