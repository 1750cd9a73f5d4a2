#include "modal/wrench_work.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/pair_blocks.h"
#include "perturbation/roundoff_scales.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

// Of coefficients along axes (roundoff_scales.h), and a few more of the sums that are made with them.
constexpr double rounding_of_sums = (RoundoffScales::along_axes + 9) * std::numeric_limits<double>::epsilon() / 2;

double size_of(const Matrix3& m) { return std::sqrt(trace(m * transpose(m))); }
// A bound of how much longer it makes a vector, reached by the identity.
double stretch(const Matrix3& m) {
  double rows = 0, columns = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    rows = std::max(rows, std::abs(m(i, 0)) + std::abs(m(i, 1)) + std::abs(m(i, 2)));
    columns = std::max(columns, std::abs(m(0, i)) + std::abs(m(1, i)) + std::abs(m(2, i)));
  }
  return std::sqrt(rows * columns);
}
double size_of(const ComplexVector3& v) { return std::sqrt(std::norm(v[0]) + std::norm(v[1]) + std::norm(v[2])); }

}  // namespace

ComplexVector3 times(const Matrix3& m, const ComplexVector3& v) {
  ComplexVector3 r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = m(i, 0) * v[0] + m(i, 1) * v[1] + m(i, 2) * v[2];
  return r;
}

void add(ComplexVector3& a, const ComplexVector3& b, Complex factor) {
  for (std::size_t k = 0; k < 3; ++k) a[k] += factor * b[k];
}

WrenchWork::WrenchWork(const Layout& layout, PartialBy family, const Eigen::VectorXcd& u, Eigen::VectorXcd dw,
                       Eigen::VectorXd dw_size)
    : layout_(layout), family_(family), u_(u), dw_(std::move(dw)), dw_size_(std::move(dw_size)) {}

WrenchWork::Done WrenchWork::of(const MarkerWrench& w) const {
  const bool strain = family_ == PartialBy::position;
  const PairMotion& p = w.pair;

  // What the motion makes of force and torque, and how much if nothing cancelled; and what they work on: the origin and
  // the axes of I, and against them those of the point that takes the opposite.
  ComplexVector3 dF{}, dT{}, moved{}, turned{};
  double dF_size = 0, dT_size = 0, moved_size = 0, turned_size = 0;
  const Vector reach = w.force.reaction == Reaction::at_J ? Vector{} : value(p.arm) - value(p.arm_J);
  for_each_block(p, layout_, [&](const PairBlock& b) {
    ComplexVector3 du{};
    for (std::size_t k = 0; k < b.count; ++k) du[k] = u_(b.column + static_cast<std::int32_t>(k));
    const double du_size = size_of(du);
    const BlockPartials on = partials_by(b, w.force);
    const Matrix3 &on_force = strain ? on.force : on.force_by_rate, &on_torque = strain ? on.torque : on.torque_by_rate;
    dF_size += du_size * size_of(on_force);
    dT_size += du_size * size_of(on_torque);
    add(dF, times(on_force, du));
    add(dT, times(on_torque, du));
    if (b.of_J && !w.force.acts_on_J()) return;
    const Matrix3 moves = b.of_J ? b.moves - skew(reach) * b.turns : b.moves;
    add(moved, times(moves, du), b.of_J ? -1.0 : 1.0);
    add(turned, times(b.turns, du), b.of_J ? -1.0 : 1.0);
    moved_size += du_size * stretch(moves);
    turned_size += du_size * stretch(b.turns);
  });
  for (const MarkerWrench::Scalar& s : w.scalars) {
    if (s.family != PartialBy::algebraic && s.family != family_) continue;
    const Complex change = s.family == family_ ? u_(s.column) : dw_(s.column);
    const double change_size = s.family == family_ ? std::abs(change) : dw_size_(s.column);
    dF_size += change_size * norm(s.force), dT_size += change_size * norm(s.torque);
    for (std::size_t k = 0; k < 3; ++k) {
      dF[k] += change * s.force[k];
      dT[k] += change * s.torque[k];
    }
  }
  for (const MarkerWrench::Turn& turn : w.turns) {
    if (!strain) continue;
    ComplexVector3 phi{};
    for_each_turning_block(*p.motion, *turn.axes, layout_,
                           [&](std::int32_t column, std::size_t count, const Matrix3& turns) {
                             for (std::size_t k = 0; k < count; ++k)
                               for (std::size_t c = 0; c < 3; ++c)
                                 phi[c] += u_(column + static_cast<std::int32_t>(k)) * turns[k][c];
                           });
    add(dF, times(turn.force, phi));
    add(dT, times(turn.torque, phi));
  }

  Done done;
  done.without_cancellation = moved_size * dF_size + turned_size * dT_size;
  // What is left where a motion cancels works with the whole of what does not: across a damper the force is rounding
  // and the motion is not, along one that only goes along both are.
  constexpr double each = rounding_of_sums;
  done.rounding = each * (size_of(moved) * dF_size + moved_size * size_of(dF) + size_of(turned) * dT_size +
                          turned_size * size_of(dT) + each * done.without_cancellation);
  for (std::size_t k = 0; k < 3; ++k) {
    done.along[k] = -0.5 * std::real(std::conj(moved[k]) * dF[k]);
    done.along[3 + k] = -0.5 * std::real(std::conj(turned[k]) * dT[k]);
  }
  return done;
}

}  // namespace dynalin
