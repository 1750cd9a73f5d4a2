#include "geometry/plane_curve.h"

#include <algorithm>
#include <numbers>

namespace dynalin {

namespace {

constexpr std::size_t fewest_samples = 96;

double cross_z(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

void take_samples(PlaneCurve::Piece& piece, std::size_t intervals) {
  for (std::size_t k = 0; k < intervals + (piece.round ? 0 : 1); ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(intervals);
    piece.samples.push_back(piece.from + (piece.to - piece.from) * share);
  }
}

// Where the pieces of a spline meet.
std::vector<Vector> break_points(const ParametricCurve& curve) {
  const std::vector<double> all = curve.samples(std::numeric_limits<std::size_t>::max());
  std::vector<Vector> points;
  for (std::size_t k = 0; k < all.size(); k += 4) points.push_back(curve.at(all[k]));
  if (curve.shape() == ParametricCurve::Shape::closed) points.back() = points.front();
  return points;
}

}  // namespace

PlaneCurve PlaneCurve::of(std::shared_ptr<const ParametricCurve> spline) {
  const std::vector<double> everywhere = spline->samples(std::numeric_limits<std::size_t>::max());
  if (std::all_of(everywhere.begin(), everywhere.end(), [&](double u) { return spline->straight_at(u); }))
    return polygon(break_points(*spline));
  PlaneCurve c;
  c.spline_ = std::move(spline);
  c.closed_ = c.spline_->shape() == ParametricCurve::Shape::closed;
  Piece p;
  p.kind = Piece::Kind::spline;
  const std::vector<double> all = c.spline_->samples(std::numeric_limits<std::size_t>::max());
  p.from = all.front(), p.to = all.back();
  p.round = c.closed_, p.start_free = p.end_free = !c.closed_;
  const std::size_t between = std::max<std::size_t>(2, (fewest_samples + all.size() - 2) / (all.size() - 1));
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    for (std::size_t i = 0; i < between; ++i)
      p.samples.push_back(all[k] + (all[k + 1] - all[k]) * static_cast<double>(i) / static_cast<double>(between));
  }
  if (!c.closed_) p.samples.push_back(all.back());
  c.pieces_.push_back(std::move(p));
  c.finish();
  return c;
}

PlaneCurve PlaneCurve::circle(double radius, double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  PlaneCurve c;
  c.circle_radius_ = radius;
  c.closed_ = std::abs(angle) >= turn * (1 - 1e-9);
  Piece p;
  p.kind = Piece::Kind::circle;
  p.from = std::min(0.0, angle), p.to = std::max(0.0, angle);
  p.round = c.closed_, p.start_free = p.end_free = !c.closed_;
  if (c.closed_) p.to = p.from + turn;
  take_samples(p, std::max<std::size_t>(8, static_cast<std::size_t>(fewest_samples * (p.to - p.from) / turn)));
  c.pieces_.push_back(std::move(p));
  c.finish();
  return c;
}

PlaneCurve PlaneCurve::polygon(const std::vector<Vector>& points) {
  PlaneCurve c;
  c.closed_ = points.size() > 3 && norm(points.back() - points.front()) == 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    Piece p;
    p.start = points[k], p.along = points[k + 1] - points[k];
    p.start_free = !c.closed_ && k == 0, p.end_free = !c.closed_ && k + 2 == points.size();
    c.pieces_.push_back(std::move(p));
  }
  c.finish();
  const std::size_t n = c.pieces_.size();
  for (std::size_t k = c.closed_ ? 0 : 1; k < n; ++k) {
    const Vector &before = c.pieces_[(k + n - 1) % n].along, &behind = c.pieces_[k].along;
    const double turn = cross_z(before, behind) * c.sense_;
    if (std::abs(turn) <= 1e-9 * norm(before) * norm(behind) && dot(before, behind) > 0) continue;
    c.corners_.push_back({c.pieces_[k].start, -1.0 * normalized(before), normalized(behind), turn >= 0});
  }
  return c;
}

