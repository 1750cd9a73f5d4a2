#include "elements/families/beam_body.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "elements/families/beam_states.h"

namespace dynalin {

namespace {

// Elements are exact up to half a turn between their ends; the formula of the relative rotation loses digits before.
constexpr double widest_turn = 0.9 * std::numbers::pi;
constexpr double half_a_turn = std::numbers::pi * (1 - 1e-9);
// Of an iteration [rad]: middles turn little against halfway between the ends.
constexpr double largest_middle_step = 0.3;
// What a unit of slope at an end moves of an element, in lengths of it: the largest value of its cubic.
constexpr double slope_reach = 4.0 / 27;

void add(PartialBy family, const BeamMatrix& m, std::size_t coordinates, const BeamColumns& at, Equations& eq) {
  if (!eq.wants(family)) return;
  // Rows in runs that stand next to each other: both poses, both slopes, the middle.
  static constexpr std::array<std::pair<std::size_t, std::size_t>, 5> runs = {
      {{0, 6}, {6, 6}, {12, 3}, {15, 3}, {18, 3}}};
  for (std::size_t c = 0; c < coordinates; ++c) {
    const double* column = m.data() + c * beam_coordinates;
    for (const auto& [first, count] : runs) {
      if (first < coordinates) eq.add(family, at[first], at[c], {column + first, count});
    }
  }
}

// Which of its nodes are turned against each other by this angle or more, empty if none are.
std::string turned_by(double limit, const BeamBody& b, const Motion& motion) {
  for (std::size_t e = 0; e < b.elements->size(); ++e) {
    double turn = (*b.elements)[e]->largest_turn(b.motion(motion, e));
    if (turn < limit) continue;
    if (std::isnan(turn)) turn = half_a_turn;
    // Beyond that the formula says nothing of how far.
    const std::string angle = turn < half_a_turn ? fmt::format("{:.4g} degrees", turn * 180 / std::numbers::pi)
                                                 : std::string("half a turn or more");
    return fmt::format(
        "nodes {} and {} of {} are turned against each other by {}: the beam between them needs more nodes",
        b.numbers[e], b.numbers[e + 1], b.label->full_text(), angle);
  }
  return {};
}

}  // namespace

BeamBodyKernel::BeamBodyKernel(std::vector<BeamBody> beams, const Model& model, Layout& layout)
    : beams_(std::move(beams)), gravity_(model.gravity) {
  static constexpr std::array<char, 3> axes = {'X', 'Y', 'Z'};
  for (const BeamBody& b : beams_) {
    const BeamStates states(b.nodes.size(), b.plane);
    std::vector<ExtraCoordinate> coordinates;
    for (std::size_t k = 0; k < b.nodes.size(); ++k) {
      const auto& elements = *b.elements;
      const double l = elements[std::min(k, elements.size() - 1)]->length();
      const Vector slope = model.body(b.nodes[k]).pose.R.x;
      // In a plane the node turns with its slope, which is like an angle.
      const double speed = b.plane ? 0 : slope_reach * l;
      const auto number = states.of_slope(k);
      for (std::size_t i = 0; i < 3; ++i) {
        coordinates.push_back({.name = fmt::format("Slope S{} of node {}", axes[i], b.numbers[k]),
                               .initial = slope[i],
                               .speed = speed,
                               .number = number[i]});
      }
    }
    for (std::size_t e = 0; !b.plane && e < b.elements->size(); ++e) {
      const auto number = states.of_middle(e);
      for (std::size_t i = 0; i < 3; ++i) {
        coordinates.push_back(
            {.name = fmt::format("Rotation B{} between nodes {} and {}", axes[i], b.numbers[e], b.numbers[e + 1]),
             .largest_step = largest_middle_step,
             .number = number[i]});
      }
    }
    layout.add_extra(*b.label, {StateType::fe_part, ExtraRole::nodal, states.count()}, std::move(coordinates));
  }
  find_coordinates(beams_, layout);
  for (const BeamBody& b : beams_) {
    bodies_.emplace_back(model, layout, b);
    TurningWhole whole{b.nodes, {}};
    for (std::size_t k = 0; k < b.nodes.size(); ++k) whole.vectors.push_back(b.slope(k));
    layout.turning_wholes.push_back(std::move(whole));
    if (b.plane) plane_rows_.emplace_back(b, model, layout);
  }
}

std::vector<const BodySource*> BeamBodyKernel::bodies() const {
  std::vector<const BodySource*> list;
  for (const NodalBody& b : bodies_) list.push_back(&b);
  return list;
}

void BeamBodyKernel::constraints(const Motion& motion, ConstraintRows& rows) const {
  for (const PlaneBeamRows& beam : plane_rows_) beam.constraints(motion, rows);
}

void BeamBodyKernel::equations(const Motion& motion, Equations& eq) const {
  BeamForces f;
  for (const BeamBody& b : beams_) {
    eq.begin_element(eq.layout().body(b.nodes.front()).label);
    for (std::size_t e = 0; e < b.elements->size(); ++e) {
      const auto at = b.columns(eq.layout(), e);
      const BeamElement& element = *(*b.elements)[e];
      const std::size_t n = element.coordinates();
      element.forces(b.motion(motion, e), gravity_, eq.wanted_partials(), f);
      for (std::size_t k = 0; k < n; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        eq.add_residual(at[k], f.elastic(i));
        eq.add_residual(at[k], f.inertia(i));
      }
      if (!eq.wants_partials()) continue;
      add(PartialBy::position, f.stiffness, n, at, eq);
      add(PartialBy::position, f.by_position, n, at, eq);
      if (element.damped()) add(PartialBy::damping, f.damping, n, at, eq);
      add(PartialBy::velocity, f.by_rate, n, at, eq);
      add(PartialBy::acceleration, f.mass, n, at, eq);
    }
  }
  for (const PlaneBeamRows& beam : plane_rows_) beam.equations(motion, eq);
}

std::string BeamBodyKernel::domain_violation(const Motion& motion) const {
  for (const BeamBody& b : beams_) {
    if (std::string reason = turned_by(widest_turn, b, motion); !reason.empty()) return reason;
  }
  return {};
}

// Half a turn has no direction.
void BeamBodyKernel::undefined_values(const Motion& motion, UndefinedValues& undefined) const {
  for (const BeamBody& b : beams_) {
    if (std::string reason = turned_by(half_a_turn, b, motion); !reason.empty())
      undefined.add(UndefinedValue{b.label, std::move(reason)});
  }
}

}  // namespace dynalin
