// NFORCE/id, IMARKERS=, J=, {KMATRIX= [, CMATRIX= | CRATIO=] [, LENGTH=] [, FORCE=] | FUNCTION=USER(…)}
//
// A linear force among n markers as seen from J: with Y the 6 n displacements (DX, DY, DZ, AX, AY, AZ)(I_k, J) in the
// axes of J and Y′ their velocities,
//
//     (F_1, T_1, …, F_n, T_n) = FORCE − K (Y − LENGTH) − C Y′
//
// acts on the markers I_k, and on J's body what balances it: the opposite of each at the origin of I_k. K and C are
// MATRIX statements of 6 n × 6 n, LENGTH and FORCE of 6 n × 1. FUNCTION calls a compiled routine of the user for all of
// the 6 n components; each is an algebraic unknown w with w − e = 0.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "elements/controls/matrix.h"
#include "elements/families/called_values.h"
#include "elements/families/defined_unknown.h"
#include "elements/families/linear_wrench.h"
#include "mechanics/binder.h"
#include "mechanics/bound_expression.h"
#include "mechanics/pair_blocks.h"
#include "mechanics/wrench_source.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Nforce {
  std::vector<std::int64_t> ids;
  MarkerId j;
  MatrixRef stiffness, damping, length, force;
  std::optional<double> ratio;
  Expression function;
  std::vector<MarkerId> markers;

  static constexpr std::array<Argument<Nforce>, 8> arguments = {{
      {.name = "IMARKERS",
       .slot = &Nforce::ids,
       .required = true,
       .help = "the markers that the forces act on",
       .ids_of = MarkerClass::statement},
      {.name = "J",
       .slot = &Nforce::j,
       .required = true,
       .help = "marker whose body balances them, and whose axes count"},
      {.name = "KMATRIX", .slot = &Nforce::stiffness, .help = "MATRIX of 6 n × 6 n: stiffness", .ends = "FUNCTION"},
      {.name = "CMATRIX", .slot = &Nforce::damping, .help = "MATRIX of 6 n × 6 n: damping", .ends = "CRATIO"},
      {.name = "CRATIO",
       .slot = &Nforce::ratio,
       .unit = "time",
       .help = "damping as part of the stiffness",
       .ends = "CMATRIX"},
      {.name = "LENGTH", .slot = &Nforce::length, .help = "MATRIX of 6 n × 1: displacements at which FORCE acts"},
      {.name = "FORCE", .slot = &Nforce::force, .help = "MATRIX of 6 n × 1"},
      {.name = "FUNCTION",
       .slot = &Nforce::function,
       .help = "USER(…): a compiled routine gives all forces",
       .ends = "KMATRIX CMATRIX CRATIO LENGTH FORCE"},
  }};
};

// What acts on one marker by the displacement of another: 6 × 6.
struct CoupledBlock {
  std::size_t by;  // of the markers
  std::array<std::array<double, 6>, 6> K, C;
};

struct Law {
  std::vector<MarkerId> markers;
  MarkerId j;
  std::vector<std::vector<CoupledBlock>> blocks{};  // on each marker, those with anything but zeros
  std::vector<double> length{}, force{};
  std::vector<Expression> components{};  // of a routine, in the place of those
};

// Of tables of 6 n × 6 n by columns, C may be empty.
std::vector<std::vector<CoupledBlock>> blocks_of(const std::vector<double>& K, const std::vector<double>& C,
                                                 std::size_t n) {
  std::vector<std::vector<CoupledBlock>> rows(n);
  for (std::size_t l = 0; l < n; ++l) {
    for (std::size_t k = 0; k < n; ++k) {
      CoupledBlock b{l, {}, {}};
      bool any = false;
      for (std::size_t c = 0; c < 6; ++c) {
        for (std::size_t r = 0; r < 6; ++r) {
          const std::size_t at = (6 * l + c) * 6 * n + 6 * k + r;
          b.K[r][c] = K[at], b.C[r][c] = C.empty() ? 0.0 : C[at];
          any = any || b.K[r][c] != 0 || b.C[r][c] != 0;
        }
      }
      if (any) rows[k].push_back(b);
    }
  }
  return rows;
}

