#include "analysis/stated_turns.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "mechanics/start_displacement_source.h"
#include "system/sources.h"

namespace dynalin {

namespace {

using Key = std::tuple<std::int32_t, std::int32_t, bool>;  // markers I and J, whether it turns
Key key_of(const StartDisplacements::Term& t) { return {t.i.index, t.j.index, t.turns}; }

// Displacements that are known, and relations that each say what its last one is once the others are.
class KnownDisplacements {
 public:
  // What is said later of the same holds.
  void state(const Key& of, double displacement) { known_.insert_or_assign(of, displacement); }
  void add(const StartDisplacements& relation) {
    for (const StartDisplacements::Term& t : relation.terms)
      if (t.factor != 0.0) relations_of_[key_of(t)].push_back(relations_.size());
    relations_.push_back(&relation);
  }
  void follow() {
    std::vector<Key> open;
    for (const auto& [key, displacement] : known_) open.push_back(key);
    while (!open.empty()) {
      const auto relations = relations_of_.find(open.back());
      open.pop_back();
      if (relations == relations_of_.end()) continue;
      for (const std::size_t r : relations->second) {
        const auto found = last_of(*relations_[r]);
        if (found && known_.insert(*found).second) open.push_back(found->first);
      }
    }
  }
  std::optional<double> of(const Key& key) const {
    const auto q = known_.find(key);
    return q == known_.end() ? std::nullopt : std::optional(q->second);
  }

 private:
  // The one displacement of a relation that is not known yet.
  std::optional<std::pair<Key, double>> last_of(const StartDisplacements& relation) const {
    const StartDisplacements::Term* last = nullptr;
    double rest = relation.constant;
    for (const StartDisplacements::Term& t : relation.terms) {
      if (t.factor == 0.0) continue;
      if (const auto q = of(key_of(t))) {
        rest -= t.factor * *q;
      } else if (last) {
        return std::nullopt;
      } else {
        last = &t;
      }
    }
    if (!last) return std::nullopt;
    return std::pair(key_of(*last), rest / last->factor);
  }

  std::map<Key, double> known_;
  std::vector<const StartDisplacements*> relations_;
  std::map<Key, std::vector<std::size_t>> relations_of_;
};

}  // namespace

void take_stated_turns(const System& system, const Restated& restated, OperatingPoint& op) {
  if (restated.empty()) return;
  const Motion start = system.motion(op);
  std::vector<StartDisplacements> list;
  for_each_source<StartDisplacementSource>(system, [&](const ElementSet&, const StartDisplacementSource& source) {
    source.start_displacements(start, list);
  });
  KnownDisplacements known;
  for (const StartDisplacements& s : list) {
    if (s.terms.size() != 1) {
      known.add(s);
      continue;
    }
    const bool holds = s.argument.empty() ? restated.begins(*s.of) : restated.holds(*s.of, s.argument);
    // A MOTION, which follows the joints, drives where an IC only begins.
    if (holds && std::isfinite(s.constant)) known.state(key_of(s.terms.front()), s.constant);
  }
  known.follow();
  for (const CountedAngle& a : system.layout().angles) {
    if (a.measure != Measure::AZ) continue;
    if (const auto q = known.of({a.i.index, a.j.index, true})) op.memory[static_cast<std::size_t>(a.memory)] = *q;
  }
}

}  // namespace dynalin
