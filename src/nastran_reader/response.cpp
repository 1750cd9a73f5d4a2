// SOL 108: (K + iωB − ω²M) u = p for every subcase and frequency.
#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cycle.h"
#include "nastran_reader/selection.h"
#include "nastran_reader/solve.h"

namespace dynalin::nastran_reader {

namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

// Static loads of a set on all freedoms.
Eigen::VectorXd excitation(const Prepared& p, int set) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(p.points->freedoms());
  for (const PointLoad& l : p.deck.point_loads) {
    if (l.set.id != set) continue;
    const Point& at = *p.points->find(l.grid.id);
    const Vector3d local = at.axes.transpose() * (p.points->system(l.system.id)->at(at.position) * l.vector);
    out.segment<3>(at.first + (l.moment ? 3 : 0)) += local;
  }
  for (const FreedomValue& v : p.deck.areas) {
    if (v.set.id == set) out[*p.points->freedom(v.freedom)] += v.value;
  }
  return out;
}

class Loads {
 public:
  explicit Loads(const Prepared& p) : p_(p), deck_(p.deck) {}

  VectorXcd at(int id, double frequency) const {
    VectorXcd sum = VectorXcd::Zero(p_.points->freedoms());
    bool combined = false;
    for (const LoadSum& s : deck_.load_sums) {
      if (s.id.id != id) continue;
      combined = true;
      for (const auto& [factor, part] : s.parts) add(sum, part.id, s.factor * factor, frequency);
    }
    if (!combined) add(sum, id, 1, frequency);
    return sum;
  }

 private:
  void add(VectorXcd& sum, int id, double factor, double frequency) const {
    for (const DynamicLoad& l : deck_.dynamic_loads) {
      if (l.id.id != id) continue;
      const Complex size = factor * Complex(value(l.real_part, frequency), value(l.imaginary_part, frequency));
      const Eigen::VectorXd shape = excitation(p_, l.excitation.id);
      const Eigen::VectorXd phase = each(l.phase, deck_.phases), delay = each(l.delay, deck_.delays);
      for (Eigen::Index k = 0; k < shape.size(); ++k) {
        if (shape[k] == 0) continue;
        // The phase is written in degrees.
        const double angle = phase[k] * std::numbers::pi / 180 - cycle * frequency * delay[k];
        sum[k] += shape[k] * size * std::polar(1.0, angle);
      }
    }
  }

  double value(const NumberOrCard& n, double frequency) const {
    if (n.card.id == 0) return n.value;
    for (const Table& t : deck_.tables) {
      if (t.id.id == n.card.id) return t.at(frequency);
    }
    return 0;
  }

  // Of every freedom: one number for all, or those of the cards and zero elsewhere.
  Eigen::VectorXd each(const NumberOrCard& n, const std::vector<FreedomValue>& cards) const {
    Eigen::VectorXd out = Eigen::VectorXd::Constant(p_.points->freedoms(), n.card.id == 0 ? n.value : 0);
    if (n.card.id == 0) return out;
    for (const FreedomValue& v : cards) {
      if (v.set.id == n.card.id) out[*p_.points->freedom(v.freedom)] = v.value;
    }
    return out;
  }

  const Prepared& p_;
  const Deck& deck_;
};

std::vector<double> selected_frequencies(const Deck& deck) {
  std::vector<double> out;
  for (const Frequencies& f : deck.frequencies) {
    if (deck.control.frequency && f.set.id == deck.control.frequency->id)
      out.insert(out.end(), f.values.begin(), f.values.end());
  }
  std::sort(out.begin(), out.end());
  // Of those that several cards give one is enough.
  out.erase(std::unique(out.begin(), out.end(), [](double a, double b) { return b - a <= 1e-14 * std::abs(b); }),
            out.end());
  return out;
}

