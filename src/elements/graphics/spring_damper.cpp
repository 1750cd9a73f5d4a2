// Springs with dampers from marker to marker, half on each body.
#include "elements/graphics/checks.h"
#include "elements/graphics/types.h"
#include "geometry/spring_damper_shape.h"

namespace dynalin::drawing {

void SpringDamper::draw(Canvas& canvas) const {
  const Frame<double> I = canvas.frame(i);
  const Vector to_J = canvas.frame(j).origin - I.origin;
  const double distance = norm(to_J);
  if (distance == 0) return canvas.leave_out("its markers are at the same point");
  const Frame<double> frame = frame_along(I.origin, to_J, I.axes.x, I.axes.y);
  const SpringDamperSize size{.coils = coils,
                              .diameter = da,
                              .cup_diameter = {db, dc},
                              .cup_length = {lc, ld},
                              .tip_length = {la, lb},
                              .segments = pieces(segments)};
  auto halves = spring_damper_halves(size, distance);
  canvas.add(canvas.body(i), placed(std::move(halves[0]), frame));
  canvas.add(canvas.body(j), placed(std::move(halves[1]), frame));
}

}  // namespace dynalin::drawing
