// Where a GRAPHICS statement draws: the model with its bodies in their places, and the shapes so far.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "model/model.h"

namespace dynalin {

class Canvas {
 public:
  Canvas(const Model& model, std::span<const Pose> poses, const ElementLabel& label, Shape::Origin origin,
         std::vector<Shape>& shapes, Diagnostics& remarks)
      : model_(model), poses_(poses), label_(label), origin_(origin), shapes_(shapes), remarks_(remarks) {}

  // In the axes of a marker, on its body.
  void add(MarkerId, Mesh);
  // In global axes, on a body.
  void add(BodyId, Mesh);
  // Lines through the origins of markers, of one body or several.
  void add_line(std::span<const MarkerId>);

  BodyId body(MarkerId m) const { return model_.marker(m).place.body; }
  Frame<double> frame(MarkerId) const;  // global axes
  // Points along a CURVE in the axes of the marker that carries it: at `segments` equal steps of its parameter, or, if
  // that is 0, where its pieces meet and between, at least 20 lines. The last point of a closed curve is the first one.
  std::vector<Vector> along(CurveRef, std::size_t segments) const;
  bool is_closed(CurveRef) const;

  const ElementLabel& label() const { return label_; }
  void remark(std::string_view code, const Span& at, std::string message, std::string hint = {}) {
    remarks_.warning(code, at, std::move(message), std::move(hint));
  }
  // "GRAPHICS/3 is not drawn: why"
  void leave_out(std::string_view why);

 private:
  const Model& model_;
  std::span<const Pose> poses_;
  const ElementLabel& label_;
  Shape::Origin origin_;
  std::vector<Shape>& shapes_;
  Diagnostics& remarks_;
};

// A frame with its origin at a point and z along a direction, x as near as can be to one of two others, the first
// unless it is all but along z.
Frame<double> frame_along(const Vector& origin, const Vector& z, const Vector& x, const Vector& otherwise);
Mesh placed(Mesh, const Frame<double>&);

}  // namespace dynalin
