// The shapes of a model: for the export, for contacts and for the eye.
#pragma once

#include <span>
#include <vector>

#include "base/diagnostics.h"
#include "geometry/shape.h"

namespace dynalin {

struct Model;

// Which shapes are wanted: all of them unless said otherwise.
struct ShapeChoice {
  bool files = true;           // what EXTERNAL names; the files are not looked at if not
  bool spring_dampers = true;  // what lies between two bodies

  bool wants(Shape::Origin origin) const {
    return origin == Shape::Origin::file ? files : origin == Shape::Origin::spring_damper ? spring_dampers : true;
  }
};

// A set of elements that draw something.
class ShapeSource {
 public:
  virtual ~ShapeSource() = default;
  virtual void draw(const Model&, std::span<const Pose> poses, const ShapeChoice&, std::vector<Shape>&,
                    Diagnostics& remarks) const = 0;
};

// All shapes, in the order of the catalogue and of the dataset, with the bodies at `poses` (by BodyId, ground first):
// what lies between two markers is as long as they are apart there. Files of shapes are read here. What cannot be drawn
// is left out with a warning: files that are not there, damaged or of an unknown format, shapes without extent.
std::vector<Shape> shapes_of(const Model&, std::span<const Pose> poses, Diagnostics& remarks, const ShapeChoice& = {});
// The poses as the dataset draws them.
std::vector<Pose> drawn_poses(const Model&);

}  // namespace dynalin
