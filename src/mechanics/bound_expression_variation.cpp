// Second derivatives: what an expression's rate e′ depends on, and how the generalized forces of its constraint row
// change with the coordinates:
//
//     Q_i = λ g_i,    g_i = Σ_k e_k G_ki,    ∂g_i/∂ξ_j = Σ_k (Σ_l e_kl G_lj) G_ki + Σ_k e_k ∂G_ki/∂ξ_j
//
// with e_k, e_kl the derivatives of the expression by its atoms and G_ki those of atom k along unit displacement i
// (position rows) or unit velocity i (velocity rows) in global axes.
#include "mechanics/bound_expression.h"
#include "mechanics/frame_variations.h"

namespace dynalin {

namespace {

using path::NestedDual;
using Nested = TimeTaylor<NestedDual>;

// A variation of one body: seeds δr, δθ of a path that grows with t^level / level!.
struct Direction {
  BodyId body;
  std::size_t level;
};

// v(t) t^level/level! as coefficients.
Vec3<TimeTaylor<Dual<6>>> grown(const Vec3<TimeTaylor<Dual<6>>>& v, std::size_t level) {
  if (level == 0) return v;
  Vec3<TimeTaylor<Dual<6>>> g;
  for (std::size_t c = 0; c < 3; ++c) {
    g[c] = {Dual<6>(0.0), v[c].value, Dual<6>(2.0) * v[c].rate};
  }
  return g;
}

void set_inner(Vec3<Nested>& v, std::size_t seed, const Vec3<TimeTaylor<Dual<6>>>& direction) {
  for (std::size_t c = 0; c < 3; ++c) {
    v[c].value.partial[seed] = direction[c].value;
    v[c].rate.partial[seed] = direction[c].rate;
    v[c].acceleration.partial[seed] = direction[c].acceleration;
  }
}

Vec3<Nested> lifted(const Vec3<TimeTaylor<Dual<6>>>& v) {
  Vec3<Nested> n;
  for (std::size_t c = 0; c < 3; ++c) {
    n[c].value.value = v[c].value, n[c].rate.value = v[c].rate, n[c].acceleration.value = v[c].acceleration;
  }
  return n;
}

Vec3<TimeTaylor<Dual<6>>> turned(std::size_t axis, const Vec3<TimeTaylor<Dual<6>>>& v) {
  const TimeTaylor<Dual<6>> zero{Dual<6>(0.0), Dual<6>(0.0), Dual<6>(0.0)};
  return axis == 0   ? Vec3<TimeTaylor<Dual<6>>>{zero, -v.z, v.y}
         : axis == 1 ? Vec3<TimeTaylor<Dual<6>>>{v.z, zero, -v.x}
                     : Vec3<TimeTaylor<Dual<6>>>{-v.y, v.x, zero};
}

// The marker frame varied first along `outer`, then, at the varied motion, along `inner`; its origin from the BCS of
// `from`.
Frame<Nested> nested_frame(const Motion& motion, const MarkerFrame& marker, const Direction& inner,
                           const Direction& outer, BodyId from) {
  const MarkerPlace& place = marker.place();
  const Frame<Taylor> plain = marker.frame(motion, from);
  const Vec3<Taylor> arm = marker.arm(motion);

  Vec3<TimeTaylor<Dual<6>>> r = path::constant<6>(plain.origin), varied_arm = path::constant<6>(arm);
  std::array<Vec3<TimeTaylor<Dual<6>>>, 3> axis;
  for (std::size_t c = 0; c < 3; ++c) axis[c] = path::constant<6>(plain.axes[c]);
  if (place.body == outer.body) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector e = unit_vectors[k];
      path::vary(r, k, outer.level, {Taylor(e.x), Taylor(e.y), Taylor(e.z)});
      path::vary(r, 3 + k, outer.level, path::turned(k, arm));
      path::vary(varied_arm, 3 + k, outer.level, path::turned(k, arm));
      for (std::size_t c = 0; c < 3; ++c) path::vary(axis[c], 3 + k, outer.level, path::turned(k, plain.axes[c]));
    }
  }
  Frame<Nested> f{lifted(r), {lifted(axis[0]), lifted(axis[1]), lifted(axis[2])}};
  if (place.body == inner.body) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector e = unit_vectors[k];
      const Vec3<Taylor> unit{Taylor(e.x), Taylor(e.y), Taylor(e.z)};
      set_inner(f.origin, k, grown(path::constant<6>(unit), inner.level));
      set_inner(f.origin, 3 + k, grown(turned(k, varied_arm), inner.level));
      for (std::size_t c = 0; c < 3; ++c) set_inner(f.axes[c], 3 + k, grown(turned(k, axis[c]), inner.level));
    }
  }
  return f;
}

}  // namespace

