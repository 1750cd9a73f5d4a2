// MFORCE/id, FLEX_BODY= [, JFLOAT=], {CASE_INDEX=, SCALE= | FUNCTION=USER(…) | FORCE=USER(…)}
//
// A load on the modal coordinates of a flexible body: column CASE_INDEX of the body's modal loads times SCALE. It acts
// on flexible bodies whose data hold such loads; files of modes hold none: the statement is read, checked and refused.
#include <fmt/format.h>

#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct ModalForce {
  BodyId body;
  MarkerId jfloat;
  std::optional<std::int64_t> index;
  Expression scale;
  UserSubroutine function{"MFOSUB"}, force{"MFOSUB"};

  static constexpr std::array<Argument<ModalForce>, 6> arguments = {{
      {.name = "FLEX_BODY", .slot = &ModalForce::body, .required = true, .help = "the flexible body it acts on"},
      {.name = "JFLOAT", .slot = &ModalForce::jfloat, .help = "floating marker whose body takes the reaction"},
      {.name = "CASE_INDEX", .slot = &ModalForce::index, .minimum = 1, .help = "which of the body's modal loads"},
      {.name = "SCALE", .slot = &ModalForce::scale, .help = "factor of that load"},
      {.name = "FUNCTION", .slot = &ModalForce::function, .help = "USER(…): not available"},
      {.name = "FORCE", .slot = &ModalForce::force, .help = "USER(…): not available"},
  }};
};

class ModalForceSet final : public TypedSet<ModalForce> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (!read_arguments(elements[k], reader)) return;
    const std::string name = reader.label().text();
    for (const auto& [word, other] : {std::pair{"CASE_INDEX", "SCALE"}, {"SCALE", "CASE_INDEX"}}) {
      if (reader.given(word)) continue;
      reader.error("missing-argument", reader.at(other),
                   reader.given(other) ? fmt::format("{} of {} needs {}", other, name, word)
                                       : fmt::format("{} needs CASE_INDEX and SCALE", name));
      return;
    }
    reader.error("statement-not-built", reader.at("CASE_INDEX"),
                 fmt::format("{} takes a modal load of its body, and modal body files hold none", name));
  }
};

}  // namespace

extern constinit const Kind mforce = Kind{
    "MFORCE",
    "",
    "Load on the modal coordinates of a flexible body.",
    Kind::Role::element,
    detail::argument_infos<ModalForce>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<ModalForceSet>(kind);
    }}.deactivatable();

}  // namespace dynalin
