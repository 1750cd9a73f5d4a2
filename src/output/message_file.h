// The text blocks of the message file (.msg).
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "dynalin/results.h"

namespace dynalin {

void write_banner(std::ostream&, std::string_view version);
void write_title(std::ostream&, std::string_view title);
void write_command(std::ostream&, std::string_view line);  // " command: …"
void write_begin(std::ostream&, std::string_view what);    // "  Begin …" between blank lines
void write_end(std::ostream&, std::string_view what);
void write_static_result(std::ostream&, int iterations, double imbalance);
void write_redundant(std::ostream&, double time, const std::vector<std::string>& rows);
enum class Block { warning, error };
void write_block(std::ostream&, Block, std::string_view text);
// Where selected modes were looked for, how many there are, and whether that is all; three lines.
std::string selection_text(const SelectedModes&, const std::string& unit);
// From the solver and "EigenSolution computation started." to the table, the CPU time and the end.
void write_eigensolution(std::ostream&, const EigenSolution&, double cpu_seconds);
// States and options of the matrices of STATEMAT and MKB.
void write_matrix_states(std::ostream&, const StateSpace&);
void write_matrix_states(std::ostream&, const SecondOrder&);
enum class RunEnding { finished, failed, interrupted };
// Seconds on the clock, and those of all processors together.
void write_footer(std::ostream&, RunEnding, double elapsed, double cpu);

// A table for the terminal: frequency, damping ratio, real and imaginary part; on request how far each eigenvalue may
// be off and its condition number. `unit` is that of frequencies, "cycles/s".
void write_eigen_table(std::ostream&, const EigenSolution&, const std::string& unit, bool with_bounds);

}  // namespace dynalin
