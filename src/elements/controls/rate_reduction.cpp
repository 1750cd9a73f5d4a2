#include "elements/controls/rate_reduction.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Coefficients = Eigen::VectorXd;

constexpr double rank_tolerance = 1e-10;    // of rows whose largest entry is 1
constexpr std::size_t wanted_points = 4;    // at which M is compared, the initial values among them
constexpr std::size_t offered_points = 24;  // some lie where a function has no value

bool reads_rate(const Atom& a) { return a.function->reads == DataSource::state_rate; }
bool reads_value(const Atom& a) { return a.function->reads == DataSource::state; }

// Numbers without relations between them.
double generic(std::size_t k) {
  const double x = static_cast<double>(k + 1) * 0.6180339887498949;
  return 0.25 + (x - std::floor(x));
}

Matrix scaled_rows(Matrix m) {
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    const double size = m.row(r).cwiseAbs().maxCoeff();
    if (size > 0) m.row(r) /= size;
  }
  return m;
}

bool is_regular(const Matrix& m) {
  Eigen::FullPivLU<Matrix> lu(scaled_rows(m));
  lu.setThreshold(rank_tolerance);
  return lu.isInvertible();
}

// Rows in the given order that depend on those before them, each with the combination of rows that vanishes: 1 for the
// row itself, the others on rows that are independent.
struct LeftNullSpace {
  std::vector<std::size_t> row;
  std::vector<Coefficients> combination;
};
LeftNullSpace left_null_space(const Matrix& m, const std::vector<std::size_t>& order) {
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

  // ∂h/∂z′ and ∂h/∂z of the members at a point; false where something has no value.
  bool partials(const std::vector<std::size_t>& members, std::size_t point, Matrix& on_rates, Matrix& on_values) const {
    const auto m = static_cast<Eigen::Index>(members.size());
    on_rates = on_values = Matrix::Zero(m, m);
    std::vector<double> atoms, slopes;
    ExpressionWorkspace<double> workspace;
    std::map<std::string, double, std::less<>> seen;  // an atom has one value in all equations
    for (Eigen::Index r = 0; r < m; ++r) {
      const DiffEquation& d = all_[members[static_cast<std::size_t>(r)]];
      if (!d.implicit) on_rates(r, r) = 1;
      if (d.opaque) {
        // Nothing is known: independent of all others.
        for (Eigen::Index c = 0; c < m; ++c) on_rates(r, c) = generic(static_cast<std::size_t>(7 * r + c) + 31 * point);
        continue;
      }
      const auto list = d.function.atoms();
      atoms.clear();
      for (const Atom& a : list) atoms.push_back(atom_value(a, point, seen));
      slopes.assign(list.size(), 0.0);
      if (!std::isfinite(d.function.evaluate<double>(atoms, slopes, workspace))) return false;
      for (std::size_t k = 0; k < list.size(); ++k) {
        if (!std::isfinite(slopes[k])) return false;
        if (!reads_rate(list[k]) && !reads_value(list[k])) continue;
        const auto known = index_.find(list[k].argument[0]);
        const auto it =
            known == index_.end() ? members.end() : std::find(members.begin(), members.end(), known->second);
        if (it == members.end()) continue;
        Matrix& into = reads_rate(list[k]) ? on_rates : on_values;
        into(r, it - members.begin()) += d.implicit ? slopes[k] : -slopes[k];
      }
    }
    return true;
  }

  double atom_value(const Atom& a, std::size_t point, std::map<std::string, double, std::less<>>& seen) const {
    const auto known = index_.find(a.argument[0]);
    const bool is_diff = (reads_rate(a) || reads_value(a)) && known != index_.end();
    if (point == 0 && is_diff) {
      const DiffEquation& d = all_[known->second];
      return reads_rate(a) ? d.initial_rate : d.initial;
    }
    std::string name(a.function->name);
    for (std::size_t k = 0; k < a.argument_count; ++k) name += "," + std::to_string(a.argument[k]);
    const auto [it, fresh] = seen.emplace(std::move(name), 0.0);
    if (fresh) it->second = (point % 2 == 0 ? 1.0 : -1.0) * generic(17 * point + seen.size());
    if (fresh && point >= offered_points / 2) it->second *= it->second * static_cast<double>(point);
    return it->second;
  }

  void reduce(const std::vector<std::size_t>& members) {
    for (const std::size_t k : members) {
      if (is_algebraic(k) && all_[k].opaque) return;  // whether its rates take part in the rank is not known
    }
    const auto m = static_cast<Eigen::Index>(members.size());
    std::vector<Matrix> on_rates, on_values;
    for (std::size_t p = 0; p < offered_points && on_rates.size() < wanted_points; ++p) {
      Matrix rates, values;
      if (!partials(members, p, rates, values)) continue;
      on_rates.push_back(std::move(rates));
      on_values.push_back(std::move(values));
    }
    if (on_rates.size() < 2) return;
    Matrix everywhere(m, m * static_cast<Eigen::Index>(on_rates.size()));
    for (std::size_t p = 0; p < on_rates.size(); ++p)
      everywhere.middleCols(static_cast<Eigen::Index>(p) * m, m) = on_rates[p];
    std::vector<std::size_t> order(members.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const LeftNullSpace conditions = left_null_space(everywhere, order);

    const bool as_it_stands =
        std::none_of(members.begin(), members.end(), [&](std::size_t k) { return is_algebraic(k) || all_[k].opaque; });
    const auto refuse = [&](RateReduction::Fault fault) {
      // Algebraic ones may have rates that are known without this.
      if (as_it_stands) result_.refusals.push_back({fault, members});
    };
    const bool varies = std::all_of(on_rates.begin(), on_rates.end(), [&](const Matrix& M) {
      return left_null_space(M, order).row.size() > conditions.row.size();
    });
    if (varies) return refuse(RateReduction::Fault::varying);
    const std::size_t at = on_rates.size() - 1;  // any point but the first, where entries may vanish
    const std::vector<Eigen::Index> eliminated = eliminate(conditions, on_rates[at], on_values[at], members);
    if (eliminated.size() < conditions.row.size() || std::count(eliminated.begin(), eliminated.end(), -1) > 0)
      return refuse(RateReduction::Fault::higher_index);
    assign(members, conditions, eliminated);
  }

  // The z that each condition determines, those wanted least first; none where the rates stay undetermined. What is
  // read through VARIABLEs and arrays is not followed: where that has to count, it counts as something, so that the
  // equations themselves decide.
  std::vector<Eigen::Index> eliminate(const LeftNullSpace& conditions, const Matrix& on_rates, const Matrix& on_values,
                                      const std::vector<std::size_t>& members) const {
    const Eigen::Index m = on_rates.rows(), k = static_cast<Eigen::Index>(conditions.row.size());
    Matrix C(k, m), unseen = Matrix::Zero(k, m), all(m, m);
    for (Eigen::Index r = 0; r < k; ++r) {
      const Coefficients& y = conditions.combination[static_cast<std::size_t>(r)];
      C.row(r) = y.transpose() * on_values;
      for (Eigen::Index j = 0; j < m; ++j) {
        if (y(j) == 0.0 || !reads_others(all_[members[static_cast<std::size_t>(j)]])) continue;
        for (Eigen::Index c = 0; c < m; ++c) unseen(r, c) = generic(static_cast<std::size_t>(m * r + c));
      }
    }
    C = scaled_rows(C);
    Eigen::Index next = 0;
    for (Eigen::Index r = 0; r < m; ++r) {
      const auto dropped = std::find(conditions.row.begin(), conditions.row.end(), static_cast<std::size_t>(r));
      if (dropped == conditions.row.end()) all.row(next++) = on_rates.row(r);
    }
    all.bottomRows(k) = C;
    if (!is_regular(all)) {
      all.bottomRows(k) = C += unseen;
      if (!is_regular(all)) return {};
    }
    std::vector<Eigen::Index> of(static_cast<std::size_t>(k), -1);
    for (Eigen::Index c = m; c-- > 0;) {
      Eigen::Index pivot = -1;
      for (Eigen::Index r = 0; r < k; ++r) {
        const bool taken = of[static_cast<std::size_t>(r)] >= 0 || std::abs(C(r, c)) <= rank_tolerance;
        if (!taken && (pivot < 0 || std::abs(C(r, c)) > std::abs(C(pivot, c)))) pivot = r;
      }
      if (pivot < 0) continue;
      of[static_cast<std::size_t>(pivot)] = c;
      const Eigen::RowVectorXd row = C.row(pivot) / C(pivot, c);
      for (Eigen::Index r = 0; r < k; ++r) {
        if (r != pivot) C.row(r) -= C(r, c) * row;
      }
    }
    return of;
  }

  static bool reads_others(const DiffEquation& d) {
    const auto atoms = d.function.atoms();
    return std::any_of(atoms.begin(), atoms.end(), [](const Atom& a) {
      return a.function->family == AtomFamily::data && !reads_rate(a) && !reads_value(a);
    });
  }

  void assign(const std::vector<std::size_t>& members, const LeftNullSpace& conditions,
              const std::vector<Eigen::Index>& eliminated) {
    std::vector<bool> is_state(members.size(), true), free(members.size(), true);
    for (std::size_t r = 0; r < eliminated.size(); ++r) {
      const auto z = static_cast<std::size_t>(eliminated[r]);
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