// Angles of each marker that have a stiffness in any of the rows; a routine reads by functions of its own.
std::vector<AnglesRead> angles_read(const Law& law) {
  std::vector<AnglesRead> read(law.markers.size());
  for (const auto& row : law.blocks) {
    for (const CoupledBlock& b : row) {
      for (std::size_t c = 0; c < 3; ++c)
        read[b.by][c] = read[b.by][c] || std::ranges::any_of(b.K, [&](const auto& by) { return by[3 + c] != 0; });
    }
  }
  return read;
}

class NforceKernel final : public Kernel, public WrenchSource {
 public:
  NforceKernel(const std::vector<Law>& laws, const std::vector<ElementLabel>& labels, Layout& layout)
      : layout_(layout), labels_(&labels) {
    for (const Law& law : laws) {
      Placed p{law, {}, layout.marker(law.j), {}, {}};
      const std::vector<AnglesRead> angles = angles_read(law);
      for (std::size_t k = 0; k < law.markers.size(); ++k) {
        p.I.push_back(layout.marker(law.markers[k]));
        p.angles.emplace_back(layout, law.markers[k], law.j, angles[k]);
        wrenches_.emplace_back(laws_.size(), k);
      }
      for (std::size_t c = 0; c < law.components.size(); ++c)
        p.components.emplace_back(layout.add_algebraic(labels[laws_.size()], static_cast<std::int32_t>(c) + 1),
                                  law.components[c]);
      laws_.push_back(std::move(p));
    }
  }

