// Typed numbers of things in a model, so that a body cannot be passed for a marker.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "base/vec3.h"
#include "dynalin/element_id.h"

namespace dynalin {

template <class Tag>
struct Handle {
  std::int32_t index = -1;

  bool valid() const { return index >= 0; }
  friend bool operator==(Handle, Handle) = default;
};

using BodyId = Handle<struct BodyTag>;      // ground is body 0
using MarkerId = Handle<struct MarkerTag>;  // the global frame is marker 0

inline constexpr BodyId ground_body{0};
inline constexpr MarkerId global_frame{0};

// An element of any kind: which set of the model, and where in it.
struct ElementHandle {
  std::int32_t set = -1;
  std::int32_t index = -1;

  bool valid() const { return set >= 0; }
  friend bool operator==(ElementHandle, ElementHandle) = default;
};

// A reference to an element of one class of statements, such as ElementRef<VariableClass>.
template <class Class>
struct ElementRef : ElementHandle {};

// clang-format off
struct MarkerClass   { static constexpr std::string_view statement = "MARKER"; };
struct VariableClass { static constexpr std::string_view statement = "VARIABLE"; };
struct ArrayClass    { static constexpr std::string_view statement = "ARRAY"; };
struct MatrixClass   { static constexpr std::string_view statement = "MATRIX"; };
struct JointClass    { static constexpr std::string_view statement = "JOINT"; };
struct CurveClass    { static constexpr std::string_view statement = "CURVE"; };
struct FlexBodyClass { static constexpr std::string_view statement = "FLEX_BODY"; };
// clang-format on

using VariableRef = ElementRef<VariableClass>;
using ArrayRef = ElementRef<ArrayClass>;
using MatrixRef = ElementRef<MatrixClass>;
using JointRef = ElementRef<JointClass>;
using CurveRef = ElementRef<CurveClass>;
using FlexBodyRef = ElementRef<FlexBodyClass>;

// How messages and tables call an element.
struct ElementLabel {
  std::string_view statement;  // "JOINT"
  std::int64_t id = 0;
  std::string_view view_name;  // into the text of the dataset, which lives as long as the model; may be empty
  Span at;

  ElementId element() const { return {std::string(statement), id}; }
  // "JOINT/3", with the view name behind it when there is one.
  std::string text() const { return std::string(statement) + "/" + std::to_string(id); }
  std::string full_text() const { return view_name.empty() ? text() : text() + " (" + std::string(view_name) + ")"; }
};
inline bool same_element(const ElementLabel& a, const ElementLabel& b) {
  return a.id == b.id && a.statement == b.statement;
}

// How a node of a body that changes its shape moves with the modal coordinates of the body, BCS axes.
struct NodeShapes {
  std::size_t first = 0;                      // of these coordinates among those outside poses
  std::vector<Vector> translation, rotation;  // of each coordinate [length, rad per unit of it]
  Vector offset;                              // from the node to the marker, undeformed
};

// Where a marker sits on its body.
struct MarkerPlace {
  BodyId body = ground_body;
  Vector p_BM;                         // origin in the BCS, undeformed
  Matrix3 R_BM = Matrix3::identity();  // axes in the BCS, undeformed
  const NodeShapes* shapes = nullptr;  // of the model, null on a rigid body
};

}  // namespace dynalin
