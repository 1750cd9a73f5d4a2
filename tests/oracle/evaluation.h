// Values of function expressions: numbers, or jets along the motion or along a variation of one body.
#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include "functions.h"
#include "model.h"

namespace dynalin::oracle {

// The cubic a + b s + c s^2 + d s^3 of s = x - start that a spline of one curve is made of at x.
struct Piece {
  Real start = 0, a = 0, b = 0, c = 0, d = 0;
};
[[nodiscard]] Piece spline_piece(const std::vector<double>& x, const std::vector<double>& y, Real at,
                                 Interpolation method);

template <class T>
class Evaluator {
 public:
  // A variation serves jets alone; without one their parameter is time.
  // A place serves numbers alone.
  explicit Evaluator(const Model& model, const Variation* variation = nullptr, const LinePoint* line_point = nullptr)
      : model_(model), variation_(variation), line_point_(line_point) {}
  [[nodiscard]] T operator()(const Expr& e) const { return node(*e.node); }
  // Where a contact is on the curves of i and of j.
  [[nodiscard]] std::array<T, 2> contact_parameters(std::size_t k) const;

 private:
  template <class U>
  friend class Evaluator;
  // What a marker at a point of contact does.
  struct Seen {
    Vector3<T> p, v, a, w, al;
    std::array<Vector3<T>, 3> axis;
  };
  // What any marker does, each quantity made when it is asked for: most expressions want one or two.
  class View {
   public:
    View(const Evaluator& of, int id);
    [[nodiscard]] Vector3<T> p() const;
    [[nodiscard]] Vector3<T> v() const;
    [[nodiscard]] Vector3<T> a() const;
    [[nodiscard]] Vector3<T> w() const;
    [[nodiscard]] Vector3<T> al() const;
    [[nodiscard]] Vector3<T> axis(std::size_t k) const;

   private:
    const MarkerMotion& m_;
    std::optional<Seen> at_contact_;
    const Variation* variation_;
    Vec turn_, shift_;  // by the variation
  };
  [[nodiscard]] T node(const Node& n) const;
  [[nodiscard]] T measured(const Node& n) const;
  [[nodiscard]] T spline(const Node& n) const;
  [[nodiscard]] T spectrum(const Node& n) const;
  [[nodiscard]] T curve(const Node& n) const;
  [[nodiscard]] T gap(const Node& n) const;
  [[nodiscard]] T variable(int id) const;
  [[nodiscard]] T state(int id) const;
  [[nodiscard]] View view(int id) const { return View(*this, id); }
  [[nodiscard]] Seen contact_view(std::size_t contact, bool on_i) const;
  [[nodiscard]] const LinePoint& line_point() const {
    if (line_point_ == nullptr) throw std::logic_error("no place along a beam is given");
    return *line_point_;
  }
  [[nodiscard]] static T without_rate(Real value);  // a quantity whose derivatives are not known

  const Model& model_;
  const Variation* variation_;
  const LinePoint* line_point_;
  mutable int depth_ = 0;
};

template <>
Evaluator<Real>::Seen Evaluator<Real>::contact_view(std::size_t contact, bool on_i) const;
template <>
Evaluator<Jet>::Seen Evaluator<Jet>::contact_view(std::size_t contact, bool on_i) const;

}  // namespace dynalin::oracle
