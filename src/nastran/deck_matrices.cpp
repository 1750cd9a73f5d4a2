#include "nastran/deck_matrices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "dataset/characters.h"

namespace dynalin::nastran {

namespace {

using Entry = Matrix::Entry;
using Entries = std::vector<Entry>;

bool before(const Entry& a, const Entry& b) { return std::tie(a.column, a.row) < std::tie(b.column, b.row); }

// By columns, each place once.
Entries summed(Entries entries) {
  std::stable_sort(entries.begin(), entries.end(), before);
  Entries sums;
  for (const Entry& e : entries) {
    if (!sums.empty() && sums.back().row == e.row && sums.back().column == e.column)
      sums.back().value += e.value;
    else
      sums.push_back(e);
  }
  return sums;
}

// ½ (A ± Aᵀ), the lower triangle alone if it is the symmetric part.
Entries part_of(const Entries& sums, double sign) {
  Entries halves;
  halves.reserve(2 * sums.size());
  for (const Entry& e : sums) {
    halves.push_back({e.row, e.column, e.value / 2});
    halves.push_back({e.column, e.row, sign * e.value / 2});
  }
  Entries part = summed(std::move(halves));
  if (sign > 0) std::erase_if(part, [](const Entry& e) { return e.row < e.column; });
  return part;
}

bool is_symmetric(const Entries& sums) {
  return std::ranges::all_of(sums, [&](const Entry& e) {
    const Entry mirrored{e.column, e.row, e.value};
    const auto other = std::lower_bound(sums.begin(), sums.end(), mirrored, before);
    return other != sums.end() && !before(mirrored, *other) && other->value == e.value;
  });
}

double largest(const Entries& entries) {
  double most = 0;
  for (const Entry& e : entries) most = std::max(most, std::abs(e.value));
  return most;
}

// Names of data blocks, which a matrix must not have.
bool is_reserved(std::string_view name) {
  static constexpr std::array<std::string_view, 20> names = {
      "POOL", "NPTP", "OPTP",     "GEOM1",  "GEOM2", "GEOM3",   "GEOM4", "GEOM5", "EDT", "MPT",
      "EPT",  "DIT",  "DYNAMICS", "CASECC", "FORCE", "MATPOOL", "KGG",   "BGG",   "MGG", "KDICT"};
  return name.starts_with("SCRATCH") || std::ranges::find(names, name) != names.end();
}

constexpr std::size_t longest_name = 8;

// Upper case, as it is read; a digit at the end where another matrix or Nastran itself has the name.
std::string own_name(std::string wanted, std::set<std::string>& taken) {
  std::string name;
  for (const char c : wanted) {
    if ((is_letter(c) || is_digit(c)) && name.size() < longest_name) name += to_upper(c);
  }
  const std::string stem = name;
  for (int k = 1; is_reserved(name) || taken.contains(name); ++k) {
    const std::string number = std::to_string(k);
    name = stem.substr(0, longest_name - number.size()) + number;
  }
  taken.insert(name);
  return name;
}

char root(MatrixKind kind) { return "KBM"[static_cast<std::size_t>(kind)]; }

class MatrixWriter {
 public:
  MatrixWriter(const Deck& deck, const ExportOptions& options, Diagnostics& remarks, std::vector<std::string>& details)
      : options_(options), remarks_(remarks), details_(details) {
    const auto take = [this](MatrixKind kind, double value) {
      double& most = largest_of_kind_[static_cast<std::size_t>(kind)];
      most = std::max(most, std::abs(value));
    };
    for (const Matrix& m : deck.matrices) take(m.kind, largest(m.entries));
    for (const Bush& b : deck.bushes) {
      for (const double k : b.stiffness) take(MatrixKind::K, k);
      for (const double c : b.damping) take(MatrixKind::B, c);
    }
  }

