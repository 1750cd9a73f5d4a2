// Small decks made by hand, with a card of every kind.
#pragma once

#include "nastran/deck.h"
#include "nastran/ids.h"

namespace dynalin::nastran {

inline Owner of_body(std::int32_t body, std::string name) { return {body, std::move(name)}; }

// Two parts on a hinge, a bushing and a differential state.
inline Deck sample_open_deck() {
  Deck d;
  d.open = true;
  d.time = 0.5;
  d.states = 5;
  d.bodies = {{"model.PART_2", 2}, {"model.PART_3", 3}};
  d.grids = {
      {of_body(-1, "ground"), 1, {0, 0, 0}, 0, "123456"},
      {of_body(0, "centre of mass of model.PART_2"), 2, {1.0 / 3, -2.5, 0}, 0, ""},
      {of_body(1, "centre of mass of model.PART_3"), 3, {1e-7, 1250, -0.125}, 0, ""},
      {of_body(0, "model.PART_2.MARKER_21"), 1000021, {0, 0, 1}, 100, ""},
      {of_body(-1, "model.ground.MARKER_1"), 1000001, {0, 0, 1}, 100, "123456"},
      {of_body(1, "model.PART_3.MARKER_31"), 1000031, {0, 10, 0}, 0, ""},
      {of_body(1, "nothing has this"), 1000099, {7, 7, 7}, 0, ""},
  };
  d.scalar_points = {
      {of_body(-1, "TFSISO/1"), 3000001}, {of_body(-1, "TFSISO/1"), 3000002}, {of_body(-1, "DIFF/4"), 3000004}};
  const double s = 0.6, c = 0.8;
  d.systems = {{of_body(0, "axes of model.PART_2.MARKER_21"), 100, {0, 0, 1}, {{c, s, 0}, {-s, c, 0}, {0, 0, 1}}}};
  d.masses = {
      {of_body(0, "model.PART_2"), 1, 2, 12.5, {{4, 0.5, -0.25}, {0.5, 5, 0.125}, {-0.25, 0.125, 6}}},
      {of_body(1, "model.PART_3"), 2, 3, 1e-3, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
  };
  d.rigid_joints = {{of_body(-1, "model.JOINT_1"), 3, 1000001, 1000021, "12345"}};
  d.rigid_elements = {{of_body(0, "model.PART_2"), 4, 2, {1000021}}, {of_body(1, "model.PART_3"), 5, 3, {1000031}}};
  d.relations = {
      {of_body(-1, "model.JOINT_2"), {{{2, 1}, 0.5}, {{3, 1}, -2}, {{3000004, 0}, 1.0 / 7}, {{2, 1}, 0.25}}},
      {of_body(-1, "model.JOINT_2"), {{{3, 6}, -4}}},
      {of_body(-1, "model.JOINT_3"), {{{3, 2}, 1}, {{2, 2}, -1}, {{2, 5}, 3}}},
  };
  d.fixed_points = {{of_body(1, "model.PART_3"), 3, "45"}};
  d.bushes = {
      {of_body(-1, "model.BUSHING_1"),
       6000000,
       6000000,
       1000031,
       1000021,
       100,
       1,
       {1e4, 2e4, 3e4, 0, 0, 5},
       {10, 20, 30, 0, 0, 0}},
      {of_body(-1, "model.FIELD_2"), 6000001, 6000001, 1000031, 0, 0, 0.5, {}, {}},
  };
  Matrix k{of_body(-1, "all forces"), MatrixKind::K, "VVV", {}};
  k.entries = {{{2, 1}, {2, 1}, 100},     {{2, 1}, {3, 1}, -40}, {{3, 1}, {2, 1}, -50},
               {{3, 1}, {3, 1}, 1.0 / 3}, {{3, 1}, {3, 1}, 45},  {{2, 6}, {2, 1}, 2e-9}};
  Matrix b{of_body(-1, "differential states"), MatrixKind::B, "ZZZ", {}};
  b.entries = {{{3000001, 0}, {3000001, 0}, 1}, {{3000002, 0}, {3000002, 0}, 1}, {{3000004, 0}, {3000004, 0}, 1}};
  Matrix empty{of_body(-1, "SFORCE/9"), MatrixKind::B, "SF9", {{{2, 1}, {2, 1}, 0}}};
  d.matrices = {k, b, empty};
  d.initial_states = {{of_body(0, "model.PART_2"), {2, 1}, 0, -1.5}, {of_body(-1, "DIFF/4"), {3000004, 0}, 2, 0}};
  for (std::int64_t g = 0; g < 4; ++g)
    d.shape_grids.push_back(
        {of_body(1, "model.BOX_1"), 4000000 + g, {static_cast<double>(g % 2), static_cast<double>(g / 2), 0}, 0, ""});
  d.shape_ties = {{of_body(1, "model.BOX_1"), 6, 3, {4000000, 4000001, 4000002, 4000003}}};
  d.shells = {{of_body(1, "model.BOX_1"), 7, 1, {4000000, 4000001, 4000003, 4000002}},
              {of_body(1, "model.EXTERNAL_1"), 8, 1, {4000000, 4000001, 4000002}}};
  d.lines = {{of_body(1, "model.OUTLINE_1"), 9, 0, 4000000, 4000001},
             {of_body(1, "model.OUTLINE_1"), 10, 2, 4000001, 4000002}};
  d.shape_properties = {{of_body(1, ""), 1, 1000, false, 0.01}, {of_body(1, ""), 2, 1000, true, 1e-4}};
  d.mode_points = {2, 3, 3000004};
  d.modes = {{{-0.1719612345, 6.601065}, {}}, {{12.5, 0}, {}}};
  for (DeckMode& mode : d.modes) {
    for (int p = 0; p < 3; ++p) {
      mode.shape.emplace_back();
      for (std::size_t k2 = 0; k2 < (p < 2 ? 6u : 1u); ++k2)
        mode.shape.back()[k2] = {mode.eigenvalue[0] * static_cast<double>(k2 + 1), -1e-12 * static_cast<double>(p)};
    }
  }
  d.inputs = {{0, 1000021, 100}, {1, 1000031, 0}};
  d.outputs = {{0, 1000031}, {1, 2}};
  return d;
}

// Two states with full matrices.
inline Deck sample_closed_deck() {
  Deck d;
  d.states = 4;
  d.grids = {{of_body(-1, "ground"), 1, {0, 0, 0}, 0, "123456"}, {of_body(-1, "MARKER/21"), 4, {0, 0, 1}, 100, ""}};
  d.scalar_points = {{of_body(-1, ""), 2}, {of_body(-1, ""), 3}};
  d.systems = {{of_body(-1, "MARKER/21"), 100, {0, 0, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  d.relations = {{of_body(-1, "MARKER/21"), {{{4, 1}, 1}, {{2, 0}, -4}}},
                 {of_body(-1, "MARKER/21"), {{{4, 2}, 1}, {{3, 0}, -0.5}}}};
  d.fixed_points = {{of_body(-1, "MARKER/21"), 4, "3456"}};
  const auto entry = [](std::int64_t i, std::int64_t j, double v) { return Matrix::Entry{{i, 0}, {j, 0}, v}; };
  d.matrices = {
      {of_body(-1, ""),
       MatrixKind::K,
       "VVV",
       {entry(2, 2, 300), entry(2, 3, -120), entry(3, 2, -100), entry(3, 3, 100)}},
      {of_body(-1, ""), MatrixKind::B, "VVV", {entry(2, 2, 3), entry(2, 3, -1.5), entry(3, 2, -1), entry(3, 3, 1)}},
      {of_body(-1, ""), MatrixKind::M, "VVV", {entry(2, 2, 2), entry(3, 3, 1)}},
  };
  d.inputs = {{0, 4, 100}, {1, 4, 0}};
  d.outputs = {{0, 4}, {1, 4}};
  return d;
}

inline const char* sample_response =
    "solution_number = 108\nbegin_frequency = 1.0\nend_frequency = 1000\nsteps_frequency = 20\n"
    "actuator_swept_sine { name = act1 magnitude = 2.2 phase_angle = 45D }\nactuator_swept_sine { name = act2 }\n"
    "force_input_channel { name = inp1 marker_id = 21 dof = Y actuator_name = act1 }\n"
    "force_input_channel { name = inp2 marker_id = 31 dof = RZ actuator_name = act2 mode = global }\n"
    "displacement_output_channel { name = out1 marker_id = 31 }\n"
    "displacement_output_channel { name = out2 marker_id = 20 }\n"
    "frequency_response_subcase { number = 200 input_channel_names = inp1 output_channel_names = out1 }\n"
    "frequency_response_subcase { number = 100 input_channel_names = inp1, inp2 output_channel_names = out1, out2 }\n";

}  // namespace dynalin::nastran
