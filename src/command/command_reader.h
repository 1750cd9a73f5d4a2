// Reads the arguments of a command by the same tables as those of a statement; there is no model behind it.
#pragma once

#include "model/schema.h"

namespace dynalin {

class CommandReader final : public ElementReader {
 public:
  using ElementReader::ElementReader;

  std::optional<MarkerId> marker(const WrittenInteger&, std::string_view) override { return std::nullopt; }
  std::optional<BodyId> body(std::string_view, const WrittenInteger&) override { return std::nullopt; }
  std::optional<ElementHandle> element(std::string_view, const WrittenInteger&) override { return std::nullopt; }
  std::optional<Expression> expression(const WrittenArgument&) override { return std::nullopt; }
  std::optional<VectorExpression> vector_expression(const WrittenArgument&) override { return std::nullopt; }
  std::optional<BodyId> preceding_body() const override { return std::nullopt; }
  std::string folder() const override { return {}; }
};

}  // namespace dynalin
