#include "reduction/direct_matrices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "dataset/characters.h"
#include "nastran_reader/deck.h"

namespace dynalin::reduction {

namespace {

using nastran_reader::Deck;
using nastran_reader::DirectMatrix;

// Both triangles agree to this much of the geometric mean of the diagonal.
constexpr double symmetric_to = 1e-8;

Freedom freedom_of(const nastran_reader::Freedom& f) { return {f.point.id, f.component}; }

// A deck and where its places are in the text that the caller holds.
class Punched {
 public:
  Punched(const SourceText& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {
    Diagnostics found;
    deck_ = nastran_reader::deck_of_text(file.name(), std::string(file.text()), found);
    for (const Diagnostic& d : found.items()) {
      if (d.severity == Severity::error) diagnostics.error(d.code, here(d.at), d.message, d.hint);
    }
  }

  const DirectMatrix* find(const std::string& name, char initial, std::string_view what) {
    std::vector<const DirectMatrix*> found;
    for (const DirectMatrix& m : deck_.matrices) {
      const bool meant = name.empty() ? m.name[0] == initial && !m.name.starts_with("K4") : m.name == upper_case(name);
      if (meant) found.push_back(&m);
    }
    if (found.size() == 1) return found[0];
    std::string names;
    for (const DirectMatrix& m : deck_.matrices) names += (names.empty() ? "" : ", ") + m.name;
    diagnostics_.error(
        "fe-matrix-missing", Span{&file_, 0, 0},
        found.empty() ? fmt::format("{} has no matrix of {}", file_.name(), what)
                      : fmt::format("{} has {} matrices that may be the {}", file_.name(), found.size(), what),
        names.empty() ? std::string("it has no DMIG") : fmt::format("it has {}; say which one is meant", names));
    return nullptr;
  }

  bool check(const DirectMatrix& m) {
    const auto refuse = [&](std::string_view why) {
      diagnostics_.error("fe-matrix-header", here(m.at), fmt::format("{} {}", m.name, why),
                         "DMIG,KAAX,0,6,1,0 begins a real symmetric matrix");
      return false;
    };
    if (!m.has_header) return refuse("has no header");
    if (m.form != 6 && m.form != 1) return refuse("is not square");
    if (m.type > 2) return refuse("is complex");
    if (m.terms.empty()) return refuse("has no entries");
    return true;
  }

  std::optional<SparseMatrix> build(const DirectMatrix& m, const std::map<Freedom, int>& rows, std::vector<Span>& at) {
    struct Term {
      int row, column;
      double value;
      const DirectMatrix::Term* from;
    };
    std::vector<Term> terms;
    for (const DirectMatrix::Term& t : m.terms) {
      const int row = rows.at(freedom_of(t.row)), column = rows.at(freedom_of(t.column));
      if (!std::isfinite(t.value)) {
        diagnostics_.error("fe-matrix-entry", here(t.at), fmt::format("an entry of {} is not a finite number", m.name));
        return std::nullopt;
      }
      terms.push_back({std::max(row, column), std::min(row, column), t.value, &t});
    }
    std::stable_sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) {
      return std::pair(a.column, a.row) < std::pair(b.column, b.row);
    });
    std::vector<double> diagonal(rows.size(), 0.0);
    at.assign(rows.size(), here(m.at));
    for (const Term& t : terms) {
      if (t.row != t.column) continue;
      diagonal[static_cast<std::size_t>(t.row)] = std::abs(t.value);
      at[static_cast<std::size_t>(t.row)] = here(t.from->at);
    }
    std::vector<Eigen::Triplet<double, std::int32_t>> triplets;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const Term& t = terms[k];
      // An entry may stand in both triangles, and then twice the same.
      if (k > 0 && terms[k - 1].row == t.row && terms[k - 1].column == t.column) {
        const Term& before = terms[k - 1];
        const double scale =
            std::sqrt(diagonal[static_cast<std::size_t>(t.row)] * diagonal[static_cast<std::size_t>(t.column)]);
        const bool same_place = freedom_of(before.from->row) == freedom_of(t.from->row);
        if (!same_place && std::abs(t.value - before.value) <= symmetric_to * scale) continue;
        diagnostics_.error(same_place ? "fe-matrix-entry" : "fe-matrix-unsymmetric", here(t.from->at),
                           same_place ? fmt::format("an entry of {} is given twice", m.name)
                                      : fmt::format("{} has {:.6g} here and {:.6g} in the other triangle", m.name,
                                                    t.value, before.value),
                           "stiffness and mass are symmetric");
        return std::nullopt;
      }
      // A square matrix says both triangles.
      const bool again = k + 1 < terms.size() && terms[k + 1].row == t.row && terms[k + 1].column == t.column;
      if (m.form == 1 && t.row != t.column && t.value != 0 && !again) {
        diagnostics_.error(
            "fe-matrix-unsymmetric", here(t.from->at),
            fmt::format("{}, a square matrix, has {:.6g} here and nothing in the other triangle", m.name, t.value),
            "form 6 in its header is a symmetric matrix, of which one triangle is stated");
        return std::nullopt;
      }
      triplets.emplace_back(t.row, t.column, t.value);
      if (t.row != t.column) triplets.emplace_back(t.column, t.row, t.value);
    }
    const auto n = static_cast<Eigen::Index>(rows.size());
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  }

 private:
  Span here(const Span& at) const {
    const SourceText* copy = deck_.text.sources.empty() ? nullptr : deck_.text.sources[0].get();
    return at.source && at.source == copy ? Span{&file_, at.offset, at.length} : Span{&file_, 0, 0};
  }

  const SourceText& file_;
  Diagnostics& diagnostics_;
  Deck deck_;
};

}  // namespace

std::optional<DirectMatrices> read_direct_matrices(const SourceText& stiffness, const std::string& stiffness_name,
                                                   const SourceText& mass, const std::string& mass_name,
                                                   Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  Punched first(stiffness, diagnostics);
  std::optional<Punched> other;
  if (&mass != &stiffness) other.emplace(mass, diagnostics);
  Punched& second = other ? *other : first;
  if (diagnostics.error_count() > before) return std::nullopt;
  const DirectMatrix* k = first.find(stiffness_name, 'K', "stiffness");
  const DirectMatrix* m = second.find(mass_name, 'M', "mass");
  if (!k || !m || !first.check(*k) || !second.check(*m)) return std::nullopt;
  std::map<Freedom, int> rows;
  for (const DirectMatrix* matrix : {k, m}) {
    for (const DirectMatrix::Term& t : matrix->terms) rows[freedom_of(t.row)] = rows[freedom_of(t.column)] = 0;
  }
  DirectMatrices result;
  for (auto& [freedom, row] : rows) {
    row = static_cast<int>(result.freedoms.size());
    result.freedoms.push_back(freedom);
  }
  auto stiffness_matrix = first.build(*k, rows, result.stiffness_at);
  auto mass_matrix = stiffness_matrix ? second.build(*m, rows, result.mass_at) : std::nullopt;
  if (!mass_matrix) return std::nullopt;
  result.stiffness = std::move(*stiffness_matrix), result.mass = std::move(*mass_matrix);
  return result;
}

}  // namespace dynalin::reduction
