#include <fmt/format.h>

#include <map>
#include <set>

#include "nastran_reader/check.h"
#include "nastran_reader/selection.h"

namespace dynalin::nastran_reader {

namespace {

class LoadChecks {
 public:
  LoadChecks(const Deck& deck, const Points& points, Diagnostics& diagnostics)
      : deck_(deck), points_(points), diagnostics_(diagnostics) {}

  void run() {
    const int solution = deck_.control.solution;
    if (solution == 0 && deck_.control.solution_at.source == nullptr && !deck_.control.sets.empty())
      diagnostics_.warning("case-selection", {}, "the deck names no solution");
    methods(solution == 107);
    frequencies(solution == 108);
    dynamic_loads();
    sums();
    for (const auto& [values, card] :
         {std::pair(&deck_.areas, "DAREA"), std::pair(&deck_.phases, "DPHASE"), std::pair(&deck_.delays, "DELAY")}) {
      for (const FreedomValue& v : *values) check_freedom(v.freedom, card, points_, diagnostics_);
    }
    initial();
    for (const Subcase& s : deck_.control.subcases) subcase(s, solution == 108);
  }

 private:
  void once(std::map<int, Span>& seen, const Reference& id, const char* card) {
    const auto [at, is_new] = seen.emplace(id.id, id.at);
    if (!is_new)
      diagnostics_.error("duplicate-card-id", id.at, fmt::format("{} {} is defined twice", card, id.id))
          .notes.push_back({at->second, "the first one"});
  }

  void methods(bool needed) {
    std::map<int, Span> seen;
    for (const ComplexMethod& m : deck_.methods) once(seen, m.id, "EIGC");
    const auto& selected = deck_.control.cmethod;
    if (selected && !seen.contains(selected->id))
      diagnostics_.error("case-selection", selected->at,
                         fmt::format("CMETHOD = {} selects an EIGC that does not exist", selected->id));
    if (!selected && needed)
      diagnostics_.warning("unselected-set", deck_.control.solution_at,
                           "no CMETHOD selects an EIGC: the solution has no eigenvalues", "CMETHOD = 101");
  }

  void frequencies(bool needed) {
    std::set<int> present;
    for (const Frequencies& f : deck_.frequencies) present.insert(f.set.id);
    const auto& selected = deck_.control.frequency;
    if (selected && !present.contains(selected->id)) {
      diagnostics_.error("case-selection", selected->at,
                         fmt::format("FREQUENCY = {} selects frequencies that do not exist", selected->id));
    } else if (!selected && needed) {
      diagnostics_.error("case-selection", deck_.control.solution_at, "SOL 108 needs FREQUENCY = in case control");
    }
  }

  void dynamic_loads() {
    std::map<int, Span> tables;
    for (const Table& t : deck_.tables) once(tables, t.id, "TABLED1");
    std::set<int> excited, delayed, phased;
    for (const PointLoad& l : deck_.point_loads) excited.insert(l.set.id);
    for (const FreedomValue& v : deck_.areas) excited.insert(v.set.id);
    for (const FreedomValue& v : deck_.delays) delayed.insert(v.set.id);
    for (const FreedomValue& v : deck_.phases) phased.insert(v.set.id);
    const auto need = [&](const Reference& r, bool there, const char* card) {
      if (r.id > 0 && !there)
        diagnostics_.error("undefined-card-id", r.at,
                           fmt::format("RLOAD1 refers to {} {}, which does not exist", card, r.id));
    };
    for (const DynamicLoad& l : deck_.dynamic_loads) {
      once(loads_, l.id, "RLOAD1");
      need(l.excitation, excited.contains(l.excitation.id), "loads of set");
      need(l.delay.card, delayed.contains(l.delay.card.id), "DELAY");
      need(l.phase.card, phased.contains(l.phase.card.id), "DPHASE");
      need(l.real_part.card, tables.contains(l.real_part.card.id), "TABLED1");
      need(l.imaginary_part.card, tables.contains(l.imaginary_part.card.id), "TABLED1");
    }
  }

  void sums() {
    for (const LoadSum& s : deck_.load_sums) {
      once(sums_, s.id, "DLOAD");
      if (const auto same = loads_.find(s.id.id); same != loads_.end())
        diagnostics_.error("load-rules", s.id.at, fmt::format("DLOAD {} has the number of an RLOAD1", s.id.id))
            .notes.push_back({same->second, "the RLOAD1"});
      std::set<int> parts;
      for (const auto& [factor, r] : s.parts) {
        if (!loads_.contains(r.id))
          diagnostics_.error("undefined-card-id", r.at,
                             fmt::format("DLOAD refers to RLOAD1 {}, which does not exist", r.id));
        if (!parts.insert(r.id).second)
          diagnostics_.error("load-rules", r.at, fmt::format("DLOAD {} names RLOAD1 {} twice", s.id.id, r.id));
      }
    }
  }

  // Initial conditions belong to what moves freely.
  void initial() {
    std::set<int> dependent;
    for (const DependentFreedom& d : dependent_freedoms(deck_, points_)) dependent.insert(d.freedom);
    std::map<std::pair<int, int>, Span> seen;
    for (const FreedomValue& v : deck_.initial) {
      const auto f = points_.freedom(v.freedom);
      if (!f) continue;
      if (!deck_.automatic_dependents() && dependent.contains(*f))
        diagnostics_.warning(
            "dependent-twice", v.freedom.point.at,
            fmt::format("TIC: {} is dependent and has no initial condition of its own", points_.name(*f)));
      const auto [at, is_new] = seen.emplace(std::pair(v.set.id, *f), v.freedom.point.at);
      if (!is_new)
        diagnostics_
            .error("duplicate-card-id", v.freedom.point.at, fmt::format("TIC: {} stands twice", points_.name(*f)))
            .notes.push_back({at->second, "the first one"});
    }
  }

  void subcase(const Subcase& s, bool response) {
    if (s.dload) {
      if (!loads_.contains(s.dload->id) && !sums_.contains(s.dload->id))
        diagnostics_.error("case-selection", s.dload->at,
                           fmt::format("DLOAD = {} selects a load that does not exist", s.dload->id));
    } else if (response) {
      diagnostics_.warning("unselected-set", s.at.source ? s.at : deck_.control.solution_at,
                           s.id ? fmt::format("no DLOAD acts in SUBCASE {}", s.id) : std::string("no DLOAD acts"));
    }
    if (s.displacement && s.displacement->kind == OutputRequest::Kind::set &&
        !deck_.control.sets.contains(s.displacement->set.id))
      diagnostics_.error("case-selection", s.displacement->set.at,
                         fmt::format("DISP = {} names a SET that does not exist", s.displacement->set.id));
  }

  const Deck& deck_;
  const Points& points_;
  Diagnostics& diagnostics_;
  std::map<int, Span> loads_, sums_;
};

}  // namespace

void check_loads(const Deck& deck, const Points& points, Diagnostics& diagnostics) {
  LoadChecks(deck, points, diagnostics).run();
}

}  // namespace dynalin::nastran_reader
