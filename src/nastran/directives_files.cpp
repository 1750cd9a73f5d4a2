// Directives: text and files.
#include "nastran/directives.h"

namespace dynalin::nastran {

std::span<const Directive> file_directives() {
  using O = ExportOptions;
  static constexpr std::array<Directive, 14> list = {{
      {.name = "file_name_style",
       .slot = &O::file_name_style,
       .help = "A: name.dat, name_MODEL.nas, a file for each matrix; B: the same with the extension of FILE; C: a file "
               "for each body",
       .ignored = in_closed_box},
      {.name = "main_file_include_extension",
       .slot = &O::main_file_include_extension,
       .help = "of the main file of styles A and C, with its point",
       .ignored = in_style_B,
       .rule = TextRule::file_extension},
      {.name = "model_include_extension",
       .slot = &O::model_include_extension,
       .help = "of the model file in style A, of all included files in style C",
       .ignored = in_style_B,
       .rule = TextRule::file_extension},
      {.name = "file_include_extension",
       .slot = &O::file_include_extension,
       .help = "of files of matrices and graphics in style A",
       .ignored = in_closed_box | outside_style_A,
       .rule = TextRule::file_extension},
      {.name = "include_directory",
       .slot = &O::include_directory,
       .help = "folder on INCLUDE cards; blank: none",
       .fallback = "that of FILE, where FILE begins at the root; else none"},
      {.name = "use_includes",
       .slot = &O::use_includes,
       .help = "no: everything in the main file",
       .ignored = in_closed_box},
      {.name = "single_included_dmig",
       .slot = &O::single_included_dmig,
       .help = "yes: matrices and graphics in one included file",
       .ignored = in_closed_box},
      {.name = "use_short_part_file_names",
       .slot = &O::use_short_part_file_names,
       .help = "files of bodies have the last part of a name alone",
       .ignored = in_sol_107},
      {.name = "use_long_format",
       .slot = &O::use_long_format,
       .help = "fields of 16 columns, matrices excepted; no: 8",
       .ignored = in_closed_box},
      {.name = "use_dmig_long_format",
       .slot = &O::use_dmig_long_format,
       .help = "matrices in fields of 16 columns and double precision; no: 8, single precision",
       .ignored = in_closed_box},
      {.name = "use_view_names",
       .slot = &O::use_view_names,
       .help = "comments have the names of adams_view_name; no: statement and id",
       .ignored = in_closed_box},
      {.name = "verbose_names",
       .slot = &O::verbose_names,
       .help = "comments say what a card is of its element",
       .ignored = in_closed_box},
      {.name = "add_space_before_names",
       .slot = &O::add_space_before_names,
       .help = "a blank between $ and the name in comments",
       .ignored = in_closed_box},
      {.name = "material_card_number",
       .slot = &O::material_card_number,
       .help = "the first MAT1 of graphics",
       .ignored = in_closed_box | with_wireframe,
       .minimum = 1},
  }};
  return list;
}

}  // namespace dynalin::nastran
