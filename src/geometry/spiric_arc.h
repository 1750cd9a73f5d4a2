// Arcs in which a plane cuts a torus: pieces that are graphs over their chords, and places on them for integrals. There
// is no closed form; heights above the chord are found by Newton's method from a cubic that leaves and arrives as the
// arc does. A Gauss rule of 14 places has an error of about the 28th of the coefficients by which Legendre polynomials
// add up to the integrand, and these fall off evenly: a piece is halved until the 12th and 13th of its slope, and of
// its angles about the axis and in the tube, are below 1e-9 of its length. What is left out is their square.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/conic_arc.h"
#include "geometry/spiric_curve.h"

namespace dynalin {

// An arc whose outside is to the right of its chord as seen from the tip of `normal`.
struct SpiricPiece {
  Vector from, to;
  Vector way;     // to − from
  Vector across;  // unit vector in the plane, outwards
  struct Place {
    double s, share;      // of the chord: where, and the weight
    Vector on_chord, at;  // the arc is at `height` along `across`
    double height, rise;  // rise: of the torus' value along `across`
    Vector tangent;       // how it goes on per share of the chord
  };
  std::array<Place, 2 * gauss_14.size()> places;  // one after the other

  // Nothing where there is no such place next to the cubic.
  std::optional<Place> place(const TorusSolid&, double s, double share) const;
  template <class Visit>
  void for_each_place(const Visit& visit) const {
    for (const Place& p : places) visit(p);
  }

 private:
  friend class SpiricPieces;
  double slope_[2]{};  // at both ends, of the height per share of the chord
};

class SpiricPieces {
 public:
  SpiricPieces(const TorusSolid& torus, const SpiricCurve& curve, const Vector& normal, std::vector<SpiricPiece>& out)
      : torus_(torus), curve_(curve), normal_(normal), out_(out) {}

  // Of the curve from one place to another one, that may be on the next stretches. `around`: past the end of the loop.
  // False where roundings have left none.
  bool add(const Vector& from, const SpiricCurve::Place& begin, const Vector& to, const SpiricCurve::Place& end,
           bool around);
  // All of a loop.
  bool add(const SpiricCurve::Loop&);

 private:
  bool add_part(const Vector& from, const Vector& to, std::size_t stretch, double begin, double end, int halvings);
  std::optional<SpiricPiece> piece(const Vector& from, const Vector& to) const;
  bool is_smooth(const SpiricPiece&) const;

  const TorusSolid& torus_;
  const SpiricCurve& curve_;
  Vector normal_;
  std::vector<SpiricPiece>& out_;
};

}  // namespace dynalin
