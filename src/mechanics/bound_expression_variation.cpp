// Second derivatives: what an expression's rate e′ depends on, and how the generalized forces of its constraint row
// change with the coordinates:
//
//     Q_i = λ g_i,    g_i = Σ_k e_k G_ki,    ∂g_i/∂ξ_j = Σ_k (Σ_l e_kl G_lj) G_ki + Σ_k e_k ∂G_ki/∂ξ_j
//
// with e_k, e_kl the derivatives of the expression by its atoms and G_ki those of atom k along unit displacement i
// (position rows) or unit velocity i (velocity rows): in global axes those of poses.
#include <algorithm>

#include "mechanics/bound_expression.h"
#include "mechanics/frame_variations.h"

namespace dynalin {

namespace {

using path::NestedDual;
using Varied = TimeTaylor<Dual<6>>;     // along the outer direction
using Nested = TimeTaylor<NestedDual>;  // its inner partials are varied along the outer direction

// A variation of one block: its coordinates as seeds of a path that grows with t^level / level!.
struct Direction {
  CoordinateBlock block;
  std::size_t level;

  bool turns(BodyId body) const { return block.kind == CoordinateBlock::Kind::pose && block.body == body; }
};

Vec3<Taylor> without_variation(const Vec3<Varied>& v) {
  const auto of = [](const Varied& x) { return Taylor(x.value.value, x.rate.value, x.acceleration.value); };
  return {of(v.x), of(v.y), of(v.z)};
}
// The quantity itself, and its inner partial.
Vec3<Varied> itself(const Vec3<Nested>& v) {
  const auto of = [](const Nested& x) { return Varied(x.value.value, x.rate.value, x.acceleration.value); };
  return {of(v.x), of(v.y), of(v.z)};
}
Vec3<Varied> partial(const Vec3<Nested>& v, std::size_t seed) {
  const auto of = [&](const Nested& x) {
    return Varied(x.value.partial[seed], x.rate.partial[seed], x.acceleration.partial[seed]);
  };
  return {of(v.x), of(v.y), of(v.z)};
}
void set_itself(Vec3<Nested>& v, const Vec3<Varied>& x) {
  for (std::size_t c = 0; c < 3; ++c)
    v[c].value.value = x[c].value, v[c].rate.value = x[c].rate, v[c].acceleration.value = x[c].acceleration;
}
void add_partial(Vec3<Nested>& v, std::size_t seed, const Vec3<Varied>& x) {
  for (std::size_t c = 0; c < 3; ++c) {
    v[c].value.partial[seed] += x[c].value;
    v[c].rate.partial[seed] += x[c].rate;
    v[c].acceleration.partial[seed] += x[c].acceleration;
  }
}
void set_partial(Vec3<Nested>& v, std::size_t seed, const Vec3<Varied>& x) {
  for (std::size_t c = 0; c < 3; ++c) {
    v[c].value.partial[seed] = x[c].value;
    v[c].rate.partial[seed] = x[c].rate;
    v[c].acceleration.partial[seed] = x[c].acceleration;
  }
}
Vec3<Nested> lifted(const Vec3<Taylor>& v) {
  Vec3<Nested> n;
  set_itself(n, path::constant<6>(v));
  return n;
}

// v(t) t^level/level! as coefficients.
Vec3<Varied> grown(const Vec3<Varied>& v, std::size_t level) {
  if (level == 0) return v;
  Vec3<Varied> g;
  for (std::size_t c = 0; c < 3; ++c) {
    g[c] = {Dual<6>(0.0), v[c].value, Dual<6>(2.0) * v[c].rate};
  }
  return g;
}

Vec3<Varied> turned(std::size_t axis, const Vec3<Varied>& v) {
  const Varied zero{Dual<6>(0.0), Dual<6>(0.0), Dual<6>(0.0)};
  return axis == 0   ? Vec3<Varied>{zero, -v.z, v.y}
         : axis == 1 ? Vec3<Varied>{v.z, zero, -v.x}
                     : Vec3<Varied>{-v.y, v.x, zero};
}

// A vector that is carried by a body turns with it: along the outer direction, then at the varied motion along the
// inner one.
void turn(Vec3<Nested>& v, const Direction& inner, const Direction& outer, BodyId body) {
  if (outer.turns(body)) {
    const auto varied = [&](Vec3<Varied> x) {
      const Vec3<Taylor> plain = without_variation(x);
      for (std::size_t k = 0; k < 3; ++k) path::vary(x, 3 + k, outer.level, path::turned(k, plain));
      return x;
    };
    for (std::size_t k = 0; k < 6; ++k) set_partial(v, k, varied(partial(v, k)));
    set_itself(v, varied(itself(v)));
  }
  if (inner.turns(body)) {
    for (std::size_t k = 0; k < 3; ++k) add_partial(v, 3 + k, grown(turned(k, itself(v)), inner.level));
  }
}

// Arm and axes of a marker, global axes, as coordinates on the body vary them.
Frame<Nested> nested_on_body(const Motion& motion, const MarkerFrame& marker, const Direction& inner,
                             const Direction& outer) {
  using Of = CoordinateBlock::Kind;
  const MarkerPlace& place = marker.place();
  const auto varies = [&](const Direction& d, Of kind) { return d.block.kind == kind && d.block.moves(marker); };
  const auto part_of = [](Nested& x, std::size_t level) -> NestedDual& {
    return level == 0 ? x.value : level == 1 ? x.rate : x.acceleration;
  };
  // Seeds of a coordinate that moves x by `factor`, k of its block.
  const auto vary_inner = [&](Nested& x, std::size_t k, double factor) {
    part_of(x, inner.level).partial[k] += factor;
  };
  const auto vary_outer = [&](Nested& x, std::size_t k, double factor) {
    part_of(x, outer.level).value.partial[k] += factor;
  };
  NodeMotion<Nested> node;
  if (const NodeShapes* shapes = place.shapes) {
    const NodeMotion<Taylor> unvaried = node_motion(*shapes, motion);
    node = {lifted(unvaried.moved), lifted(unvaried.angle)};
    const auto vary = [&](const Direction& d, const auto& vary_one) {
      for (std::size_t k = 0; varies(d, Of::modal) && k < d.block.count; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          vary_one(node.moved[c], k, shapes->translation[d.block.first_shape + k][c]);
          vary_one(node.angle[c], k, shapes->rotation[d.block.first_shape + k][c]);
        }
      }
    };
    vary(inner, vary_inner), vary(outer, vary_outer);
  }
  Nested u{};
  if (marker.curve) {
    const Taylor along = marker.along_motion(motion);
    u = {NestedDual(along.value), NestedDual(along.rate), NestedDual(along.acceleration)};
    if (varies(inner, Of::curve_parameter)) vary_inner(u, 0, 1.0);
    if (varies(outer, Of::curve_parameter)) vary_outer(u, 0, 1.0);
  }
  const Frame<Nested> local = marker.on_body(node, u);
  const Mat3<Taylor> R = motion.body(place.body).axes();
  const Mat3<Nested> axes{lifted(R.x), lifted(R.y), lifted(R.z)};
  return {axes * local.origin, axes * local.axes};
}

// The marker frame varied first along `outer`, then, at the varied motion, along `inner`; its origin from the BCS of
// `from`.
Frame<Nested> nested_frame(const Motion& motion, const MarkerFrame& marker, const Direction& inner,
                           const Direction& outer, BodyId from) {
  const BodyId body = marker.place().body;
  const Frame<Taylor> plain = marker.frame(motion, from);
  Frame<Nested> f{lifted(plain.origin), {lifted(plain.axes.x), lifted(plain.axes.y), lifted(plain.axes.z)}};
  const auto changes_on_body = [&](const Direction& d) {
    return d.block.kind != CoordinateBlock::Kind::pose && d.block.moves(marker);
  };
  Vec3<Nested> arm = lifted(marker.arm(motion));
  if (changes_on_body(inner) || changes_on_body(outer)) {
    Frame<Nested> own = nested_on_body(motion, marker, inner, outer);
    arm = own.origin, f.axes = own.axes;
  }
  turn(arm, inner, outer, body);
  for (std::size_t c = 0; c < 3; ++c) turn(f.axes[c], inner, outer, body);
  // The origin is where it is, and varies as the arm and the origin of the body do.
  for (std::size_t c = 0; c < 3; ++c) {
    const Taylor at{plain.origin[c]};
    f.origin[c] = arm[c];
    f.origin[c].value.value.value = at.value;
    f.origin[c].rate.value.value = at.rate;
    f.origin[c].acceleration.value.value = at.acceleration;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<Taylor> unit{Taylor(unit_vectors[k].x), Taylor(unit_vectors[k].y), Taylor(unit_vectors[k].z)};
    if (outer.turns(body)) {
      Vec3<Varied> origin = itself(f.origin);
      path::vary(origin, k, outer.level, unit);
      set_itself(f.origin, origin);
    }
    if (inner.turns(body)) add_partial(f.origin, k, grown(path::constant<6>(unit), inner.level));
  }
  return f;
}

}  // namespace

