// What the configuration file of LINEAR/EXPORT decides (LINEAR command, 5.3.4): a member for each directive, of the
// same name, with the documented default. Blocks are lists. The table of directives (directives.h) fills it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dynalin::nastran {

enum class Automset : std::uint8_t { yes, lusol };
enum class EigenMethod : std::uint8_t { hess, clan };
enum class Output : std::uint8_t { plot, punch, both };
enum class Spacing : std::uint8_t { linear, log };
enum class FileStyle : std::uint8_t { A, B, C };
enum class Axes : std::uint8_t { local, global };

struct ClanRegion {
  std::array<double, 5> values{};  // ALPHAAJ, OMEGAAJ, ALPHABJ, OMEGABJ, LJ
  std::int64_t count = 0;          // NDJ
};

struct IdRange {
  std::int64_t first = 0, last = 0;
};

// An element by class and id or by its name, and the end of the names of its matrices.
struct Editable {
  std::string type;  // "sforce", "bushing" … of forces; empty for flexible bodies
  std::optional<std::int64_t> id;
  std::string name;
  std::string suffix;
};

struct Actuator {
  std::string name;
  double magnitude = 1, phase_angle = 0;  // [rad]
};

struct ChannelMarker {
  std::optional<std::int64_t> marker_id;
  std::string marker_name;
  Axes mode = Axes::local;
};
struct OutputChannel : ChannelMarker {
  std::string name;
};
struct InputChannel : ChannelMarker {
  std::string name;
  int dof = 1;  // 1 … 6: x, y, z, rx, ry, rz
  std::string actuator_name;
};
struct Subcase {
  std::int64_t number = 0;
  std::vector<std::string> input_channel_names, output_channel_names;
};

struct ExportOptions {
  // What is solved.
  std::int64_t solution_number = 107;
  std::int64_t cmethod_number = 101;
  EigenMethod eigc_method = EigenMethod::hess;
  std::vector<ClanRegion> clan_region;
  std::optional<std::int64_t> number_of_eigenvalues;  // the size of the state matrix
  bool use_damping = true;
  Automset automset = Automset::lusol;
  Output disp_plot_punch = Output::both;
  std::int64_t param_post = 0;
  std::string title = "ADAMS2NASTRAN Export Utility";
  std::optional<std::string> subtitle;  // the time
  std::vector<std::string> verbatim;
  std::optional<std::int64_t> load;  // written only where it is asked for: a deck has no static loads of its own
  std::int64_t mpc_set = 1, spc_set = 1, tic_set = 2, initial_dmig_set = 1;
  bool ignore_errors = false, debug = false;

  // Frequency response.
  std::optional<double> begin_frequency, end_frequency;
  std::optional<std::int64_t> steps_frequency;
  Spacing spacing_frequency = Spacing::linear;
  std::vector<Actuator> actuator_swept_sine;
  std::vector<OutputChannel> displacement_output_channel;
  std::vector<InputChannel> force_input_channel;
  std::vector<Subcase> frequency_response_subcase;
  std::int64_t dload_card_number = 100, dload_card_number_increment = 1;
  std::int64_t rload1_card_number = 200, rload1_card_number_increment = 1;
  std::int64_t force_card_number = 300, force_card_number_increment = 1;
  std::int64_t dphase_card_number = 400, dphase_card_number_increment = 1;
  std::int64_t tabled1_card_number = 500, tabled1_card_number_increment = 1;
  std::int64_t frequency_card_number = 600;
  std::int64_t set_card_number = 900, set_card_number_increment = 1;

  // What is exported, and as what.
  bool export_all_markers = false, export_ground_markers = false;
  std::vector<IdRange> export_markers_by_id;
  std::vector<std::string> export_markers_by_name;
  bool all_forces_editable = true, all_flexbodies_editable = true;
  std::vector<Editable> force_editable, flexbody_editable;  // …_by_id and …_by_name
  bool export_cbush = true, export_residuals = true, use_rjoints = true;
  bool export_tic_cards = false, export_mode_shapes = false;
  bool export_graphics = true, export_external = true, export_spdp = true;
  bool use_plotel = false, use_wireframe = false;
  bool export_rbe_connectivity = false, export_spc_connectivity = false;
  std::int64_t spc_set_connectivity = 30000;
  std::vector<std::string> remove_unused_items;  // "cbush", "grid"
  double small_mass = 0;                         // 0: 1e-8 of the smallest mass
  double matrix_entry_zero_tolerance = 1e-8;
  bool split_dmigs = true;
  std::string forces_dmig_name = "VVV", differentials_dmig_name = "ZZZ";

  // Numbers.
  bool use_adams_ids = true;
  std::int64_t grid_offset = 1, marker_offset = 1000000, pointmass_offset = 2000000, spoint_offset = 3000000;
  std::int64_t graphics_grid_offset = 4000000, cbush_offset = 6000000, pbush_offset = 6000000;
  std::int64_t cord2r_offset = 100, conm2_offset = 1, cquad4_offset = 1, ctria3_offset = 1, crod_offset = 1;
  std::int64_t prod_offset = 1, pshell_offset = 1, rbe2_offset = 1, rjoint_offset = 1, material_card_number = 1000;

  // Text and files.
  FileStyle file_name_style = FileStyle::A;
  std::string main_file_include_extension = ".dat", model_include_extension = ".nas", file_include_extension = ".bdf";
  std::optional<std::string> include_directory;  // that of the exported file
  bool single_included_dmig = false, use_includes = true;
  bool use_long_format = true, use_dmig_long_format = true;
  bool add_space_before_names = false, use_view_names = true, verbose_names = true, use_short_part_file_names = false;
};

}  // namespace dynalin::nastran
