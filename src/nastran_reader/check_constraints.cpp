#include <fmt/format.h>

#include <Eigen/LU>
#include <map>
#include <set>

#include "nastran_reader/check.h"
#include "nastran_reader/equations.h"
#include "nastran_reader/selection.h"

namespace dynalin::nastran_reader {

namespace {

class Constraints {
 public:
  Constraints(const Deck& deck, const Points& points, Diagnostics& diagnostics)
      : deck_(deck), points_(points), diagnostics_(diagnostics) {}

  void run() {
    for (const Mpc& m : deck_.mpcs) {
      for (const Mpc::Term& t : m.terms) check_freedom(t.freedom, "MPC", points_, diagnostics_);
    }
    for (const Spc& s : deck_.spcs) spc(s);
    for (const FreedomValue& v : deck_.initial) check_freedom(v.freedom, "TIC", points_, diagnostics_);
    for (const RigidElement& r : deck_.rigid) {
      if (r.kind == RigidElement::Kind::bar) bar(r);
    }
    std::set<int> mpc_sets, spc_sets;
    for (const Mpc& m : deck_.mpcs) mpc_sets.insert(m.set.id);
    for (const Spc& s : deck_.spcs) spc_sets.insert(s.set.id);
    selection("MPC", deck_.control.mpc, deck_.mpc_sums, mpc_sets, deck_.mpcs.empty() ? Span{} : deck_.mpcs[0].at);
    selection("SPC", deck_.control.spc, deck_.spc_sums, spc_sets, deck_.spcs.empty() ? Span{} : deck_.spcs[0].at);
    if (!deck_.automatic_dependents()) dependents();
  }

 private:
  void spc(const Spc& s) {
    if (s.last == 0 && !points_.find(s.point.id))
      diagnostics_.error("undefined-card-id", s.point.at,
                         fmt::format("SPC refers to point {}, which does not exist", s.point.id));
    for (const Point* p : held_points(s, points_)) {
      if (p->scalar ? s.components <= 1 : s.components != 0) continue;
      diagnostics_.error("wrong-component", s.components_at,
                         p->scalar ? fmt::format("SPC: {} is a scalar point, which has component 0 alone", p->id)
                                   : fmt::format("SPC: the components of GRID {} are missing", p->id));
      return;
    }
  }

  // Whether the independent components of a bar tell its motion.
  void bar(const RigidElement& r) {
    const Point *a = points_.find(r.a.id), *b = points_.find(r.dependent[0].id);
    if (!a || !b || a->scalar || b->scalar) return;
    Matrix6 free;
    const Matrix6 at_a = Matrix6::Identity(), at_b = rigid_map(*a, *b);
    Eigen::Index row = 0;
    const double arm = std::max((a->position - b->position).norm(), 1e-30);
    for (int k = 0; k < 12; ++k) {
      if (!((k < 6 ? r.free_a : r.free_b) >> (k % 6) & 1)) continue;
      free.row(row++) = k < 6 ? at_a.row(k) : at_b.row(k - 6);
    }
    // Rotations by the length of the bar compare with translations.
    Matrix6 scaled = free;
    scaled.rightCols(3) /= arm;
    for (Eigen::Index k = 0; k < 6; ++k) scaled.row(k) /= std::max(scaled.row(k).cwiseAbs().maxCoeff(), 1e-300);
    if (Eigen::FullPivLU<Matrix6>(scaled).setThreshold(1e-9).rank() < 6)
      diagnostics_.error("wrong-component", r.components_at,
                         fmt::format("RBAR {}: its independent components do not tell how it moves", r.id.id));
  }

  void selection(const char* card, const std::optional<Selected>& selected, const std::vector<SetSum>& sums,
                 const std::set<int>& present, const Span& first) {
    for (const SetSum& s : sums) {
      for (const Reference& r : s.of) {
        if (!present.contains(r.id))
          diagnostics_.error("undefined-card-id", r.at,
                             fmt::format("{}ADD {} names set {}, which has no {}", card, s.set.id, r.id, card));
      }
      if (present.contains(s.set.id))
        diagnostics_.error("duplicate-card-id", s.set.at,
                           fmt::format("{}ADD {} has the number of a set of {} cards", card, s.set.id, card));
    }
    if (!selected) {
      if (!present.empty() && (!deck_.control.subcases.empty() || deck_.control.solution))
        diagnostics_.warning(
            "unselected-set", first,
            fmt::format("no {} = in case control selects a set of {} cards: none of them counts", card, card),
            fmt::format("{} = {}", card, *present.begin()));
      return;
    }
    bool found = present.contains(selected->id);
    for (const SetSum& s : sums) found = found || s.set.id == selected->id;
    if (!found)
      diagnostics_.error("case-selection", selected->at,
                         fmt::format("{} = {} selects a set that does not exist", card, selected->id));
  }

  void dependents() {
    std::map<int, DependentFreedom> seen;
    std::set<int> held;
    const std::set<int> sets = sets_of(deck_.control.spc, deck_.spc_sums);
    const auto hold = [&](const Point& p, Components components) {
      for (int c = 0; c < (p.scalar ? 1 : 6); ++c) {
        if (p.scalar || (components >> c & 1)) held.insert(p.first + c);
      }
    };
    for (const Point& p : points_.all()) {
      if (p.fixed) hold(p, p.fixed);
    }
    for (const Spc& s : deck_.spcs) {
      if (!sets.contains(s.set.id)) continue;
      for (const Point* p : held_points(s, points_)) hold(*p, s.components);
    }
    for (const DependentFreedom& d : dependent_freedoms(deck_, points_)) {
      const auto [at, is_new] = seen.emplace(d.freedom, d);
      const std::string hint = "PARAM,AUTOMSET,YES lets the program choose what is dependent";
      if (!is_new)
        diagnostics_
            .error("dependent-twice", d.at,
                   fmt::format("{} is dependent by {} and by {}", points_.name(d.freedom), d.card, at->second.card),
                   hint)
            .notes.push_back({at->second.at, "the first one"});
      if (held.contains(d.freedom))
        diagnostics_.error("dependent-twice", d.at,
                           fmt::format("{} is dependent by {} and held by SPC or PS", points_.name(d.freedom), d.card),
                           hint);
    }
  }

  const Deck& deck_;
  const Points& points_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_constraints(const Deck& deck, const Points& points, Diagnostics& diagnostics) {
  Constraints(deck, points, diagnostics).run();
}

}  // namespace dynalin::nastran_reader
