#include "output/message_file.h"

#include <fmt/ostream.h>

#include <cmath>
#include <string>

namespace dynalin {

namespace {
const std::string rule(79, '-');
}

void write_banner(std::ostream& out, std::string_view version) {
  fmt::print(out, "{0}\n|{1:^77}|\n|{2:^77}|\n{0}\n\n", rule, "Dynalin: linear models of mechanisms",
             fmt::format("Version: {}", version));
}

void write_title(std::ostream& out, std::string_view title) {
  fmt::print(out, "{0}\n|{1:^77}|\n|{2}|\n|{3:77}|\n|{4:^77}|\n{0}\n\n", rule, "Model Title", std::string(77, '='), "",
             title.substr(0, 77));
}

void write_command(std::ostream& out, std::string_view line) { fmt::print(out, " command: {}\n", line); }
void write_begin(std::ostream& out, std::string_view what) { fmt::print(out, "\n\n  Begin {}\n\n\n", what); }
void write_end(std::ostream& out, std::string_view what) { fmt::print(out, "\n  End {}\n\n", what); }

void write_static_result(std::ostream& out, int iterations, double imbalance) {
  fmt::print(out, "  Static Solution converged in {} iterations\n  Residual imbalance is less than {:.5E}\n",
             iterations, imbalance);
}

void write_redundant(std::ostream& out, double time, const std::vector<std::string>& rows) {
  if (rows.empty()) return;
  fmt::print(out,
             "\n  Time T={:.9E}.\n  Degree-of-freedom analysis identified redundant constraints in the model:\n  {}\n",
             time, rule.substr(2));
  for (const std::string& row : rows) fmt::print(out, "   -  deactivating constraint equation  {}\n", row);
}

void write_block(std::ostream& out, Block kind, std::string_view text) {
  const std::string_view name = kind == Block::warning ? "WARNING" : "ERROR";
  fmt::print(out, "\n---- START: {0} ----\n{1}\n---- END: {0} ----\n", name, text);
}

void write_eigensolution(std::ostream& out, const EigenSolution& e) {
  fmt::print(out, "\n  EigenSolution computation started.\n\n");
  if (e.rm) fmt::print(out, "  Option RM={} was used.\n\n", e.rm);
  if (e.pstate) fmt::print(out, "  Option PSTATE={} was used.\n\n", e.pstate);
  if (e.without_damping) fmt::print(out, "  Option NODAMPIN was used.\n\n");
  if (e.original) fmt::print(out, "  Option ORIGINAL was used.\n\n");
  fmt::print(out,
             "  This model has\n{:9d} kinematic states (displacement and velocities)\n{:9d} differential states "
             "(DIFFs, LSEs, etc.)\n",
             e.kinematic_states, e.differential_states);
  if (e.kinematic_states > 0) {
    fmt::print(out, "\n  The selected kinematic states are:\n");
    int number = 0;
    for (std::size_t k = 0; k < e.kinematic_states; ++k) {
      const StateLabel& s = e.states[k];
      if (!s.is_rate) fmt::print(out, "{:9d} {}{}{}\n", ++number, s.text, s.owner.empty() ? "" : "   ", s.owner);
    }
    fmt::print(out, "\n  The other kinematic states are the respective derivatives.\n");
  }
  fmt::print(out, "\n{:17}E I G E N V A L U E S  at time = {:.5E}\n", "", e.time);
  fmt::print(out, "      Number    Real(cycles/unit time)   Imag.(cycles/unit time)\n");
  int number = 0;
  for (const EigenMode& m : e.modes) {
    const double re = m.eigenvalue_hz.real() + 0.0, im = m.eigenvalue_hz.imag();
    if (m.is_real) {
      fmt::print(out, "{:10d}{:25.5E}\n", ++number, re);
    } else {
      fmt::print(out, "{:10d}{:25.5E}    +/-{:19.5E}\n", ++number, re, im);
    }
  }
  fmt::print(out, "\n\n  Eigensolution computation finished.\n\n");
}

void write_footer(std::ostream& out, bool complete, double elapsed) {
  fmt::print(out, "\n\n{}\nElapsed time = {:.2f}s\n", complete ? "Finished -----" : "Ended early: the run failed -----",
             elapsed);
}

void write_eigen_table(std::ostream& out, const EigenSolution& e, bool with_bounds) {
  with_bounds = with_bounds && e.vectors.size() > 0;
  const auto line = [&](std::string_view number, std::string_view frequency, std::string_view damping,
                        std::string_view real, std::string_view imaginary, const std::string& bounds,
                        std::string_view mover) {
    fmt::print(out, "{:>6}  {:>14}  {:>10}  {:>15}  {:>15}  {}{}\n", number, frequency, damping, real, imaginary,
               bounds, mover);
  };
  const auto columns = [&](std::string_view bound, std::string_view condition) {
    return with_bounds ? fmt::format("{:>12}  {:>10}  ", bound, condition) : std::string();
  };
  line("mode", "frequency", "damping", "real", "imaginary", columns("error bound", "condition"),
       e.vectors.size() ? "moves most" : "");
  line("", "cycles/time", "ratio", "cycles/time", "cycles/time", columns("cycles/time", ""), "");
  int number = 0;
  for (const EigenMode& m : e.modes) {
    const double size = std::abs(m.eigenvalue_hz);
    const double ratio = size > 0 ? -m.eigenvalue_hz.real() / size : 0.0;
    line(std::to_string(++number), fmt::format("{:.7g}", size), fmt::format("{:.5f}", ratio + 0.0),
         fmt::format("{:.7g}", m.eigenvalue_hz.real() + 0.0),
         m.is_real ? "0" : fmt::format("+/- {:.7g}", m.eigenvalue_hz.imag()),
         columns(m.structural_zero ? "exact" : fmt::format("{:.1e}", m.error_bound_hz),
                 fmt::format("{:.1e}", m.condition)),
         m.moves_most);
  }
}

}  // namespace dynalin