void PlaneCurve::finish() {
  Vector low{1e300, 1e300, 0}, high{-1e300, -1e300, 0};
  std::vector<Vector> all;
  for (Piece& p : pieces_) {
    for (const double u : p.samples) p.points.push_back(at(p, u));
    all.insert(all.end(), p.points.begin(), p.points.end());
    for (const double u : {p.from, p.to}) {
      if (!p.round) all.push_back(at(p, u));
    }
  }
  double area = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    low = {std::min(low.x, all[k].x), std::min(low.y, all[k].y), 0};
    high = {std::max(high.x, all[k].x), std::max(high.y, all[k].y), 0};
    area += cross_z(all[k], all[(k + 1) % all.size()]);
  }
  if (closed_ && area < 0) sense_ = -1;
  centre_ = 0.5 * (low + high);
  for (const Vector& p : all) radius_ = std::max(radius_, norm(p - centre_));
  radius_ *= 1.05;  // what bulges between samples
}

namespace {

std::size_t nearest_sample(const PlaneCurve::Piece& piece, const Vector& p) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < piece.points.size(); ++k) {
    const double x = piece.points[k].x - p.x, y = piece.points[k].y - p.y, square = x * x + y * y;
    if (square < least) best = k, least = square;
  }
  return best;
}

}  // namespace

double PlaneCurve::nearly_nearest(const Piece& piece, const Vector& p) const {
  if (piece.kind != Piece::Kind::spline) return nearest(piece, p);
  const double u = piece.samples[nearest_sample(piece, p)];
  const Vector d = at(piece, u) - p, slope = at(piece, u, 1), bend = at(piece, u, 2);
  const double g = dot(d, slope), square = dot(slope, slope), h = square + dot(d, bend);
  const double most = (piece.to - piece.from) / static_cast<double>(piece.samples.size() - 1);
  return u - std::clamp(g / (h > 0 ? h : square), -most, most);
}

double PlaneCurve::nearest(const Piece& piece, const Vector& p) const {
  if (!piece.curved()) return dot(p - piece.start, piece.along) / dot(piece.along, piece.along);
  if (piece.kind == Piece::Kind::circle) {
    const double angle = std::atan2(p.y, p.x), middle = 0.5 * (piece.from + piece.to);
    return middle + std::remainder(angle - middle, 2 * std::numbers::pi);
  }
  const std::size_t best = nearest_sample(piece, p);
  const std::size_t n = piece.samples.size();
  const double period = piece.to - piece.from;
  double low = best > 0 ? piece.samples[best - 1] : piece.round ? piece.samples[n - 1] - period : -1e300;
  double high = best + 1 < n ? piece.samples[best + 1] : piece.round ? piece.samples[0] + period : 1e300;
  double u = piece.samples[best];
  for (int k = 0; k < 60; ++k) {
    const Vector d = at(piece, u) - p, slope = at(piece, u, 1), bend = at(piece, u, 2);
    const double g = dot(d, slope), h = dot(slope, slope) + dot(d, bend);
    (g > 0 ? high : low) = u;
    double next = h > 0 ? u - g / h : 0.5 * (low + high);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (g == 0 || !(std::abs(next - u) > 1e-15) || !std::isfinite(next)) break;
    u = next;
  }
  return u;
}

double PlaneCurve::height(const Piece& piece, double u, const Vector& p) const {
  const Vector slope = at(piece, u, 1);
  return sense_ * cross_z(p - at(piece, u), slope) / norm(slope);
}

double PlaneCurve::inside(const Piece& piece, double u) const {
  double least = std::numeric_limits<double>::infinity();
  const double speed = norm(at(piece, u, 1));
  if (piece.start_free) least = std::min(least, (u - piece.from) * speed);
  if (piece.end_free) least = std::min(least, (piece.to - u) * speed);
  return least;
}

}  // namespace dynalin
