// AXCV/id, I=, JFLOAT=, CURVE=, RM= [, DISP=x,y,z [, ICM=]] [, VEL=]
//
// Marker I runs along a curve that the body of marker RM carries, its z axis along the curve:
//
//     p − c(u) = 0,     x·c′(u) = 0,     y·c′(u) = 0
//
// with the origin p and the axes x, y of I in the axes of RM and the parameter u of the point of contact, a coordinate.
// Removes 4 degrees of freedom: I slides along the curve and turns about it, as in a CYLINDRICAL joint that is bent.
// The reaction on I is a force F and a torque T at its origin that do no work as I slides,
// F·c′ + T·(c′ × c″)/|c′|² = 0: what turns I with the curve is felt along it. The opposite acts on RM's body.
#include "elements/families/curve_rider.h"

namespace dynalin {

namespace {

struct AxisOnCurve {
  static constexpr StateType state_type{61};  // ours
  static constexpr bool turns = true;
  static constexpr std::array<std::string_view, 1> parameter_names = {"Curve parameter ALPHA"};
  static constexpr std::array<StartArguments, 1> starts = {{{"DISP", "VEL"}}};
  static constexpr std::array<std::string_view, 5> row_names = {"DX", "DY", "DZ", "x tangent", "y tangent"};
  std::array<std::shared_ptr<const ParametricCurve>, 1> curves;

  template <class T>
  std::array<T, 5> rows(const RelativeFrame<T>& I, const std::array<T, 1>& u) const {
    const Vec3<T> d = I.p - curves[0]->at(u[0]), slope = curves[0]->at(u[0], 1);
    const double scale = 1 / curves[0]->least_speed();
    return {d.x, d.y, d.z, dot(I.x, slope) * scale, dot(I.y, slope) * scale};
  }
  template <class T>
  Vec3<T> point(const RelativeFrame<T>&, const std::array<T, 1>&) const {
    return {T(0.0), T(0.0), T(0.0)};
  }
  std::array<double, 1> nearest(const RelativeFrame<double>& I) const { return {curves[0]->nearest(I.p)}; }
};

}  // namespace

extern constinit const Kind axcv = curve_rider<AxisOnCurve>("AXCV", "An axis runs along a curve.");

}  // namespace dynalin
