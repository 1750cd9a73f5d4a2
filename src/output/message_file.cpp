#include "output/message_file.h"

#include <fmt/ostream.h>

#include <array>
#include <cmath>
#include <string>

#include "output/certain_digits.h"

namespace dynalin {

namespace {

const std::string full_line(79, '-');

// A value that is zero is as certain as its bound is small against the fastest of the model.
double largest_modulus(const EigenSolution& e) {
  double most = 0;
  for (const EigenMode& m : e.modes) most = std::max(most, std::abs(m.eigenvalue_hz));
  return most;
}

// What the marks of a table of eigenvalues say.
void write_doubts(std::ostream& out, const EigenSolution& e, int digits) {
  bool marked = false;
  const double fastest = largest_modulus(e);
  for (const EigenMode& m : e.modes) {
    const double modulus = std::abs(m.eigenvalue_hz), size = modulus > 0 ? modulus : fastest;
    marked = marked || !certain(m.eigenvalue_hz.real(), size, m.error_bound_hz, digits) ||
             (!m.is_real && !certain(m.eigenvalue_hz.imag(), size, m.error_bound_hz, digits));
  }
  if (marked) fmt::print(out, "\n  ? the error bound is larger than the last digit printed\n");
  for (std::size_t k = 0; k < e.modes.size();) {
    const EigenMode& m = e.modes[k];
    if (m.cluster_size > 1) {
      fmt::print(out, "  {} to {}: the mean of {} eigenvalues within {:.1E} of it, not told apart\n", k + 1,
                 k + m.cluster_size, m.cluster_size, m.error_bound_hz);
    }
    k += m.cluster_size;
  }
}

}  // namespace

void write_banner(std::ostream& out, std::string_view version) {
  fmt::print(out, "{0}\n|{1:^77}|\n|{2:^77}|\n{0}\n\n", full_line, "Dynalin: linear models of mechanisms",
             fmt::format("Version: {}", version));
}

void write_title(std::ostream& out, std::string_view title) {
  fmt::print(out, "{0}\n|{1:^77}|\n|{2}|\n|{3:77}|\n|{4:^77}|\n{0}\n\n", full_line, "Model Title", std::string(77, '='),
             "", title.substr(0, 77));
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
             time, full_line.substr(2));
  for (const std::string& row : rows) fmt::print(out, "   -  deactivating constraint equation  {}\n", row);
}

void write_block(std::ostream& out, Block kind, std::string_view text) {
  const std::string_view name = kind == Block::warning ? "WARNING" : "ERROR";
  fmt::print(out, "\n---- START: {0} ----\n{1}\n---- END: {0} ----\n", name, text);
}

namespace {

// Which states were chosen, and under which options; `count` states are kinematic, rates among them.
struct ChosenStates {
  const std::vector<StateLabel>& states;
  std::size_t kinematic, differential;
  std::int64_t rm, pstate;
  bool without_damping, original;
};

void write_chosen_states(std::ostream& out, const ChosenStates& c) {
  if (c.rm) fmt::print(out, "  Option RM={} was used.\n\n", c.rm);
  if (c.pstate) fmt::print(out, "  Option PSTATE={} was used.\n\n", c.pstate);
  if (c.without_damping) fmt::print(out, "  Option NODAMPIN was used.\n\n");
  if (c.original) fmt::print(out, "  Option ORIGINAL was used.\n\n");
  fmt::print(out,
             "  This model has\n{:9d} kinematic states (displacement and velocities)\n{:9d} differential states "
             "(DIFFs, LSEs, etc.)\n",
             c.kinematic, c.differential);
  if (c.kinematic == 0) return;
  fmt::print(out, "\n  The selected kinematic states are:\n");
  int number = 0;
  std::size_t left = c.kinematic;
  for (const StateLabel& s : c.states) {
    if (left == 0) break;
    if (!s.is_rate) fmt::print(out, "{:9d} {}{}{}\n", ++number, s.text, s.owner.empty() ? "" : "   ", s.owner.text());
    --left;
  }
  fmt::print(out, "\n  The other kinematic states are the respective derivatives.\n");
}

// Its row has no rate of a rate.
bool is_first_order(const SecondOrder& s, std::size_t coordinate) {
  const auto k = static_cast<Eigen::Index>(coordinate);
  return s.M(k, k) == 0;
}

}  // namespace

void write_matrix_states(std::ostream& out, const StateSpace& s) {
  fmt::print(out, "\n  State matrices computation started.\n\n");
  write_chosen_states(out, {s.states, s.kinematic_states, s.states.size() - s.kinematic_states, s.rm, s.pstate,
                            s.without_damping, s.original});
  fmt::print(out, "\n  State matrices computation finished.\n\n");
}

// The coordinates of the second-order form stand without their rates, which are states all the same.
void write_matrix_states(std::ostream& out, const SecondOrder& s) {
  std::vector<StateLabel> states;
  for (std::size_t k = 0; k + s.differential_states < s.states.size(); ++k) {
    states.push_back(s.states[k]);
    if (is_first_order(s, k)) continue;
    states.push_back(s.states[k]);
    states.back().is_rate = true;
  }
  fmt::print(out, "\n  Second-order matrices computation started.\n\n");
  write_chosen_states(out,
                      {states, states.size(), s.differential_states, s.rm, s.pstate, s.without_damping, s.original});
  fmt::print(out, "\n  Second-order matrices computation finished.\n\n");
}

