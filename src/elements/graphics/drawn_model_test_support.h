// A model with GRAPHICS out of text, and what it draws.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "elements/catalogue.h"
#include "geometry/mesh_test_support.h"
#include "geometry/shape_source.h"
#include "model/model.h"

namespace dynalin {

struct DrawnModel {
  std::unique_ptr<Model> model;
  Diagnostics diagnostics;  // of reading
  Diagnostics remarks;      // of the last drawing

  std::vector<Shape> shapes(const ShapeChoice& choice = {}) { return shapes(drawn_poses(*model), choice); }
  std::vector<Shape> shapes(std::span<const Pose> poses, const ShapeChoice& choice = {}) {
    remarks = {};
    return shapes_of(*model, poses, remarks, choice);
  }
  Shape shape() {
    auto all = shapes();
    EXPECT_EQ(all.size(), 1u) << render(remarks);
    return all.empty() ? Shape{} : std::move(all.front());
  }
};

// Lines 1 to 11: PART/2 at (10, 0, 0) turned by 90 degrees about z, PART/3 at (0, 20, 0), markers 20, 21 and 30, 31.
inline const std::string two_parts =
    "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=10,0,0, "
    "REULER=90D,0,0\n"
    "MARKER/20, PART=2\nMARKER/21, PART=2, QP=1,2,3, ZP=2,2,3, XP=1,3,3\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=0,20,0\n"
    "MARKER/30, PART=3\nMARKER/31, PART=3, QP=0,0,4\nMARKER/39, PART=3, FLOATING\n";

inline DrawnModel model_of(const std::string& lines, const std::string& name = "model.adm",
                           const std::string& before = two_parts) {
  DrawnModel drawn;
  auto dataset = parse_dataset(std::make_shared<const SourceText>(name, before + lines + "\nEND\n"));
  drawn.diagnostics = std::move(dataset.diagnostics);
  auto built = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  drawn.diagnostics.append(std::move(built.diagnostics));
  drawn.model = std::move(built.value);
  return drawn;
}
inline DrawnModel sound_model_of(const std::string& lines) {
  DrawnModel drawn = model_of(lines);
  EXPECT_TRUE(drawn.diagnostics.items().empty()) << render(drawn.diagnostics);
  return drawn;
}

}  // namespace dynalin
