// OUTPUT and RESULTS as written, in datasets and as commands.
#pragma once

#include "model/model.h"
#include "model/schema.h"
#include "model/settings.h"

namespace dynalin {

// What OUTPUT says of the files over time. Tables are written where there is an OUTPUT without NOPRINT.
struct OutputSettings {
  bool stated = false;
  bool request_file = false, graphics_file = false, tables = true;
  bool fixed = false;           // numbers of tables without exponents
  bool yaw_pitch_roll = false;  // orientations of DISPLACEMENT in tables and request file
  // Of DISPLACEMENT, VELOCITY, ACCELERATION and FORCE in tables and request file: factors of translation and rotation,
  // and below what size a value is written as zero.
  std::array<std::array<double, 2>, 4> scale = {{{1, 1}, {1, 1}, {1, 1}, {1, 1}}};
  std::array<double, 4> zero{};

  bool writes_tables() const { return stated && tables; }
};

struct WrittenOutput {
  bool requests = false, graphics = false, no_requests = false, no_graphics = false;
  bool print = false, no_print = false, fixed = false, yaw_pitch_roll = false, euler = false, defaults = false;
  bool list = false, flag = false;
  std::vector<double> dscale, vscale, ascale, fscale;
  std::optional<double> dzero, vzero, azero, fzero;
  Obsolete value;