std::string_view name_of(CountedBy by) {
  static constexpr std::array<std::string_view, 4> names = {"not counted", "all eigenvalues computed",
                                                            "inertia of a factorization", "winding number"};
  return names[static_cast<std::size_t>(by)];
}

std::string selection_text(const SelectedModes& s, const std::string& unit) {
  std::string text;
  if (const auto* nearest = std::get_if<NearestModes>(&s.wanted)) {
    text = fmt::format("  the {} mode{} nearest to {:g} {}, within {:.6g}", nearest->count,
                       nearest->count == 1 ? "" : "s", nearest->frequency, unit, s.radius_hz);
  } else {
    const auto& band = std::get<ModesInBand>(s.wanted);
    text = fmt::format("  all modes from {:g} to {:g} {}", band.low, band.high, unit);
  }
  text += ", and zeros that follow from the structure\n";
  text += fmt::format("  eigenvalues there: {} found, ", s.found);
  text += s.by == CountedBy::nothing ? "not counted\n" : fmt::format("{} counted ({})\n", s.counted, name_of(s.by));
  return text + fmt::format("  complete: {}\n", s.complete);
}

void write_eigensolution(std::ostream& out, const EigenSolution& e, double cpu_seconds) {
  if (e.selected && e.selected->by != CountedBy::full_solution) {
    fmt::print(out, "\n  Eigensolution Using: shift-invert iteration for {} of {} values\n", e.selected->found,
               e.states.size());
  } else {
    fmt::print(out, "\n  Eigensolution Using: QR eigen solver for {} values\n", e.states.size());
  }
  fmt::print(out, "\n  EigenSolution computation started.\n\n");
  write_chosen_states(
      out, {e.states, e.kinematic_states, e.differential_states, e.rm, e.pstate, e.without_damping, e.original});
  if (e.selected) fmt::print(out, "\n  Selected modes:\n{}", selection_text(*e.selected, "cycles/unit time"));
  fmt::print(out, "\n{:17}E I G E N V A L U E S  at time = {:.5E}\n", "", e.time);
  fmt::print(out, "      Number    Real(cycles/unit time)   Imag.(cycles/unit time)\n");
  int number = 0;
  const double fastest = largest_modulus(e);
  for (const EigenMode& m : e.modes) {
    const double re = m.eigenvalue_hz.real() + 0.0, im = m.eigenvalue_hz.imag();
    const double size = std::abs(m.eigenvalue_hz);
    const char* of_real = doubt(certain(re, size > 0 ? size : fastest, m.error_bound_hz, 6));
    if (m.is_real) {
      fmt::print(out, "{:10d}{:25.5E}{}\n", ++number, re, of_real);
    } else {
      fmt::print(out, "{:10d}{:25.5E}{:<4}+/-{:19.5E}{}\n", ++number, re, of_real, im,
                 doubt(certain(im, size, m.error_bound_hz, 6)));
    }
  }
  write_doubts(out, e, 6);
  fmt::print(out, "\n\n  Simulation CPU time for eigenSolution computation = {:.6E} seconds.\n", cpu_seconds);
  fmt::print(out, "\n  Eigensolution computation finished.\n\n");
}

void write_footer(std::ostream& out, RunEnding ending, double elapsed, double cpu) {
  const std::string_view text = ending == RunEnding::finished ? "Finished -----"
                                : ending == RunEnding::failed ? "Ended early: the run failed -----"
                                                              : "Ended early: the run was interrupted -----";
  const double share = elapsed > 0 ? 100 * cpu / elapsed : 0.0;
  fmt::print(out, "\n\n{}\nElapsed time = {:.2f}s,  CPU time = {:.2f}s,  {:.2f}%\n", text, elapsed, cpu, share);
}

void write_eigen_table(std::ostream& out, const EigenSolution& e, const std::string& unit, bool with_bounds) {
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
  line("", unit, "ratio", unit, unit, columns(unit, ""), "");
  int number = 0;
  const double fastest = largest_modulus(e);
  for (const EigenMode& m : e.modes) {
    const double size = std::abs(m.eigenvalue_hz), compared = size > 0 ? size : fastest;
    double ratio = size > 0 ? -m.eigenvalue_hz.real() / size : 0.0;
    if (std::abs(ratio) < 0.5e-5) ratio = 0;  // without the sign of what is not printed
    const double bound = m.error_bound_hz;
    const auto digits = [&](double v) {
      return fmt::format("{:.7g}{}", v + 0.0, doubt(certain(v, compared, bound, 7)));
    };
    // Nor is that a value is real known of one without a bound.
    const bool is_known_real = m.is_real && std::isfinite(bound);
    line(std::to_string(++number), digits(size),
         fmt::format("{:.5f}{}", ratio + 0.0, doubt(m.structural_zero || is_known_real || bound <= 1e-5 * compared)),
         digits(m.eigenvalue_hz.real()),
         m.is_real ? fmt::format("0{}", doubt(is_known_real)) : "+/- " + digits(m.eigenvalue_hz.imag()),
         columns(m.structural_zero ? "exact" : fmt::format("{:.1e}", m.error_bound_hz),
                 fmt::format("{:.1e}", m.condition)),
         m.moves_most);
  }
  write_doubts(out, e, 7);
}

}  // namespace dynalin
