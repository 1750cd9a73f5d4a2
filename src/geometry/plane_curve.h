// A curve in the plane z = 0 that bounds matter: what contacts in a plane are calculated from. It consists of smooth
// pieces, each with a parameter of its own, and of corners where straight ones meet. Matter lies inside where it is
// closed. Where it is open, matter lies to the left as it runs, seen from z; of an arc on the side of its centre.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "expression/parametric_curve.h"

namespace dynalin {

class PlaneCurve {
 public:
  struct Piece {
    enum class Kind : std::uint8_t { spline, circle, line } kind = Kind::line;
    double from = 0, to = 1;                    // of the parameter; an angle on a circle, a share of a line
    bool round = false;                         // it ends where it begins
    bool start_free = false, end_free = false;  // nothing is beyond
    Vector start, along;                        // of a line
    std::vector<double> samples;                // parameters that resolve how it bends, none on a line
    std::vector<Vector> points;                 // there

    bool curved() const { return kind != Kind::line; }
  };
  struct Corner {
    Vector at, back, on;  // unit vectors away from it, along the pieces before and behind
    bool convex = true;
  };

  // One that is straight in all its pieces, as of order 2, is a polygon.
  static PlaneCurve of(std::shared_ptr<const ParametricCurve>);
  // About the origin, from x on; of less than a turn open.
  static PlaneCurve circle(double radius, double angle);
  // Closed where the last point is the first one. Points that follow each other differ.
  static PlaneCurve polygon(const std::vector<Vector>& points);

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<Corner>& corners() const { return corners_; }
  bool closed() const { return closed_; }
  // Where matter is: 1 left, −1 right.
  double sense() const { return sense_; }
  // All of it lies in this circle.
  const Vector& centre() const { return centre_; }
  double radius() const { return radius_; }

  // Point and derivatives 1 and 2.
  template <class T>
  Vec3<T> at(const Piece&, const T& u, int derivative = 0) const;
  // The parameter of the point of a piece next to p, beyond free ends of it and of every line as it goes on there.
  double nearest(const Piece&, const Vector& p) const;
  // The same but for what is of no account: from the nearest sample one step of Newton's method.
  double nearly_nearest(const Piece&, const Vector& p) const;
  // How far p is from matter there, negative within.
  double height(const Piece&, double u, const Vector& p) const;
  // How far u is from the nearest free end, negative beyond it. [length]
  double inside(const Piece&, double u) const;

 private:
  void finish();
  std::vector<Piece> pieces_;
  std::vector<Corner> corners_;
  std::shared_ptr<const ParametricCurve> spline_;
  double circle_radius_ = 0;
  bool closed_ = false;
  double sense_ = 1;
  Vector centre_;
  double radius_ = 0;
};

template <class T>
Vec3<T> PlaneCurve::at(const Piece& piece, const T& u, int derivative) const {
  using std::cos, std::sin;
  switch (piece.kind) {
    case Piece::Kind::spline:
      return spline_->at(u, derivative);
    case Piece::Kind::circle: {
      const T x = cos(u) * circle_radius_, y = sin(u) * circle_radius_;
      if (derivative == 1) return {-y, x, T(0.0)};
      return derivative == 0 ? Vec3<T>{x, y, T(0.0)} : Vec3<T>{-x, -y, T(0.0)};
    }
    case Piece::Kind::line:
      break;
  }
  const Vector& d = piece.along;
  if (derivative == 0) return {piece.start.x + u * d.x, piece.start.y + u * d.y, T(0.0)};
  if (derivative == 1) return {T(d.x), T(d.y), T(0.0)};
  return {T(0.0), T(0.0), T(0.0)};
}

}  // namespace dynalin
