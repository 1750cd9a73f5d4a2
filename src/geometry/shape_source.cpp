#include "geometry/shape_source.h"

#include "model/model.h"

namespace dynalin {

std::vector<Shape> shapes_of(const Model& model, std::span<const Pose> poses, Diagnostics& remarks,
                             const ShapeChoice& choice) {
  std::vector<Shape> shapes;
  for (const auto& set : model.sets) {
    const auto* source = dynamic_cast<const ShapeSource*>(set.get());
    if (source && set->active) source->draw(model, poses, choice, shapes, remarks);
  }
  return shapes;
}

std::vector<Pose> drawn_poses(const Model& model) {
  std::vector<Pose> poses;
  for (const Body& body : model.bodies) poses.push_back(body.pose);
  return poses;
}

}  // namespace dynalin
