#include "states/original_states.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

// Principal inertias that differ by less than this part of the largest are equal.
constexpr double equal_inertias = 1e-9;
// Frames whose turns differ by less than this are equally near.
constexpr double equal_turns = 1e-9;
// Below this sin θ the angles are taken of the frame with its axes renamed.
constexpr double least_sine = 1e-3;

// The right-handed frame along three orthogonal lines that is turned least from the identity. Lines come by ascending
// inertia, and of frames turned equally the first in the order of permutations stands.
Matrix3 nearest_frame(const std::array<Vector, 3>& line) {
  std::array<std::size_t, 3> at = {0, 1, 2};
  Matrix3 best;
  double best_trace = -1;
  do {
    Matrix3 frame;
    std::size_t weakest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      frame[k] = line[at[k]][k] < 0 ? -line[at[k]] : line[at[k]];
      if (frame[k][k] < frame[weakest][weakest]) weakest = k;
    }
    if (dot(cross(frame.x, frame.y), frame.z) < 0) frame[weakest] = -frame[weakest];
    if (trace(frame) > best_trace + equal_turns) best = frame, best_trace = trace(frame);
  } while (std::next_permutation(at.begin(), at.end()));
  return best;
}

// The same where only one line is given: the least turn that lays x, y or z on it.
Matrix3 nearest_frame(const Vector& line) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(line[k]) > std::abs(line[nearest]) + equal_turns) nearest = k;
  }
  const Vector axis = line[nearest] < 0 ? -line : line;
  const Matrix3 turn = skew(cross(unit_vectors[nearest], axis));
  return Matrix3::identity() + turn + (1 / (1 + axis[nearest])) * (turn * turn);
}

// With the third axis z = (z₁, z₂, cos ϑ) of the frame, s = sin ϑ and the line of nodes n = Z × z/s,
// ω = ψ′ Z + ϑ′ n + φ′ z gives for a rotation δθ
//     δψ = (Z − (z₁, z₂, 0) cos ϑ/s²)·δθ,   δϑ = n·δθ,   δφ = ((z₁, z₂, 0)/s²)·δθ
std::array<Vec3<Taylor>, 3> angle_gradients(const Vec3<Taylor>& z) {
  const Taylor none(0.0);
  const Taylor sine2 = z.x * z.x + z.y * z.y, sine = sqrt(sine2);
  const Taylor x = z.x / sine2, y = z.y / sine2;
  return {{{-(x * z.z), -(y * z.z), Taylor(1.0)}, {-(z.y / sine), z.x / sine, none}, {x, y, none}}};
}

// The same the other way round: how a unit of coordinate k of a body moves its coordinates in the layout, with z the
// third axis of its frame and `arm` from the origin of the BCS to the mass centre.
CandidateSet::Moves moves_of(const BodyBlock& block, std::size_t k, const Vector& z, const Vector& arm) {
  if (k < 3) return {{block.offset + static_cast<std::int32_t>(k), 1.0}};
  const double sine = std::hypot(z.x, z.y);
  const Vector turn = k == 3 ? unit_vectors[2] : k == 4 ? Vector{-z.y / sine, z.x / sine, 0} : z;
  const Vector shift = -cross(turn, arm);  // the mass centre stays
  CandidateSet::Moves moves;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = block.offset + static_cast<std::int32_t>(i);
    if (shift[i] != 0) moves.emplace_back(at, shift[i]);
    if (turn[i] != 0) moves.emplace_back(at + 3, turn[i]);
  }
  return moves;
}

