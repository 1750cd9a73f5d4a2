#include "elements/controls/rate_reduction.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "elements/controls/signature_method.h"
#include "elements/controls/structural_matrix.h"
#include "expression/formal_partials.h"

namespace dynalin {

namespace {

using Dense = Eigen::MatrixXd;
using Coefficients = Eigen::VectorXd;
using Sum = FormalPartials::Sum;
using Sums = std::vector<std::vector<Sum>>;  // by equation and unknown

constexpr double rank_tolerance = 1e-10;  // of rows whose largest entry is 1

bool reads_rate(const Atom& a) { return a.function->reads == DataSource::state_rate; }
bool reads_value(const Atom& a) { return a.function->reads == DataSource::state; }

void add(Sum& to, const Sum& more, double factor) {
  for (const auto& [term, number] : more) to[term] += factor * number;
}

// The terms of a row beside each other: a combination of rows vanishes whatever the terms are if it vanishes here.
Dense by_terms(const Sums& sums) {
  std::map<FormalPartials::Term, Eigen::Index> place;
  for (const auto& row : sums) {
    for (const Sum& sum : row) {
      for (const auto& [term, number] : sum) place.emplace(term, static_cast<Eigen::Index>(place.size()));
    }
  }
  const auto m = static_cast<Eigen::Index>(sums.size());
  Dense all = Dense::Zero(m, m * static_cast<Eigen::Index>(place.size()));
  for (Eigen::Index r = 0; r < m; ++r) {
    for (Eigen::Index c = 0; c < m; ++c) {
      for (const auto& [term, number] : sums[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)])
        all(r, place.at(term) * m + c) = number;
    }
  }
  return all;
}

StructuralEntry entry_of(const Sum& sum) {
  if (sum.empty()) return {};
  const auto number = sum.find(FormalPartials::one);
  return sum.size() == 1 && number != sum.end() ? StructuralEntry{number->second} : StructuralEntry::any();
}

// Rows in the given order that depend on those before them, each with the combination of rows that vanishes: 1 for the
// row itself, the others on rows that are independent.
struct LeftNullSpace {
  std::vector<std::size_t> row;
  std::vector<Coefficients> combination;
};
LeftNullSpace left_null_space(const Dense& m, const std::vector<std::size_t>& order) {
  LeftNullSpace result;
  struct Step {
    Coefficients row, combination;
    Eigen::Index pivot;
  };
  std::vector<Step> basis;
  for (const std::size_t k : order) {
    const auto at = static_cast<Eigen::Index>(k);
    Coefficients row = m.row(at).transpose(), combination = Coefficients::Unit(m.rows(), at);
    const double size = row.size() > 0 ? row.cwiseAbs().maxCoeff() : 0;
    for (const Step& s : basis) {
      const double factor = row(s.pivot) / s.row(s.pivot);
      row -= factor * s.row;
      combination -= factor * s.combination;
      row(s.pivot) = 0;
    }
    Eigen::Index pivot = 0;
    if (size > 0 && row.cwiseAbs().maxCoeff(&pivot) > rank_tolerance * size) {
      basis.push_back({row, combination, pivot});
      continue;
    }
    const double largest = combination.cwiseAbs().maxCoeff();
    combination = (combination.array().abs() <= rank_tolerance * largest).select(0.0, combination);
    result.row.push_back(k);
    result.combination.push_back(combination);
  }
  return result;
}

class Reducer {
 public:
  explicit Reducer(const std::vector<DiffEquation>& all) : all_(all) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!all[k].constant) index_[all[k].id] = k;
    }
    result_.roles.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      result_.roles[k].is_state = !is_algebraic(k);
      result_.roles[k].equation = k;
    }
  }

  RateReduction run() {
    for (const auto& members : components()) {
      const bool shared = members.size() > 1 || (all_[members[0]].reads_own_rate && !all_[members[0]].constant);
      if (shared) reduce(members);
    }
    return std::move(result_);
  }

 private:
  bool is_algebraic(std::size_t k) const { return all_[k].implicit && !all_[k].reads_own_rate; }

  // DIFFs that are tied by reading each other's rates, each by what is kept first: explicit ones, implicit ones,
  // algebraic ones, each by id.
  std::vector<std::vector<std::size_t>> components() const {
    std::vector<std::size_t> leader(all_.size());
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto find = [&](std::size_t k) {
      while (leader[k] != k) k = leader[k] = leader[leader[k]];
      return k;
    };
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (all_[k].constant) continue;
      for (const Atom& a : all_[k].function.atoms()) {
        if (!reads_rate(a)) continue;
        if (const auto it = index_.find(a.argument[0]); it != index_.end()) leader[find(k)] = find(it->second);
      }
    }
    std::vector<std::size_t> order(all_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t k) { return std::tuple(is_algebraic(k), all_[k].implicit, all_[k].id); };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (const std::size_t k : order) members[find(k)].push_back(k);
    std::vector<std::vector<std::size_t>> list;
    for (auto& [first, of] : members) list.push_back(std::move(of));
    return list;
  }

  // ∂h/∂z′ and ∂h/∂z of the members.
  struct Partials {
    Sums on_rates, on_values;
  };
  Partials partials(const std::vector<std::size_t>& members) const {
    const std::size_t m = members.size();
    FormalPartials formal;
    Partials found{Sums(m, std::vector<Sum>(m)), Sums(m, std::vector<Sum>(m))};
    for (std::size_t r = 0; r < m; ++r) {
      const DiffEquation& d = all_[members[r]];
      if (d.opaque) {
        // Nothing is known: independent of all others.
        for (Sum& sum : found.on_rates[r]) sum[formal.unlike_any()] = 1;
        continue;
      }
      if (!d.implicit) found.on_rates[r][r][FormalPartials::one] = 1;
      const auto atoms = d.function.atoms();
      const std::vector<Sum> slopes = formal.of(d.function);
      for (std::size_t k = 0; k < atoms.size(); ++k) {
        if (!reads_rate(atoms[k]) && !reads_value(atoms[k])) continue;
        const auto known = index_.find(atoms[k].argument[0]);
        const auto it =
            known == index_.end() ? members.end() : std::find(members.begin(), members.end(), known->second);
        if (it == members.end()) continue;
        Sums& into = reads_rate(atoms[k]) ? found.on_rates : found.on_values;
        add(into[r][static_cast<std::size_t>(it - members.begin())], slopes[k], d.implicit ? 1 : -1);
      }
    }
    return found;
  }

  void reduce(const std::vector<std::size_t>& members) {
    for (const std::size_t k : members) {
      if (is_algebraic(k) && all_[k].opaque) return;  // whether its rates take part in the rank is not known
    }
    const Partials of = partials(members);
    std::vector<std::size_t> order(members.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const LeftNullSpace conditions = left_null_space(by_terms(of.on_rates), order);
    auto eliminated = eliminate(conditions, of, members, Unseen::left_out);
    if (!eliminated) eliminated = eliminate(conditions, of, members, Unseen::anything);
    if (eliminated) return assign(members, conditions, *eliminated);
    // Algebraic ones may have rates that are known without this.
    if (std::none_of(members.begin(), members.end(), [&](std::size_t k) { return is_algebraic(k) || all_[k].opaque; }))
      result_.refusals.push_back({members});
  }

  // What is read through VARIABLEs and arrays is not followed: where that has to count, it counts as something, so that
  // the equations themselves decide.
  enum class Unseen : std::uint8_t { left_out, anything };

  // The z that each condition determines, those wanted least first; nothing where the rates stay undetermined.
  std::optional<std::vector<std::size_t>> eliminate(const LeftNullSpace& conditions, const Partials& of,
                                                    const std::vector<std::size_t>& members, Unseen unseen) const {
    const std::size_t m = members.size(), k = conditions.row.size();
    StructuralMatrix C(k, m);
    for (std::size_t r = 0; r < k; ++r) {
      const Coefficients& y = conditions.combination[r];
      bool others = false;
      for (std::size_t j = 0; j < m; ++j)
        others = others || (y(static_cast<Eigen::Index>(j)) != 0.0 && reads_others(all_[members[j]]));
      for (std::size_t c = 0; c < m; ++c)
        C(r, c) = others && unseen == Unseen::anything ? StructuralEntry::any() : entry_of(combined(of, y, c));
    }
    // Equations that stay are differentiated not at all, conditions once.
    StructuralMatrix jacobian(m, m);
    Signature signature(m, std::vector<std::optional<int>>(m));
    std::size_t next = 0;
    for (std::size_t r = 0; r < m; ++r) {
      if (std::find(conditions.row.begin(), conditions.row.end(), r) != conditions.row.end()) continue;
      for (std::size_t c = 0; c < m; ++c) {
        jacobian(next, c) = entry_of(of.on_rates[r][c]);
        if (!jacobian(next, c).is_zero())
          signature[next][c] = 1;
        else if (!of.on_values[r][c].empty())
          signature[next][c] = 0;
      }
      ++next;
    }
    for (std::size_t r = 0; r < k; ++r, ++next) {
      for (std::size_t c = 0; c < m; ++c) {
        jacobian(next, c) = C(r, c);
        if (!C(r, c).is_zero()) signature[next][c] = 0;
      }
    }
    const auto index = structural_index(signature);
    if (!index || *std::max_element(index->differentiated.begin(), index->differentiated.end()) > 1 ||
        index->freedoms != static_cast<int>(m - k) || jacobian.rank() < m)
      return std::nullopt;
    return dependent_columns(C, conditions);
  }

  // ∂(yᵀh)/∂z
  static Sum combined(const Partials& of, const Coefficients& y, std::size_t unknown) {
    std::map<FormalPartials::Term, std::pair<double, double>> terms;  // their sum, and the sum of sizes
    for (std::size_t j = 0; j < of.on_values.size(); ++j) {
      for (const auto& [term, number] : of.on_values[j][unknown]) {
        const double part = y(static_cast<Eigen::Index>(j)) * number;
        terms[term].first += part, terms[term].second += std::abs(part);
      }
    }
    Sum sum;
    for (const auto& [term, c] : terms) {
      if (std::abs(c.first) > rank_tolerance * c.second) sum[term] = c.first;
    }
    return sum;
  }

  // From the last column on those that raise the rank, and for each the row that determines it: if it can, its own.
  static std::optional<std::vector<std::size_t>> dependent_columns(const StructuralMatrix& C,
                                                                   const LeftNullSpace& conditions) {
    std::vector<std::size_t> columns;
    for (std::size_t c = C.columns(); c-- > 0 && columns.size() < C.rows();) {
      columns.push_back(c);
      if (C.columns_only(columns).rank() < columns.size()) columns.pop_back();
    }
    if (columns.size() < C.rows()) return std::nullopt;
    const StructuralMatrix all = C.columns_only(columns);
    StructuralMatrix own = all;
    for (std::size_t r = 0; r < C.rows(); ++r) {
      const auto place = std::find(columns.begin(), columns.end(), conditions.row[r]);
      if (place == columns.end() || C(r, *place).is_zero()) continue;
      const auto at = static_cast<std::size_t>(place - columns.begin());
      for (std::size_t k = 0; k < C.rows(); ++k) {
        if (k != at) own(r, k) = {};
        if (k != r) own(k, at) = {};
      }
    }
    std::vector<std::size_t> row_of, column_of(C.rows());
    if (own.term_rank(row_of) < C.rows() && all.term_rank(row_of) < C.rows()) return std::nullopt;
    for (std::size_t k = 0; k < columns.size(); ++k) column_of[row_of[k]] = columns[k];
    return column_of;
  }

  static bool reads_others(const DiffEquation& d) {
    const auto atoms = d.function.atoms();
    return std::any_of(atoms.begin(), atoms.end(), [](const Atom& a) {
      return a.function->family == AtomFamily::data && !reads_rate(a) && !reads_value(a);
    });
  }

  void assign(const std::vector<std::size_t>& members, const LeftNullSpace& conditions,
              const std::vector<std::size_t>& eliminated) {
    std::vector<bool> is_state(members.size(), true), free(members.size(), true);
    for (std::size_t r = 0; r < eliminated.size(); ++r) {
      const std::size_t z = eliminated[r];
      is_state[z] = false;
      free[conditions.row[r]] = false;
      RateReduction::Role& role = result_.roles[members[z]];
      role.is_state = false;
      const Coefficients& y = conditions.combination[r];
      const bool own = conditions.row[r] == z && (y.array() != 0.0).count() == 1 && is_algebraic(members[z]);
      if (own && !reads_any_rate(all_[members[z]])) continue;
      for (std::size_t j = 0; j < members.size(); ++j) {
        const double factor = y(static_cast<Eigen::Index>(j));
        if (factor != 0.0) role.condition.push_back({members[j], factor});
      }
    }
    // What reads rates in hidden ways is not seen by its partials either.
    if (std::none_of(members.begin(), members.end(), [&](std::size_t k) { return all_[k].opaque; }))
      result_.coupled.push_back(members);
    // Equations that stay go to their own state, what is left over to the states without one.
    std::vector<std::size_t> without;
    for (std::size_t j = 0; j < members.size(); ++j) {
      if (!is_state[j]) continue;
      result_.roles[members[j]].is_state = true;
      if (!free[j]) without.push_back(j);
      free[j] = false;
    }
    std::size_t next = 0;
    for (const std::size_t j : without) {
      while (!free[next]) ++next;
      result_.roles[members[j]].equation = members[next];
      free[next] = false;
    }
  }

  static bool reads_any_rate(const DiffEquation& d) {
    const auto atoms = d.function.atoms();
    return std::any_of(atoms.begin(), atoms.end(), reads_rate);
  }

  const std::vector<DiffEquation>& all_;
  std::map<std::int64_t, std::size_t> index_;
  RateReduction result_;
};

}  // namespace

RateReduction reduce_rates(const std::vector<DiffEquation>& equations) { return Reducer(equations).run(); }

}  // namespace dynalin