void BoundExpression::add_reaction_partials(const Motion& motion, Equations& eq, double lambda,
                                            RowLevel row_level) const {
  ExpressionScratch& scratch = eq.scratch;
  const std::size_t n = atoms_.size();
  scratch.taylor_atoms.resize(n);
  scratch.taylor_partials.resize(n);
  // Gradients of every atom by its bodies: level 0 in 0–5, level 1 in 6–11.
  scratch.gradients.resize(4 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const BoundAtom& a = atoms_[k];
    scratch.taylor_atoms[k] = Taylor(atom_value(a, motion), 0.0, 0.0);
    if (a.kind != BoundAtom::Kind::measure) continue;
    for (std::size_t b = 0; b < a.body_count; ++b) {
      scratch.gradients[4 * k + b] = path::varied_measure<12>(a.measure, a.places, motion, a.bodies[b]).value.partial;
    }
  }
  const std::size_t inner_level = row_level == RowLevel::position ? 0 : 1;

  // The variation of the slopes e_k along one coordinate comes as a rate.
  for (std::size_t outer_level = 0; outer_level <= inner_level; ++outer_level) {
    const PartialBy family = outer_level == 0 ? PartialBy::position : PartialBy::velocity;
    if (!eq.wants(family)) continue;
    for (const BodyId outer : bodies_) {
      const BodyBlock& columns = eq.layout().body(outer);
      for (std::int32_t j = 0; j < columns.count; ++j) {
        for (std::size_t l = 0; l < n; ++l) {
          scratch.taylor_atoms[l].rate = gradient(scratch, l, outer, 6 * outer_level + static_cast<std::size_t>(j));
        }
        expression_.evaluate<Taylor>(scratch.taylor_atoms, std::span(scratch.taylor_partials), scratch.taylor);
        for (const BodyId inner : bodies_) {
          const BodyBlock& forces = eq.layout().body(inner);
          for (std::int32_t i = 0; i < forces.count; ++i) {
            double sum = 0;
            for (std::size_t k = 0; k < n; ++k) {
              const double g = gradient(scratch, k, inner, 6 * inner_level + static_cast<std::size_t>(i));
              const double change = scratch.taylor_partials[k].rate;
              if (g != 0.0 && change != 0.0) sum += change * g;
            }
            eq.add(family, forces.offset + i, columns.offset + j, lambda == 0.0 ? 0.0 : -lambda * sum);
          }
        }
      }
    }
    // The variation of the gradients themselves, with the slopes e_k of the last pass.
    if (bodies_.empty()) continue;
    for (std::size_t k = 0; k < n; ++k) {
      const BoundAtom& a = atoms_[k];
      if (a.kind != BoundAtom::Kind::measure || (a.order == 0 && inner_level == 1)) continue;
      const double slope = scratch.taylor_partials[k].value;
      for (std::size_t b = 0; b < a.body_count; ++b) {
        for (std::size_t c = 0; c < a.body_count; ++c) {
          const Direction inner{a.bodies[b], inner_level}, outer{a.bodies[c], outer_level};
          const auto frame = [&](std::size_t m) {
            return nested_frame(motion, a.places[m], inner, outer, a.places[0].place().body);
          };
          const NestedDual m = evaluate_measure<Nested>(a.measure, {frame(0), frame(1), frame(2), frame(3)}).value;
          const BodyBlock &forces = eq.layout().body(inner.body), &columns = eq.layout().body(outer.body);
          for (std::int32_t i = 0; i < forces.count; ++i) {
            for (std::int32_t j = 0; j < columns.count; ++j) {
              const double change = m.partial[static_cast<std::size_t>(i)].partial[static_cast<std::size_t>(j)];
              const double force = lambda * slope;
              eq.add(family, forces.offset + i, columns.offset + j, force == 0.0 ? 0.0 : -force * change);
            }
          }
        }
      }
    }
  }
}

