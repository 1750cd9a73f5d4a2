// Statements that are read as text, kept and otherwise passed over.
#pragma once

#include "model/kind.h"
#include "model/model.h"

namespace dynalin {

class TextSet : public ElementSet {
 public:
  using ElementSet::ElementSet;
  void append(ElementLabel label) override {
    labels.push_back(std::move(label));
    sound.push_back(true);
  }
  void read(std::size_t, ElementReader&) override {}
  void finish(Model& model, Diagnostics&) override {
    if (!labels.empty()) model.settings.passed_over.emplace_back(kind().statement);
  }
};

// An element has an id that others may refer to, something inert need not.
constexpr Kind kept_as_text(std::string_view statement, std::string_view summary, Kind::Role role) {
  return {statement, "",
          summary,   role,
          {},        [](const Kind& kind) -> std::unique_ptr<ElementSet> {
            return std::make_unique<TextSet>(kind); }};
}

}  // namespace dynalin