std::vector<int> requested(const Prepared& p, const Subcase& s) {
  std::vector<int> out;
  if (!s.displacement || s.displacement->kind == OutputRequest::Kind::none) return out;
  const NamedSet* set = nullptr;
  if (s.displacement->kind == OutputRequest::Kind::set) set = &p.deck.control.sets.at(s.displacement->set.id);
  for (const Point& point : p.points->all()) {
    if (!set || set->contains(point.id)) out.push_back(point.id);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

void tell_idle_loads(const Prepared& p, Diagnostics& diagnostics) {
  constexpr double rounding_of_balance = 1e-12;
  const auto& T = p.elimination.T;
  for (const DynamicLoad& l : p.deck.dynamic_loads) {
    const Eigen::VectorXd loads = excitation(p, l.excitation.id);
    const Eigen::VectorXd acting = (T.transpose() * loads).cwiseAbs();
    const Eigen::VectorXd parts = T.cwiseAbs().transpose() * loads.cwiseAbs();
    if (!loads.any() || (acting.array() > rounding_of_balance * parts.array()).any()) continue;
    diagnostics.warning("idle-load", l.at,
                        fmt::format("RLOAD1 {} excites nothing: constraints hold all that its loads act on", l.id.id));
  }
}

tl::expected<std::vector<ResponseCase>, std::string> solve_response(const Prepared& p, Diagnostics&) {
  if (!p.assembled()) return tl::unexpected(std::string("the deck is wrong"));
  const auto& T = p.elimination.T;
  const SparseMatrix columns = T;
  const auto reduced = [&](const SparseMatrix& X) { return SparseMatrix(columns.transpose() * (X * columns)); };
  const SparseMatrix M = reduced(p.equations.M), B = reduced(p.equations.B), K = reduced(p.equations.K);
  // What no matrix touches rests.
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(T.cols());
  for (const SparseMatrix* X : {&M, &B, &K}) {
    for (Eigen::Index c = 0; c < X->outerSize(); ++c) {
      for (SparseMatrix::InnerIterator it(*X, c); it; ++it) {
        if (it.value() != 0) sizes[it.row()] = sizes[it.col()] = 1;
      }
    }
  }
  std::vector<Eigen::Triplet<double>> resting;
  for (int k = 0; k < T.cols(); ++k) {
    if (sizes[k] == 0) resting.emplace_back(k, k, 1.0);
  }
  SparseMatrix rest(T.cols(), T.cols());
  rest.setFromTriplets(resting.begin(), resting.end());

  const Loads loads(p);
  const std::vector<double> frequencies = selected_frequencies(p.deck);
  std::vector<ResponseCase> out;
  for (const Subcase& s : p.deck.control.subcases) {
    ResponseCase c;
    c.subcase = s.id, c.label = s.label, c.frequencies = frequencies;
    c.displacements = Eigen::MatrixXcd::Zero(p.points->freedoms(), static_cast<Eigen::Index>(frequencies.size()));
    c.points = requested(p, s);
    out.push_back(std::move(c));
  }
  Eigen::SparseLU<ComplexSparse> factors;
  // Where nothing is free to move there is nothing to solve.
  for (std::size_t f = 0; T.cols() > 0 && f < frequencies.size(); ++f) {
    const double omega = cycle * frequencies[f];
    ComplexSparse Q =
        (K + rest).cast<Complex>() + Complex(0, omega) * B.cast<Complex>() - Complex(omega * omega) * M.cast<Complex>();
    Q.makeCompressed();
    if (f == 0) factors.analyzePattern(Q);
    factors.factorize(Q);
    if (factors.info() != Eigen::Success)
      return tl::unexpected(fmt::format("the matrices are singular at {} cycles per unit of time", frequencies[f]));
    for (std::size_t k = 0; k < out.size(); ++k) {
      const auto& dload = p.deck.control.subcases[k].dload;
      if (!dload) continue;
      const VectorXcd load = T.transpose().cast<Complex>() * loads.at(dload->id, frequencies[f]);
      const VectorXcd q = factors.solve(load);
      if (!q.allFinite())
        return tl::unexpected(fmt::format("the matrices are singular at {} cycles per unit of time", frequencies[f]));
      out[k].displacements.col(static_cast<Eigen::Index>(f)) = T.cast<Complex>() * q;
    }
  }
  return out;
}

}  // namespace dynalin::nastran_reader