  void bind(Binder& binder) override {
    for (Placed& p : laws_) {
      for (DefinedUnknown& c : p.components) c.bind(binder);
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (std::size_t law = 0; law < laws_.size(); ++law) {
      const Placed& p = laws_[law];
      eq.begin_element((*labels_)[law]);
      const std::size_t n = p.I.size();
      for (const DefinedUnknown& c : p.components) c.add_equation(motion, eq);
      PairScratch& at = eq.pair_scratch;
      make_room(p, at);
      for (std::size_t k = 0; k < n; ++k) look(p, k, motion, at);
      for (std::size_t k = 0; k < n; ++k) {
        // The force itself turns with J and its arms move; each marker adds what its displacement changes.
        apply(at.pairs[k], spread(at.pairs[k], total(p, k, motion, at), eq.wanted_partials()), eq);
        if (!eq.wants_partials()) continue;
        for_each_component(p, k, at.pairs[k], [&](std::int32_t column, const Vector& force, const Vector& torque) {
          apply_column(at.pairs[k], force, torque, Reaction::at_I, PartialBy::algebraic, column, eq);
        });
        if (!p.components.empty()) continue;
        for (const CoupledBlock& b : p.law.blocks[k])
          apply_cross_partials(at.pairs[k], at.pairs[b.by], spread(at.pairs[b.by], change(b, at), Partials::yes), eq);
      }
    }
  }

  void undefined_values(const Motion& motion, UndefinedValues& undefined) const override {
    for (std::size_t law = 0; law < laws_.size(); ++law) {
      const Placed& p = laws_[law];
      const ElementLabel& label = (*labels_)[law];
      for (const DefinedUnknown& c : p.components) c.find_undefined(motion, label, undefined);
      for (std::size_t k = 0; k < p.I.size(); ++k) {
        const std::string I = layout_.marker_label(p.law.markers[k]).text();
        if (auto angle = undefined_angle(label, p.angles[k].read(), pair_motion(motion, p.I[k], p.J), I))
          undefined.add(std::move(*angle));
      }
    }
  }

  // A wrench for each marker.
  const WrenchSource* wrenches() const override { return this; }
  std::size_t wrench_count(std::size_t) const override { return wrenches_.size(); }
  std::size_t element_of_wrench(std::size_t w) const override { return wrenches_[w].first; }
  MarkerId marker_I(std::size_t w) const override { return law_of(w).markers[wrenches_[w].second]; }
  MarkerId marker_J(std::size_t w) const override { return law_of(w).j; }
  void wrench(const Motion& motion, std::size_t w, Partials wanted, MarkerWrench& out) const override {
    const auto [at, k] = wrenches_[w];
    const Placed& p = laws_[at];
    PairScratch& all = out.scratch;
    make_room(p, all);
    look(p, k, motion, all);
    if (p.components.empty()) {
      for (const CoupledBlock& b : p.law.blocks[k]) look(p, b.by, motion, all);
    }
    out.pair = all.pairs[k];
    out.force = spread(out.pair, total(p, k, motion, all), wanted);
    if (wanted == Partials::no) return;
    for_each_component(p, k, out.pair, [&](std::int32_t column, const Vector& force, const Vector& torque) {
      out.scalars.push_back({PartialBy::algebraic, column, force, torque});
    });
    if (!p.components.empty()) return;
    for (const CoupledBlock& b : p.law.blocks[k]) {
      const PairForce f = spread(all.pairs[b.by], change(b, all), Partials::yes);
      for_each_block(all.pairs[b.by], layout_, [&](const PairBlock& block) {
        const BlockPartials on = partials_by(block, f);
        for (std::size_t c = 0; c < block.count; ++c) {
          const std::int32_t column = block.column + static_cast<std::int32_t>(c);
          out.scalars.push_back({PartialBy::position, column, on.force[c], on.torque[c]});
          out.scalars.push_back({PartialBy::damping, column, on.force_by_rate[c], on.torque_by_rate[c]});
        }
      });
    }
  }

 private:
  struct Placed {
    Law law;
    std::vector<MarkerPlace> I;
    MarkerPlace J;
    std::vector<CountedAngles> angles;
    std::vector<DefinedUnknown> components{};
  };
  const Law& law_of(std::size_t w) const { return laws_[wrenches_[w].first].law; }
  static void make_room(const Placed& p, PairScratch& at) {
    at.pairs.resize(p.I.size()), at.displacements.resize(p.I.size());
  }
  // Takes the motion of marker k and its displacement.
  static void look(const Placed& p, std::size_t k, const Motion& motion, PairScratch& at) {
    at.pairs[k] = pair_motion(motion, p.I[k], p.J);
    at.displacements[k] = relative_displacement(at.pairs[k], p.angles[k]);
  }
  // What acts on marker k.
  static RelativeWrench total(const Placed& p, std::size_t k, const Motion& motion, const PairScratch& at) {
    RelativeWrench w;
    for (std::size_t r = 0; r < 6 && !p.components.empty(); ++r)
      (r < 3 ? w.force[r] : w.torque[r - 3]) = p.components[6 * k + r].at(motion);
    if (!p.components.empty()) return w;
    for (std::size_t r = 0; r < 6; ++r) {
      double sum = p.law.force[6 * k + r];
      for (const CoupledBlock& b : p.law.blocks[k]) {
        const RelativeDisplacement& d = at.displacements[b.by];
        for (std::size_t c = 0; c < 6; ++c)
          sum -= b.K[r][c] * (d.y[c] - p.law.length[6 * b.by + c]) + b.C[r][c] * d.rate[c];
      }
      (r < 3 ? w.force[r] : w.torque[r - 3]) = sum;
    }
    return w;
  }
  // Of a routine: force and torque on marker k by a unit of each of its components, global axes.
  template <class Visit>
  static void for_each_component(const Placed& p, std::size_t k, const PairMotion& pair, Visit&& visit) {
    if (p.components.empty()) return;
    const Matrix3 R = value(pair.axes_J);
    for (std::size_t r = 0; r < 6; ++r) {
      const Vector e = R[r % 3];
      visit(p.components[6 * k + r].column(), r < 3 ? e : Vector{}, r < 3 ? Vector{} : e);
    }
  }
  // How that changes with the displacement of another marker.
  static RelativeWrench change(const CoupledBlock& b, const PairScratch& at) {
    RelativeWrench w;
    w.depends_on_rate = true;
    const RelativeDisplacement& d = at.displacements[b.by];
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) {
        const double K = b.K[r][c], C = b.C[r][c];
        for (std::size_t i = 0; i < 6; ++i) {
          w.on_pose[r][i] -= K * d.on_pose[c][i] + C * d.rate_on_pose[c][i];
          w.on_rate[r][i] -= C * d.rate_on_rate[c][i];
        }
      }
    }
    return w;
  }

  const Layout& layout_;
  const std::vector<ElementLabel>* labels_;
  std::vector<Placed> laws_;
  std::vector<std::pair<std::size_t, std::size_t>> wrenches_;  // law and marker
};

