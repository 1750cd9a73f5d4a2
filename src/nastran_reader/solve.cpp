#include "nastran_reader/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "nastran_reader/check.h"
#include "nastran_reader/quadratic_eigen.h"
#include "nastran_reader/selection.h"

namespace dynalin::nastran_reader {

namespace {

// The same, with errors of one code as warnings.
Diagnostics lowered(const Diagnostics& all, std::string_view code) {
  Diagnostics out;
  for (const Diagnostic& d : all.items()) {
    const bool error = d.severity == Severity::error && d.code != code;
    (error ? out.error(d.code, d.at, d.message, d.hint) : out.warning(d.code, d.at, d.message, d.hint)).notes = d.notes;
  }
  return out;
}

// What Nastran refuses, and what changes no result: which component is dependent.
constexpr std::string_view refused_for_form = "dependent-twice";
// What is right, and nobody solves here.
constexpr std::string_view right_elsewhere = "unassembled-card";

using MapRow = Eigen::SparseVector<double>;

double largest_entry(const MapRow& row) {
  double most = 0;
  for (MapRow::InnerIterator it(row); it; ++it) most = std::max(most, std::abs(it.value()));
  return most;
}

// Elements of which no stiffness is assembled: none may be needed, since all grids move as one rigid body or not at
// all.
void check_undeformed(const Prepared& p, Diagnostics& diagnostics) {
  const auto& T = p.elimination.T;
  const auto motion = [&](const Point& point, int c) { return MapRow(T.row(point.first + c).transpose()); };
  for (const UndeformedElement& e : p.deck.undeformed) {
    if (e.card == "PLOTEL") continue;
    const Point* first = p.points->find(e.grids[0].id);
    MapRow moves[6];
    for (int c = 0; c < 6; ++c) moves[c] = motion(*first, c);
    bool rigid = true;
    for (std::size_t k = 1; k < e.grids.size() && rigid; ++k) {
      const Point* other = p.points->find(e.grids[k].id);
      const Matrix6 map = rigid_map(*first, *other);
      for (int c = 0; c < 6 && rigid; ++c) {
        MapRow expected(T.cols());
        double size = 0;
        for (int j = 0; j < 6; ++j) {
          if (map(c, j) == 0) continue;
          expected += map(c, j) * moves[j];
          size = std::max(size, std::abs(map(c, j)) * largest_entry(moves[j]));
        }
        const MapRow is = motion(*other, c);
        size = std::max(size, largest_entry(is));
        rigid = largest_entry(is - expected) <= 1e-8 * size;
      }
    }
    if (!rigid)
      diagnostics.error("unassembled-card", e.id.at,
                        fmt::format("{} {} can deform, and its stiffness is not assembled here", e.card, e.id.id));
  }
}

void tell_near_redundancy(const Prepared& p, Diagnostics& diagnostics) {
  for (const auto& r : p.elimination.nearly_redundant) {
    const ConstraintRow& row = p.equations.rows[r.row];
    diagnostics.warning("nearly-dependent-row", row.at,
                        fmt::format("{} nearly follows from other constraints: {:.1e} of it is left, which counts",
                                    row.card, r.relative));
  }
}

void tell_untouched(const Prepared& p, const Reduced& reduced, Diagnostics& diagnostics) {
  std::map<int, std::pair<const Point*, std::string>> by_point;
  for (const int f : reduced.untouched) {
    const Point& point = p.points->point_of(f);
    auto& [at, components] = by_point[point.first];
    at = &point;
    if (!point.scalar) components += static_cast<char>('1' + f - point.first);
  }
  for (const auto& [first, entry] : by_point) {
    const auto& [point, components] = entry;
    diagnostics.warning("free-component", point->at,
                        fmt::format("{} {} no mass, damping, stiffness or constraint: taken out",
                                    point->scalar ? fmt::format("SPOINT {}", point->id)
                                                  : fmt::format("GRID {} component {}", point->id, components),
                                    components.size() > 1 ? "have" : "has"),
                        "hold it by SPC; Nastran stops here unless AUTOSPC does");
  }
}

}  // namespace

Prepared prepare(Deck deck, Diagnostics reading, Purpose purpose) {
  Prepared p;
  p.deck = std::move(deck);
  Diagnostics found = std::move(reading);
  if (!p.deck.text.lines.empty()) {
    p.points.emplace(p.deck, found);
    check_references(p.deck, *p.points, found);
    check_constraints(p.deck, *p.points, found);
    check_matrices(p.deck, *p.points, found);
    check_loads(p.deck, *p.points, found);
  }
  if (purpose == Purpose::check) {
    warn_of_unknown(p.deck, found);
    found = lowered(found, right_elsewhere);
  } else {
    check_solvable(p.deck, purpose == Purpose::solve_what_is_known, found);
    found = lowered(found, refused_for_form);
  }
  const bool assemblable = p.points && !lowered(found, refused_for_form).has_errors();
  p.diagnostics = std::move(found);
  if (!assemblable) return p;
  p.equations = assemble(p.deck, *p.points);
  p.elimination = eliminate(p.equations);
  tell_near_redundancy(p, p.diagnostics);
  tell_idle_loads(p, p.diagnostics);
  if (purpose != Purpose::check) check_undeformed(p, p.diagnostics);
  return p;
}

Prepared prepare(const std::string& path, Purpose purpose) {
  Diagnostics reading;
  Deck deck = read_deck(path, reading);
  return prepare(std::move(deck), std::move(reading), purpose);
}

tl::expected<ModeSolution, std::string> solve_modes(const Prepared& p, Diagnostics& diagnostics) {
  if (!p.assembled()) return tl::unexpected(std::string("the deck is wrong"));
  constexpr Eigen::Index most = 20000;  // as dense matrices
  if (p.elimination.T.cols() > most)
    return tl::unexpected(fmt::format("{} independent components are more than {}", p.elimination.T.cols(), most));
  ModeSolution out;
  out.degrees_of_freedom = p.points->freedoms();
  out.reduced = reduce(p.equations, p.elimination);
  tell_untouched(p, out.reduced, diagnostics);
  const Reduced& r = out.reduced;
  out.independent = r.K.rows();
  const Eigen::MatrixXd sizes = r.M.cwiseAbs() + r.B.cwiseAbs() + r.K.cwiseAbs();
  for (Eigen::Index k = 0; k < r.K.rows(); ++k) {
    const bool row = sizes.row(k).any();
    if (row && sizes.col(k).any()) continue;
    const int freedom = p.elimination.independent[static_cast<std::size_t>(r.kept[static_cast<std::size_t>(k)])];
    return tl::unexpected(fmt::format("the matrices are singular for every frequency: the {} of {} is empty",
                                      row ? "column" : "row", p.points->name(freedom)));
  }
  auto found = finite_eigenvalues(r.M, r.B, r.K);
  if (!found) return tl::unexpected(found.error());
  out.eigenvalues = std::move(found->values);
  out.zeros = found->zeros;
  return out;
}

tl::expected<ModeSolution, std::string> solve_modes(const std::string& path) {
  Prepared p = prepare(path, Purpose::solve);
  if (p.diagnostics.has_errors()) return tl::unexpected(render(p.diagnostics));
  return solve_modes(p, p.diagnostics);
}

Eigen::VectorXcd mode_shape(const Prepared& p, const ModeSolution& solution, std::complex<double> eigenvalue) {
  const Reduced& r = solution.reduced;
  const Eigen::VectorXcd q = eigenvector(r.M, r.B, r.K, eigenvalue);
  Eigen::VectorXcd all = Eigen::VectorXcd::Zero(p.elimination.T.cols());
  for (std::size_t k = 0; k < r.kept.size(); ++k) all[r.kept[k]] = q[static_cast<Eigen::Index>(k)];
  Eigen::VectorXcd u = p.elimination.T.cast<std::complex<double>>() * all;
  Eigen::Index at_largest = 0;
  if (u.size() == 0 || u.cwiseAbs().maxCoeff(&at_largest) == 0) return u;
  return u / u[at_largest];
}

}  // namespace dynalin::nastran_reader
