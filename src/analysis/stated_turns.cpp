#include "analysis/stated_turns.h"

#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "mechanics/start_displacement_source.h"
#include "system/sources.h"

namespace dynalin {

namespace {

using Key = std::tuple<std::int32_t, std::int32_t, bool>;  // markers I and J, whether it turns
Key key_of(const StartDisplacements::Term& t) { return {t.i.index, t.j.index, t.turns}; }

// Where the statement says what the last displacement is that is not known yet.
std::optional<std::pair<Key, double>> follows(const StartDisplacements& s, const std::map<Key, double>& known) {
  const StartDisplacements::Term* open = nullptr;
  double rest = s.constant;
  for (const StartDisplacements::Term& t : s.terms) {
    if (t.factor == 0.0) continue;
    const auto q = known.find(key_of(t));
    if (q != known.end()) {
      rest -= t.factor * q->second;
    } else if (open) {
      return std::nullopt;
    } else {
      open = &t;
    }
  }
  if (!open) return std::nullopt;
  return std::pair(key_of(*open), rest / open->factor);
}

}  // namespace

void take_stated_turns(const System& system, const Restated& restated, OperatingPoint& op) {
  if (restated.empty()) return;
  const Motion start = system.motion(op);
  std::vector<StartDisplacements> list;
  for_each_source<StartDisplacementSource>(system, [&](const ElementSet&, const StartDisplacementSource& source) {
    source.start_displacements(start, list);
  });
  std::map<Key, double> known;
  std::erase_if(list, [&](const StartDisplacements& s) {
    if (s.terms.size() != 1) return false;
    const bool holds = s.argument.empty() ? restated.begins(*s.of) : restated.holds(*s.of, s.argument);
    // A MOTION, which follows the joints, drives where an IC only begins.
    if (holds && std::isfinite(s.constant)) known.insert_or_assign(key_of(s.terms.front()), s.constant);
    return true;
  });
  for (bool more = !known.empty(); more;) {
    more = false;
    std::erase_if(list, [&](const StartDisplacements& s) {
      const auto found = follows(s, known);
      if (found) known.insert(*found), more = true;
      return found.has_value();
    });
  }
  for (const CountedAngle& a : system.layout().angles) {
    if (a.measure != Measure::AZ) continue;
    const auto q = known.find(Key{a.i.index, a.j.index, true});
    if (q != known.end()) op.memory[static_cast<std::size_t>(a.memory)] = q->second;
  }
}

}  // namespace dynalin