class NforceSet final : public TypedSet<Nforce> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Nforce& n = elements[k];
    if (!read_arguments(n, reader)) return;
    const std::string name = reader.label().text();
    const bool calls = reader.given("FUNCTION");
    if (calls && n.function.program().routines().empty()) {
      reader.error("unknown-word", reader.at("FUNCTION"),
                   fmt::format("FUNCTION of {} is USER(…), the call of a compiled routine, and no expression", name));
    }
    if (calls == n.stiffness.valid() && !reader.statement().damaged) {
      reader.error(
          calls ? "excluded-arguments" : "missing-argument", calls ? reader.at("KMATRIX") : reader.statement().at,
          calls ? fmt::format("{} takes KMATRIX or FUNCTION, not both", name) : fmt::format("{} needs KMATRIX", name));
    }
    if (n.ratio && n.damping.valid()) {
      reader.error("excluded-arguments", reader.at("CRATIO"),
                   fmt::format("{} takes CMATRIX or CRATIO, not both", name));
    }
    for (const std::int64_t id : n.ids) {
      if (const auto m = reader.marker({id, reader.at("IMARKERS")}, "IMARKERS")) n.markers.push_back(*m);
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Nforce& n = elements[k];
      Law law{n.markers, n.j};
      const std::size_t size = 6 * n.markers.size();
      for (const MarkerId i : n.markers)
        check_pair(model, labels[k], i, n.j, {.rotation_of_I = true, .rotation_of_J = true}, diagnostics);
      const auto take = [&](MatrixRef ref, std::string_view word, std::size_t columns) {
        if (!ref.valid()) return std::vector<double>();
        const Matrix& m = *model.get<Matrix>(ref);
        if (m.rows != size || m.columns != columns) {
          diagnostics.error("wrong-size", labels[k].at,
                            fmt::format("{} of {} must be {} × {}, {} is {} × {}", word, labels[k].text(), size,
                                        columns, model.label(ref).text(), m.rows, m.columns));
          return std::vector<double>(size * columns, 0.0);
        }
        return m.values;
      };
      if (!n.stiffness.valid()) {
        law.components = values_of_routine(n.function, size);
        laws_.push_back(std::move(law));
        continue;
      }
      const std::vector<double> K = take(n.stiffness, "KMATRIX", size);
      std::vector<double> C = take(n.damping, "CMATRIX", size);
      if (n.ratio) {
        C = K;
        for (double& v : C) v *= *n.ratio;
      }
      law.blocks = blocks_of(K, C, n.markers.size());
      law.length = take(n.length, "LENGTH", 1);
      law.force = take(n.force, "FORCE", 1);
      law.length.resize(size, 0.0);
      law.force.resize(size, 0.0);
      const std::vector<AnglesRead> angles = angles_read(law);
      for (std::size_t m = 0; m < n.markers.size() && !diagnostics.has_errors(); ++m)
        warn_of_undefined_angles(model, labels[k], n.markers[m], n.j, angles[m], diagnostics);
      laws_.push_back(std::move(law));
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<NforceKernel>(laws_, labels, layout);
  }

 private:
  std::vector<Law> laws_;
};

ToldToRoutine told_of_nforce(const StatementWords& s) {
  const std::vector<int> markers = s.integers("IMARKERS");
  ToldToRoutine all = told_with(markers, [&](const std::vector<int>& ids) {
    return sAdamsNforce{s.id(),     s.constants().count(), s.constants().data(), static_cast<int>(ids.size()),
                        ids.data(), s.integer("J")};
  });
  all.values = 6 * markers.size();
  return all;
}
constexpr std::array<RoutineKind, 1> nforce_routines = {
    {{.routine = "nfosub", .values = 0, .arguments = RoutineArguments::function, .told = told_of_nforce}}};

}  // namespace

extern constinit const Kind nforce =
    Kind{"NFORCE",
         "",
         "Linear force among several markers as seen from one.",
         Kind::Role::element,
         detail::argument_infos<Nforce>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<NforceSet>(kind); },
         Kind::EnergyRows::each_marker}
        .deactivatable()
        .calling(nforce_routines);

}  // namespace dynalin
