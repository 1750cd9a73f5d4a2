// Arcs in which a plane cuts the curved surface of a solid, of any conic: pieces that are graphs over their chords, and
// integrals over them. On a chord from P to Q the surface's f is −q s (1 − s), and the arc is beside it by the root h
// of a h² + b h = q s (1 − s): without cancellation, of ellipses, parabolas, hyperbolas and straight lines alike.
// Numbers of a Gauss rule are exact but for roundings where the roots of b² + 4 a q s (1 − s) are far from the chord,
// and an arc is halved until they are.
#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "geometry/quadric_solid.h"

namespace dynalin {

// From 0 to 1: places and weights of the first half, each with its mirror image.
inline constexpr std::array<std::array<double, 2>, 7> gauss_14 = {{
    {0.00685809565159383079, 0.01755973016587593014},
    {0.03578255816821324098, 0.04007904357988010396},
    {0.08639934246511750404, 0.06075928534395159258},
    {0.15635354759415726056, 0.07860158357909677318},
    {0.24237568182092295022, 0.09276919873896891100},
    {0.34044381553605512769, 0.10259923186064780209},
    {0.44597252564632816618, 0.10763192673157889745},
}};

// An arc to the right of its chord as seen from the tip of `normal`.
struct ConicPiece {
  Vector from, to;
  Vector way;      // to − from
  Vector across;   // unit vector in the plane, to the side of the arc
  double a, q;     // of f: along `across` squared, and along the chord squared
  double rise[2];  // of f along `across`, at both ends

  struct Place {
    double share;         // of the chord: the weight
    Vector on_chord, at;  // the arc is at `height` along `across`
    double height, rise;
  };
  Place place(double s, double share) const {
    const double c = q * s * (1 - s), b = rise[0] + (rise[1] - rise[0]) * s, root = std::sqrt(b * b + 4 * a * c);
    const double h = 2 * c / (b + root);
    const Vector m = from + way * s;
    return {share, m, m + across * h, h, root};
  }
  // How it goes on per share of the chord.
  static Vector tangent(const QuadricSolid& solid, const ConicPiece& p, const Place& at) {
    return p.way - p.across * (dot(solid.gradient(at.at), p.way) / at.rise);
  }
  template <class Visit>
  void for_each_place(const Visit& visit) const {
    for (const auto& [s, weight] : gauss_14) visit(place(s, weight)), visit(place(1 - s, weight));
  }
};

// Whether Gauss' rule is exact: an error falls as the 28th power of the size of the ellipse about −1 and 1 that has the
// nearest root on it.
inline bool is_smooth(const ConicPiece& p) {
  constexpr double least = 4;
  if (!(p.rise[0] > 0 && p.rise[1] > 0)) return false;
  using Complex = std::complex<double>;
  const double m = 0.5 * (p.rise[0] + p.rise[1]), d = 0.5 * (p.rise[1] - p.rise[0]), c = p.a * p.q;
  const auto is_far = [&](const Complex& x) {
    const Complex root = std::sqrt(x * x - 1.0);
    return std::max(std::abs(x + root), std::abs(x - root)) >= least;
  };
  const double A = d * d - c, B = m * d, C = m * m + c;
  const Complex root = std::sqrt(Complex(B * B - A * C));
  const Complex sum = B > 0 ? -B - root : -B + root;
  // Of both roots sum/A and C/sum.
  return (A == 0 || is_far(sum / A)) && (sum == 0.0 || is_far(C / sum));
}

// leaf(piece) for all of an arc; false where roundings have left none. `direction`: of its chord.
template <class Leaf>
bool for_each_piece(const QuadricSolid& solid, const Vector& normal, const Vector& from, const Vector& to,
                    const Vector& direction, const Leaf& leaf, int halvings = 40) {
  const Vector across = cross(direction, normal), way = to - from;
  const ConicPiece p{from,
                     to,
                     way,
                     across,
                     solid.form(across, across),
                     std::max(solid.form(way, way), 0.0),
                     {dot(solid.gradient(from), across), dot(solid.gradient(to), across)}};
  if (is_smooth(p)) {
    leaf(p);
    return true;
  }
  if (halvings == 0) return false;
  const double b = 0.5 * (p.rise[0] + p.rise[1]), c = 0.25 * p.q, square = b * b + 4 * p.a * c;
  if (!(square >= 0)) return false;
  const double h = b > 0 ? 2 * c / (b + std::sqrt(square)) : (std::sqrt(square) - b) / (2 * p.a);
  const Vector middle = from + 0.5 * way + across * h, one = middle - from, other = to - middle;
  const double size = norm(one), other_size = norm(other);
  if (!std::isfinite(h) || !(size > 0) || !(other_size > 0)) return false;
  return for_each_piece(solid, normal, from, middle, one / size, leaf, halvings - 1) &&
         for_each_piece(solid, normal, middle, to, other / other_size, leaf, halvings - 1);
}

}  // namespace dynalin