namespace {

// Partials of X and X′ of a measure by δq, δq′ … of one body.
template <std::size_t N>
void add_measure_rate(Measure measure, const std::array<MarkerFrame, 4>& places, const Motion& motion, BodyId body,
                      Equations& eq, std::int32_t row, double by_value, double by_rate, PartialBy velocity_family) {
  const BodyBlock& block = eq.layout().body(body);
  const auto m = path::varied_measure<N>(measure, places, motion, body);
  const std::array families = {PartialBy::position, velocity_family, PartialBy::acceleration};
  for (std::size_t level = 0; 6 * level < N; ++level) {
    for (std::int32_t k = 0; k < block.count; ++k) {
      const std::size_t seed = 6 * level + static_cast<std::size_t>(k);
      const auto times = [](double factor, double gradient) { return factor == 0.0 ? 0.0 : factor * gradient; };
      eq.add(families[level], row, block.offset + k,
             times(by_value, m.value.partial[seed]) + times(by_rate, m.rate.partial[seed]));
    }
  }
}

}  // namespace

void BoundExpression::fill_rates(const Motion& motion, ExpressionScratch& scratch) const {
  using Kind = BoundAtom::Kind;
  scratch.taylor_atoms.resize(atoms_.size());
  scratch.taylor_partials.resize(atoms_.size());
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    const BoundAtom& a = atoms_[k];
    Taylor& x = scratch.taylor_atoms[k] = Taylor(atom_value(a, motion), 0.0, 0.0);
    if (a.kind == Kind::time) x.rate = motion.mode == AnalysisMode::statics ? 0.0 : 1.0;
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
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    const BoundAtom& a = atoms_[k];
    const double by_value = factor * scratch.taylor_partials[k].rate,
                 by_rate = factor * scratch.taylor_partials[k].value;
    if (a.kind == Kind::measure) {
      const std::array families = {PartialBy::position, velocity_family, PartialBy::acceleration};
      for (std::size_t p = 0; p < a.parameter_count; ++p) {
        const auto m = path::measure_by_parameter(a.measure, a.places, motion, a.parameters[p]);
        for (std::size_t level = 0; level <= static_cast<std::size_t>(a.order) + 1; ++level) {
          eq.add(families[level], row, a.parameters[p],
                 by_value * m.value.partial[level] + by_rate * m.rate.partial[level]);
        }
      }
      for (std::size_t b = 0; b < a.body_count; ++b) {
        if (a.order == 0) {
          add_measure_rate<12>(a.measure, a.places, motion, a.bodies[b], eq, row, by_value, by_rate, velocity_family);
        } else {
          add_measure_rate<18>(a.measure, a.places, motion, a.bodies[b], eq, row, by_value, by_rate, velocity_family);
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

double BoundExpression::gradient(const ExpressionScratch& scratch, std::size_t atom, BodyId body,
                                 std::size_t seed) const {
  const BoundAtom& a = atoms_[atom];
  for (std::size_t b = 0; b < a.body_count; ++b) {
    if (a.bodies[b] == body) return scratch.gradients[4 * atom + b][seed];
  }
  return 0;
}

}  // namespace dynalin
