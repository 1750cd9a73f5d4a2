// The scalar values of elements that data functions of expressions read.
#pragma once

#include <cstddef>
#include <cstdint>

#include "mechanics/handles.h"

namespace dynalin {

class BoundExpression;

// A scalar channel that expressions may read.
struct Channel {
  enum class Kind : std::uint8_t { none, constant, algebraic, state, state_rate } kind = Kind::none;
  std::int32_t index = -1;
  double constant = 0;
};

// Elements that hold values which data functions read.
class ChannelSource {
 public:
  virtual Channel value_channel(std::size_t /*element*/) const { return {}; }  // VARVAL
  // The expression that gives this value, null if none does.
  virtual const BoundExpression* value_function(std::size_t /*element*/) const { return nullptr; }
  virtual Channel state_channel(std::size_t /*element*/, std::size_t /*n*/) const { return {}; }
  virtual Channel output_channel(std::size_t /*element*/, std::size_t /*n*/) const { return {}; }
  // The coordinate of shape n of a body that this source deforms, or its time derivative of that order.
  virtual Channel shape_channel(BodyId, std::size_t /*n*/, int /*derivative*/) const { return {}; }

 protected:
  ~ChannelSource() = default;
};

}  // namespace dynalin