void BoundExpression::add_reaction_partials(const Motion& motion, Equations& eq, double lambda,
                                            RowLevel row_level) const {
  ExpressionScratch& scratch = eq.scratch;
  const std::size_t n = bound_atoms().size();
  scratch.taylor_atoms.resize(n);
  scratch.taylor_partials.resize(n);
  // Gradients of every atom by its blocks: level 0 in 0–5, level 1 in 6–11.
  scratch.gradients.resize(atom_blocks().size());
  for (std::size_t k = 0; k < n; ++k) {
    const BoundAtom& a = bound_atoms()[k];
    scratch.taylor_atoms[k] = Taylor(atom_value(a, motion), 0.0, 0.0);
    if (a.kind != BoundAtom::Kind::measure) continue;
    for (std::size_t b = a.first_block; b < a.first_block + a.block_count; ++b) {
      auto& gradient = scratch.gradients[b];
      if (a.order == 0) {
        const auto by_position = path::varied_displacement(a.measure, a.places, motion, atom_blocks()[b]).partial;
        gradient.fill(0.0);
        std::copy(by_position.begin(), by_position.end(), gradient.begin());
      } else {
        gradient = path::varied_measure<12>(a.measure, a.places, motion, atom_blocks()[b]).value.partial;
      }
    }
  }
  const std::size_t inner_level = row_level == RowLevel::position ? 0 : 1;

  // The variation of the slopes e_k along one coordinate comes as a rate.
  for (std::size_t outer_level = 0; outer_level <= inner_level; ++outer_level) {
    const PartialBy family = outer_level == 0 ? PartialBy::position : PartialBy::velocity;
    if (!eq.wants(family)) continue;
    for (const CoordinateBlock& columns : all_blocks()) {
      for (std::int32_t j = 0; j < columns.count; ++j) {
        for (std::size_t l = 0; l < n; ++l) {
          scratch.taylor_atoms[l].rate = gradient(scratch, l, columns, 6 * outer_level + static_cast<std::size_t>(j));
        }
        expression_.evaluate<Taylor>(scratch.taylor_atoms, std::span(scratch.taylor_partials), scratch.taylor);
        for (const CoordinateBlock& forces : all_blocks()) {
          for (std::int32_t i = 0; i < forces.count; ++i) {
            double sum = 0;
            for (std::size_t k = 0; k < n; ++k) {
              const double g = gradient(scratch, k, forces, 6 * inner_level + static_cast<std::size_t>(i));
              const double change = scratch.taylor_partials[k].rate;
              if (g != 0.0 && change != 0.0) sum += change * g;
            }
            eq.add(family, forces.column + i, columns.column + j, lambda == 0.0 ? 0.0 : -lambda * sum);
          }
        }
      }
    }
    // The variation of the gradients themselves, with the slopes e_k of the last pass.
    if (all_blocks().empty()) continue;
    for (std::size_t k = 0; k < n; ++k) {
      const BoundAtom& a = bound_atoms()[k];
      if (a.kind != BoundAtom::Kind::measure || (a.order == 0 && inner_level == 1)) continue;
      const double slope = scratch.taylor_partials[k].value;
      for (const CoordinateBlock& forces : blocks(a)) {
        for (const CoordinateBlock& columns : blocks(a)) {
          const Direction inner{forces, inner_level}, outer{columns, outer_level};
          const auto frame = [&](std::size_t m) {
            return nested_frame(motion, a.places[m], inner, outer, a.places[0].place().body);
          };
          const auto instant = [&](std::size_t m) { return path::at_instant(frame(m)); };
          const NestedDual m =
              a.order == 0 ? evaluate_measure<NestedDual>(a.measure, {instant(0), instant(1), instant(2), instant(3)})
                           : evaluate_measure<Nested>(a.measure, {frame(0), frame(1), frame(2), frame(3)}).value;
          for (std::int32_t i = 0; i < forces.count; ++i) {
            for (std::int32_t j = 0; j < columns.count; ++j) {
              const double change = m.partial[static_cast<std::size_t>(i)].partial[static_cast<std::size_t>(j)];
              const double force = lambda * slope;
              eq.add(family, forces.column + i, columns.column + j, force == 0.0 ? 0.0 : -force * change);
            }
          }
        }
      }
    }
  }
}