  void add(const Matrix& matrix) {
    const Entries sums = summed(matrix.entries);
    const std::string name = root(matrix.kind) + matrix.suffix;
    dropped_ = 0;
    const std::size_t before_this = list_.size();
    if (is_symmetric(sums)) {
      Entries lower = sums;
      std::erase_if(lower, [](const Entry& e) { return e.row < e.column; });
      keep(matrix, name, true, std::move(lower));
    } else if (!(options_.split_dmigs && options_.solution_number == 108)) {
      keep(matrix, name, false, sums);
    } else {
      // What is small in the rest is the rounding of a symmetric matrix: the tolerance comes after the split.
      Entries even = part_of(sums, 1), odd = part_of(sums, -1);
      drop_small(even), drop_small(odd);
      const std::string letter(1, root(matrix.kind));
      if (!even.empty()) put(matrix, odd.empty() ? name : letter + "S" + matrix.suffix, true, std::move(even));
      if (!odd.empty()) put(matrix, letter + "A" + matrix.suffix, false, std::move(odd));
    }
    report(name, matrix, largest(sums), list_.size() > before_this);
  }
  std::vector<WrittenMatrix> take() { return std::move(list_); }

 private:
  void drop_small(Entries& entries) {
    std::erase_if(entries, [&](const Entry& e) {
      const bool small = e.value == 0 || std::abs(e.value) < options_.matrix_entry_zero_tolerance;
      if (small) dropped_ = std::max(dropped_, std::abs(e.value));
      return small;
    });
  }
  void keep(const Matrix& matrix, const std::string& name, bool symmetric, Entries entries) {
    drop_small(entries);
    if (!entries.empty()) put(matrix, name, symmetric, std::move(entries));
  }
  void put(const Matrix& matrix, const std::string& name, bool symmetric, Entries entries) {
    list_.push_back({own_name(name, taken_), matrix.kind, symmetric, std::move(entries), matrix});
  }
  void report(const std::string& name, const Matrix& matrix, double most, bool written) {
    const std::string of = matrix.name.empty() ? name : fmt::format("{} of {}", name, matrix.name);
    details_.push_back(
        most == 0 ? fmt::format("matrix {} is empty", of)
        : dropped_ == 0
            ? fmt::format("matrix {}: nothing is below the tolerance", of)
            : fmt::format("matrix {}: the largest entry that is not written is {:.3g}, the largest is {:.3g}", of,
                          dropped_, most));
    // What is left of a force beyond its CBUSH may be rounding alone: it counts beside all of its kind.
    constexpr double worth_saying = 1e-8;
    if (dropped_ > worth_saying * largest_of_kind_[static_cast<std::size_t>(matrix.kind)])
      remarks_.warning(
          "dropped-entries", {},
          fmt::format("entries of {} below matrix_entry_zero_tolerance = {:g} are not written, up to {:.3g}{}", of,
                      options_.matrix_entry_zero_tolerance, dropped_,
                      written ? fmt::format("; the largest is {:.3g}", most) : ", all that it has"),
          "matrix_entry_zero_tolerance = 0");
  }

  const ExportOptions& options_;
  Diagnostics& remarks_;
  std::vector<std::string>& details_;
  std::vector<WrittenMatrix> list_;
  std::set<std::string> taken_;
  double dropped_ = 0;                       // the largest of a matrix
  std::array<double, 3> largest_of_kind_{};  // K, B and M
};

}  // namespace

std::vector<WrittenMatrix> written_matrices(const Deck& deck, const ExportOptions& options, Diagnostics& remarks,
                                            std::vector<std::string>& details) {
  MatrixWriter writer(deck, options, remarks, details);
  for (const Matrix& matrix : deck.matrices) writer.add(matrix);
  return writer.take();
}

void write(const WrittenMatrix& matrix, FieldWidth width, CardFile& file) {
  constexpr int square = 1, symmetric = 6, single = 1, twice = 2;
  const bool large = width == FieldWidth::large;
  file.heading("matrix " + matrix.name);
  Card header("DMIG", FieldWidth::small);
  header.word(matrix.name).integer(0).integer(matrix.symmetric ? symmetric : square);
  header.integer(large ? twice : single).integer(0);
  file.add(header, matrix.owner);
  for (std::size_t k = 0; k < matrix.entries.size();) {
    const Dof column = matrix.entries[k].column;
    Card card("DMIG", width);
    card.word(matrix.name).integer(column.point).integer(column.component).blank();
    for (; k < matrix.entries.size() && matrix.entries[k].column == column; ++k) {
      const Entry& e = matrix.entries[k];
      card.integer(e.row.point).integer(e.row.component);
      card.real(e.value, large ? Exponent::letter_D : Exponent::bare).blank();
    }
    file.add(card, matrix.owner);
  }
}

}  // namespace dynalin::nastran