  using E = WrittenOutput;
  static constexpr std::string_view scale = "factor of translations [and rotations] in tables and request file";
  static constexpr std::string_view zero = "what is smaller is written there as 0";
  static constexpr std::array<Argument<E>, 28> arguments = {{
      {.name = "REQSAVE", .slot = &E::requests, .help = "the request file (.req)"},
      {.name = "GRSAVE", .slot = &E::graphics, .help = "the graphics file (.gra)"},
      {.name = "NOREQSAVE", .slot = &E::no_requests, .help = "no request file"},
      {.name = "NOGRSAVE", .slot = &E::no_graphics, .help = "no graphics file"},
      {.name = "NOPRINT", .slot = &E::no_print, .help = "no tables of requests (.out)"},
      {.name = "PRINT", .slot = &E::print, .help = "these tables, which every OUTPUT asks for"},
      {.name = "TELETYPE", .slot = &E::flag},
      {.name = "OSFORMAT", .slot = &E::flag},
      {.name = "FIXED", .slot = &E::fixed, .help = "numbers of tables without exponents, as far as they fit"},
      {.name = "CHART", .slot = &E::value},
      {.name = "NOCHART", .slot = &E::flag},
      {.name = "NOSEPARATOR", .slot = &E::flag},
      {.name = "SEPARATOR", .slot = &E::flag},
      {.name = "DSCALE", .slot = &E::dscale, .help = scale},
      {.name = "DZERO", .slot = &E::dzero, .minimum = 0, .help = zero},
      {.name = "VSCALE", .slot = &E::vscale, .help = scale},
      {.name = "VZERO", .slot = &E::vzero, .minimum = 0, .help = zero},
      {.name = "ASCALE", .slot = &E::ascale, .help = scale},
      {.name = "AZERO", .slot = &E::azero, .minimum = 0, .help = zero},
      {.name = "FSCALE", .slot = &E::fscale, .help = scale},
      {.name = "FZERO", .slot = &E::fzero, .minimum = 0, .help = zero},
      {.name = "YPR", .slot = &E::yaw_pitch_roll, .help = "yaw, pitch and roll in tables and request file"},
      {.name = "VPR", .slot = &E::flag},
      {.name = "EULER", .slot = &E::euler, .help = "3-1-3 angles there (default)"},
      {.name = "TITLE", .slot = &E::value},
      {.name = "OLDREQ", .slot = &E::flag},
      {.name = "DEFAULT", .slot = &E::defaults, .help = "everything as without the statement"},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 20> acting = {
      "REQSAVE", "GRSAVE", "NOREQSAVE", "NOGRSAVE", "NOPRINT", "PRINT", "FIXED", "NOCHART", "DSCALE",  "DZERO",
      "VSCALE",  "VZERO",  "ASCALE",    "AZERO",    "FSCALE",  "FZERO", "YPR",   "EULER",   "DEFAULT", "LIST"};
  static constexpr std::array<std::string_view, 4> alternatives = {"REQSAVE NOREQSAVE", "GRSAVE NOGRSAVE",
                                                                   "PRINT NOPRINT", "YPR EULER"};
  bool check(ElementReader&) const;
  void apply(OutputSettings&) const;
  void apply(Settings&) const {}  // where output_settings finds it
};
// As the dataset has them.
OutputSettings output_settings(const Model&);

// RESULTS: XRF asks for the results file in XML; the switches keep parts of its contents out of it.
struct WrittenResults {
  bool xrf = false, no_linear = false, flag = false;
  bool no_displacements = false, no_velocities = false, no_accelerations = false;
  bool no_reactions = false, no_forces = false, no_system_elements = false, no_requests = false;
  std::optional<std::int64_t> decimal_places;
  std::string comment;

  using E = WrittenResults;
  static constexpr std::array<Argument<E>, 16> arguments = {{
      {.name = "XRF", .slot = &E::xrf, .help = "the results file in XML"},
      {.name = "DECIMALPLACES",
       .slot = &E::decimal_places,
       .minimum = 1,
       .help = "digits of numbers, 17 unless stated",
       .maximum = 100},
      {.name = "NOLINEAR", .slot = &E::no_linear, .help = "no linear results in the file"},
      {.name = "FORMATTED", .slot = &E::flag, .help = "text, as the file always is"},
      {.name = "UNFORMATTED", .slot = &E::flag},
      {.name = "COMMENT", .slot = &E::comment, .help = "a line at the head of the file"},
      {.name = "NODISPLACEMENTS", .slot = &E::no_displacements},
      {.name = "NOVELOCITIES", .slot = &E::no_velocities},
      {.name = "NOACCELERATIONS", .slot = &E::no_accelerations},
      {.name = "NOAPPLIEDFORCES", .slot = &E::no_forces},
      {.name = "NOREACTIONFORCES", .slot = &E::no_reactions},
      {.name = "NOFLOATINGMARKERS", .slot = &E::flag},
      {.name = "NODATASTRUCTURES", .slot = &E::flag},
      {.name = "NOSYSTEMELEMENTS", .slot = &E::no_system_elements},
      {.name = "NOTIRES", .slot = &E::flag},
      {.name = "NOREQUESTS", .slot = &E::no_requests, .help = "no requests in the file"},
  }};
  // Of floating markers, data structures and tires there is nothing in the file.
  static constexpr std::array<std::string_view, 15> acting = {"XRF",
                                                              "FORMATTED",
                                                              "DECIMALPLACES",
                                                              "NOLINEAR",
                                                              "COMMENT",
                                                              "NODISPLACEMENTS",
                                                              "NOVELOCITIES",
                                                              "NOACCELERATIONS",
                                                              "NOAPPLIEDFORCES",
                                                              "NOREACTIONFORCES",
                                                              "NOFLOATINGMARKERS",
                                                              "NODATASTRUCTURES",
                                                              "NOSYSTEMELEMENTS",
                                                              "NOTIRES",
                                                              "NOREQUESTS"};
  bool check(ElementReader&) const;
  static void remark(std::span<const WrittenResults>, std::span<const ElementLabel>, Diagnostics&);
  void apply(Settings& s) const {
    s.results.xrf = s.results.xrf || xrf;
    const auto take = [](bool& earlier, bool stated) { earlier = earlier || stated; };
    take(s.results.without_linear, no_linear);
    take(s.results.without_displacements, no_displacements), take(s.results.without_velocities, no_velocities);
    take(s.results.without_accelerations, no_accelerations), take(s.results.without_reactions, no_reactions);
    take(s.results.without_forces, no_forces), take(s.results.without_system_elements, no_system_elements);
    take_over(s.results.decimal_places, decimal_places);
  }
};

// What RESULTS lets into the results file.
struct ResultsContents {
  ResultsSettings settings;
  bool requests = true;
  std::string comment;
};
ResultsContents results_contents(const Model&);

}  // namespace dynalin