template <std::size_t N>
void BoundExpression::add_measure_rate(const BoundAtom& a, const Motion& motion, const CoordinateBlock& block,
                                       const IntoEquation& into, const Factors& factors) {
  const auto m = path::varied_measure<N>(a.measure, a.places, motion, block);
  const std::array families = {PartialBy::position, into.velocity_family, PartialBy::acceleration};
  for (std::size_t level = 0; 6 * level < N; ++level) {
    for (std::int32_t k = 0; k < block.count; ++k) {
      const std::size_t seed = 6 * level + static_cast<std::size_t>(k);
      const auto times = [](double factor, double gradient) { return factor == 0.0 ? 0.0 : factor * gradient; };
      into.eq.add(families[level], into.row, block.column + k,
                  times(factors.of_value, m.value.partial[seed]) + times(factors.of_rate, m.rate.partial[seed]));
    }
  }
}

void BoundExpression::fill_rates(const Motion& motion, ExpressionScratch& scratch) const {
  using Kind = BoundAtom::Kind;
  scratch.taylor_atoms.resize(bound_atoms().size());
  scratch.taylor_partials.resize(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const BoundAtom& a = bound_atoms()[k];
    Taylor& x = scratch.taylor_atoms[k] = Taylor(atom_value(a, motion), 0.0, 0.0);
    const bool rests = is_equilibrium(motion.mode);
    if (a.kind == Kind::time) x.rate = rests ? 0.0 : 1.0;
    if (a.kind == Kind::measure) x.rate = atom_along_motion(a, motion).rate;
    if (a.kind != Kind::channel) continue;
    const auto n = static_cast<std::size_t>(a.rate.index);
    if (a.rate.kind == Channel::Kind::algebraic) x.rate = motion.algebraic[n];
    if (a.rate.kind == Channel::Kind::state_rate) x.rate = motion.state_rate[n];
  }
}

