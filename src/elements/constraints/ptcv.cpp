// PTCV/id, I=, JFLOAT=, CURVE=, RM= [, DISP=x,y,z [, ICM=]] [, VEL=]
//
// The origin of marker I lies on a curve that the body of marker RM carries:
//
//     p − c(u) = 0          p: I from RM in the axes of RM, u: the parameter of the point of contact, a coordinate
//
// Removes 2 degrees of freedom. The reaction on I is a force across the curve, as λ·c′ = 0 says; the opposite acts on
// RM's body at the same point, where the floating marker JFLOAT is.
#include "elements/families/curve_rider.h"

namespace dynalin {

namespace {

struct PointOnCurve {
  static constexpr StateType state_type = StateType::ptcv;
  static constexpr bool turns = false;
  static constexpr std::array<std::string_view, 1> parameter_names = {"Curve parameter ALPHA"};
  static constexpr std::array<StartArguments, 1> starts = {{{"DISP", "VEL"}}};
  static constexpr std::array<std::string_view, 3> row_names = {"DX", "DY", "DZ"};
  std::array<std::shared_ptr<const ParametricCurve>, 1> curves;

  template <class T>
  std::array<T, 3> rows(const RelativeFrame<T>& I, const std::array<T, 1>& u) const {
    const Vec3<T> c = curves[0]->at(u[0]);
    return {I.p.x - c.x, I.p.y - c.y, I.p.z - c.z};
  }
  template <class T>
  Vec3<T> point(const RelativeFrame<T>&, const std::array<T, 1>&) const {
    return {T(0.0), T(0.0), T(0.0)};
  }
  std::array<double, 1> nearest(const RelativeFrame<double>& I) const { return {curves[0]->nearest(I.p)}; }
};

}  // namespace

extern constinit const Kind ptcv = curve_rider<PointOnCurve>("PTCV", "Holds a point on a curve.");

}  // namespace dynalin
