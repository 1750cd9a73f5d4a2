// OUTPUT, RESULTS and REQUEST as written, in datasets and as commands.
#pragma once

#include "model/schema.h"
#include "model/settings.h"

namespace dynalin {

struct WrittenOutput {
  bool flag = false;
  Obsolete value;

  using E = WrittenOutput;
  static constexpr std::array<Argument<E>, 27> arguments = {{
      {.name = "REQSAVE", .slot = &E::flag},     {.name = "GRSAVE", .slot = &E::flag},
      {.name = "NOREQSAVE", .slot = &E::flag},   {.name = "NOGRSAVE", .slot = &E::flag},
      {.name = "NOPRINT", .slot = &E::flag},     {.name = "PRINT", .slot = &E::flag},
      {.name = "TELETYPE", .slot = &E::flag},    {.name = "OSFORMAT", .slot = &E::flag},
      {.name = "FIXED", .slot = &E::flag},       {.name = "CHART", .slot = &E::value},
      {.name = "NOSEPARATOR", .slot = &E::flag}, {.name = "SEPARATOR", .slot = &E::flag},
      {.name = "DSCALE", .slot = &E::value},     {.name = "DZERO", .slot = &E::value},
      {.name = "VSCALE", .slot = &E::value},     {.name = "VZERO", .slot = &E::value},
      {.name = "ASCALE", .slot = &E::value},     {.name = "AZERO", .slot = &E::value},
      {.name = "FSCALE", .slot = &E::value},     {.name = "FZERO", .slot = &E::value},
      {.name = "YPR", .slot = &E::flag},         {.name = "VPR", .slot = &E::flag},
      {.name = "EULER", .slot = &E::flag},       {.name = "TITLE", .slot = &E::value},
      {.name = "OLDREQ", .slot = &E::flag},      {.name = "DEFAULT", .slot = &E::flag},
      {.name = "LIST", .slot = &E::flag},
  }};
  static constexpr std::array<std::string_view, 1> acting = {"LIST"};
  void apply(Settings&) const {}
};

// RESULTS: XRF asks for the results file in XML; the switches keep parts of its contents out of it.
struct WrittenResults {
  bool xrf = false, no_linear = false, flag = false;
  bool no_displacements = false, no_velocities = false, no_accelerations = false;
  bool no_reactions = false, no_forces = false, no_system_elements = false;
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
      {.name = "FORMATTED", .slot = &E::flag},
      {.name = "UNFORMATTED", .slot = &E::flag},
      {.name = "COMMENT", .slot = &E::comment},
      {.name = "NODISPLACEMENTS", .slot = &E::no_displacements},
      {.name = "NOVELOCITIES", .slot = &E::no_velocities},
      {.name = "NOACCELERATIONS", .slot = &E::no_accelerations},
      {.name = "NOAPPLIEDFORCES", .slot = &E::no_forces},
      {.name = "NOREACTIONFORCES", .slot = &E::no_reactions},
      {.name = "NOFLOATINGMARKERS", .slot = &E::flag},
      {.name = "NODATASTRUCTURES", .slot = &E::flag},
      {.name = "NOSYSTEMELEMENTS", .slot = &E::no_system_elements},
      {.name = "NOTIRES", .slot = &E::flag},
      {.name = "NOREQUESTS", .slot = &E::flag},
  }};
  // What concerns time histories alone needs no word: there are none.
  static constexpr std::array<std::string_view, 14> acting = {"XRF",
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

// REQUEST: time histories, of which there are none here.
struct WrittenRequest {
  bool flag = false;
  std::optional<std::int64_t> i, j, rm;
  Obsolete value;
  std::string text;
  std::vector<std::int64_t> variables;

  using E = WrittenRequest;
  static constexpr std::array<Argument<E>, 26> arguments = {{
      {.name = "DISPLACEMENT", .slot = &E::flag},
      {.name = "VELOCITY", .slot = &E::flag},
      {.name = "ACCELERATION", .slot = &E::flag},
      {.name = "FORCE", .slot = &E::flag},
      {.name = "I", .slot = &E::i},
      {.name = "J", .slot = &E::j},
      {.name = "RM", .slot = &E::rm},
      {.name = "F1", .slot = &E::value},
      {.name = "F2", .slot = &E::value},
      {.name = "F3", .slot = &E::value},
      {.name = "F4", .slot = &E::value},
      {.name = "F5", .slot = &E::value},
      {.name = "F6", .slot = &E::value},
      {.name = "F7", .slot = &E::value},
      {.name = "F8", .slot = &E::value},
      {.name = "FUNCTION", .slot = &E::value},
      {.name = "ROUTINE", .slot = &E::text},
      {.name = "VARIABLES", .slot = &E::variables},
      {.name = "COMMENT", .slot = &E::value},
      {.name = "TITLE", .slot = &E::value},
      {.name = "CNAMES", .slot = &E::value},
      {.name = "CUNITS", .slot = &E::value},
      {.name = "CLABELS", .slot = &E::value},
      {.name = "RESULTS_NAME", .slot = &E::value},
      {.name = "LABEL", .slot = &E::value},
      {.name = "LIST", .slot = &E::flag},
  }};
};

}  // namespace dynalin