double BoundExpression::rate(const Motion& motion, ExpressionScratch& scratch) const {
  fill_rates(motion, scratch);
  return expression_.evaluate<Taylor>(scratch.taylor_atoms, scratch.taylor).rate;
}

// δe′ = Σ_k e_k′ δa_k + e_k δa_k′
void BoundExpression::add_rate(const Motion& motion, Equations& eq, std::int32_t row, double factor,
                               PartialBy velocity_family) const {
  using Kind = BoundAtom::Kind;
  ExpressionScratch& scratch = eq.scratch;
  fill_rates(motion, scratch);
  const Taylor e =
      expression_.evaluate<Taylor>(scratch.taylor_atoms, std::span(scratch.taylor_partials), scratch.taylor);
  eq.add_residual(row, factor * e.rate);
  if (!eq.wants_partials()) return;
  const IntoEquation into{eq, row, velocity_family};
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const BoundAtom& a = bound_atoms()[k];
    const double by_value = factor * scratch.taylor_partials[k].rate,
                 by_rate = factor * scratch.taylor_partials[k].value;
    if (a.kind == Kind::measure) {
      for (const CoordinateBlock& block : blocks(a)) {
        if (a.order == 0) {
          add_measure_rate<12>(a, motion, block, into, {by_value, by_rate});
        } else {
          add_measure_rate<18>(a, motion, block, into, {by_value, by_rate});
        }
      }
    } else if (a.kind == Kind::channel) {
      const auto add = [&](const Channel& c, double value) {
        if (c.kind == Channel::Kind::constant) return;
        const PartialBy family = c.kind == Channel::Kind::algebraic ? PartialBy::algebraic
                                 : c.kind == Channel::Kind::state   ? PartialBy::state
                                                                    : PartialBy::state_rate;
        eq.add(family, row, c.index, value);
      };
      add(a.channel, by_value);
      add(a.rate, by_rate);
    }
  }
}

double BoundExpression::gradient(const ExpressionScratch& scratch, std::size_t atom, const CoordinateBlock& block,
                                 std::size_t seed) const {
  const BoundAtom& a = bound_atoms()[atom];
  for (std::size_t b = a.first_block; b < a.first_block + a.block_count; ++b) {
    if (atom_blocks()[b] == block) return scratch.gradients[b][seed];
  }
  return 0;
}

}  // namespace dynalin
