// Constraints that keep marker I on a curve of another body, KEYWORD/id, I=, JFLOAT=, CURVE=, RM= [, DISP=x,y,z
// [, ICM=]] [, VEL=]. A member E of families/curve_contact.h with one parameter says besides
//
//     static constexpr bool turns;       // whether it holds axes of I, too
#pragma once

#include "elements/families/curve_contact.h"
#include "elements/families/markers.h"

namespace dynalin {

struct CurveRider {
  MarkerId i, jfloat, rm, icm;
  CurveRef curve;
  std::optional<Vector> disp;
  std::optional<double> vel;

  static constexpr std::array<Argument<CurveRider>, 7> arguments = {{
      {.name = "I", .slot = &CurveRider::i, .required = true, .help = "marker that stays on the curve"},
      {.name = "JFLOAT", .slot = &CurveRider::jfloat, .required = true, .help = "floating marker on the body of RM"},
      {.name = "CURVE", .slot = &CurveRider::curve, .required = true, .help = "the curve"},
      {.name = "RM", .slot = &CurveRider::rm, .required = true, .help = "marker in whose axes the curve is stated"},
      {.name = "DISP",
       .slot = &CurveRider::disp,
       .unit = unit::length,
       .help = "where the contact starts, in RM or ICM",
       .start = StatedStart::alone},
      {.name = "VEL",
       .slot = &CurveRider::vel,
       .unit = unit::velocity,
       .help = "speed along the curve at the start",
       .start = StatedStart::alone},
      {.name = "ICM", .slot = &CurveRider::icm, .help = "marker whose axes DISP is stated in"},
  }};
};

template <class E>
class CurveRiderSet final : public CurveContactSet<CurveRider, E> {
 public:
  using CurveContactSet<CurveRider, E>::CurveContactSet;

  void read(std::size_t k, ElementReader& reader) override {
    CurveRider& e = this->elements[k];
    if (read_arguments(e, reader)) check_start_point(reader, e.icm.valid(), e.disp.has_value(), "ICM", "DISP");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < this->elements.size(); ++k) {
      const CurveRider& e = this->elements[k];
      const ElementLabel& label = this->labels[k];
      const Curve* written = model.get<Curve>(e.curve);
      if (!check_pair(model, label, e.i, e.rm, {.rotation_of_I = E::turns, .rotation_of_J = true}, diagnostics) ||
          !check_contact_marker(model, label, e.jfloat, "JFLOAT", e.rm, diagnostics) ||
          !check_start_axes(model, label, e.icm, "ICM", e.rm, diagnostics) || !written->shape) {
        continue;
      }
      model.markers[static_cast<std::size_t>(e.jfloat.index)].follows = e.i;
      const E element{{written->shape}};
      ContactStart start{element.nearest(drawn_frame(model, e.i, e.rm))[0], e.disp.has_value(), e.vel};
      if (e.disp) start.parameter = stated_parameter(model, *written, *e.disp, e.rm, e.icm);
      this->contacts_.push_back({element, e.i, e.rm, e.i, e.jfloat, {{e.jfloat, e.rm, 0}}, {start}});
    }
  }
};

template <class E>
constexpr Kind curve_rider(std::string_view statement, std::string_view summary) {
  return curve_contact<CurveRiderSet<E>, CurveRider>(statement, summary);
}

}  // namespace dynalin
