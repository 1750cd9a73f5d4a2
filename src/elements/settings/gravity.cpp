// ACCGRAV/IGRAV=, JGRAV=, KGRAV=
//
// Gravitational acceleration along the global axes [length/time²]; without the statement there is none. Every body
// carries its weight (mass/UCF) g at its centre of mass.
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct Gravity {
  double x = 0, y = 0, z = 0;

  static constexpr std::array<Argument<Gravity>, 3> arguments = {{
      {.name = "IGRAV", .slot = &Gravity::x, .unit = unit::acceleration, .help = "along global x"},
      {.name = "JGRAV", .slot = &Gravity::y, .unit = unit::acceleration, .help = "along global y"},
      {.name = "KGRAV", .slot = &Gravity::z, .unit = unit::acceleration, .help = "along global z"},
  }};
};

class GravitySet final : public TypedSet<Gravity> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override { read_arguments(elements[k], reader); }
  void finish(Model& model, Diagnostics&) override {
    if (!elements.empty()) model.gravity = {elements[0].x, elements[0].y, elements[0].z};
  }
};

}  // namespace

extern constinit const Kind gravity = Kind{
    "ACCGRAV",
    "",
    "Gravitational acceleration in global axes.",
    Kind::Role::singleton,
    detail::argument_infos<Gravity>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<GravitySet>(kind);
    }}.with_example("ACCGRAV/KGRAV=0");

}  // namespace dynalin
