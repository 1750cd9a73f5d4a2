// PLCV/id, I=, IFLOAT=, JFLOAT=, CURVE=, RM= [, DISP=x,y,z [, ICM=]] [, VEL=]
//
// The x-y plane of marker I touches a curve that the body of marker RM carries: a point of the curve lies in the plane,
// and its tangent there too. With p and z the origin and the z axis of I from RM, in the axes of RM, and u the
// parameter of the point of contact, a coordinate,
//
//     z·(c(u) − p) = 0,     z·c′(u) = 0
//
// Removes 1 degree of freedom. The reaction on I is a force along z at the point of contact: the balance of u,
// λ₁ z·c′ + λ₂ z·c″ = 0, leaves nothing of the second row where the curve bends away from the plane. The opposite acts
// on RM's body there.
#include "elements/families/curve_contact.h"
#include "elements/families/markers.h"

namespace dynalin {

namespace {

struct PlaneOnCurve {
  static constexpr StateType state_type{60};  // ours
  static constexpr std::array<std::string_view, 1> parameter_names = {"Curve parameter ALPHA"};
  static constexpr std::array<StartArguments, 1> starts = {{{"DISP", "VEL"}}};
  static constexpr std::array<std::string_view, 2> row_names = {"DZ", "tangent"};
  std::array<std::shared_ptr<const ParametricCurve>, 1> curves;

  template <class T>
  std::array<T, 2> rows(const RelativeFrame<T>& I, const std::array<T, 1>& u) const {
    return {dot(I.z, point(I, u)), dot(I.z, curves[0]->at(u[0], 1)) * (1 / curves[0]->least_speed())};
  }
  template <class T>
  Vec3<T> point(const RelativeFrame<T>& I, const std::array<T, 1>& u) const {
    return curves[0]->at(u[0]) - I.p;
  }
  // Where the curve does not bend away from the plane, it could roll along it without any motion of the bodies.
  std::string undetermined(const RelativeFrame<double>& I, const std::array<double, 1>& u) const {
    const Vector slope = curves[0]->at(u[0], 1), bend = curves[0]->at(u[0], 2);
    const double speed = norm(slope), curvature = dot(I.z, bend) / (speed * speed);
    if (std::abs(curvature) * speed > 1e-9) return {};
    return fmt::format(
        " has no definite point of contact: its curve does not bend away from the plane at the parameter {:.6g}", u[0]);
  }

  // Where the curve comes or goes farthest along z, next to the plane; of a curve that does neither, its nearest end.
  std::array<double, 1> nearest(const RelativeFrame<double>& I) const {
    const ParametricCurve& c = *curves[0];
    const auto height = [&](double u) { return dot(I.z, c.at(u) - I.p); };
    const auto slope = [&](double u) { return dot(I.z, c.at(u, 1)); };
    std::vector<double> places = c.samples(std::numeric_limits<std::size_t>::max());
    if (c.shape() == ParametricCurve::Shape::closed) places.push_back(places.front() + 2);
    double best = std::abs(height(places.front())) < std::abs(height(places.back())) ? places.front() : places.back();
    bool touches = false;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      double low = places[k], high = places[k + 1];
      const bool rises = slope(low) > 0;
      if (rises == (slope(high) > 0)) continue;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        ((slope(middle) > 0) == rises ? low : high) = middle;
      }
      if (touches && std::abs(height(low)) >= std::abs(height(best))) continue;
      best = low, touches = true;
    }
    return {best};
  }
};

struct Plcv {
  MarkerId i, ifloat, jfloat, rm, icm;
  CurveRef curve;
  std::optional<Vector> disp;
  std::optional<double> vel;

  static constexpr std::array<Argument<Plcv>, 8> arguments = {{
      {.name = "I", .slot = &Plcv::i, .required = true, .help = "marker whose x-y plane touches the curve"},
      {.name = "IFLOAT", .slot = &Plcv::ifloat, .required = true, .help = "floating marker on the body of I"},
      {.name = "JFLOAT", .slot = &Plcv::jfloat, .required = true, .help = "floating marker on the body of RM"},
      {.name = "CURVE", .slot = &Plcv::curve, .required = true, .help = "the curve"},
      {.name = "RM", .slot = &Plcv::rm, .required = true, .help = "marker in whose axes the curve is stated"},
      {.name = "DISP",
       .slot = &Plcv::disp,
       .unit = unit::length,
       .help = "where the contact starts, in RM or ICM",
       .start = StatedStart::alone},
      {.name = "VEL",
       .slot = &Plcv::vel,
       .unit = unit::velocity,
       .help = "its speed along the curve at the start",
       .start = StatedStart::alone},
      {.name = "ICM", .slot = &Plcv::icm, .help = "marker whose axes DISP is stated in"},
  }};
};

class PlcvSet final : public CurveContactSet<Plcv, PlaneOnCurve> {
 public:
  using CurveContactSet::CurveContactSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (read_arguments(elements[k], reader))
      check_start_point(reader, elements[k].icm.valid(), elements[k].disp.has_value(), "ICM", "DISP");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Plcv& e = elements[k];
      const ElementLabel& label = labels[k];
      const Curve* curve = model.get<Curve>(e.curve);
      if (!check_pair(model, label, e.i, e.rm, {.rotation_of_I = true, .rotation_of_J = true}, diagnostics) ||
          !check_contact_marker(model, label, e.ifloat, "IFLOAT", e.i, diagnostics) ||
          !check_contact_marker(model, label, e.jfloat, "JFLOAT", e.rm, diagnostics) ||
          !check_start_axes(model, label, e.icm, "ICM", e.rm, diagnostics) || !curve->shape) {
        continue;
      }
      const PlaneOnCurve element{{curve->shape}};
      ContactStart start{element.nearest(drawn_frame(model, e.i, e.rm))[0], e.disp.has_value(), e.vel};
      if (e.disp) start.parameter = stated_parameter(model, *curve, *e.disp, e.rm, e.icm);
      contacts_.push_back(
          {element, e.i, e.rm, e.ifloat, e.jfloat, {{e.ifloat, e.rm, 0}, {e.jfloat, e.rm, 0}}, {start}});
    }
  }
};

}  // namespace

extern constinit const Kind plcv = curve_contact<PlcvSet, Plcv>("PLCV", "A plane touches a curve.");

}  // namespace dynalin