StateCoordinate principal_coordinate(const System& system, const BodyBlock& block, std::int32_t k, bool renamed) {
  static constexpr std::array names = {"DX", "DY", "DZ", "PSI", "THETA", "PHI"};
  StateLabel label;
  label.type = block.listed.states.types.principal;
  label.element = block.label.id;
  label.owner = block.label.element();
  label.coordinate = k + 1;
  label.text = fmt::format("Global {} {}(PBCS{})", k < 3 ? "displacement" : "angle", names[static_cast<std::size_t>(k)],
                           renamed && k >= 3 ? " yzx" : "");
  const StateType type = label.type;
  const int rate = label.coordinate + block.listed.states.rates_behind;
  return state_coordinate(std::move(label), type, rate, system.coordinate_scale(block.offset + k));
}

}  // namespace

Matrix3 principal_axes(const Body& body) {
  const Matrix3 J = transpose(body.R_BI) * body.J_BC * body.R_BI;
  Eigen::Matrix3d tensor;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      tensor(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = 0.5 * (J(r, c) + J(c, r));
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  const Eigen::Vector3d& inertia = solver.eigenvalues();
  const auto line = [&](Eigen::Index k) {
    const Eigen::Vector3d v = solver.eigenvectors().col(k);
    return Vector{v(0), v(1), v(2)};
  };
  const double equal = equal_inertias * inertia.cwiseAbs().maxCoeff();
  const bool lower = inertia(1) - inertia(0) <= equal, upper = inertia(2) - inertia(1) <= equal;
  if (lower && upper) return body.R_BI;
  if (lower || upper) return body.R_BI * nearest_frame(line(lower ? 2 : 0));
  return body.R_BI * nearest_frame({line(0), line(1), line(2)});
}

bool euler_singular(const Vector& z_axis) { return std::hypot(z_axis.x, z_axis.y) < least_sine; }

std::int32_t add_principal_candidates(const System& system, const Motion& motion, std::int32_t row, CandidateSet& set) {
  const Layout& layout = system.layout();
  std::vector<std::size_t> order;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    if (layout.bodies[b].count > 0) order.push_back(b);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return layout.bodies[a].label.id < layout.bodies[b].label.id; });
  const Vec3<Taylor> none{};
  for (const std::size_t b : order) {
    const BodyBlock& block = layout.bodies[b];
    if (block.is_node()) {  // as they are
      for (std::int32_t k = 0; k < block.count; ++k, ++row) {
        const std::int32_t coordinate = block.offset + k;
        set.gradients.set(row, Taylor());
        set.gradients.add_coordinate(row, coordinate, Taylor(1.0));
        set.wanted.push_back({coordinate, -1, global_coordinate(system, block, k)});
        set.moves.push_back({{coordinate, 1.0}});
      }
      continue;
    }
    const Body& body = system.model().bodies[b];
    const BodyId id{static_cast<std::int32_t>(b)};
    const BodyMotion& moving = motion.body(id);
    Matrix3 axes = principal_axes(body);
    const bool renamed = euler_singular(moving.R * axes.z);
    if (renamed) axes = {axes.y, axes.z, axes.x};
    const Frame<Taylor> pbcs = motion.frame({id, body.p_BC, axes});
    const Vec3<Taylor> arm = pbcs.origin - along_motion(moving.r, moving.rdot, moving.rddot);
    const auto angles = angle_gradients(pbcs.axes.z);
    for (std::int32_t k = 0; k < block.count; ++k, ++row) {
      const auto i = static_cast<std::size_t>(k);
      set.gradients.set(row, Taylor());
      if (k < 3) {
        // δ(e·r_C) = e·δr + (arm × e)·δθ
        const Vector& unit = unit_vectors[i];
        const Vec3<Taylor> e{Taylor(unit.x), Taylor(unit.y), Taylor(unit.z)};
        set.gradients.add_pose(row, id, e, cross(arm, e));
      } else {
        set.gradients.add_pose(row, id, none, angles[i - 3]);
      }
      set.wanted.push_back({-1, row, principal_coordinate(system, block, k, renamed)});
      set.moves.push_back(moves_of(block, i, moving.R * axes.z, moving.R * body.p_BC));
    }
  }
  return row;
}

}  // namespace dynalin
