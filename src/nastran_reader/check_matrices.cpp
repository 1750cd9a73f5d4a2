#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "nastran_reader/check.h"

namespace dynalin::nastran_reader {

namespace {

class Matrices {
 public:
  Matrices(const Deck& deck, const Points& points, Diagnostics& diagnostics)
      : deck_(deck), points_(points), diagnostics_(diagnostics) {}

  void run() {
    for (const DirectMatrix& m : deck_.matrices) matrix(m);
    std::set<std::string> used;
    for (const auto& [command, uses] : deck_.control.matrices) {
      for (const MatrixUse& u : uses) {
        used.insert(u.name);
        use(command, u);
      }
    }
    const bool any_control = deck_.control.solution != 0;
    for (const DirectMatrix& m : deck_.matrices) {
      if (any_control && !used.contains(m.name))
        diagnostics_.warning("unselected-set", m.at,
                             fmt::format("no command of case control selects the matrix {}", m.name));
    }
    const auto direct = deck_.control.matrices.find("K2PP");
    if (direct != deck_.control.matrices.end() && !direct->second.empty() && deck_.automatic_spc())
      diagnostics_.warning(
          "autospc-on", direct->second[0].at,
          "AUTOSPC is on, looks at the stiffness of elements alone and may hold what K2PP alone makes stiff",
          "PARAM,AUTOSPC,NO");
  }

 private:
  void matrix(const DirectMatrix& m) {
    if (!m.has_header) {
      diagnostics_.error("dmig-header", m.at, fmt::format("the header of the matrix {} is missing", m.name),
                         fmt::format("DMIG,{},0,6,2,0", m.name));
    } else if (m.terms.empty()) {
      diagnostics_.warning("dmig-header", m.at, fmt::format("the matrix {} has no term", m.name));
    }
    if ((m.type == 2 || m.type == 4) && m.without_d)
      diagnostics_.warning("dmig-term", *m.without_d,
                           fmt::format("{} is of double precision, and this term has no D", m.name), "1.0D0");
    std::unordered_map<std::uint64_t, Span> seen;
    for (const DirectMatrix::Term& t : m.terms) {
      const auto row = freedom(t.row, m), column = freedom(t.column, m);
      if (!row || !column) continue;
      const auto key = [](int i, int j) { return static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint32_t>(j); };
      if (const auto [at, is_new] = seen.emplace(key(*row, *column), t.at); !is_new) {
        diagnostics_
            .error("dmig-term", t.at,
                   fmt::format("{}: the term of {} and column {} stands twice", m.name, points_.name(*row),
                               points_.name(*column)))
            .notes.push_back({at->second, "the first one"});
      } else if (m.form == 6 && *row != *column) {
        const auto other = seen.find(key(*column, *row));
        if (other != seen.end())
          diagnostics_
              .error("dmig-term", t.at,
                     fmt::format("{} is symmetric, and the term of {} and {} stands in both triangles", m.name,
                                 points_.name(*row), points_.name(*column)))
              .notes.push_back({other->second, "the other one"});
      }
    }
  }

  std::optional<int> freedom(const Freedom& f, const DirectMatrix& m) {
    const Point* p = points_.find(f.point.id);
    // A column is read once and stands in all its terms: one message is enough.
    const auto tell = [&](std::string_view code, const Span& at, std::string message) {
      if (told_.insert({at.source, at.offset}).second) diagnostics_.error(code, at, std::move(message));
    };
    if (!p) {
      tell("undefined-card-id", f.point.at,
           fmt::format("DMIG {} refers to point {}, which does not exist", m.name, f.point.id));
      return std::nullopt;
    }
    const Span at = f.component_at.source ? f.component_at : f.point.at;
    if (p->scalar && f.component != 0) {
      tell("wrong-component", at, fmt::format("DMIG {}: {} is a scalar point and has component 0", m.name, p->id));
      return std::nullopt;
    }
    const auto found = points_.freedom(f);
    if (!found) tell("wrong-component", at, fmt::format("DMIG {}: a component of GRID {} is missing", m.name, p->id));
    return found;
  }

  void use(const std::string& command, const MatrixUse& u) {
    const auto m = std::find_if(deck_.matrices.begin(), deck_.matrices.end(),
                                [&](const DirectMatrix& d) { return d.name == u.name; });
    if (m == deck_.matrices.end()) {
      diagnostics_.error("case-selection", u.at,
                         fmt::format("{} names the matrix {}, which does not exist", command, u.name));
      return;
    }
    const bool structural = command.ends_with("GG");
    if (!m->has_header) return;
    if (structural && m->form != 6) {
      diagnostics_.error("dmig-header", u.at,
                         fmt::format("{} takes symmetric matrices, IFO 6, and {} has {}", command, u.name, m->form));
    } else if (m->form != 1 && m->form != 6) {
      diagnostics_.error("dmig-header", u.at,
                         fmt::format("{} takes square matrices, IFO 1 or 6, and {} has {}", command, u.name, m->form));
    }
  }

  const Deck& deck_;
  const Points& points_;
  Diagnostics& diagnostics_;
  std::set<std::pair<const SourceText*, std::uint32_t>> told_;
};

}  // namespace

void check_matrices(const Deck& deck, const Points& points, Diagnostics& diagnostics) {
  Matrices(deck, points, diagnostics).run();
}

}  // namespace dynalin::nastran_reader
