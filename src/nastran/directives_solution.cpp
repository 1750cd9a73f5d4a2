// Directives: what is solved, and what case control says of it.
#include "nastran/directives.h"

namespace dynalin::nastran {

std::span<const Directive> solution_directives() {
  using O = ExportOptions;
  static constexpr std::array<Directive, 20> list = {{
      {.name = "solution_number",
       .slot = &O::solution_number,
       .help = "complex eigenvalues (107) or frequency response (108), by the direct method"},
      {.name = "eigc_method",
       .slot = &O::eigc_method,
       .help = "method on the EIGC card: upper Hessenberg, or complex Lanczos"},
      {.name = "clan_region",
       .slot = &O::clan_region,
       .help = "ALPHAAJ, OMEGAAJ, ALPHABJ, OMEGABJ, LJ and NDJ of a search region for eigc_method = clan; as many "
               "directives as regions",
       .ignored = with_hess},
      {.name = "number_of_eigenvalues",
       .slot = &O::number_of_eigenvalues,
       .help = "on the EIGC card",
       .ignored = in_sol_108,
       .minimum = 1,
       .fallback = "the size of the state matrix"},
      {.name = "cmethod_number",
       .slot = &O::cmethod_number,
       .help = "number of the EIGC card that CMETHOD selects",
       .ignored = in_sol_108,
       .minimum = 1},
      {.name = "use_damping", .slot = &O::use_damping, .help = "no: forces lose what they see of velocities"},
      {.name = "automset",
       .slot = &O::automset,
       .help = "PARAM,AUTOMSET: Nastran chooses the dependent freedoms; yes for releases before 2016",
       .ignored = in_closed_box},
      {.name = "split_dmigs",
       .slot = &O::split_dmigs,
       .help = "each matrix as a symmetric one (IFO 6) and the rest (IFO 1)",
       .ignored = in_sol_107},
      {.name = "matrix_entry_zero_tolerance",
       .slot = &O::matrix_entry_zero_tolerance,
       .help = "entries of matrices of a smaller magnitude are not written",
       .minimum = 0},
      {.name = "disp_plot_punch", .slot = &O::disp_plot_punch, .help = "where DISP puts displacements"},
      {.name = "param_post", .slot = &O::param_post, .help = "value of PARAM,POST"},
      {.name = "title", .slot = &O::title, .help = "TITLE of case control", .rule = TextRule::case_control_line},
      {.name = "subtitle",
       .slot = &O::subtitle,
       .help = "SUBTITLE of case control",
       .rule = TextRule::case_control_line,
       .fallback = "the time"},
      {.name = "load",
       .slot = &O::load,
       .help = "number of a LOAD command in case control, for loads that are added to the deck",
       .minimum = 1,
       .fallback = "no LOAD command"},
      {.name = "mpc_set", .slot = &O::mpc_set, .help = "set of the MPC cards", .minimum = 1},
      {.name = "spc_set", .slot = &O::spc_set, .help = "set of the SPC cards", .ignored = in_closed_box, .minimum = 1},
      {.name = "tic_set", .slot = &O::tic_set, .help = "set of the TIC cards", .ignored = in_closed_box, .minimum = 1},
      {.name = "initial_dmig_set",
       .slot = &O::initial_dmig_set,
       .help = "number of the first SET of names of matrices",
       .minimum = 1},
      {.name = "ignore_errors",
       .slot = &O::ignore_errors,
       .help = "yes: what is wrong in this file is left out with a warning"},
      {.name = "debug", .slot = &O::debug, .help = "yes: each directive and what it does is printed"},
  }};
  return list;
}

}  // namespace dynalin::nastran
