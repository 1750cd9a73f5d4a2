// PTCV/id, I=, JFLOAT=, CURVE=, RM= [, DISP=x,y,z [, ICM=]] [, VEL=]
//
// The origin of marker I lies on a curve that the body of marker RM carries:
//
//     p − c(u) = 0          p: I from RM in the axes of RM, u: the parameter of the point of contact, a coordinate
//
// Removes 2 degrees of freedom. The reaction on I is a force across the curve, as λ·c′ = 0 says; the opposite acts on
// RM's body at the same point, where the floating marker JFLOAT is.
#include "elements/families/curve_contact.h"
#include "elements/families/markers.h"

namespace dynalin {

namespace {

struct PointOnCurve {
  static constexpr StateType state_type = StateType::ptcv;
  static constexpr std::array<std::string_view, 1> parameter_names = {"Curve parameter ALPHA"};
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
};

struct Ptcv {
  MarkerId i, jfloat, rm, icm;
  CurveRef curve;
  std::optional<Vector> disp;
  std::optional<double> vel;

  static constexpr std::array<Argument<Ptcv>, 7> arguments = {{
      {.name = "I", .slot = &Ptcv::i, .required = true, .help = "marker that stays on the curve"},
      {.name = "JFLOAT", .slot = &Ptcv::jfloat, .required = true, .help = "floating marker on the body of RM"},
      {.name = "CURVE", .slot = &Ptcv::curve, .required = true, .help = "the curve"},
      {.name = "RM", .slot = &Ptcv::rm, .required = true, .help = "marker in whose axes the curve is stated"},
      {.name = "DISP", .slot = &Ptcv::disp, .unit = unit::length, .help = "where the contact starts, in RM or ICM"},
      {.name = "VEL", .slot = &Ptcv::vel, .unit = unit::velocity, .help = "speed along the curve at the start"},
      {.name = "ICM", .slot = &Ptcv::icm, .help = "marker whose axes DISP is stated in"},
  }};
};

class PtcvSet final : public CurveContactSet<Ptcv, PointOnCurve> {
 public:
  using CurveContactSet::CurveContactSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (read_arguments(elements[k], reader))
      check_start_point(reader, elements[k].icm.valid(), elements[k].disp.has_value(), "ICM", "DISP");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Ptcv& e = elements[k];
      const ElementLabel& label = labels[k];
      const Curve* curve = model.get<Curve>(e.curve);
      if (!check_pair(model, label, e.i, e.rm, {true, false, true}, diagnostics) ||
          !check_contact_marker(model, label, e.jfloat, "JFLOAT", e.rm, diagnostics) ||
          !check_start_axes(model, label, e.icm, "ICM", e.rm, diagnostics) || !curve->shape) {
        continue;
      }
      model.markers[static_cast<std::size_t>(e.jfloat.index)].follows = e.i;
      ContactStart start{curve->shape->nearest(drawn_frame(model, e.i, e.rm).p), e.disp.has_value(), e.vel};
      if (e.disp) start.parameter = stated_parameter(model, *curve, *e.disp, e.rm, e.icm);
      contacts_.push_back({{{curve->shape}}, e.i, e.rm, e.i, e.jfloat, {{e.jfloat, e.rm, 0}}, {start}});
    }
  }
};

}  // namespace

extern constinit const Kind ptcv = curve_contact<PtcvSet, Ptcv>("PTCV", "Holds a point on a curve.");

}  // namespace dynalin
