// What a statement that draws a shape offers to contacts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "geometry/solid.h"
#include "mechanics/handles.h"

namespace dynalin {

struct Model;

struct ContactShape {
  MarkerId marker;  // in whose axes it stands
  solid::Shape shape;
};

// A set of elements that draw something.
class ContactShapeSource {
 public:
  virtual ~ContactShapeSource() = default;
  // Nothing where nothing can touch it; `why` then says what it is: "a LINK".
  virtual std::optional<ContactShape> contact_shape(std::size_t element, const Model&, std::string& why) const = 0;
};

}  // namespace dynalin
